//! The pane: what is measured and shown, the plot, where the used evaluator errs, and the table.

use egui::{Rect, RichText, Sense, Ui, pos2, vec2};

use super::choices::{budget_ui, filters_ui, measure_ui};
use super::plot::{Shown, legend_ui, plot_ui};
use super::table::table_ui;
use super::words::NOT_MEASURED;
use super::{ShownErrors, Used, Wanted};
use crate::app::map_panel::{paint_chart_names, paint_probe, place_of, window_of};
use crate::app::marks::{colour_bar, ring};
use crate::app::model::Model;
use crate::app::numbers::significant;
use crate::app::state::PanelState;
use crate::app::theme;
use crate::lab::bench::Row;
use crate::lab::filter::fronts;
use crate::mapping::MappingId;
use crate::math::Vec3;

/// Width from which the errors' picture stands beside the plot.
const WIDE: f32 = 480.0;
/// Below this width the pane scrolls sideways.
const LEAST_WIDTH: f32 = 190.0;
/// Least height of the plot.
const LOWEST_PLOT: f32 = 200.0;
/// Height of the table with its head.
const TABLE_HEIGHT: f32 = 190.0;
/// Height of the errors' picture in a narrow pane.
const PICTURE_HEIGHT: f32 = 170.0;
/// A click this near to the worst direction's ring means it, in points.
const GRIP: f32 = 14.0;

/// Shows the laboratory in all the space there is.
pub fn laboratory_ui(ui: &mut Ui, model: &mut Model<'_>) {
    theme::scrolled_pane(ui, LEAST_WIDTH, |ui, height| content_ui(ui, model, height));
}

fn content_ui(ui: &mut Ui, model: &mut Model<'_>, height: f32) {
    let top = ui.cursor().top();
    measure_ui(ui, model);
    filters_ui(ui, model);
    budget_ui(ui, model);
    let maps = model.state.laboratory.maps(model.state.mapping);
    let rows = model.labs.bench.rows();
    let found: Vec<&Row> = model.state.laboratory.filter(&maps).of(rows);
    let shown: Vec<Shown<'_>> = found.iter().copied().zip(fronts(&found)).collect();
    legend_ui(ui, model, &maps);
    if rows.is_empty() {
        return;
    }
    let left = height - (ui.cursor().top() - top) - TABLE_HEIGHT;
    let plot_height = left.max(LOWEST_PLOT);
    let width = ui.available_width();
    if width >= WIDE {
        ui.horizontal_top(|ui| {
            plot_ui(ui, model, &shown, vec2((0.6 * width).floor(), plot_height));
            ui.vertical(|ui| errors_ui(ui, model, plot_height));
        });
        table_ui(ui, model, &shown, TABLE_HEIGHT);
    } else {
        plot_ui(ui, model, &shown, vec2(width, plot_height.min(width)));
        table_ui(ui, model, &shown, TABLE_HEIGHT);
        errors_ui(ui, model, PICTURE_HEIGHT);
    }
}

/// Where the used evaluator errs: the mapping's picture, with a scale. Without a measured speed no error is shown.
fn errors_ui(ui: &mut Ui, model: &mut Model<'_>, height: f32) {
    let map = model.state.mapping;
    let Some(used) = model.used else { return };
    let Used {
        evaluator,
        measured: Some(choice),
        ..
    } = used
    else {
        let text = format!("{} by {}: {NOT_MEASURED}", map.info().id, used.evaluator.id);
        ui.label(RichText::new(text).small());
        return;
    };
    let top = ui.cursor().top();
    let shown = model.labs.bench.errors.shown();
    let is_of = |(of, _): &(&Wanted, _)| of.map == map && of.evaluator == evaluator.id;
    let shown = shown.filter(is_of).map(|(_, shown)| shown);
    let ns = significant(choice.row.ns);
    let name = format!("{} by {}", map.info().id, evaluator.id);
    let text = match shown {
        Some(shown) => format!("{name}, {ns} ns a direction: {}", range_text(shown)),
        None => format!("{name}: computing where it errs …"),
    };
    ui.add(egui::Label::new(RichText::new(text).small()).wrap());
    scale_ui(ui);
    let used_height = ui.cursor().top() - top;
    let size = vec2(ui.available_width(), (height - used_height).max(60.0));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Errors"));
    let window = window_of(&PanelState::new(map, true), rect);
    let picture = window.picture_rect();
    let pixels = picture.size() * ui.ctx().pixels_per_point();
    let side = |length: f32| (length.round() as usize).clamp(1, 4096);
    model.errors_wanted = Some(Wanted {
        map,
        evaluator: evaluator.id,
        rows: model.map_size(map)[1],
        size: [side(pixels.x), side(pixels.y)],
    });
    let painter = ui.painter_at(rect);
    let Some(shown) = shown else { return };
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    painter.image(shown.picture.id(), picture, whole, egui::Color32::WHITE);
    if model.state.overlays.names {
        paint_chart_names(&painter, map, &window);
    }
    let worst = (shown.errors.max_rad > 0.0).then_some(shown.errors.worst);
    let worst_at = worst.and_then(|dir| place_of(map, Vec3::from_f64(dir), &window));
    if let Some(at) = worst_at {
        ring(&painter, at, theme::VECTORS[0]);
    }
    if model.state.overlays.probe {
        paint_probe(&painter, model, map, &window);
    }
    let clicked = response
        .interact_pointer_pos()
        .filter(|_| response.clicked());
    if let Some(pos) = clicked {
        let dir = match (worst, worst_at) {
            (Some(worst), Some(at)) if at.distance(pos) < GRIP => Some(worst),
            _ => dir_at(map, window.picture_from_screen(pos)),
        };
        if let Some(dir) = dir {
            model.keep_probe(dir);
        }
    }
    response.on_hover_text("A click moves the probe there; the ring is the worst direction");
}

fn dir_at(map: MappingId, place: [f64; 2]) -> Option<[f64; 3]> {
    let point = map.info().layout.chart_from_picture(place)?;
    map.inverse::<f64>(point).map(Vec3::to_f64)
}

/// The errors of the picture: the ends of its scale, and its holes.
fn range_text(shown: &ShownErrors) -> String {
    let errors = &shown.errors;
    let holes = match errors.holes {
        0 => String::new(),
        holes => format!("; red: {holes} pixels without a result"),
    };
    format!(
        "from 0 to {} rad, {} texel here{holes}",
        significant(errors.max_rad),
        significant(errors.max_texels)
    )
}

/// The scale's colours, from no error at the left to the largest.
fn scale_ui(ui: &mut Ui) {
    const HEIGHT: f32 = 10.0;
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    colour_bar(ui.painter(), rect, theme::scale);
}
