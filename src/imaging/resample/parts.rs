//! The rows of a map's parts: which texels each part has, and which beyond it a filter asks for.

use std::ops::Range;

use super::grid::Grid;
use crate::mapping::ChartPoint;

/// One row of a part with its gutter.
#[derive(Clone, Debug)]
pub(super) struct PartRow {
    /// Columns whose texels the part has; where it has none, an empty range at the end of `reached`.
    pub own: Range<i32>,
    /// Columns that a filter may ask for.
    pub reached: Range<i32>,
}

impl PartRow {
    fn new(own: Range<i32>, reached: Range<i32>) -> Self {
        let own = if own.is_empty() {
            reached.end..reached.end
        } else {
            own
        };
        let reached = reached.start.min(own.start)..reached.end.max(own.end);
        Self { own, reached }
    }
}

/// The rows from `reach` above a chart to `reach` below it, of each of its facets, one facet after another.
pub(super) fn part_rows(grid: &Grid, reach: i32) -> Vec<PartRow> {
    let rows = -reach..grid.size[1] as i32 + reach;
    if grid.facets == 1 {
        return rows
            .map(|row| PartRow::new(grid.owned(row), grid.reached(row, reach)))
            .collect();
    }
    let lattice = Lattice::new(grid);
    (0..grid.facets as usize)
        .flat_map(|facet| rows.clone().map(move |row| (facet, row)))
        .map(|(facet, row)| lattice.row(facet, row, reach))
        .collect()
}

/// Which facet has which points of a lattice of half texels, from a chart's left upper corner on: points k at the places
/// (k - 1)/2, so that odd ones are texels' middles.
struct Lattice {
    width: i32,
    /// For each row of the lattice, the first and the last point of each facet; it has all between them, for facets are convex.
    lines: Vec<Vec<Option<[i32; 2]>>>,
}

impl Lattice {
    fn new(grid: &Grid) -> Self {
        let [width, height] = grid.size.map(|n| n as i32);
        let place = |k: i32| 0.5 * f64::from(k - 1);
        let line = |j: i32| {
            let facet = |i: i32| {
                let at = [0, 1].map(|side| grid.coordinate(side, place([i, j][side])));
                grid.mapping.facet(ChartPoint::new(0, at[0], at[1])) as usize
            };
            let mut line = vec![None::<[i32; 2]>; grid.facets as usize];
            // Intervals whose ends lie in one facet belong to it; others are halved.
            let mut open = vec![[0, 2 * width]];
            while let Some([from, to]) = open.pop() {
                if facet(from) != facet(to) && to - from > 1 {
                    let middle = (from + to) / 2;
                    open.extend([[from, middle], [middle, to]]);
                    continue;
                }
                for end in [from, to] {
                    let run = line[facet(end)].get_or_insert([end, end]);
                    *run = [run[0].min(end), run[1].max(end)];
                }
            }
            line
        };
        Self {
            width,
            lines: (0..=2 * height).map(line).collect(),
        }
    }

    fn run(&self, facet: usize, line: i32) -> Option<[i32; 2]> {
        *self.lines.get(usize::try_from(line).ok()?)?.get(facet)?
    }

    fn row(&self, facet: usize, row: i32, reach: i32) -> PartRow {
        let line = 2 * row + 1;
        let own = match self.run(facet, line) {
            // Odd points only.
            Some([first, last]) => first / 2..(last + 1) / 2,
            None => 0..0,
        };
        // The facet ends less than half a texel, a lattice point, beyond those of its points from which the row is reached.
        let mut reached: Option<[i32; 2]> = None;
        for line in line - 2 * reach..=line + 2 * reach {
            if let Some([first, last]) = self.run(facet, line) {
                let [from, to] = reached.unwrap_or([first, last]);
                reached = Some([from.min(first), to.max(last)]);
            }
        }
        let reached = match reached {
            // From point k - 1, at the place (k - 2)/2, to the right of a column; and from k + 1, at k/2, to the left.
            Some([first, last]) => {
                let from = (first - 2).div_euclid(2) - reach;
                from.max(-reach)..(last.div_euclid(2) + reach).min(self.width - 1 + reach) + 1
            }
            None => 0..0,
        };
        PartRow::new(own, reached)
    }
}
