//! A parabola on each half of an axis: a correction with one product, found by trying.

use super::face_map::Warp;
use super::{MappingInfo, cube_face, evaluator};
use crate::math::Real;

/// See the [module](self).
pub struct Everitt;

/// e: the slope in the middle of a face; 2 - e is the slope at its border. Everitt took 1.375.
pub const SLOPE: f64 = 1.4511;

impl Warp for Everitt {
    const INFO: MappingInfo = MappingInfo {
        id: "everitt",
        name: "Everitt's cube",
        about: "A cube divided by parabolas: two products, areas differ by 1.44.",
        source: "Everitt 2014, with the constant that public code ascribes to Zucker and Higashi, JCGT 7(2) 2018",
        evaluators: || evaluator::plain_and::<Everitt>(&[]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = 1/2 + a (e + (1 − e)|a|)/2, e = 1.4511",
        "v = 1/2 + b (e + (1 − e)|b|)/2, e = 1.4511",
    ];

    #[inline(always)]
    fn from_plane<R: Real>(a: R) -> R {
        a * (R::from_f64(SLOPE) - R::from_f64(SLOPE - 1.0) * a.abs())
    }

    /// The root of the parabola, in the form that does not cancel.
    #[inline(always)]
    fn to_plane<R: Real>(p: R) -> R {
        let square = R::from_f64(SLOPE * SLOPE) - R::from_f64(4.0 * (SLOPE - 1.0)) * p.abs();
        R::two() * p / (R::from_f64(SLOPE) + square.sqrt())
    }
}
