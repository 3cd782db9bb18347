//! Angles without a branch, for loops that a compiler turns into vector instructions.
//!
//! The polynomials and so the errors are those of [`super::atan_unit`] and [`super::sin_cos_turns`].

use super::arctan::{atan_unit, sin_cos_quarter};

/// 1/(2 pi): turns in a radian.
const TURNS_PER_RAD: f32 = (0.5 * std::f64::consts::FRAC_1_PI) as f32;

/// Angle of the point (x, y) in turns, in two parts: a multiple of 1/4 within [-1/2, 1/2], and a rest within [-1/8, 1/8]. (0, 0)
/// for the origin.
///
/// The parts are kept apart because their sum would round the rest: near half a turn by 3e-8 turns.
#[inline(always)]
pub fn atan2_turns(y: f32, x: f32) -> (f32, f32) {
    let (ax, ay) = (x.abs(), y.abs());
    let is_steep = ay > ax;
    let (small, large) = if is_steep { (ax, ay) } else { (ay, ax) };
    let divisor = if large > 0.0 { large } else { 1.0 };
    let angle = atan_turns(small / divisor);
    let base = if is_steep { 0.25 } else { 0.0 };
    let rest = if is_steep { -angle } else { angle };
    let base = if x < 0.0 { 0.5 - base } else { base };
    let rest = if x < 0.0 { -rest } else { rest };
    if y < 0.0 {
        (-base, -rest)
    } else {
        (base, rest)
    }
}

/// Arctangent in turns, |t| <= 1.
#[inline(always)]
pub fn atan_turns(t: f32) -> f32 {
    atan_unit(t) * TURNS_PER_RAD
}

/// (sin, cos) of an angle in turns, |turns| <= 1/8.
#[inline(always)]
pub fn sin_cos_eighth(turns: f32) -> (f32, f32) {
    sin_cos_quarter(turns * 4.0)
}

/// 3/2 2^23: a float of at most 2^22 added to it is rounded to a whole number, which its last bits then hold. A cast to an
/// integer would ask every number whether it fits.
const ROUNDING: f32 = 12_582_912.0;

/// The whole number nearest to `x`, halves to even; |x| < 2^22.
#[inline(always)]
pub fn nearest_whole(x: f32) -> i32 {
    ((x + ROUNDING).to_bits() as i32).wrapping_sub(ROUNDING.to_bits() as i32)
}

/// The whole number at or below `x`, and how far `x` lies above it; |x| < 2^22. `ROUNDS`: for processors with an instruction that
/// rounds down, as all with AVX2 have; elsewhere the library would be called. The numbers are the same.
#[inline(always)]
pub fn floor_and_rest<const ROUNDS: bool>(x: f32) -> (i32, f32) {
    if ROUNDS {
        let whole = x.floor();
        return (nearest_whole(whole), x - whole);
    }
    let near = (x + ROUNDING) - ROUNDING;
    let is_above = near > x;
    let whole = nearest_whole(x).wrapping_sub(i32::from(is_above));
    let near = if is_above { near - 1.0 } else { near };
    (whole, x - near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_exact_arctangent() {
        let (mut worst, mut control) = (0.0_f64, 0.0_f64);
        for i in -400..=400_i32 {
            for j in -400..=400_i32 {
                let (y, x) = (i as f32 * 0.37, j as f32 * 0.41);
                let (base, rest) = atan2_turns(y, x);
                assert!(base * 4.0 == (base * 4.0).round() && rest.abs() <= 0.125001);
                let exact = f64::from(y).atan2(f64::from(x)) / std::f64::consts::TAU;
                let error = |found: f64| (found - exact - (found - exact).round()).abs();
                worst = worst.max(error(f64::from(base) + f64::from(rest)));
                control = control.max(error(f64::from(base) - f64::from(rest)));
            }
        }
        // Observed: 1.5e-8 turns, a unit in the last place of 1/8.
        assert!(worst < 2.0e-8 && worst > 0.7e-8, "{worst}");
        assert!(control > 0.2, "{control}");
    }

    #[test]
    fn floors_are_below() {
        for (x, whole) in [(2.75, 2), (-2.75, -3), (-0.25, -1), (3.0, 3), (-3.0, -3)] {
            let exact = (whole, x - whole as f32);
            assert_eq!(floor_and_rest::<false>(x), exact);
            assert_eq!(floor_and_rest::<true>(x), exact);
        }
    }
}
