//! Where the texels of a chart sit, and which of them hold directions.

use std::ops::Range;

use super::geometry::Place;
use crate::imaging::{MapShape, Siting};
use crate::mapping::{ChartPoint, Domain, MappingId};

/// A chart's texels. Places are counted in texels: k is the middle of texel k, in either siting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    pub mapping: MappingId,
    pub size: [u32; 2],
    pub siting: Siting,
    /// Parts of a chart that filters do not look across as if it were smooth there: see [`Grid::part`].
    pub facets: u32,
}

/// Charts of fewer texels a side are one part: those of eight have texels of their own in each.
const LEAST_DIVIDED: u32 = 8;

/// Nearer to a texel's middle than this, a place is put upon it: a millionth of a texel, a thousandth of what is promised,
/// and far above the rounding of a place (4e-12 at 16384 texels). What should hit texels hits them to the bit.
const SNAP: f64 = 1.0 / (1_u64 << 20) as f64;

/// The texel at or before a place, and how far the place lies beyond it, in [0, 1).
pub(super) fn split(place: f64) -> (i32, f32) {
    let near = place.round();
    if (place - near).abs() < SNAP {
        return (near as i32, 0.0);
    }
    let whole = place.floor();
    // At most 1 - SNAP, which f32 does not round to 1.
    (whole as i32, (place - whole) as f32)
}

impl Grid {
    pub fn of(shape: &MapShape) -> Self {
        Self {
            mapping: shape.mapping,
            size: shape.size,
            siting: shape.siting,
            facets: if shape.size.iter().all(|n| *n >= LEAST_DIVIDED) {
                shape.mapping.facets()
            } else {
                1
            },
        }
    }

    /// The part of the map in which a point lies: its chart's number times the facets of a chart, and its facet. To filters a
    /// part is what a chart is to others: beyond its border lies its own gutter.
    pub fn part(&self, point: ChartPoint<f64>) -> u32 {
        if self.facets == 1 {
            return point.chart;
        }
        point.chart * self.facets + self.mapping.facet(point)
    }

    /// The place of the direction of a point beyond one of its chart's parts.
    pub fn folded(&self, facet: u32, point: ChartPoint<f64>) -> Option<Place> {
        let found = if self.facets == self.mapping.facets() {
            self.mapping.folded(facet, point)
        } else {
            self.mapping.forward(self.mapping.continued(point))
        };
        found.map(|found| self.found(found))
    }

    /// The coordinate in [0, 1] of a place along side `side` (0: across, 1: down).
    pub fn coordinate(&self, side: usize, place: f64) -> f64 {
        self.siting.coordinate(place, self.size[side])
    }

    /// The place of a coordinate: undoes [`Grid::coordinate`].
    pub fn place(&self, side: usize, coordinate: f64) -> f64 {
        let count = f64::from(self.size[side]);
        match self.siting {
            Siting::Centre => coordinate * count - 0.5,
            Siting::Edge if self.size[side] == 1 => coordinate - 0.5,
            Siting::Edge => coordinate * (count - 1.0),
        }
    }

    /// The place of a chart point.
    pub fn found(&self, point: ChartPoint<f64>) -> Place {
        Place {
            part: self.part(point),
            at: [self.place(0, point.u), self.place(1, point.v)],
        }
    }

    /// Places per unit of the coordinate: the derivative of [`Grid::place`].
    pub fn density(&self, side: usize) -> f64 {
        self.place(side, 1.0) - self.place(side, 0.0)
    }

    /// The columns of row `row` whose texels' middles lie in the mapping's domain. Empty beyond the chart.
    pub fn owned(&self, row: i32) -> Range<i32> {
        let [width, height] = self.size.map(|n| n as i32);
        if row < 0 || row >= height {
            return 0..0;
        }
        if self.mapping.info().domain == Domain::Square {
            return 0..width;
        }
        let v = self.coordinate(1, f64::from(row));
        let is_in = |column: i32| Domain::Disc.contains(self.coordinate(0, f64::from(column)), v);
        // The disc is symmetric: as many from the right as from the left, found by halving.
        let (mut out, mut first) = (0, (width + 1) / 2);
        while out < first {
            let middle = (out + first) / 2;
            if is_in(middle) {
                first = middle;
            } else {
                out = middle + 1;
            }
        }
        if out >= width - out {
            0..0
        } else {
            out..width - out
        }
    }

    /// The columns of row `row`, on the chart or off it, that a filter reaching `reach` texels may ask for.
    pub fn reached(&self, row: i32, reach: i32) -> Range<i32> {
        let [width, height] = self.size.map(|n| n as i32);
        if row < -reach || row >= height + reach {
            return 0..0;
        }
        if self.mapping.info().domain == Domain::Square {
            return -reach..width + reach;
        }
        // The disc at the row nearest to its middle among those from which this one is reached, in places.
        let [x, y] = [0, 1].map(|side| self.place(side, 0.5));
        let [across, down] = [0, 1].map(|side| 0.5 * self.density(side).max(f64::MIN_POSITIVE));
        let reach = f64::from(reach);
        let away = ((f64::from(row) - y).abs() - reach).max(0.0) / down;
        if away > 1.0 {
            return 0..0;
        }
        let half = across * (1.0 - away * away).sqrt();
        let first = (x - half - reach).ceil() as i32;
        let last = (x + half + reach).floor() as i32;
        first..last + 1
    }
}
