//! The quadrilateralised spherical cube: equal areas, divided alike on every edge, bent along the diagonals of the faces.

use super::face_map::FaceMap;
use super::{Claims, MappingInfo, cube_face, evaluator};
use crate::math::Real;
use std::f64::consts::{FRAC_1_PI, PI};

/// See the [module](self).
pub struct Qsc;

impl FaceMap for Qsc {
    const INFO: MappingInfo = MappingInfo {
        id: "qsc",
        name: "Quadrilateralised spherical cube",
        about: "A cube with the same solid angle in every texel, bent along the diagonals of its faces.",
        source: "O'Neill and Laubscher 1976; PROJ's qsc",
        claims: Claims {
            equal_area: true,
            conformal: false,
            continuous: true,
        },
        evaluators: || evaluator::plain_and::<Qsc>(&[]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = 1/2 + (a/2) √(S(S + 1)/(n(n + 1))) where |a| ≥ |b|: S = √(2 + t²), t = b/a, n = √(1 + a² + b²); else v's with a and b exchanged",
        "v = 1/2 + (u − 1/2) (12/π) atan(t(S − 1)/(S + t²)) where |a| ≥ |b|; else u's with a and b exchanged",
    ];

    /// In the quarter around an axis, with t the slope and cos(reach) = 1/S on the border: the distance from the middle is the root of
    /// (1 - cos)/(1 - cos(reach)), and 1 - cos = (a^2 + b^2)/(n(n + 1)). Across, the angle grows by solid angle: t's arctangent
    /// less that of t/S, which is one arctangent by the rule for differences.
    #[inline(always)]
    fn from_plane<R: Real>(a: R, b: R) -> (R, R) {
        let is_upright = b.abs() > a.abs();
        let (major, minor) = if is_upright { (b, a) } else { (a, b) };
        if major.abs() <= R::zero() {
            let [along, across] = MIDDLE.map(R::from_f64);
            return (a / along, b / across);
        }
        let slope = minor / major;
        let square = slope * slope;
        let reach = (R::two() + square).sqrt();
        let n = (R::one() + a * a + b * b).sqrt();
        let along = major * (reach * (reach + R::one()) / (n * (n + R::one()))).sqrt();
        // S - 1 is (1 + t^2)/(S + 1), which keeps the digits.
        let below = (reach + R::one()) * (reach + square);
        let turned = (slope * (R::one() + square) / below).atan_unit();
        let across = along * turned * R::from_f64(12.0 * FRAC_1_PI);
        if is_upright {
            (across, along)
        } else {
            (along, across)
        }
    }

    #[inline(always)]
    fn to_plane<R: Real>(p: R, q: R) -> (R, R) {
        Self::to_plane_of(Self::facet(p, q), p, q)
    }

    /// The quarters between the diagonals: around +p, +q, -p, -q.
    const FACETS: u32 = 4;

    #[inline(always)]
    fn facet<R: Real>(p: R, q: R) -> u32 {
        let is_upright = q.abs() > p.abs();
        let along = if is_upright { q } else { p };
        u32::from(is_upright) + if along < R::zero() { 2 } else { 0 }
    }

    /// The quarter's formula goes on to twice its slope; around the middle, where all four meet in a point, it is as on the face.
    #[inline(always)]
    fn to_plane_of<R: Real>(facet: u32, p: R, q: R) -> (R, R) {
        let reaches = |facet: u32| {
            let (major, minor) = if facet & 1 != 0 { (q, p) } else { (p, q) };
            let along = if facet & 2 != 0 { -major } else { major };
            along > R::zero() && minor.abs() <= R::two() * along
        };
        let facet = if reaches(facet) {
            facet
        } else {
            Self::facet(p, q)
        };
        let is_upright = facet & 1 != 0;
        let (major, minor) = if is_upright { (q, p) } else { (p, q) };
        let (major, minor) = from_quarter(major, minor);
        if is_upright {
            (minor, major)
        } else {
            (major, minor)
        }
    }
}

/// sin(pi/8).
const BOUND: f64 = 0.382_683_432_365_089_8;

/// Slopes of the plane's coordinates in the very middle of a face, where each direction has its own: those along the first quarter's
/// axis, as everywhere with pi/6 for their product. There S = sqrt 2, and sqrt(2/(S(S + 1))) = 2 sin(pi/8); the tangent of the slope's
/// angle grows by pi/24 over sin(pi/8)^2.
const MIDDLE: [f64; 2] = [2.0 * BOUND, PI / (12.0 * BOUND)];

/// The plane's coordinates along and across a quarter from the square's. With w the slope on the square and f = pi w/12, the
/// plane's is sin f/(cos f - 1/sqrt 2), here by the half of f and sin(pi/8) so that nothing cancels; then cos = 1 - P^2 (1 - 1/S).
#[inline(always)]
fn from_quarter<R: Real>(along: R, across: R) -> (R, R) {
    if along.abs() <= R::zero() {
        let [slope, turn] = MIDDLE.map(R::from_f64);
        return (along * slope, across * turn);
    }
    let (sin, cos) = (across / along * R::from_f64(1.0 / 48.0)).sin_cos_turns();
    let bound = R::from_f64(BOUND);
    let tangent = sin * cos / ((bound - sin) * (bound + sin));
    let square = tangent * tangent;
    let reach = (R::two() + square).sqrt();
    let both = reach * (reach + R::one());
    // 1 - cos.
    let versine = along * along * (R::one() + square) / both;
    let plane = along * ((R::two() - versine) / both).sqrt() / (R::one() - versine);
    (plane, plane * tangent)
}
