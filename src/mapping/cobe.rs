//! The quadrilateralised cube of the COBE satellite's data, as a polynomial from the square to the plane: nearly equal areas.
//!
//! The literature has a polynomial for each way, and neither is the other's inverse (off by up to 2.5e-3). Here the one from the
//! square to the plane is the mapping, as its areas are the more even ones; the other way is its true inverse, and the published
//! polynomial is an evaluator.

use super::evaluator::{self, SeedForm};
use super::face_map::FaceMap;
use super::{ChartPoint, Mapping, MappingInfo, cube_face};
use crate::math::{Real, Vec3};

/// See the [module](self).
pub struct Cobe;

impl FaceMap for Cobe {
    const INFO: MappingInfo = MappingInfo {
        id: "cobe",
        name: "COBE cube",
        about: "A smooth cube of nearly equal areas, which differ by 1.02, by polynomials.",
        source: "Chan and O'Neill 1975, COBE's sky maps; polynomials that public code ascribes to JCGT 7(2) 2018",
        evaluators: || evaluator::plain_and::<Cobe>(&[PUBLISHED]),
        ..cube_face::FAMILY
    };
    const FORMULAS: [&'static str; 2] = [
        "u = (1 + p)/2, where G(p, q) = a, G(q, p) = b; G(p, q) = p(g₀ + g₁p² + (1 − p²)((g₂ + g₃q² + g₄p²)p² + (g₅ + g₆q²)q²))",
        "v = (1 + q)/2",
    ];

    /// What the published polynomial leaves, taken away again and again: each time a sixteenth of it stays.
    #[inline(always)]
    fn from_plane<R: Real>(a: R, b: R) -> (R, R) {
        let (p, q) = fit(a, b);
        let mut found = (p, q);
        for _ in 0..sweeps::<R>() {
            let (back_a, back_b) = Self::to_plane(found.0, found.1);
            let (again_p, again_q) = fit(back_a, back_b);
            found = (found.0 + (p - again_p), found.1 + (q - again_q));
        }
        found
    }

    #[inline(always)]
    fn to_plane<R: Real>(p: R, q: R) -> (R, R) {
        (onto(p, q), onto(q, p))
    }
}

/// What is left of the fit's 2.5e-3 after n sweeps, 2.5e-3/16^n, counts half in u = (1 + p)/2. For u from 1/2 on this is below half a unit in the last
/// place: 1.9e-8 of f32's 3.0e-8 for n = 4, and 4e-18 of f64's 5.6e-17 for n = 12.
fn sweeps<R: Real>() -> u32 {
    if R::EPSILON > 1e-10 { 4 } else { 12 }
}

/// G: a of (p, q). At |p| = 1 it is 1 for every q.
#[inline(always)]
fn onto<R: Real>(p: R, q: R) -> R {
    let k = R::from_f64;
    let (pp, qq) = (p * p, q * q);
    let inner =
        (k(-0.094_118_008_582_4) + k(0.040_912_598_118_7) * qq - k(0.062_327_269_088_1) * pp) * pp
            + (k(0.027_592_248_090_2) + k(0.034_221_702_697_9) * qq) * qq;
    // The published 0.723951234952 and 0.276048765048 add up to 1.
    p * (R::one() + (R::one() - pp) * (inner - k(0.276_048_765_048)))
}

/// The published polynomial the other way.
#[inline(always)]
fn fit<R: Real>(a: R, b: R) -> (R, R) {
    (fit_of(a, b), fit_of(b, a))
}

#[inline(always)]
fn fit_of<R: Real>(a: R, b: R) -> R {
    let k = R::from_f64;
    let (aa, bb) = (a * a, b * b);
    let inner = (k(-0.212_853_382_041) + k(0.094_125_968_487_7) * bb + k(0.069_353_268_533_3) * aa)
        * aa
        + (k(-0.117_847_692_949) + k(0.010_798_919_718_1) * bb) * bb;
    // The published 1.37738198385 and -0.377381983848 add up to 1 + 2e-12; here an edge stays an edge.
    a * (R::one() + (R::one() - aa) * (inner + k(0.377_381_983_85)))
}

/// The polynomial from the plane to the square by itself.
const PUBLISHED: SeedForm = SeedForm {
    id: "published-fit",
    about: "the published polynomial from the plane to the square, which is not the inverse of the other one",
    source: "public code that names JCGT 7(2) 2018",
    forward: |dir: Vec3<f32>| {
        let (face, a, b) = cube_face::gnomonic(dir, cube_face::largest_component)?;
        let (p, q) = fit(a, b);
        let place = |c: f32| 0.5 + 0.5 * c;
        Some(ChartPoint::new(face, place(p), place(q)).clamped())
    },
    inverse: Some(<Cobe as Mapping>::inverse),
};
