//! Cube map: six pictures taken with a square field of view of 90 degrees, the gnomonic plane as it is.

use super::chart::{to_signed, to_unit};
use super::cube_face::{
    self, face_lanes, frame_lanes, from_gnomonic, gnomonic, is_side, largest_component,
    largest_component_lane, shallow_latitudes,
};
use super::evaluator;
use super::{
    AngleLanes, ChartPoint, Convention, DirLanes, Lane, Line, Mapping, MappingInfo, PointLanes,
    ShaderForm, Step,
};
use crate::math::{Real, Vec3};

/// See the [module](self).
pub struct Cube;

impl Mapping for Cube {
    const INFO: MappingInfo = MappingInfo {
        id: "cube",
        name: "Cube map",
        about: "Six flat pictures: one division, hardware everywhere, 5.2 times the solid angle at a face's centre as at its corner.",
        source: "Greene 1986; the table of OpenGL, D3D, Vulkan and WebGPU",
        conventions: &[Convention {
            id: "lower-left",
            about: "the encyclopaedia article: the same vectors, rows counted from below, v' = 1 - v",
            columns: ["chart", "u", "v"],
            forward: (lower_left, lower_left),
            inverse: Some((lower_left_inverse, lower_left_inverse)),
        }],
        evaluators: || {
            let mut list = evaluator::plain_and::<Cube>(&[]);
            list.push(evaluator::of_form(ShaderForm::CubeUnit));
            list
        },
        ..cube_face::FAMILY
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let (face, a, b) = gnomonic(dir, largest_component)?;
        Some(ChartPoint::new(face, to_unit(a), to_unit(b)).clamped())
    }

    /// Beyond the face: on along its own plane.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        from_gnomonic(point.chart, to_signed(point.u), to_signed(point.v))
    }

    const HAS_LANES: bool = true;

    #[inline(always)]
    fn forward_lanes(dirs: &DirLanes, points: &mut PointLanes) {
        face_lanes(dirs, points, largest_component_lane, Self::from_middle);
    }

    const HAS_FACES: bool = true;

    #[inline(always)]
    fn from_middle(_: u32, a: f32, b: f32) -> (f32, f32) {
        (0.5 * a, 0.5 * b)
    }

    fn line(_: usize, coordinate: f64) -> Line {
        let a = to_signed(coordinate);
        // On the side faces the tangent of the latitude is -b over the distance from the y axis.
        let nearness = 1.0 / 1.0.hypot(a);
        [a as f32, nearness as f32, 0.0, 0.0]
    }

    #[inline(always)]
    fn inverse_lanes(face: u32, columns: [&Lane; 4], row: Line, dirs: &mut DirLanes) {
        frame_lanes(face, dirs, |k| (columns[0][k], row[0], 1.0));
    }

    fn has_meridians(face: u32) -> bool {
        is_side(face)
    }

    #[inline(always)]
    fn latitude_lanes(columns: [&Lane; 4], row: Line, latitudes: &mut AngleLanes) {
        shallow_latitudes(latitudes, |k| -row[0] * columns[1][k]);
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let Some(point) = Self::forward(dir) else {
            return Vec::new();
        };
        cube_face::steps(dir, |a, b| {
            [
                Step::new("u", "u = (a + 1)/2", format!("({a} + 1)/2 = {}", point.u)),
                Step::new("v", "v = (b + 1)/2", format!("({b} + 1)/2 = {}", point.v)),
            ]
        })
    }
}

fn lower_left<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
    let (face, a, b) = gnomonic(dir, largest_component)?;
    Some(ChartPoint::new(face, to_unit(a), to_unit(-b)).clamped())
}

fn lower_left_inverse<R: Real>(point: ChartPoint<R>) -> Option<Vec3<R>> {
    Cube::inverse(point.flipped())
}
