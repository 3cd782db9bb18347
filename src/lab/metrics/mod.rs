//! What a mapping's distortion comes to over all of it: extremes and means from the exact Jacobian.
//!
//! Means are over the chart's area, so that every texel of the map counts alike, as in Lambers's *Mappings between Sphere, Disc, and
//! Square* and *Survey of Cube Mapping Methods*. They are integrals by Gauss's rule over the smooth pieces of a chart, so they do not depend on a number of texels.

mod extremes;
pub mod heat;
mod local;
pub mod tissot;

use std::sync::LazyLock;

use serde::{Serialize, Serializer};

pub use local::{Local, Quantity, Yardstick, omega_rad};

use crate::imaging::Progress;
use crate::mapping::{ChartPoint, MappingId, integrate};
use crate::math::Rule;

/// A mapping that can be differentiated at a corner of a cube has a/b of at least this there: a right angle on the map is 120 degrees on the
/// sphere, and axes a and b turn a right angle into 2 atan(a/b) at most, so a/b >= tan 60 degrees.
pub const CORNER_BOUND: f64 = 1.732_050_807_568_877_2;

/// The distortion of a mapping. A number without bound is infinite, and written as the word `unbounded`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Metrics {
    /// The mapping.
    pub mapping: MappingId,
    /// Number of its charts.
    pub charts: u32,
    /// Largest over smallest solid angle of a texel.
    #[serde(serialize_with = "bounded")]
    pub area_ratio: f64,
    /// Root of the mean square of D_A - 1, where D_A is the mean solid angle over the texel's (Lambers).
    #[serde(serialize_with = "bounded")]
    pub area_rms: f64,
    /// Mean of a/b, the ratio of the axes of Tissot's indicatrix (Lambers's D_I).
    #[serde(serialize_with = "bounded")]
    pub anisotropy_mean: f64,
    /// Largest a/b.
    #[serde(serialize_with = "bounded")]
    pub anisotropy_max: f64,
    /// Mean of the largest error of an angle, degrees.
    #[serde(serialize_with = "bounded")]
    pub omega_mean_deg: f64,
    /// Largest error of an angle, degrees; 180 where a/b has no bound.
    pub omega_max_deg: f64,
    /// Longest extent of any texel over the side of the ideal one.
    #[serde(serialize_with = "bounded")]
    pub worst_linear: f64,
    /// How many times the texels of the ideal map are needed so that the coarsest direction is as fine: the square of `worst_linear`.
    #[serde(serialize_with = "bounded")]
    pub texel_budget: f64,
    /// Longest side of any texel over the shortest of any.
    #[serde(serialize_with = "bounded")]
    pub edge_ratio: f64,
    /// Longest diagonal of any texel over the shortest of any.
    #[serde(serialize_with = "bounded")]
    pub diagonal_ratio: f64,
    /// Sum of the solid angles of all texels, sr.
    pub solid_angle_sum_sr: f64,
    /// The mapping promises equal areas.
    pub equal_area: bool,
    /// The mapping promises to keep angles.
    pub conformal: bool,
}

fn bounded<S: Serializer>(value: &f64, to: S) -> Result<S::Ok, S::Error> {
    if value.is_finite() {
        to.serialize_f64(*value)
    } else {
        to.serialize_str(UNBOUNDED)
    }
}

/// The word for a number that grows without bound.
pub const UNBOUNDED: &str = "unbounded";

/// Rows of texels whose solid angles are summed.
const SUM_ROWS: u32 = 64;

/// Measures a mapping; `None` when cancelled.
pub fn measure(map: MappingId, progress: &Progress) -> Option<Metrics> {
    let yardstick = Yardstick::new(map);
    // Logarithms of what is largest; smallest ones are the largest of the reciprocals.
    let [
        most_area,
        least_area,
        anisotropy,
        linear,
        longest,
        shortest,
        long_diagonal,
        short_diagonal,
    ] = extremes::largest(
        &yardstick,
        map,
        [
            |l| l.area.ln(),
            |l| -l.area.ln(),
            |l| l.anisotropy.ln(),
            |l| l.linear.ln(),
            |l| l.sides[0].max(l.sides[1]).ln(),
            |l| -l.sides[0].min(l.sides[1]).ln(),
            |l| l.diagonals[0].max(l.diagonals[1]).ln(),
            |l| -l.diagonals[0].min(l.diagonals[1]).ln(),
        ],
        progress,
    )?;
    let [area_square, anisotropy_mean, omega_mean_rad] = means(&yardstick, map, progress)?;
    let solid_angle_sum_sr = map.solid_angle_sum_sr(SUM_ROWS, || !progress.is_cancelled())?;
    let worst_linear = linear.exp();
    let info = map.info();
    Some(Metrics {
        mapping: map,
        charts: info.chart_count(),
        area_ratio: (most_area + least_area).exp(),
        area_rms: area_square.sqrt(),
        anisotropy_mean,
        anisotropy_max: anisotropy.exp(),
        omega_mean_deg: omega_mean_rad.to_degrees(),
        omega_max_deg: omega_rad(anisotropy.exp()).to_degrees(),
        worst_linear,
        texel_budget: worst_linear * worst_linear,
        edge_ratio: (longest + shortest).exp(),
        diagonal_ratio: (long_diagonal + short_diagonal).exp(),
        solid_angle_sum_sr,
        equal_area: info.claims.equal_area,
        conformal: info.claims.conformal,
    })
}

/// Means over the charts of (D_A - 1)^2, a/b and omega in radians; infinite where the integral does not come to an end. `None` when cancelled.
fn means(yardstick: &Yardstick, map: MappingId, progress: &Progress) -> Option<[f64; 3]> {
    /// Twice as many nodes move an integral by this share at most, unless it has no limit: one that grows as a logarithm grows by
    /// several hundredths.
    const SETTLED: f64 = 2e-3;
    let [coarse, fine] = RULES.each_ref().map(|rule| {
        let info = map.info();
        let mut sum = [0.0; 3];
        for chart in 0..info.chart_count() {
            let found = integrate(info.domain, [[0.0, 1.0]; 2], rule, |u, v| {
                // The rest of the points costs nothing any more.
                if progress.is_cancelled() {
                    return [f64::NAN; 3];
                }
                let local = yardstick.at(ChartPoint::new(chart, u, v));
                local.map_or([f64::NAN; 3], |local| {
                    let off = 1.0 / local.area - 1.0;
                    [off * off, local.anisotropy, local.omega_rad()]
                })
            });
            sum.iter_mut()
                .zip(found)
                .for_each(|(sum, part)| *sum += part);
        }
        let area = f64::from(info.chart_count()) * yardstick.domain();
        sum.map(|sum| sum / area)
    });
    let settled = std::array::from_fn(|k| {
        let moved = (fine[k] - coarse[k]).abs();
        if moved <= SETTLED * fine[k].abs().max(1.0) {
            fine[k]
        } else {
            f64::INFINITY
        }
    });
    (!progress.is_cancelled()).then_some(settled)
}

/// Nodes along each side of a smooth piece.
static RULES: LazyLock<[Rule; 2]> = LazyLock::new(|| [24, 48].map(Rule::new));
