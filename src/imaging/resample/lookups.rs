//! Where a run of target texels looks in the source.

use std::ops::Range;

use super::geometry::{Geometry, Place};
use super::grid::split;

/// Places in the source, one for each texel of a run of a target row; the same index in every list.
///
/// A place is split into the whole texel and the rest, so that charts of 16384 texels are resolved to far less than a
/// thousandth of a texel: texel k has its centre at `column` k with `right` 0.
#[derive(Clone, Debug, Default)]
pub(super) struct Lookups {
    /// Part of the source, where its charts are whole the chart (see [`super::grid::Grid::part`]); [`Lookups::NOWHERE`] where the target's texel has no direction.
    pub chart: Vec<u32>,
    /// The texel at or left of the place; -1 left of the first texel's centre.
    pub column: Vec<i32>,
    /// The texel at or above the place; -1 above the first row's centre.
    pub row: Vec<i32>,
    /// How far to the right of that texel's centre, in [0, 1).
    pub right: Vec<f32>,
    /// How far below that texel's centre, in [0, 1).
    pub below: Vec<f32>,
}

impl Lookups {
    /// Stands for no chart: the target's texel lies outside of its disc.
    pub const NOWHERE: u32 = u32::MAX;

    /// Makes room for `count` places.
    pub fn resize(&mut self, count: usize) {
        self.chart.resize(count, Self::NOWHERE);
        self.column.resize(count, 0);
        self.row.resize(count, 0);
        self.right.resize(count, 0.0);
        self.below.resize(count, 0.0);
    }

    /// Puts a place, or nowhere, at an index.
    pub fn set(&mut self, index: usize, place: Option<Place>) {
        let Some(place) = place else {
            self.chart[index] = Self::NOWHERE;
            return;
        };
        self.chart[index] = place.part;
        (self.column[index], self.right[index]) = split(place.at[0]);
        (self.row[index], self.below[index]) = split(place.at[1]);
    }
}

/// A way to find the places. The general one asks the target's inverse and the source's forward function for every texel;
/// faster ones compute rows and columns apart, or many directions at once. All give the same places.
pub(super) trait Places: Sync {
    /// The places of the texels `columns` of row `row` of the target's chart `chart`; `out` gets that many.
    fn fill(&self, chart: u32, row: u32, columns: Range<u32>, out: &mut Lookups);
}

/// The general way: texel by texel.
impl Places for Geometry {
    fn fill(&self, chart: u32, row: u32, columns: Range<u32>, out: &mut Lookups) {
        out.resize(columns.len());
        for (index, column) in columns.enumerate() {
            out.set(
                index,
                self.place(chart, [f64::from(column), f64::from(row)]),
            );
        }
    }
}
