//! The quadratic of the S2 library: between the plain cube and the tangent, without a transcendental function.

use super::face_map::Warp;
use super::{MappingInfo, cube_face, evaluator};
use crate::math::Real;

/// See the [module](self).
pub struct S2Quadratic;

impl Warp for S2Quadratic {
    const INFO: MappingInfo = MappingInfo {
        id: "s2-quadratic",
        name: "S2 quadratic cube",
        about: "A cube divided by a square root: areas differ by 2.10, and both ways are a few operations.",
        source: "S2 geometry library, s2coords.h",
        evaluators: || evaluator::plain_and::<S2Quadratic>(&[]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = 1/2 + sgn(a) (√(1 + 3|a|) − 1)/2",
        "v = 1/2 + sgn(b) (√(1 + 3|b|) − 1)/2",
    ];

    /// sqrt(1 + 3a) - 1, without the difference.
    #[inline(always)]
    fn from_plane<R: Real>(a: R) -> R {
        let three = R::from_f64(3.0);
        three * a / (R::one() + (R::one() + three * a.abs()).sqrt())
    }

    /// ((1 + p)^2 - 1)/3.
    #[inline(always)]
    fn to_plane<R: Real>(p: R) -> R {
        p * (R::two() + p.abs()) * R::from_f64(1.0 / 3.0)
    }
}
