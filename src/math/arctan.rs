//! The project's own arctangent, sine and cosine for f32, shared by the CPU and every shader.
//!
//! The shading language allows a built-in atan2 an error of 4096 ULP and a built-in sine 4.9e-4; a software driver was
//! seen to be off by 3.9e-4 rad in asin. These polynomials use only additions and products, which the language rounds
//! correctly, so the CPU and every adapter agree to a few ULP. A driver may fuse a product and a sum into one rounding:
//! the errors are stated for none fused and for all fused.
//!
//! The coefficients are derived, the number of them is chosen and the errors are measured by
//! `cargo run --release --example derive_arctangent`; `tests/arctangent.rs` holds this file to it.

/// Coefficients c of atan t = t + t s (c0 + c1 s + ...), s = t^2, |t| <= 1, lowest power first: degree 17 in t.
///
/// Degree 15 errs by 2.6 ULP; degree 19 gains 0.1 ULP, but its atan 1 is not the float nearest to pi/4.
pub const ATAN_COEFFICIENTS: [f32; 8] = [
    -0.33333153,
    0.19993767,
    -0.14211002,
    0.106657684,
    -0.07551656,
    0.043204635,
    -0.016363103,
    0.0029193931,
];

/// Coefficients c of sin(f pi/2) = f + f (c0 + c1 s + ...), s = f^2, |f| <= 1/2, lowest power first: degree 7 in f.
///
/// The sum starts with f itself, so that c0 = pi/2 - 1 and the roundings of the rest weigh a third: 1.2 ULP, not 1.6.
/// One more coefficient gains nothing.
pub const SIN_QUARTER_COEFFICIENTS: [f32; 4] = [0.5707963, -0.6459626, 0.07967021, -0.004574429];

/// Coefficients c of cos(f pi/2) = 1 + s (c0 + c1 s + ...), s = f^2, |f| <= 1/2, lowest power first: degree 8 in f.
///
/// Degree 6 errs by 1.6 ULP; one more coefficient gains nothing.
pub const COS_QUARTER_COEFFICIENTS: [f32; 4] = [-1.2337005, 0.25366855, -0.020855596, 0.0008944864];

/// Value of the polynomial with the given coefficients, lowest power first (Horner's scheme).
#[inline(always)] // a loop over many directions becomes vector instructions only where nothing is called
fn horner<const N: usize>(coefficients: &[f32; N], x: f32) -> f32 {
    let mut sum = 0.0;
    for c in coefficients.iter().rev() {
        sum = sum * x + c;
    }
    sum
}

/// Arctangent of t in radians for |t| <= 1.
///
/// Largest error over every float of [0, 1]: 1.25 ULP and 7.5e-8 rad (all fused: 1.08 ULP and 6.4e-8 rad). Odd, apart
/// from the sign of -0; the float nearest to pi/4 at 1, and nowhere above it. A float's value may be one ULP below that
/// of a smaller float.
#[inline(always)]
pub fn atan_unit(t: f32) -> f32 {
    let s = t * t;
    t + t * s * horner(&ATAN_COEFFICIENTS, s)
}

/// (sin, cos) of an angle in turns, |turns| <= 2. The reduction to an eighth of a turn is exact.
///
/// Largest error over every float of an eighth of a turn: 1.24 ULP and 5.9e-8 in the sine, 1.13 ULP and 6.8e-8 in the
/// cosine (all fused: 0.99 ULP and 4.7e-8, 0.88 ULP and 5.3e-8). Exact at quarter turns. At odd eighths both are the
/// float nearest to the square root of 1/2 with their signs, so it does not matter that the shading language rounds
/// halves to even and Rust away from zero.
pub fn sin_cos_turns(turns: f32) -> (f32, f32) {
    let quarters = (turns * 4.0).round();
    let (sin, cos) = sin_cos_quarter(turns * 4.0 - quarters);
    turn_by_quarters(quarters as i32, sin, cos)
}

/// (sin, cos) of `f` quarter turns, |f| <= 1/2.
#[inline(always)]
pub(super) fn sin_cos_quarter(f: f32) -> (f32, f32) {
    let s = f * f;
    let sin = f + f * horner(&SIN_QUARTER_COEFFICIENTS, s);
    let cos = 1.0 + s * horner(&COS_QUARTER_COEFFICIENTS, s);
    (sin, cos)
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
