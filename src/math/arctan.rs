//! The project's own arctangent, sine and cosine for f32, shared by the CPU and every shader.
//!
//! The shading language allows a built-in atan2 an error of 4096 ULP and a built-in sine 4.9e-4; a software driver was
//! seen to be off by 3.9e-4 rad in asin. These polynomials use only additions, products and one division, which the
//! language rounds correctly, so the CPU and every adapter agree to a few ULP.

/// Coefficients c of atan t = t + t s (c0 + c1 s + ... ), s = t^2, |t| <= 1: degree 17 in t.
pub const ATAN_COEFFICIENTS: [f32; 8] = [
    -0.333_331_53,
    0.199_937_73,
    -0.142_110_56,
    0.106_660_03,
    -0.075_522_12,
    0.043_211_83,
    -0.016_367_91,
    0.002_920_688,
];

/// Coefficients of sin(f pi/2) = f (c0 + c1 f^2 + ...), |f| <= 1/2.
pub const SIN_QUARTER_COEFFICIENTS: [f32; 5] = [
    1.570_796_3,
    -0.645_964_1,
    0.079_692_63,
    -0.004_681_754,
    0.000_160_441_2,
];

/// Coefficients of cos(f pi/2) = 1 + f^2 (c0 + c1 f^2 + ...), |f| <= 1/2.
pub const COS_QUARTER_COEFFICIENTS: [f32; 4] =
    [-1.233_700_6, 0.253_669_5, -0.020_863_48, 0.000_919_260_3];

/// Value of the polynomial with the given coefficients, lowest power first (Horner's scheme).
fn horner(coefficients: &[f32], x: f32) -> f32 {
    coefficients.iter().rev().fold(0.0, |sum, &c| sum * x + c)
}

/// Arctangent of t in radians for |t| <= 1.
pub fn atan_unit(t: f32) -> f32 {
    let s = t * t;
    t + t * s * horner(&ATAN_COEFFICIENTS, s)
}

/// (sin, cos) of an angle in turns, |turns| <= 2. The reduction to an eighth of a turn is exact.
pub fn sin_cos_turns(turns: f32) -> (f32, f32) {
    let quarters = (turns * 4.0).round();
    let f = turns * 4.0 - quarters;
    let s = f * f;
    let sin = f * horner(&SIN_QUARTER_COEFFICIENTS, s);
    let cos = 1.0 + s * horner(&COS_QUARTER_COEFFICIENTS, s);
    turn_by_quarters(quarters as i32, sin, cos)
}

/// (sin, cos) of an angle increased by whole quarter turns.
pub(super) fn turn_by_quarters<R: std::ops::Neg<Output = R>>(
    quarters: i32,
    sin: R,
    cos: R,
) -> (R, R) {
    match quarters & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}
