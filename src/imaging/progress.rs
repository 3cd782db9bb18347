//! How far a job is, and the wish that it stop.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU32, AtomicU64, Ordering};
use std::time::{Duration, Instant};

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

/// Shared between the worker that reports and the window that shows and cancels. A few atomics: cheap to ask every row.
#[derive(Debug)]
pub struct Progress {
    fraction_bits: AtomicU32,
    stage: AtomicU8,
    cancelled: Arc<AtomicBool>,
    start: Instant,
    /// When the present stage began, after the start.
    stage_start_ms: AtomicU64,
}

impl Default for Progress {
    fn default() -> Self {
        Self {
            fraction_bits: AtomicU32::default(),
            stage: AtomicU8::default(),
            cancelled: Arc::default(),
            start: Instant::now(),
            stage_start_ms: AtomicU64::default(),
        }
    }
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

    /// How long the present stage will still take if it goes on as it has; `None` as long as too little is done to tell.
    pub fn left(&self) -> Option<Duration> {
        let began = Duration::from_millis(self.stage_start_ms.load(Ordering::Relaxed));
        left_after(self.start.elapsed().saturating_sub(began), self.fraction())
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
        // `as`: 2^64 milliseconds are not reached.
        let now_ms = self.start.elapsed().as_millis() as u64;
        self.stage_start_ms.store(now_ms, Ordering::Relaxed);
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

/// How long the rest takes when `fraction` of all took `taken`.
fn left_after(taken: Duration, fraction: f32) -> Option<Duration> {
    /// What is done sooner, or by less, says nothing of the pace.
    const LEAST_TIME: Duration = Duration::from_millis(200);
    const LEAST_DONE: f32 = 0.02;
    let is_told = taken >= LEAST_TIME && fraction >= LEAST_DONE;
    is_told.then(|| taken.mul_f32((1.0 - fraction) / fraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_takes_as_long_as_what_is_done() {
        let second = Duration::from_secs(1);
        assert_eq!(left_after(second, 0.25), Some(3 * second));
        assert_eq!(left_after(second, 1.0), Some(Duration::ZERO));
        assert_eq!(left_after(second, 0.01), None);
        assert_eq!(left_after(second / 10, 0.25), None);
        assert_eq!(left_after(second, f32::NAN), None);
    }

    #[test]
    fn each_stage_has_its_own_pace() {
        let progress = Progress::new();
        progress.step(1, 2);
        std::thread::sleep(Duration::from_millis(250));
        assert!(progress.left().is_some());
        progress.enter(Stage::Writing);
        progress.step(1, 2);
        assert_eq!(progress.left(), None);
    }
}
