//! Latlong (equirectangular): longitude to the right, colatitude downwards. The first seed's "spherical mapping".
//!
//! The centre of the picture looks along +z, +x lies to the right, +y is up. Grimm and Niebruegge, equations 1 to 4.

use super::{AngleLanes, Borders, DirLanes, LANES, Lane, Line, PointLanes};
use super::{ChartPoint, Convention, Erratum, Family, Mapping, MappingInfo, Step};
use super::{evaluator, seed_forms};
use crate::math::{Real, Vec3, atan2_turns};
use std::f64::consts::FRAC_1_PI;

/// See the [module](self).
pub struct Latlong;

impl Mapping for Latlong {
    const INFO: MappingInfo = MappingInfo {
        id: "latlong",
        name: "Latlong",
        about: "Longitude and latitude as a picture: simple, but the poles are stretched over a whole row.",
        source: "equirectangular; Grimm and Niebruegge, eq. 1-4",
        family: Family::Graticule,
        aspect: 2.0,
        conventions: &[Convention {
            id: "grimm",
            about: "z up, longitude from +x: u = frac(theta/2pi), v = phi/pi with theta = atan2(Ry, Rx), phi = acos(Rz/|R|)",
            columns: ["chart", "u", "v"],
            forward: (grimm, grimm),
            inverse: Some((grimm_inverse, grimm_inverse)),
        }],
        errata: &[
            Erratum {
                id: "Eq. 1 and 3",
                printed: "u = arctan(Ry/Rx)/(2π)",
                right: "u = frac(atan2(Ry, Rx)/(2π))",
                why: "the quotient loses the quadrant: R and the direction half a turn away get the same u",
                values: |dir| {
                    let dir = dir.scaled_direction()?;
                    Some(((dir.y / dir.x).atan() * 0.5 * FRAC_1_PI, grimm(dir)?.u))
                },
            },
            Erratum {
                id: "Eq. 4",
                printed: "v = 0.5 + φ/π",
                right: "v = φ/π",
                why: "φ is measured from the pole, so it already runs over [0, π]; printed, v runs over [0.5, 1.5]",
                values: |dir| grimm(dir).map(|p| (0.5 + p.v, p.v)),
            },
        ],
        evaluators: || evaluator::with_arctangents_and::<Latlong>(seed_forms::LATLONG),
        borders: Borders::DateLineAndPoles,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        // The colatitude from both of its legs: acos(y/n) would lose half the digits at the poles.
        let v = d.x.hypot(d.z).atan2(d.y) * R::from_f64(FRAC_1_PI);
        Some(ChartPoint::new(0, column(d), v).clamped())
    }

    /// Beyond the chart: over the date line, and over a pole to the other side.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        direction(longitude(point.u), colatitude(point.v))
    }

    /// Without an angle: over the date line to the other border, over a pole half a turn on.
    fn folded<R: Real>(_: u32, point: ChartPoint<R>) -> Option<ChartPoint<R>> {
        let ChartPoint { u, v, .. } = point;
        let (zero, one) = (R::zero(), R::one());
        let (u, v) = if v < zero {
            (u + R::half(), -v)
        } else if v > one {
            (u + R::half(), R::two() - v)
        } else {
            (u, v)
        };
        let u = if u < zero {
            u + one
        } else if u > one {
            u - one
        } else {
            u
        };
        Some(ChartPoint::new(0, u, v).clamped())
    }

    const HAS_LANES: bool = true;
    const LANES_HAVE_POLES: bool = true;

    #[inline(always)]
    fn forward_lanes(dirs: &DirLanes, points: &mut PointLanes) {
        points.base = None;
        for k in 0..LANES {
            let (x, y, z) = (dirs.x[k], dirs.y[k], dirs.z[k]);
            let (base, rest) = atan2_turns(x, z);
            (points.base_u[k], points.rest_u[k]) = (0.5 + base, rest);
            let (base, rest) = atan2_turns((x * x + z * z).sqrt(), y);
            (points.base_v[k], points.rest_v[k]) = (2.0 * base, 2.0 * rest);
            points.chart[k] = 0;
        }
    }

    fn line(side: usize, coordinate: f64) -> Line {
        if side == 0 {
            let (sin, cos) = longitude(coordinate);
            return [sin as f32, cos as f32, 0.0, 0.0];
        }
        let (sin, cos) = colatitude(coordinate);
        let latitude_turns = 0.5 * (0.5 - coordinate);
        let base = (8.0 * latitude_turns).round() / 8.0;
        let rest = latitude_turns - base;
        [sin as f32, cos as f32, base as f32, rest as f32]
    }

    #[inline(always)]
    #[expect(
        clippy::needless_range_loop,
        reason = "a lane is an index into several lists at once"
    )]
    fn inverse_lanes(_: u32, columns: [&Lane; 4], row: Line, dirs: &mut DirLanes) {
        for k in 0..LANES {
            dirs.x[k] = row[0] * columns[0][k];
            dirs.y[k] = row[1];
            dirs.z[k] = row[0] * columns[1][k];
        }
    }

    fn has_meridians(_: u32) -> bool {
        true
    }

    #[inline(always)]
    fn latitude_lanes(_: [&Lane; 4], row: Line, latitudes: &mut AngleLanes) {
        latitudes.base = row[2];
        latitudes.rest.fill(row[3]);
    }

    const PARALLELS: Option<[f32; 2]> = Some([0.5, -2.0]);

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(p)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let [longitude, u] = column_steps(d);
        let radius = x.hypot(z);
        let colatitude = radius.atan2(y);
        vec![
            longitude,
            Step::new(
                "radius",
                "ρ = √(x² + z²)",
                format!("√({x}² + {z}²) = {radius}"),
            ),
            Step::new(
                "colatitude",
                "θ = atan2(ρ, y)",
                format!("atan2({radius}, {y}) = {colatitude} rad"),
            ),
            u,
            Step::new("v", "v = θ/π", format!("{colatitude}/π = {}", p.v)),
        ]
    }
}

/// The column of a scaled direction: its longitude from +z towards +x, in turns from the left edge.
pub(super) fn column<R: Real>(d: Vec3<R>) -> R {
    R::half() + d.x.atan2(d.z) * R::from_f64(0.5 * FRAC_1_PI)
}

/// The two steps of [`column`]: longitude and u.
pub(super) fn column_steps<R: Real + std::fmt::Display>(d: Vec3<R>) -> [Step; 2] {
    let Vec3 { x, z, .. } = d;
    let longitude = x.atan2(z);
    [
        Step::new(
            "longitude",
            "λ = atan2(x, z)",
            format!("atan2({x}, {z}) = {longitude} rad"),
        ),
        Step::new(
            "u",
            "u = 1/2 + λ/(2π)",
            format!("1/2 + {longitude}/(2π) = {}", column(d).clamp_unit()),
        ),
    ]
}

/// Sine and cosine of the longitude of a column. With [`colatitude`] and [`direction`] it makes the inverse: whoever walks
/// a whole picture takes each column and each row once.
pub fn longitude<R: Real>(u: R) -> (R, R) {
    (u - R::half()).sin_cos_turns()
}

/// Sine and cosine of the colatitude of a row.
pub fn colatitude<R: Real>(v: R) -> (R, R) {
    (v * R::half()).sin_cos_turns()
}

/// The unit direction from (sine, cosine) of its longitude and of its colatitude.
pub fn direction<R: Real>(longitude: (R, R), colatitude: (R, R)) -> Vec3<R> {
    let ((sin_longitude, cos_longitude), (sin_colatitude, cos_colatitude)) =
        (longitude, colatitude);
    Vec3::new(
        sin_colatitude * sin_longitude,
        cos_colatitude,
        sin_colatitude * cos_longitude,
    )
}

/// The first seed's numbers: its axes have z up.
fn grimm<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
    let d = dir.scaled_direction()?;
    let turns = d.y.atan2(d.x) * R::from_f64(0.5 * FRAC_1_PI);
    let u = if turns < R::zero() {
        turns + R::one()
    } else {
        turns
    };
    // A tiny negative angle rounds up to a whole turn, which is turn 0.
    let u = if u < R::one() { u } else { R::zero() };
    let v = d.x.hypot(d.y).atan2(d.z) * R::from_f64(FRAC_1_PI);
    Some(ChartPoint::new(0, u, v).clamped())
}

fn grimm_inverse<R: Real>(point: ChartPoint<R>) -> Option<Vec3<R>> {
    if !point.is_on(1) {
        return None;
    }
    let (sin_theta, cos_theta) = point.u.sin_cos_turns();
    let (sin_phi, cos_phi) = (point.v * R::half()).sin_cos_turns();
    Some(Vec3::new(sin_phi * cos_theta, sin_phi * sin_theta, cos_phi))
}
