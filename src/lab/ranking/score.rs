//! Area and shape weighed against each other: one score, the order that it makes, and where that flips.

use serde::{Deserialize, Serialize};

use super::{Criterion, EQUAL, ranks};
use crate::lab::metrics::Metrics;
use crate::mapping::MappingId;

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

/// The mappings by their score at a weight of shape from 0 (area alone) to 1 (shape alone), the best first. Of those that are equal the one stands first that is
/// better with both weighed alike, then the one that comes first in `measured`.
pub fn order(measured: &[&Metrics], basis: Basis, weight: f64) -> Vec<Placed> {
    let scores = |weight: f64| -> Vec<f64> {
        let scores = measured.iter().map(|m| basis.score(m, weight));
        scores.collect()
    };
    let (own, alike) = (scores(weight), scores(0.5));
    let (ranks, ties) = (ranks(&own), ranks(&alike));
    let mut sorted: Vec<usize> = (0..measured.len()).collect();
    sorted.sort_by(|a, b| {
        let by_score = ranks[*a].total_cmp(&ranks[*b]);
        by_score.then(ties[*a].total_cmp(&ties[*b]))
    });
    let mut placed: Vec<Placed> = Vec::with_capacity(sorted.len());
    let mut last = None;
    for k in sorted {
        let before = placed.last().filter(|_| last == Some(ranks[k]));
        let place = before.map_or(placed.len() + 1, |before| before.place);
        last = Some(ranks[k]);
        placed.push(Placed {
            map: measured[k].mapping,
            score: own[k],
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
}
