//! The seeds' own numbers for the same map, and where they print it wrongly.

use super::ChartPoint;
use crate::math::Vec3;

/// A forward function in one number type.
pub type ForwardFn<R> = fn(Vec3<R>) -> Option<ChartPoint<R>>;
/// An inverse function in one number type.
pub type InverseFn<R> = fn(ChartPoint<R>) -> Option<Vec3<R>>;

/// Another way to number the charts and to lay the axes, as a publication has it.
///
/// The direction is always a direction: a formula that is printed for unit vectors gets a unit vector.
#[derive(Debug)]
pub struct Convention {
    /// Name on the command line.
    pub id: &'static str,
    /// What differs, and whose it is.
    pub about: &'static str,
    /// Names of the three numbers.
    pub columns: [&'static str; 3],
    /// Forward in f32 and f64.
    pub forward: (ForwardFn<f32>, ForwardFn<f64>),
    /// Inverse in f32 and f64; `None` where the printed formula has none.
    pub inverse: Option<(InverseFn<f32>, InverseFn<f64>)>,
}

/// An equation as printed beside the right one.
#[derive(Debug)]
pub struct Erratum {
    /// Short name of the finding.
    pub id: &'static str,
    /// The equation as printed.
    pub printed: &'static str,
    /// The right equation.
    pub right: &'static str,
    /// Why it is wrong.
    pub why: &'static str,
    /// Both values for a direction, printed then right; `None` for a vector that is no direction.
    pub values: fn(Vec3<f64>) -> Option<(f64, f64)>,
}
