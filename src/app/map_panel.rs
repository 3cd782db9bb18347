//! The panel of one mapping: its unfolded picture with the probe's marks.

use egui::{Align2, Color32, PointerButton, Pos2, Rect, Response, Sense, Ui};

use super::action::{Action, probe_at};
use super::distortion::{paint_distortion, paint_legend};
use super::marks::{cross_mark, dot, edged_line, edged_text, footprint, ring};
use super::model::Model;
use super::panel_view::PanelWindow;
use super::probe::{face_outline, picture_lines, texel_outline};
use super::state::PanelState;
use super::story::StoryStep;
use super::theme;
use super::views::ViewKey;
use super::wheel::{ZOOM_PER_POINT, wheel_zoom};
use crate::mapping::{Layout, MappingId};
use crate::math::Vec3;

/// The window of a panel over a rectangle of the screen.
pub fn window_of(view: &PanelState, rect: Rect) -> PanelWindow {
    let info = view.mapping.info();
    PanelWindow::new(rect, view, info.layout.picture_aspect(info.aspect) as f32)
}

/// Shows the panel in all the space there is.
pub fn map_panel_ui(ui: &mut Ui, model: &mut Model<'_>, mapping: MappingId) {
    let name = format!("Panel: {}", mapping.info().name);
    let Some(response) = theme::picture_ui(ui, &name, Sense::click_and_drag()) else {
        return;
    };
    let rect = response.rect;
    model.view_ui(ui, ViewKey::Panel(mapping), rect);
    let view = model.state.panel(mapping);
    let window = window_of(&view, rect);
    pointer(ui, model, view, &window, &response);
    let painter = ui.painter_at(rect);
    paint_distortion(model, &painter, mapping, &window);
    if model.state.overlays.names {
        paint_chart_names(&painter, mapping, &window);
    }
    if model.state.overlays.probe {
        paint_probe(&painter, model, mapping, &window);
    }
    if let Some(step) = model.painted_step() {
        paint_story(&painter, step, mapping, &window);
    }
    paint_legend(&painter, model, mapping, rect);
}

/// What the pointer does: finds directions, pans and zooms.
pub(super) fn pointer(
    ui: &Ui,
    model: &mut Model<'_>,
    view: PanelState,
    window: &PanelWindow,
    response: &Response,
) {
    if response.dragged_by(PointerButton::Secondary) || response.dragged_by(PointerButton::Middle) {
        model.push(Action::SetPanelView(
            window.panned(view, response.drag_delta()),
        ));
        return;
    }
    let Some(pos) = response.hover_pos().or(response.interact_pointer_pos()) else {
        return;
    };
    if let Some(factor) = wheel_zoom(ui, response, ZOOM_PER_POINT) {
        let zoomed = window.zoomed(view, factor, pos);
        model.push(Action::SetPanelView(zoomed));
    }
    if response.double_clicked() {
        model.push(Action::SetPanelView(PanelState::new(
            view.mapping,
            view.open,
        )));
    }
    let moved = ui.input(|i| i.pointer.delta() != egui::Vec2::ZERO || i.pointer.any_pressed());
    let held = response.dragged_by(PointerButton::Primary) || response.clicked();
    if held || (model.state.probe_follows && moved) {
        let layout = view.mapping.info().layout;
        let place = window.picture_from_screen(pos);
        if let Some(action) = layout
            .chart_from_picture(place)
            .and_then(|point| probe_at(view.mapping, point))
        {
            model.push(action);
        }
    }
    if response.clicked() && model.state.probe_follows {
        model.push(Action::FollowPointer(false));
    }
}

/// The name of each chart in its corner.
pub(super) fn paint_chart_names(painter: &egui::Painter, mapping: MappingId, window: &PanelWindow) {
    let info = mapping.info();
    if info.layout == Layout::Single {
        return;
    }
    for (chart, name) in info.charts.iter().enumerate() {
        let corner = crate::mapping::ChartPoint::new(chart as u32, 0.02, 0.01);
        if let Some(place) = info.layout.picture_from_chart(corner) {
            let at = window.screen_from_picture(place);
            edged_text(painter, at, Align2::LEFT_TOP, name, Color32::from_gray(230));
        }
    }
}

/// Where a direction lies on the screen.
pub(super) fn place_of(mapping: MappingId, dir: Vec3<f64>, window: &PanelWindow) -> Option<Pos2> {
    let place = mapping
        .forward(dir)
        .and_then(|p| mapping.info().layout.picture_from_chart(p))?;
    Some(window.screen_from_picture(place))
}

/// The directions of a step of the ray story, and a ring around the one that is looked up.
fn paint_story(
    painter: &egui::Painter,
    step: &StoryStep,
    mapping: MappingId,
    window: &PanelWindow,
) {
    for mark in &step.marks {
        if let Some(at) = place_of(mapping, mark.dir, window) {
            dot(painter, at, mark.color);
        }
    }
    if let Some(at) = step.lookup.and_then(|dir| place_of(mapping, dir, window)) {
        ring(painter, at, theme::PROBE);
    }
}

/// The probe's face, its texel and itself; grey where the map has no texel of its own for the direction.
pub(super) fn paint_probe(
    painter: &egui::Painter,
    model: &Model<'_>,
    mapping: MappingId,
    window: &PanelWindow,
) {
    let dir = model.state.probe_f64();
    let info = mapping.info();
    let is_own = info.coverage.contains(dir.to_f64());
    let color = if is_own { theme::PROBE } else { Color32::GRAY };
    let lines = |outline: &[_]| -> Vec<Vec<Pos2>> {
        let lines = picture_lines(mapping, outline).into_iter();
        let on_screen = |line: Vec<_>| line.into_iter().map(|p| window.screen_from_picture(p));
        lines.map(|line| on_screen(line).collect()).collect()
    };
    for line in lines(&face_outline(dir)) {
        edged_line(painter, line, 1.5, color);
    }
    let size = model.map_size(model.state.mapping);
    let texel = lines(&texel_outline(model.state.mapping, size, dir));
    if let Some(at) = place_of(mapping, dir, window) {
        cross_mark(painter, at, color);
    }
    footprint(painter, texel);
}
