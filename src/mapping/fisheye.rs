//! Fisheye discs: the equidistant fisheye of each half of the world, as cameras with two such lenses store it.
//!
//! Chart 0 looks along +z, chart 1 along -z; both are what an observer inside sees. The distance from a disc's middle is the
//! angle from its axis, a right angle at the rim.

use super::chart::{on_disc, over_rim, to_signed};
use super::{Borders, ChartPoint, Domain, Family, Layout, Mapping, MappingInfo, Step, evaluator};
use crate::math::{Real, Vec3, unit_in_plane};
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// See the [module](self).
pub struct Fisheye;

impl Mapping for Fisheye {
    const INFO: MappingInfo = MappingInfo {
        id: "fisheye",
        name: "Fisheye discs",
        about: "Two discs, one for each half of the world, on which the distance from the middle is the angle from the axis.",
        source: "azimuthal equidistant, per hemisphere; Bourke, dual fisheye",
        family: Family::Discs,
        charts: &["front", "back"],
        domain: Domain::Disc,
        layout: Layout::Pair,
        evaluators: evaluator::shaders_with_arctangents,
        borders: Borders::TwoRims,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        // Of the direction as it came: scaling may have taken the digits of a small z.
        let back = dir.z < R::zero();
        // The angle from both of its legs: acos(|z|/n) would lose half the digits in the middle.
        let rho = d.x.hypot(d.y).atan2(d.z.abs()) * R::from_f64(FRAC_1_PI);
        let (x, y) = unit_in_plane(d.x, d.y);
        let x = if back { -x } else { x };
        let (u, v) = (R::half() + rho * x, R::half() - rho * y);
        Some(ChartPoint::new(u32::from(back), u, v).clamped())
    }

    /// Beyond the rim: on into the other half.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let (chart, p, q) = over_rim(point.chart, to_signed(point.u), -to_signed(point.v));
        let radius = p.hypot(q);
        let front = if radius <= R::zero() {
            // p/r has no value in the middle; sin(r pi/2)/r has one.
            let slope = R::from_f64(FRAC_PI_2);
            Vec3::new(slope * p, slope * q, R::one())
        } else {
            let (sin, cos) = (radius * R::from_f64(0.25)).sin_cos_turns();
            Vec3::new(sin * (p / radius), sin * (q / radius), cos)
        };
        on_disc(chart, front)
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let across = x.hypot(y);
        let size = z.abs();
        let angle = across.atan2(size);
        let rho = angle * R::from_f64(FRAC_1_PI);
        let front = point.chart == 0;
        let [u, v] = Step::from_middle(front, rho, [x, y, across], &point);
        vec![
            Step::disc(front),
            Step::across(x, y, across),
            Step::new(
                "angle",
                "θ = atan2(q, |z|)",
                format!("atan2({across}, {size}) = {angle} rad"),
            ),
            Step::new("radius", "ρ = θ/π", format!("{angle}/π = {rho}")),
            u,
            v,
        ]
    }
}
