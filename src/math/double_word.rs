//! Sums and products that keep twice the digits of their type, for differences that cancel.
//!
//! Error-free transformations of Knuth (two-sum) and Dekker and Veltkamp (two-product), put together as in Joldes, Muller
//! and Popescu, "Tight and rigorous error bounds for basic building blocks of double-word arithmetic" (2017), and the sum
//! of Ogita, Rump and Oishi, "Accurate sum and dot product" (2005). They need rounding to nearest and no overflow, which Rust
//! gives; a shader's compiler may reorder, so that `shaders/optics.wgsl` goes another way.

use std::ops::{Add, Div, Mul, Neg};

use super::{Real, Vec3};

/// The unevaluated sum of two numbers, the second below half a unit in the last place of the first. With u half the type's
/// epsilon, every operation here is within 10 u^2 of its result, for f32 4e-14.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleWord<R> {
    /// The number rounded to its type.
    pub high: R,
    /// What the rounding left.
    pub low: R,
}

impl<R: Real> DoubleWord<R> {
    /// a + b exactly.
    pub fn sum(a: R, b: R) -> Self {
        let high = a + b;
        let b_part = high - a;
        let a_part = high - b_part;
        Self {
            high,
            low: (a - a_part) + (b - b_part),
        }
    }

    /// a + b exactly, for |a| >= |b|.
    fn quick_sum(a: R, b: R) -> Self {
        let high = a + b;
        Self {
            high,
            low: b - (high - a),
        }
    }

    /// a b exactly.
    pub fn product(a: R, b: R) -> Self {
        let high = a * b;
        let (a_high, a_low) = halves(a);
        let (b_high, b_low) = halves(b);
        let low = ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low;
        Self { high, low }
    }

    /// The inner product of two vectors, to about three times the digits of its type before it is rounded to two: its
    /// sign and its leading digits are right also where the terms cancel.
    pub fn dot(a: Vec3<R>, b: Vec3<R>) -> Self {
        let [x, y, z] = [
            Self::product(a.x, b.x),
            Self::product(a.y, b.y),
            Self::product(a.z, b.z),
        ];
        let (low, rest) = distil(x.low, [y.low, z.low, x.high, y.high, z.high]);
        let (high, [p, q, r, s, t]) = distil(low, rest);
        Self::sum(high, (((p + q) + r) + s) + t)
    }
}

/// Adds from left to right without loss: the rounded sum, and what each step left.
fn distil<R: Real, const N: usize>(first: R, others: [R; N]) -> (R, [R; N]) {
    let mut sum = first;
    let left = others.map(|term| {
        let step = DoubleWord::sum(sum, term);
        sum = step.high;
        step.low
    });
    (sum, left)
}

/// A number as a sum of two with half its digits each.
fn halves<R: Real>(x: R) -> (R, R) {
    // Veltkamp's constant 2^s + 1 with s half the number of digits p, rounded up; epsilon is 2^(1 - p).
    let digits = 1.0 - R::EPSILON.log2();
    let scaled = x * R::from_f64((0.5 * digits).ceil().exp2() + 1.0);
    let high = scaled - (scaled - x);
    (high, x - high)
}

impl<R: Real> From<R> for DoubleWord<R> {
    fn from(x: R) -> Self {
        Self {
            high: x,
            low: R::zero(),
        }
    }
}

impl<R: Real> Neg for DoubleWord<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl<R: Real> Add for DoubleWord<R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = Self::sum(self.high, other.high);
        let low = Self::sum(self.low, other.low);
        let near = Self::quick_sum(high.high, high.low + low.high);
        Self::quick_sum(near.high, low.low + near.low)
    }
}

impl<R: Real> Mul for DoubleWord<R> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        Self::quick_sum(product.high, product.low + cross)
    }
}

impl<R: Real> Div for DoubleWord<R> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let guess = self.high / other.high;
        let left = self + -(other * guess.into());
        Self::quick_sum(guess, left.high / other.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wide(x: DoubleWord<f32>) -> f64 {
        f64::from(x.high) + f64::from(x.low)
    }

    #[test]
    fn twice_the_digits_are_kept() {
        let (a, b) = (1.000_123_4_f32, -0.777_654_3_f32);
        assert_eq!(wide(DoubleWord::product(a, b)), f64::from(a) * f64::from(b));
        assert_eq!(
            wide(DoubleWord::sum(a, 1e-9)),
            f64::from(a) + f64::from(1e-9_f32)
        );
        let (x, y) = (DoubleWord::sum(a, 3e-9), DoubleWord::sum(b, -2e-9));
        for (found, right) in [
            (x + y, wide(x) + wide(y)),
            (x * y, wide(x) * wide(y)),
            (x / y, wide(x) / wide(y)),
        ] {
            let error = (wide(found) / right - 1.0).abs();
            assert!(error < 4e-14, "{error}");
            assert!((f64::from(found.high) / right - 1.0).abs() > 4e-14);
        }
    }

    #[test]
    fn an_inner_product_that_cancels_keeps_its_sign() {
        let a = Vec3::new(1.0_f32, 1.0 + f32::EPSILON, 1e-9);
        let b = Vec3::new(-1.0 - 2.0 * f32::EPSILON, 1.0 + f32::EPSILON, -1e-6);
        // The squares of epsilon are left, less the last term.
        let right = f64::from(f32::EPSILON).powi(2) - f64::from(1e-9_f32) * f64::from(1e-6_f32);
        let found = DoubleWord::dot(a, b);
        assert!((wide(found) / right - 1.0).abs() < 1e-12);
        assert!((f64::from(a.dot(b)) / right - 1.0).abs() > 1e-3);
    }
}
