//! Dual numbers: a value and its derivatives in N directions, carried through the same text as the value.
//!
//! Running a mapping's inverse on `Dual<_, 2>` gives its Jacobian to the last digit, hence the solid angle of a texel,
//! Tissot's indicatrix and texel density, without finite differences.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Real;

/// value + sum of `derivative[i]` e_i with e_i e_j = 0.
#[derive(Clone, Copy, Debug)]
pub struct Dual<R, const N: usize> {
    /// The value.
    pub value: R,
    /// Its partial derivatives.
    pub derivative: [R; N],
}

impl<R: Real, const N: usize> Dual<R, N> {
    /// A constant: all derivatives are zero.
    pub fn constant(value: R) -> Self {
        Self {
            value,
            derivative: [R::zero(); N],
        }
    }

    /// The independent variable number `index` (below N) at `value`.
    pub fn variable(value: R, index: usize) -> Self {
        let derivative = std::array::from_fn(|i| if i == index { R::one() } else { R::zero() });
        Self { value, derivative }
    }

    /// f(self) given f's value and slope there.
    fn chain(self, value: R, slope: R) -> Self {
        Self {
            value,
            derivative: self.derivative.map(|d| d * slope),
        }
    }

    /// Both operands' derivatives, combined.
    fn combine(self, other: Self, value: R, f: impl Fn(R, R) -> R) -> Self {
        let derivative = std::array::from_fn(|i| f(self.derivative[i], other.derivative[i]));
        Self { value, derivative }
    }
}

impl<R: Real, const N: usize> PartialEq for Dual<R, N> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<R: Real, const N: usize> PartialOrd for Dual<R, N> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<R: Real, const N: usize> Add for Dual<R, N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, self.value + other.value, |a, b| a + b)
    }
}

impl<R: Real, const N: usize> Sub for Dual<R, N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combine(other, self.value - other.value, |a, b| a - b)
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "the product rule adds")]
impl<R: Real, const N: usize> Mul for Dual<R, N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, self.value * other.value, |a, b| {
            a * other.value + self.value * b
        })
    }
}

#[expect(
    clippy::suspicious_arithmetic_impl,
    reason = "the quotient rule subtracts"
)]
impl<R: Real, const N: usize> Div for Dual<R, N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.combine(other, value, |a, b| (a - value * b) / other.value)
    }
}

impl<R: Real, const N: usize> Neg for Dual<R, N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.chain(-self.value, -R::one())
    }
}

impl<R: Real, const N: usize> Real for Dual<R, N> {
    const EPSILON: f64 = R::EPSILON;

    fn from_f64(value: f64) -> Self {
        Self::constant(R::from_f64(value))
    }
    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, R::half() / root)
    }
    fn atan_unit(self) -> Self {
        let slope = R::one() / (R::one() + self.value * self.value);
        self.chain(self.value.atan_unit(), slope)
    }
    fn sin_cos_turns(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos_turns();
        let rad_per_turn = R::from_f64(std::f64::consts::TAU);
        (
            self.chain(sin, cos * rad_per_turn),
            self.chain(cos, -sin * rad_per_turn),
        )
    }
    fn pow(self, exponent: Self) -> Self {
        let slope = exponent.value * self.value.pow(exponent.value - R::one());
        self.chain(self.value.pow(exponent.value), slope)
    }
    fn ln_1p(self) -> Self {
        self.chain(self.value.ln_1p(), R::one() / (R::one() + self.value))
    }
    fn exp_m1(self) -> Self {
        let value = self.value.exp_m1();
        self.chain(value, value + R::one())
    }
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }
}
