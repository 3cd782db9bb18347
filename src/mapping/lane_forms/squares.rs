//! The octahedral squares.

use super::{Arctangent, LaneForm, SineCosine, sin_cos_quarters, unit, with_sign};
use crate::mapping::octahedral::Octahedral;
use crate::mapping::octahedral_equal_area::OctahedralEqualArea;

/// Folds a point over the diamond's edge; the signs are those of `x` and `z`.
#[inline(always)]
fn fold(along_x: f32, along_z: f32, x: f32, z: f32) -> (f32, f32) {
    (
        with_sign(1.0 - along_z.abs(), x),
        with_sign(1.0 - along_x.abs(), z),
    )
}

impl LaneForm for Octahedral {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        _: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        let scale = 1.0 / (x.abs() + y.abs() + z.abs());
        let (a, b) = (x * scale, z * scale);
        let folded = fold(a, b, x, z);
        let (a, b) = if y < 0.0 { folded } else { (a, b) };
        (0, 0.5 + 0.5 * a, 0.5 + 0.5 * b)
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        _: A,
        _: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        let (a, b) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        let y = 1.0 - a.abs() - b.abs();
        let folded = fold(a, b, a, b);
        let (x, z) = if y < 0.0 { folded } else { (a, b) };
        unit(x, y, z)
    }
}

impl LaneForm for OctahedralEqualArea {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        arctangent: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        let square = x * x + z * z;
        let n = (square + y * y).sqrt();
        // Never above 1 by more than a rounding, which the fold and the clamp stand.
        let radius = (square / (n * (n + y.abs()))).sqrt();
        let (ax, az) = (x.abs(), z.abs());
        let is_steep = az > ax;
        let (small, large) = if is_steep { (ax, az) } else { (az, ax) };
        let divisor = if large > 0.0 { large } else { 1.0 };
        let share = arctangent.quarters::<FUSED>(small / divisor);
        // The smaller coordinate is the radius times this share, the larger what is left.
        let near = radius * share;
        let far = radius - near;
        let (a, b) = if is_steep { (near, far) } else { (far, near) };
        let (a, b) = (with_sign(a, x), with_sign(b, z));
        let folded = fold(a, b, x, z);
        let (a, b) = if y < 0.0 { folded } else { (a, b) };
        (0, 0.5 + 0.5 * a, 0.5 + 0.5 * b)
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        angles: A,
        _: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        let (a, b) = (2.0 * u - 1.0, 2.0 * v - 1.0);
        let is_below = 1.0 - a.abs() - b.abs() < 0.0;
        let folded = fold(a, b, a, b);
        let (a, b) = if is_below { folded } else { (a, b) };
        let radius = a.abs() + b.abs();
        let share = b.abs() / (if radius > 0.0 { radius } else { 1.0 });
        let (sin, cos) = sin_cos_quarters::<A, FUSED>(angles, share);
        // sin(colatitude) = r sqrt(2 - r^2), cos(colatitude) = 1 - r^2.
        let left = 2.0 - radius * radius;
        let across = radius * (if left > 0.0 { left } else { 0.0 }).sqrt();
        let up = (1.0 - radius) * (1.0 + radius);
        [
            with_sign(across * cos, a),
            if is_below { -up } else { up },
            with_sign(across * sin, b),
        ]
    }
}
