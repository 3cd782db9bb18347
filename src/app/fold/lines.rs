//! The lines on a folded map: borders, equal u and v, the six great circles, Tissot's ellipses.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::view::Surface;
use crate::app::state::Overlays;
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
}

/// A line that is seen from one side.
#[derive(Clone, Debug)]
pub struct Line {
    /// What it is.
    pub kind: Kind,
    /// Places on the screen, in [0, 1]^2, v down.
    pub at: Vec<[f32; 2]>,
    /// It lies where the surface is seen from outside.
    pub is_outside: bool,
}

/// Points along a side of a chart, and around a quarter of a circle.
const STEPS: u32 = 48;
/// Parts into which the lines of equal u and v divide a chart.
const PARTS: u32 = 8;

/// The lines that are switched on.
pub fn lines(surface: &Surface, overlays: Overlays) -> Vec<Line> {
    let map = surface.map();
    let mut lines = Vec::new();
    let mut add =
        |kind: Kind, points: Vec<ChartPoint<f64>>| cut(surface, kind, &points, &mut lines);
    if overlays.grid {
        for chart in 0..map.info().chart_count() {
            for part in 1..PARTS {
                for side in [0, 1] {
                    add(Kind::Grid, equal(map, chart, side, part));
                }
            }
        }
    }
    for chart in 0..map.info().chart_count() {
        add(Kind::Border, border(map, chart));
    }
    if overlays.great_circles {
        for (index, (_, normal)) in GREAT_CIRCLES.into_iter().enumerate() {
            add(Kind::GreatCircle(index), great_circle(map, normal));
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

/// A line of equal u (`side` 0) or v (1), as far as it is in the domain.
fn equal(map: MappingId, chart: u32, side: usize, part: u32) -> Vec<ChartPoint<f64>> {
    let fixed = f64::from(part) / f64::from(PARTS);
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

fn great_circle(map: MappingId, normal: [i8; 3]) -> Vec<ChartPoint<f64>> {
    let normal = Vec3::<f64>::from_f64(normal.map(f64::from)).normalized();
    // The axis that the normal has nothing of lies on the circle.
    let on = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        .map(Vec3::from_f64)
        .into_iter()
        .find(|axis| axis.dot(normal) == 0.0);
    let Some(on) = on else { return Vec::new() };
    let across = normal.cross(on);
    let count = 8 * STEPS;
    (0..=count)
        .filter_map(|k| {
            // Between the places where u is not told, the poles.
            let (sin, cos) = (TAU * (f64::from(k) + 0.5) / f64::from(count)).sin_cos();
            map.forward(on * cos + across * sin)
        })
        .collect()
}

/// Adds what of a line is in one piece: on one chart, without a jump, seen from one side.
fn cut(surface: &Surface, kind: Kind, points: &[ChartPoint<f64>], lines: &mut Vec<Line>) {
    /// Longer steps of (u, v) jump from one border of a chart to another.
    const JUMP: f64 = 0.25;
    let mut last: Option<ChartPoint<f64>> = None;
    let mut now: Option<Line> = None;
    for point in points {
        let Some((at, _)) = surface.seen(*point) else {
            lines.extend(now.take());
            last = None;
            continue;
        };
        let is_outside = surface.is_outside(*point);
        let is_near = last.is_some_and(|last| {
            let step = (last.u - point.u).abs().max((last.v - point.v).abs());
            last.chart == point.chart && step < JUMP
        });
        match &mut now {
            Some(line) if is_near && line.is_outside == is_outside => line.at.push(at),
            Some(line) => {
                // A line that goes round the rim of the surface has no gap there.
                if is_near {
                    line.at.push(at);
                }
                lines.extend(now.replace(Line {
                    kind,
                    at: vec![at],
                    is_outside,
                }));
            }
            None => {
                now = Some(Line {
                    kind,
                    at: vec![at],
                    is_outside,
                });
            }
        }
        last = Some(*point);
    }
    lines.extend(now);
    lines.retain(|line| line.at.len() > 1);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Camera;

    fn of(map: MappingId, share: f32, overlays: Overlays) -> Vec<Line> {
        let surface = Surface::new(map, share, Camera::default(), 1.0);
        lines(&surface, overlays)
    }

    #[test]
    fn lines_are_in_pieces_without_a_jump() {
        let all = Overlays {
            grid: true,
            great_circles: true,
            ellipses: true,
            ..Overlays::NONE
        };
        for &map in MappingId::ALL {
            for share in [0.0, 0.3, 0.5, 1.0] {
                for line in of(map, share, all) {
                    for pair in line.at.windows(2) {
                        let step = (pair[0][0] - pair[1][0]).hypot(pair[0][1] - pair[1][1]);
                        assert!(step < 0.14, "{map} {share} {:?}: {step}", line.kind);
                    }
                }
            }
        }
    }

    #[test]
    fn each_overlay_brings_its_own_lines() {
        let count = |overlays, kind: fn(Kind) -> bool| {
            let lines = of(MappingId::Ccm, 0.0, overlays);
            lines.iter().filter(|line| kind(line.kind)).count()
        };
        let circle = |kind| matches!(kind, Kind::GreatCircle(_));
        assert_eq!(count(Overlays::NONE, |kind| kind == Kind::Border), 6);
        assert_eq!(
            count(Overlays::NONE, |kind| kind != Kind::Border),
            0,
            "control"
        );
        let circles = Overlays {
            great_circles: true,
            ..Overlays::NONE
        };
        assert!(count(circles, circle) > 6);
        let grid = Overlays {
            grid: true,
            ..Overlays::NONE
        };
        assert_eq!(count(grid, |kind| kind == Kind::Grid), 6 * 2 * 7);
    }
}
