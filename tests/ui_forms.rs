//! The form of the viewport's shader in the window: chosen from a list, kept in the scene, its error shown as a picture.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "a test's helpers say what they expect too"
)]

mod window_kit;

use egui_kittest::kittest::Queryable;
use sixfold::app::action::Action;
use sixfold::app::command::Command;
use sixfold::app::state::{AppState, FormState};
use sixfold::mapping::{MappingId, ShaderForm};
use window_kit::{Ui, open_sized, run, settle, small};

fn form(ui: &Ui) -> FormState {
    ui.state().explorer().state().form
}

/// High enough for all controls.
fn open(state: AppState) -> Ui {
    open_sized(state, 1280.0, 1400.0)
}

/// The share of the viewport's pixels without colour, and how bright its brightest is.
fn grey(ui: &mut Ui) -> (f64, u8) {
    let rect = ui.get_by_label("The viewport").rect().shrink(40.0);
    let picture = ui.render().unwrap();
    let (mut count, mut grey, mut brightest) = (0, 0, 0);
    for y in rect.top() as u32..rect.bottom() as u32 {
        for x in rect.left() as u32..rect.right() as u32 {
            let [r, g, b, _] = picture.get_pixel(x, y).0;
            count += 1;
            grey += u32::from(r == g && g == b);
            brightest = brightest.max(r.min(g).min(b));
        }
    }
    (f64::from(grey) / f64::from(count), brightest)
}

#[test]
fn a_form_is_chosen_and_its_error_is_shown() {
    let mut ui = open(small());
    assert_eq!(form(&ui), FormState::default());
    let (share, _) = grey(&mut ui);
    assert!(share < 0.5, "{share}");
    ui.get_by_role_and_label(egui::Role::ComboBox, "computed by")
        .click();
    settle(&mut ui);
    ui.get_by_role_and_label(egui::Role::Button, "wgsl-own-7")
        .click();
    settle(&mut ui);
    assert_eq!(form(&ui).form, ShaderForm::Own7);
    ui.get_by_label_contains("own arctangent of degree 7");
    assert!(grey(&mut ui).0 < 0.5);

    ui.get_by_label("its error in texels, magnified").click();
    settle(&mut ui);
    assert!(form(&ui).difference);
    // Marks and arrows lie over it.
    let (share, brightest) = grey(&mut ui);
    assert!(share > 0.9 && brightest > 100, "{share} {brightest}");
    // Control: the precise form has no error.
    let precise = FormState {
        difference: true,
        magnification: Some(16),
        ..FormState::default()
    };
    let mut bare = small();
    bare.overlays = sixfold::app::state::Overlays::NONE;
    bare.form = precise;
    let (share, brightest) = grey(&mut open(bare));
    assert!(share > 0.99 && brightest == 0, "{share} {brightest}");

    run(&mut ui, Command::Undo);
    assert!(!form(&ui).difference && form(&ui).form == ShaderForm::Own7);
}

#[test]
fn a_scene_keeps_the_form_and_a_mapping_without_it_is_precise() {
    let mut ui = open(small());
    let wanted = FormState {
        form: ShaderForm::CubeUnit,
        difference: false,
        magnification: Some(64),
    };
    run(&mut ui, Action::SetForm(wanted));
    run(&mut ui, Action::SetMapping(MappingId::Latlong));
    ui.get_by_role_and_label(egui::Role::ComboBox, "computed by")
        .click();
    settle(&mut ui);
    // What it has, and not what it has not.
    ui.get_by_role_and_label(egui::Role::Button, "wgsl-table-256");
    assert!(
        ui.query_by_role_and_label(egui::Role::Button, "cube-unit")
            .is_none()
    );
    assert_eq!(form(&ui), wanted);
    let json = ui.state().explorer().state().to_json().unwrap();
    assert!(json.contains(r#""form": "cube-unit""#), "{json}");
    assert_eq!(AppState::from_json(&json).unwrap().form, wanted);
    for form in ShaderForm::ALL {
        let text = format!(r#"{{"schema": 4, "form": {{"form": "{form}"}}}}"#);
        assert_eq!(AppState::from_json(&text).unwrap().form.form, form);
    }
    let old = AppState::from_json(r#"{"schema": 4}"#).unwrap();
    assert_eq!(old.form, FormState::default());
}
