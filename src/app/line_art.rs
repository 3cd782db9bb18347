//! Views as lines on white paper, for papers and slides: the folded map, panels, the cut through the horizon. Light, heat maps and tints are no
//! lines, and are left out; so is the probe, but for the cut.

use egui::{Rect, pos2, vec2};

use super::fold::{self, Surface, is_covered, letters};
use super::map_lines::{Kind, MapLine, crosses, goes_on, map_lines};
use super::map_panel::window_of;
use super::panels::cells;
use super::picture::{Destination, PictureRequest, What};
use super::sampling::{CutsWanted, sheet};
use super::state::AppState;
use crate::gpu::GREAT_CIRCLE_COLORS;
use crate::imaging::{Environment, Progress, atomic::write_atomically};
use crate::lab::drawing::{Colour, Drawing};
use crate::mapping::cube_face::GREAT_CIRCLES;
use crate::mapping::{ChartPoint, Layout, MappingId};

const INK: Colour = [20, 20, 20];
const GRID: Colour = [150, 150, 150];
/// What lies behind what lets through.
const FAR: Colour = [200, 200, 200];
const ELLIPSE: Colour = [0, 114, 178];
const RED: Colour = [200, 30, 30];
const BLUE: Colour = [30, 60, 200];

/// How the names of files of lines end.
pub const SVG: &str = "svg";

/// Letters, of a sheet's smaller side.
const LETTER: f64 = 0.022;
/// A thin pen, of a sheet's smaller side.
const PEN: f64 = 0.0011;

impl What {
    /// True of what can be drawn with lines alone.
    pub fn is_line_art(self) -> bool {
        match self {
            Self::Panel(_) | Self::Panels | Self::Fold | Self::Sampling => true,
            Self::Window | Self::Viewport | Self::Microscope | Self::Budget | Self::Ranking => {
                false
            }
        }
    }
}

/// Writes what is seen as lines, where a file is asked for whose name ends in .svg; `None` where none is.
///
/// # Errors
/// One line that says what failed; nothing is written then.
pub fn written(state: &AppState, request: &PictureRequest) -> Option<Result<(), String>> {
    let Destination::File { path, force } = &request.to else {
        return None;
    };
    let is_svg = path
        .extension()
        .is_some_and(|end| end.eq_ignore_ascii_case(SVG));
    is_svg.then(|| {
        let state = request.shown(state).sanitized();
        let art = drawing(&state, request.what, request.size).ok_or_else(|| {
            let what = request.what.name();
            format!("{what} cannot be written as lines: let the name end in .png")
        })?;
        write_atomically(path, *force, art.svg().as_bytes()).map_err(|error| error.to_string())
    })
}

/// What is seen as lines on a sheet of `size` pixels; `None` of what is no line art.
pub fn drawing(state: &AppState, what: What, size: [u32; 2]) -> Option<Drawing> {
    let mut drawing = Drawing::new(size);
    let [width, height] = size.map(|n| n as f32);
    let paper = Rect::from_min_size(pos2(0.0, 0.0), vec2(width, height));
    let pen = Pen::of(size);
    match what {
        What::Panel(mapping) => draw_panel(&mut drawing, state, mapping, paper, pen),
        What::Panels => {
            let open: Vec<MappingId> = state.open_panels().collect();
            let head = (2.0 * pen.letter) as f32;
            for (mapping, mut cell) in open.iter().zip(cells(open.len(), paper)) {
                let title = [
                    f64::from(cell.left()) + 0.5 * pen.letter,
                    f64::from(cell.top()) + 0.5 * pen.letter,
                ];
                drawing.words(mapping.info().name, title, pen.letter, INK);
                cell.min.y += head;
                draw_panel(&mut drawing, state, *mapping, cell, pen);
            }
        }
        What::Fold => draw_fold(&mut drawing, state, paper, pen),
        What::Sampling => {
            let cuts = CutsWanted::new(state).make(&Progress::new());
            drawing = sheet(state, &cuts.unwrap_or_default(), size);
        }
        What::Window | What::Viewport | What::Microscope | What::Budget | What::Ranking => {
            return None;
        }
    }
    Some(drawing)
}

/// Sizes on a sheet, in pixels.
#[derive(Clone, Copy)]
struct Pen {
    width: f64,
    letter: f64,
}

impl Pen {
    fn of([width, height]: [u32; 2]) -> Self {
        let side = f64::from(width.min(height));
        Self {
            width: (PEN * side).max(0.5),
            letter: (LETTER * side).clamp(6.0, 40.0),
        }
    }

    /// Width and ink of a line.
    fn line(self, kind: Kind) -> (f64, Colour) {
        let (times, ink) = match kind {
            Kind::Grid => (1.0, GRID),
            Kind::Border => (2.0, INK),
            Kind::GreatCircle(index) => (3.0, GREAT_CIRCLE_COLORS[index]),
            Kind::Ellipse => (1.5, ELLIPSE),
            Kind::Cross(is_red) => (2.0, if is_red { RED } else { BLUE }),
        };
        (times * self.width, ink)
    }
}

/// The lines of a map that the state shows, the crosses among them where they are its surroundings.
fn lines_of(state: &AppState, mapping: MappingId) -> Vec<MapLine> {
    let mut lines = map_lines(mapping, state.overlays);
    if state.environment == Environment::IcosahedronCrosses {
        lines.extend(crosses(mapping));
    }
    lines
}

fn draw_panel(drawing: &mut Drawing, state: &AppState, mapping: MappingId, cell: Rect, pen: Pen) {
    let window = window_of(&state.panel(mapping), cell);
    let layout = mapping.info().layout;
    let place = |point: ChartPoint<f64>| {
        let at = window.screen_from_picture(layout.picture_from_chart(point)?);
        Some([f64::from(at.x), f64::from(at.y)])
    };
    for MapLine { kind, points } in lines_of(state, mapping) {
        let (width, ink) = pen.line(kind);
        for piece in points.chunk_by(|a, b| goes_on(*a, *b)) {
            let piece: Vec<_> = piece.iter().copied().filter_map(place).collect();
            for inside in clipped(&piece, cell) {
                drawing.line(&inside, width, ink);
            }
        }
    }
    if state.overlays.names && layout != Layout::Single {
        for (chart, name) in mapping.info().charts.iter().enumerate() {
            // At the top in the middle: near corners crosses lie.
            let top = place(ChartPoint::new(chart as u32, 0.5, 0.02));
            if let Some(at) = top.filter(|[x, y]| cell.contains(pos2(*x as f32, *y as f32))) {
                drawing.words_below(name, at, pen.letter, INK);
            }
        }
    }
    if cell.size() != vec2(drawing.size()[0] as f32, drawing.size()[1] as f32) {
        let [low, high] = [cell.min, cell.max].map(|at| [f64::from(at.x), f64::from(at.y)]);
        let frame = [low, [high[0], low[1]], high, [low[0], high[1]], low];
        drawing.line(&frame, pen.width, GRID);
    }
}

fn draw_fold(drawing: &mut Drawing, state: &AppState, sheet: Rect, pen: Pen) {
    let fold = state.fold;
    let aspect = sheet.width() / sheet.height();
    let surface = Surface::new(state.mapping, fold.share, fold.camera, aspect);
    let place = |at: &[f32; 2]| {
        [
            f64::from(at[0] * sheet.width()),
            f64::from(at[1] * sheet.height()),
        ]
    };
    let seen = fold::seen(&surface, &lines_of(state, state.mapping));
    // As on the screen: outsides lie over all that is seen from inside.
    let quads = surface.quads();
    let covered = |at: &[f32; 2]| is_covered(&quads, *at);
    for line in seen.iter().filter(|line| !line.is_outside) {
        let (width, ink) = pen.line(line.kind);
        let hidden: Vec<bool> = line.at.iter().map(covered).collect();
        let both: Vec<_> = line.at.iter().zip(hidden).collect();
        for piece in both.chunk_by(|a, b| a.1 == b.1) {
            let is_hidden = piece.first().is_some_and(|(_, hidden)| *hidden);
            let points: Vec<_> = piece.iter().map(|(at, _)| place(at)).collect();
            if !is_hidden || fold.see_through {
                drawing.line(&points, width, if is_hidden { FAR } else { ink });
            }
        }
    }
    for line in seen.iter().filter(|line| line.is_outside) {
        let (width, ink) = pen.line(line.kind);
        let points: Vec<_> = line.at.iter().map(place).collect();
        drawing.line(&points, width, ink);
    }
    if let Some(outline) = surface.outline() {
        let points: Vec<_> = outline.iter().map(place).collect();
        drawing.line(&points, 2.0 * pen.width, INK);
    }
    for (index, at) in letters(&seen) {
        let [x, y] = place(&at);
        let name = GREAT_CIRCLES[index].0.to_string();
        let at = [x + 0.4 * pen.letter, y - 1.2 * pen.letter];
        drawing.words(&name, at, pen.letter, INK);
    }
}

/// The pieces of a line inside a rectangle.
fn clipped(points: &[[f64; 2]], rect: Rect) -> Vec<Vec<[f64; 2]>> {
    let low = [rect.left(), rect.top()].map(f64::from);
    let high = [rect.right(), rect.bottom()].map(f64::from);
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut goes_on = false;
    for pair in points.windows(2) {
        // The part of the step inside: after Liang and Barsky, from each border the share at which it is crossed.
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let step = pair[1][axis] - pair[0][axis];
            let shares = [low, high].map(|border| (border[axis] - pair[0][axis]) / step);
            if step == 0.0 {
                if !(low[axis]..=high[axis]).contains(&pair[0][axis]) {
                    to = -1.0;
                }
            } else {
                from = from.max(shares[0].min(shares[1]));
                to = to.min(shares[0].max(shares[1]));
            }
        }
        if from > to {
            goes_on = false;
            continue;
        }
        let at = |share: f64| [0, 1].map(|i: usize| pair[0][i] + share * (pair[1][i] - pair[0][i]));
        match pieces.last_mut().filter(|_| goes_on && from == 0.0) {
            Some(piece) => piece.push(at(to)),
            None => pieces.push(vec![at(from), at(to)]),
        }
        goes_on = to == 1.0;
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::state::Overlays;
    use crate::lab::drawing::Shape;

    #[test]
    fn lines_end_at_the_sheet() {
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(10.0, 10.0));
        let across = [
            [-5.0, 5.0],
            [5.0, 5.0],
            [5.0, 15.0],
            [8.0, 15.0],
            [8.0, 2.0],
        ];
        let inside = clipped(&across, rect);
        assert_eq!(inside[0], [[0.0, 5.0], [5.0, 5.0], [5.0, 10.0]]);
        assert_eq!(inside[1], [[8.0, 10.0], [8.0, 2.0]]);
        assert_eq!(inside.len(), 2);
        assert_eq!(
            clipped(&across[..2], rect.translate(vec2(20.0, 0.0))).len(),
            0
        );
    }

    #[test]
    fn every_view_that_is_line_art_stays_on_its_sheet() {
        const SIZE: [u32; 2] = [400, 300];
        for &mapping in MappingId::ALL {
            let mut state = AppState {
                mapping,
                environment: Environment::IcosahedronCrosses,
                overlays: Overlays {
                    grid: true,
                    great_circles: true,
                    names: true,
                    ..Overlays::NONE
                },
                ..AppState::default()
            };
            state.panel_mut(mapping).unwrap().zoom = 3.0;
            state.fold.share = 1.0;
            for what in [
                What::Panel(mapping),
                What::Panels,
                What::Fold,
                What::Sampling,
            ] {
                assert!(what.is_line_art());
                let art = drawing(&state, what, SIZE).unwrap();
                let points = art.shapes().iter().flat_map(|shape| match shape {
                    Shape::Line { points, .. } => points.clone(),
                    Shape::Disc { at, .. } | Shape::Words { at, .. } => vec![*at],
                });
                let mut count = 0;
                for at in points {
                    let is_on =
                        (0..2).all(|i| (-0.01..=f64::from(SIZE[i]) + 0.01).contains(&at[i]));
                    assert!(is_on, "{mapping} {what:?}: {at:?}");
                    count += 1;
                }
                assert!(count > 50, "{mapping} {what:?}: {count}");
            }
        }
        for what in [What::Window, What::Viewport, What::Ranking] {
            assert!(!what.is_line_art());
            assert!(drawing(&AppState::default(), what, SIZE).is_none());
        }
    }

    #[test]
    fn each_cross_and_great_circle_is_drawn_in_its_ink() {
        let inks = |state: &AppState, what: What| {
            let art = drawing(state, what, [800, 600]).unwrap();
            let ink = |shape: &Shape| match shape {
                Shape::Line { colour, .. } => Some(*colour),
                _ => None,
            };
            art.shapes().iter().filter_map(ink).collect::<Vec<_>>()
        };
        let mut state = AppState {
            environment: Environment::IcosahedronCrosses,
            overlays: Overlays::NONE,
            ..AppState::default()
        };
        let map = What::Panel(MappingId::Octahedral);
        let with_crosses = inks(&state, map);
        assert!(with_crosses.iter().filter(|ink| **ink == RED).count() >= 12);
        assert!(with_crosses.iter().filter(|ink| **ink == BLUE).count() >= 20);
        state.environment = Environment::Courtyard;
        assert!(!inks(&state, map).contains(&RED), "control");
        state.overlays.great_circles = true;
        state.fold.share = 1.0;
        let circles = inks(&state, What::Fold);
        for ink in GREAT_CIRCLE_COLORS {
            assert!(circles.contains(&ink), "{ink:?}");
        }
    }
}
