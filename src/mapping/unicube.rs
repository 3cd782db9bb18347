//! The unicube: each axis divided so that every strip between two lines holds the same solid angle.

use super::cube_face::{self, plane_of_strip, strip_of_plane};
use super::face_map::Warp;
use super::{MappingInfo, evaluator};
use crate::math::Real;

/// See the [module](self).
pub struct Unicube;

impl Warp for Unicube {
    const INFO: MappingInfo = MappingInfo {
        id: "unicube",
        name: "Unicube",
        about: "A cube whose columns hold equal solid angles, and whose rows do; areas differ by 1.33.",
        source: "Ho, Wan, Leung, Lam and Wong 2011, Unicube for dynamic environment mapping",
        evaluators: || evaluator::plain_and::<Unicube>(&[]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = 1/2 + (3/π) atan(a/√(a² + 2))",
        "v = 1/2 + (3/π) atan(b/√(b² + 2))",
    ];

    #[inline(always)]
    fn from_plane<R: Real>(a: R) -> R {
        strip_of_plane(a)
    }

    #[inline(always)]
    fn to_plane<R: Real>(p: R) -> R {
        plane_of_strip(p)
    }
}
