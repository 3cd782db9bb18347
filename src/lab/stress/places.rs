//! Where the literature's faults are to be seen.

use super::microscope::{Lengths, Verdict, View};
use crate::mapping::MappingId;

/// A fault, and how to look at it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// What is seen there.
    pub title: &'static str,
    /// Why.
    pub why: &'static str,
    /// The mapping.
    pub map: MappingId,
    /// The evaluator with the fault.
    pub evaluator: &'static str,
    /// The direction in the middle.
    pub center: [f64; 3],
    /// Angle across the picture's smaller side in degrees.
    pub span_deg: f64,
    /// Length of the vectors.
    pub lengths: Lengths,
    /// The verdict of the pixels that are wrong.
    pub verdict: Verdict,
}

impl Place {
    /// A picture of it.
    pub fn view(&self, size: [usize; 2]) -> View {
        View {
            map: self.map,
            evaluator: self.evaluator,
            center: self.center,
            span_deg: self.span_deg,
            lengths: self.lengths,
            size,
            is_scattered: false,
        }
    }
}

/// A black disc of the paper's shader.
const fn disc(title: &'static str, center: [f64; 3]) -> Place {
    Place {
        title,
        why: "bool(ceil(d)) is true for d = -1: where a product rounds to -1 no row of the table matches, and the shader \
              paints black",
        map: MappingId::Ccm,
        evaluator: "paper-shader",
        center,
        span_deg: 0.1,
        lengths: Lengths::Plane,
        verdict: Verdict::Hole,
    }
}

/// All of them.
pub const PLACES: [Place; 13] = [
    disc("Black disc between -x and -y", [-1.0, -1.0, 0.0]),
    disc("Black disc between +x and -y", [1.0, -1.0, 0.0]),
    disc("Black disc between -y and -z", [0.0, -1.0, -1.0]),
    disc("Black disc between -y and +z", [0.0, -1.0, 1.0]),
    disc("Black disc between -x and -z", [-1.0, 0.0, -1.0]),
    disc("Black disc between +x and -z", [1.0, 0.0, -1.0]),
    Place {
        title: "Corner hole of fused multiply-adds",
        why: "three products, each fused into its sum, order x, y and z in a circle; the hole is one direction of f32",
        map: MappingId::Ccm,
        evaluator: "fused-shader",
        center: [-1.0, -1.0, 1.0],
        span_deg: 2e-5,
        lengths: Lengths::Sphere(1.0),
        verdict: Verdict::Hole,
    },
    Place {
        title: "Eq. 6 as printed, over three faces",
        why: "the root stands over Rz instead of in the denominator's arcsine: v does not reach 1 on the edge",
        map: MappingId::Ccm,
        evaluator: "printed-eq6",
        center: [1.0, 1.0, 1.0],
        span_deg: 90.0,
        lengths: Lengths::Plane,
        verdict: Verdict::TooFar,
    },
    Place {
        title: "Pole of the arccosine's latitude",
        why: "y rounds to 1 within 2.4e-4 rad of the pole and a little beyond, and acos(1) is 0",
        map: MappingId::Latlong,
        evaluator: "textbook",
        center: [0.0, 1.0, 0.0],
        span_deg: 0.1,
        lengths: Lengths::Sphere(1.0),
        verdict: Verdict::TooFar,
    },
    Place {
        title: "Rim of the sphere map, m simplified",
        why: "1 - z has no digits left: m is 0, and u and v are no numbers",
        map: MappingId::Sphere,
        evaluator: "short-m",
        center: [0.0, 0.0, 1.0],
        span_deg: 0.1,
        lengths: Lengths::Plane,
        verdict: Verdict::NotFinite,
    },
    Place {
        title: "Rim of the sphere map, m as printed",
        why: "the whole rim is one direction, at which m is 0; around it f32's u and v cannot tell directions apart",
        map: MappingId::Sphere,
        evaluator: "textbook",
        center: [0.0, 0.0, 1.0],
        span_deg: 0.1,
        lengths: Lengths::Plane,
        verdict: Verdict::NotFinite,
    },
    Place {
        title: "Centre of the angular map",
        why: "the arccosine of a z that rounds to 1 is 0, and so is what it is divided by",
        map: MappingId::Angular,
        evaluator: "textbook",
        center: [0.0, 0.0, 1.0],
        span_deg: 0.1,
        lengths: Lengths::Plane,
        verdict: Verdict::TooFar,
    },
    Place {
        title: "Pole of the equal-area square",
        why: "1 - |y| has no digits left around the poles",
        map: MappingId::OctahedralEqualArea,
        evaluator: "textbook",
        center: [0.0, 1.0, 0.0],
        span_deg: 0.1,
        lengths: Lengths::Plane,
        verdict: Verdict::TooFar,
    },
];
