//! Arvo's equal-area cube: columns by solid angle, then each column by height. The two axes differ, so the faces do not
//! divide all their edges alike.

use super::cube_face::{self, plane_of_strip, strip_of_plane};
use super::face_map::FaceMap;
use super::{Claims, MappingInfo, evaluator};
use crate::math::Real;

/// See the [module](self).
pub struct Arvo;

impl FaceMap for Arvo {
    const INFO: MappingInfo = MappingInfo {
        id: "arvo",
        name: "Arvo's cube",
        about: "A cube with the same solid angle in every texel, smooth on each face, but with edges divided in two ways.",
        source: "Arvo 2001, stratified sampling of 2-manifolds",
        claims: Claims {
            equal_area: true,
            conformal: false,
            continuous: false,
        },
        evaluators: || evaluator::plain_and::<Arvo>(&[]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = 1/2 + (3/π) atan(a/√(a² + 2))",
        "v = 1/2 + (b/2) √((a² + 2)/(a² + b² + 1))",
    ];

    const HAS_COLUMNS: bool = true;

    #[inline(always)]
    fn from_plane<R: Real>(a: R, b: R) -> (R, R) {
        let aa = a * a;
        let height = ((aa + R::two()) / (aa + b * b + R::one())).sqrt();
        (strip_of_plane(a), b * height)
    }

    /// q^2 (a^2 + b^2 + 1) = b^2 (a^2 + 2), solved for b.
    #[inline(always)]
    fn to_plane<R: Real>(p: R, q: R) -> (R, R) {
        let a = plane_of_strip(p);
        let aa = a * a;
        let height = ((aa + R::one()) / (aa + (R::two() - q * q))).sqrt();
        (a, q * height)
    }
}
