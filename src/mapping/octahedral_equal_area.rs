//! Equal-area octahedral (Clarberg 2008; the environment map of pbrt-v4), turned as [`octahedral`](super::octahedral).
//!
//! Each octant's triangle is mapped with equal area: 4 pi sr per unit of chart area everywhere.

use super::chart::{to_signed, to_unit};
use super::octahedral::{BELOW, Octant, fold, octant, wrap};
use super::{Borders, ChartPoint, Claims, Family, Mapping, MappingInfo, Step};
use super::{evaluator, seed_forms};
use crate::math::{Real, Vec3};
use std::f64::consts::{FRAC_1_PI, PI, SQRT_2};

/// See the [module](self).
pub struct OctahedralEqualArea;

impl Mapping for OctahedralEqualArea {
    const INFO: MappingInfo = MappingInfo {
        id: "octahedral-equal-area",
        name: "Equal-area octahedral",
        about: "The octahedral square with the same solid angle in every texel.",
        source: "Clarberg 2008; pbrt-v4",
        family: Family::Octahedra,
        charts: &["square"],
        claims: Claims {
            equal_area: true,
            ..MappingInfo::PLAIN.claims
        },
        evaluators: || {
            evaluator::with_arctangents_and::<OctahedralEqualArea>(
                seed_forms::OCTAHEDRAL_EQUAL_AREA,
            )
        },
        borders: Borders::FoldedSides,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        let (radius, share) = polar(d);
        let along_z = radius * share;
        let (x, z) = (copy_sign(radius - along_z, d.x), copy_sign(along_z, d.z));
        let (x, z) = if d.y < R::zero() {
            fold_signed(x, z, d)
        } else {
            (x, z)
        };
        Some(ChartPoint::new(0, to_unit(x), to_unit(z)).clamped())
    }

    /// Beyond an edge: back in at the mirrored place.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let (mut x, mut z) = wrap(to_signed(point.u), to_signed(point.v));
        let height = R::one() - x.abs() - z.abs();
        let below = height < R::zero();
        if below {
            (x, z) = fold(x, z);
        }
        // After the fold both halves look alike.
        let dir = in_octant([x.abs(), z.abs()]);
        Vec3::new(
            copy_sign(dir.x, x),
            if below { -dir.y } else { dir.y },
            copy_sign(dir.z, z),
        )
    }

    const FACETS: u32 = 8;

    fn facet<R: Real>(point: ChartPoint<R>) -> u32 {
        octant(point)
    }

    /// The formula of the octant goes on, but not around the pole, where all four meet in a point: there it is as on the chart.
    fn extended<R: Real>(facet: u32, point: ChartPoint<R>) -> Vec3<R> {
        let Octant { signs, legs } = Octant::of(facet, point);
        let is_below = facet & BELOW != 0;
        let legs = if is_below {
            [R::one() - legs[1], R::one() - legs[0]]
        } else {
            legs
        };
        // Half a quarter turn beyond the octant, and what is behind the pole.
        if legs[0].min(legs[1]) * R::two() <= -(legs[0] + legs[1]) {
            return Self::continued(point);
        }
        let dir = in_octant(legs);
        let y = if is_below { -dir.y } else { dir.y };
        Vec3::new(dir.x * signs[0], y, dir.z * signs[1])
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let n = d.length();
        let (radius, share) = polar(d);
        let mut steps = vec![
            Step::length(d, n),
            Step::new(
                "radius",
                "r = √((x² + z²)/(n(n + |y|)))",
                format!("√(({x}² + {z}²)/({n}({n} + |{y}|))) = {radius}"),
            ),
            Step::new(
                "share",
                "t = (2/π) atan2(|z|, |x|)",
                format!("(2/π) atan2(|{z}|, |{x}|) = {share}"),
            ),
        ];
        if y < R::zero() {
            steps.push(Step::new(
                "fold (y < 0)",
                "over the diamond's edge",
                "(ox, oz) → ((1 − |oz|) sgn x, (1 − |ox|) sgn z)".to_owned(),
            ));
        }
        steps.push(Step::new(
            "u",
            "u = (r(1 − t) sgn x + 1)/2, or folded",
            format!("{}", point.u),
        ));
        steps.push(Step::new(
            "v",
            "v = (r t sgn z + 1)/2, or folded",
            format!("{}", point.v),
        ));
        steps
    }
}

/// The direction of a place in the octant of three positive signs: its two legs add up to the radius, the second's part of it
/// is the share of the quarter turn.
fn in_octant<R: Real>([along_x, along_z]: [R; 2]) -> Vec3<R> {
    let radius = along_x + along_z;
    if radius <= R::zero() {
        // At the pole there is no share, and no one slope: that of the meridian at which z begins.
        let (slope, turn) = (R::from_f64(SQRT_2), R::from_f64(PI / SQRT_2));
        return Vec3::new(slope * radius, R::one(), turn * along_z);
    }
    let share = along_z / radius;
    let (sin, cos) = (share * R::from_f64(0.25)).sin_cos_turns();
    // sin(colatitude) = r sqrt(2 - r^2), cos(colatitude) = 1 - r^2.
    let across = radius * (R::two() - radius * radius).max(R::zero()).sqrt();
    let up = (R::one() - radius) * (R::one() + radius);
    Vec3::new(across * cos, up, across * sin)
}

/// Radius sqrt(1 - |y|/n) in [0, 1], computed without the difference, and the share of a quarter turn from |x| to |z|.
fn polar<R: Real>(d: Vec3<R>) -> (R, R) {
    let n = d.length();
    let radius = d.x.hypot(d.z) / (n * (n + d.y.abs())).sqrt();
    let share = d.z.abs().atan2(d.x.abs()) * R::from_f64(2.0 * FRAC_1_PI);
    (radius.min(R::one()), share)
}

/// `magnitude` with the sign of `sign`, where zero counts as positive.
fn copy_sign<R: Real>(magnitude: R, sign: R) -> R {
    magnitude.abs() * sign.sign_or_one()
}

/// [`fold`] with the signs of the direction itself: a coordinate that rounds to zero must not change sides.
fn fold_signed<R: Real>(x: R, z: R, d: Vec3<R>) -> (R, R) {
    (
        copy_sign(R::one() - z.abs(), d.x),
        copy_sign(R::one() - x.abs(), d.z),
    )
}
