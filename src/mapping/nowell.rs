//! Nowell's map: a point of the cube's surface to the unit ball by a polynomial under a root.

use super::face_map::FaceMap;
use super::{MappingInfo, cube_face, evaluator};
use crate::math::Real;

/// See the [module](self).
pub struct Nowell;

impl FaceMap for Nowell {
    const INFO: MappingInfo = MappingInfo {
        id: "nowell",
        name: "Nowell's cube",
        about: "The cube blown up by a polynomial: no division on the way to the ball, areas differ by 1.33.",
        source: "Nowell 2005, Mapping a cube to a sphere",
        evaluators: || evaluator::plain_and::<Nowell>(&[]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = 1/2 + X √(3/(s + √(s² − 24 X²))), X = a/n, Y = b/n, n = √(1 + a² + b²), s = 3 + 2(X² − Y²)",
        "v = 1/2 + Y √(3/(t + √(t² − 24 Y²))), t = 3 − 2(X² − Y²)",
    ];

    /// With p on the cube, X^2 = p^2/2 - p^2 q^2/6 and Y^2 = q^2/2 - p^2 q^2/6 on the ball, so q^2 = p^2 - 2(X^2 - Y^2), and p^2
    /// is the root of s^2 - (3 + 2(X^2 - Y^2)) s + 6 X^2 = 0, taken in the form that does not cancel.
    #[inline(always)]
    fn from_plane<R: Real>(a: R, b: R) -> (R, R) {
        let n_squared = R::one() + a * a + b * b;
        let (x_squared, y_squared) = (a * a / n_squared, b * b / n_squared);
        let twice = R::two() * (x_squared - y_squared);
        let n = n_squared.sqrt();
        let place = |c: R, c_squared: R, sum: R| {
            let root = (sum * sum - R::from_f64(24.0) * c_squared).sqrt();
            c / n * (R::from_f64(12.0) / (sum + root)).sqrt()
        };
        let three = R::from_f64(3.0);
        (
            place(a, x_squared, three + twice),
            place(b, y_squared, three - twice),
        )
    }

    /// (x, y) over z of the ball: x = p sqrt(1/2 - q^2/6), y = q sqrt(1/2 - p^2/6), z = sqrt(1 - p^2/2 - q^2/2 + p^2 q^2/3).
    #[inline(always)]
    fn to_plane<R: Real>(p: R, q: R) -> (R, R) {
        let (pp, qq) = (p * p, q * q);
        let across = |other: R| (R::half() - other * R::from_f64(1.0 / 6.0)).sqrt();
        // (1 - pp/2)(1 - qq/2) + pp qq/12: only sums of what is positive.
        let half = R::half();
        let up = ((R::one() - pp * half) * (R::one() - qq * half)
            + pp * qq * R::from_f64(1.0 / 12.0))
        .sqrt();
        (p * across(qq) / up, q * across(pp) / up)
    }
}
