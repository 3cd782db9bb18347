//! Our own polynomials at seven degrees, the error of each about an eighth of that of the one before.

use super::{Arctangent, SineCosine, horner, multiply_add};
use crate::math::{COS_QUARTER_COEFFICIENTS, SIN_QUARTER_COEFFICIENTS};

/// The coefficients of one degree, lowest power first, s = t^2 throughout.
#[derive(Debug)]
pub struct Level {
    /// Name of the evaluators that use it: `atan-` and the arctangent's degree.
    pub id: &'static str,
    /// What it is.
    pub about: &'static str,
    /// The arctangent of t in quarter turns, t P(s), |t| <= 1.
    pub quarters: &'static [f32],
    /// atan(a/sqrt 2)/(2 atan(1/sqrt 2)) = a P(s), |a| <= 1.
    pub along: &'static [f32],
    /// 1/(2 q) = 1 + s P(s) for the arctangent q of 1/sqrt(1 + s) in quarter turns, s in [0, 1].
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

/// From the roughest to where f32 itself is the limit. Each arctangent has the smallest possible largest absolute error;
/// where the cube's edges ask for less than the whole interval, fewer coefficients give the same. Derived by `cargo run
/// --release --example derive_arctangent`; `tests/arctangent.rs` holds this list to it.
#[expect(
    clippy::approx_constant,
    reason = "a fitted slope at 0 is near 2/pi, not meant to be it"
)]
pub const LEVELS: [Level; 7] = [
    Level {
        id: "atan-5",
        about: "own polynomials, arctangent of degree 5: 6e-4 rad",
        quarters: &[0.63366455, -0.18378589, 0.050508782],
        along: &[0.57387346, -0.090757206, 0.016960273],
        reach: &[0.3130775, -0.037409008],
        sin: SIN_3,
        cos: COS_4,
    },
    Level {
        id: "atan-7",
        about: "own polynomials, arctangent of degree 7: 8e-5 rad",
        quarters: &[0.63611925, -0.20446609, 0.09311424, -0.024819173],
        along: &[0.57387346, -0.090757206, 0.016960273],
        reach: &[0.31747878, -0.051980134, 0.010612668],
        sin: SIN_3,
        cos: COS_4,
    },
    Level {
        id: "atan-9",
        about: "own polynomials, arctangent of degree 9: 1.2e-5 rad",
        quarters: &[0.6365347, -0.2102787, 0.1146934, -0.054212727, 0.01327062],
        along: &[0.57437915, -0.09492351, 0.02543742, -0.004899056],
        reach: &[0.3181712, -0.056306392, 0.018217383, -0.0040112967],
        sin: SIN_5,
        cos: COS_4,
    },
    Level {
        id: "atan-11",
        about: "own polynomials, arctangent of degree 11: 1.8e-6 rad",
        quarters: &[
            0.63660526,
            -0.2117541,
            0.1232105,
            -0.07411642,
            0.033512976,
            -0.007459271,
        ],
        along: &[
            0.5744298,
            -0.095617555,
            0.027980192,
            -0.0083313,
            0.0015393228,
        ],
        reach: &[
            0.31828603,
            -0.057456892,
            0.021766491,
            -0.008301733,
            0.001781399,
        ],
        sin: SIN_5,
        cos: COS_6,
    },
    Level {
        id: "atan-13",
        about: "own polynomials, arctangent of degree 13: 3.5e-7 rad",
        quarters: &[
            0.6366173,
            -0.21210507,
            0.1261012,
            -0.084248245,
            0.05069331,
            -0.02139559,
            0.0043372484,
        ],
        along: &[
            0.57443494,
            -0.09572248,
            0.02857732,
            -0.009712212,
            0.0029324119,
            -0.00051001756,
        ],
        reach: &[
            0.31830573,
            -0.057744708,
            0.023120776,
            -0.011068025,
            0.0043371473,
            -0.00087615475,
        ],
        sin: SIN_5,
        cos: COS_6,
    },
    Level {
        id: "atan-15",
        about: "own polynomials, arctangent of degree 15: 1.3e-7 rad",
        quarters: &[
            0.6366193,
            -0.21218362,
            0.1269733,
            -0.088489726,
            0.061236165,
            -0.03538563,
            0.013769228,
            -0.002539066,
        ],
        along: &[
            0.57443494,
            -0.09572248,
            0.02857732,
            -0.009712212,
            0.0029324119,
            -0.00051001756,
        ],
        reach: &[
            0.31830916,
            -0.057813425,
            0.023575952,
            -0.012447123,
            0.0064421035,
            -0.0024525041,
            0.00046067467,
        ],
        sin: &SIN_QUARTER_COEFFICIENTS,
        cos: &COS_QUARTER_COEFFICIENTS,
    },
    Level {
        id: "atan-17",
        about: "own polynomials, arctangent of degree 17: 1.1e-7 rad",
        quarters: &[
            0.6366197,
            -0.2122012,
            0.12722312,
            -0.090076245,
            0.06655911,
            -0.045488775,
            0.0246684,
            -0.008768583,
            0.0014644729,
        ],
        along: &[
            0.5744354,
            -0.095736235,
            0.028689217,
            -0.01010009,
            0.0035838238,
            -0.0010340242,
            0.00016189332,
        ],
        reach: &[
            0.31830916,
            -0.057813425,
            0.023575952,
            -0.012447123,
            0.0064421035,
            -0.0024525041,
            0.00046067467,
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
    fn quarters<const FUSED: bool>(self, t: f32) -> f32 {
        t * horner::<FUSED>(LEVELS[LEVEL].quarters, t * t)
    }

    #[inline(always)]
    fn add_quarters<const FUSED: bool>(self, base: f32, t: f32) -> f32 {
        multiply_add::<FUSED>(t, horner::<FUSED>(LEVELS[LEVEL].quarters, t * t), base)
    }

    #[inline(always)]
    fn along_edge<const FUSED: bool>(self, a: f32) -> f32 {
        multiply_add::<FUSED>(a, horner::<FUSED>(LEVELS[LEVEL].along, a * a), 0.5)
    }

    #[inline(always)]
    fn reach<const FUSED: bool>(self, _q: f32, s: f32) -> f32 {
        multiply_add::<FUSED>(s, horner::<FUSED>(LEVELS[LEVEL].reach, s), 1.0)
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
