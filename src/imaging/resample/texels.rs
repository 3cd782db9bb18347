//! The source's texels where they lie, and the gutter around them.

use super::grid::Grid;
use super::lookups::Lookups;
use super::stored::{Decoder, Stored};
use crate::imaging::{EnvironmentMap, MapShape, Placement};
use crate::mapping::ChartPoint;
use std::ops::Range;

/// Where the pixels of a chart lie in a picture: sample 0 of the pixel of texel (0, 0), and the steps to the next texel to the
/// right and to the one below, all in samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Strides {
    pub raster: usize,
    pub base: isize,
    pub right: isize,
    pub down: isize,
}

impl Strides {
    pub fn of(placement: &Placement, shape: &MapShape, raster_width: u32) -> Self {
        let count = shape.channels.count() as isize;
        let offset = |[x, y]: [u32; 2]| (y as isize * raster_width as isize + x as isize) * count;
        let [x, y] = placement.turn.cell_from_chart([0, 0], shape.size);
        let base = offset([placement.origin[0] + x, placement.origin[1] + y]);
        // The steps do not depend on the size: those of 2 x 2 texels.
        let corner = |texel| offset(placement.turn.cell_from_chart(texel, [2, 2]));
        Self {
            raster: placement.raster,
            base,
            right: corner([1, 0]) - corner([0, 0]),
            down: corner([0, 1]) - corner([0, 0]),
        }
    }

    /// Sample 0 of a texel.
    pub fn at(&self, column: i32, row: i32) -> usize {
        (self.base + self.right * column as isize + self.down * row as isize) as usize
    }
}

/// One row of a chart with its gutter.
#[derive(Clone, Debug)]
struct Row {
    /// Columns whose texels the chart has.
    own: Range<i32>,
    /// Columns that a filter may ask for.
    reached: Range<i32>,
    /// Index of the first gutter texel left of the chart's own, and right of it.
    left: usize,
    right: usize,
}

/// Which texels beyond the charts a filter asks for, and where their light comes from. Depends on shapes alone.
///
/// A gutter texel stands for the direction that the mapping's inverse continues to; its light is found where that direction
/// really lies. Rows hold what is reached less what the chart owns, so the memory is that of the seams: 20 bytes a texel, and 16
/// for its light.
#[derive(Clone, Debug)]
pub(super) struct Gutter {
    reach: i32,
    rows: Vec<Row>,
    /// Gutter texels of one chart.
    per_chart: usize,
    /// Where each gutter texel of each chart is looked up.
    lookups: Lookups,
    /// How often the gutter's light is found again from texels that may lie in the gutter themselves.
    sweeps: u32,
}

/// A texel of a chart: one of its own, or one of the gutter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slot {
    Own,
    Gutter(usize),
    /// Nothing reaches there.
    Beyond,
}

impl Gutter {
    /// The gutter of charts for filters that reach `reach` texels beyond the place.
    pub fn new(grid: &Grid, reach: i32) -> Self {
        let mut per_chart = 0;
        let rows: Vec<Row> = (-reach..grid.size[1] as i32 + reach)
            .map(|row| {
                let reached = grid.reached(row, reach);
                let own = grid.owned(row);
                let own = if own.is_empty() {
                    reached.end..reached.end
                } else {
                    own
                };
                let reached = reached.start.min(own.start)..reached.end.max(own.end);
                let left = per_chart;
                let right = left + (own.start - reached.start) as usize;
                per_chart = right + (reached.end - own.end) as usize;
                Row {
                    own,
                    reached,
                    left,
                    right,
                }
            })
            .collect();
        let charts = grid.mapping.info().chart_count();
        let mut lookups = Lookups::default();
        lookups.resize(per_chart * charts as usize);
        let mut index = 0;
        for chart in 0..charts {
            for (row, y) in rows.iter().zip(-reach..) {
                for x in (row.reached.start..row.own.start).chain(row.own.end..row.reached.end) {
                    // A chart of few texels has a gutter wider than the chart: the inverse goes on for half a chart only.
                    let coordinate = |side, place: i32| {
                        grid.coordinate(side, f64::from(place)).clamp(-0.45, 1.45)
                    };
                    let point = ChartPoint::new(chart, coordinate(0, x), coordinate(1, y));
                    let found = grid.mapping.forward(grid.mapping.continued(point));
                    lookups.set(
                        index,
                        found.map(|found| super::geometry::Place {
                            chart: found.chart,
                            at: [grid.place(0, found.u), grid.place(1, found.v)],
                        }),
                    );
                    index += 1;
                }
            }
        }
        Self {
            reach,
            rows,
            per_chart,
            lookups,
            sweeps: SWEEPS,
        }
    }

    /// Whether the block of texels is the chart's own.
    fn owns(&self, columns: Range<i32>, rows: Range<i32>) -> bool {
        // Own columns shrink towards the disc's top and bottom, so the first and the last row decide.
        [rows.start, rows.end - 1].into_iter().all(|row| {
            let index = usize::try_from(row + self.reach).ok();
            index
                .and_then(|index| self.rows.get(index))
                .is_some_and(|row| row.own.start <= columns.start && columns.end <= row.own.end)
        })
    }

    fn slot(&self, chart: u32, column: i32, row: i32) -> Slot {
        let last = self.rows.len() as i32 - 1;
        let row = &self.rows[(row + self.reach).clamp(0, last) as usize];
        if row.own.contains(&column) {
            return Slot::Own;
        }
        if row.reached.is_empty() {
            return Slot::Beyond;
        }
        let column = column.clamp(row.reached.start, row.reached.end - 1);
        let chart = chart as usize * self.per_chart;
        Slot::Gutter(
            chart
                + if column < row.own.start {
                    row.left + (column - row.reached.start) as usize
                } else {
                    row.right + (column - row.own.end) as usize
                },
        )
    }
}

/// Neighbouring gutter texels are found from each other near a rim, where no chart owns the four texels around their place.
/// Each sweep passes light on; the weights of gutter texels are at most about a half, so that 24 leave a hundred-millionth.
const SWEEPS: u32 = 24;

/// A colour to mix, and opacity. Not premultiplied.
pub(super) type Pixel = [f32; 4];

/// The source's texels, decoded as they are read. `N`: samples a pixel.
pub(super) struct Texels<'a, S, const N: usize> {
    charts: Vec<Option<(&'a [S], Strides)>>,
    decoder: Decoder,
    gutter: &'a Gutter,
    /// Light of the gutter's texels.
    light: Vec<Pixel>,
}

impl<'a, S: Stored, const N: usize> Texels<'a, S, N> {
    /// `mix` finds the light of a place from the texels, as the filter's own way does or simpler.
    pub fn new(
        map: &'a EnvironmentMap,
        decoder: Decoder,
        gutter: &'a Gutter,
        is_nearest: bool,
    ) -> Self {
        let shape = map.shape();
        let charts = shape.charts.iter().map(|placement| {
            let placement = placement.as_ref()?;
            let raster = &map.rasters()[placement.raster];
            let strides = Strides::of(placement, shape, raster.width());
            Some((S::slice(raster.samples())?, strides))
        });
        let mut texels = Self {
            charts: charts.collect(),
            decoder,
            gutter,
            light: vec![[0.0; 4]; gutter.lookups.len()],
        };
        texels.fill_gutter(is_nearest);
        texels
    }

    fn fill_gutter(&mut self, is_nearest: bool) {
        let lookups = &self.gutter.lookups;
        for index in 0..lookups.len() {
            self.light[index] = self.nearest_own(index);
        }
        if is_nearest {
            return;
        }
        for _ in 0..self.gutter.sweeps {
            let mut moved = false;
            for index in 0..lookups.len() {
                let light = super::filter::bilinear(self, lookups, index);
                moved |= light != self.light[index];
                self.light[index] = light;
            }
            if !moved {
                break;
            }
        }
    }

    /// The nearest of the four texels around a gutter texel's place that a chart owns.
    fn nearest_own(&self, index: usize) -> Pixel {
        let lookups = &self.gutter.lookups;
        let chart = lookups.chart[index];
        if chart == Lookups::NOWHERE {
            return [0.0; 4];
        }
        let mut best: Option<(f32, [i32; 2])> = None;
        for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let texel = [lookups.column[index] + dx, lookups.row[index] + dy];
            let away =
                (lookups.right[index] - dx as f32).abs() + (lookups.below[index] - dy as f32).abs();
            if self.gutter.slot(chart, texel[0], texel[1]) == Slot::Own
                && best.is_none_or(|(least, _)| away < least)
            {
                best = Some((away, texel));
            }
        }
        best.map_or([0.0; 4], |(_, [column, row])| self.own(chart, column, row))
    }

    fn pixel(&self, samples: &[S], at: usize) -> Pixel {
        let Some(stored) = samples.get(at..at + N) else {
            return [0.0; 4];
        };
        let mut pixel = [0.0, 0.0, 0.0, 1.0];
        for (value, stored) in pixel.iter_mut().zip(&stored[..3]) {
            *value = stored.decoded(self.decoder);
        }
        if N == 4 {
            pixel[3] = stored[3].share();
        }
        pixel
    }

    fn own(&self, chart: u32, column: i32, row: i32) -> Pixel {
        match self.charts.get(chart as usize) {
            Some(Some((samples, strides))) => self.pixel(samples, strides.at(column, row)),
            _ => [0.0; 4],
        }
    }

    /// A texel of a chart or of its gutter.
    pub fn texel(&self, chart: u32, column: i32, row: i32) -> Pixel {
        match self.gutter.slot(chart, column, row) {
            Slot::Own => self.own(chart, column, row),
            Slot::Gutter(index) => self.light[index],
            Slot::Beyond => [0.0; 4],
        }
    }

    /// The K x K texels from (`column`, `row`) on, row by row.
    pub fn block<const K: usize>(&self, chart: u32, column: i32, row: i32) -> [[Pixel; K]; K] {
        let reach = K as i32;
        let mut block = [[[0.0; 4]; K]; K];
        if self.gutter.owns(column..column + reach, row..row + reach) {
            let Some(Some((samples, strides))) = self.charts.get(chart as usize) else {
                return block;
            };
            let mut start =
                strides.base + strides.right * column as isize + strides.down * row as isize;
            for line in &mut block {
                let mut at = start;
                for pixel in line {
                    *pixel = self.pixel(samples, at as usize);
                    at += strides.right;
                }
                start += strides.down;
            }
            return block;
        }
        for (line, row) in block.iter_mut().zip(row..) {
            for (pixel, column) in line.iter_mut().zip(column..) {
                *pixel = self.texel(chart, column, row);
            }
        }
        block
    }
}
