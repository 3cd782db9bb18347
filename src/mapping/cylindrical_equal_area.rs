//! Cylindrical equal-area (Lambert): longitude to the right, height downwards. 4 pi sr per unit of chart area.

use super::{
    Borders, ChartPoint, Claims, Family, Mapping, MappingInfo, Step, WeakSpot, evaluator, latlong,
};
use crate::math::{Real, Vec3};
use std::f64::consts::PI;

/// See the [module](self).
pub struct CylindricalEqualArea;

impl Mapping for CylindricalEqualArea {
    const INFO: MappingInfo = MappingInfo {
        id: "cylindrical-equal-area",
        name: "Cylindrical equal-area",
        about: "The sphere's shadow on a cylinder around it: every texel the same solid angle, poles squeezed flat.",
        source: "Lambert 1772",
        family: Family::Graticule,
        aspect: PI,
        claims: Claims {
            equal_area: true,
            ..MappingInfo::PLAIN.claims
        },
        weak_spots: &[WeakSpot {
            dir: [0.0, -1.0, 0.0],
            great_circle: false,
            radius_rad: 0.05,
            outside_rad: 1.5e-6,
            reason: "v is flat at the poles, and near v = 1 half of the last digit of v is worth 6e-8 rad over the angle from the pole",
        }],
        evaluators: evaluator::shaders_with_arctangents,
        borders: Borders::DateLine,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        let n = d.length();
        // n - |y| cancels near a pole; it equals (x^2 + z^2)/(n + |y|).
        let across = d.x.hypot(d.z);
        let from_pole = R::half() * (across / n) * (across / (n + d.y.abs()));
        let v = if d.y > R::zero() {
            from_pole
        } else {
            R::one() - from_pole
        };
        Some(ChartPoint::new(0, latlong::column(d), v).clamped())
    }

    /// Beyond the chart: over the date line; beyond a pole down the other side, as v runs back.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let (sin, cos) = latlong::longitude(point.u);
        let v = (point.v - R::two() * (point.v - R::one()).max(R::zero())).abs();
        let is_over_pole = point.v < R::zero() || point.v > R::one();
        // 1 - y^2 = 4 v (1 - v), which cancels at neither pole.
        let across = R::two() * (v * (R::one() - v)).sqrt();
        let across = if is_over_pole { -across } else { across };
        Vec3::new(across * sin, R::one() - R::two() * v, across * cos)
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let y = d.y;
        let [longitude, u] = latlong::column_steps(d);
        let n = d.length();
        vec![
            longitude,
            Step::length(d, n),
            u,
            Step::new(
                "v",
                "v = (1 − y/n)/2",
                format!("(1 − {y}/{n})/2 = {}", point.v),
            ),
        ]
    }
}
