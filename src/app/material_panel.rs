//! The controls of the material: only those that the chosen kind has, each with its unit.

use egui::{DragValue, RichText, Slider, Ui};

use super::action::Action;
use super::command::Command;
use super::controls::choose_ui;
use super::dialogs::Dialog;
use super::model::Model;
use crate::imaging::short_name;
use crate::optics::glass::{FRAUNHOFER_C_UM, FRAUNHOFER_F_UM, Glass};
use crate::optics::material::{
    BallPicture, Dispersion, INDEX_RANGE, MAGNIFICATION_RANGE, MOST_BOUNCES, Material, POWER_RANGE,
    Shading, Surface, Surfaces, View, WAVELENGTHS_RANGE,
};
use crate::optics::metal::Metal;
use crate::optics::presets::presets;
use crate::optics::{Formula, critical_angle_rad};

/// Shows the material's controls.
pub fn material_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let before = &model.state.material;
    let mut material = before.clone();
    preset_ui(ui, &mut material);
    choose_into(ui, "kind", &mut material.surface, Surface::ALL, |s| {
        s.name()
    });
    surface_ui(ui, model, &mut material);
    choose_into(
        ui,
        "what is looked at",
        &mut material.view,
        View::ALL,
        |v| v.name(),
    );
    view_ui(ui, &mut material);
    if material != *before {
        model.push(Action::SetMaterial(Box::new(material)));
    }
    compare_ui(ui, model);
}

fn choose_into<T: PartialEq + Clone>(
    ui: &mut Ui,
    label: &str,
    value: &mut T,
    options: impl IntoIterator<Item = T>,
    name: impl Fn(&T) -> &'static str,
) {
    let name = |option: &T| name(option).to_owned();
    if let Some(chosen) = choose_ui(ui, label, value, options, name) {
        *value = chosen;
    }
}

/// A slider under its name.
fn slider_ui(ui: &mut Ui, label: &str, slider: Slider<'_>) {
    let name = ui.label(label);
    // What is not edited keeps all its digits, also those that are not shown.
    let slider = slider.clamping(egui::SliderClamping::Edits);
    ui.add(slider).labelled_by(name.id);
}

fn preset_ui(ui: &mut Ui, material: &mut Material) {
    // A preset changes what the body is, not what is looked at.
    let made = |make: &fn() -> Material| Material {
        view: material.view,
        ..make()
    };
    let now = presets()
        .iter()
        .find(|(_, make)| made(make) == *material)
        .map(|(name, _)| *name);
    let names = presets().iter().map(|(name, _)| Some(*name));
    let title = |name: &Option<&'static str>| name.unwrap_or("your own").to_owned();
    let chosen = choose_ui(ui, "preset", &now, names, title).flatten();
    let preset = presets().iter().find(|(name, _)| Some(*name) == chosen);
    if let Some((_, make)) = preset {
        *material = made(make);
    }
}

fn surface_ui(ui: &mut Ui, model: &mut Model<'_>, material: &mut Material) {
    match material.surface {
        Surface::Mirror => mirror_ui(ui, model, material),
        Surface::Dielectric => {
            index_ui(ui, &mut material.index);
            refracting_ui(ui, model, material);
        }
        Surface::Metal => {
            choose_into(ui, "metal", &mut material.metal, Metal::ALL, |m| m.name());
            let index = material.metal.index_rgb();
            for (color, [n, k]) in ["red", "green", "blue"].into_iter().zip(index) {
                note_ui(ui, &format!("{color}: n = {n:.3}, k = {k:.3}"));
            }
        }
        Surface::Glass => {
            let label = "dispersion";
            choose_into(ui, label, &mut material.dispersion, Dispersion::ALL, |d| {
                d.name()
            });
            if material.dispersion == Dispersion::Spectral {
                choose_into(ui, "glass", &mut material.glass, Glass::ALL, |g| g.name());
                let [red, blue] =
                    [FRAUNHOFER_C_UM, FRAUNHOFER_F_UM].map(|um| material.glass.index(um));
                note_ui(ui, &format!("n = {red:.4} at 656 nm, {blue:.4} at 486 nm"));
                let (low, high) = WAVELENGTHS_RANGE;
                let slider = Slider::new(&mut material.wavelengths, low..=high);
                slider_ui(ui, "wavelengths", slider);
            } else {
                index_ui(ui, &mut material.index);
            }
            refracting_ui(ui, model, material);
        }
        Surface::Veil => {
            ui.checkbox(&mut material.opacity_by_angle, "opacity 1 − cos");
            if !material.opacity_by_angle {
                let slider = Slider::new(&mut material.opacity, 0.0..=1.0).max_decimals(2);
                slider_ui(ui, "opacity", slider);
            }
        }
        Surface::Ball => ball_ui(ui, model, material),
    }
}

fn mirror_ui(ui: &mut Ui, model: &mut Model<'_>, material: &mut Material) {
    let label = "reflected and looked up";
    choose_into(ui, label, &mut material.shading, Shading::ALL, |s| s.name());
    if material.shading == Shading::PerPixel {
        ui.checkbox(&mut material.printed_reflection, "the paper's sign (P6)")
            .on_hover_text("2 (N · I) N − I with the incident vector towards the surface");
    } else {
        density_ui(ui, model);
    }
}

/// The fineness of the body's triangles; a model has its own.
fn density_ui(ui: &mut Ui, model: &mut Model<'_>) {
    if model.state.model.is_some() {
        return;
    }
    let (low, high) = super::state::DENSITY_RANGE;
    let mut density = model.state.density;
    let label = ui.label("mesh density");
    let slider = Slider::new(&mut density, low..=high).logarithmic(true);
    if ui.add(slider).labelled_by(label.id).changed() {
        model.push(Action::SetDensity(density));
    }
    note_ui(
        ui,
        &format!("{} triangles", model.target.mesh().triangles().len()),
    );
}

fn index_ui(ui: &mut Ui, index: &mut f32) {
    let (low, high) = INDEX_RANGE;
    let slider = Slider::new(index, low..=high).max_decimals(4);
    slider_ui(ui, "index n2/n1", slider);
    let eta = 1.0 / f64::from(*index);
    let mut text = format!("eta = n1/n2 = {eta:.4}");
    if let Some(critical) = critical_angle_rad(eta.max(1.0 / eta)) {
        let side = if eta > 1.0 { "" } else { " inside" };
        text += &format!(", critical angle{side} {:.2}°", critical.to_degrees());
    }
    note_ui(ui, &text);
}

fn formula_ui(ui: &mut Ui, material: &mut Material) {
    let label = "reflectance by";
    choose_into(ui, label, &mut material.formula, Formula::ALL, |f| f.name());
    let formula = material.formula;
    shape_ui(ui, material, formula);
}

/// The numbers of one formula.
fn shape_ui(ui: &mut Ui, material: &mut Material, formula: Formula) {
    let number = |ui: &mut Ui, name: &str, value: &mut f32, (low, high): (f32, f32)| {
        ui.horizontal(|ui| {
            let label = ui.label(name);
            let drag = DragValue::new(value).range(low..=high).speed(0.02);
            ui.add(drag.max_decimals(2)).labelled_by(label.id);
        });
    };
    let shape = &mut material.shape;
    match formula {
        Formula::Schlick => number(ui, "exponent", &mut shape.exponent, POWER_RANGE),
        Formula::Cg => {
            number(ui, "bias", &mut shape.bias, (0.0, 1.0));
            number(ui, "scale", &mut shape.scale, (0.0, 4.0));
            number(ui, "power", &mut shape.power, POWER_RANGE);
        }
        Formula::Simple | Formula::PrintedSign => {
            number(ui, "power", &mut shape.power, POWER_RANGE)
        }
        _ => {}
    }
}

/// How much is reflected, and how far light is followed. Through both surfaces it is followed exactly: no formula is asked for.
fn refracting_ui(ui: &mut Ui, model: &Model<'_>, material: &mut Material) {
    let is_exact = material.surfaces == Surfaces::Both && material.view == View::Whole;
    if is_exact {
        note_ui(ui, "reflectance: Fresnel, exact");
    } else {
        formula_ui(ui, material);
    }
    surfaces_ui(ui, model, material);
}

fn surfaces_ui(ui: &mut Ui, model: &Model<'_>, material: &mut Material) {
    let mut both = material.surfaces == Surfaces::Both;
    ui.checkbox(&mut both, "through both surfaces")
        .on_hover_text("Off: the ray inside the body looks up the map, as in the notes' shaders");
    material.surfaces = if both { Surfaces::Both } else { Surfaces::One };
    if both {
        bounces_ui(ui, material);
        if material.surface == Surface::Glass && !model.is_ball {
            note_ui(
                ui,
                "this body is traced at one wavelength; the sphere shows all",
            );
        }
    }
}

fn bounces_ui(ui: &mut Ui, material: &mut Material) {
    let slider = Slider::new(&mut material.bounces, 0..=MOST_BOUNCES);
    slider_ui(ui, "inner reflections", slider);
}

fn ball_ui(ui: &mut Ui, model: &mut Model<'_>, material: &mut Material) {
    let mut options = vec![BallPicture::Outline, BallPicture::Toon, BallPicture::Studio];
    if let BallPicture::File(_) = material.ball {
        options.push(material.ball.clone());
    }
    let name = |picture: &BallPicture| match picture {
        BallPicture::Outline => "outline".to_owned(),
        BallPicture::Toon => "toon".to_owned(),
        BallPicture::Studio => "studio".to_owned(),
        BallPicture::File(path) => short_name(path),
    };
    if let Some(ball) = choose_ui(ui, "picture of the ball", &material.ball, options, name) {
        material.ball = ball;
    }
    if ui.button("Open a picture …").clicked() {
        model.push(Command::ShowDialog(Dialog::OpenBall(String::new())));
    }
}

fn view_ui(ui: &mut Ui, material: &mut Material) {
    // What the view needs and the kind has no control for.
    let asks_index = !matches!(
        material.view,
        View::Whole | View::Reflection | View::Opacity
    );
    let is_metals = material.surface == Surface::Metal && material.view == View::Reflectance;
    if asks_index && !material.refracts() && !is_metals {
        index_ui(ui, &mut material.index);
        if material.view != View::Discriminant && material.view != View::Refraction {
            formula_ui(ui, material);
        }
    }
    match material.view {
        View::Difference => {
            let label = "less the reflectance by";
            choose_into(ui, label, &mut material.other_formula, Formula::ALL, |f| {
                f.name()
            });
            let other = material.other_formula;
            if other != material.formula {
                shape_ui(ui, material, other);
            }
            magnification_ui(ui, material);
            note_ui(ui, "orange: more, white: alike, blue: less");
        }
        View::SurfaceDifference => {
            magnification_ui(ui, material);
            if material.surfaces == Surfaces::One {
                bounces_ui(ui, material);
            }
        }
        View::Discriminant | View::Refraction if material.eta() > 1.0 => {
            note_ui(ui, "stripes: all light is reflected");
        }
        _ => {}
    }
}

fn magnification_ui(ui: &mut Ui, material: &mut Material) {
    let (low, high) = MAGNIFICATION_RANGE;
    let slider = Slider::new(&mut material.magnification, low..=high).logarithmic(true);
    slider_ui(ui, "magnified", slider.suffix("×").max_decimals(1));
}

/// Another material right of the divider: the present one is kept there, to be changed on the left.
fn compare_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut is_compared = model.state.compare_material.is_some();
    let text = "keep this material at the right";
    if ui.checkbox(&mut is_compared, text).changed() {
        let kept = is_compared.then(|| Box::new(model.state.material.clone()));
        model.push(Action::SetCompareMaterial(kept));
    }
}

fn note_ui(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).small());
}
