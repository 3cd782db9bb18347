//! f32 with the standard library's functions in place of our own.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Real;
use super::arctan::turn_by_quarters;

/// A float whose angles the platform's own library computes. Mappings written for any [`Real`] are compared in it with
/// what everybody would write.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Library(pub f32);

macro_rules! operator {
    ($trait:ident, $function:ident, $sign:tt) => {
        impl $trait for Library {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl Neg for Library {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Library {
    const EPSILON: f64 = <f32 as Real>::EPSILON;

    fn from_f64(value: f64) -> Self {
        Self(value as f32)
    }
    fn to_f64(self) -> f64 {
        f64::from(self.0)
    }
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    fn atan_unit(self) -> Self {
        Self(self.0.atan())
    }
    fn sin_cos_turns(self) -> (Self, Self) {
        // The reduction is exact, as everywhere: an angle in radians would be rounded first.
        let quarters = (self.0 * 4.0).round();
        let (sin, cos) = ((self.0 * 4.0 - quarters) * std::f32::consts::FRAC_PI_2).sin_cos();
        turn_by_quarters(quarters as i32, Self(sin), Self(cos))
    }
    fn pow(self, exponent: Self) -> Self {
        Self(self.0.powf(exponent.0))
    }
    fn ln_1p(self) -> Self {
        Self(self.0.ln_1p())
    }
    fn exp_m1(self) -> Self {
        Self(self.0.exp_m1())
    }
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    fn hypot(self, other: Self) -> Self {
        // Its result is never -0, of which the library's atan2 makes half a turn.
        Self(self.0.hypot(other.0))
    }
    fn atan2(self, x: Self) -> Self {
        Self(self.0.atan2(x.0))
    }
    fn atan(self) -> Self {
        Self(self.0.atan())
    }
}
