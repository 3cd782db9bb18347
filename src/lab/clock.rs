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
        let repeats = self.repeats(&mut work);
        Timing::of(
            (0..self.samples.max(1))
                .map(|_| run(repeats, &mut work))
                .collect(),
        )
    }

    /// Times `work` and, in turns with it, a plain copy of `bytes` bytes by one thread or by all: the work's times, and the
    /// median of its ratios to the copy that ran beside it. What else the machine does slows both.
    pub fn time_beside_copy(
        self,
        mut work: impl FnMut(),
        bytes: usize,
        on_all: bool,
    ) -> (Timing, f64) {
        let from = vec![1_u8; bytes];
        let mut to = vec![0_u8; bytes];
        let mut copy = || {
            if on_all {
                copy_on_all(&from, &mut to);
            } else {
                to.copy_from_slice(black_box(&from));
            }
            black_box(&mut to);
        };
        let repeats = [self.repeats(&mut work), self.repeats(&mut copy)];
        let mut samples = Vec::new();
        let mut ratios = Vec::new();
        for _ in 0..self.samples.max(1) {
            let ns = run(repeats[0], &mut work);
            ratios.push(ns / run(repeats[1], &mut copy));
            samples.push(ns);
        }
        ratios.sort_by(f64::total_cmp);
        (Timing::of(samples), at(&ratios, 0.5))
    }

    /// How often the work must be run until it can be timed.
    fn repeats(self, work: &mut impl FnMut()) -> u32 {
        let once = run(1, work).min(run(1, work)).max(20.0);
        (self.shortest.as_nanos() as f64 / once).ceil().max(1.0) as u32
    }
}

/// Nanoseconds that the work takes when it is run so often.
fn run(repeats: u32, work: &mut impl FnMut()) -> f64 {
    let start = Instant::now();
    for _ in 0..repeats {
        work();
    }
    start.elapsed().as_secs_f64() * 1e9 / f64::from(repeats)
}

/// The sorted value that so large a share lies below.
fn at(sorted: &[f64], share: f64) -> f64 {
    let last = sorted.len().saturating_sub(1);
    let place = (last as f64 * share).round() as usize;
    sorted.get(place).copied().unwrap_or(f64::NAN)
}

impl Timing {
    /// Of some samples.
    pub(super) fn of(mut samples: Vec<f64>) -> Self {
        samples.sort_by(f64::total_cmp);
        let median_ns = at(&samples, 0.5);
        Self {
            median_ns,
            spread: 0.5 * (at(&samples, 0.75) - at(&samples, 0.25)) / median_ns,
        }
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
        for on_all in [false, true] {
            let (timing, ratio) = clock.time_beside_copy(|| calls += black_box(1), 1 << 20, on_all);
            assert!(
                timing.median_ns > 0.0 && ratio > 0.0 && ratio < 1.0,
                "{ratio}"
            );
        }
    }
}
