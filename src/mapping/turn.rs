//! How a chart lies in its cell of a picture: one of the eight symmetries of the square.

use serde::{Deserialize, Serialize};

/// The chart as it was drawn, exchanged left and right when `mirrored`, then turned clockwise by quarter turns.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize,
)]
pub struct Turn {
    quarters: u8,
    mirrored: bool,
}

impl Turn {
    /// As it was drawn.
    pub const UPRIGHT: Self = Self::new(0, false);
    /// Upside down.
    pub const HALF: Self = Self::new(2, false);

    /// `quarters` quarter turns clockwise, after an exchange of left and right when `mirrored`.
    pub const fn new(quarters: u8, mirrored: bool) -> Self {
        Self {
            quarters: quarters & 3,
            mirrored,
        }
    }

    /// All eight, those that do not mirror first.
    pub fn all() -> impl Iterator<Item = Self> {
        [false, true]
            .into_iter()
            .flat_map(|mirrored| (0..4).map(move |quarters| Self::new(quarters, mirrored)))
    }

    /// Quarter turns clockwise, 0 to 3.
    pub const fn quarters(self) -> u8 {
        self.quarters
    }

    /// Whether left and right are exchanged before the turn.
    pub const fn is_mirrored(self) -> bool {
        self.mirrored
    }

    /// Size of the cell of a chart of `size`: width and height exchanged by odd quarter turns.
    pub const fn turned(self, [width, height]: [u32; 2]) -> [u32; 2] {
        if self.quarters & 1 == 0 {
            [width, height]
        } else {
            [height, width]
        }
    }

    /// Pixel of the cell that holds the chart's texel; both counted from the left upper corner. `size` is the chart's.
    pub const fn cell_from_chart(self, [x, y]: [u32; 2], [width, height]: [u32; 2]) -> [u32; 2] {
        let x = if self.mirrored { width - 1 - x } else { x };
        match self.quarters {
            0 => [x, y],
            1 => [height - 1 - y, x],
            2 => [width - 1 - x, height - 1 - y],
            _ => [y, width - 1 - x],
        }
    }

    /// Place in the cell, in [0, 1]^2, of a place of the chart.
    pub fn cell_place(self, [u, v]: [f64; 2]) -> [f64; 2] {
        let u = if self.mirrored { 1.0 - u } else { u };
        match self.quarters {
            0 => [u, v],
            1 => [1.0 - v, u],
            2 => [1.0 - u, 1.0 - v],
            _ => [v, 1.0 - u],
        }
    }

    /// The turn that undoes this one.
    pub const fn inverse(self) -> Self {
        // A mirrored turn undoes itself: a mirror before a turn is the opposite turn before the mirror.
        if self.mirrored {
            self
        } else {
            Self::new(4 - self.quarters, false)
        }
    }

    /// First `self`, then `next`.
    pub const fn then(self, next: Self) -> Self {
        // next's mirror, moved before self's turn, turns that round.
        let quarters = if next.mirrored {
            4 - self.quarters + next.quarters
        } else {
            self.quarters + next.quarters
        };
        Self::new(quarters, self.mirrored != next.mirrored)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_make_a_group() {
        let places = [[0.2, 0.1], [0.9, 0.3]];
        for a in Turn::all() {
            for b in Turn::all() {
                for place in places {
                    let twice = b.cell_place(a.cell_place(place));
                    let once = a.then(b).cell_place(place);
                    assert!(
                        (0..2).all(|i| (twice[i] - once[i]).abs() < 1e-15),
                        "{a:?} {b:?}"
                    );
                }
            }
            assert_eq!(a.then(a.inverse()), Turn::UPRIGHT);
            let size = [3, 2];
            let [width, height] = a.turned(size);
            for x in 0..3 {
                for y in 0..2 {
                    let [i, j] = a.cell_from_chart([x, y], size);
                    let centre = [(f64::from(x) + 0.5) / 3.0, (f64::from(y) + 0.5) / 2.0];
                    let place = a.cell_place(centre);
                    let there = [
                        (f64::from(i) + 0.5) / f64::from(width),
                        (f64::from(j) + 0.5) / f64::from(height),
                    ];
                    assert!((0..2).all(|k| (place[k] - there[k]).abs() < 1e-15), "{a:?}");
                }
            }
        }
        let quarter = Turn::new(1, false);
        assert_eq!(quarter.cell_place([0.0, 0.0]), [1.0, 0.0], "clockwise");
    }
}
