//! Sphere map (OpenGL's, Hoff's derivation): what a small mirror ball shows to a viewer far away on -z.
//!
//! The centre of the chart is the direction back to the viewer, -z; the whole rim is +z, the one direction that has no
//! unique image. The map is exactly equal-area (16 sr per unit of chart area); it fails by shape, at the rim.

use super::chart::height_squared;
use super::{
    Borders, ChartPoint, Claims, Convention, Coverage, Domain, Family, Mapping, MappingInfo, Step,
    WeakSpot,
};
use super::{evaluator, seed_forms};
use crate::math::{Real, Vec3};

/// See the [module](self).
pub struct Sphere;

impl Mapping for Sphere {
    const INFO: MappingInfo = MappingInfo {
        id: "sphere",
        name: "Sphere map",
        about: "A mirror ball seen from far away: one picture, equal area, torn apart at its rim. As in any mirror, writing is reversed.",
        source: "OpenGL sphere map; Hoff 1998",
        family: Family::Discs,
        charts: &["ball"],
        domain: Domain::Disc,
        coverage: Coverage::SphereLessPoint([0.0, 0.0, 1.0]),
        claims: Claims {
            equal_area: true,
            ..MappingInfo::PLAIN.claims
        },
        evaluators: || evaluator::plain_and::<Sphere>(seed_forms::SPHERE),
        weak_spots: &[WeakSpot {
            dir: [0.0, 0.0, 1.0],
            great_circle: false,
            radius_rad: 0.01,
            outside_rad: 1e-4,
            reason: "around the rim direction u and v hardly move, so their last digit is worth up to 7e-4 rad",
        }],
        conventions: &[Convention {
            id: "hoff",
            about: "right-handed eye space, r_z towards the viewer, v (Hoff's t) upwards: u = s = rx/m + 1/2, v = t = ry/m + 1/2",
            columns: ["chart", "u", "v"],
            forward: (hoff, hoff),
            inverse: Some((hoff_inverse, hoff_inverse)),
        }],
        borders: Borders::OneRim,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        let (x, y) = disc_offset(d);
        Some(ChartPoint::new(0, R::half() + x, R::half() - y).clamped())
    }

    /// Beyond the rim: the rim's own direction.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        // (p, q, -w) is the ball's normal; the direction is the view reflected there.
        let p = R::two() * point.u - R::one();
        let q = R::one() - R::two() * point.v;
        let w = height_squared(point.u, point.v).max(R::zero()).sqrt();
        let twice = R::two() * w;
        Vec3::new(twice * p, twice * q, R::one() - twice * w)
    }

    /// Beyond the rim: past +z and up the other side, so that the light between rim and texels lies on a line through +z.
    fn extended<R: Real>(_: u32, point: ChartPoint<R>) -> Vec3<R> {
        let beyond = -height_squared(point.u, point.v);
        if beyond <= R::zero() {
            return Self::continued(point);
        }
        let p = R::two() * point.u - R::one();
        let q = R::one() - R::two() * point.v;
        // As high over the disc as inside, but on the other side; (p, q) have the length sqrt(1 + beyond).
        let beyond = beyond.min(R::one());
        let across = -R::two() * (beyond * (R::one() - beyond)).sqrt() / p.hypot(q);
        Vec3::new(across * p, across * q, R::one() - R::two() * beyond)
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let n = d.length();
        let half = n - z;
        let m = R::two() * (x * x + y * y + half * half).sqrt();
        vec![
            Step::length(d, n),
            Step::new(
                "m",
                "m = 2√(x² + y² + (n − z)²)",
                format!("2√({x}² + {y}² + ({n} − {z})²) = {m}"),
            ),
            Step::new("u", "u = 1/2 + x/m", format!("1/2 + {x}/{m} = {}", point.u)),
            Step::new("v", "v = 1/2 − y/m", format!("1/2 − {y}/{m} = {}", point.v)),
        ]
    }
}

/// (x, y)/m of a scaled direction: the point on the ball, at most 1/2 from the centre.
fn disc_offset<R: Real>(d: Vec3<R>) -> (R, R) {
    let n = d.length();
    if d.z <= R::zero() {
        let m = R::two() * (d.x * d.x + d.y * d.y + (n - d.z) * (n - d.z)).sqrt();
        return (d.x / m, d.y / m);
    }
    // Ahead, n - z cancels; it equals rho slope with slope = rho/(n + z). Near the rim a rounding of u moves the direction
    // a thousand times as far, so m is formed with as few as can be: from x and y at a scale at which their squares, too,
    // are normal numbers.
    let Some(across) = Vec3::new(d.x, d.y, R::zero()).scaled_direction() else {
        return (R::half(), R::zero());
    };
    let slope = d.x.hypot(d.y) / (n + d.z);
    let square = across.x * across.x + across.y * across.y;
    let m = R::two() * (square + square * (slope * slope)).sqrt();
    (across.x / m, across.y / m)
}

/// Hoff's numbers: the same point with t counted upwards.
fn hoff<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
    let d = dir.scaled_direction()?;
    let (x, y) = disc_offset(d);
    Some(ChartPoint::new(0, R::half() + x, R::half() + y).clamped())
}

fn hoff_inverse<R: Real>(point: ChartPoint<R>) -> Option<Vec3<R>> {
    Sphere::inverse(point.flipped())
}
