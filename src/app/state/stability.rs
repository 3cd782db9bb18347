//! What the stability pane shows.

use serde::{Deserialize, Serialize};

use crate::lab::stress::Measure;
use crate::lab::stress::microscope::{Lengths, SPAN_DEG, View};
use crate::lab::stress::places::{PLACES, Place};
use crate::mapping::MappingId;
use crate::mapping::evaluator::{EvaluatorInfo, SINGLE};
use crate::math::Vec3;

/// What the stability pane shows of the selected mapping.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct StabilityState {
    /// The pane is shown.
    pub open: bool,
    /// The measure that the table's cells tell.
    pub measure: Measure,
    /// The evaluator under the microscope; where the selected mapping has none of this name, the usual one.
    pub evaluator: String,
    /// The direction in the microscope's middle, of unit length.
    pub center: [f64; 3],
    /// The angle across the smaller side of its picture in degrees, in [`SPAN_DEG`].
    pub span_deg: f64,
    /// How long the vectors are that the evaluator gets.
    pub lengths: Lengths,
}

impl Default for StabilityState {
    /// The first of the literature's faults.
    fn default() -> Self {
        let first = PLACES[0];
        Self {
            open: false,
            measure: Measure::default(),
            evaluator: first.evaluator.to_owned(),
            center: first.center,
            span_deg: first.span_deg,
            lengths: first.lengths,
        }
        .sanitized()
    }
}

/// Lengths of vectors that are offered: far enough from both ends of f32 that every direction near the middle has such a vector.
pub const LENGTHS: (f64, f64) = (1e-44, 3e38);

/// A direction at length 1, as it is where it has that; `None` for what is no direction.
fn unit(dir: [f64; 3]) -> Option<[f64; 3]> {
    let scaled = Vec3::<f64>::from_f64(dir).scaled_direction()?;
    let is_unit = (scaled.dot(scaled) - 1.0).abs() < 1e-14;
    Some(if is_unit {
        dir
    } else {
        scaled.normalized().to_f64()
    })
}

impl StabilityState {
    /// The nearest that makes sense.
    #[must_use]
    pub fn sanitized(mut self) -> Self {
        let [low, high] = SPAN_DEG;
        let is_number = self.span_deg.is_finite();
        self.span_deg = if is_number { self.span_deg } else { high }.clamp(low, high);
        self.center = unit(self.center)
            .or(unit(PLACES[0].center))
            .unwrap_or([0.0, 0.0, 1.0]);
        if let Lengths::Sphere(length) = &mut self.lengths {
            let (least, most) = LENGTHS;
            *length = if length.is_finite() { *length } else { 1.0 }.clamp(least, most);
        }
        self
    }

    /// The evaluator of a mapping that is looked at.
    pub fn evaluator_of(&self, mapping: MappingId) -> Option<&'static EvaluatorInfo> {
        let named = mapping.evaluator(&self.evaluator);
        named.or_else(|| mapping.evaluator(SINGLE))
    }

    /// What the microscope shows on so many pixels.
    pub fn view(&self, mapping: MappingId, size: [usize; 2]) -> View {
        let view = View {
            map: mapping,
            evaluator: self.evaluator_of(mapping).map_or(SINGLE, |e| e.id),
            center: self.center,
            span_deg: self.span_deg,
            lengths: self.lengths,
            size,
            is_scattered: false,
        };
        /// Two steps of f32 below 1.
        const FINE: f64 = f32::EPSILON as f64;
        View {
            is_scattered: view.pitch() > FINE,
            ..view
        }
    }

    /// Looking at a fault of the literature.
    #[must_use]
    pub fn at(self, place: &Place) -> Self {
        Self {
            evaluator: place.evaluator.to_owned(),
            center: place.center,
            span_deg: place.span_deg,
            lengths: place.lengths,
            ..self
        }
        .sanitized()
    }
}
