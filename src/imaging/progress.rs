//! How far a job is, and the wish that it stop.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU32, Ordering};

/// What a job is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Stage {
    /// Nothing yet.
    #[default]
    Waiting,
    /// Bytes come from the file.
    Reading,
    /// Bytes become texels or triangles.
    Decoding,
    /// Texels come from a formula.
    Computing,
    /// Texels of one map become those of another.
    Converting,
    /// Texels become bytes of a file.
    Writing,
    /// What cannot be shown is counted and replaced.
    Checking,
    /// Times are taken and errors found.
    Measuring,
    /// The result is ready.
    Done,
}

impl Stage {
    const ALL: [Self; 9] = [
        Self::Waiting,
        Self::Reading,
        Self::Decoding,
        Self::Computing,
        Self::Converting,
        Self::Writing,
        Self::Checking,
        Self::Measuring,
        Self::Done,
    ];

    /// One word for the status bar.
    pub fn name(self) -> &'static str {
        match self {
            Self::Waiting => "waiting",
            Self::Reading => "reading",
            Self::Decoding => "decoding",
            Self::Computing => "computing",
            Self::Converting => "converting",
            Self::Writing => "writing",
            Self::Checking => "checking",
            Self::Measuring => "measuring",
            Self::Done => "done",
        }
    }
}

/// Shared between the worker that reports and the window that shows and cancels. Three atomics: cheap to ask every row.
#[derive(Debug, Default)]
pub struct Progress {
    fraction_bits: AtomicU32,
    stage: AtomicU8,
    cancelled: Arc<AtomicBool>,
}

impl Progress {
    /// Nothing done, not cancelled.
    pub fn new() -> Self {
        Self::default()
    }

    /// Share of the present stage that is done, in [0, 1].
    pub fn fraction(&self) -> f32 {
        f32::from_bits(self.fraction_bits.load(Ordering::Relaxed))
    }

    /// The present stage.
    pub fn stage(&self) -> Stage {
        let index = usize::from(self.stage.load(Ordering::Relaxed));
        Stage::ALL.get(index).copied().unwrap_or_default()
    }

    /// Asks the job to stop at the next row or block.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the job was asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// What [`Self::cancel`] sets, for those who can only set a flag: a signal's handler.
    pub fn cancel_flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.cancelled)
    }

    /// Reports a new stage; its fraction starts at 0.
    pub fn enter(&self, stage: Stage) {
        self.set_fraction(0.0);
        self.stage.store(stage as u8, Ordering::Relaxed);
    }

    /// Reports that `done` of `total` is done.
    pub fn step(&self, done: usize, total: usize) {
        self.set_fraction(done as f32 / total.max(1) as f32);
    }

    fn set_fraction(&self, fraction: f32) {
        let bits = fraction.clamp(0.0, 1.0).to_bits();
        self.fraction_bits.store(bits, Ordering::Relaxed);
    }
}
