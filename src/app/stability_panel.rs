//! The stability pane: where to look, the microscope, and the table of evaluators and families.

use egui::{Align, ComboBox, DragValue, Label, Layout, RichText, ScrollArea, Slider, Ui, vec2};

use super::action::Action;
use super::microscope::{degrees_text, microscope_ui};
use super::model::Model;
use super::narrow::slider_ui;
use super::stability_table::{TABLE_WIDTH, table_ui};
use super::state::{LENGTHS, StabilityState};
use super::theme;
use crate::lab::stress::microscope::{Lengths, SPAN_DEG};
use crate::lab::stress::places::{PLACES, Place};

/// Width from which table and microscope stand side by side: the table's with the microscope's.
const WIDE: f32 = 1040.0;
/// Room beside the table for what scrolls it.
const SCROLL_BAR: f32 = 14.0;
/// Below this width or height everything scrolls together.
const LEAST: egui::Vec2 = vec2(200.0, 380.0);
/// Height of the microscope there.
const LOW_MICROSCOPE: f32 = 260.0;

/// Shows the pane in all the space there is.
pub fn stability_ui(ui: &mut Ui, model: &mut Model<'_>) {
    theme::pane_frame(ui).show(ui, |ui| {
        let size = ui.available_size();
        let column = Layout::top_down(Align::Min);
        if size.x < LEAST.x || size.y < LEAST.y {
            let scroll = ScrollArea::both().auto_shrink([false, false]);
            scroll.show(ui, |ui| {
                ui.set_max_width(size.x.max(LEAST.x));
                let width = ui.available_width();
                looking_ui(ui, model);
                let height = LOW_MICROSCOPE.min(size.y.max(1.0));
                ui.allocate_ui_with_layout(vec2(width, height), column, |ui| {
                    microscope_ui(ui, model);
                });
                table_ui(ui, model);
            });
        } else if size.x >= WIDE {
            ui.horizontal_top(|ui| {
                let width = TABLE_WIDTH + SCROLL_BAR;
                ui.allocate_ui_with_layout(vec2(width, size.y), column, |ui| {
                    ui.set_width(width);
                    table_ui(ui, model);
                });
                ui.allocate_ui_with_layout(ui.available_size(), column, |ui| {
                    looking_ui(ui, model);
                    microscope_ui(ui, model);
                });
            });
        } else {
            looking_ui(ui, model);
            // The picture has the larger share.
            let height = (0.6 * ui.available_height()).max(120.0);
            let width = ui.available_width();
            ui.allocate_ui_with_layout(vec2(width, height), column, |ui| {
                microscope_ui(ui, model);
            });
            ui.add_space(4.0);
            table_ui(ui, model);
        }
    });
}

/// Changes what the pane shows.
pub(super) fn set(model: &mut Model<'_>, stability: StabilityState) {
    if stability != model.state.stability {
        model.push(Action::SetStability(Box::new(stability)));
    }
}

/// Where one looks, and through which evaluator.
fn looking_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut stability = model.state.stability.clone();
    ui.horizontal_wrapped(|ui| {
        ui.menu_button("Go to a finding", |ui| {
            for place in &PLACES {
                if ui.button(place.title).on_hover_text(place.why).clicked() {
                    go_to(model, place);
                    ui.close();
                }
            }
        })
        .response
        .on_hover_text("The literature's faults, each where it lies");
        evaluator_ui(ui, model, &mut stability);
        lengths_ui(ui, &mut stability);
        if ui
            .button("Turn the viewport there")
            .on_hover_text(
                "The eye goes where the object shows this direction; the fine zoom is the microscope's",
            )
            .clicked()
        {
            let dir = stability.center;
            model.push(Action::FaceDirection(dir.map(|c| c as f32)));
            model.keep_probe(dir);
        }
    });
    ui.horizontal(|ui| zoom_ui(ui, &mut stability));
    let [x, y, z] = stability.center;
    let text = format!("around {x:+.9} {y:+.9} {z:+.9}");
    ui.add(Label::new(RichText::new(text).small()).wrap());
    set(model, stability);
}

fn go_to(model: &mut Model<'_>, place: &Place) {
    if place.map != model.state.mapping {
        model.push(Action::SetMapping(place.map));
    }
    let stability = model.state.stability.clone().at(place);
    let dir = stability.center;
    set(model, stability);
    model.keep_probe(dir);
}

fn evaluator_ui(ui: &mut Ui, model: &Model<'_>, stability: &mut StabilityState) {
    let mapping = model.state.mapping;
    let now = stability.evaluator_of(mapping).map_or("", |e| e.id);
    let label = ui.label("by");
    ComboBox::from_id_salt("microscope evaluator")
        .width(110.0_f32.min(ui.available_width()))
        .height(420.0)
        .selected_text(now)
        .show_ui(ui, |ui| {
            for evaluator in mapping.evaluators() {
                let option = ui.selectable_label(evaluator.id == now, evaluator.id);
                if option.on_hover_text(evaluator.about).clicked() {
                    evaluator.id.clone_into(&mut stability.evaluator);
                }
            }
        })
        .response
        .labelled_by(label.id);
}

fn zoom_ui(ui: &mut Ui, stability: &mut StabilityState) {
    let label = ui.label("across");
    // To the right is nearer.
    let [low, high] = SPAN_DEG;
    let slider = Slider::new(&mut stability.span_deg, high..=low)
        .logarithmic(true)
        .smallest_positive(low)
        .custom_formatter(|deg, _| degrees_text(deg))
        .custom_parser(|text| text.trim().trim_end_matches('°').trim().parse().ok());
    ui.spacing_mut().slider_width = 240.0;
    slider_ui(ui, slider, label.id, "0.000020°").on_hover_text(
        "The angle across the picture's smaller side; the wheel zooms, a drag pans. f32 has a step every 0.0000034°",
    );
}

/// How long the vectors are.
fn lengths_ui(ui: &mut Ui, stability: &mut StabilityState) {
    let names = ["rays of a camera", "vectors of length"];
    let now = usize::from(matches!(stability.lengths, Lengths::Sphere(_)));
    let label = ui.label("for");
    let hover =
        "Rounding falls differently at each length. A camera's rays end on a plane at distance 1";
    ComboBox::from_id_salt("microscope lengths")
        .width(130.0_f32.min(ui.available_width()))
        .selected_text(names[now])
        .show_ui(ui, |ui| {
            if ui.selectable_label(now == 0, names[0]).clicked() {
                stability.lengths = Lengths::Plane;
            }
            if ui.selectable_label(now == 1, names[1]).clicked() && now == 0 {
                stability.lengths = Lengths::Sphere(1.0);
            }
        })
        .response
        .labelled_by(label.id)
        .on_hover_text(hover);
    if let Lengths::Sphere(length) = &mut stability.lengths {
        let speed = (*length * 0.001).max(f64::MIN_POSITIVE);
        let number = DragValue::new(length)
            .speed(speed)
            .range(LENGTHS.0..=LENGTHS.1)
            .update_while_editing(false)
            .custom_formatter(|x, _| length_text(x));
        ui.add(number).on_hover_text("Drag, or type");
    }
}

fn length_text(x: f64) -> String {
    if (0.01..1000.0).contains(&x) {
        format!("{x:.6}")
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned()
    } else {
        format!("{x:.3e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_is_short() {
        for (x, text) in [(1.0, "1"), (1.0005, "1.0005"), (1e-40, "1.000e-40")] {
            assert_eq!(length_text(x), text);
        }
    }
}
