//! What is measured, what is shown of it, and the error budget.

use egui::{RichText, Slider, Ui};

use super::words::{NOT_MEASURED, budget_text};
use crate::app::action::Action;
use crate::app::command::Command;
use crate::app::dialogs::{Dialog, SaveDialog};
use crate::app::lists::{grouped_ui, list_ui, scrolled_ui};
use crate::app::model::Model;
use crate::app::narrow::slider_ui;
use crate::app::state::{BUDGET_TEXELS, LaboratoryState};
use crate::lab::bench::Way;
use crate::lab::filter::{Load, devices};
use crate::lab::inputs::Inputs;
use crate::mapping::MappingId;

/// Name of the folder that is proposed for the measurements.
const FOLDER: &str = "bench";

/// The button that measures, and what was measured last.
pub fn measure_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let lab = &model.labs.bench;
    ui.horizontal_wrapped(|ui| {
        let measure = egui::Button::new("Measure");
        let response = ui.add_enabled(!lab.is_measuring(), measure);
        let hint = "Times every evaluator of the mappings below on this machine, each beside a plain copy, and finds its error";
        if response.on_hover_text(hint).clicked() {
            model.push(Command::MeasureEvaluators);
        }
        let mut full = model.state.laboratory.full;
        let hint = "Longer times and more directions: minutes in place of seconds";
        if ui.checkbox(&mut full, "carefully").on_hover_text(hint).changed() {
            change(model, |laboratory| laboratory.full = full);
        }
        let save = egui::Button::new("Save …");
        if ui.add_enabled(lab.measured().is_some(), save).clicked() {
            model.push(Command::ShowDialog(Dialog::SaveBench(SaveDialog {
                path: FOLDER.to_owned(),
                force: false,
            })));
        }
    });
    let text = if lab.is_measuring() {
        "measuring …".to_owned()
    } else if let Some(why) = lab.fault() {
        why.to_owned()
    } else if let Some(measured) = lab.measured() {
        let machine = &measured.machine;
        format!(
            "{} measurements of {} on {}, {} cores",
            measured.rows.len(),
            machine.date,
            machine.cpu,
            machine.cores
        )
    } else {
        format!("{NOT_MEASURED}: nothing is measured until you ask for it")
    };
    ui.add(egui::Label::new(RichText::new(text).small()).wrap());
}

/// What is shown of the measurements.
pub fn filters_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let before = &model.state.laboratory;
    let mut laboratory = before.clone();
    mappings_ui(ui, model.state.mapping, &mut laboratory);
    lists_ui(ui, devices(model.labs.bench.rows()), &mut laboratory);
    if laboratory != *before {
        model.push(Action::SetLaboratory(Box::new(laboratory)));
    }
}

/// The lists, as many in a line as have room: a list and its name stay together.
fn lists_ui(ui: &mut Ui, known: Vec<String>, laboratory: &mut LaboratoryState) {
    let LaboratoryState {
        direction,
        inputs,
        load,
        device,
        ..
    } = laboratory;
    let mut lists: Vec<List<'_>> = vec![
        Box::new(|ui| {
            let ways = [Way::Forward, Way::Inverse];
            list_ui(ui, "way", direction, ways, |way| way.id().to_owned());
        }),
        Box::new(|ui| list_ui(ui, "inputs", inputs, Inputs::ALL, |i| i.id().to_owned())),
        Box::new(|ui| list_ui(ui, "threads", load, Load::ALL, |l| l.name().to_owned())),
        Box::new(|ui| {
            let options = std::iter::once(None).chain(known.into_iter().map(Some));
            list_ui(ui, "device", device, options, |device| {
                device.clone().unwrap_or_else(|| "the widest".to_owned())
            });
        }),
    ];
    let in_line = (ui.available_width() / LIST_WIDTH).max(1.0) as usize;
    while !lists.is_empty() {
        let line = lists.drain(..in_line.min(lists.len())).collect::<Vec<_>>();
        ui.horizontal(|ui| line.into_iter().for_each(|list| list(ui)));
    }
}

/// A list with its name.
type List<'a> = Box<dyn FnOnce(&mut Ui) + 'a>;
/// Width of the longest.
const LIST_WIDTH: f32 = 190.0;

/// The mappings beside the one that is looked up.
fn mappings_ui(ui: &mut Ui, map: MappingId, laboratory: &mut LaboratoryState) {
    ui.menu_button("Mappings …", |ui| {
        let mut entry_ui = |ui: &mut Ui, other: MappingId| {
            let mut is_shown = other == map || laboratory.beside.contains(&other);
            let checkbox = egui::Checkbox::new(&mut is_shown, other.info().name);
            if ui.add_enabled(other != map, checkbox).changed() {
                laboratory.beside.retain(|m| *m != other);
                if is_shown {
                    laboratory.beside.push(other);
                }
            }
        };
        let all = MappingId::ALL.iter().copied();
        let family = |map: &MappingId| Some(map.info().family);
        scrolled_ui(ui, |ui| grouped_ui(ui, all, family, &mut entry_ui));
    });
}

/// The budget, and what it finds.
pub fn budget_ui(ui: &mut Ui, model: &mut Model<'_>) {
    /// Width from which the slider stands beside its name.
    const BESIDE: f32 = 330.0;
    let laboratory = &model.state.laboratory;
    let (mut is_on, mut texels) = (laboratory.budget_on, laboratory.budget_texels);
    let mut is_changed = false;
    let content = |ui: &mut Ui| {
        let hint = "The cheapest evaluator within this error is used: a share of a texel, or of a pixel where a texel takes several";
        let on = ui.checkbox(&mut is_on, "error budget").on_hover_text(hint);
        ui.spacing_mut().slider_width = 90.0;
        let slider = Slider::new(&mut texels, BUDGET_TEXELS.0..=BUDGET_TEXELS.1)
            .logarithmic(true)
            .max_decimals(4)
            .suffix(" texel");
        let slider_ui = |ui: &mut Ui| slider_ui(ui, slider, on.id, "0.0001 texel");
        let slider = ui.add_enabled_ui(is_on, slider_ui).inner;
        is_changed = on.changed() || slider.changed();
    };
    if ui.available_width() >= BESIDE {
        ui.horizontal(content);
    } else {
        ui.scope(content);
    }
    if is_changed {
        change(model, |laboratory| {
            (laboratory.budget_on, laboratory.budget_texels) = (is_on, texels);
        });
    }
    if laboratory.budget_on {
        let text = budget_text(model);
        ui.add(egui::Label::new(RichText::new(text).small()).wrap());
    }
}

/// Changes something of what the laboratory shows.
pub fn change(model: &mut Model<'_>, with: impl FnOnce(&mut LaboratoryState)) {
    let mut laboratory = model.state.laboratory.clone();
    with(&mut laboratory);
    model.push(Action::SetLaboratory(Box::new(laboratory)));
}
