//! Our own polynomials at seven degrees, the error of each about an eighth of that of the one before.

use super::{Arctangent, SineCosine, horner, multiply_add};
use crate::math::{ATAN_COEFFICIENTS, COS_QUARTER_COEFFICIENTS, SIN_QUARTER_COEFFICIENTS};

/// The coefficients of one degree, lowest power first, s = t^2 throughout.
#[derive(Debug)]
pub struct Level {
    /// Name of the evaluators that use it: `atan-` and the arctangent's degree.
    pub id: &'static str,
    /// What it is.
    pub about: &'static str,
    /// atan t = t + t s P(s), |t| <= 1.
    pub atan: &'static [f32],
    /// atan(a/sqrt 2)/(2 atan(1/sqrt 2)) = a P(s), |a| <= 1.
    pub along: &'static [f32],
    /// 1/(2 atan(1/sqrt(1 + s))) = P(s), s in [0, 1].
    pub reach: &'static [f32],
    /// sin(f pi/2) = f + f P(s), |f| <= 1/2.
    pub sin: &'static [f32],
    /// cos(f pi/2) = 1 + s P(s), |f| <= 1/2.
    pub cos: &'static [f32],
}

/// Sine of degree 3, 4.1e-4 of it, and cosine of degree 4, 1.5e-5.
const SIN_3: &[f32] = &[0.5701548, -0.6260753];
const COS_4: &[f32] = &[-1.2331097, 0.2463136];
/// Sine of degree 5, 1.5e-6 of it, and cosine of degree 6, 9.4e-8.
const SIN_5: &[f32] = &[0.570794, -0.64579844, 0.07794113];
const COS_6: &[f32] = &[-1.2336977, 0.2536024, -0.02041453];

/// From the roughest to the one that [`crate::math::atan_unit`] uses. Each has the smallest possible largest relative
/// error, which is 2e-3, 2.6e-4, 3.5e-5, 5e-6, 7e-7, 1e-7 and 2e-8 before the roundings; where the cube's edges ask for less
/// than the whole interval, fewer coefficients give the same. Derived by `cargo run --release --example
/// derive_arctangent`; `tests/arctangent.rs` holds this list to it.
pub const LEVELS: [Level; 7] = [
    Level {
        id: "atan-5",
        about: "own polynomials, arctangent of degree 5: 1.6e-3 rad",
        atan: &[-0.30769572, 0.09470036],
        along: &[0.57199097, -0.07411876],
        reach: &[0.63917065, 0.17645878],
        sin: SIN_3,
        cos: COS_4,
    },
    Level {
        id: "atan-7",
        about: "own polynomials, arctangent of degree 7: 2.0e-4 rad",
        atan: &[-0.32762277, 0.15931424, -0.046496492],
        along: &[0.5742578, -0.092300914, 0.018197697],
        reach: &[0.6368012, 0.1986119, -0.023270149],
        sin: SIN_3,
        cos: COS_4,
    },
    Level {
        id: "atan-9",
        about: "own polynomials, arctangent of degree 9: 2.8e-5 rad",
        atan: &[-0.33213073, 0.18681423, -0.09409803, 0.024840325],
        along: &[0.57442147, -0.09526389, 0.026120316, -0.0052900873],
        reach: &[0.636637, 0.20198248, -0.032843113, 0.0066200877],
        sin: SIN_5,
        cos: COS_4,
    },
    Level {
        id: "atan-11",
        about: "own polynomials, arctangent of degree 11: 4.0e-6 rad",
        atan: &[-0.333089, 0.19618303, -0.1225148, 0.058770005, -0.013955003],
        along: &[
            0.57443434,
            -0.095678374,
            0.028200217,
            -0.008625783,
            0.0016706141,
        ],
        reach: &[0.6366217, 0.202529, -0.03575861, 0.011484086, -0.002503857],
        sin: SIN_5,
        cos: COS_6,
    },
    Level {
        id: "atan-13",
        about: "own polynomials, arctangent of degree 13: 6.3e-7 rad",
        atan: &[
            -0.3332849,
            0.19897865,
            -0.1354453,
            0.08483996,
            -0.037795607,
            0.008105946,
        ],
        along: &[
            0.5744354,
            -0.095732145,
            0.02863181,
            -0.009837308,
            0.0030578917,
            -0.0005557496,
        ],
        reach: &[
            0.63662,
            0.2026233,
            -0.03655873,
            0.013817176,
            -0.0052492567,
            0.0011223033,
        ],
        sin: SIN_5,
        cos: COS_6,
    },
    Level {
        id: "atan-15",
        about: "own polynomials, arctangent of degree 15: 1.5e-7 rad",
        atan: &[
            -0.33332393,
            0.19974229,
            -0.14041407,
            0.09968682,
            -0.06020597,
            0.024736002,
            -0.004823059,
        ],
        along: &[
            0.5744354,
            -0.095732145,
            0.02863181,
            -0.009837308,
            0.0030578917,
            -0.0005557496,
        ],
        reach: &[
            0.6366198,
            0.20263866,
            -0.036751986,
            0.01468327,
            -0.00697982,
            0.0027024366,
            -0.0005378902,
        ],
        sin: &SIN_QUARTER_COEFFICIENTS,
        cos: &COS_QUARTER_COEFFICIENTS,
    },
    Level {
        id: "atan-17",
        about: "own polynomials, arctangent of degree 17: 7.5e-8 rad",
        atan: &ATAN_COEFFICIENTS,
        along: &[
            0.5744355,
            -0.09573735,
            0.028694406,
            -0.010106923,
            0.0035795954,
            -0.001019912,
            0.00015470173,
        ],
        reach: &[
            0.6366198,
            0.20263866,
            -0.036751986,
            0.01468327,
            -0.00697982,
            0.0027024366,
            -0.0005378902,
        ],
        sin: &SIN_QUARTER_COEFFICIENTS,
        cos: &COS_QUARTER_COEFFICIENTS,
    },
];

/// The polynomials of `LEVELS[LEVEL]`; the loop is compiled for their number.
#[derive(Clone, Copy, Debug)]
pub struct Own<const LEVEL: usize>;

impl<const LEVEL: usize> Arctangent for Own<LEVEL> {
    #[inline(always)]
    fn atan<const FUSED: bool>(self, t: f32) -> f32 {
        let s = t * t;
        multiply_add::<FUSED>(t * s, horner::<FUSED>(LEVELS[LEVEL].atan, s), t)
    }

    #[inline(always)]
    fn along_edge<const FUSED: bool>(self, a: f32) -> f32 {
        a * horner::<FUSED>(LEVELS[LEVEL].along, a * a)
    }

    #[inline(always)]
    fn reach<const FUSED: bool>(self, _q: f32, s: f32) -> f32 {
        horner::<FUSED>(LEVELS[LEVEL].reach, s)
    }
}

impl<const LEVEL: usize> SineCosine for Own<LEVEL> {
    #[inline(always)]
    fn sin_cos_quarter<const FUSED: bool>(self, f: f32) -> (f32, f32) {
        let s = f * f;
        (
            multiply_add::<FUSED>(f, horner::<FUSED>(LEVELS[LEVEL].sin, s), f),
            multiply_add::<FUSED>(s, horner::<FUSED>(LEVELS[LEVEL].cos, s), 1.0),
        )
    }
}
