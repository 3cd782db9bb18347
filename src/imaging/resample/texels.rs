//! The source's texels where they lie, and the gutter around them.

use super::filter::Mix;
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

/// Most sweeps over the gutter, each finding every texel's light again from the others'. A square chart's gutter needs two, since
/// its texels lie over texels that the neighbour owns, or over its gutter at a corner; along rims a fourth changes the sixth digit.
const SWEEPS: u32 = 4;

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
        let count = self.gutter.lookups.len();
        for index in 0..count {
            self.light[index] = self.nearest_own(index);
        }
        if is_nearest {
            return;
        }
        for _ in 0..SWEEPS {
            let mut is_settled = true;
            for index in 0..count {
                let light = self.settled(index);
                is_settled &= light == self.light[index];
                self.light[index] = light;
            }
            if is_settled {
                break;
            }
        }
    }

    /// The chart's own texel nearest to a gutter texel's place.
    fn nearest_own(&self, index: usize) -> Pixel {
        let Gutter {
            lookups,
            rows,
            reach,
            ..
        } = self.gutter;
        let chart = lookups.chart[index];
        if chart == Lookups::NOWHERE {
            return [0.0; 4];
        }
        let next = |rest: f32| i32::from(rest >= 0.5);
        let height = rows.len() as i32 - 2 * reach;
        let mut row = (lookups.row[index] + next(lookups.below[index])).clamp(0, height - 1);
        let own = |row: i32| &rows[(row + reach) as usize].own;
        // A disc's first and last rows may have no texel of their own, the middle row has.
        while own(row).is_empty() && row != height / 2 {
            row += (height / 2 - row).signum();
        }
        if own(row).is_empty() {
            return [0.0; 4];
        }
        let column = lookups.column[index] + next(lookups.right[index]);
        self.own(chart, column.clamp(own(row).start, own(row).end - 1), row)
    }

    /// The four texels around a gutter texel's place, and their weights.
    fn around(&self, index: usize) -> impl Iterator<Item = (u32, [i32; 2], f32)> {
        let lookups = &self.gutter.lookups;
        let (chart, column, row) = (
            lookups.chart[index],
            lookups.column[index],
            lookups.row[index],
        );
        let (right, below) = (lookups.right[index], lookups.below[index]);
        [(0, 0), (1, 0), (0, 1), (1, 1)]
            .into_iter()
            .filter_map(move |(x, y)| {
                let across = if x == 0 { 1.0 - right } else { right };
                let down = if y == 0 { 1.0 - below } else { below };
                let weight = across * down;
                (weight > 0.0 && chart != Lookups::NOWHERE).then_some((
                    chart,
                    [column + x, row + y],
                    weight,
                ))
            })
    }

    /// The light of a gutter texel, as between the four texels around its place.
    ///
    /// Just beyond a rim, the texels around that place lie just beyond the other side's rim, and theirs is this texel again.
    /// Passing light to and fro between the two would take for ever, so where a texel of the gutter comes in, its own four are
    /// put in its place, and what comes back to this texel is left out of the mean: that solves the pair.
    fn settled(&self, index: usize) -> Pixel {
        let mut mix = Mix::around(self.light[index]);
        for (chart, [column, row], weight) in self.around(index) {
            match self.gutter.slot(chart, column, row) {
                Slot::Own => mix.add(self.own(chart, column, row), weight),
                Slot::Gutter(other) if other == index => {}
                Slot::Gutter(other) => {
                    for (chart, [column, row], share) in self.around(other) {
                        let slot = self.gutter.slot(chart, column, row);
                        if slot != Slot::Gutter(index) {
                            mix.add(self.in_slot(slot, chart, column, row), weight * share);
                        }
                    }
                }
                Slot::Beyond => {}
            }
        }
        mix.mean()
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
        self.in_slot(self.gutter.slot(chart, column, row), chart, column, row)
    }

    fn in_slot(&self, slot: Slot, chart: u32, column: i32, row: i32) -> Pixel {
        match slot {
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
