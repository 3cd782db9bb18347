//! Angular map (Debevec's light probe): the distance from the centre is the angle from +z.
//!
//! Azimuthal equidistant: centre +z, the whole rim -z.

use super::{Borders, ChartPoint, Coverage, Domain, Family, Mapping, MappingInfo, Step};
use super::{evaluator, seed_forms};
use crate::math::{Real, Vec3, unit_in_plane};
use std::f64::consts::{FRAC_1_PI, TAU};

/// See the [module](self).
pub struct Angular;

impl Mapping for Angular {
    const INFO: MappingInfo = MappingInfo {
        id: "angular",
        name: "Angular map",
        about: "Angle from the centre as radius: the light probes' picture.",
        source: "azimuthal equidistant; Debevec's light probe",
        family: Family::Discs,
        charts: &["disc"],
        domain: Domain::Disc,
        coverage: Coverage::SphereLessPoint([0.0, 0.0, -1.0]),
        evaluators: || evaluator::with_arctangents_and::<Angular>(seed_forms::ANGULAR),
        borders: Borders::OneRim,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        let across = d.x.hypot(d.y);
        // The angle from both of its legs: acos(z/n) would lose half the digits at the centre and at the rim.
        let rho = across.atan2(d.z) * R::from_f64(0.5 * FRAC_1_PI);
        let (x, y) = unit_in_plane(d.x, d.y);
        Some(ChartPoint::new(0, R::half() + rho * x, R::half() - rho * y).clamped())
    }

    /// Beyond the rim: past -z and up the other side.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let (x, y) = (point.u - R::half(), R::half() - point.v);
        let rho = x.hypot(y);
        if rho <= R::zero() {
            // x/rho has no value in the middle; sin(2 pi rho)/rho has one.
            let slope = R::from_f64(TAU);
            return Vec3::new(slope * x, slope * y, R::one());
        }
        let (sin, cos) = rho.sin_cos_turns();
        Vec3::new(sin * (x / rho), sin * (y / rho), cos)
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let across = x.hypot(y);
        let angle = across.atan2(z);
        let rho = angle * R::from_f64(0.5 * FRAC_1_PI);
        let [u, v] = Step::from_middle(true, rho, [x, y, across], &point);
        vec![
            Step::across(x, y, across),
            Step::new(
                "angle",
                "θ = atan2(q, z)",
                format!("atan2({across}, {z}) = {angle} rad"),
            ),
            Step::new("radius", "ρ = θ/(2π)", format!("{angle}/(2π) = {rho}")),
            u,
            v,
        ]
    }
}
