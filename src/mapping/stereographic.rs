//! Stereographic: one disc around +z on which circles stay circles, cut off where nine tenths of the sphere are on it.
//!
//! With theta the angle from +z, the distance from the middle over the disc's radius is tan(theta/2)/3, so that the rim lies
//! at cos theta = -4/5. A direction beyond is looked up at the nearest point of the rim, and -z, to which every point of the rim
//! is equally near, at the rightmost one.

use super::chart::to_signed;
use super::{ChartPoint, Claims, Coverage, Domain, Family, Mapping, MappingInfo, Step};
use crate::math::{Real, Vec3, unit_in_plane};

/// See the [module](self).
pub struct Stereographic;

/// tan(theta/2) on the rim.
pub const RIM: f64 = 3.0;

/// cos theta on the rim: (1 - RIM^2)/(1 + RIM^2).
const RIM_COS: f64 = -0.8;

impl Mapping for Stereographic {
    const INFO: MappingInfo = MappingInfo {
        id: "stereographic",
        name: "Stereographic",
        about: "One disc on which circles stay circles: a little planet. A tenth of the sphere, around -z, is left out.",
        source: "Hipparchus; Snyder 1987, p. 154",
        family: Family::Discs,
        charts: &["disc"],
        domain: Domain::Disc,
        coverage: Coverage::Cap {
            axis: [0.0, 0.0, 1.0],
            least: RIM_COS,
        },
        claims: Claims {
            conformal: true,
            ..MappingInfo::PLAIN.claims
        },
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        let rho = R::half() * radius(d);
        let (x, y) = unit_in_plane(d.x, d.y);
        Some(ChartPoint::new(0, R::half() + rho * x, R::half() - rho * y).clamped())
    }

    /// Beyond the rim: on, as on the disc.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let rim = R::from_f64(RIM);
        let (p, q) = (rim * to_signed(point.u), -rim * to_signed(point.v));
        let square = p * p + q * q;
        let scale = R::one() / (R::one() + square);
        let twice = R::two() * scale;
        Vec3::new(p * twice, q * twice, (R::one() - square) * scale)
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let n = d.length();
        let across = x.hypot(y);
        let rho = R::half() * radius(d);
        let side = if z < n * R::from_f64(RIM_COS) {
            "z < −4n/5: beyond the rim, the nearest point of the rim"
        } else {
            "z ≥ −4n/5: on the disc"
        };
        let [u, v] = Step::from_middle(true, rho, [x, y, across], &point);
        vec![
            Step::length(d, n),
            Step::across(x, y, across),
            Step::new(
                "radius",
                "ρ = tan(θ/2)/6 = q/(6(n + z)), at most 1/2",
                format!("{across}/(6({n} + {z})) = {rho}"),
            ),
            Step::new("side", "covered where z ≥ −4n/5", side.to_owned()),
            u,
            v,
        ]
    }
}

/// Distance from the middle over the disc's radius, of a scaled direction.
fn radius<R: Real>(d: Vec3<R>) -> R {
    let n = d.length();
    if d.z <= n * R::from_f64(RIM_COS) {
        return R::one();
    }
    let across = d.x.hypot(d.y);
    let rim = R::from_f64(RIM);
    // n + z cancels behind; across/(n + z) equals (n - z)/across.
    let radius = if d.z < R::zero() {
        (n - d.z) / (rim * across)
    } else {
        across / (rim * (n + d.z))
    };
    radius.min(R::one())
}
