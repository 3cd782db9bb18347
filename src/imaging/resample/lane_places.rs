//! Places of many texels at once.

use std::ops::Range;

use pulp::NullaryFnOnce;

use super::conversion::Conversion;
use super::geometry::Geometry;
use super::lookups::{Lookups, Places};
use crate::mapping::{AngleLanes, DirLanes, LANES, Lane, Line, MappingId, PointLanes};
use crate::math::Isa;
use crate::math::floor_and_rest;

/// Places for mappings that compute many directions at once.
///
/// What columns and rows have in common is computed once for the plan in f64; the rest in f32, with whole parts kept apart, so that
/// charts of 16384 texels are resolved too. Where columns of the target are meridians of the source, no longitude is left to compute.
#[derive(Clone, Debug)]
pub(super) struct LanePlaces {
    pub isa: Isa,
    source: MappingId,
    target: MappingId,
    /// The four numbers of each column, with room for a whole block from any column on.
    columns: [Vec<f32>; 4],
    rows: Vec<Line>,
    /// For each chart whose columns lie in columns of the source.
    meridians: Vec<Option<Meridians>>,
    turn: Option<[[f32; 3]; 3]>,
    /// place = coordinate * scale + offset, in source texels across and down.
    scale: [f32; 2],
    offset: [f32; 2],
}

/// Source columns of a chart's columns.
#[derive(Clone, Debug)]
struct Meridians {
    /// With room for a whole block from any column on.
    columns: Vec<i32>,
    right: Vec<f32>,
    /// The turn has exchanged north and south.
    is_upside_down: bool,
}

/// The places of [`LANES`] texels: [`Lookups`] of a fixed length.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(super) struct PlaceLanes {
    pub chart: [u32; LANES],
    pub column: [i32; LANES],
    pub row: [i32; LANES],
    pub right: Lane,
    pub below: Lane,
}

/// What a block needs in between.
#[derive(Clone, Debug, Default)]
pub(super) struct LaneScratch {
    dirs: DirLanes,
    latitudes: AngleLanes,
    points: PointLanes,
}

impl Default for PlaceLanes {
    fn default() -> Self {
        Self {
            chart: [Lookups::NOWHERE; LANES],
            column: [0; LANES],
            row: [0; LANES],
            right: [0.0; LANES],
            below: [0.0; LANES],
        }
    }
}

impl LanePlaces {
    /// `None` where a mapping has no such form, or places are in proportion anyway.
    pub fn new(geometry: &Geometry, isa: Isa) -> Option<Self> {
        let (source, target) = (&geometry.source, &geometry.target);
        let is_able = source.mapping.has_lanes() && target.mapping.has_lanes();
        // Lanes know charts, not facets.
        if !is_able || source.facets > 1 || geometry.is_proportional() {
            return None;
        }
        // Only turned about y, or upside down, small x and z stay small.
        let [[_, b, _], [c, _, d], [_, e, _]] = geometry.turn;
        let is_upright = [b, c, d, e].iter().all(|mixed| *mixed == 0.0);
        if source.mapping.lanes_have_poles() && !is_upright {
            return None;
        }
        let line = |side: usize, index: u32| {
            let mut at = [0.0; 2];
            at[side] = f64::from(index);
            let point = geometry.target_point(0, at);
            target
                .mapping
                .line(side, if side == 0 { point.u } else { point.v })
        };
        let [width, height] = target.size;
        let mut columns = [const { Vec::new() }; 4];
        for column in 0..width + LANES as u32 {
            for (list, number) in columns.iter_mut().zip(line(0, column.min(width - 1))) {
                list.push(number);
            }
        }
        let charts = 0..target.mapping.info().chart_count();
        let is_turned = geometry.turn != Conversion::UNTURNED;
        Some(Self {
            isa,
            source: source.mapping,
            target: target.mapping,
            columns,
            rows: (0..height).map(|row| line(1, row)).collect(),
            meridians: charts
                .map(|chart| Meridians::new(geometry, chart).filter(|_| is_upright))
                .collect(),
            turn: is_turned.then(|| geometry.turn.map(|row| row.map(|c| c as f32))),
            scale: [0, 1].map(|side| source.density(side) as f32),
            offset: [0, 1].map(|side| source.place(side, 0.0) as f32),
        })
    }

    /// The places of the texels from `column` on.
    #[inline(always)]
    pub fn fill_lanes(
        &self,
        chart: u32,
        row: u32,
        column: u32,
        scratch: &mut LaneScratch,
        places: &mut PlaceLanes,
    ) {
        let LaneScratch {
            dirs,
            latitudes,
            points,
        } = scratch;
        let first = column as usize;
        let mut columns: [&Lane; 4] = [&[0.0; LANES]; 4];
        for (lane, list) in columns.iter_mut().zip(&self.columns) {
            if let Some(found) = list.get(first..).and_then(|list| list.first_chunk()) {
                *lane = found;
            }
        }
        let Some(&row) = self.rows.get(row as usize) else {
            return;
        };
        let [scale, offset] = [self.scale, self.offset];
        if let Some(Some(meridians)) = self.meridians.get(chart as usize) {
            self.target.latitude_lanes(columns, row, latitudes);
            if meridians.is_upside_down {
                for k in 0..LANES {
                    latitudes.base[k] = -latitudes.base[k];
                    latitudes.rest[k] = -latitudes.rest[k];
                }
            }
            self.source.parallel_lanes(latitudes, points);
            meridians.fill(first, places);
            for k in 0..LANES {
                (places.row[k], places.below[k]) =
                    placed(points.base_v[k], points.rest_v[k], scale[1], offset[1]);
            }
            return;
        }
        self.target.inverse_lanes(chart, columns, row, dirs);
        if let Some([a, b, c]) = self.turn {
            for k in 0..LANES {
                let (x, y, z) = (dirs.x[k], dirs.y[k], dirs.z[k]);
                dirs.x[k] = a[0] * x + a[1] * y + a[2] * z;
                dirs.y[k] = b[0] * x + b[1] * y + b[2] * z;
                dirs.z[k] = c[0] * x + c[1] * y + c[2] * z;
            }
        }
        self.source.forward_lanes(dirs, points);
        places.chart = points.chart;
        for k in 0..LANES {
            (places.column[k], places.right[k]) =
                placed(points.base_u[k], points.rest_u[k], scale[0], offset[0]);
        }
        for k in 0..LANES {
            (places.row[k], places.below[k]) =
                placed(points.base_v[k], points.rest_v[k], scale[1], offset[1]);
        }
    }
}

impl Meridians {
    fn new(geometry: &Geometry, chart: u32) -> Option<Self> {
        let (source, target) = (&geometry.source, &geometry.target);
        if !source.mapping.has_parallels() || !target.mapping.has_meridians(chart) {
            return None;
        }
        let [width, height] = target.size;
        // Any row tells the longitude; far from the poles it is exact.
        let row = 0.5 * f64::from(height - 1);
        let place = |column: u32| geometry.place(chart, [f64::from(column.min(width - 1)), row]);
        let (mut columns, mut right) = (Vec::new(), Vec::new());
        for column in 0..width + LANES as u32 {
            let [x, _] = place(column)?.at;
            columns.push(x.floor() as i32);
            right.push((x - x.floor()) as f32);
        }
        Some(Self {
            columns,
            right,
            is_upside_down: geometry.turn[1][1] < 0.0,
        })
    }

    /// Chart and columns of a block.
    #[inline(always)]
    fn fill(&self, first: usize, places: &mut PlaceLanes) {
        let columns = self
            .columns
            .get(first..)
            .and_then(|list| list.first_chunk());
        let right = self.right.get(first..).and_then(|list| list.first_chunk());
        if let (Some(columns), Some(right)) = (columns, right) {
            places.chart.fill(0);
            (places.column, places.right) = (*columns, *right);
        }
    }
}

/// Texel and rest of a coordinate. The base's place is exact: a multiple of 1/8 with at most 20 more bits.
#[inline(always)]
fn placed(base: f32, rest: f32, scale: f32, offset: f32) -> (i32, f32) {
    let (whole, part) = floor_and_rest(base * scale + offset);
    let (more, part) = floor_and_rest(rest * scale + part);
    (whole.wrapping_add(more), part)
}

struct Fill<'a> {
    places: &'a LanePlaces,
    chart: u32,
    row: u32,
    columns: Range<u32>,
    out: &'a mut Lookups,
}

impl NullaryFnOnce for Fill<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let mut scratch = LaneScratch::default();
        let mut places = PlaceLanes::default();
        let mut at = 0;
        for column in self.columns.clone().step_by(LANES) {
            self.places
                .fill_lanes(self.chart, self.row, column, &mut scratch, &mut places);
            let count = LANES.min((self.columns.end - column) as usize);
            let range = at..at + count;
            self.out.chart[range.clone()].copy_from_slice(&places.chart[..count]);
            self.out.column[range.clone()].copy_from_slice(&places.column[..count]);
            self.out.row[range.clone()].copy_from_slice(&places.row[..count]);
            self.out.right[range.clone()].copy_from_slice(&places.right[..count]);
            self.out.below[range].copy_from_slice(&places.below[..count]);
            at += count;
        }
    }
}

impl Places for LanePlaces {
    fn fill(&self, chart: u32, row: u32, columns: Range<u32>, out: &mut Lookups) {
        out.resize(columns.len());
        self.isa.run(Fill {
            places: self,
            chart,
            row,
            columns,
            out,
        });
    }
}
