//! All mappings by two criteria, with the front of those that nothing beats in both.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Sense, Stroke, Ui, Vec2, pos2, vec2};

use super::axis::Axis;
use super::entry::{Corner, Entry, NO_COST, corner};
use super::panel::set;
use crate::app::action::Action;
use crate::app::laboratory::{free_place, look, paint_marker};
use crate::app::lists::list_ui;
use crate::app::model::Model;
use crate::app::theme;
use crate::lab::ranking::{Criterion, front};
use crate::lab::scatter::front_steps;

/// Room for the marks: at the left and below.
const ROOM: Vec2 = vec2(44.0, 34.0);
/// Share of an axis left free at its ends.
const MARGIN: f32 = 0.04;
/// Radius around a point within which the pointer is on it.
const REACH: f32 = 6.0;
const GRID: Color32 = Color32::from_gray(52);
const QUIET: Color32 = Color32::from_gray(150);
const LETTER: f32 = 11.0;

/// A mapping at its place on the screen.
struct Point<'a> {
    entry: &'a Entry<'a>,
    at: Pos2,
    on_front: bool,
}

/// The plot with its lists of axes, `size` large.
pub fn scatter_ui(ui: &mut Ui, model: &mut Model<'_>, entries: &[Entry<'_>], size: Vec2) {
    let mut ranking = model.state.ranking.clone();
    ui.horizontal_wrapped(|ui| {
        let name = |criterion: &Criterion| criterion.name().to_owned();
        let [across, up] = &mut ranking.axes;
        list_ui(ui, "across", across, Criterion::ALL, name);
        list_ui(ui, "up", up, Criterion::ALL, name);
    });
    let chosen = ranking.axes;
    set(model, ranking);
    let [Some(across), Some(up)] = chosen.map(|criterion| Axis::over(criterion, entries)) else {
        let has_no_cost = chosen.contains(&Criterion::Cost);
        ui.label(if entries.is_empty() {
            ""
        } else if has_no_cost {
            NO_COST
        } else {
            "nothing is measured yet"
        });
        return;
    };
    let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
    let frame = Rect::from_min_max(rect.min + vec2(ROOM.x, 4.0), rect.max - vec2(8.0, ROOM.y));
    if frame.width() < 40.0 || frame.height() < 40.0 {
        return;
    }
    let place = |[x, y]: [f64; 2]| {
        frame.left_bottom()
            + vec2(
                frame.width() * across.share(x, MARGIN),
                -frame.height() * up.share(y, MARGIN),
            )
    };
    paint_axes(ui.painter(), frame, &across, &up);
    let known: Vec<(&Entry<'_>, [f64; 2])> = entries
        .iter()
        .filter_map(|entry| Some((entry, [entry.value(chosen[0])?, entry.value(chosen[1])?])))
        .collect();
    let values: Vec<[f64; 2]> = known.iter().map(|(_, at)| *at).collect();
    let fronts = front(chosen, &values);
    let mut ends: Vec<[f64; 2]> = known
        .iter()
        .zip(&fronts)
        .filter(|(_, is_on)| **is_on)
        .map(|((_, at), _)| *at)
        .collect();
    ends.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let stair: Vec<Pos2> = front_steps(&ends).into_iter().map(place).collect();
    for pair in stair.windows(2) {
        let stroke = Stroke::new(1.5, Color32::from_gray(200));
        ui.painter().line_segment([pair[0], pair[1]], stroke);
    }
    let points: Vec<Point<'_>> = known
        .iter()
        .zip(&fronts)
        .map(|((entry, at), is_on)| Point {
            entry,
            at: place(*at),
            on_front: *is_on,
        })
        .collect();
    let mut lines = paint_corner(ui.painter(), frame, &across, &up);
    let front_lines = stair.windows(2);
    lines.extend(front_lines.map(|pair| Rect::from_two_pos(pair[0], pair[1]).expand(1.0)));
    points_ui(ui, model, &points);
    paint_names(ui.painter(), frame, &points, lines);
    let missing = entries.len() - points.len();
    if missing > 0 {
        let text = match chosen.contains(&Criterion::Cost) {
            true => format!("{missing} without a measured cost are not drawn"),
            false => format!("{missing} are still to come"),
        };
        let at = frame.right_top() + vec2(-6.0, 4.0);
        let font = FontId::proportional(LETTER);
        ui.painter().text(at, Align2::RIGHT_TOP, text, font, QUIET);
    }
}

fn axis_name(criterion: Criterion) -> &'static str {
    match criterion {
        Criterion::Cost => "ns a lookup within the error budget",
        _ => criterion.name(),
    }
}

/// The frame, its grid, and what stands on the axes.
fn paint_axes(painter: &Painter, frame: Rect, across: &Axis, up: &Axis) {
    let font = FontId::proportional(LETTER);
    painter.rect_stroke(frame, 0.0, Stroke::new(1.0, GRID), egui::StrokeKind::Inside);
    let mut last = f32::NEG_INFINITY;
    for (mark, text) in across.marks() {
        let x = frame.left() + frame.width() * across.share(mark, MARGIN);
        painter.vline(x, frame.y_range(), Stroke::new(1.0, GRID));
        let galley = painter.layout_no_wrap(text, font.clone(), QUIET);
        let left = x - 0.5 * galley.size().x;
        if left > last + 4.0 {
            last = left + galley.size().x;
            painter.galley(pos2(left, frame.bottom() + 2.0), galley, QUIET);
        }
    }
    let mut last = f32::INFINITY;
    for (mark, text) in up.marks() {
        let y = frame.bottom() - frame.height() * up.share(mark, MARGIN);
        painter.hline(frame.x_range(), y, Stroke::new(1.0, GRID));
        if y < last - LETTER - 2.0 {
            last = y;
            let at = pos2(frame.left() - 4.0, y);
            painter.text(at, Align2::RIGHT_CENTER, text, font.clone(), QUIET);
        }
    }
    let dashed = |ends: [Pos2; 2]| {
        painter.extend(egui::Shape::dashed_line(
            &ends,
            Stroke::new(1.0, QUIET),
            4.0,
            4.0,
        ));
    };
    if let Some(border) = across.border() {
        let x = frame.left() + frame.width() * border;
        dashed([pos2(x, frame.top()), pos2(x, frame.bottom())]);
        let at = pos2(0.5 * (x + frame.right()), frame.bottom() + 2.0);
        painter.text(at, Align2::CENTER_TOP, "no bound", font.clone(), QUIET);
    }
    if let Some(border) = up.border() {
        let y = frame.bottom() - frame.height() * border;
        dashed([pos2(frame.left(), y), pos2(frame.right(), y)]);
        let at = pos2(frame.left() - 4.0, 0.5 * (y + frame.top()));
        painter.text(
            at,
            Align2::RIGHT_CENTER,
            "∞",
            FontId::proportional(14.0),
            QUIET,
        );
    }
    let white = Color32::from_gray(210);
    let at = pos2(frame.center().x, frame.bottom() + ROOM.y);
    let name = format!("{} (smaller is better)", axis_name(across.criterion));
    painter.text(at, Align2::CENTER_BOTTOM, name, font.clone(), white);
    let galley = painter.layout_no_wrap(axis_name(up.criterion).to_owned(), font, white);
    let at = pos2(
        frame.left() - ROOM.x,
        frame.center().y + 0.5 * galley.size().x,
    );
    let turned = egui::epaint::TextShape::new(at, galley, white);
    painter.add(turned.with_angle(-std::f32::consts::FRAC_PI_2));
}

/// The least of what is smooth at a cube's corner, where the largest a/b or error of an angle is an axis; what lines and words cover.
fn paint_corner(painter: &Painter, frame: Rect, across: &Axis, up: &Axis) -> Vec<Rect> {
    let mut covered = Vec::new();
    let font = FontId::proportional(LETTER);
    let stroke = Stroke::new(1.0, theme::TEXEL);
    let bound = |axis: &Axis, room: f32| {
        let corner = corner(axis.criterion).filter(|corner| axis.contains(corner.bound));
        let Corner { bound, name, .. } = corner?;
        let whole = format!("{name}: no mapping that is smooth at a cube's corner is below");
        // The whole where there is room, so that nothing runs beyond the frame.
        let words = |text: String| painter.layout_no_wrap(text, font.clone(), theme::TEXEL);
        let whole = words(whole);
        let galley = if whole.size().x < room - 8.0 {
            whole
        } else {
            words(name)
        };
        Some((axis.share(bound, MARGIN), galley))
    };
    if let Some((share, galley)) = bound(up, frame.width()) {
        let y = frame.bottom() - frame.height() * share;
        painter.hline(frame.x_range(), y, stroke);
        let at = pos2(frame.right() - 4.0, y + 1.0);
        let words = Align2::RIGHT_TOP.anchor_size(at, galley.size());
        painter.galley(words.min, galley, theme::TEXEL);
        let line = Rect::from_x_y_ranges(frame.x_range(), y - 1.0..=y + 1.0);
        covered.extend([words, line]);
    }
    if let Some((share, galley)) = bound(across, frame.height()) {
        let x = frame.left() + frame.width() * share;
        painter.vline(x, frame.y_range(), stroke);
        let at = pos2(x + 2.0 + galley.size().y, frame.top() + 4.0);
        let words = vec2(galley.size().y + 3.0, galley.size().x);
        covered.push(Rect::from_min_size(pos2(x, frame.top() + 4.0), words));
        let line = Rect::from_x_y_ranges(x - 1.0..=x + 1.0, frame.y_range());
        covered.push(line);
        let turned = egui::epaint::TextShape::new(at, galley, theme::TEXEL);
        painter.add(turned.with_angle(std::f32::consts::FRAC_PI_2));
    }
    covered
}

/// The points: all that is known of a mapping under the pointer, a click opens it.
fn points_ui(ui: &mut Ui, model: &mut Model<'_>, points: &[Point<'_>]) {
    for point in points {
        let info = point.entry.map.info();
        let (color, shape) = look(info.id);
        let rect = Rect::from_center_size(point.at, Vec2::splat(2.0 * REACH));
        let id = ui.scope_id().with(("scatter", info.id));
        let response = ui.interact(rect, id, Sense::click());
        let label = format!("Point: {}", info.name);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
        let painter = ui.painter();
        paint_marker(painter, point.at, shape, color);
        let is_current = model.state.mapping == point.entry.map;
        if is_current || response.hovered() || response.has_focus() {
            painter.circle_stroke(point.at, REACH + 1.5, Stroke::new(1.5, theme::PROBE));
        }
        if response.clicked() {
            model.push(Action::OpenMapping(point.entry.map));
        }
        response.on_hover_ui(|ui| {
            ui.label(point.entry.summary());
            let is_near = |other: &&Point<'_>| {
                other.entry.map != point.entry.map && other.at.distance(point.at) < REACH
            };
            for other in points.iter().filter(is_near) {
                ui.label(format!("here too: {}", other.entry.map.info().name));
            }
        });
    }
}

/// Names of the front's points, then of the others, each where it covers no point, no line and no other name.
fn paint_names(painter: &Painter, frame: Rect, points: &[Point<'_>], lines: Vec<Rect>) {
    let mut taken = lines;
    let marks = points.iter().map(|point| point.at);
    taken.extend(marks.map(|at| Rect::from_center_size(at, Vec2::splat(8.0))));
    for is_on in [true, false] {
        for point in points.iter().filter(|point| point.on_front == is_on) {
            let info = point.entry.map.info();
            let color = if is_on { Color32::WHITE } else { QUIET };
            let font = FontId::proportional(LETTER);
            let galley = painter.layout_no_wrap(info.id.to_owned(), font, color);
            if let Some(rect) = free_place(point.at, galley.size(), frame, &taken) {
                painter.galley(rect.min, galley, color);
                taken.push(rect);
            }
        }
    }
}
