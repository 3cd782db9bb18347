//! The controls at the left: what is looked up, in what surroundings, and what is drawn over it.

use egui::{ComboBox, RichText, Slider, Ui};

use super::action::Action;
use super::arrangement::Pane;
use super::command::Command;
use super::dialogs::Dialog;
use super::lists;
use super::material_panel::material_ui;
use super::model::Model;
use super::state::{EXPOSURE_RANGE, MOST_MAGNIFIED, TEXEL_BUDGET_RANGE};
use super::turning::rotation_ui;
use crate::gpu::ToneCurve;
use crate::imaging::{Environment, short_name};
use crate::lab::metrics::Quantity;
use crate::lab::metrics::tissot::SPACING_DEG;
use crate::mapping::{Family, MappingId, ShaderForm};
use crate::scene::Object;

/// Shows the controls, scrolled where they are too many.
pub fn controls_ui(ui: &mut Ui, model: &mut Model<'_>) {
    egui::ScrollArea::vertical()
        .auto_shrink([false, false])
        .show(ui, |ui| {
            heading_ui(ui, "Mapping");
            mapping_ui(ui, model);
            heading_ui(ui, "Scene");
            scene_ui(ui, model);
            heading_ui(ui, "Material");
            material_ui(ui, model);
            heading_ui(ui, "Overlays");
            overlays_ui(ui, model);
            heading_ui(ui, "Light");
            light_ui(ui, model);
            heading_ui(ui, "Shader");
            form_ui(ui, model);
            heading_ui(ui, "Panels");
            panels_ui(ui, model);
        });
}

fn heading_ui(ui: &mut Ui, title: &str) {
    ui.add_space(4.0);
    ui.label(RichText::new(title).strong());
    ui.separator();
}

/// A labelled list to choose from.
pub(super) fn choose_ui<T: PartialEq + Clone>(
    ui: &mut Ui,
    label: &str,
    now: &T,
    options: impl IntoIterator<Item = T>,
    name: impl Fn(&T) -> String,
) -> Option<T> {
    choose_grouped_ui(ui, label, now, options, name, |_| None)
}

/// The same of what belongs to mappings' families.
fn choose_grouped_ui<T: PartialEq + Clone>(
    ui: &mut Ui,
    label: &str,
    now: &T,
    options: impl IntoIterator<Item = T>,
    name: impl Fn(&T) -> String,
    family: impl Fn(&T) -> Option<Family>,
) -> Option<T> {
    let mut chosen = now.clone();
    let text = ui.label(label);
    ComboBox::from_id_salt(label)
        .width(ui.available_width() - 8.0)
        .height(lists::HEIGHT)
        .selected_text(name(now))
        .show_ui(ui, |ui| {
            lists::entries_ui(ui, &mut chosen, options, name, family)
        })
        .response
        .labelled_by(text.id);
    (chosen != *now).then_some(chosen)
}

fn mapping_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let state = model.state;
    let all = MappingId::ALL.iter().copied();
    let name = |m: &MappingId| m.info().name.to_owned();
    let family = |m: &MappingId| Some(m.info().family);
    if let Some(mapping) = choose_grouped_ui(
        ui,
        "looked up by object and sky",
        &state.mapping,
        all.clone(),
        name,
        family,
    ) {
        model.push(Action::SetMapping(mapping));
    }
    let others = std::iter::once(None).chain(all.filter(|m| *m != state.mapping).map(Some));
    let name = |m: &Option<MappingId>| m.map_or("none", |m| m.info().name).to_owned();
    let family = |m: &Option<MappingId>| m.map(|m| m.info().family);
    if let Some(compare) = choose_grouped_ui(
        ui,
        "compared, right of the divider",
        &state.compare,
        others,
        name,
        family,
    ) {
        model.push(Action::SetCompare(compare));
    }
    let mut budget = state.texel_budget as f32 / 1e6;
    let (low, high) = TEXEL_BUDGET_RANGE;
    let range = low as f32 / 1e6..=high as f32 / 1e6;
    let label = ui.label("texels of every map, in millions");
    let slider = Slider::new(&mut budget, range)
        .logarithmic(true)
        .max_decimals(4);
    // Each new budget bakes every map anew: wait until the slider is let go.
    let response = ui
        .add(slider.update_while_editing(false))
        .labelled_by(label.id);
    if response.changed() && !response.dragged() || response.drag_stopped() {
        let texels = (budget * 1e6) as u32;
        if texels != state.texel_budget {
            model.push(Action::SetTexelBudget(texels));
        }
    }
    let [w, h] = model.map_size(state.mapping);
    let charts = state.mapping.info().chart_count();
    ui.label(RichText::new(format!("{charts} × {w}×{h} texels")).small());
}

/// In which form the shaders run, and how far it errs.
fn form_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let state = model.state;
    let mut chosen = state.form;
    let now = model.form.form;
    let id = |form: &ShaderForm| form.id().to_owned();
    if let Some(form) = choose_ui(ui, "computed by", &now, state.mapping.forms(), id) {
        chosen.form = form;
    }
    if now != ShaderForm::Precise {
        ui.label(RichText::new(now.about()).small());
    }
    if now != state.mapping.form_or_precise(chosen.form) {
        ui.label(RichText::new("chosen by the error budget").small());
    }
    ui.checkbox(&mut chosen.difference, "its error in texels, magnified");
    if chosen.difference {
        let powers = (0..=MOST_MAGNIFIED.ilog2()).step_by(2);
        let powers = std::iter::once(None).chain(powers.map(|power| Some(1 << power)));
        let name = |factor: &Option<u32>| {
            factor.map_or("what suits".to_owned(), |factor| format!("× {factor}"))
        };
        if let Some(factor) = choose_ui(ui, "magnified by", &chosen.magnification, powers, name) {
            chosen.magnification = factor;
        }
    }
    if chosen != state.form {
        model.push(Action::SetForm(chosen));
    }
}

fn scene_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let state = model.state;
    let now = &state.environment;
    let mut options: Vec<Environment> = Environment::ALL_BUILT_IN.to_vec();
    if let Environment::File(_) = now {
        options.push(now.clone());
    }
    if let Some(environment) = choose_ui(ui, "environment", now, options, Environment::name) {
        model.push(Command::LoadEnvironment(environment));
    }
    if ui.button("Open a file …").clicked() {
        model.push(Command::ShowDialog(Dialog::Open(String::new())));
    }
    if let Environment::File(file) = now
        && ui
            .button("How it is read …")
            .on_hover_text("Mapping, layout and which way round the file is")
            .clicked()
    {
        model.push(Command::ShowDialog(Dialog::Reading(file.clone())));
    }
    if let Some(text) = model.surroundings.and_then(|s| s.bad_texels().summary()) {
        ui.label(RichText::new(text).small().color(super::theme::TEXEL));
    }
    rotation_ui(ui, model);
    object_ui(ui, model);
    if ui
        .button("Reset the view")
        .on_hover_text("Key: R")
        .clicked()
    {
        model.push(Action::ResetCamera);
    }
}

/// The built-in objects, and the model from a file while there is one.
fn object_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let state = model.state;
    let own = state.model.as_ref();
    let name = |object: &Option<Object>| match (object, own) {
        (Some(object), _) => object.name().to_owned(),
        (None, Some(path)) => short_name(path),
        (None, None) => String::new(),
    };
    let now = own.is_none().then_some(state.object);
    let model_first = own.map(|_| None);
    let options = model_first.into_iter().chain(Object::ALL.map(Some));
    if let Some(Some(object)) = choose_ui(ui, "object", &now, options, name) {
        model.push(Action::SetObject(object));
    }
}

fn light_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let state = model.state;
    let mut ev = state.exposure_ev;
    let label = ui.label("exposure");
    let range = EXPOSURE_RANGE.0..=EXPOSURE_RANGE.1;
    let slider = ui.add(Slider::new(&mut ev, range).suffix(" EV").max_decimals(2));
    if slider.labelled_by(label.id).changed() {
        model.push(Action::SetExposure(ev));
    }
    let tone = choose_ui(ui, "tone curve", &state.tone, ToneCurve::ALL, |t| {
        t.name().to_owned()
    });
    if let Some(tone) = tone {
        model.push(Action::SetTone(tone));
    }
}

fn overlays_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut overlays = model.state.overlays;
    for (on, name) in [
        (&mut overlays.great_circles, "great circles A to F"),
        (&mut overlays.face_tint, "tint of the faces"),
        (&mut overlays.grid, "lines of equal u and v"),
        (&mut overlays.vectors, "incident, normal, reflected"),
        (&mut overlays.axes, "axes"),
        (&mut overlays.probe, "probe"),
        (&mut overlays.names, "names of the charts"),
    ] {
        ui.checkbox(on, name);
    }
    let heats = std::iter::once(None).chain(Quantity::ALL.map(Some));
    let name = |heat: &Option<Quantity>| heat.map_or("light", Quantity::name).to_owned();
    if let Some(heat) = choose_ui(ui, "panels show", &overlays.heat, heats, name) {
        overlays.heat = heat;
    }
    ui.checkbox(&mut overlays.ellipses, "Tissot's ellipses")
        .on_hover_text("What each mapping makes of equal circles of the sphere");
    if overlays.ellipses {
        let range = SPACING_DEG.0..=SPACING_DEG.1;
        let label = ui.label("a circle every");
        ui.add(
            Slider::new(&mut overlays.ellipses_deg, range)
                .suffix("°")
                .step_by(1.0),
        )
        .labelled_by(label.id);
    }
    if overlays != model.state.overlays {
        model.push(Action::SetOverlays(overlays));
    }
}

fn panels_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let all = MappingId::ALL.iter().copied();
    let family = |map: &MappingId| Some(map.info().family);
    lists::grouped_ui(ui, all, family, |ui, mapping| {
        let pane = Pane::Map(mapping);
        let mut open = model.state.is_open(pane);
        if ui.checkbox(&mut open, pane.name()).changed() {
            model.push(Action::SetPaneOpen(pane, open));
        }
    });
    if ui.button("Arrange as at first").clicked() {
        model.push(Command::ResetArrangement);
    }
}
