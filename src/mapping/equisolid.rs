//! Equisolid discs: Lambert's azimuthal equal-area map of each half of the world, 8 sr per unit of chart area.
//!
//! Chart 0 looks along +z, chart 1 along -z; both are what an observer inside sees. With theta the angle from a disc's axis and r
//! the distance from its middle over the disc's radius, r = sqrt 2 sin(theta/2).

use super::chart::{on_disc, over_rim, to_signed};
use super::{Borders, ChartPoint, Claims, Domain, Family, Layout, Mapping, MappingInfo, Step};
use crate::math::{Real, Vec3};

/// See the [module](self).
pub struct Equisolid;

impl Mapping for Equisolid {
    const INFO: MappingInfo = MappingInfo {
        id: "equisolid",
        name: "Equisolid discs",
        about: "Two discs, one for each half of the world, with the same solid angle in every texel.",
        source: "Lambert 1772, azimuthal equal-area; the equisolid-angle fisheye",
        family: Family::Discs,
        charts: &["front", "back"],
        domain: Domain::Disc,
        layout: Layout::Pair,
        claims: Claims {
            equal_area: true,
            ..MappingInfo::PLAIN.claims
        },
        borders: Borders::TwoRims,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        // Of the direction as it came: scaling may have taken the digits of a small z.
        let back = dir.z < R::zero();
        let n = d.length();
        // sqrt 2 sin(theta/2) is the root of 1 - cos theta, and that is sin theta over the root of 1 + cos theta.
        let twice = R::two() * (n * (n + d.z.abs())).sqrt();
        let x = if back { -d.x } else { d.x };
        let (u, v) = (R::half() + x / twice, R::half() - d.y / twice);
        Some(ChartPoint::new(u32::from(back), u, v).clamped())
    }

    /// Beyond the rim: into the other half, as far from the rim as the point is.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let (chart, p, q) = over_rim(point.chart, to_signed(point.u), -to_signed(point.v));
        let square = p * p + q * q;
        let scale = (R::two() - square).sqrt();
        on_disc(chart, Vec3::new(p * scale, q * scale, R::one() - square))
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let n = d.length();
        let size = z.abs();
        let m = R::two() * (n * (n + size)).sqrt();
        let front = point.chart == 0;
        let (formula, sign) = if front {
            ("u = 1/2 + x/m", "+")
        } else {
            ("u = 1/2 − x/m", "−")
        };
        vec![
            Step::length(d, n),
            Step::disc(front),
            Step::new(
                "m",
                "m = 2√(n(n + |z|))",
                format!("2√({n}({n} + {size})) = {m}"),
            ),
            Step::new("u", formula, format!("1/2 {sign} {x}/{m} = {}", point.u)),
            Step::new("v", "v = 1/2 − y/m", format!("1/2 − {y}/{m} = {}", point.v)),
        ]
    }
}
