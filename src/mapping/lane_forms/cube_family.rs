//! The cube family: the face and its frame, then the warp.

use std::f64::consts::{FRAC_1_PI, SQRT_2};

use super::{Arctangent, LaneForm, SineCosine, unit};
use crate::mapping::ccm::{Ccm, HALF_EDGE_RAD};
use crate::mapping::cube::Cube;
use crate::mapping::cube_face::{largest_component_lane, sign_table_lane};
use crate::mapping::eac::Eac;
use crate::mapping::face_map::FaceMap;
use crate::math::approximation::multiply_add;

/// The direction with these coordinates in the frame of a face.
#[inline(always)]
fn from_frame(face: u32, across: f32, down: f32, axis: f32) -> [f32; 3] {
    let (is_x, is_y, is_negative) = (face < 2, face & 6 == 2, face & 1 != 0);
    let axis = if is_negative { -axis } else { axis };
    let turned = if is_negative & !is_y { -across } else { across };
    let down_y = if is_negative { -down } else { down };
    [
        if is_x { axis } else { turned },
        if is_y { axis } else { -down },
        if is_x {
            -turned
        } else if is_y {
            down_y
        } else {
            axis
        },
    ]
}

impl LaneForm for Cube {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        _: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        let d = largest_component_lane(x, y, z);
        let scale = 0.5 / d.axis;
        (
            d.face,
            multiply_add::<FUSED>(d.across, scale, 0.5),
            multiply_add::<FUSED>(d.down, scale, 0.5),
        )
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        _: A,
        chart: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        let [a, b, c] = unit(2.0 * u - 1.0, 2.0 * v - 1.0, 1.0);
        from_frame(chart, a, b, c)
    }
}

impl<F: FaceMap> LaneForm for F {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        _: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        let d = largest_component_lane(x, y, z);
        let scale = 1.0 / d.axis;
        let (p, q) = F::from_plane(d.across * scale, d.down * scale);
        (
            d.face,
            multiply_add::<FUSED>(p, 0.5, 0.5),
            multiply_add::<FUSED>(q, 0.5, 0.5),
        )
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        _: A,
        chart: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        let (a, b) = F::to_plane(2.0 * u - 1.0, 2.0 * v - 1.0);
        let [a, b, c] = unit(a, b, 1.0);
        from_frame(chart, a, b, c)
    }
}

impl LaneForm for Eac {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        arctangent: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        let d = largest_component_lane(x, y, z);
        let scale = 1.0 / d.axis;
        (
            d.face,
            arctangent.add_quarters::<FUSED>(0.5, d.across * scale),
            arctangent.add_quarters::<FUSED>(0.5, d.down * scale),
        )
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        angles: A,
        chart: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        let (sin_u, cos_u) = angles.sin_cos_quarter::<FUSED>(u - 0.5);
        let (sin_v, cos_v) = angles.sin_cos_quarter::<FUSED>(v - 0.5);
        // The tangents and 1, times both cosines.
        let [a, b, c] = unit(sin_u * cos_v, sin_v * cos_u, cos_u * cos_v);
        from_frame(chart, a, b, c)
    }
}

/// With the axis m, p along the edges that are divided by arc length and t the other component, h = sqrt(p^2 + m^2):
/// a = p/m and b q = t/h, and one division gives both. The latitude's largest value needs no arctangent, as it depends on
/// a^2 alone.
impl LaneForm for Ccm {
    #[inline(always)]
    fn chart_point<A: Arctangent, const FUSED: bool>(
        arctangent: A,
        x: f32,
        y: f32,
        z: f32,
    ) -> (u32, f32, f32) {
        let d = sign_table_lane(x, y, z);
        let is_x = d.face < 2;
        let (p, t) = if is_x {
            (d.down, d.across)
        } else {
            (d.across, d.down)
        };
        let h = multiply_add::<FUSED>(p, p, d.axis * d.axis).sqrt();
        let scale = 1.0 / (d.axis * h);
        let (per_axis, per_h) = (h * scale, d.axis * scale);
        let a = p * per_axis;
        let latitude = arctangent.quarters::<FUSED>(t * per_h);
        let reach = arctangent.reach::<FUSED>(d.axis * per_h, a * a);
        let along = arctangent.along_edge::<FUSED>(a);
        let across = multiply_add::<FUSED>(latitude, reach, 0.5);
        if is_x {
            (d.face, across, along)
        } else {
            (d.face, along, across)
        }
    }

    #[inline(always)]
    fn direction<A: Arctangent + SineCosine, const FUSED: bool>(
        angles: A,
        chart: u32,
        u: f32,
        v: f32,
    ) -> [f32; 3] {
        /// Quarter turns in an edge.
        const EDGE: f32 = (4.0 * HALF_EDGE_RAD * FRAC_1_PI) as f32;
        let is_x = chart < 2;
        let (l, m) = if is_x { (v, u) } else { (u, v) };
        let (sin, cos) = angles.sin_cos_quarter::<FUSED>((l - 0.5) * EDGE);
        // a = sqrt 2 sin/cos, so 1 + a^2 is (1 + sin^2)/cos^2.
        let scale = 1.0 / multiply_add::<FUSED>(sin, sin, 1.0).sqrt();
        let (q, qa) = (cos * scale, (SQRT_2 as f32 * sin) * scale);
        let reach = 2.0 * angles.quarters::<FUSED>(q);
        let (height, cos) = angles.sin_cos_quarter::<FUSED>((m - 0.5) * reach);
        let (along, axis) = (cos * qa, cos * q);
        let (across, down) = if is_x {
            (height, along)
        } else {
            (along, height)
        };
        from_frame(chart, across, down, axis)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mapping::cube_face;
    use crate::math::Vec3;
    use crate::math::inputs::{Random, SIGN_PATTERNS};

    #[test]
    fn faces_are_those_of_the_tables() {
        let mut random = Random::new(5);
        let patterns = SIGN_PATTERNS.map(|signs| signs.map(f32::from));
        let near = (0..100_000).map(|_| random.adversarial());
        let mut disagree = 0;
        for [x, y, z] in patterns.into_iter().chain(near) {
            let dir = Vec3::new(x, y, z);
            let table = cube_face::sign_table(dir);
            assert_eq!(sign_table_lane(x, y, z).face, table, "{dir:?}");
            let largest = cube_face::largest_component(dir);
            assert_eq!(largest_component_lane(x, y, z).face, largest, "{dir:?}");
            disagree += u32::from(table != largest);
            let d = sign_table_lane(x, y, z);
            assert_eq!(from_frame(d.face, d.across, d.down, d.axis), [x, y, z]);
        }
        assert!(disagree > 100, "the rules differ on ties: {disagree}");
    }
}
