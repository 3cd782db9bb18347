//! Meridians and parallels.

use super::strokes::Strokes;
use super::{blend, coverage};
use crate::math::Vec3;

const PAPER: [f32; 3] = [0.82, 0.80, 0.74];
const PAPER_SOUTH: [f32; 3] = [0.62, 0.68, 0.74];
const LINE: [f32; 3] = [0.10, 0.10, 0.11];
/// Equator, and the latitudes' numbers: vermilion.
const EQUATOR: [f32; 3] = [0.665, 0.112, 0.0];
/// Meridian 0, and the longitudes' numbers: blue.
const PRIME: [f32; 3] = [0.0, 0.16, 0.445];

const STEP_DEG: f64 = 15.0;
/// Numbers stand at every other line.
const NUMBER_STEP_DEG: f64 = 30.0;
const LINE_HALF_WIDTH_DEG: f64 = 0.14;
const BOLD_HALF_WIDTH_DEG: f64 = 0.4;
const NUMBER_HALF_WIDTH_DEG: f64 = 0.34;
/// Height of a number, and its distance from its two lines.
const NUMBER_DEG: f64 = 4.2;
const GAP_DEG: f64 = 1.4;
/// Paper around the digits.
const HALO_DEG: f64 = 0.5;
/// Meridians other than the four great ones end here, before they run together.
const LAST_PARALLEL_DEG: f64 = 75.0;

pub(super) struct Graticule {
    /// -180, -150, .. 150.
    longitudes: Vec<Strokes>,
    /// -60, -30, 0, 30, 60 (the equator has the longitudes instead).
    latitudes: Vec<Strokes>,
}

impl Graticule {
    pub(super) fn new() -> Self {
        // A number's lower left corner is the origin of its plane.
        let number = |degrees: i32| {
            Strokes::new().text(&format!("{degrees}°"), [0.0, -NUMBER_DEG], NUMBER_DEG)
        };
        Self {
            longitudes: (-6..6)
                .map(|step| number(if step == -6 { 180 } else { step * 30 }))
                .collect(),
            latitudes: (-2..3).map(|step| number(step * 30)).collect(),
        }
    }

    pub(super) fn color(&self, Vec3 { x, y, z }: Vec3<f64>, texel_rad: f64) -> [f32; 3] {
        let texel = texel_rad.to_degrees();
        let cos_lat = x.hypot(z);
        let lat = y.atan2(cos_lat).to_degrees();
        let lon = x.atan2(z).to_degrees();

        let paper = blend(PAPER_SOUTH, PAPER, coverage(-lat, 0.0, texel));
        let to_parallel = distance_to_step(lat, STEP_DEG);
        let is_polar = lat.abs() > LAST_PARALLEL_DEG;
        let to_meridian = distance_to_step(lon, if is_polar { 90.0 } else { STEP_DEG }) * cos_lat;
        let thin = coverage(to_parallel.min(to_meridian), LINE_HALF_WIDTH_DEG, texel);
        let mut color = blend(paper, LINE, 0.7 * thin);
        // Only its own half of the great circle is meridian 0.
        let to_prime = if z > 0.0 {
            x.abs().asin().to_degrees()
        } else {
            f64::INFINITY
        };
        color = blend(color, PRIME, coverage(to_prime, BOLD_HALF_WIDTH_DEG, texel));
        color = blend(
            color,
            EQUATOR,
            coverage(lat.abs(), BOLD_HALF_WIDTH_DEG, texel),
        );

        // A number lies flat at its own height: one scale for its whole width, so that it does not lean.
        let with_number = |strokes: Option<&Strokes>, scale: f64, east: f64, north: f64, ink| {
            let p = [east * scale - GAP_DEG, GAP_DEG - north];
            let reach = NUMBER_HALF_WIDTH_DEG + HALO_DEG + texel;
            let distance = strokes.map_or(f64::INFINITY, |strokes| strokes.distance(p, reach));
            // Paper around the strokes keeps the thin lines off the digits.
            let halo = coverage(distance, NUMBER_HALF_WIDTH_DEG + HALO_DEG, texel);
            let amount = coverage(distance, NUMBER_HALF_WIDTH_DEG, texel);
            blend(blend(color, paper, halo), ink, amount)
        };
        let top = GAP_DEG + NUMBER_DEG + GAP_DEG;
        if (0.0..top).contains(&lat) {
            let (index, east) = cell(lon + 180.0, NUMBER_STEP_DEG);
            return with_number(self.longitudes.get(index), 1.0, east, lat, PRIME);
        }
        let (index, north) = cell(lat + 60.0, NUMBER_STEP_DEG);
        let (_, east) = cell(lon + 180.0, 90.0);
        if lat < -60.0 || north > top {
            return color;
        }
        let scale = (lat - north + top / 2.0).to_radians().cos();
        with_number(self.latitudes.get(index), scale, east, north, EQUATOR)
    }
}

fn distance_to_step(degrees: f64, step: f64) -> f64 {
    (degrees - (degrees / step).round() * step).abs()
}

/// Which step a non-negative angle lies in, and how far into it.
fn cell(degrees: f64, step: f64) -> (usize, f64) {
    let index = (degrees / step).floor().max(0.0);
    (index as usize, degrees - index * step)
}
