//! Which mapping is best depends on the question: mappings in the order of one criterion, or of area and shape weighed against each other.
//!
//! Distortions are ratios: twice as large and half as large are equally far from even, and two in a row multiply. So they are compared, weighed and drawn
//! by their logarithms, in which ratios become distances and perfection is 0.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use super::metrics::{Metrics, omega_rad};
use crate::mapping::MappingId;

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

    /// Values from `low` to `high`, about six, at which an axis is marked: in even steps where they are within a decade, else 1, 2 and 5 times the powers of ten.
    pub fn marks(self, [low, high]: [f64; 2]) -> Vec<f64> {
        const WANTED: f64 = 6.0;
        if !(low.is_finite() && high > low) {
            return Vec::new();
        }
        if low > 0.0 && high > 10.0 * low {
            let powers = low.log10().floor() as i32..=high.log10().ceil() as i32;
            let all = powers.flat_map(|power| [1.0, 2.0, 5.0].map(|s| s * 10_f64.powi(power)));
            return all.filter(|mark| (low..=high).contains(mark)).collect();
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

/// What of area and shape is weighed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Basis {
    /// The extremes: area max/min and the largest a/b.
    #[default]
    Worst,
    /// What all texels come to: 1 + RMS of the area's error, and the mean a/b.
    Mean,
}

impl Basis {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Worst, Self::Mean];

    /// Its name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Worst => "the worst texels",
            Self::Mean => "all texels",
        }
    }

    /// The criteria of area and of shape.
    pub const fn criteria(self) -> [Criterion; 2] {
        match self {
            Self::Worst => [Criterion::Area, Criterion::ShapeMax],
            Self::Mean => [Criterion::AreaRms, Criterion::ShapeMean],
        }
    }

    /// Logarithms of the ratios of area and of shape: 0 where there is no distortion, infinite where there is no bound.
    fn logarithms(self, metrics: &Metrics) -> [f64; 2] {
        self.criteria().map(|criterion| {
            criterion
                .of(metrics, None)
                .map_or(f64::INFINITY, |value| criterion.place(value))
        })
    }

    /// (1 - w) ln(area) + w ln(shape): the logarithm of a weighed geometric mean of both ratios, so that it does not matter in which unit either
    /// is given. Infinite where what counts has no bound; what does not count at all, its weight being 0, does not even then.
    pub fn score(self, metrics: &Metrics, weight: f64) -> f64 {
        let [area, shape] = self.logarithms(metrics);
        let part = |share: f64, log: f64| if share > 0.0 { share * log } else { 0.0 };
        part(1.0 - weight, area) + part(weight, shape)
    }
}

/// A mapping in an order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The mapping.
    pub map: MappingId,
    /// Its score; see [`Basis::score`].
    pub score: f64,
    /// Its place, from 1; what is equally good has the same.
    pub place: usize,
}

/// Scores as near as this are equal: the search for the extremes ends as near to them.
const EQUAL: f64 = 1e-6;

/// A logarithm in steps of [`EQUAL`], which can be compared without regard to the last digits of a search.
fn steps(log: f64) -> f64 {
    (log / EQUAL).round()
}

/// The mappings by their score at a weight of shape from 0 (area alone) to 1 (shape alone), the best first. Of those that are equal the one stands first that is
/// better with both weighed alike, then the one that comes first in `measured`.
pub fn order(measured: &[&Metrics], basis: Basis, weight: f64) -> Vec<Placed> {
    let score = |metrics: &Metrics| basis.score(metrics, weight);
    let key = |metrics: &Metrics| [score(metrics), basis.score(metrics, 0.5)].map(steps);
    let mut sorted: Vec<&Metrics> = measured.to_vec();
    sorted.sort_by(|a, b| {
        let ([a, a_both], [b, b_both]) = (key(a), key(b));
        a.total_cmp(&b).then(a_both.total_cmp(&b_both))
    });
    let mut placed: Vec<Placed> = Vec::with_capacity(sorted.len());
    for metrics in sorted {
        let score = score(metrics);
        let before = placed.last().filter(|p| steps(p.score) == steps(score));
        let place = before.map_or(placed.len() + 1, |before| before.place);
        placed.push(Placed {
            map: metrics.mapping,
            score,
            place,
        });
    }
    placed
}

/// Those of which area and shape have a bound, so that no weight puts them last.
pub fn bounded<'a>(measured: &[&'a Metrics], basis: Basis) -> Vec<&'a Metrics> {
    let is_bounded = |metrics: &&&Metrics| basis.score(metrics, 0.5).is_finite();
    measured.iter().filter(is_bounded).copied().collect()
}

/// For each of `measured` its index in the order, from 0, at `count` weights evenly from 0 to 1.
pub fn bump(measured: &[&Metrics], basis: Basis, count: usize) -> Vec<(MappingId, Vec<usize>)> {
    let last = count.saturating_sub(1).max(1) as f64;
    let orders: Vec<Vec<Placed>> = (0..count)
        .map(|k| order(measured, basis, k as f64 / last))
        .collect();
    let place = |map: MappingId, order: &[Placed]| order.iter().position(|p| p.map == map);
    let line = |metrics: &&Metrics| {
        let map = metrics.mapping;
        (map, orders.iter().filter_map(|o| place(map, o)).collect())
    };
    measured.iter().map(line).collect()
}

/// Which mapping is best from which weight on, exactly: the lower envelope of the scores, which are straight lines over the weight.
pub fn winners(measured: &[&Metrics], basis: Basis) -> Vec<(f64, MappingId)> {
    let lines: Vec<(MappingId, [f64; 2])> = bounded(measured, basis)
        .into_iter()
        .map(|metrics| (metrics.mapping, basis.logarithms(metrics)))
        .collect();
    let first = order(&bounded(measured, basis), basis, 0.0);
    let mut winners: Vec<(f64, MappingId)> = Vec::new();
    let mut now = first.first().map(|placed| (0.0, placed.map));
    while let Some((from, map)) = now {
        winners.push((from, map));
        let Some((_, [area, shape])) = lines.iter().find(|line| line.0 == map) else {
            break;
        };
        // What falls more steeply crosses where (1 - w) (area' - area) = w (shape - shape').
        let crossing = |(other, [a, s]): &(MappingId, [f64; 2])| {
            let (behind, ahead) = (a - area, shape - s);
            let is_steeper = ahead + behind > EQUAL && ahead > EQUAL;
            is_steeper.then(|| ((behind / (behind + ahead)).max(from), *other, ahead))
        };
        let next = lines.iter().filter_map(crossing);
        let next = next.min_by(|a, b| a.0.total_cmp(&b.0).then(b.2.total_cmp(&a.2)));
        now = next.map(|(weight, other, _)| (weight, other));
    }
    winners
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Progress;
    use crate::lab::metrics::measure;

    fn metrics(map: MappingId, area_ratio: f64, anisotropy_max: f64) -> Metrics {
        let mut metrics = measure(MappingId::Paraboloid, &Progress::new()).unwrap();
        (metrics.mapping, metrics.area_ratio) = (map, area_ratio);
        metrics.anisotropy_max = anisotropy_max;
        metrics
    }

    /// Even in area, even in shape, a compromise, and one without bound in shape.
    fn four() -> Vec<Metrics> {
        vec![
            metrics(MappingId::Arvo, 1.0, 2.0),
            metrics(MappingId::Paraboloid, 4.0, 1.0),
            metrics(MappingId::Cobe, 1.2, 1.3),
            metrics(MappingId::Sphere, 1.0, f64::INFINITY),
        ]
    }

    fn ids(order: &[Placed]) -> Vec<MappingId> {
        order.iter().map(|placed| placed.map).collect()
    }

    #[test]
    fn the_order_flips_with_the_question() {
        use MappingId::{Arvo, Cobe, Paraboloid, Sphere};
        let four = four();
        let all: Vec<&Metrics> = four.iter().collect();
        let at = |weight| ids(&order(&all, Basis::Worst, weight));
        // Area alone does not ask for shape: two are equally good, and the one with the better shape stands first.
        assert_eq!(at(0.0), [Arvo, Sphere, Cobe, Paraboloid]);
        assert_eq!(at(1e-9), [Arvo, Cobe, Paraboloid, Sphere]);
        assert_eq!(at(0.5), [Cobe, Arvo, Paraboloid, Sphere]);
        assert_eq!(at(1.0), [Paraboloid, Cobe, Arvo, Sphere]);
        let places: Vec<usize> = order(&all, Basis::Worst, 0.0)
            .iter()
            .map(|p| p.place)
            .collect();
        assert_eq!(places, [1, 1, 3, 4]);
        let score = Basis::Worst.score(&four[2], 0.25);
        assert!((score - (0.75 * 1.2_f64.ln() + 0.25 * 1.3_f64.ln())).abs() < 1e-15);
        // Control: a plain mean of the ratios would put the paraboloid elsewhere.
        let plain = |m: &Metrics| 0.45 * m.area_ratio + 0.55 * m.anisotropy_max;
        let mean = |m: &Metrics| Basis::Worst.score(m, 0.55);
        assert!(mean(&four[0]) < mean(&four[1]) && plain(&four[0]) < plain(&four[1]));
        let double = metrics(Paraboloid, 8.0, 1.0);
        assert!((mean(&double) - mean(&four[1]) - 0.45 * 2_f64.ln()).abs() < 1e-14);
        assert!(plain(&double) > 1.5 * plain(&four[1]));
        // Means are other numbers: all four have the paraboloid's here.
        let placed = order(&all, Basis::Mean, 0.5);
        assert!(placed.iter().all(|p| p.place == 1));
    }

    #[test]
    fn who_wins_is_told_with_the_weight_from_which_on() {
        use MappingId::{Arvo, Cobe, Paraboloid};
        let four = four();
        let all: Vec<&Metrics> = four.iter().collect();
        let found = winners(&all, Basis::Worst);
        let maps: Vec<MappingId> = found.iter().map(|w| w.1).collect();
        assert_eq!(maps, [Arvo, Cobe, Paraboloid]);
        for pair in found.windows(2) {
            let (weight, before, after) = (pair[1].0, pair[0].1, pair[1].1);
            let at = |weight| ids(&order(&all, Basis::Worst, weight))[0];
            assert_eq!((at(weight - 1e-3), at(weight + 1e-3)), (before, after));
        }
        // Control: without the compromise there is one change, elsewhere.
        let without: Vec<&Metrics> = all.iter().copied().filter(|m| m.mapping != Cobe).collect();
        let found = winners(&without, Basis::Worst);
        assert_eq!(
            found.iter().map(|w| w.1).collect::<Vec<_>>(),
            [Arvo, Paraboloid]
        );
        assert!((found[1].0 - 2.0 / 3.0).abs() < 1e-12, "4^(1 - w) = 2^w");
        assert_eq!(winners(&[], Basis::Worst), []);
        assert_eq!(winners(&[&four[3]], Basis::Worst), []);
    }

    #[test]
    fn a_bump_chart_holds_each_place_once_at_every_weight() {
        let four = four();
        let all: Vec<&Metrics> = four.iter().collect();
        let lines = bump(&all, Basis::Worst, 21);
        for k in 0..21 {
            let mut places: Vec<usize> = lines.iter().map(|line| line.1[k]).collect();
            places.sort_unstable();
            assert_eq!(places, [0, 1, 2, 3]);
        }
        let paraboloid = &lines[1].1;
        assert!(paraboloid.is_sorted_by(|a, b| a >= b) && paraboloid[0] == 3);
        assert_eq!(paraboloid[20], 0);
        assert!(!lines[0].1.is_sorted_by(|a, b| a >= b), "control");
        assert_eq!(bounded(&all, Basis::Worst).len(), 3);
        assert_eq!(bump(&all, Basis::Worst, 1)[0].1.len(), 1);
    }

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
        // A right angle off by 31.08 degrees is the cube's corner, sqrt 3.
        let omega = omega_rad(3_f64.sqrt()).to_degrees();
        assert!((Criterion::OmegaMax.place(omega) - 0.5 * 3_f64.ln()).abs() < 1e-14);
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
}
