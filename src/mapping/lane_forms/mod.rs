//! Formulas without a branch, for any arctangent: a loop over them becomes vector instructions.
//!
//! A form takes directions whose largest component lies within [`SIZES`], where squares keep their digits. [`forward`] brings the
//! others there, one by one, by a power of two, and leaves out what is no direction.

mod cube_family;
mod discs;
mod latlong;
mod squares;

use std::marker::PhantomData;
use std::ops::RangeInclusive;

use pulp::NullaryFnOnce;

use super::chart::MappingInfo;
use super::slices::{Dirs, DirsMut, NOWHERE, Points, PointsMut};
use super::{Domain, Mapping};
use crate::math::approximation::{Arctangent, SineCosine};
use crate::math::{Isa, Vec3, nearest_whole};

/// Largest components that a form takes. No square overflows; and of components down to 2^-39 of the largest, whose angle f32
/// shows, none is subnormal.
const SIZES: RangeInclusive<f32> = 1.0 / (1_u64 << 24) as f32..=(1_u64 << 60) as f32;

/// A mapping's formula without a branch. `FUSED` says whether products and sums are fused, as far as the form uses it.
pub trait LaneForm: Mapping {
    /// Chart and (u, v), not yet clamped, of a direction.
    fn chart_point<A: Arctangent, const FUSED: bool>(
        arctangent: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32);

    /// The unit direction of a point on a chart.
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        angles: A,
        chart: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3];
}

/// Chart points of directions by a form, compiled for the given instructions.
pub fn forward<M: LaneForm, A: Arctangent>(
    isa: Isa,
    angles: A,
    dirs: Dirs<'_>,
    points: PointsMut<'_>,
) {
    let form = PhantomData::<M>;
    if isa.available() == Isa::Baseline {
        isa.run(Forward::<M, A, false> {
            form,
            angles,
            dirs,
            points,
        });
    } else {
        isa.run(Forward::<M, A, true> {
            form,
            angles,
            dirs,
            points,
        });
    }
}

/// Unit directions of chart points by a form, compiled for the given instructions; the zero vector off the chart.
pub fn inverse<M: LaneForm, A: Arctangent + SineCosine>(
    isa: Isa,
    angles: A,
    points: Points<'_>,
    dirs: DirsMut<'_>,
) {
    let form = PhantomData::<M>;
    if isa.available() == Isa::Baseline {
        isa.run(Inverse::<M, A, false> {
            form,
            angles,
            points,
            dirs,
        });
    } else {
        isa.run(Inverse::<M, A, true> {
            form,
            angles,
            points,
            dirs,
        });
    }
}

struct Forward<'a, M, A, const FUSED: bool> {
    form: PhantomData<M>,
    angles: A,
    dirs: Dirs<'a>,
    points: PointsMut<'a>,
}

/// Directions that are looked through before they are computed: 3 KiB, which stay in the first-level cache.
const BLOCK: usize = 256;

impl<M: LaneForm, A: Arctangent, const FUSED: bool> NullaryFnOnce for Forward<'_, M, A, FUSED> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { dirs, points, .. } = self;
        let count = dirs.len().min(points.len());
        let mut own = ([0_u32; BLOCK], [0.0_f32; BLOCK], [0.0_f32; BLOCK]);
        for start in (0..count).step_by(BLOCK) {
            let range = start..count.min(start + BLOCK);
            // Slices of one length, so that no bound is checked inside the loop.
            let (x, y, z) = (
                &dirs.x[range.clone()],
                &dirs.y[range.clone()],
                &dirs.z[range.clone()],
            );
            let (chart, u, v) = (
                &mut points.chart[range.clone()],
                &mut points.u[range.clone()],
                &mut points.v[range],
            );
            let n = x.len();
            let (y, z) = (&y[..n], &z[..n]);
            let (chart, u, v) = (&mut chart[..n], &mut u[..n], &mut v[..n]);
            let mut fits = true;
            for k in 0..n {
                fits &= fits_sizes(x[k], y[k], z[k]);
            }
            if fits && A::LOOKS_UP {
                let (charts, us, vs) = (&mut own.0[..n], &mut own.1[..n], &mut own.2[..n]);
                for k in 0..n {
                    (charts[k], us[k], vs[k]) =
                        clamped_point::<M, A, FUSED>(self.angles, x[k], y[k], z[k]);
                }
                chart.copy_from_slice(charts);
                u.copy_from_slice(us);
                v.copy_from_slice(vs);
                continue;
            }
            if fits {
                for k in 0..n {
                    (chart[k], u[k], v[k]) =
                        clamped_point::<M, A, FUSED>(self.angles, x[k], y[k], z[k]);
                }
                continue;
            }
            for k in 0..n {
                let dir = Vec3::new(x[k], y[k], z[k]);
                (chart[k], u[k], v[k]) = match dir.scaled_direction().map(near_one) {
                    Some(d) => clamped_point::<M, A, FUSED>(
                        self.angles,
                        with_side(d.x, dir.x),
                        with_side(d.y, dir.y),
                        with_side(d.z, dir.z),
                    ),
                    None => (NOWHERE, 0.0, 0.0),
                };
            }
        }
    }
}

struct Inverse<'a, M, A, const FUSED: bool> {
    form: PhantomData<M>,
    angles: A,
    points: Points<'a>,
    dirs: DirsMut<'a>,
}

impl<M: LaneForm, A: Arctangent + SineCosine, const FUSED: bool> NullaryFnOnce
    for Inverse<'_, M, A, FUSED>
{
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { points, dirs, .. } = self;
        let count = points.len().min(dirs.len());
        let mut own = [[0.0_f32; BLOCK]; 3];
        for start in (0..count).step_by(BLOCK) {
            let range = start..count.min(start + BLOCK);
            let (chart, u, v) = (
                &points.chart[range.clone()],
                &points.u[range.clone()],
                &points.v[range.clone()],
            );
            let (x, y, z) = (
                &mut dirs.x[range.clone()],
                &mut dirs.y[range.clone()],
                &mut dirs.z[range],
            );
            let n = chart.len();
            let (u, v) = (&u[..n], &v[..n]);
            let (x, y, z) = (&mut x[..n], &mut y[..n], &mut z[..n]);
            if A::LOOKS_UP {
                let [xs, ys, zs] = &mut own;
                let (xs, ys, zs) = (&mut xs[..n], &mut ys[..n], &mut zs[..n]);
                for k in 0..n {
                    [xs[k], ys[k], zs[k]] =
                        kept_direction::<M, A, FUSED>(self.angles, chart[k], u[k], v[k]);
                }
                x.copy_from_slice(xs);
                y.copy_from_slice(ys);
                z.copy_from_slice(zs);
                continue;
            }
            for k in 0..n {
                [x[k], y[k], z[k]] =
                    kept_direction::<M, A, FUSED>(self.angles, chart[k], u[k], v[k]);
            }
        }
    }
}

// Functions and not closures: a closure that is called from two places may be left a call, and then no loop around it
// becomes vector instructions.

/// A form's chart point, clamped to the chart.
#[inline(always)]
fn clamped_point<M: LaneForm, A: Arctangent, const FUSED: bool>(
    angles: A,
    x: f32,
    y: f32,
    z: f32,
) -> (u32, f32, f32) {
    let (chart, u, v) = M::chart_point::<A, FUSED>(angles, x, y, z);
    (chart, clamp_unit(u), clamp_unit(v))
}

/// The direction times a power of two that brings its largest component, which lies within 2^-60 and 2^60, into [1, 2).
fn near_one(dir: Vec3<f32>) -> Vec3<f32> {
    const EXPONENT: u32 = 0xFF << 23;
    // Twice the bias of exponents, less this one's.
    dir * f32::from_bits((254 << 23) - (dir.max_abs().to_bits() & EXPONENT))
}

/// The scaled component, or the smallest number on its side of 0 where scaling has made it 0: charts are told apart by signs.
fn with_side(scaled: f32, given: f32) -> f32 {
    if scaled == 0.0 && given != 0.0 {
        f32::from_bits(1).copysign(given)
    } else {
        scaled
    }
}

/// A form's direction, zero off the chart.
#[inline(always)]
fn kept_direction<M: LaneForm, A: Arctangent + SineCosine, const FUSED: bool>(
    angles: A,
    chart: u32,
    u: f32,
    v: f32,
) -> [f32; 3] {
    let [x, y, z] = M::direction::<A, FUSED>(angles, chart, u, v);
    if is_on(&M::INFO, chart, u, v) {
        [x, y, z]
    } else {
        [0.0; 3]
    }
}

/// Whether the largest component lies within [`SIZES`]; the bits of positive floats are ordered as the floats are, and NaN
/// lies above them all.
#[inline(always)]
fn fits_sizes(x: f32, y: f32, z: f32) -> bool {
    let size = |c: f32| c.to_bits() & (u32::MAX >> 1);
    let larger = |a: u32, b: u32| if a > b { a } else { b };
    let largest = larger(larger(size(x), size(y)), size(z));
    (largest >= SIZES.start().to_bits()) & (largest <= SIZES.end().to_bits())
}

/// [`super::ChartPoint::is_on`] and [`Domain::contains`] without a branch.
#[inline(always)]
#[expect(
    clippy::manual_range_contains,
    reason = "a range looks no further when the first comparison fails: a branch"
)]
fn is_on(info: &MappingInfo, chart: u32, u: f32, v: f32) -> bool {
    let in_square = (u >= 0.0) & (u <= 1.0) & (v >= 0.0) & (v <= 1.0);
    let in_domain = match info.domain {
        Domain::Square => true,
        Domain::Disc => Domain::Disc.contains(u, v),
    };
    (chart < info.chart_count()) & in_square & in_domain
}

/// Clamped to [0, 1] by two comparisons, without the care for NaN that `f32::clamp` takes.
#[inline(always)]
fn clamp_unit(c: f32) -> f32 {
    let c = if c > 0.0 { c } else { 0.0 };
    if c < 1.0 { c } else { 1.0 }
}

/// `base` and the angle of the point (x, y) in quarter turns within [-2, 2], 0 for the origin; rounded once where the
/// arctangent can.
#[inline(always)]
fn add_angle<A: Arctangent, const FUSED: bool>(arctangent: A, base: f32, y: f32, x: f32) -> f32 {
    let (ax, ay) = (x.abs(), y.abs());
    let is_steep = ay > ax;
    let (small, large) = if is_steep { (ax, ay) } else { (ay, ax) };
    let t = small / (if large > 0.0 { large } else { 1.0 });
    // Mirrored at the diagonal, at the y axis, at the x axis.
    let (whole, t) = if is_steep { (1.0, -t) } else { (0.0, t) };
    let (whole, t) = if x < 0.0 {
        (2.0 - whole, -t)
    } else {
        (whole, t)
    };
    let (whole, t) = if y < 0.0 { (-whole, -t) } else { (whole, t) };
    arctangent.add_quarters::<FUSED>(base + whole, t)
}

/// (sin, cos) of quarter turns.
#[inline(always)]
fn sin_cos_quarters<A: SineCosine, const FUSED: bool>(angles: A, quarters: f32) -> (f32, f32) {
    let whole = nearest_whole(quarters);
    let (sin, cos) = angles.sin_cos_quarter::<FUSED>(quarters - whole as f32);
    let is_odd = whole & 1 != 0;
    let (sin, cos) = if is_odd { (cos, sin) } else { (sin, cos) };
    let sin = if whole & 2 != 0 { -sin } else { sin };
    let cos = if whole.wrapping_add(1) & 2 != 0 {
        -cos
    } else {
        cos
    };
    (sin, cos)
}

/// The vector at length 1.
#[inline(always)]
fn unit(x: f32, y: f32, z: f32) -> [f32; 3] {
    let scale = 1.0 / (x * x + y * y + z * z).sqrt();
    [x * scale, y * scale, z * scale]
}

/// `magnitude` >= 0 with the sign of `sign`; zero of either sign counts as positive.
#[inline(always)]
fn with_sign(magnitude: f32, sign: f32) -> f32 {
    if sign < 0.0 { -magnitude } else { magnitude }
}
