//! Which mapping is best depends on the question: mappings in the order of one criterion, or of area and shape weighed against each other.
//!
//! Distortions are ratios: twice as large and half as large are equally far from even, and two in a row multiply. So they are compared, weighed and drawn
//! by their logarithms, in which ratios become distances and perfection is 0.

mod score;

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use super::front::on_front;
use super::metrics::{CORNER_BOUND, Metrics, omega_rad};
use super::scatter::log_marks;

pub use score::{Basis, Placed, bounded, bump, order, winners};

/// What mappings can be compared by. Of each, smaller is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Criterion {
    /// [`Metrics::area_ratio`].
    Area,
    /// [`Metrics::area_rms`].
    AreaRms,
    /// [`Metrics::anisotropy_mean`].
    ShapeMean,
    /// [`Metrics::anisotropy_max`].
    ShapeMax,
    /// [`Metrics::omega_mean_deg`].
    OmegaMean,
    /// [`Metrics::omega_max_deg`].
    OmegaMax,
    /// [`Metrics::worst_linear`].
    Linear,
    /// [`Metrics::texel_budget`].
    Budget,
    /// [`Metrics::edge_ratio`].
    Edges,
    /// [`Metrics::diagonal_ratio`].
    Diagonals,
    /// Time of a lookup in nanoseconds, as the laboratory has measured it.
    Cost,
}

impl Criterion {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Area,
        Self::AreaRms,
        Self::ShapeMean,
        Self::ShapeMax,
        Self::OmegaMean,
        Self::OmegaMax,
        Self::Linear,
        Self::Budget,
        Self::Edges,
        Self::Diagonals,
        Self::Cost,
    ];

    /// Its name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Area => "area max/min",
            Self::AreaRms => "area RMS",
            Self::ShapeMean => "a/b mean",
            Self::ShapeMax => "a/b max",
            Self::OmegaMean => "ω mean",
            Self::OmegaMax => "ω max",
            Self::Linear => "linear",
            Self::Budget => "budget",
            Self::Edges => "edges",
            Self::Diagonals => "diagonals",
            Self::Cost => "ns a lookup",
        }
    }

    /// What it means, with its unit, in a sentence.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Area => {
                "Solid angle of the largest texel over that of the smallest; 1 where all are equal."
            }
            Self::AreaRms => {
                "Root of the mean square of D_A − 1, where D_A is the mean solid angle over the texel's; 0 where all are equal."
            }
            Self::ShapeMean => {
                "Mean ratio of the axes of Tissot's indicatrix, the ellipse that a small circle becomes; 1 where circles stay circles."
            }
            Self::ShapeMax => {
                "Largest ratio of the axes of Tissot's indicatrix, the ellipse that a small circle becomes; 1 where circles stay circles."
            }
            Self::OmegaMean => {
                "Mean over the map of the largest error of an angle, in degrees; 0 where angles are kept."
            }
            Self::OmegaMax => {
                "The largest error of an angle anywhere, in degrees; 0 where angles are kept, 180 where there is no bound."
            }
            Self::Linear => {
                "Longest extent of any texel over the side of the ideal one, when as many equal squares cover the same solid angle."
            }
            Self::Budget => {
                "How many times as many texels as an ideal map the mapping needs so that its coarsest direction is as fine: the square of linear."
            }
            Self::Edges => {
                "Longest side of any texel over the shortest of any, as S2 compares cells."
            }
            Self::Diagonals => {
                "Longest diagonal of any texel over the shortest of any, as S2 compares cells."
            }
            Self::Cost => {
                "Nanoseconds from a direction to its texel by the fastest way within the laboratory's error budget, beside its error in texels."
            }
        }
    }

    /// Its value, infinite where there is no bound; `None` for a cost that was not measured.
    pub fn of(self, metrics: &Metrics, cost_ns: Option<f64>) -> Option<f64> {
        Some(match self {
            Self::Area => metrics.area_ratio,
            Self::AreaRms => metrics.area_rms,
            Self::ShapeMean => metrics.anisotropy_mean,
            Self::ShapeMax => metrics.anisotropy_max,
            Self::OmegaMean => metrics.omega_mean_deg,
            Self::OmegaMax => metrics.omega_max_deg,
            Self::Linear => metrics.worst_linear,
            Self::Budget => metrics.texel_budget,
            Self::Edges => metrics.edge_ratio,
            Self::Diagonals => metrics.diagonal_ratio,
            Self::Cost => return cost_ns,
        })
    }

    /// What no mapping that is smooth at a cube's corner is below there: [`CORNER_BOUND`], and the error of angles that belongs to it.
    pub fn corner_bound(self) -> Option<f64> {
        match self {
            Self::ShapeMax => Some(CORNER_BOUND),
            Self::OmegaMax => Some(omega_rad(CORNER_BOUND).to_degrees()),
            _ => None,
        }
    }

    /// The unit that is written behind a value.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::OmegaMean | Self::OmegaMax => "°",
            Self::Cost => " ns",
            _ => "",
        }
    }

    /// Place of a value on an axis where equal steps are equal ratios. What is 0 at best is turned into a ratio first: an RMS r into
    /// 1 + r, an error of angles into the a/b that makes it.
    pub fn place(self, value: f64) -> f64 {
        match self {
            Self::AreaRms => value.ln_1p(),
            // sin(omega/2) = (a - b)/(a + b), so ln(a/b) = 2 artanh(sin(omega/2)).
            Self::OmegaMean | Self::OmegaMax => {
                2.0 * (0.5 * value.clamp(0.0, 180.0).to_radians()).sin().atanh()
            }
            _ => value.ln(),
        }
    }

    /// The value at a place: the inverse of [`Self::place`].
    pub fn value(self, place: f64) -> f64 {
        match self {
            Self::AreaRms => place.exp_m1(),
            Self::OmegaMean | Self::OmegaMax => omega_rad(place.exp()).to_degrees(),
            _ => place.exp(),
        }
    }

    /// Whether a value has a bound; an error of angles has none at 180 degrees.
    pub fn is_bounded(self, value: f64) -> bool {
        self.place(value) < UNBOUNDED_PLACE
    }

    /// Of each value the rank among all of them, equal where their places are as good as equal; infinite without bound.
    pub fn ranks(self, values: &[f64]) -> Vec<f64> {
        let place = |value: &f64| {
            if self.is_bounded(*value) {
                self.place(*value)
            } else {
                f64::INFINITY
            }
        };
        ranks(&values.iter().map(place).collect::<Vec<_>>())
    }

    /// Whether a value lies between both ends, or is one as far as a search can tell.
    pub fn is_within(self, value: f64, ends: [f64; 2]) -> bool {
        let [low, high] = ends.map(|end| self.place(end));
        (low - EQUAL..=high + EQUAL).contains(&self.place(value))
    }

    /// Values from `low` to `high`, about six, at which an axis is marked: in even steps where they are within a decade, else as
    /// [`log_marks`] has it.
    pub fn marks(self, [low, high]: [f64; 2]) -> Vec<f64> {
        const WANTED: f64 = 6.0;
        /// Share of the largest at which marks begin beside 0.
        const BESIDE_ZERO: f64 = 0.01;
        if !(low.is_finite() && high > low) {
            return Vec::new();
        }
        if self.place(0.0) == 0.0 && self.is_within(0.0, [low, high]) {
            let beside = log_marks([BESIDE_ZERO * high, high]);
            return std::iter::once(0.0).chain(beside).collect();
        }
        if low > 0.0 && high > 10.0 * low {
            return log_marks([low, high]);
        }
        let rough = (high - low) / WANTED;
        let power = 10_f64.powf(rough.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|s| s * power);
        let step = steps.into_iter().find(|step| *step >= rough);
        let step = step.unwrap_or(10.0 * power);
        let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
        (first..=last).map(|k| k as f64 * step).collect()
    }
}

/// Smaller first or larger first; what is unbounded after every number either way, and what is not known last.
pub fn compare(a: Option<f64>, b: Option<f64>, descending: bool) -> Ordering {
    let class = |value: Option<f64>| match value {
        Some(value) if value.is_finite() => 0,
        Some(_) => 1,
        None => 2,
    };
    match (a, b) {
        (Some(x), Some(y)) if x.is_finite() && y.is_finite() => {
            let order = x.total_cmp(&y);
            if descending { order.reverse() } else { order }
        }
        _ => class(a).cmp(&class(b)),
    }
}

/// Logarithms as near as this are equal: the search for the extremes ends as near to them.
const EQUAL: f64 = 1e-6;

/// Of each logarithm the rank among all of them, from 0; those that lie within [`EQUAL`] of the next have the same. What is infinite stays so.
fn ranks(logs: &[f64]) -> Vec<f64> {
    let mut rising: Vec<usize> = (0..logs.len()).collect();
    rising.sort_by(|a, b| logs[*a].total_cmp(&logs[*b]));
    let mut ranks = vec![0.0; logs.len()];
    let mut rank = 0.0;
    let mut before = f64::NEG_INFINITY;
    for k in rising {
        if logs[k] - before > EQUAL && before.is_finite() {
            rank += 1.0;
        }
        before = logs[k];
        ranks[k] = if before.is_finite() { rank } else { before };
    }
    ranks
}

/// A ratio of e to this power is none any more: an angle off by 180 degrees less what f64 can tell apart has 37.
const UNBOUNDED_PLACE: f64 = 30.0;

/// Which mappings nothing beats in both criteria, by their values. What only the last digits of a search tell apart counts as equal, or noise
/// would decide among those that are equal-area. What has no bound in one of both is not on the front.
pub fn front(criteria: [Criterion; 2], values: &[[f64; 2]]) -> Vec<bool> {
    let [across, up] = [0, 1].map(|k: usize| {
        let values: Vec<f64> = values.iter().map(|at| at[k]).collect();
        criteria[k].ranks(&values)
    });
    on_front(&across.into_iter().zip(up).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Progress;
    use crate::lab::metrics::measure;
    use crate::mapping::MappingId;

    #[test]
    fn unbounded_comes_last_either_way_and_unknown_after_it() {
        let values = [Some(2.0), None, Some(f64::INFINITY), Some(1.0)];
        let sorted = |descending| {
            let mut sorted = values;
            sorted.sort_by(|a, b| compare(*a, *b, descending));
            sorted
        };
        let infinite = Some(f64::INFINITY);
        assert_eq!(sorted(false), [Some(1.0), Some(2.0), infinite, None]);
        assert_eq!(sorted(true), [Some(2.0), Some(1.0), infinite, None]);
    }

    #[test]
    fn places_are_ratios_and_come_back() {
        for criterion in Criterion::ALL {
            for value in [1.0, 1.7, 30.0, 100.0] {
                let place = criterion.place(value);
                let back = criterion.value(place);
                assert!((back / value - 1.0).abs() < 1e-12, "{criterion:?} {value}");
            }
        }
        // Angles off by 31.08 degrees are those at the cube's corner, sqrt 3: one bound at one place.
        let root = 3_f64.sqrt();
        let omega = Criterion::OmegaMax.corner_bound().unwrap();
        let sine = (root - 1.0) / (root + 1.0);
        assert!((omega - (2.0 * sine.asin()).to_degrees()).abs() < 1e-13);
        assert!((omega - 31.0845).abs() < 5e-5, "{omega}");
        let shape = Criterion::ShapeMax.corner_bound().unwrap();
        let places = [
            Criterion::OmegaMax.place(omega),
            Criterion::ShapeMax.place(shape),
        ];
        assert!(
            places
                .iter()
                .all(|place| (place - 0.5 * 3_f64.ln()).abs() < 1e-14)
        );
        assert_eq!(Criterion::OmegaMean.corner_bound(), None);
        assert_eq!(Criterion::OmegaMax.place(0.0), 0.0);
        assert_eq!(Criterion::AreaRms.place(0.0), 0.0);
        assert!(Criterion::OmegaMax.place(180.0) > 30.0, "no bound");
        assert_eq!(Criterion::Area.place(f64::INFINITY), f64::INFINITY);
    }

    #[test]
    fn axes_are_marked_at_round_numbers() {
        let marks = |low, high| Criterion::Area.marks([low, high]);
        assert_eq!(marks(1.0, 50.0), [1.0, 2.0, 5.0, 10.0, 20.0, 50.0]);
        let near = marks(1.19, 1.77);
        assert!(near.len() > 4 && near.len() < 9, "{near:?}");
        assert!(
            near.iter()
                .all(|m| (m * 20.0 - (m * 20.0).round()).abs() < 1e-9)
        );
        assert_eq!(marks(0.0, 5.0), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
        assert!(marks(1.0, 1.0).is_empty());
        // What is 0 at best is marked there once, however near to it a search has come.
        let omega = Criterion::OmegaMax.marks([1e-6, 60.0]);
        assert_eq!(omega, [0.0, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]);
        assert_eq!(Criterion::OmegaMax.marks([20.0, 40.0])[0], 20.0);
        assert!(marks(f64::INFINITY, f64::NEG_INFINITY).is_empty());
    }

    #[test]
    fn every_criterion_tells_its_own_number() {
        let metrics = measure(MappingId::Octahedral, &Progress::new()).unwrap();
        let values: Vec<f64> = Criterion::ALL
            .into_iter()
            .map(|criterion| criterion.of(&metrics, Some(7.5)).unwrap())
            .collect();
        for (k, value) in values.iter().enumerate() {
            assert!(!values[..k].contains(value), "{:?}", Criterion::ALL[k]);
        }
        assert_eq!(Criterion::Cost.of(&metrics, None), None);
    }

    #[test]
    fn what_only_a_search_tells_apart_does_not_decide_the_front() {
        let axes = [Criterion::Area, Criterion::ShapeMax];
        let noise = 2e-15;
        let infinite = f64::INFINITY;
        let values = [
            [1.0 + noise, 1.557],
            [1.0, 2.998],
            [4.0, 1.0 + 3e-8],
            [134.0, 1.0],
            [1.0, infinite],
            [1.3, 1.4],
        ];
        let front = front(axes, &values);
        assert_eq!(front, [true, false, true, false, false, true]);
        // Control: by the bare numbers noise puts the second and the fourth there.
        let bare = on_front(&values.map(|[x, y]| (x, y)));
        assert!(bare[1] && bare[3]);
        // What is told apart counts.
        assert!(super::front(axes, &[[1.0 + 1e-5, 1.5], [1.0, 3.0]])[1]);
        // 180 degrees are no bound, and in the order they come last both ways.
        let omega = Criterion::OmegaMax;
        assert!(!omega.is_bounded(180.0) && omega.is_bounded(179.0));
        assert_eq!(omega.ranks(&[180.0, 90.0]), [infinite, 0.0]);
        assert_eq!(
            super::front([Criterion::Area, omega], &[[1.0, 180.0]]),
            [false]
        );
    }

    #[test]
    fn what_lies_within_a_search_of_the_next_has_its_rank_wherever_it_lies() {
        let infinite = f64::INFINITY;
        // Across the half of a step, where rounding parts what is 1e-15 apart; the control is as far as can be told apart.
        for middle in [0.0, 0.5e-6, 1.5e-6, 0.7] {
            let logs = [middle + 1e-15, infinite, middle + 2e-6, middle - 1e-15];
            assert_eq!(ranks(&logs), [0.0, infinite, 1.0, 0.0], "{middle}");
        }
        assert_eq!(
            ranks(&[1.6e-6, 0.8e-6, 0.0]),
            [0.0; 3],
            "each within the next"
        );
        assert_eq!(ranks(&[]), [0.0; 0]);
        let shape = Criterion::ShapeMax;
        assert_eq!(shape.ranks(&[2.0, 1.0 + 1e-8, 1.0]), [1.0, 0.0, 0.0]);
        assert!(shape.is_within(2.0 + 1e-9, [1.0, 2.0]) && !shape.is_within(2.001, [1.0, 2.0]));
        assert!(!shape.is_within(infinite, [1.0, 2.0]));
    }
}
