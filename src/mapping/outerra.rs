//! Outerra's cube: the gnomonic plane lifted towards the middle of the face, so that squares stay square almost everywhere.

use super::face_map::FaceMap;
use super::{MappingInfo, cube_face, evaluator};
use crate::math::Real;
use std::f64::consts::SQRT_2;

/// See the [module](self).
pub struct Outerra;

/// M = 1/(2 sqrt 2 - 2) - 1: how much farther than the border the middle of a face lies.
const LIFT: f64 = (SQRT_2 - 1.0) / 2.0;

/// Newton's steps from the first guess: the error is below 1e-10 after two and below the last digit of f64 after three; one
/// more brings a derivative there too. The shader, in f32 and without derivatives, takes three.
const STEPS: u32 = 4;

impl FaceMap for Outerra {
    const INFO: MappingInfo = MappingInfo {
        id: "outerra",
        name: "Outerra's cube",
        about: "The cube with the smallest mean distortion of shapes; areas differ by 3.57.",
        source: "Kemen 2009, Outerra: spherical cube mapping",
        evaluators: || evaluator::plain_and::<Outerra>(&[]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = (1 + a k)/2, k = 1 + M(1 − a²k²)(1 − b²k²), M = (√2 − 1)/2",
        "v = (1 + b k)/2",
    ];

    /// (p, q) = k (a, b), where k is the height of the lifted plane: one equation in k, by Newton's steps.
    #[inline(always)]
    fn from_plane<R: Real>(a: R, b: R) -> (R, R) {
        let (aa, bb) = (a * a, b * b);
        let lift = R::from_f64(LIFT);
        let mut k = R::one() + lift * (R::one() - aa) * (R::one() - bb);
        for _ in 0..STEPS {
            let (across, down) = (R::one() - aa * k * k, R::one() - bb * k * k);
            let excess = R::one() + lift * across * down - k;
            let slope = R::one() + R::two() * lift * k * (aa * down + bb * across);
            k = k + excess / slope;
        }
        (a * k, b * k)
    }

    #[inline(always)]
    fn to_plane<R: Real>(p: R, q: R) -> (R, R) {
        let k = R::one() + R::from_f64(LIFT) * (R::one() - p * p) * (R::one() - q * q);
        (p / k, q / k)
    }
}
