//! Many directions at once, component by component: the form in which a compiler uses vector instructions.
//!
//! [`Mapping::forward_lanes`] and [`Mapping::inverse_lanes`] compute [`LANES`] texels without a branch. A mapping that has no such
//! form of its own goes lane by lane through its usual functions.
//!
//! [`Mapping::forward_lanes`]: super::Mapping::forward_lanes
//! [`Mapping::inverse_lanes`]: super::Mapping::inverse_lanes

#![expect(
    clippy::needless_range_loop,
    reason = "a lane is an index into several lists at once"
)]

use super::{ChartPoint, Mapping};
use crate::math::{Real, Vec3};

/// How many at once: eight vectors of the widest kind, which hides the latency of one, and 512 bytes a component, so that
/// all that a texel needs stays in the first-level cache.
pub const LANES: usize = 128;

/// One number for each lane. Structures of them are aligned to 64 bytes, the widest vector: one that lies across two lines of the
/// cache costs two accesses, and across two pages many.
pub type Lane = [f32; LANES];

/// Directions of any length but zero.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct DirLanes {
    /// To the right.
    pub x: Lane,
    /// Up.
    pub y: Lane,
    /// Forward.
    pub z: Lane,
}

/// Angles in turns, each split as `base + rest`.
///
/// The base, which all have in common, is a multiple of 1/8, a rest at most that large, so that angles near a quarter of a turn keep
/// the digits of small ones.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct AngleLanes {
    /// A multiple of 1/8.
    pub base: f32,
    /// The rest.
    pub rest: Lane,
}

/// Chart points, each coordinate split: `u = base_u + rest_u`, and so with v.
///
/// A base is a multiple of 1/8, so its place in texels is exact, and what was computed keeps the digits of the small rest: in
/// charts of 16384 texels a coordinate in one f32 would be rounded by half a thousandth of a texel.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct PointLanes {
    /// Chart, or [`PointLanes::NOWHERE`].
    pub chart: [u32; LANES],
    /// Both bases of all, where they are but one number; then `base_u` and `base_v` mean nothing.
    pub base: Option<f32>,
    /// Exact part of u.
    pub base_u: Lane,
    /// The rest of u.
    pub rest_u: Lane,
    /// Exact part of v.
    pub base_v: Lane,
    /// The rest of v.
    pub rest_v: Lane,
}

impl PointLanes {
    /// Stands for no chart.
    pub const NOWHERE: u32 = u32::MAX;
}

impl Default for DirLanes {
    fn default() -> Self {
        Self {
            x: [0.0; LANES],
            y: [0.0; LANES],
            z: [0.0; LANES],
        }
    }
}

impl Default for AngleLanes {
    fn default() -> Self {
        Self {
            base: 0.0,
            rest: [0.0; LANES],
        }
    }
}

impl Default for PointLanes {
    fn default() -> Self {
        Self {
            chart: [Self::NOWHERE; LANES],
            base: None,
            base_u: [0.0; LANES],
            rest_u: [0.0; LANES],
            base_v: [0.0; LANES],
            rest_v: [0.0; LANES],
        }
    }
}

/// What all texels of a column, or of a row, have in common: up to four numbers of the mapping's choice.
pub type Line = [f32; 4];

/// Lane by lane through [`Mapping::forward`].
pub(super) fn forward_each<M: Mapping>(dirs: &DirLanes, points: &mut PointLanes) {
    points.base = Some(0.0);
    for k in 0..LANES {
        let point = M::forward(Vec3::new(dirs.x[k], dirs.y[k], dirs.z[k]));
        let point = point.unwrap_or(ChartPoint::new(PointLanes::NOWHERE, 0.0, 0.0));
        (points.chart[k], points.rest_u[k], points.rest_v[k]) = (point.chart, point.u, point.v);
    }
}

/// Lane by lane through [`Mapping::inverse`]; a line is its coordinate. Nowhere is the zero vector.
pub(super) fn inverse_each<M: Mapping>(
    chart: u32,
    columns: [&Lane; 4],
    row: Line,
    dirs: &mut DirLanes,
) {
    for k in 0..LANES {
        let dir = M::inverse(ChartPoint::new(chart, columns[0][k], row[0]));
        let dir = dir.unwrap_or(Vec3::new(f32::zero(), f32::zero(), f32::zero()));
        (dirs.x[k], dirs.y[k], dirs.z[k]) = (dir.x, dir.y, dir.z);
    }
}
