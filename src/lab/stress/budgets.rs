//! What each evaluator may err by, and what is known to be broken. Tests and the command hold evaluators to this table.

use super::Measures;
use super::families::Family;
use crate::mapping::MappingId;

/// Largest errors of an evaluator in radians, whatever the mapping: forward, and there and back. Beside them what was
/// observed over all mappings.
const BUDGETS: &[(&str, f64, f64)] = &[("f32", 1e-6, 1.5e-6)];

/// Where f32 cannot resolve directions, however they are computed.
const WEAK_RAD: f64 = 1.5e-3;

/// Something that an evaluator is known to do wrong.
#[derive(Debug)]
pub struct Expectation {
    /// Ids of the mapping and of the evaluator.
    pub of: (&'static str, &'static str),
    /// Name of the measure that is over what is allowed.
    pub measure: &'static str,
    /// The families in which it must be seen; in the others it may be.
    pub families: &'static [Family],
    /// The finding.
    pub why: &'static str,
}

/// Every known fault: of the literature's forms only.
const EXPECTATIONS: &[Expectation] = &[];

/// What is allowed to an evaluator.
pub fn allowed(map: MappingId, evaluator: &str) -> Measures {
    let found = BUDGETS.iter().find(|(id, ..)| *id == evaluator);
    let (forward, round_trip) = found.map_or((0.0, 0.0), |(_, f, r)| (*f, *r));
    let floor = if map.info().weak_spots.is_empty() {
        0.0
    } else {
        WEAK_RAD
    };
    // A chart's side is about a quarter turn or more; both sides of a seam err.
    Measures {
        max_forward_rad: forward.max(floor),
        max_round_trip_rad: round_trip.max(floor),
        max_seam_jump_texels: 1024.0 * (2.4e-7 + forward),
        max_fall_ulp: 2.0,
        ..Measures::default()
    }
}

/// What is known to be wrong with an evaluator.
pub fn expectations(map: MappingId, evaluator: &str) -> impl Iterator<Item = &'static Expectation> {
    EXPECTATIONS
        .iter()
        .filter(move |e| e.of == (map.info().id, evaluator))
}
