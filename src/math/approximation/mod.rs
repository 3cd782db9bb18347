//! Ways to approximate the arctangent, sine and cosine of f32, for loops without a branch.
//!
//! Each takes a fraction of what the standard library takes and errs by more. They are written once: with every product
//! and sum rounded, or fused where the processor can (`FUSED`), which is faster and a little nearer.

mod own;
mod published;
mod table;

pub use own::{LEVELS, Level, Own};
pub use published::{Hastings9, Hastings17, Lagarde, Pbrt, Published, Rajan2, Rajan3, Rational};
pub use table::{Table, TableKind};

/// Half of an edge of the continuous cube map as seen from the centre: atan(1/sqrt 2), in radians.
const HALF_EDGE_RAD: f64 = 0.615_479_708_670_387_3;

/// An arctangent, in quarter turns: charts are divided by halves, quarters and eighths of a turn, so that no constant has
/// to follow.
pub trait Arctangent: Copy + Send + Sync + 'static {
    /// Whether it reads memory at places that depend on its argument: then a loop becomes vector instructions only where it
    /// writes to memory that nobody else can know.
    const LOOKS_UP: bool = false;

    /// Arctangent of t in quarter turns, |t| <= 1: within [-1/2, 1/2].
    fn quarters<const FUSED: bool>(self, t: f32) -> f32;

    /// `base` and the arctangent of t in quarter turns.
    #[inline(always)]
    fn add_quarters<const FUSED: bool>(self, base: f32, t: f32) -> f32 {
        base + self.quarters::<FUSED>(t)
    }

    /// 1/2 + atan(a/sqrt 2)/(2 atan(1/sqrt 2)) for |a| <= 1: the place along an edge of the continuous cube map, in [0, 1].
    #[inline(always)]
    fn along_edge<const FUSED: bool>(self, a: f32) -> f32 {
        const EDGES_PER_QUARTER: f32 = (std::f64::consts::FRAC_PI_4 / HALF_EDGE_RAD) as f32;
        let quarters = self.quarters::<FUSED>(a * std::f32::consts::FRAC_1_SQRT_2);
        multiply_add::<FUSED>(quarters, EDGES_PER_QUARTER, 0.5)
    }

    /// 1/(2 quarters(q)) for q = 1/sqrt(1 + s), s in [0, 1]: what the continuous cube map multiplies a latitude in quarter
    /// turns by.
    #[inline(always)]
    fn reach<const FUSED: bool>(self, q: f32, _s: f32) -> f32 {
        0.5 / self.quarters::<FUSED>(q)
    }
}

/// A sine and a cosine.
pub trait SineCosine: Copy + Send + Sync + 'static {
    /// (sin, cos) of `f` quarter turns, |f| <= 1/2.
    fn sin_cos_quarter<const FUSED: bool>(self, f: f32) -> (f32, f32);
}

/// a b + c, rounded once or twice.
#[inline(always)]
pub(crate) fn multiply_add<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// Value of a polynomial, lowest power first; 0 without coefficients.
#[inline(always)]
pub(super) fn horner<const FUSED: bool>(coefficients: &[f32], x: f32) -> f32 {
    let Some((highest, rest)) = coefficients.split_last() else {
        return 0.0;
    };
    let mut sum = *highest;
    for c in rest.iter().rev() {
        sum = multiply_add::<FUSED>(sum, x, *c);
    }
    sum
}
