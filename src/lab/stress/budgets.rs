//! What each evaluator may err by, and what is known to be broken. Tests and the command hold evaluators to this table.

use super::families::Family;
use super::{Measure, Measures};
use crate::mapping::{MappingId, ShaderForm};

/// Largest errors of an evaluator in radians, whatever the mapping: forward, and there and back. Beside them what was
/// observed over all mappings.
const BUDGETS: &[(&str, f64, f64)] = &[
    // Observed: 6.9e-7 and 8.1e-7, by the angular map.
    ("f32", 1e-6, 1.2e-6),
    ("library", 1e-6, 1.2e-6),
    // 4.8e-7 and 4.7e-7, by the middle of the stereographic disc: the rounding of u and v alone, of which half a last digit is worth
    // 12 rad over the disc's width there, sqrt 2 * 12 * 2^-25 = 5.06e-7 with both.
    ("reference", 5.1e-7, 5.6e-7),
    // 3.9e-7, by the octahedral square.
    ("lanes", 6e-7, 6e-7),
    // Forward by the equi-angular cube or the continuous one, 9.4e-4 to 6.2e-7.
    ("atan-5", 1.4e-3, 2.2e-3),
    ("atan-7", 2.2e-4, 6e-4),
    ("atan-9", 2.7e-5, 5e-5),
    ("atan-11", 4.2e-6, 6e-6),
    ("atan-13", 1.3e-6, 2.5e-6),
    ("atan-15", 9e-7, 1.1e-6),
    ("atan-17", 9e-7, 1.1e-6),
    // 2.5e-5 and, by the sine and cosine of few terms, 7.0e-4.
    ("hastings-9", 3.7e-5, 1e-3),
    ("hastings-17", 9e-7, 1.1e-6),
    // 8.1e-3, 6.5e-3, 2.6e-3, 2.6e-3 and 1.4e-5, all by the continuous cube map.
    ("rational", 1.2e-2, 1.2e-2),
    ("rajan-2", 9.5e-3, 9.5e-3),
    ("rajan-3", 4e-3, 4e-3),
    ("lagarde", 4e-3, 4e-3),
    ("pbrt", 2e-5, 2e-5),
    // 3.1e-5 and 2.0e-6; the others are as near as f32.
    ("table-64", 4.5e-5, 4.5e-5),
    ("table-256", 3e-6, 3e-6),
    ("table-1024", 9e-7, 1.1e-6),
    ("table-4096", 9e-7, 1.1e-6),
    ("table-64-cubic", 9e-7, 1.1e-6),
    ("table-256-cubic", 9e-7, 1.1e-6),
    ("table-1024-cubic", 9e-7, 1.1e-6),
    ("table-4096-cubic", 9e-7, 1.1e-6),
    // Shaders, on Mesa's software Vulkan: 6.9e-7 and 7.2e-7 by the angular map, as f32.
    ("wgsl", 1e-6, 1.2e-6),
    // 3.8e-6 and 3.6e-6, 1.7e-4 and 3.9e-4 by the continuous cube map and, back, by the latlong.
    ("wgsl-own-11", 6e-6, 6e-6),
    ("wgsl-own-7", 2.6e-4, 6e-4),
    // 2.0e-6 and 2.0e-6.
    ("wgsl-table-256", 3e-6, 3e-6),
    // What the language promises, not what is seen, since another adapter may use all of it: 4096 ULP are 4.9e-4 of an angle, 1.5e-3 rad
    // of a longitude beside 7.7e-4 rad of a colatitude; sine and cosine 2^-11. Mesa's software Vulkan: 5.4e-6 and 4.5e-6;
    // its software GL: 2.8e-4 and 2.8e-4.
    (BUILT_IN, 1.8e-3, 2.8e-3),
    // 3.0e-7 and 3.8e-7: the bent direction is kept inside of its face.
    ("cube-unit", 5e-7, 6e-7),
    // The literature's, of which more is expected below.
    ("textbook", 1e-6, 1.2e-6),
    ("fast-acos", 1e-4, 1e-4),
    ("short-m", 1e-6, 1.2e-6),
    ("paper-shader", 1e-6, 1.2e-6),
    ("fused-shader", 1e-6, 1.2e-6),
    ("printed-eq6", 1e-6, 1.2e-6),
    // 1.3e-3: a polynomial that is not the inverse.
    ("published-fit", 1.9e-3, 1.9e-3),
];

/// The form whose budget is the language's promise.
pub const BUILT_IN: &str = ShaderForm::BuiltIn.id();

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

const ACOS: &str = "the arccosine of a coordinate that rounds to 1 is 0: 2.4e-4 rad and more are lost around the poles";
const ROOT: &str = "1 - |y| has no digits left around the poles";
const POLE: &str = "0/0 at the centre and at the rim, and around them nearly so";
const RIM: &str = "m is 0 at the rim's direction";
const SHORT: &str = "1 - z has no digits left around the rim's direction";
const OVER: &str = "T is up to 1.2e-7 over 1 on edges";
const CEIL: &str =
    "bool(ceil(-1)) is true: black discs of 0.0315 degrees around the middles of six edges";
const DOTS: &str = "rounded dot products cannot tell faces apart within an ULP of an edge";
const FUSED: &str = "three roundings order x, y and z in a circle, and no row of the table matches";
const EQ6: &str = "Eq. 6 as printed does not reach 1 on the edge: up to 0.224 of a face";

/// Every known fault: of the literature's forms only.
const EXPECTATIONS: &[Expectation] = &[
    Expectation {
        of: ("latlong", "textbook"),
        measure: "max_forward_rad",
        families: &[Family::Borders],
        why: ACOS,
    },
    Expectation {
        of: ("latlong", "textbook"),
        measure: "max_round_trip_rad",
        families: &[Family::Borders],
        why: ACOS,
    },
    Expectation {
        of: ("latlong", "fast-acos"),
        measure: "max_forward_rad",
        families: &[Family::Borders],
        why: ACOS,
    },
    Expectation {
        of: ("latlong", "fast-acos"),
        measure: "max_round_trip_rad",
        families: &[Family::Borders],
        why: ACOS,
    },
    Expectation {
        of: ("octahedral-equal-area", "textbook"),
        measure: "max_forward_rad",
        families: &[Family::Borders],
        why: ROOT,
    },
    Expectation {
        of: ("octahedral-equal-area", "textbook"),
        measure: "max_round_trip_rad",
        families: &[Family::Borders],
        why: ROOT,
    },
    Expectation {
        of: ("angular", "textbook"),
        measure: "max_forward_rad",
        families: &[Family::Borders],
        why: ACOS,
    },
    Expectation {
        of: ("angular", "textbook"),
        measure: "max_round_trip_rad",
        families: &[Family::Borders],
        why: ACOS,
    },
    Expectation {
        of: ("angular", "textbook"),
        measure: "not_finite",
        families: &[Family::Borders, Family::Ties, Family::NegativeZeros],
        why: POLE,
    },
    Expectation {
        of: ("angular", "textbook"),
        measure: "out_of_range",
        families: &[],
        why: POLE,
    },
    Expectation {
        of: ("angular", "fast-acos"),
        measure: "max_forward_rad",
        families: &[Family::Borders],
        why: ACOS,
    },
    Expectation {
        of: ("angular", "fast-acos"),
        measure: "max_round_trip_rad",
        families: &[Family::Borders],
        why: ACOS,
    },
    Expectation {
        of: ("angular", "fast-acos"),
        measure: "not_finite",
        families: &[Family::Borders, Family::Ties, Family::NegativeZeros],
        why: POLE,
    },
    Expectation {
        of: ("angular", "fast-acos"),
        measure: "out_of_range",
        families: &[],
        why: POLE,
    },
    Expectation {
        of: ("sphere", "textbook"),
        measure: "not_finite",
        families: &[Family::Borders, Family::Ties, Family::NegativeZeros],
        why: RIM,
    },
    Expectation {
        of: ("sphere", "textbook"),
        measure: "out_of_range",
        families: &[],
        why: RIM,
    },
    Expectation {
        of: ("sphere", "textbook"),
        measure: "max_forward_rad",
        families: &[],
        why: RIM,
    },
    Expectation {
        of: ("sphere", "textbook"),
        measure: "max_round_trip_rad",
        families: &[],
        why: RIM,
    },
    Expectation {
        of: ("sphere", "short-m"),
        measure: "not_finite",
        families: &[Family::Borders, Family::Ties, Family::NegativeZeros],
        why: SHORT,
    },
    Expectation {
        of: ("sphere", "short-m"),
        measure: "out_of_range",
        families: &[],
        why: SHORT,
    },
    Expectation {
        of: ("sphere", "short-m"),
        measure: "max_forward_rad",
        families: &[Family::Uniform, Family::Borders],
        why: SHORT,
    },
    Expectation {
        of: ("sphere", "short-m"),
        measure: "max_round_trip_rad",
        families: &[Family::Uniform, Family::Borders],
        why: SHORT,
    },
    Expectation {
        of: ("ccm", "textbook"),
        measure: "out_of_range",
        families: &[Family::Walks],
        why: OVER,
    },
    Expectation {
        of: ("ccm", "paper-shader"),
        measure: "holes",
        families: &[Family::Borders, Family::EdgeMiddles],
        why: CEIL,
    },
    Expectation {
        of: ("ccm", "paper-shader"),
        measure: "wrong_chart",
        families: &[Family::Walks],
        why: DOTS,
    },
    Expectation {
        of: ("ccm", "paper-shader"),
        measure: "out_of_range",
        families: &[Family::Walks],
        why: OVER,
    },
    Expectation {
        of: ("ccm", "fused-shader"),
        measure: "holes",
        families: &[Family::Ties, Family::Walks],
        why: FUSED,
    },
    Expectation {
        of: ("ccm", "fused-shader"),
        measure: "wrong_chart",
        families: &[Family::Walks],
        why: DOTS,
    },
    Expectation {
        of: ("ccm", "fused-shader"),
        measure: "out_of_range",
        families: &[Family::Walks],
        why: OVER,
    },
    Expectation {
        of: ("ccm", "printed-eq6"),
        measure: "max_forward_rad",
        families: &[Family::Uniform, Family::Borders, Family::EdgeMiddles],
        why: EQ6,
    },
    Expectation {
        of: ("ccm", "printed-eq6"),
        measure: "max_round_trip_rad",
        families: &[Family::Uniform, Family::Borders, Family::EdgeMiddles],
        why: EQ6,
    },
    Expectation {
        of: ("ccm", "printed-eq6"),
        measure: "max_seam_jump_texels",
        families: &[Family::Walks],
        why: EQ6,
    },
];

/// What is allowed to an evaluator.
pub fn allowed(map: MappingId, evaluator: &str) -> Measures {
    let found = BUDGETS.iter().find(|(id, ..)| *id == evaluator);
    let (forward, round_trip) = found.map_or((0.0, 0.0), |(_, f, r)| (*f, *r));
    let floor = if map.info().weak_spots.is_empty() {
        0.0
    } else {
        WEAK_RAD
    };
    // As near as f32 both sides of a seam differ by roundings; an approximation errs on both, mostly the same way. Of seams that are
    // divided in two ways nothing is promised.
    let seam = match forward {
        _ if !map.info().claims.continuous => 1.0,
        _ if forward > 1e-6 => 0.7 * forward,
        _ => 2.4e-7,
    };
    Measures {
        max_forward_rad: forward.max(floor),
        max_round_trip_rad: round_trip.max(floor),
        max_seam_jump_texels: 1024.0 * seam,
        // Two roundings.
        max_fall_ulp: 2.0,
        ..Measures::default()
    }
}

/// What is known to be wrong with an evaluator in a measure; by ids of the mapping and of the evaluator.
pub fn known(mapping: &str, evaluator: &str, measure: Measure) -> Option<&'static Expectation> {
    EXPECTATIONS
        .iter()
        .find(|e| e.of == (mapping, evaluator) && e.measure == measure.id())
}

/// What is known to be wrong with an evaluator.
pub fn expectations(map: MappingId, evaluator: &str) -> impl Iterator<Item = &'static Expectation> {
    EXPECTATIONS
        .iter()
        .filter(move |e| e.of == (map.info().id, evaluator))
}
