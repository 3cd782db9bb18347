//! The texels around a map's parts, which stand for light that other parts hold.

use std::ops::Range;

use super::geometry::Place;
use super::grid::Grid;
use super::parts::{PartRow, part_rows};
use super::strips::Threads;
use crate::mapping::ChartPoint;

/// Which texels beyond the map's parts (see [`Grid::part`]) a filter asks for, and where their light comes from. Depends on
/// shapes alone.
///
/// A gutter texel stands for the direction that the mapping's inverse continues to; its light is found where that direction
/// really lies. Rows hold what is reached less what the part owns, so the memory is that of the seams: 11 bytes a texel, and 12 or
/// 16 for its light.
#[derive(Clone, Debug)]
pub(super) struct Gutter {
    reach: i32,
    size: [u32; 2],
    facets: u32,
    /// Of each facet the rows from `reach` above the chart to `reach` below it.
    rows: Vec<Row>,
    /// Gutter texels of one chart.
    per_chart: usize,
    /// Where each gutter texel of each chart is looked up.
    sources: Vec<Source>,
}

/// Where a gutter texel gets its light from. Places are counted from the one before the first texel on, in steps of a
/// [`Source::STEPS`]th, as near as [`super::grid::split`] tells them apart. Beyond a rim a texel's light is found from few
/// that lie far, so that less would show.
///
/// The part, or [`Source::NOWHERE`], and the steps across and down, five bytes each.
#[derive(Clone, Copy, Debug, Default)]
struct Source([u8; 11]);

impl Source {
    /// More than any mapping has parts.
    const NOWHERE: u8 = u8::MAX;

    const STEPS: u64 = 1 << 20;

    fn new(place: Option<Place>) -> Self {
        let mut bytes = [Self::NOWHERE; 11];
        if let Some(place) = place
            && let Ok(part) = u8::try_from(place.part)
        {
            bytes[0] = part;
            for (bytes, at) in bytes[1..].chunks_exact_mut(5).zip(place.at) {
                let steps = ((at + 1.0) * Self::STEPS as f64).round() as u64;
                bytes.copy_from_slice(&steps.to_le_bytes()[..5]);
            }
        }
        Self(bytes)
    }

    /// The part, the texel at or left of and above the place, and how far the place is from it.
    fn get(self) -> Option<(u32, [i32; 2], [f32; 2])> {
        let [part, a, b, c, d, e, f, g, h, i, j] = self.0;
        let steps = [[a, b, c, d, e], [f, g, h, i, j]]
            .map(|[a, b, c, d, e]| u64::from_le_bytes([a, b, c, d, e, 0, 0, 0]));
        (part != Self::NOWHERE).then(|| {
            (
                u32::from(part),
                steps.map(|steps| (steps / Self::STEPS) as i32 - 1),
                steps.map(|steps| (steps % Self::STEPS) as f32 / Self::STEPS as f32),
            )
        })
    }
}

/// A part's row, and the indices of its gutter's first texels left and right of its own.
#[derive(Clone, Debug)]
struct Row {
    texels: PartRow,
    left: usize,
    right: usize,
}

impl Row {
    /// The column of the gutter texel with an index that is one of this row's.
    fn column(&self, index: usize) -> i32 {
        let PartRow { own, reached } = &self.texels;
        if index < self.right {
            reached.start + (index - self.left) as i32
        } else {
            own.end + (index - self.right) as i32
        }
    }
}

/// A texel of a chart: one of its own, or one of the gutter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slot {
    Own,
    Gutter(usize),
    /// Nothing reaches there.
    Beyond,
}

impl Gutter {
    /// The gutter of a map's parts for filters that reach `reach` texels beyond the place.
    pub fn new(grid: &Grid, reach: i32, threads: &Threads) -> Self {
        let mut per_chart = 0;
        let rows: Vec<Row> = part_rows(grid, reach)
            .into_iter()
            .map(|texels| {
                let left = per_chart;
                let right = left + (texels.own.start - texels.reached.start) as usize;
                per_chart = right + (texels.reached.end - texels.own.end) as usize;
                Row {
                    texels,
                    left,
                    right,
                }
            })
            .collect();
        let charts = grid.mapping.info().chart_count();
        let height = grid.size[1] as usize + 2 * reach as usize;
        let source = |index: usize| {
            let (chart, index) = (index / per_chart, index % per_chart);
            let line = rows.partition_point(|row| row.left <= index) - 1;
            let (facet, y) = (line / height, (line % height) as i32 - reach);
            let x = rows[line].column(index);
            // A chart of few texels has a gutter wider than the chart: the inverse goes on for half a chart only.
            let coordinate =
                |side, place: i32| grid.coordinate(side, f64::from(place)).clamp(-0.45, 1.45);
            let point = ChartPoint::new(chart as u32, coordinate(0, x), coordinate(1, y));
            Source::new(grid.folded(facet as u32, point))
        };
        let mut sources = vec![Source::default(); per_chart * charts as usize];
        threads.fill_each(&mut sources, source);
        Self {
            reach,
            size: grid.size,
            facets: grid.facets,
            rows,
            per_chart,
            sources,
        }
    }

    /// A row of a part; beyond those that are there, the nearest.
    fn row(&self, facet: u32, row: i32) -> &Row {
        let height = self.size[1] as i32 + 2 * self.reach;
        let row = (row + self.reach).clamp(0, height - 1) as usize;
        &self.rows[facet as usize * height as usize + row]
    }

    /// Chart and facet of a part.
    pub fn chart(&self, part: u32) -> (u32, u32) {
        if self.facets == 1 {
            (part, 0)
        } else {
            (part / self.facets, part % self.facets)
        }
    }

    /// Whether the block of texels is the part's own.
    pub fn owns(&self, facet: u32, columns: Range<i32>, rows: Range<i32>) -> bool {
        // Parts are convex, so the first and the last row decide. Rows beyond the gutter's own nothing.
        [rows.start, rows.end - 1].into_iter().all(|row| {
            let own = &self.row(facet, row).texels.own;
            (0..self.size[1] as i32).contains(&row)
                && own.start <= columns.start
                && columns.end <= own.end
        })
    }

    #[inline]
    pub fn slot(&self, part: u32, column: i32, row: i32) -> Slot {
        let (chart, facet) = self.chart(part);
        let Row {
            texels: PartRow { own, reached },
            left,
            right,
        } = self.row(facet, row);
        if own.contains(&column) {
            return Slot::Own;
        }
        if reached.is_empty() {
            return Slot::Beyond;
        }
        let column = column.clamp(reached.start, reached.end - 1);
        let chart = chart as usize * self.per_chart;
        Slot::Gutter(
            chart
                + if column < own.start {
                    left + (column - reached.start) as usize
                } else {
                    right + (column - own.end) as usize
                },
        )
    }

    /// How many gutter texels there are.
    pub const fn len(&self) -> usize {
        self.sources.len()
    }

    /// The chart's own texel nearest to a gutter texel's place: chart, column, row.
    pub fn nearest_own(&self, index: usize) -> Option<(u32, [i32; 2])> {
        let (part, texel, rest) = self.sources[index].get()?;
        let (chart, _) = self.chart(part);
        let [mut column, mut row] = [0, 1].map(|side| {
            (texel[side] + i32::from(rest[side] >= 0.5)).clamp(0, self.size[side] as i32 - 1)
        });
        if self.facets == 1 {
            let own = |row: i32| &self.row(0, row).texels.own;
            // A disc's first and last rows may have no texel of their own, the middle row has.
            let middle = self.size[1] as i32 / 2;
            while own(row).is_empty() && row != middle {
                row += (middle - row).signum();
            }
            if own(row).is_empty() {
                return None;
            }
            column = column.clamp(own(row).start, own(row).end - 1);
        }
        Some((chart, [column, row]))
    }

    /// The four texels around a gutter texel's place: part, texel, weight.
    pub fn around(&self, index: usize) -> impl Iterator<Item = (u32, [i32; 2], f32)> {
        let source = self.sources[index].get();
        [[0, 0], [1, 0], [0, 1], [1, 1]]
            .into_iter()
            .filter_map(move |step: [i32; 2]| {
                let (part, texel, rest) = source?;
                let share = |side: usize| {
                    if step[side] == 0 {
                        1.0 - rest[side]
                    } else {
                        rest[side]
                    }
                };
                let weight = share(0) * share(1);
                (weight > 0.0).then_some((
                    part,
                    [0, 1].map(|side| texel[side] + step[side]),
                    weight,
                ))
            })
    }
}
