//! Maps on discs: sphere map, dual paraboloid, angular map.

use super::{Arctangent, LaneForm, SineCosine, add_angle, sin_cos_quarters};
use crate::mapping::angular::Angular;
use crate::mapping::chart::height_squared;
use crate::mapping::paraboloid::Paraboloid;
use crate::mapping::sphere::Sphere;

/// A point of the plane at a size at which its squares are normal numbers, its length there, and the length as it was;
/// (1, 0) stands for the origin, with length 0.
#[inline(always)]
fn sized(x: f32, y: f32) -> (f32, f32, f32, f32) {
    // Below 2^-50 it is 2^100 times as large: components from 2^-149 to 2^60 get squares from 2^-98 to 2^120.
    const SMALL: f32 = 1.0 / (1_u64 << 50) as f32;
    const UP: f32 = (1.0 / SMALL) * (1.0 / SMALL);
    let is_small = (x.abs() < SMALL) & (y.abs() < SMALL);
    let (up, down) = if is_small { (UP, 1.0 / UP) } else { (1.0, 1.0) };
    let is_zero = (x == 0.0) & (y == 0.0);
    let (x, y) = (if is_zero { 1.0 } else { x * up }, y * up);
    let length = (x * x + y * y).sqrt();
    (x, y, length, if is_zero { 0.0 } else { length * down })
}

impl LaneForm for Sphere {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        _: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        let n = (x * x + y * y + z * z).sqrt();
        let (sx, sy, length, across) = sized(x, y);
        // Ahead, n - z cancels; it is across^2/(n + z), and m/2 is the length times sqrt(1 + slope^2).
        let is_ahead = z > 0.0;
        let slope = if is_ahead { across / (n + z) } else { n - z };
        let half_m = if is_ahead {
            length * (1.0 + slope * slope).sqrt()
        } else {
            (x * x + y * y + slope * slope).sqrt()
        };
        let (x, y) = if is_ahead { (sx, sy) } else { (x, y) };
        let scale = 0.5 / half_m;
        (0, 0.5 + x * scale, 0.5 - y * scale)
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        _: A,
        _: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        let (p, q) = (2.0 * u - 1.0, 1.0 - 2.0 * v);
        let height = height_squared(u, v);
        let w = (if height > 0.0 { height } else { 0.0 }).sqrt();
        let twice = 2.0 * w;
        [twice * p, twice * q, 1.0 - twice * w]
    }
}

impl LaneForm for Paraboloid {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        _: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        let n = (x * x + y * y + z * z).sqrt();
        let scale = 0.5 / (n + z.abs());
        let is_back = z < 0.0;
        let x = if is_back { -x } else { x };
        (u32::from(is_back), 0.5 + x * scale, 0.5 - y * scale)
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        _: A,
        chart: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        let (p, q) = (2.0 * u - 1.0, 1.0 - 2.0 * v);
        let square = p * p + q * q;
        let scale = 1.0 / (1.0 + square);
        let (x, y, z) = (2.0 * p * scale, 2.0 * q * scale, (1.0 - square) * scale);
        let is_front = chart == 0;
        [
            if is_front { x } else { -x },
            y,
            if is_front { z } else { -z },
        ]
    }
}

impl LaneForm for Angular {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        arctangent: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        let (x, y, length, across) = sized(x, y);
        let scale = 0.25 * add_angle::<A, FUSED>(arctangent, 0.0, across, z) / length;
        (0, 0.5 + x * scale, 0.5 - y * scale)
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        angles: A,
        _: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        let (x, y) = (u - 0.5, 0.5 - v);
        let rho = (x * x + y * y).sqrt();
        let (sin, cos) = sin_cos_quarters::<A, FUSED>(angles, 4.0 * rho);
        let scale = if rho > 0.0 { sin / rho } else { 0.0 };
        [x * scale, y * scale, cos]
    }
}
