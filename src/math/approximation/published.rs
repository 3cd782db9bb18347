//! Approximations from the literature, with the numbers that it prints.

#![expect(
    clippy::excessive_precision,
    reason = "as they are printed; f32 rounds them"
)]

use std::f32::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4};

use super::{Arctangent, SineCosine, horner, multiply_add};

/// What is known of an approximation before it is measured.
pub trait Published {
    /// Name on the command line.
    const ID: &'static str;
    /// What it is.
    const ABOUT: &'static str;
    /// Where it was printed.
    const SOURCE: &'static str;
}

macro_rules! published {
    ($name:ident, $id:literal, $about:literal, $source:literal) => {
        #[doc = concat!($about, ". ", $source, ".")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Published for $name {
            const ID: &'static str = $id;
            const ABOUT: &'static str = $about;
            const SOURCE: &'static str = $source;
        }
    };
}

published!(
    Hastings9,
    "hastings-9",
    "arctangent of degree 9, 1.1e-5 rad; sine and cosine of degree 5 and 4",
    "Hastings 1955; Abramowitz and Stegun 4.4.47, 4.3.96, 4.3.98"
);
published!(
    Hastings17,
    "hastings-17",
    "arctangent of degree 17, 2e-8 rad; sine and cosine of degree 11 and 10",
    "Carlson and Goldstein 1955; Abramowitz and Stegun 4.4.49, 4.3.97, 4.3.99"
);
published!(
    Rational,
    "rational",
    "arctangent as t/(1 + 0.28 t²), 4.9e-3 rad",
    "Abramowitz and Stegun 4.4.48"
);
published!(
    Rajan2,
    "rajan-2",
    "arctangent as t (π/4 + 0.273 (1 − |t|)), 3.8e-3 rad",
    "Rajan, Wang, Inkol and Joyal, IEEE Signal Processing Magazine, May 2006"
);
published!(
    Rajan3,
    "rajan-3",
    "arctangent of degree 3 in |t|, 1.5e-3 rad",
    "Rajan, Wang, Inkol and Joyal, IEEE Signal Processing Magazine, May 2006"
);
published!(
    Lagarde,
    "lagarde",
    "arctangent of degree 3 in |t|, 1.4e-3 rad",
    "Lagarde 2014, Inverse trigonometric functions GPU optimization (atanFast4)"
);
published!(
    Pbrt,
    "pbrt",
    "arctangent of degree 6 in t >= 0, 6.4e-6 rad",
    "pbrt-v4, equal-area mapping"
);

/// Quarter turns in so many radians: all but one are printed for radians.
#[inline(always)]
fn in_quarters(rad: f32) -> f32 {
    rad * FRAC_2_PI
}

impl Arctangent for Hastings9 {
    #[inline(always)]
    fn quarters<const FUSED: bool>(self, t: f32) -> f32 {
        const C: [f32; 5] = [
            0.999_866_0,
            -0.330_299_5,
            0.180_141_0,
            -0.085_133_0,
            0.020_835_1,
        ];
        in_quarters(t * horner::<FUSED>(&C, t * t))
    }
}

impl SineCosine for Hastings9 {
    #[inline(always)]
    fn sin_cos_quarter<const FUSED: bool>(self, f: f32) -> (f32, f32) {
        series::<FUSED>(f, &[1.0, -0.166_05, 0.007_61], &[1.0, -0.496_70, 0.037_05])
    }
}

impl Arctangent for Hastings17 {
    #[inline(always)]
    fn quarters<const FUSED: bool>(self, t: f32) -> f32 {
        const C: [f32; 8] = [
            -0.333_331_452_8,
            0.199_935_508_5,
            -0.142_088_994_4,
            0.106_562_639_3,
            -0.075_289_640_0,
            0.042_909_613_8,
            -0.016_165_736_7,
            0.002_866_225_7,
        ];
        let s = t * t;
        in_quarters(multiply_add::<FUSED>(t * s, horner::<FUSED>(&C, s), t))
    }
}

impl SineCosine for Hastings17 {
    #[inline(always)]
    fn sin_cos_quarter<const FUSED: bool>(self, f: f32) -> (f32, f32) {
        const SIN: [f32; 6] = [
            1.0,
            -0.166_666_666_4,
            0.008_333_331_5,
            -0.000_198_409_0,
            0.000_002_752_6,
            -0.000_000_023_9,
        ];
        const COS: [f32; 6] = [
            1.0,
            -0.499_999_996_3,
            0.041_666_641_8,
            -0.001_388_839_7,
            0.000_024_760_9,
            -0.000_000_260_5,
        ];
        series::<FUSED>(f, &SIN, &COS)
    }
}

/// (sin, cos) of `f` quarter turns from the polynomials of sin x/x and cos x in x^2.
#[inline(always)]
fn series<const FUSED: bool>(f: f32, sin: &[f32], cos: &[f32]) -> (f32, f32) {
    let x = f * FRAC_PI_2;
    let s = x * x;
    (x * horner::<FUSED>(sin, s), horner::<FUSED>(cos, s))
}

impl Arctangent for Rational {
    #[inline(always)]
    fn quarters<const FUSED: bool>(self, t: f32) -> f32 {
        in_quarters(t / multiply_add::<FUSED>(0.28 * t, t, 1.0))
    }
}

impl Arctangent for Rajan2 {
    #[inline(always)]
    fn quarters<const FUSED: bool>(self, t: f32) -> f32 {
        in_quarters(t * multiply_add::<FUSED>(-0.273, t.abs(), FRAC_PI_4 + 0.273))
    }
}

impl Arctangent for Rajan3 {
    #[inline(always)]
    fn quarters<const FUSED: bool>(self, t: f32) -> f32 {
        let a = t.abs();
        let bend = multiply_add::<FUSED>(0.0663, a, 0.2447);
        in_quarters(t * multiply_add::<FUSED>(1.0 - a, bend, FRAC_PI_4))
    }
}

impl Arctangent for Lagarde {
    #[inline(always)]
    fn quarters<const FUSED: bool>(self, t: f32) -> f32 {
        in_quarters(t * horner::<FUSED>(&[1.0301, -0.1784, -0.0663], t.abs()))
    }
}

impl Arctangent for Pbrt {
    #[inline(always)]
    fn quarters<const FUSED: bool>(self, t: f32) -> f32 {
        // This one is printed for quarter turns.
        const C: [f32; 7] = [
            0.406_758_566_2e-5,
            0.636_226_545_3,
            0.615_720_179e-2,
            -0.247_333_733_3,
            0.881_770_664_8e-1,
            0.419_038_818_0e-1,
            -0.251_390_972_3e-1,
        ];
        horner::<FUSED>(&C, t.abs()).copysign(t)
    }
}
