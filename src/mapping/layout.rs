//! How charts are unfolded into one picture.
//!
//! Picture coordinates (x, y) are in [0, 1]^2, x to the right and y downwards, over the whole picture.

use serde::{Deserialize, Serialize};

use super::{ChartPoint, Turn};

/// The arrangement of a mapping's charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Layout {
    /// One chart fills the picture.
    Single,
    /// Two charts side by side.
    Pair,
    /// Two charts, one above the other.
    PairColumn,
    /// Six faces as a horizontal cross, seen from inside: +y above and -y below +z; -x, +z, +x, -z from left to right.
    Cross,
    /// Six faces as a vertical cross: +y; -x, +z, +x; -y; -z below it and upside down, so that it goes on from -y.
    VerticalCross,
    /// The same with -z upright.
    VerticalCrossUpright,
    /// Six faces side by side: +x -x +y -y +z -z.
    Row,
    /// Six faces one above the other in the same order.
    Column,
    /// Three columns, two rows: +x -x +y above -y +z -z, all upright.
    #[serde(rename = "3x2")]
    ThreeByTwo,
    /// Three columns, two rows as 360-degree video has them: -x +z +x above -y -z +y, the lower three turned so that each row
    /// is without a break: -y and +y by three quarters clockwise, -z by one (FFmpeg 5.1's `eac`, found by running it).
    #[serde(rename = "3x2-turned")]
    ThreeByTwoTurned,
    /// Twelve squares down a staircase, as the HEALPix grid lies when turned by an eighth: on the diagonal those around the equator,
    /// right of it those of the north and below it those of the south, each beside what it meets but at the poles.
    Staircase,
    /// A picture for each chart.
    Faces,
}

/// Where a layout puts a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Column and row of the grid.
    pub at: [u32; 2],
    /// How the chart lies there.
    pub turn: Turn,
}

const fn upright(column: u32, row: u32) -> Cell {
    turned(column, row, 0)
}

const fn turned(column: u32, row: u32, quarters: u8) -> Cell {
    Cell {
        at: [column, row],
        turn: Turn::new(quarters, false),
    }
}

impl Layout {
    /// Every layout.
    pub const ALL: [Self; 12] = [
        Self::Single,
        Self::Pair,
        Self::PairColumn,
        Self::Cross,
        Self::VerticalCross,
        Self::VerticalCrossUpright,
        Self::Row,
        Self::Column,
        Self::ThreeByTwo,
        Self::ThreeByTwoTurned,
        Self::Staircase,
        Self::Faces,
    ];

    /// The name on the command line; a pair is the row, or the column, of two charts.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::Cross => "cross",
            Self::VerticalCross => "vertical-cross",
            Self::VerticalCrossUpright => "vertical-cross-upright",
            Self::Pair | Self::Row => "row",
            Self::PairColumn | Self::Column => "column",
            Self::ThreeByTwo => "3x2",
            Self::ThreeByTwoTurned => "3x2-turned",
            Self::Staircase => "staircase",
            Self::Faces => "faces",
        }
    }

    /// The layout of `charts` charts with this name.
    pub fn from_id(id: &str, charts: u32) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|layout| layout.id() == id && layout.holds(charts))
    }

    /// Whether that many charts can lie so.
    pub const fn holds(self, charts: u32) -> bool {
        matches!(self, Self::Faces) || self.cells().len() == charts as usize
    }

    /// Columns and rows of the grid of cells; of one chart's own picture where each has its own.
    pub const fn grid(self) -> [u32; 2] {
        match self {
            Self::Single | Self::Faces => [1, 1],
            Self::Pair => [2, 1],
            Self::PairColumn => [1, 2],
            Self::Cross => [4, 3],
            Self::VerticalCross | Self::VerticalCrossUpright => [3, 4],
            Self::Row => [6, 1],
            Self::Column => [1, 6],
            Self::ThreeByTwo | Self::ThreeByTwoTurned => [3, 2],
            Self::Staircase => [5, 5],
        }
    }

    /// Cell of each chart, by chart index; none where each has its own picture.
    pub const fn cells(self) -> &'static [Cell] {
        // Six in the order of the charts +x -x +y -y +z -z.
        match self {
            Self::Single => const { &[upright(0, 0)] },
            Self::Pair => const { &[upright(0, 0), upright(1, 0)] },
            Self::PairColumn => const { &[upright(0, 0), upright(0, 1)] },
            Self::Cross => {
                const {
                    &[
                        upright(2, 1),
                        upright(0, 1),
                        upright(1, 0),
                        upright(1, 2),
                        upright(1, 1),
                        upright(3, 1),
                    ]
                }
            }
            Self::VerticalCross => {
                const {
                    &[
                        upright(2, 1),
                        upright(0, 1),
                        upright(1, 0),
                        upright(1, 2),
                        upright(1, 1),
                        turned(1, 3, 2),
                    ]
                }
            }
            Self::VerticalCrossUpright => {
                const {
                    &[
                        upright(2, 1),
                        upright(0, 1),
                        upright(1, 0),
                        upright(1, 2),
                        upright(1, 1),
                        upright(1, 3),
                    ]
                }
            }
            Self::Row => {
                const {
                    &[
                        upright(0, 0),
                        upright(1, 0),
                        upright(2, 0),
                        upright(3, 0),
                        upright(4, 0),
                        upright(5, 0),
                    ]
                }
            }
            Self::Column => {
                const {
                    &[
                        upright(0, 0),
                        upright(0, 1),
                        upright(0, 2),
                        upright(0, 3),
                        upright(0, 4),
                        upright(0, 5),
                    ]
                }
            }
            Self::ThreeByTwo => {
                const {
                    &[
                        upright(0, 0),
                        upright(1, 0),
                        upright(2, 0),
                        upright(0, 1),
                        upright(1, 1),
                        upright(2, 1),
                    ]
                }
            }
            Self::ThreeByTwoTurned => {
                const {
                    &[
                        upright(2, 0),
                        upright(0, 0),
                        turned(2, 1, 3),
                        turned(0, 1, 3),
                        upright(1, 0),
                        turned(1, 1, 1),
                    ]
                }
            }
            Self::Staircase => {
                const {
                    &[
                        upright(1, 0),
                        upright(2, 1),
                        upright(3, 2),
                        upright(4, 3),
                        upright(0, 0),
                        upright(1, 1),
                        upright(2, 2),
                        upright(3, 3),
                        upright(0, 1),
                        upright(1, 2),
                        upright(2, 3),
                        upright(3, 4),
                    ]
                }
            }
            Self::Faces => &[],
        }
    }

    /// The cell of a chart; where each chart has its own picture, the whole of it.
    pub fn cell(self, chart: u32) -> Option<Cell> {
        match self {
            Self::Faces => Some(upright(0, 0)),
            _ => self.cells().get(chart as usize).copied(),
        }
    }

    /// Width over height of the picture when a chart's is `aspect`.
    pub fn picture_aspect(self, aspect: f64) -> f64 {
        let [columns, rows] = self.grid();
        aspect * f64::from(columns) / f64::from(rows)
    }

    /// Where a chart point lies in the picture.
    pub fn picture_from_chart(self, point: ChartPoint<f64>) -> Option<[f64; 2]> {
        let cell = self.cell(point.chart)?;
        let [columns, rows] = self.grid();
        let [x, y] = cell.turn.cell_place([point.u, point.v]);
        Some([
            (f64::from(cell.at[0]) + x) / f64::from(columns),
            (f64::from(cell.at[1]) + y) / f64::from(rows),
        ])
    }

    /// The chart point at a place of the picture; `None` beside the charts, and where each chart has its own picture.
    pub fn chart_from_picture(self, [x, y]: [f64; 2]) -> Option<ChartPoint<f64>> {
        if !(0.0..=1.0).contains(&x) || !(0.0..=1.0).contains(&y) {
            return None;
        }
        let grid = self.grid();
        let place = [x * f64::from(grid[0]), y * f64::from(grid[1])];
        let at = [0, 1].map(|i| (place[i] as u32).min(grid[i] - 1));
        let chart = self.cells().iter().position(|cell| cell.at == at)?;
        let inside = [place[0] - f64::from(at[0]), place[1] - f64::from(at[1])];
        let [u, v] = self.cells()[chart].turn.inverse().cell_place(inside);
        Some(ChartPoint::new(chart as u32, u, v))
    }
}

#[cfg(test)]
mod tests {
    use super::super::cube_face;
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn a_place_goes_to_its_chart_and_back() {
        for layout in Layout::ALL {
            for chart in 0..layout.cells().len() as u32 {
                let point = ChartPoint::new(chart, 0.25, 0.75);
                let place = layout.picture_from_chart(point).unwrap();
                let back = layout.chart_from_picture(place).unwrap();
                assert_eq!(back.chart, chart);
                assert!((back.u - 0.25).abs() < 1e-15 && (back.v - 0.75).abs() < 1e-15);
                assert_ne!(layout.chart_from_picture([place[1], place[0]]), Some(point));
            }
            assert_eq!(layout.chart_from_picture([1.1, 0.5]), None);
        }
        assert_eq!(
            Layout::Cross.picture_from_chart(ChartPoint::new(9, 0.0, 0.0)),
            None
        );
        assert_eq!(
            Layout::Cross.chart_from_picture([0.01, 0.01]),
            None,
            "a cross has empty corners"
        );
    }

    /// Largest distance between the gnomonic directions on both sides of the vertical borders in a row of the grid.
    fn worst_break(cells: &[Cell], row: u32) -> f64 {
        let dir_at = |column: u32, place: [f64; 2]| -> Vec3<f64> {
            let chart = cells
                .iter()
                .position(|cell| cell.at == [column, row])
                .unwrap();
            let [u, v] = cells[chart].turn.inverse().cell_place(place);
            cube_face::from_gnomonic(chart as u32, 2.0 * u - 1.0, 2.0 * v - 1.0)
        };
        let mut worst = 0.0_f64;
        for column in 0..2 {
            for y in [0.0, 0.2, 0.5, 0.9] {
                let gap = dir_at(column, [1.0, y]) - dir_at(column + 1, [0.0, y]);
                worst = worst.max(gap.length());
            }
        }
        worst
    }

    #[test]
    fn rows_of_the_turned_layout_have_no_break() {
        let cells = Layout::ThreeByTwoTurned.cells();
        for row in 0..2 {
            assert!(worst_break(cells, row) < 1e-15);
        }
        // The same turned the other way round breaks.
        let mut other = cells.to_vec();
        other[5].turn = Turn::new(3, false);
        assert!(worst_break(&other, 1) > 0.5);
    }

    #[test]
    fn names_come_back() {
        for (charts, layouts) in [(1, 2), (2, 3), (6, 8), (12, 2)] {
            let held: Vec<Layout> = Layout::ALL
                .into_iter()
                .filter(|l| l.holds(charts))
                .collect();
            assert_eq!(held.len(), layouts);
            for layout in held {
                assert_eq!(Layout::from_id(layout.id(), charts), Some(layout));
            }
        }
        assert_eq!(Layout::from_id("cross", 2), None);
    }
}
