//! How charts are unfolded into one picture.
//!
//! Picture coordinates (x, y) are in [0, 1]^2, x to the right and y downwards, over the whole picture.

use serde::Serialize;

use super::ChartPoint;

/// The arrangement of a mapping's charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layout {
    /// One chart fills the picture.
    Single,
    /// Two charts side by side.
    Pair,
    /// Six faces as a horizontal cross, seen from inside: +y above and -y below +z; -x, +z, +x, -z from left to right.
    Cross,
}

impl Layout {
    /// Columns and rows of the grid of cells.
    pub const fn grid(self) -> [u32; 2] {
        match self {
            Self::Single => [1, 1],
            Self::Pair => [2, 1],
            Self::Cross => [4, 3],
        }
    }

    /// Column and row of each chart's cell, by chart index.
    pub const fn cells(self) -> &'static [[u32; 2]] {
        match self {
            Self::Single => &[[0, 0]],
            Self::Pair => &[[0, 0], [1, 0]],
            // +x -x +y -y +z -z
            Self::Cross => &[[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]],
        }
    }

    /// Width over height of the picture when a chart's is `aspect`.
    pub fn picture_aspect(self, aspect: f64) -> f64 {
        let [columns, rows] = self.grid();
        aspect * f64::from(columns) / f64::from(rows)
    }

    /// Where a chart point lies in the picture.
    pub fn picture_from_chart(self, point: ChartPoint<f64>) -> Option<[f64; 2]> {
        let cell = self.cells().get(point.chart as usize)?;
        let [columns, rows] = self.grid();
        Some([
            (f64::from(cell[0]) + point.u) / f64::from(columns),
            (f64::from(cell[1]) + point.v) / f64::from(rows),
        ])
    }

    /// The chart point at a place of the picture; `None` beside the charts.
    pub fn chart_from_picture(self, [x, y]: [f64; 2]) -> Option<ChartPoint<f64>> {
        if !(0.0..=1.0).contains(&x) || !(0.0..=1.0).contains(&y) {
            return None;
        }
        let grid = self.grid();
        let place = [x * f64::from(grid[0]), y * f64::from(grid[1])];
        let cell = [0, 1].map(|i| (place[i] as u32).min(grid[i] - 1));
        let chart = self.cells().iter().position(|c| *c == cell)?;
        Some(ChartPoint::new(
            chart as u32,
            place[0] - f64::from(cell[0]),
            place[1] - f64::from(cell[1]),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_goes_to_its_chart_and_back() {
        for layout in [Layout::Single, Layout::Pair, Layout::Cross] {
            for chart in 0..layout.cells().len() as u32 {
                let point = ChartPoint::new(chart, 0.25, 0.75);
                let place = layout.picture_from_chart(point).unwrap();
                assert_eq!(layout.chart_from_picture(place), Some(point));
                assert_ne!(layout.chart_from_picture([place[1], place[0]]), Some(point));
            }
            assert_eq!(layout.chart_from_picture([1.1, 0.5]), None);
            assert_eq!(
                layout.picture_from_chart(ChartPoint::new(9, 0.0, 0.0)),
                None
            );
        }
        assert_eq!(
            Layout::Cross.chart_from_picture([0.01, 0.01]),
            None,
            "a cross has empty corners"
        );
    }
}
