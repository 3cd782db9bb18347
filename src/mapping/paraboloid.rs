//! Dual paraboloid (Heidrich and Seidel): two mirrors back to back, each a stereographic picture of half the world.
//!
//! Chart 0 looks along +z, chart 1 along -z; both are what an observer inside sees. Exactly conformal, area ratio 4.

use super::chart::on_disc;
use super::evaluator;
use super::{Borders, ChartPoint, Claims, Domain, Family, Layout, Mapping, MappingInfo, Step};
use crate::math::{Real, Vec3};

/// See the [module](self).
pub struct Paraboloid;

impl Mapping for Paraboloid {
    const INFO: MappingInfo = MappingInfo {
        id: "paraboloid",
        name: "Dual paraboloid",
        about: "Two discs, one for each half of the world: circles stay circles, only products and one quotient.",
        source: "Heidrich and Seidel 1998",
        family: Family::Discs,
        charts: &["front", "back"],
        domain: Domain::Disc,
        layout: Layout::Pair,
        claims: Claims {
            conformal: true,
            ..MappingInfo::PLAIN.claims
        },
        evaluators: || evaluator::plain_and::<Paraboloid>(&[]),
        borders: Borders::TwoRims,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        // Of the direction as it came: scaling may have taken the digits of a small z.
        let back = dir.z < R::zero();
        let twice = R::two() * (d.length() + d.z.abs());
        let x = if back { -d.x } else { d.x };
        let (u, v) = (R::half() + x / twice, R::half() - d.y / twice);
        Some(ChartPoint::new(u32::from(back), u, v).clamped())
    }

    /// Beyond the rim: on into the other half.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let p = R::two() * point.u - R::one();
        let q = R::one() - R::two() * point.v;
        // The paraboloid's normal is (p, q, 1) and the direction the axis reflected there.
        let square = p * p + q * q;
        let scale = R::one() / (R::one() + square);
        let front = Vec3::new(
            R::two() * p * scale,
            R::two() * q * scale,
            (R::one() - square) * scale,
        );
        on_disc(point.chart, front)
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let n = d.length();
        let front = point.chart == 0;
        let sign = if front { "+" } else { "−" };
        let size = z.abs();
        vec![
            Step::length(d, n),
            Step::disc(front),
            Step::new(
                "u",
                if front {
                    "u = 1/2 + x/(2(n + z))"
                } else {
                    "u = 1/2 − x/(2(n − z))"
                },
                format!("1/2 {sign} {x}/(2({n} + {size})) = {}", point.u),
            ),
            Step::new(
                "v",
                if front {
                    "v = 1/2 − y/(2(n + z))"
                } else {
                    "v = 1/2 − y/(2(n − z))"
                },
                format!("1/2 − {y}/(2({n} + {size})) = {}", point.v),
            ),
        ]
    }
}
