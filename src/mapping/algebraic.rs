//! A root in place of the arctangent: the shape of the tangent's curve, without a transcendental function.

use super::face_map::Warp;
use super::{MappingInfo, cube_face, evaluator};
use crate::math::Real;

/// See the [module](self).
pub struct Algebraic;

/// c: p = a sqrt((1 + c^2)/(1 + c^2 a^2)).
pub const BEND: f64 = 0.87;

impl Warp for Algebraic {
    const INFO: MappingInfo = MappingInfo {
        id: "algebraic",
        name: "Algebraic cube",
        about: "A cube divided by a root: areas differ by 1.27.",
        source: "Lambers 2020, mappings between sphere, disc and square",
        evaluators: || evaluator::plain_and::<Algebraic>(&[]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = 1/2 + (a/2) √((1 + c²)/(1 + c² a²)), c = 0.87",
        "v = 1/2 + (b/2) √((1 + c²)/(1 + c² b²)), c = 0.87",
    ];

    #[inline(always)]
    fn from_plane<R: Real>(a: R) -> R {
        const SQUARE: f64 = BEND * BEND;
        let below = R::one() + R::from_f64(SQUARE) * a * a;
        a * (R::from_f64(1.0 + SQUARE) / below).sqrt()
    }

    #[inline(always)]
    fn to_plane<R: Real>(p: R) -> R {
        const SQUARE: f64 = BEND * BEND;
        p / (R::from_f64(1.0 + SQUARE) - R::from_f64(SQUARE) * p * p).sqrt()
    }
}
