//! Loops compiled once for each set of instructions, and the choice between them at run time.

use pulp::NullaryFnOnce;
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};

/// Sets of instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Isa {
    /// What every processor of the kind has (x86-64: SSE2).
    Baseline,
    /// x86-64-v3: AVX2 and fused multiply-add.
    Avx2,
    /// x86-64-v4: AVX-512.
    Avx512,
}

impl Isa {
    /// All, the narrowest first.
    pub const ALL: [Self; 3] = [Self::Baseline, Self::Avx2, Self::Avx512];

    /// The best that the processor has.
    #[cfg(target_arch = "x86_64")]
    pub fn best() -> Self {
        if V4::try_new().is_some() {
            Self::Avx512
        } else if V3::try_new().is_some() {
            Self::Avx2
        } else {
            Self::Baseline
        }
    }

    /// The best that the processor has: other kinds have one set only.
    #[cfg(not(target_arch = "x86_64"))]
    pub fn best() -> Self {
        Self::Baseline
    }

    /// This, or the best that the processor has where it lacks this.
    pub fn available(self) -> Self {
        self.min(Self::best())
    }

    /// The name in reports.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// Runs a loop that is compiled for these instructions, or for fewer where the processor lacks them. `work.call` and all
    /// that it calls must be inlined, else it is compiled for the baseline.
    #[inline(always)]
    pub fn run<W: NullaryFnOnce>(self, work: W) -> W::Output {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 if let Some(v4) = V4::try_new() => v4.vectorize(work),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 | Self::Avx2 if let Some(v3) = V3::try_new() => v3.vectorize(work),
            _ => work.call(),
        }
    }
}
