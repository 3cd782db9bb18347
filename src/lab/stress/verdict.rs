//! What is to be said of one chart point that an evaluator found, against exact arithmetic.

use crate::lab::accuracy::direction_of;
use crate::mapping::{Borders, ChartPoint, MappingId, NOWHERE};
use crate::math::{Vec3, angle_rad};

/// What exact arithmetic says of a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Exact {
    /// Its chart.
    chart: u32,
    /// Whether charts meet there exactly, so that each of them is right.
    is_tie: bool,
}

impl Exact {
    /// `None` for what is no direction. Comparisons are exact, and f64 holds every f32 and what scaling makes of it.
    pub fn of(map: MappingId, dir: [f64; 3]) -> Option<Self> {
        let point = map.forward(Vec3::<f64>::from_f64(dir))?;
        Some(Self {
            chart: point.chart,
            is_tie: is_tie(map, dir, point),
        })
    }
}

/// Whether charts meet at a direction exactly.
///
/// On a border that is no plane it is the evaluator's error that chooses, which is measured by itself: there all that is near counts.
fn is_tie(map: MappingId, dir: [f64; 3], point: ChartPoint<f64>) -> bool {
    /// As a part of a chart's side.
    const NEAR: f64 = 1e-3;
    let [x, y, z] = dir.map(f64::abs);
    match map.info().borders {
        Borders::CubeEdges => {
            let largest = x.max(y).max(z);
            [x, y, z].iter().filter(|c| **c == largest).count() > 1
        }
        Borders::TwoRims => z == 0.0,
        Borders::BasePixelEdges => {
            let to_side = |c: f64| c.min(1.0 - c);
            x == 0.0 || z == 0.0 || to_side(point.u).min(to_side(point.v)) < NEAR
        }
        _ => false,
    }
}

/// A direction at a size at which squares neither overflow nor vanish.
pub(super) fn at_usual_size(dir: [f64; 3]) -> [f64; 3] {
    let scaled = Vec3::<f64>::from_f64(dir).scaled_direction();
    scaled.map_or(dir, Vec3::to_f64)
}

/// What was found at one direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// A direction has no chart.
    pub is_hole: bool,
    /// The chart is another one than in exact arithmetic, a tie left out; or what is no direction has a chart.
    pub is_wrong_chart: bool,
    /// A coordinate is a number outside of [0, 1].
    pub is_out_of_range: bool,
    /// A coordinate is no finite number.
    pub is_not_finite: bool,
    /// The angle between the direction and that of the chart point, in radians; `None` where there is no such point, or the
    /// mapping does not cover the direction.
    pub forward_rad: Option<f64>,
}

impl Found {
    /// Judges the point that was found for a direction of any length.
    pub fn of(map: MappingId, dir: [f64; 3], exact: Option<Exact>, point: ChartPoint<f32>) -> Self {
        let is_nowhere = point.chart == NOWHERE;
        let coordinates = [point.u, point.v];
        let Some(exact) = exact else {
            return Self {
                is_wrong_chart: !is_nowhere,
                ..Self::default()
            };
        };
        if is_nowhere || !coordinates.iter().all(|c| c.is_finite()) {
            return Self {
                is_hole: is_nowhere,
                is_not_finite: !is_nowhere,
                ..Self::default()
            };
        }
        let is_covered = map.info().coverage.contains(dir);
        let meant = direction_of(map, point.to_f64()).filter(|_| is_covered);
        Self {
            is_wrong_chart: point.chart != exact.chart && !exact.is_tie,
            is_out_of_range: !coordinates.iter().all(|c| (0.0..=1.0).contains(c)),
            forward_rad: meant.map(|meant| angle_rad(meant, at_usual_size(dir))),
            ..Self::default()
        }
    }
}
