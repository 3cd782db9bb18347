//! Equi-angular cube: each face is divided by angle instead of by tangent.

use super::cube_face::{
    self, face_lanes, frame_lanes, from_gnomonic, gnomonic, is_side, largest_component,
    largest_component_lane, shallow_latitudes,
};
use super::evaluator;
use super::{AngleLanes, ChartPoint, DirLanes, Lane, Line, Mapping, MappingInfo, PointLanes, Step};
use crate::math::{Real, Vec3, atan_unit};
use std::f64::consts::FRAC_1_PI;

/// See the [module](self).
pub struct Eac;

impl Mapping for Eac {
    const INFO: MappingInfo = MappingInfo {
        id: "eac",
        name: "Equi-angular cube",
        about: "A cube whose faces are divided by angle: areas differ by 1.41 only.",
        source: "the tangent adjustment of the survey literature; EAC of 360-degree video",
        evaluators: || evaluator::with_arctangents_and::<Eac>(&[]),
        ..cube_face::FAMILY
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let (face, a, b) = gnomonic(dir, largest_component)?;
        let place = |c: R| R::half() + c.atan_unit() * R::from_f64(2.0 * FRAC_1_PI);
        Some(ChartPoint::new(face, place(a), place(b)).clamped())
    }

    /// Beyond the face: on along its own plane.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        // (u - 1/2) pi/2 radians are a quarter of u - 1/2 in turns.
        let tangent = |c: R| ((c - R::half()) * R::from_f64(0.25)).tan_turns();
        from_gnomonic(point.chart, tangent(point.u), tangent(point.v))
    }

    const HAS_LANES: bool = true;

    #[inline(always)]
    fn forward_lanes(dirs: &DirLanes, points: &mut PointLanes) {
        face_lanes(dirs, points, largest_component_lane, Self::from_middle);
    }

    const HAS_FACES: bool = true;

    #[inline(always)]
    fn from_middle(_: u32, a: f32, b: f32) -> (f32, f32) {
        let place = |c: f32| atan_unit(c) * (2.0 * FRAC_1_PI) as f32;
        (place(a), place(b))
    }

    fn line(_: usize, coordinate: f64) -> Line {
        let (sin, cos) = ((coordinate - 0.5) * 0.25).sin_cos_turns();
        [sin as f32, cos as f32, (sin / cos) as f32, 0.0]
    }

    #[inline(always)]
    fn inverse_lanes(face: u32, columns: [&Lane; 4], row: Line, dirs: &mut DirLanes) {
        let [row_sin, row_cos, ..] = row;
        // The tangents, times both cosines.
        frame_lanes(face, dirs, |k| {
            let (sin, cos) = (columns[0][k], columns[1][k]);
            (sin * row_cos, row_sin * cos, cos * row_cos)
        });
    }

    fn has_meridians(face: u32) -> bool {
        is_side(face)
    }

    #[inline(always)]
    fn latitude_lanes(columns: [&Lane; 4], row: Line, latitudes: &mut AngleLanes) {
        // The row's tangent over the distance from the y axis, which is 1/cos.
        shallow_latitudes(latitudes, |k| -row[2] * columns[1][k]);
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let Some(point) = Self::forward(dir) else {
            return Vec::new();
        };
        cube_face::steps(dir, |a, b| {
            [
                Step::new(
                    "u",
                    "u = 1/2 + (2/π) atan a",
                    format!("1/2 + (2/π) atan {a} = {}", point.u),
                ),
                Step::new(
                    "v",
                    "v = 1/2 + (2/π) atan b",
                    format!("1/2 + (2/π) atan {b} = {}", point.v),
                ),
            ]
        })
    }
}
