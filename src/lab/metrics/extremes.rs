//! The largest and smallest distortion of a mapping, and whether there is one at all.

use std::f64::consts::TAU;

use super::local::{Local, Yardstick};
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

/// The largest value of each of `values` over a mapping; infinite where it grows without bound towards a border.
pub fn largest<const N: usize>(
    yardstick: &Yardstick,
    map: MappingId,
    values: [Value; N],
) -> [f64; N] {
    let within = |margin: f64| {
        let search = Search {
            yardstick,
            map,
            margin,
        };
        search.largest(&values)
    };
    let [last_but_one, last] = [20, 30].map(|digits| within(2f64.powi(-digits)));
    let at_border = within(0.0);
    std::array::from_fn(|k| {
        if last[k] - last_but_one[k] > SETTLED {
            return f64::INFINITY;
        }
        // On the border itself a formula may divide by zero; where it does not, its number is the exact one.
        let is_limit = (at_border[k] - last[k]).abs() < NEAR;
        if is_limit { at_border[k] } else { last[k] }
    })
}

/// A search that keeps a margin from the border of every chart.
struct Search<'a> {
    yardstick: &'a Yardstick,
    map: MappingId,
    margin: f64,
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

    fn largest<const N: usize>(&self, values: &[Value; N]) -> [f64; N] {
        let place = |k: u32| f64::from(k) / f64::from(LATTICE);
        let mut seen = Vec::new();
        for chart in 0..self.map.info().chart_count() {
            for (i, j) in (0..=LATTICE).flat_map(|i| (0..=LATTICE).map(move |j| (i, j))) {
                let at = [place(i), place(j)];
                if let Some(local) = self.local(chart, at) {
                    seen.push((chart, at, local));
                }
            }
        }
        values.map(|value| {
            let mut starts: Vec<(f64, u32, [f64; 2])> = seen
                .iter()
                .map(|(chart, at, local)| (value(local), *chart, *at))
                .filter(|(value, ..)| !value.is_nan())
                .collect();
            starts.sort_by(|a, b| b.0.total_cmp(&a.0));
            starts.truncate(STARTS);
            let climbed = starts.into_iter().map(|start| self.climb(value, start));
            climbed.fold(f64::NEG_INFINITY, f64::max)
        })
    }

    /// Uphill by steps in eight directions, halved where none leads up.
    fn climb(&self, value: Value, (mut best, chart, mut at): (f64, u32, [f64; 2])) -> f64 {
        /// Steps as small as an ULP of the place.
        const LEAST: f64 = 1e-15;
        /// A mapping whose derivative is noise must not keep the search for ever.
        const MOST: usize = 2000;
        let mut step = 0.5 / f64::from(LATTICE);
        for _ in 0..MOST {
            if step < LEAST {
                break;
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
        best
    }
}
