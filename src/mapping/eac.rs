//! Equi-angular cube: each face is divided by angle instead of by tangent.

use super::cube_face::{self, from_gnomonic, gnomonic, largest_component};
use super::{ChartPoint, Mapping, MappingInfo, Step};
use crate::math::{Real, Vec3};
use std::f64::consts::FRAC_1_PI;

/// See the [module](self).
pub struct Eac;

impl Mapping for Eac {
    const INFO: MappingInfo = MappingInfo {
        id: "eac",
        name: "Equi-angular cube",
        about: "A cube whose faces are divided by angle: areas differ by 1.41 only.",
        source: "the tangent adjustment of the survey literature; EAC of 360-degree video",
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
