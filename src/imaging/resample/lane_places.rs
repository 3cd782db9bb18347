//! Places of many texels at once.

use std::ops::Range;

use pulp::NullaryFnOnce;

use super::conversion::Conversion;
use super::geometry::{Geometry, Place};
use super::lookups::{Lookups, Places};
use super::strips::Threads;
use crate::mapping::{AngleLanes, DirLanes, LANES, Lane, Line, MappingId, PointLanes, cube_face};
use crate::math::{Isa, Vec3, floor_and_rest};

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
    /// Where columns are meridians, rows parallels, and the source knows places of both: the charts that the columns cross. Columns
    /// and rows then hold the source's numbers, not the target's.
    graticule: Option<Vec<u32>>,
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
    /// v on the equator, and what is added for each turn of the target's latitude: less where the turn has exchanged north and south.
    parallels: [f32; 2],
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
    pub fn new(geometry: &Geometry, isa: Isa, threads: &Threads) -> Option<Self> {
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
        let charts = 0..target.mapping.info().chart_count();
        let has_graticule = is_upright
            && source.mapping.has_faces()
            && target.mapping.parallels().is_some()
            && charts
                .clone()
                .all(|chart| target.mapping.has_meridians(chart));
        let [width, height] = target.size;
        let line = |side: usize, index: u32| {
            // Any row tells a longitude, any column a latitude; far from the poles longitudes are exact.
            let mut at = [0.0, 0.5 * f64::from(height - 1)];
            at[side] = f64::from(index);
            if !has_graticule {
                let point = geometry.target_point(0, at);
                let coordinate = [point.u, point.v][side];
                return Some((0, target.mapping.line(side, coordinate)));
            }
            let Vec3 { x, y, z } = geometry.source_dir(0, at)?;
            let radius = x.hypot(z);
            Some(if side == 0 {
                cube_face::meridian([x / radius, z / radius])
            } else {
                (0, cube_face::parallel([radius, y]))
            })
        };
        let (mut columns, mut crossed) = ([const { Vec::new() }; 4], Vec::new());
        for column in 0..width + LANES as u32 {
            let (chart, numbers) = line(0, column.min(width - 1))?;
            crossed.push(chart);
            for (list, number) in columns.iter_mut().zip(numbers) {
                list.push(number);
            }
        }
        let rows = (0..height).map(|row| Some(line(1, row)?.1));
        let is_turned = geometry.turn != Conversion::UNTURNED;
        Some(Self {
            isa,
            source: source.mapping,
            target: target.mapping,
            columns,
            rows: rows.collect::<Option<_>>()?,
            graticule: has_graticule.then_some(crossed),
            meridians: charts
                .map(|chart| Meridians::new(geometry, chart, threads).filter(|_| is_upright))
                .collect(),
            turn: is_turned.then(|| geometry.turn.map(|row| row.map(|c| c as f32))),
            scale: [0, 1].map(|side| source.density(side) as f32),
            offset: [0, 1].map(|side| source.place(side, 0.0) as f32),
        })
    }

    /// The places of the texels from `column` on. `ROUNDS`: see [`floor_and_rest`].
    #[inline(always)]
    pub fn fill_lanes<const ROUNDS: bool>(
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
            meridians.fill(first, places);
            // v = equator + slope (base + rest)
            let [equator, slope] = meridians.parallels;
            let base = equator + slope * latitudes.base;
            for k in 0..LANES {
                (places.row[k], places.below[k]) = placed::<ROUNDS>(
                    base,
                    latitudes.rest[k],
                    [scale[1], slope * scale[1]],
                    offset[1],
                );
            }
            return;
        }
        if let Some(crossed) = &self.graticule {
            if let Some(charts) = crossed.get(first..).and_then(|list| list.first_chunk()) {
                self.source.graticule_lanes((charts, columns), row, points);
            }
        } else {
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
        }
        places.chart = points.chart;
        let [scale_u, scale_v] = scale.map(|scale| [scale; 2]);
        if let Some(base) = points.base {
            for k in 0..LANES {
                (places.column[k], places.right[k]) =
                    placed::<ROUNDS>(base, points.rest_u[k], scale_u, offset[0]);
                (places.row[k], places.below[k]) =
                    placed::<ROUNDS>(base, points.rest_v[k], scale_v, offset[1]);
            }
            return;
        }
        for k in 0..LANES {
            (places.column[k], places.right[k]) =
                placed::<ROUNDS>(points.base_u[k], points.rest_u[k], scale_u, offset[0]);
        }
        for k in 0..LANES {
            (places.row[k], places.below[k]) =
                placed::<ROUNDS>(points.base_v[k], points.rest_v[k], scale_v, offset[1]);
        }
    }
}

impl Meridians {
    fn new(geometry: &Geometry, chart: u32, threads: &Threads) -> Option<Self> {
        let (source, target) = (&geometry.source, &geometry.target);
        let [equator, slope] = source.mapping.parallels()?;
        if !target.mapping.has_meridians(chart) {
            return None;
        }
        let [width, height] = target.size;
        // Any row tells the longitude; far from the poles it is exact.
        let row = 0.5 * f64::from(height - 1);
        let place = |column: u32| geometry.place(chart, [f64::from(column.min(width - 1)), row]);
        let mut places = vec![None; width as usize + LANES];
        threads.fill_each(&mut places, |column| place(column as u32));
        let places = places.into_iter().collect::<Option<Vec<_>>>()?;
        let whole = |place: &Place| place.at[0].floor();
        Some(Self {
            columns: places.iter().map(|place| whole(place) as i32).collect(),
            right: places
                .iter()
                .map(|place| (place.at[0] - whole(place)) as f32)
                .collect(),
            parallels: [equator, slope * geometry.turn[1][1].signum() as f32],
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

/// Texel and rest of a coordinate in two parts, each with its scale. The base's place is exact: a multiple of 1/8 with at most 20
/// more bits.
#[inline(always)]
fn placed<const ROUNDS: bool>(base: f32, rest: f32, scale: [f32; 2], offset: f32) -> (i32, f32) {
    let (whole, part) = floor_and_rest::<ROUNDS>(base * scale[0] + offset);
    let (more, part) = floor_and_rest::<ROUNDS>(rest * scale[1] + part);
    (whole.wrapping_add(more), part)
}

/// A run of texels, compiled for a set of instructions.
struct Fill<'a, const ROUNDS: bool> {
    places: &'a LanePlaces,
    chart: u32,
    row: u32,
    columns: Range<u32>,
    out: &'a mut Lookups,
}

impl<const ROUNDS: bool> NullaryFnOnce for Fill<'_, ROUNDS> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let mut scratch = LaneScratch::default();
        let mut places = PlaceLanes::default();
        let mut at = 0;
        for column in self.columns.clone().step_by(LANES) {
            self.places.fill_lanes::<ROUNDS>(
                self.chart,
                self.row,
                column,
                &mut scratch,
                &mut places,
            );
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
        if self.rounds() {
            self.fill_by::<true>(chart, row, columns, out);
        } else {
            self.fill_by::<false>(chart, row, columns, out);
        }
    }
}

impl LanePlaces {
    fn fill_by<const ROUNDS: bool>(
        &self,
        chart: u32,
        row: u32,
        columns: Range<u32>,
        out: &mut Lookups,
    ) {
        self.isa.run(Fill::<ROUNDS> {
            places: self,
            chart,
            row,
            columns,
            out,
        });
    }

    /// Whether the instructions round: see [`floor_and_rest`].
    pub fn rounds(&self) -> bool {
        self.isa != Isa::Baseline
    }
}
