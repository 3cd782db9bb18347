//! Matcap (the simple sphere map of Scali's article): the direction's x and y as they are.
//!
//! Two directions share each texel. The inverse returns the one that faces the viewer (z <= 0), and the mapping covers
//! that hemisphere only. It is Hoff's sphere map if the vector put in is the normal instead of the direction.

use super::chart::height_squared;
use super::{
    ChartPoint, Convention, Coverage, Domain, Family, Mapping, MappingInfo, Step, WeakSpot,
};
use crate::math::{Real, Vec3};

/// See the [module](self).
pub struct Matcap;

impl Mapping for Matcap {
    const INFO: MappingInfo = MappingInfo {
        id: "matcap",
        name: "Matcap",
        about: "x and y as they are: the cheapest map, and half the world is missing. The half behind the viewer is seen as in a mirror.",
        source: "simple sphere map; Scali, Cubemaps",
        family: Family::Discs,
        charts: &["disc"],
        domain: Domain::Disc,
        coverage: Coverage::Cap {
            axis: [0.0, 0.0, -1.0],
            least: 0.0,
        },
        weak_spots: &[WeakSpot {
            dir: [0.0, 0.0, 1.0],
            great_circle: true,
            radius_rad: 0.16,
            outside_rad: 1.5e-6,
            reason: "at the rim the disc is seen edge-on: an angle from it moves x and y by half its square only",
        }],
        conventions: &[Convention {
            id: "scali",
            about: "v upwards: U = (x + 1)/2, V = (y + 1)/2 of the unit direction",
            columns: ["chart", "u", "v"],
            forward: (scali, scali),
            inverse: Some((scali_inverse, scali_inverse)),
        }],
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        let n = d.length();
        let u = (d.x / n + R::one()) * R::half();
        let v = (R::one() - d.y / n) * R::half();
        Some(ChartPoint::new(0, u, v).clamped())
    }

    /// Beyond the rim: the rim's own direction.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let x = R::two() * point.u - R::one();
        let y = R::one() - R::two() * point.v;
        let z = -height_squared(point.u, point.v).max(R::zero()).sqrt();
        Vec3::new(x, y, z).normalized()
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let n = d.length();
        let side = if z > R::zero() {
            "z > 0: this texel belongs to the mirrored direction"
        } else {
            "z ≤ 0: the texel's own direction"
        };
        vec![
            Step::length(d, n),
            Step::new(
                "u",
                "u = (x/n + 1)/2",
                format!("({x}/{n} + 1)/2 = {}", point.u),
            ),
            Step::new(
                "v",
                "v = (1 − y/n)/2",
                format!("(1 − {y}/{n})/2 = {}", point.v),
            ),
            Step::new("side", "covered where z ≤ 0", side.to_owned()),
        ]
    }
}

/// Scali's numbers: V upwards.
fn scali<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
    let d = dir.scaled_direction()?;
    let n = d.length();
    let signed = |c: R| (c / n + R::one()) * R::half();
    Some(ChartPoint::new(0, signed(d.x), signed(d.y)).clamped())
}

fn scali_inverse<R: Real>(point: ChartPoint<R>) -> Option<Vec3<R>> {
    Matcap::inverse(point.flipped())
}
