//! Where in a texel's footprint the source is asked.
//!
//! A texel of the target sees the mean over its area. Bilinear lookups are means over a tent already, whose variance is
//! 1/6 of a squared source texel along each side; the footprint's, a box f texels long, is f^2/12. So n lookups are spread over
//! the share s of the box for which both together have the box's variance:
//! s^2 f^2 (1 - 1/n^2)/12 + 1/6 = f^2/12. Up to f = sqrt 2 that is one lookup in the middle, from there on the spread grows
//! without a jump; n is chosen so that lookups lie at most one source texel apart, at which tents add up to an even mean.
//! Weights are never negative: light is not rung.

use super::geometry::{Footprint, Geometry, Place, is_equal_area};
use super::strips::Run;

/// Places in a texel, relative to its middle, in texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spots {
    count: [u32; 2],
    spread: [f64; 2],
}

/// Most lookups along a side of a texel. Where a footprint is longer, as around a pole of a latlong map, the source's texels
/// there are as narrow as they are many: what is not looked up weighs nothing.
const MOST: u32 = 256;

impl Spots {
    /// `count` times `count`, evenly.
    pub fn grid(count: u32) -> Self {
        Self {
            count: [count.max(1); 2],
            spread: [1.0; 2],
        }
    }

    /// Those that a footprint needs; one for a texel without.
    pub fn of(footprint: Option<Footprint>) -> Self {
        let mut spots = Self::grid(1);
        let Some(footprint) = footprint else {
            return spots;
        };
        for (side, length) in footprint.lengths().into_iter().enumerate() {
            let square = if length.is_finite() {
                length * length
            } else {
                f64::MAX
            };
            if square <= 2.0 {
                continue;
            }
            // The spread is below sqrt(f^2 - 2)/sqrt(1 - 1/n^2); one lookup more than its length in texels keeps them a
            // texel apart.
            let count = ((square - 2.0).sqrt().ceil() + 1.0).min(f64::from(MOST));
            spots.count[side] = count as u32;
            let spread = (1.0 - 2.0 / square) / (1.0 - 1.0 / (count * count));
            spots.spread[side] = spread.sqrt().min(1.0);
        }
        spots
    }

    /// How many places.
    pub const fn len(&self) -> u32 {
        self.count[0] * self.count[1]
    }

    /// Hands out the places, row by row.
    pub fn each_row(&self, mut take: impl FnMut(&[[f64; 2]])) {
        let offset = |side: usize, index: u32| {
            let count = f64::from(self.count[side]);
            ((f64::from(index) + 0.5) / count - 0.5) * self.spread[side]
        };
        let mut row = [[0.0; 2]; 64];
        for j in 0..self.count[1] {
            let y = offset(1, j);
            for first in (0..self.count[0]).step_by(row.len()) {
                let part = (self.count[0] - first).min(row.len() as u32);
                for (spot, i) in row.iter_mut().zip(first..first + part) {
                    *spot = [offset(0, i), y];
                }
                take(&row[..part as usize]);
            }
        }
    }
}

/// What is known at the corners of a row's texels: where the source is looked up there, and the solid angle per area.
pub(super) struct Corners {
    /// Along the upper edge and along the lower one.
    rows: [Vec<(Option<Place>, f64)>; 2],
}

impl Corners {
    pub fn of(geometry: &Geometry, run: &Run) -> Self {
        let weighs = !is_equal_area(geometry.target.mapping);
        let corner = |column: u32, y: f64| {
            let at = [f64::from(column) - 0.5, f64::from(run.row) + y];
            let weight = if weighs {
                geometry.weight(run.chart, at)
            } else {
                1.0
            };
            (geometry.place(run.chart, at), weight)
        };
        let rows = [-0.5, 0.5].map(|y| {
            let columns = run.columns.start..=run.columns.end;
            columns.map(|column| corner(column, y)).collect()
        });
        Self { rows }
    }

    /// The texel of the run between its corners, if its places lie nearly evenly there.
    pub fn patch(&self, index: usize, middle: Place) -> Option<Patch> {
        let corners =
            |row: &Vec<(Option<Place>, f64)>| Some([*row.get(index)?, *row.get(index + 1)?]);
        let corners = [corners(&self.rows[0])?, corners(&self.rows[1])?];
        let mut patch = Patch {
            part: middle.part,
            places: [[[0.0; 2]; 2]; 2],
            rise: middle.at,
            weights: corners.map(|row| row.map(|(_, weight)| weight)),
        };
        for (places, row) in patch.places.iter_mut().zip(corners) {
            for (at, (place, weight)) in places.iter_mut().zip(row) {
                let place = place.filter(|place| place.part == middle.part)?;
                *at = place.at;
                for (rise, at) in patch.rise.iter_mut().zip(place.at) {
                    *rise -= 0.25 * at;
                }
                if weight <= 0.0 {
                    return None;
                }
            }
        }
        // The jump of a seam and the turn about a pole are far larger than this.
        patch
            .rise
            .iter()
            .all(|rise| rise.abs() < EVEN)
            .then_some(patch)
    }
}

/// Places that deviate less in a texel's middle from the mean of those at its corners, in source texels, follow from both.
const EVEN: f64 = 1.0 / 32.0;

/// A texel whose places follow from those at its corners and its middle.
pub(super) struct Patch {
    part: u32,
    places: [[[f64; 2]; 2]; 2],
    /// How far the middle lies from the mean of the corners.
    rise: [f64; 2],
    weights: [[f64; 2]; 2],
}

impl Patch {
    /// Place and weight of a spot, in texels from the middle.
    pub fn at(&self, [x, y]: [f64; 2]) -> (Place, f64) {
        let mix = |from: f64, to: f64, at: f64| from + (to - from) * (at + 0.5);
        let hill = (1.0 - 4.0 * x * x) * (1.0 - 4.0 * y * y);
        let [upper, lower] = self.places;
        let at = [0, 1].map(|side| {
            let between = mix(
                mix(upper[0][side], upper[1][side], x),
                mix(lower[0][side], lower[1][side], x),
                y,
            );
            between + hill * self.rise[side]
        });
        let [upper, lower] = self.weights.map(|[left, right]| mix(left, right, x));
        (
            Place {
                part: self.part,
                at,
            },
            mix(upper, lower, y),
        )
    }
}
