//! The pane of the loss laboratory: what is measured, the numbers, and the residual.

use egui::{Color32, DragValue, Rect, RichText, Sense, Ui, vec2};

use super::action::Action;
use super::command::Command;
use super::labs::Lab;
use super::lists::{grouped_list_ui, list_ui};
use super::loss::{Measured, Shown};
use super::map_panel::{paint_chart_names, paint_probe, place_of, pointer, window_of};
use super::marks::ring;
use super::model::Model;
use super::numbers::significant;
use super::state::{LOSS_ROWS, LossState, MOST_MAGNIFIED};
use super::theme;
use crate::imaging::compare::Worst;
use crate::imaging::resample::{Filter, chart_size, equal_rows};
use crate::mapping::MappingId;
use crate::math::Vec3;

/// Width from which the picture stands beside the text.
const WIDE: f32 = 620.0;
/// Width of the text there.
const TEXT_WIDTH: f32 = 300.0;
/// Below this width the text scrolls, or its words would be cut.
const LEAST_WIDTH: f32 = 140.0;
/// Below this height a picture shows too little.
const LOWEST_PICTURE: f32 = 150.0;
/// A click this near to the worst texel's ring means the texel, in points.
const GRIP: f32 = 16.0;
/// The ring around the worst texel.
const WORST: Color32 = theme::VECTORS[0];

/// Shows the laboratory in all the space there is.
pub fn loss_ui(ui: &mut Ui, model: &mut Model<'_>) {
    theme::pane_frame(ui).show(ui, |ui| {
        let size = ui.available_size();
        let scroll = egui::ScrollArea::both().auto_shrink([false, false]);
        if size.x >= WIDE {
            ui.horizontal_top(|ui| {
                let column = egui::Layout::top_down(egui::Align::Min);
                ui.allocate_ui_with_layout(vec2(TEXT_WIDTH, size.y), column, |ui| {
                    scroll.show(ui, |ui| text_ui(ui, model));
                });
                picture_ui(ui, model, ui.available_size());
            });
        } else {
            // One below the other; where both have no room, they scroll.
            scroll.show(ui, |ui| {
                ui.set_max_width(size.x.max(LEAST_WIDTH));
                let top = ui.cursor().top();
                text_ui(ui, model);
                let left = size.y - (ui.cursor().top() - top);
                let width = ui.available_width();
                picture_ui(ui, model, vec2(width, left.max(LOWEST_PICTURE.min(size.y))));
            });
        }
    });
}

fn text_ui(ui: &mut Ui, model: &mut Model<'_>) {
    choices_ui(ui, model);
    ui.separator();
    let lab = &model.labs.loss;
    if let Some(shown) = lab.shown() {
        numbers_ui(ui, model, shown);
    }
    if let Some(why) = lab.fault() {
        ui.label(why);
        if ui.button("Measure again").clicked() {
            model.push(Command::MeasureLoss);
        }
    } else if lab.is_busy() {
        ui.label(RichText::new("measuring …").small());
    }
}

/// What is measured, and how it is shown. A is the map that goes and comes back, B the one that it goes through.
fn choices_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut loss = model.state.loss;
    ui.label("What is lost from A to B and back to A?");
    ui.horizontal_wrapped(|ui| map_ui(ui, "A", &mut loss.from, &mut loss.from_rows));
    ui.horizontal_wrapped(|ui| map_ui(ui, "B", &mut loss.via, &mut loss.via_rows));
    let filters = std::iter::once(None).chain(Filter::ALL.map(Some));
    let filter_name = |filter: &Option<Filter>| filter.map_or("what suits", Filter::id).to_owned();
    ui.horizontal_wrapped(|ui| list_ui(ui, "filter", &mut loss.filter, filters, filter_name));
    let powers = (0..=MOST_MAGNIFIED.ilog2())
        .step_by(2)
        .map(|power| Some(1 << power));
    let shown = |factor: &Option<u32>| {
        factor.map_or("what suits".to_owned(), |factor| format!("× {factor}"))
    };
    let powers = std::iter::once(None).chain(powers);
    ui.horizontal_wrapped(|ui| list_ui(ui, "magnified", &mut loss.magnification, powers, shown));
    if loss != model.state.loss {
        model.push(Action::SetLoss(loss));
    }
}

/// A mapping and its rows; another mapping is as fine as the one before.
fn map_ui(ui: &mut Ui, label: &str, mapping: &mut MappingId, rows: &mut u32) {
    let before = *mapping;
    let all = MappingId::ALL.iter().copied();
    let name = |mapping: &MappingId| mapping.info().name.to_owned();
    let family = |mapping: &MappingId| Some(mapping.info().family);
    grouped_list_ui(ui, label, mapping, all, name, family);
    if *mapping != before {
        *rows = equal_rows(*mapping, before, chart_size(before, *rows));
    }
    let number = DragValue::new(rows)
        .range(LOSS_ROWS.0..=LOSS_ROWS.1)
        .suffix(" rows")
        .update_while_editing(false);
    ui.add(number)
        .on_hover_text("Rows of a chart: drag, or type");
}

/// The numbers of a measurement. Speed stands beside its error.
fn numbers_ui(ui: &mut Ui, model: &mut Model<'_>, shown: &Shown) {
    let (settings, measured) = (&shown.wanted.settings, &shown.measured);
    ui.label(RichText::new(way_text(settings)).small());
    ui.label(error_and_time_text(measured));
    if !measured.is_lossless() {
        let worst = &measured.loss.difference.worst;
        let button = egui::Button::new(worst_text(settings, worst)).wrap();
        let response = ui.add(button);
        if response.on_hover_text("Move the probe there").clicked() {
            model.keep_probe(worst.dir);
        }
    }
    let times = if measured.is_lossless() {
        "differences: black everywhere".to_owned()
    } else {
        format!("differences × {}", shown.factor)
    };
    ui.label(times);
}

/// "A: Latlong 512×256; B: Cube map 6 × 128×128".
fn way_text(settings: &LossState) -> String {
    let map = |mapping: MappingId, rows: u32| {
        let [width, height] = chart_size(mapping, rows);
        let count = match mapping.info().chart_count() {
            1 => String::new(),
            count => format!("{count} × "),
        };
        format!("{} {count}{width}×{height}", mapping.info().name)
    };
    format!(
        "A: {}; B: {}",
        map(settings.from, settings.from_rows),
        map(settings.via, settings.via_rows)
    )
}

/// The error with the time that it took: neither says much alone.
fn error_and_time_text(measured: &Measured) -> String {
    let loss = &measured.loss;
    let [there, back] = loss.times.map(|time| time.as_secs_f64() * 1e3);
    let [first, second] = loss.reports.each_ref().map(|report| report.filter.id());
    let times = format!("there in {there:.1} ms ({first}), back in {back:.1} ms ({second})");
    let difference = &loss.difference;
    if measured.is_lossless() {
        return format!("nothing is lost: every texel came back exactly; {times}");
    }
    let peak = if difference.peak == 1.0 {
        "white, 1".to_owned()
    } else {
        format!("the brightest light, {:.4}", difference.peak)
    };
    format!(
        "RMS {} in linear light; PSNR {:.2} dB against {peak}; {times}",
        significant(difference.rms),
        difference.psnr_db
    )
}

fn worst_text(settings: &LossState, worst: &Worst) -> String {
    let charts = settings.from.info().charts;
    let chart = match charts.get(worst.chart as usize) {
        Some(name) if charts.len() > 1 => format!(" of {name}"),
        _ => String::new(),
    };
    let [column, row] = worst.texel;
    let [x, y, z] = worst.dir;
    format!(
        "worst texel: {column}, {row}{chart}, off by {} towards {x:+.3} {y:+.3} {z:+.3}",
        significant(worst.difference)
    )
}

/// The residual, seen as the panel of its mapping is: what is zoomed there is zoomed here.
fn picture_ui(ui: &mut Ui, model: &mut Model<'_>, size: egui::Vec2) {
    if size.x < 1.0 || size.y < 1.0 {
        return;
    }
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Residual"));
    let lab = &model.labs.loss;
    let Some(shown) = lab.shown() else {
        return;
    };
    let mapping = shown.wanted.settings.from;
    let view = model.state.panel(mapping);
    let window = window_of(&view, rect);
    let worst = (!shown.measured.is_lossless()).then_some(shown.measured.loss.difference.worst);
    let worst_at = worst.and_then(|worst| {
        let at = place_of(mapping, Vec3::from_f64(worst.dir), &window)?;
        Some((worst, at))
    });
    let clicked = response
        .interact_pointer_pos()
        .filter(|_| response.clicked());
    match (worst_at, clicked) {
        (Some((worst, at)), Some(pos)) if at.distance(pos) < GRIP => model.keep_probe(worst.dir),
        _ => pointer(ui, model, view, &window, &response),
    }
    let painter = ui.painter_at(rect);
    let whole = Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
    let picture = window.picture_rect();
    painter.image(shown.picture.id(), picture, whole, Color32::WHITE);
    if model.state.overlays.names {
        paint_chart_names(&painter, mapping, &window);
    }
    if let Some((_, at)) = worst_at {
        ring(&painter, at, WORST);
    }
    if model.state.overlays.probe {
        paint_probe(&painter, model, mapping, &window);
    }
}
