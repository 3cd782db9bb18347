//! Where in a texel's footprint the source is asked.
//!
//! A texel of the target sees the mean over its area. Bilinear lookups are means over a tent already, whose variance is
//! 1/6 of a squared source texel along each side; the footprint's, a box f texels long, is f^2/12. So n lookups are spread over
//! the share s of the box for which both together have the box's variance:
//! s^2 f^2 (1 - 1/n^2)/12 + 1/6 = f^2/12. Up to f = sqrt 2 that is one lookup in the middle, from there on the spread grows
//! without a jump; n is chosen so that lookups lie at most one source texel apart, at which tents add up to an even mean.
//! Weights are never negative: light is not rung.

use super::geometry::Footprint;

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
