//! Mercator, as the maps of the web have it: a square of meridians and parallels on which small shapes are kept, cut off at both poles.
//!
//! v = 1/2 - asinh(tan latitude)/(2 pi), so that the square ends at a latitude of atan(sinh(pi)), 85.0511 degrees. A direction
//! beyond is looked up at the nearest point, in the first or the last row of its own meridian.

use super::{
    Borders, ChartPoint, Claims, Coverage, Family, Mapping, MappingInfo, Step, evaluator, latlong,
};
use crate::math::{Real, Vec3};
use std::f64::consts::{FRAC_1_PI, TAU};

/// See the [module](self).
pub struct Mercator;

/// Sine of the latitude at which the square ends: tanh(pi).
pub const CUT: f64 = 0.996_272_076_220_75;

impl Mapping for Mercator {
    const INFO: MappingInfo = MappingInfo {
        id: "mercator",
        name: "Mercator",
        about: "Parallels drawn apart as much as meridians are, so that small shapes are kept; the poles are out of reach.",
        source: "Mercator 1569; the web's maps, EPSG:3857 on a sphere",
        family: Family::Graticule,
        coverage: Coverage::Band {
            axis: [0.0, 1.0, 0.0],
            most: CUT,
        },
        claims: Claims {
            conformal: true,
            ..MappingInfo::PLAIN.claims
        },
        evaluators: evaluator::shaders_with_arctangents,
        borders: Borders::DateLine,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        let rows = height(d) * R::from_f64(0.5 * FRAC_1_PI);
        Some(ChartPoint::new(0, latlong::column(d), R::half() - rows).clamped())
    }

    /// Beyond the chart: over the date line, and on towards a pole.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let (sin, cos) = latlong::longitude(point.u);
        let height = (R::half() - point.v) * R::from_f64(TAU);
        // With m = e^|h| - 1: tanh h and 1/cosh h, of which neither cancels.
        let m = height.abs().exp_m1();
        let power = m + R::one();
        let below = power * power + R::one();
        let up = m * (m + R::two()) / below;
        let across = R::two() * power / below;
        let up = if height < R::zero() { -up } else { up };
        Vec3::new(across * sin, up, across * cos)
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let y = d.y;
        let [longitude, u] = latlong::column_steps(d);
        let across = d.x.hypot(d.z);
        let height = height(d);
        vec![
            longitude,
            u,
            Step::new(
                "across",
                "q = √(x² + z²)",
                format!("√({}² + {}²) = {across}", d.x, d.z),
            ),
            Step::new(
                "height",
                "h = asinh(tan φ) = asinh(y/q), at most π either way",
                format!("asinh({y}/{across}) = {height}"),
            ),
            Step::new(
                "v",
                "v = 1/2 − h/(2π)",
                format!("1/2 − {height}/(2π) = {}", point.v),
            ),
        ]
    }
}

/// asinh(tan latitude) of a scaled direction, at most pi either way.
fn height<R: Real>(d: Vec3<R>) -> R {
    let (n, size) = (d.length(), d.y.abs());
    let height = if size >= n * R::from_f64(CUT) {
        R::from_f64(std::f64::consts::PI)
    } else {
        // ln((n + |y|)/q) with q across; n - q, which cancels at the equator, is y^2/(n + q).
        let across = d.x.hypot(d.z);
        ((size + size * (size / (n + across))) / across).ln_1p()
    };
    if d.y < R::zero() { -height } else { height }
}
