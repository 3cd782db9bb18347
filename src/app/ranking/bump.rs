//! Places over the weight of shape: a line for each mapping, crossing where the order flips.

use egui::{Align2, Color32, FontId, Pos2, Rect, RichText, Sense, Stroke, Ui, Vec2, pos2, vec2};

use super::entry::Entry;
use super::panel::set;
use crate::app::action::Action;
use crate::app::laboratory::look;
use crate::app::model::Model;
use crate::app::theme;
use crate::lab::metrics::Metrics;
use crate::lab::ranking::{bounded, bump, order};
use crate::mapping::MappingId;

/// Weights at which places are found: fine enough that a flip looks as if it were there.
const STEPS: usize = 101;
/// Width of the names at both sides.
const NAMES: f32 = 122.0;
/// From this width on there are names at the left, too.
const BOTH_SIDES: f32 = 460.0;
const LETTER: f32 = 11.0;
const QUIET: Color32 = Color32::from_gray(150);

/// The chart, `size` large; a click or a drag in it sets the weight, a click on a name opens the mapping.
pub fn bump_ui(ui: &mut Ui, model: &mut Model<'_>, entries: &[Entry<'_>], size: Vec2) {
    let ranking = &model.state.ranking;
    let basis = ranking.basis;
    let measured: Vec<&Metrics> = entries.iter().filter_map(|entry| entry.metrics).collect();
    let shown = bounded(&measured, basis);
    if shown.is_empty() {
        if !entries.is_empty() {
            ui.label("nothing is measured yet");
        }
        return;
    }
    let top = ui.cursor().top();
    let last: Vec<&str> = measured
        .iter()
        .filter(|metrics| !shown.iter().any(|s| s.mapping == metrics.mapping))
        .map(|metrics| metrics.mapping.info().id)
        .collect();
    if !last.is_empty() {
        let text = format!(
            "Without bound in area or shape, so last as soon as that counts at all: {}",
            last.join(", ")
        );
        ui.add(egui::Label::new(RichText::new(text).small()).wrap());
    }
    let height =
        (size.y - (ui.cursor().top() - top)).max((LETTER + 2.0) * shown.len() as f32 + 20.0);
    let (rect, _) = ui.allocate_exact_size(vec2(size.x, height), Sense::hover());
    let left = if rect.width() >= BOTH_SIDES {
        NAMES
    } else {
        22.0
    };
    let plot = Rect::from_min_max(
        rect.min + vec2(left, 2.0),
        pos2(
            (rect.right() - NAMES).max(rect.left() + left + 40.0),
            rect.bottom() - 18.0,
        ),
    );
    let at = |weight: f64, index: usize| {
        let share = (index as f32 + 0.5) / shown.len() as f32;
        pos2(
            plot.left() + plot.width() * weight as f32,
            plot.top() + plot.height() * share,
        )
    };
    weight_ui(ui, model, plot);
    let ranking = &model.state.ranking;
    let lines = bump(&shown, basis, STEPS);
    let now = plot.left() + plot.width() * ranking.weight as f32;
    let painter = ui.painter().clone();
    painter.rect_stroke(
        plot,
        0.0,
        Stroke::new(1.0, Color32::from_gray(52)),
        egui::StrokeKind::Inside,
    );
    let pointed = ui.data(|data| data.get_temp::<MappingId>(ui.scope_id().with("pointed")));
    for (map, places) in &lines {
        let (color, _) = look(map.info().id);
        let is_chosen =
            ranking.compared.contains(map) || pointed == Some(*map) || model.state.mapping == *map;
        let (width, color) = if is_chosen {
            (2.6, color)
        } else {
            (1.2, color.gamma_multiply(0.6))
        };
        let point = |(k, index): (usize, &usize)| at(k as f64 / (STEPS - 1) as f64, *index);
        let points: Vec<Pos2> = places.iter().enumerate().map(point).collect();
        painter.line(points, Stroke::new(width, color));
    }
    painter.vline(now, plot.y_range(), Stroke::new(1.5, theme::PROBE));
    let font = FontId::proportional(LETTER);
    let here = order(&shown, basis, ranking.weight);
    for (index, placed) in here.iter().enumerate() {
        let (color, _) = look(placed.map.info().id);
        painter.circle_filled(at(ranking.weight, index), 3.0, color);
    }
    for (x, anchor, text) in [
        (plot.left(), Align2::LEFT_BOTTOM, "area alone"),
        (plot.right(), Align2::RIGHT_BOTTOM, "shape alone"),
    ] {
        painter.text(pos2(x, rect.bottom()), anchor, text, font.clone(), QUIET);
    }
    let mut pointed = None;
    for (weight, side) in [(0.0, Align2::RIGHT_CENTER), (1.0, Align2::LEFT_CENTER)] {
        let is_left = weight < 0.5;
        for (index, placed) in order(&shown, basis, weight).iter().enumerate() {
            let beside = at(weight, index) + vec2(if is_left { -5.0 } else { 5.0 }, 0.0);
            let text = if is_left && left < NAMES {
                format!("{}", index + 1)
            } else {
                placed.map.info().id.to_owned()
            };
            let (color, _) = look(placed.map.info().id);
            let drawn = painter.text(beside, side, text, font.clone(), color);
            let id = ui.scope_id().with(("bump", is_left, index));
            let response = ui.interact(drawn, id, Sense::click());
            let end = if is_left { "area" } else { "shape" };
            let label = format!("Place {} by {end}: {}", index + 1, placed.map.info().name);
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
            if response.hovered() || response.has_focus() {
                pointed = Some(placed.map);
                painter.rect_stroke(
                    drawn.expand(1.0),
                    2.0,
                    Stroke::new(1.0, QUIET),
                    egui::StrokeKind::Outside,
                );
            }
            if response.clicked() {
                model.push(Action::OpenMapping(placed.map));
            }
            if let Some(entry) = entries.iter().find(|entry| entry.map == placed.map) {
                response.on_hover_text(entry.summary());
            }
        }
    }
    point_at(ui, pointed);
}

/// A click or a drag sets the weight.
fn weight_ui(ui: &mut Ui, model: &mut Model<'_>, plot: Rect) {
    let id = ui.scope_id().with("bump weight");
    let response = ui.interact(plot, id, Sense::click_and_drag());
    response.widget_info(|| {
        egui::WidgetInfo::labeled(egui::Role::Image, true, "Places over the weight of shape")
    });
    let pointer = response.interact_pointer_pos();
    if let Some(pos) = pointer.filter(|_| response.clicked() || response.dragged()) {
        let weight = f64::from((pos.x - plot.left()) / plot.width()).clamp(0.0, 1.0);
        let mut ranking = model.state.ranking.clone();
        ranking.weight = (weight * 100.0).round() / 100.0;
        set(model, ranking);
    }
}

/// Remembers which mapping is pointed at, to draw its line above the others in the next frame.
fn point_at(ui: &Ui, pointed: Option<MappingId>) {
    let id = ui.scope_id().with("pointed");
    let before = ui.data(|data| data.get_temp::<MappingId>(id));
    if before == pointed {
        return;
    }
    ui.data_mut(|data| {
        data.remove::<MappingId>(id);
        if let Some(map) = pointed {
            data.insert_temp(id, map);
        }
    });
    ui.ctx().request_repaint();
}
