//! An axis over the values of a criterion: equal steps are equal ratios, and what has no bound stands at its end.

use super::entry::Entry;
use crate::lab::ranking::Criterion;

/// Share of an axis that what is bounded has, where something is not.
const BOUNDED: f32 = 0.9;

/// An axis.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    /// What stands on it.
    pub criterion: Criterion,
    /// The smallest and the largest value that has a bound.
    pub ends: [f64; 2],
    /// Something has no bound.
    pub has_unbounded: bool,
}

impl Axis {
    /// Over all that is known; `None` where nothing bounded is.
    pub fn over(criterion: Criterion, entries: &[Entry<'_>]) -> Option<Self> {
        let values = entries.iter().filter_map(|entry| entry.value(criterion));
        let [mut low, mut high] = [f64::INFINITY, f64::NEG_INFINITY];
        let mut has_unbounded = false;
        for value in values {
            if criterion.is_bounded(value) {
                (low, high) = (low.min(value), high.max(value));
            } else {
                has_unbounded = true;
            }
        }
        (low <= high).then_some(Self {
            criterion,
            ends: [low, high],
            has_unbounded,
        })
    }

    /// Whether a value lies between the ends, or is one as far as a search can tell.
    pub fn contains(&self, value: f64) -> bool {
        self.criterion.is_within(value, self.ends)
    }

    /// Share of the axis, 0 to 1: from the best to the worst, and 1 where there is no bound. `margin` is left free at both ends.
    pub fn share(&self, value: f64, margin: f32) -> f32 {
        if !self.criterion.is_bounded(value) {
            return 1.0 - 0.5 * margin;
        }
        let [low, high] = self.ends.map(|end| self.criterion.place(end));
        let span = high - low;
        let share = if span > 1e-9 {
            (self.criterion.place(value) - low) / span
        } else {
            0.5
        };
        let room = if self.has_unbounded { BOUNDED } else { 1.0 } - 2.0 * margin;
        margin + share as f32 * room
    }

    /// Where the axis of what is bounded ends, where something is not.
    pub fn border(&self) -> Option<f32> {
        self.has_unbounded.then_some(BOUNDED)
    }

    /// Marked values with their text.
    pub fn marks(&self) -> Vec<(f64, String)> {
        let text = |mark: f64| {
            let text = format!("{mark:.3}");
            let text = text.trim_end_matches('0').trim_end_matches('.');
            (mark, format!("{text}{}", self.criterion.unit().trim()))
        };
        self.criterion
            .marks(self.ends)
            .into_iter()
            .map(text)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Progress;
    use crate::lab::metrics::measure;
    use crate::mapping::MappingId;

    #[test]
    fn an_axis_runs_from_the_best_to_the_worst_and_what_has_no_bound_stands_beyond() {
        let measured = [MappingId::Cube, MappingId::Paraboloid, MappingId::Latlong]
            .map(|map| measure(map, &Progress::new()).unwrap());
        let entries = measured.each_ref().map(|metrics| Entry {
            map: metrics.mapping,
            metrics: Some(metrics),
            cost: None,
            placed: None,
        });
        for criterion in [Criterion::Area, Criterion::ShapeMax, Criterion::OmegaMax] {
            let axis = Axis::over(criterion, &entries).unwrap();
            assert!(axis.has_unbounded, "the latlong's {criterion:?}");
            let share = |k: usize| axis.share(entries[k].value(criterion).unwrap(), 0.0);
            let mut bounded = [share(0), share(1)];
            bounded.sort_by(f32::total_cmp);
            assert_eq!(bounded, [0.0, BOUNDED]);
            assert_eq!(share(2), 1.0);
            assert!(axis.marks().len() > 2, "{:?}", axis.marks());
        }
        let two = Axis::over(Criterion::Area, &entries[..2]).unwrap();
        assert!(!two.has_unbounded && two.border().is_none(), "control");
        assert_eq!(two.share(two.ends[1], 0.0), 1.0);
        assert!(two.contains(4.5) && !two.contains(2.0) && !two.contains(6.0));
        // The cube's corner is the end of an axis to the last digit but one.
        for criterion in [Criterion::ShapeMax, Criterion::OmegaMax] {
            let axis = Axis::over(criterion, &entries[..2]).unwrap();
            let bound = criterion.corner_bound().unwrap();
            assert!(axis.contains(bound * (1.0 + 1e-15)) && !axis.contains(1.01 * bound));
            assert!((axis.share(bound, 0.0) - 1.0).abs() < 1e-6, "{criterion:?}");
        }
        assert!((two.share((two.ends[0] * two.ends[1]).sqrt(), 0.0) - 0.5).abs() < 1e-6);
        assert!(Axis::over(Criterion::Cost, &entries).is_none());
    }
}
