//! A hint to the processor's caches: the only unsafe code of this project.
//!
//! A row of the target crosses rows of the source, and the next one needs their lower neighbours: lines of memory so far apart that
//! no processor foresees them. Asked for early, they are there in time: with and without the hint, in turns on one thread
//! (`examples/measure_convert.rs`, latlong of 4096 x 2048 and six faces of 1024, AVX-512), floats to the cube took 48 and 56 ms,
//! back 57 and 69 ms; bytes 30 and 31 ms, back 39 and 41 ms.

#![expect(
    unsafe_code,
    reason = "the hint is declared unsafe, though it reads nothing"
)]

/// Asks for the memory of the sample at `index`, counted around; does nothing where there is no such hint.
#[inline(always)]
pub(super) fn prefetch<T>(samples: &[T], index: usize) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let address = samples.as_ptr().wrapping_add(index).cast();
        // SAFETY: every address is allowed: the hint neither reads nor faults. Its instructions, SSE, belong to this architecture.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(address) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (samples, index);
}
