//! What one texel of a level has in common with the texels of the next: the pieces into which both levels' borders cut a chart.

use crate::imaging::MapShape;
use crate::mapping::{ChartPoint, MappingId};

/// One side of a chart, cut into segments by the texels of two levels.
#[derive(Clone, Debug)]
struct Side {
    /// Texels of the finer and the coarser level.
    counts: [u32; 2],
    /// Where segments begin, and the last's end, as multiples of 1/(finer count * coarser count).
    borders: Vec<u64>,
    /// Of each segment, in charts.
    lengths: Vec<f32>,
    /// The first segment of each coarse texel, and the number of segments.
    first: Vec<usize>,
}

impl Side {
    fn new(fine: u32, coarse: u32) -> Self {
        let steps =
            |count: u32, step: u32| (0..=u64::from(count)).map(move |k| k * u64::from(step));
        let mut borders: Vec<u64> = steps(fine, coarse).chain(steps(coarse, fine)).collect();
        borders.sort_unstable();
        borders.dedup();
        let first = steps(coarse, fine)
            .map(|border| borders.partition_point(|b| *b < border))
            .collect();
        let all = u64::from(fine) * u64::from(coarse);
        let lengths = borders
            .windows(2)
            .map(|ends| ((ends[1] - ends[0]) as f64 / all as f64) as f32)
            .collect();
        Self {
            counts: [fine, coarse],
            borders,
            lengths,
            first,
        }
    }

    fn len(&self) -> usize {
        self.borders.len() - 1
    }

    /// Whether the next level has fewer texels here.
    fn is_reduced(&self) -> bool {
        self.counts[0] > self.counts[1]
    }

    fn fine(&self, segment: usize) -> u32 {
        (self.borders[segment] / u64::from(self.counts[1])) as u32
    }

    /// The coordinate at a share of a segment.
    fn coordinate(&self, segment: usize, share: f64) -> f64 {
        let [from, to] = [0, 1].map(|end| self.borders[segment + end] as f64);
        (from + (to - from) * share) / (f64::from(self.counts[0]) * f64::from(self.counts[1]))
    }

    fn segment(&self, coordinate: f64) -> usize {
        let place = coordinate * f64::from(self.counts[0]) * f64::from(self.counts[1]);
        let after = self
            .borders
            .partition_point(|border| *border as f64 <= place);
        after.clamp(1, self.len()) - 1
    }
}

/// A texel that gives light to a coarse texel and what it weighs there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share {
    pub chart: u32,
    pub texel: [u32; 2],
    pub weight: f32,
}

/// A piece's edge on the border of a chart: chart, side (left, right, upper, lower), segment along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Edge {
    chart: u32,
    side: usize,
    segment: usize,
}

/// The pieces of all charts.
#[derive(Clone, Debug)]
pub(super) struct Pieces {
    mapping: MappingId,
    sides: [Side; 2],
    /// Solid angle per unit of area of a chart's pieces, row by row, or one for each row where all are alike; for charts that
    /// are not alike.
    densities: Vec<Vec<f32>>,
    /// Of each chart its list of them.
    list_of: Vec<usize>,
    is_even: bool,
    /// For each chart and side what lies beyond each segment.
    beyond: Vec<[Vec<Option<Edge>>; 4]>,
}

/// Pieces along a side from which on the solid angle is that of the middle, to (1/512)^2 of its bend.
const MANY: usize = 512;

impl Pieces {
    /// From a level with square charts to one of `coarse` texels. Charts that are not there give and take nothing.
    pub fn new(shape: &MapShape, coarse: [u32; 2]) -> Self {
        let mapping = shape.mapping;
        let sides = [0, 1].map(|side| Side::new(shape.size[side], coarse[side]));
        let is_there = |chart: u32| {
            shape
                .charts
                .get(chart as usize)
                .is_some_and(Option::is_some)
        };
        let mut pieces = Self {
            mapping,
            is_even: is_even(mapping),
            densities: Vec::new(),
            list_of: Vec::new(),
            beyond: Vec::new(),
            sides,
        };
        let charts = 0..mapping.info().chart_count();
        let mut measured = Vec::new();
        for chart in charts.clone() {
            let known = measured
                .iter()
                .position(|known| are_alike(mapping, chart, *known));
            pieces.list_of.push(known.unwrap_or(measured.len()));
            if known.is_none() {
                measured.push(chart);
                pieces.densities.push(pieces.measured(chart));
            }
        }
        let edges = |chart: u32, side: usize| {
            (0..pieces.sides[1 - side / 2].len()).map(move |segment| Edge {
                chart,
                side,
                segment,
            })
        };
        let partner = |edge: Edge| {
            let other = pieces.over(edge)?;
            let both = [edge, other]
                .iter()
                .all(|e| pieces.sides[e.side / 2].is_reduced());
            (both && is_there(other.chart) && pieces.over(other) == Some(edge)).then_some(other)
        };
        pieces.beyond = charts
            .map(|chart| [0, 1, 2, 3].map(|side| edges(chart, side).map(partner).collect()))
            .collect();
        pieces
    }

    fn measured(&self, chart: u32) -> Vec<f32> {
        use rayon::prelude::*;
        let [columns, rows] = [0, 1].map(|side| self.sides[side].len());
        let columns = if self.is_even { 1 } else { columns };
        // Small charts' pieces are cut again, so that Gauss's rule is exact to what single precision keeps.
        let cuts = (32 / columns.max(rows)).max(1) as u32;
        // Three points on [0, 1]; or the middle.
        let offset = 0.5 * 0.6_f64.sqrt();
        let gauss = [
            (0.5 - offset, 5.0 / 18.0),
            (0.5, 8.0 / 18.0),
            (0.5 + offset, 5.0 / 18.0),
        ];
        let middle = [(0.5, 1.0)];
        let rule: &[(f64, f64)] = if rows.min(self.sides[0].len()) < MANY {
            &gauss
        } else {
            &middle
        };
        let nodes: Vec<(f64, f64)> = (0..cuts)
            .flat_map(|cut| {
                rule.iter().map(move |(x, w)| {
                    ((f64::from(cut) + x) / f64::from(cuts), w / f64::from(cuts))
                })
            })
            .collect();
        (0..rows * columns)
            .into_par_iter()
            .map(|index| {
                let (column, row) = (index % columns, index / columns);
                let mut sum = 0.0;
                for (x, weight_x) in &nodes {
                    let u = self.sides[0].coordinate(column, *x);
                    for (y, weight_y) in &nodes {
                        let v = self.sides[1].coordinate(row, *y);
                        let found = self.mapping.jacobian(ChartPoint::new(chart, u, v));
                        sum += weight_x * weight_y * found.map_or(0.0, |(_, j)| j.area_scale());
                    }
                }
                sum as f32
            })
            .collect()
    }

    fn solid_angle(&self, chart: u32, [column, row]: [usize; 2]) -> f32 {
        let index = if self.is_even {
            row
        } else {
            row * self.sides[0].len() + column
        };
        let size = self.sides[0].lengths[column] * self.sides[1].lengths[row];
        self.densities[self.list_of[chart as usize]][index] * size
    }

    /// What lies on the other side of an edge.
    fn over(&self, edge: Edge) -> Option<Edge> {
        /// How far beyond, in charts: far above rounding, far below a texel of the largest chart.
        const STEP: f64 = 1.0 / (1_u64 << 24) as f64;
        let across = edge.side / 2;
        let mut at = [self.sides[1 - across].coordinate(edge.segment, 0.5); 2];
        at[across] = if edge.side.is_multiple_of(2) {
            -STEP
        } else {
            1.0 + STEP
        };
        let dir = self
            .mapping
            .continued(ChartPoint::new(edge.chart, at[0], at[1]));
        let found = self.mapping.forward(dir)?;
        let depths = [found.u, 1.0 - found.u, found.v, 1.0 - found.v];
        let side = (0..4).fold(0, |best, side| {
            if depths[side] < depths[best] {
                side
            } else {
                best
            }
        });
        let along = 1 - side / 2;
        let coordinate = [found.u, found.v][along];
        Some(Edge {
            chart: found.chart,
            side,
            segment: self.sides[along].segment(coordinate),
        })
    }

    fn on_border(&self, edge: Edge) -> [usize; 2] {
        let across = edge.side / 2;
        let mut piece = [edge.segment; 2];
        piece[across] = if edge.side.is_multiple_of(2) {
            0
        } else {
            self.sides[across].len() - 1
        };
        piece
    }

    fn fine(&self, piece: [usize; 2]) -> [u32; 2] {
        [0, 1].map(|side| self.sides[side].fine(piece[side]))
    }

    /// Hands out all that gives light to a coarse texel.
    ///
    /// Each piece gives its own light to the coarse texel in which it lies, but for each edge on that texel's border a quarter,
    /// for which it gets as much from its neighbour there, over seams, too: over a row that is one texel in eight from beyond
    /// either border and three from either half, a tent. What two pieces exchange is the smaller one's quarter for both, so
    /// that the sum of all light stays, and so does what is alike everywhere.
    pub fn shares(&self, chart: u32, texel: [u32; 2], mut give: impl FnMut(Share)) {
        let [columns, rows] = [0, 1].map(|side| {
            let first = &self.sides[side].first;
            let texel = texel[side] as usize;
            first[texel]..first[texel + 1]
        });
        for row in rows.clone() {
            for column in columns.clone() {
                let piece = [column, row];
                let whole = self.solid_angle(chart, piece);
                let own = self.fine(piece);
                let mut rest = whole;
                let mut exchange = |chart: u32, other: [usize; 2]| {
                    let texel = self.fine(other);
                    let weight = 0.25 * whole.min(self.solid_angle(chart, other));
                    rest -= weight;
                    give(Share {
                        chart,
                        texel,
                        weight,
                    });
                };
                for (side, (at, range)) in
                    [(column, &columns), (row, &rows)].into_iter().enumerate()
                {
                    if !self.sides[side].is_reduced() {
                        continue;
                    }
                    for (end, is_last) in [(0, at == range.start), (1, at + 1 == range.end)] {
                        if !is_last {
                            continue;
                        }
                        let is_out = if end == 0 {
                            at == 0
                        } else {
                            at + 1 == self.sides[side].len()
                        };
                        if is_out {
                            let edge = self
                                .beyond
                                .get(chart as usize)
                                .and_then(|sides| *sides[2 * side + end].get(piece[1 - side])?);
                            if let Some(edge) = edge {
                                exchange(edge.chart, self.on_border(edge));
                            }
                            continue;
                        }
                        let mut other = piece;
                        other[side] = if end == 0 { at - 1 } else { at + 1 };
                        // A texel that the border cuts has the same light on both sides.
                        if self.sides[side].fine(other[side]) != own[side] {
                            exchange(chart, other);
                        }
                    }
                }
                give(Share {
                    chart,
                    texel: own,
                    weight: rest,
                });
            }
        }
    }
}

/// Solid angle per unit of a chart's area.
fn area(mapping: MappingId, chart: u32, [u, v]: [f64; 2]) -> f64 {
    let found = mapping.jacobian(ChartPoint::new(chart, u, v));
    found.map_or(0.0, |(_, jacobian)| jacobian.area_scale())
}

/// Off the axes of any symmetry.
const ACROSS: [f64; 4] = [0.05, 0.27, 0.4, 0.83];
const DOWN: [f64; 3] = [0.1, 0.34, 0.45];

fn all_near(mut pairs: impl Iterator<Item = [f64; 2]>) -> bool {
    pairs.all(|[a, b]| (a - b).abs() < 1e-9 * b)
}

/// Whether all texels of a row are the same solid angle.
fn is_even(mapping: MappingId) -> bool {
    all_near(
        DOWN.into_iter()
            .flat_map(|v| ACROSS.map(|u| [u, 0.63].map(|u| area(mapping, 0, [u, v])))),
    )
}

/// Whether two charts have the same solid angles at the same places.
fn are_alike(mapping: MappingId, a: u32, b: u32) -> bool {
    all_near(
        DOWN.into_iter()
            .flat_map(|v| ACROSS.map(|u| [a, b].map(|chart| area(mapping, chart, [u, v])))),
    )
}
