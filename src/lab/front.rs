//! The front of run time against error.

/// For each (time, error) whether nothing is at least as good in both and better in one. What is not a number is never on
/// the front.
pub fn on_front(costs: &[(f64, f64)]) -> Vec<bool> {
    let is_beaten = |(time, error): (f64, f64)| {
        costs
            .iter()
            .any(|&(t, e)| t <= time && e <= error && (t < time || e < error))
    };
    costs
        .iter()
        .map(|&cost| cost.0.is_finite() && cost.1.is_finite() && !is_beaten(cost))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_nothing_beats_is_on_the_front() {
        let costs = [
            (1.0, 1e-3),
            (2.0, 1e-4),
            (2.0, 1e-5),
            (3.0, 1e-5),
            (0.5, f64::NAN),
            (9.0, 0.0),
            (1.0, 1e-3),
        ];
        let front = [true, false, true, false, false, true, true];
        assert_eq!(on_front(&costs), front);
    }

    #[test]
    fn along_the_front_error_falls_as_time_grows() {
        let mut random = crate::math::inputs::Random::new(8);
        let costs: Vec<(f64, f64)> = (0..400).map(|_| (random.unit(), random.unit())).collect();
        let on = on_front(&costs);
        let mut front: Vec<(f64, f64)> = costs
            .iter()
            .zip(&on)
            .filter(|(_, on)| **on)
            .map(|(c, _)| *c)
            .collect();
        front.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert!(front.len() > 3 && front.windows(2).all(|w| w[1].1 < w[0].1));
        // Each of the others is beaten by one of the front.
        for (cost, _) in costs.iter().zip(&on).filter(|(_, on)| !**on) {
            assert!(front.iter().any(|f| f.0 <= cost.0 && f.1 <= cost.1));
        }
    }
}
