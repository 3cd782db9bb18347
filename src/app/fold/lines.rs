//! The lines on a folded map, as they are seen.

use super::view::{LinePoint, Surface};
use crate::app::map_lines::{Kind, MapLine, goes_on};
use crate::mapping::cube_face::GREAT_CIRCLES;
use crate::mapping::{ChartPoint, Unfolding};

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

/// Where each great circle has its letter: on the longest piece that is seen from outside, else of the longest.
pub fn letters(lines: &[Line]) -> Vec<(usize, [f32; 2])> {
    let of_circle = |index: usize| {
        let own = lines
            .iter()
            .filter(|line| line.kind == Kind::GreatCircle(index));
        let longest = own.max_by_key(|line| (line.is_outside, line.at.len()))?;
        // Not the middle, where lines of other circles may lie.
        let at = longest.at.get(longest.at.len() * 3 / 8)?;
        Some((index, *at))
    };
    (0..GREAT_CIRCLES.len()).filter_map(of_circle).collect()
}

/// Where lines of the map are seen.
pub fn seen(surface: &Surface, map_lines: &[MapLine]) -> Vec<Line> {
    let unfolding = Unfolding::new(surface.map());
    let trace = |line: &MapLine| TracedLine::new(&unfolding, line);
    let traced: Vec<TracedLine> = map_lines.iter().map(trace).collect();
    project(surface, &traced)
}

/// Where traced lines are seen.
pub fn project(surface: &Surface, traced: &[TracedLine]) -> Vec<Line> {
    let mut lines = Vec::new();
    for line in traced {
        cut(surface, line, &mut lines);
    }
    lines
}

/// A line of the map, traced however the map is folded and wherever it is seen from.
pub struct TracedLine {
    kind: Kind,
    points: Vec<LinePoint>,
}

impl TracedLine {
    /// Traces a line.
    pub fn new(unfolding: &Unfolding, line: &MapLine) -> Self {
        let trace = |point: &ChartPoint<f64>| LinePoint::new(unfolding, *point);
        Self {
            kind: line.kind,
            points: line.points.iter().map(trace).collect(),
        }
    }
}

/// Adds what of a line is in one piece: on one chart, without a jump, seen from one side.
fn cut(surface: &Surface, traced: &TracedLine, lines: &mut Vec<Line>) {
    let mut end = |line: Option<Line>| lines.extend(line.filter(|line| line.at.len() > 1));
    let begin = |at: [f32; 2], is_outside: bool| Line {
        kind: traced.kind,
        at: vec![at],
        is_outside,
    };
    let mut last: Option<ChartPoint<f64>> = None;
    let mut now: Option<Line> = None;
    for line_point in &traced.points {
        let Some((at, is_outside)) = surface.side(line_point) else {
            end(now.take());
            last = None;
            continue;
        };
        let point = line_point.point();
        let is_near = last.is_some_and(|last| goes_on(last, point));
        match &mut now {
            Some(line) if is_near && line.is_outside == is_outside => line.at.push(at),
            Some(line) => {
                // A line that goes round the rim of the surface has no gap there.
                if is_near {
                    line.at.push(at);
                }
                end(now.replace(begin(at, is_outside)));
            }
            None => now = Some(begin(at, is_outside)),
        }
        last = Some(point);
    }
    end(now);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::map_lines::map_lines;
    use crate::app::state::Overlays;
    use crate::mapping::MappingId;
    use crate::scene::Camera;

    fn of(map: MappingId, share: f32, overlays: Overlays) -> Vec<Line> {
        let surface = Surface::new(map, share, Camera::default(), 1.0);
        seen(&surface, &map_lines(map, overlays))
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
