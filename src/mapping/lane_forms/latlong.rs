//! Latlong.

use super::{Arctangent, LaneForm, SineCosine, add_angle, sin_cos_quarters};
use crate::mapping::latlong::Latlong;

impl LaneForm for Latlong {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        arctangent: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        // Where a square underflows its part of the colatitude is below 1e-11 rad, and the longitude does not need it.
        let across = (x * x + z * z).sqrt();
        let longitude = add_angle::<A, FUSED>(arctangent, 2.0, x, z);
        let colatitude = add_angle::<A, FUSED>(arctangent, 0.0, across, y);
        (0, 0.25 * longitude, 0.5 * colatitude)
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        angles: A,
        _: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        let (sin_u, cos_u) = sin_cos_quarters::<A, FUSED>(angles, 4.0 * (u - 0.5));
        let (sin_v, cos_v) = sin_cos_quarters::<A, FUSED>(angles, 2.0 * v);
        [sin_v * sin_u, cos_v, sin_v * cos_u]
    }
}
