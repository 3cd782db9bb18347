//! The tangent with another angle than an eighth of a turn: the equi-angular cube, but with more even areas.

use super::face_map::Warp;
use super::{MappingInfo, cube_face, evaluator};
use crate::math::Real;
use std::f64::consts::TAU;

/// See the [module](self).
pub struct Tangent;

/// c: p = atan(c a)/atan c. With 1 it would be the equi-angular cube.
pub const STRETCH: f64 = 1.182_286_685_55;

/// atan c, in radians (its sine and cosine are tested).
const REACH_RAD: f64 = 0.868_734_829_277_358_6;

impl Warp for Tangent {
    const INFO: MappingInfo = MappingInfo {
        id: "tangent",
        name: "Adjusted tangent cube",
        about: "The equi-angular cube with a stretched angle: areas differ by 1.31.",
        source: "the constant that public code ascribes to Zucker and Higashi, JCGT 7(2) 2018",
        evaluators: || evaluator::plain_and::<Tangent>(&[]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = 1/2 + atan(c a)/(2 atan c), c = 1.18228668555",
        "v = 1/2 + atan(c b)/(2 atan c), c = 1.18228668555",
    ];

    #[inline(always)]
    fn from_plane<R: Real>(a: R) -> R {
        (a * R::from_f64(STRETCH)).atan() * R::from_f64(1.0 / REACH_RAD)
    }

    #[inline(always)]
    fn to_plane<R: Real>(p: R) -> R {
        (p * R::from_f64(REACH_RAD / TAU)).tan_turns() * R::from_f64(1.0 / STRETCH)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angle_is_that_of_the_stretch() {
        assert_eq!(REACH_RAD, f64::atan(STRETCH));
    }
}
