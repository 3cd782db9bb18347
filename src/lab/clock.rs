//! How long a piece of work takes.

use std::hint::black_box;
use std::time::{Duration, Instant};

/// How carefully times are taken.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// How often a piece of work is timed.
    pub samples: usize,
    /// The shortest time that is taken, by repeating the work.
    pub shortest: Duration,
}

/// Times of one piece of work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Median, in nanoseconds.
    pub median_ns: f64,
    /// Half the distance between the quartiles over the median.
    pub spread: f64,
}

impl Clock {
    /// Times `work`, which is run once before.
    pub fn time(self, mut work: impl FnMut()) -> Timing {
        let mut run = |repeats: u32| {
            let start = Instant::now();
            for _ in 0..repeats {
                work();
            }
            start.elapsed()
        };
        let first = run(1);
        let once = first.min(run(1)).max(Duration::from_nanos(20));
        let repeats = self.shortest.as_nanos().div_ceil(once.as_nanos()).max(1);
        let repeats = u32::try_from(repeats).unwrap_or(u32::MAX);
        let samples = (0..self.samples.max(1)).map(|_| run(repeats).as_secs_f64() * 1e9);
        let mut samples: Vec<f64> = samples.map(|ns| ns / f64::from(repeats)).collect();
        samples.sort_by(f64::total_cmp);
        let at = |share: f64| samples[((samples.len() - 1) as f64 * share).round() as usize];
        let median_ns = at(0.5);
        Timing {
            median_ns,
            spread: 0.5 * (at(0.75) - at(0.25)) / median_ns.max(f64::MIN_POSITIVE),
        }
    }

    /// Times a plain copy of `bytes` bytes by one thread or, in pieces, by all.
    pub fn copy(self, bytes: usize, on_all: bool) -> Timing {
        let from = vec![1_u8; bytes];
        let mut to = vec![0_u8; bytes];
        self.time(|| {
            if on_all {
                copy_on_all(&from, &mut to);
            } else {
                to.copy_from_slice(black_box(&from));
            }
            black_box(&mut to);
        })
    }
}

/// Bytes that one thread copies at least.
const PIECE: usize = 1 << 18;

fn copy_on_all(from: &[u8], to: &mut [u8]) {
    if from.len() <= PIECE {
        to.copy_from_slice(black_box(from));
        return;
    }
    let half = from.len() / 2;
    let (a, b) = to.split_at_mut(half);
    rayon::join(
        || copy_on_all(&from[..half], a),
        || copy_on_all(&from[half..], b),
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_repeated_until_it_can_be_timed() {
        let clock = Clock {
            samples: 3,
            shortest: Duration::from_micros(200),
        };
        let mut calls = 0_u32;
        let timing = clock.time(|| calls += black_box(1));
        assert!(calls > 100, "{calls}");
        assert!(timing.median_ns > 0.0 && timing.spread >= 0.0);
        let small = clock.copy(1 << 10, false).median_ns;
        let large = clock.copy(1 << 20, true).median_ns;
        assert!(small > 0.0 && large > 0.0);
    }
}
