//! The number trait: one text of every formula serves f32, f64 and dual numbers.
//!
//! Only operations that stay accurate over their whole domain are here. `asin` and `acos` lose half the digits near
//! their ends, so a mapping cannot call them: they live in [`Textbook`], for the seeds' own conventions and evaluators.

use std::fmt::{Debug, Display};
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::{arctan, logarithm};

/// A real number type in which mappings are computed.
///
/// Comparisons look at the value alone (a dual number's derivative takes no part), so that branches fall alike in
/// every type. Angles in turns (1 = a full circle) are reduced exactly; radians would round first.
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// Distance from 1 to the next larger number of the type.
    const EPSILON: f64;

    /// The number of the type nearest to `value`.
    fn from_f64(value: f64) -> Self;
    /// The value as f64 (exact for f32; a dual number's derivative is dropped).
    fn to_f64(self) -> f64;
    /// Square root; the argument is not negative.
    fn sqrt(self) -> Self;
    /// Arctangent of t for |t| <= 1, in radians.
    fn atan_unit(self) -> Self;
    /// (sin, cos) of an angle given in turns, for |turns| <= 2.
    fn sin_cos_turns(self) -> (Self, Self);
    /// `self` to the power `exponent`; `self` is not negative and `exponent` is a constant (its derivative takes no part).
    fn pow(self, exponent: Self) -> Self;
    /// ln(1 + self) for self >= 0, exact in all digits of a small one too.
    fn ln_1p(self) -> Self;
    /// e^self - 1 for |self| <= 40, exact in all digits of a small one too.
    fn exp_m1(self) -> Self;
    /// True for neither NaN nor infinite.
    fn is_finite(self) -> bool;

    /// 0.
    fn zero() -> Self {
        Self::from_f64(0.0)
    }
    /// 1.
    fn one() -> Self {
        Self::from_f64(1.0)
    }
    /// 1/2.
    fn half() -> Self {
        Self::from_f64(0.5)
    }
    /// 2.
    fn two() -> Self {
        Self::from_f64(2.0)
    }
    /// |self|.
    fn abs(self) -> Self {
        if self < Self::zero() { -self } else { self }
    }
    /// The smaller of two; `other` when they cannot be compared.
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }
    /// The larger of two; `other` when they cannot be compared.
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
    /// Clamped to [0, 1]; the last step of every forward mapping, since a rounding may leave by one ULP.
    fn clamp_unit(self) -> Self {
        self.max(Self::zero()).min(Self::one())
    }
    /// +1 for zero and above, -1 below: the sign with sgn 0 = +1 that octahedral folding needs.
    fn sign_or_one(self) -> Self {
        if self < Self::zero() {
            -Self::one()
        } else {
            Self::one()
        }
    }
    /// sqrt(self^2 + other^2) without overflow, underflow or cancellation.
    fn hypot(self, other: Self) -> Self {
        let (a, b) = (self.abs(), other.abs());
        let (large, small) = if a < b { (b, a) } else { (a, b) };
        if large <= Self::zero() {
            return large;
        }
        let ratio = small / large;
        large * (Self::one() + ratio * ratio).sqrt()
    }
    /// Angle of the point (x, y) = (`x`, `self`) in radians, in [-pi, pi]; 0 at the origin.
    ///
    /// The argument of the arctangent is the smaller component over the larger, so it never leaves [0, 1].
    fn atan2(self, x: Self) -> Self {
        let (ay, ax) = (self.abs(), x.abs());
        if !(ax > Self::zero() || ay > Self::zero()) {
            return Self::zero();
        }
        let mut angle = if ay > ax {
            Self::from_f64(std::f64::consts::FRAC_PI_2) - (ax / ay).atan_unit()
        } else {
            (ay / ax).atan_unit()
        };
        if x < Self::zero() {
            angle = Self::from_f64(std::f64::consts::PI) - angle;
        }
        if self < Self::zero() { -angle } else { angle }
    }
    /// Arctangent in radians for any finite argument.
    fn atan(self) -> Self {
        self.atan2(Self::one())
    }
    /// Tangent of an angle given in turns, |turns| < 1/4.
    fn tan_turns(self) -> Self {
        let (sin, cos) = self.sin_cos_turns();
        sin / cos
    }
}

/// The functions of the seed articles that the stable forms avoid. Conventions and evaluators only.
pub trait Textbook: Real + Display {
    /// Arcsine in radians.
    fn asin(self) -> Self;
    /// Arccosine in radians.
    fn acos(self) -> Self;
    /// Smallest integer not below the number.
    fn ceil(self) -> Self;
    /// Largest integer not above the number.
    fn floor(self) -> Self;
    /// The library's own atan2 (not ours).
    fn library_atan2(self, x: Self) -> Self;
    /// The library's own tangent, of an angle in radians.
    fn tan_rad(self) -> Self;
    /// The library's own sine and cosine, of an angle in radians.
    fn sin_cos_rad(self) -> (Self, Self);
}

macro_rules! textbook {
    ($float:ty) => {
        impl Textbook for $float {
            fn asin(self) -> Self {
                <$float>::asin(self)
            }
            fn acos(self) -> Self {
                <$float>::acos(self)
            }
            fn ceil(self) -> Self {
                <$float>::ceil(self)
            }
            fn floor(self) -> Self {
                <$float>::floor(self)
            }
            fn library_atan2(self, x: Self) -> Self {
                <$float>::atan2(self, x)
            }
            fn tan_rad(self) -> Self {
                <$float>::tan(self)
            }
            fn sin_cos_rad(self) -> (Self, Self) {
                <$float>::sin_cos(self)
            }
        }
    };
}
textbook!(f32);
textbook!(f64);

impl Real for f32 {
    const EPSILON: f64 = f32::EPSILON as f64;

    fn from_f64(value: f64) -> Self {
        value as f32
    }
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    fn sqrt(self) -> Self {
        f32::sqrt(self)
    }
    fn atan_unit(self) -> Self {
        arctan::atan_unit(self)
    }
    fn sin_cos_turns(self) -> (Self, Self) {
        arctan::sin_cos_turns(self)
    }
    fn pow(self, exponent: Self) -> Self {
        self.powf(exponent)
    }
    fn ln_1p(self) -> Self {
        logarithm::ln_1p(self)
    }
    fn exp_m1(self) -> Self {
        logarithm::exp_m1(self)
    }
    fn is_finite(self) -> bool {
        f32::is_finite(self)
    }
}

impl Real for f64 {
    const EPSILON: f64 = f64::EPSILON;

    fn from_f64(value: f64) -> Self {
        value
    }
    fn to_f64(self) -> f64 {
        self
    }
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    fn atan_unit(self) -> Self {
        f64::atan(self)
    }
    fn sin_cos_turns(self) -> (Self, Self) {
        // Quarter turns and a remainder in [-1/2, 1/2] quarter: both exact, so only the last product rounds.
        let quarters = (self * 4.0).round();
        let (sin, cos) = ((self * 4.0 - quarters) * std::f64::consts::FRAC_PI_2).sin_cos();
        arctan::turn_by_quarters(quarters.to_f64() as i32, sin, cos)
    }
    fn pow(self, exponent: Self) -> Self {
        self.powf(exponent)
    }
    fn ln_1p(self) -> Self {
        f64::ln_1p(self)
    }
    fn exp_m1(self) -> Self {
        f64::exp_m1(self)
    }
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}
