//! The largest and smallest distortion of a mapping, and whether there is one at all.

use std::f64::consts::TAU;

use super::local::{Local, Yardstick};
use crate::imaging::Progress;
use crate::mapping::{ChartPoint, Domain, MappingId};

/// Steps of the lattice from which a search begins.
const LATTICE: u32 = 32;
/// From how many points of the lattice.
const STARTS: usize = 3;
/// How much the logarithm may still grow from a margin of 2^-20 of a chart to one of 2^-30: a power of the distance as small as
/// 0.05/ln(2^10) = 0.007 is noticed, and a root that comes to its end grows by a thousandth.
const SETTLED: f64 = 0.05;
/// From 2^-30 of a chart to its border a smooth logarithm changes by less.
const NEAR: f64 = 1e-6;

/// What is sought: the logarithm of something positive.
pub type Value = fn(&Local) -> f64;

/// The largest value of each of `values` over a mapping; infinite where it grows without bound towards a border. `None` when cancelled, which is
/// looked at after a few points.
pub fn largest<const N: usize>(
    yardstick: &Yardstick,
    map: MappingId,
    values: [Value; N],
    progress: &Progress,
) -> Option<[f64; N]> {
    let within = |margin: f64| {
        let search = Search {
            yardstick,
            map,
            margin,
            progress,
        };
        search.largest(&values)
    };
    let [last_but_one, last] = [within(2f64.powi(-20))?, within(2f64.powi(-30))?];
    let at_border = within(0.0)?;
    Some(std::array::from_fn(|k| {
        if last[k] - last_but_one[k] > SETTLED {
            return f64::INFINITY;
        }
        // On the border itself a formula may divide by zero; where it does not, its number is the exact one.
        let is_limit = (at_border[k] - last[k]).abs() < NEAR;
        if is_limit { at_border[k] } else { last[k] }
    }))
}

/// A search that keeps a margin from the border of every chart.
struct Search<'a> {
    yardstick: &'a Yardstick,
    map: MappingId,
    margin: f64,
    progress: &'a Progress,
}

impl Search<'_> {
    /// The point of a chart at a place (s, t) of the unit square: the chart less its margin, or the disc in polar coordinates.
    fn local(&self, chart: u32, [s, t]: [f64; 2]) -> Option<Local> {
        let span = 1.0 - 2.0 * self.margin;
        let [u, v] = match self.map.info().domain {
            Domain::Square => [s, t].map(|c| self.margin + span * c),
            Domain::Disc => {
                let (sin, cos) = (TAU * s).sin_cos();
                let r = 0.5 * span * t;
                [0.5 + r * cos, 0.5 + r * sin]
            }
        };
        self.yardstick.at(ChartPoint::new(chart, u, v))
    }

    fn largest<const N: usize>(&self, values: &[Value; N]) -> Option<[f64; N]> {
        let place = |k: u32| f64::from(k) / f64::from(LATTICE);
        let mut seen = Vec::new();
        for chart in 0..self.map.info().chart_count() {
            for i in 0..=LATTICE {
                if self.progress.is_cancelled() {
                    return None;
                }
                let row = (0..=LATTICE).map(|j| [place(i), place(j)]);
                seen.extend(row.filter_map(|at| Some((chart, at, self.local(chart, at)?))));
            }
        }
        let mut found = [f64::NEG_INFINITY; N];
        for (found, value) in found.iter_mut().zip(values) {
            let mut starts: Vec<(f64, u32, [f64; 2])> = seen
                .iter()
                .map(|(chart, at, local)| (value(local), *chart, *at))
                .filter(|(value, ..)| !value.is_nan())
                .collect();
            starts.sort_by(|a, b| b.0.total_cmp(&a.0));
            starts.truncate(STARTS);
            for start in starts {
                *found = found.max(self.climb(*value, start)?);
            }
        }
        Some(found)
    }

    /// Uphill by steps in eight directions, halved where none leads up.
    fn climb(&self, value: Value, (mut best, chart, mut at): (f64, u32, [f64; 2])) -> Option<f64> {
        /// Steps as small as an ULP of the place.
        const LEAST: f64 = 1e-15;
        /// A mapping whose derivative is noise must not keep the search for ever.
        const MOST: usize = 2000;
        let mut step = 0.5 / f64::from(LATTICE);
        for _ in 0..MOST {
            if step < LEAST {
                break;
            }
            if self.progress.is_cancelled() {
                return None;
            }
            let around = [-1.0, 0.0, 1.0].into_iter();
            let around = around.flat_map(|x| [-1.0, 0.0, 1.0].map(|y| [x, y]));
            let tried = around.filter_map(|[x, y]| {
                let place = [at[0] + x * step, at[1] + y * step].map(|c| c.clamp(0.0, 1.0));
                Some((value(&self.local(chart, place)?), place))
            });
            let up = tried.filter(|(found, _)| *found > best);
            match up.max_by(|a, b| a.0.total_cmp(&b.0)) {
                Some((found, place)) => (best, at) = (found, place),
                None => step *= 0.5,
            }
        }
        Some(best)
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::rc::Rc;

    use super::*;

    thread_local! {
        /// Calls of `counted`, and at which one it cancels what.
        static CALLS: Cell<usize> = const { Cell::new(0) };
        static CANCEL: Cell<Option<(usize, Rc<Progress>)>> = const { Cell::new(None) };
    }

    fn counted(local: &Local) -> f64 {
        let calls = CALLS.get() + 1;
        CALLS.set(calls);
        let cancel = CANCEL.take().filter(|(at, progress)| {
            if calls == *at {
                progress.cancel();
            }
            calls < *at
        });
        CANCEL.set(cancel);
        local.area.ln()
    }

    /// Values that are computed, and the result.
    fn search(cancel_at: usize) -> (usize, Option<[f64; 1]>) {
        let map = MappingId::Fisheye;
        let progress = Rc::new(Progress::new());
        CALLS.set(0);
        CANCEL.set(Some((cancel_at, Rc::clone(&progress))));
        let found = largest(&Yardstick::new(map), map, [counted], &progress);
        (CALLS.get(), found)
    }

    #[test]
    fn a_cancelled_search_ends_within_a_step() {
        let (all, found) = search(usize::MAX);
        assert!(found.is_some());
        // The lattice's points are valued at once, the points around a climber's nine at a time.
        let points =
            (LATTICE as usize + 1).pow(2) * MappingId::Fisheye.info().chart_count() as usize;
        for at in [1, points + 1, points + 100, all / 2, all - 100] {
            let (calls, found) = search(at);
            assert_eq!(found, None, "{at}");
            assert!(calls <= at + points, "{at}: {calls}");
            if at > points && at < all / 3 {
                assert!(calls < at + 9, "{at}: {calls}");
            }
        }
        assert!(all > 4 * points, "control: {all} of {points}");
    }
}
