//! The lines of a map as lines of chart points: borders, equal u and v, the six great circles, Tissot's ellipses. Where they are seen is
//! for those who draw them.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::state::Overlays;
use crate::imaging::computed::cross_outlines;
use crate::lab::metrics::tissot::{OUTLINE, indicatrices};
use crate::mapping::cube_face::GREAT_CIRCLES;
use crate::mapping::{ChartPoint, Domain, MappingId};
use crate::math::Vec3;

/// What a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The border of a chart.
    Border,
    /// Equal u or v.
    Grid,
    /// The great circle of that index, A to F.
    GreatCircle(usize),
    /// An image of a circle of the sphere.
    Ellipse,
    /// The outline of a cross; true for the icosahedron's.
    Cross(bool),
}

/// A line whose points may jump from one chart to another.
#[derive(Clone, Debug)]
pub struct MapLine {
    /// What it is.
    pub kind: Kind,
    /// Its points, near to one another but for jumps.
    pub points: Vec<ChartPoint<f64>>,
}

/// Points along a side of a chart, and around a quarter of a circle.
const STEPS: u32 = 48;

/// Columns and rows into which the lines of equal u and v part a chart: where they are meridians and parallels, 15 degrees of longitude each.
fn parts(map: MappingId) -> [u32; 2] {
    if map.info().borders.is_around() {
        [24, 12]
    } else {
        [8, 8]
    }
}

/// The lines that are switched on, and the borders.
pub fn map_lines(map: MappingId, overlays: Overlays) -> Vec<MapLine> {
    let charts = 0..map.info().chart_count();
    let mut lines = Vec::new();
    let mut add = |kind: Kind, points: Vec<ChartPoint<f64>>| lines.push(MapLine { kind, points });
    if overlays.grid {
        for chart in charts.clone() {
            for (side, parts) in parts(map).into_iter().enumerate() {
                for part in 1..parts {
                    let fixed = f64::from(part) / f64::from(parts);
                    add(Kind::Grid, equal(map, chart, side, fixed));
                }
            }
        }
    }
    for chart in charts {
        add(Kind::Border, border(map, chart));
    }
    if overlays.great_circles {
        for (index, (_, normal)) in GREAT_CIRCLES.into_iter().enumerate() {
            for piece in great_circle(map, normal) {
                add(Kind::GreatCircle(index), piece);
            }
        }
    }
    if overlays.ellipses {
        for ellipse in indicatrices(map, f64::from(overlays.ellipses_deg)) {
            let mut points: Vec<ChartPoint<f64>> = ellipse.outline(OUTLINE).collect();
            points.extend(points.first().copied());
            // Beyond its chart another one lies, for which it does not stand.
            let is_on = |p: &ChartPoint<f64>| p.is_on(map.info().chart_count());
            for piece in points.chunk_by(|a, b| is_on(a) == is_on(b)) {
                if piece.first().is_some_and(is_on) {
                    add(Kind::Ellipse, piece.to_vec());
                }
            }
        }
    }
    lines
}

/// The outlines of the crosses at the vertices of icosahedron and dodecahedron.
pub fn crosses(map: MappingId) -> Vec<MapLine> {
    let outlines = cross_outlines().into_iter();
    let lines = |(is_red, outline): (bool, Vec<Vec3<f64>>)| {
        let pieces = on_map(map, &outline).into_iter();
        pieces.map(move |points| MapLine {
            kind: Kind::Cross(is_red),
            points,
        })
    };
    outlines.flat_map(lines).collect()
}

/// True where a line goes on from one point to the next: on one chart, without a jump from one of its borders to another.
pub fn goes_on(from: ChartPoint<f64>, to: ChartPoint<f64>) -> bool {
    /// Longer steps of (u, v) jump.
    const JUMP: f64 = 0.25;
    let step = (from.u - to.u).abs().max((from.v - to.v).abs());
    from.chart == to.chart && step < JUMP
}

/// A line of equal u (`side` 0) or v (1), as far as it is in the domain.
fn equal(map: MappingId, chart: u32, side: usize, fixed: f64) -> Vec<ChartPoint<f64>> {
    let along = |k: u32| {
        let c = 2.0 * f64::from(k) / f64::from(STEPS) - 1.0;
        match map.info().domain {
            Domain::Square => 0.5 + 0.5 * c,
            // Denser towards the rim, where directions may follow like a root.
            Domain::Disc => {
                let half = (0.25 - (fixed - 0.5) * (fixed - 0.5)).max(0.0).sqrt();
                0.5 + half * (FRAC_PI_2 * c).sin()
            }
        }
    };
    (0..=STEPS)
        .map(|k| match side {
            0 => ChartPoint::new(chart, fixed, along(k)),
            _ => ChartPoint::new(chart, along(k), fixed),
        })
        .collect()
}

/// Once around a chart.
fn border(map: MappingId, chart: u32) -> Vec<ChartPoint<f64>> {
    let count = 4 * STEPS;
    (0..=count)
        .map(|k| match map.info().domain {
            Domain::Disc => {
                let (sin, cos) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
                ChartPoint::new(chart, 0.5 + 0.5 * cos, 0.5 + 0.5 * sin)
            }
            Domain::Square => {
                let c = f64::from(k % STEPS) / f64::from(STEPS);
                let [u, v] = match k / STEPS % 4 {
                    0 => [c, 0.0],
                    1 => [1.0, c],
                    2 => [1.0 - c, 1.0],
                    _ => [0.0, 1.0 - c],
                };
                ChartPoint::new(chart, u, v)
            }
        })
        .collect()
}

fn great_circle(map: MappingId, normal: [i8; 3]) -> Vec<Vec<ChartPoint<f64>>> {
    let normal = Vec3::<f64>::from_f64(normal.map(f64::from)).normalized();
    // The axis that the normal has nothing of lies on the circle.
    let on = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .map(Vec3::from_f64)
        .into_iter()
        .find(|axis| axis.dot(normal) == 0.0);
    let Some(on) = on else { return Vec::new() };
    let across = normal.cross(on);
    let count = 8 * STEPS;
    let dirs: Vec<_> = (0..=count)
        .map(|k| {
            // Between the places where u is not told, the poles.
            let (sin, cos) = (TAU * (f64::from(k) + 0.5) / f64::from(count)).sin_cos();
            on * cos + across * sin
        })
        .collect();
    on_map(map, &dirs)
}

/// A line of the sphere on the map, in pieces that end at borders and where the map ends.
fn on_map(map: MappingId, dirs: &[Vec3<f64>]) -> Vec<Vec<ChartPoint<f64>>> {
    /// Halvings of a step: then what is missing is less than a pixel in any picture.
    const HALVINGS: u32 = 16;
    let joins = |from: Option<ChartPoint<f64>>, to: Option<ChartPoint<f64>>| match (from, to) {
        (Some(from), Some(to)) => goes_on(from, to),
        (from, to) => from.is_none() && to.is_none(),
    };
    let mut pieces = vec![Vec::new()];
    for pair in dirs.windows(2) {
        let [from, to] = [pair[0], pair[1]].map(|dir| map.own_point(dir));
        let (mut last, mut next) = (from, to);
        if !joins(from, to) {
            let (mut low, mut high) = (pair[0], pair[1]);
            for _ in 0..HALVINGS {
                let middle = (low + high).normalized();
                let point = map.own_point(middle);
                if joins(last, point) {
                    (low, last) = (middle, point);
                } else {
                    (high, next) = (middle, point);
                }
            }
        }
        if let Some(piece) = pieces.last_mut() {
            piece.extend(from.filter(|from| piece.last() != Some(from)));
            piece.extend(last.filter(|last| piece.last() != Some(last)));
        }
        if !joins(from, to) {
            pieces.push(next.into_iter().collect());
        }
    }
    let end = dirs.last().and_then(|dir| map.own_point(*dir));
    if let Some(piece) = pieces.last_mut() {
        piece.extend(end);
    }
    pieces.retain(|piece| piece.len() > 1);
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_the_sphere_ends_at_borders_and_where_the_map_ends() {
        let around: Vec<_> = (0..=360)
            .map(|k| {
                let (sin, cos) = (TAU * (f64::from(k) + 0.5) / 360.0).sin_cos();
                Vec3::new(sin * 0.6, sin * 0.8, cos)
            })
            .collect();
        let mut ends = 0;
        for &map in MappingId::ALL {
            let pieces = on_map(map, &around);
            let is_whole = pieces
                .iter()
                .all(|p| p.windows(2).all(|w| goes_on(w[0], w[1])));
            assert!(is_whole, "{map}");
            // All of the line that the map holds is there.
            let count: usize = pieces.iter().map(Vec::len).sum();
            let own = around
                .iter()
                .filter(|dir| map.own_point(**dir).is_some())
                .count();
            assert!(count >= own, "{map}: {count} of {own}");
            // An end that is none of the line's own lies where the next step leads elsewhere: at a border or at the end of the map.
            for end in pieces
                .iter()
                .flat_map(|piece| [piece.first(), piece.last()])
                .flatten()
            {
                let info = map.info();
                let from_side = [end.u, end.v]
                    .map(|c| c.min(1.0 - c))
                    .into_iter()
                    .fold(1.0, f64::min);
                let from_rim = 0.5 - (end.u - 0.5).hypot(end.v - 0.5);
                let off = match info.domain {
                    Domain::Square => from_side,
                    Domain::Disc => from_rim,
                };
                let is_own_end = [around.first(), around.last()]
                    .into_iter()
                    .flatten()
                    .any(|dir| {
                        map.own_point(*dir).is_some_and(|p| {
                            goes_on(p, *end) && (p.u - end.u).hypot(p.v - end.v) < 1e-9
                        })
                    });
                assert!(off < 2e-4 || is_own_end, "{map}: {off} {end:?}");
                ends += usize::from(!is_own_end);
            }
        }
        assert!(ends > 100, "control: {ends}");
    }
}
