//! Environments in the window: turned, exported for other programs.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod window_kit;

use egui_kittest::kittest::Queryable;
use sixfold::app::action::Action;
use sixfold::app::command::Command;
use sixfold::app::export::{Export, Preset};
use sixfold::app::state::{AppState, Overlays};
use sixfold::imaging::load::{self, Format, Opened};
use sixfold::imaging::{Environment, Progress, Stored};
use sixfold::mapping::{ChartPoint, Layout, MappingId};
use sixfold::math::{Rotation, turned};
use window_kit::{Ui, open, run, settle, small};

fn state(ui: &Ui) -> &AppState {
    ui.state().explorer().state()
}

/// The newest message, which must not be a failure.
fn told(ui: &Ui) -> String {
    let message = ui.state().explorer().messages().last().unwrap();
    assert!(!message.is_error, "{}", message.text);
    message.text.clone()
}

#[test]
fn a_turn_bakes_what_is_shown_and_is_taken_back_at_once() {
    let mut ui = open(small());
    let bakes = |ui: &Ui| ui.state().explorer().report().totals.map_bakes;
    let before = bakes(&ui);
    for yaw in [10.0, 20.0, 30.0] {
        run(
            &mut ui,
            Action::SetRotation(Rotation::from_degrees([yaw, 0.0, 0.0])),
        );
    }
    assert_eq!(bakes(&ui) - before, 3 * 6, "six panels are shown");
    ui.get_by_role_and_label(egui::Role::SpinButton, "yaw");
    run(&mut ui, Command::Undo);
    assert_eq!(state(&ui).rotation, Rotation::NONE);
    assert!(window_kit::rests(&mut ui));
}

#[test]
fn rings_are_shown_when_they_are_wanted_and_a_drag_turns_one_number() {
    let mut ui = open(small());
    assert!(ui.query_by_label("Ring: yaw").is_none());
    let overlays = Overlays {
        rings: true,
        ..state(&ui).overlays
    };
    run(&mut ui, Action::SetOverlays(overlays));
    for (index, name) in ["yaw", "pitch", "roll"].into_iter().enumerate() {
        let before = state(&ui).rotation.degrees();
        let camera = state(&ui).camera;
        let knob = ui.get_by_label(&format!("Ring: {name}")).rect().center();
        ui.hover_at(knob);
        ui.step();
        ui.drag_at(knob);
        ui.step();
        ui.hover_at(knob + egui::vec2(25.0, 12.0));
        ui.step();
        ui.drop_at(knob + egui::vec2(25.0, 12.0));
        settle(&mut ui);
        let after = state(&ui).rotation.degrees();
        for i in 0..3 {
            assert_eq!(
                before[i] != after[i],
                i == index,
                "{name}: {before:?} {after:?}"
            );
        }
        assert_eq!(state(&ui).camera, camera, "the drag turned the camera too");
    }
}

#[test]
fn older_scenes_are_not_turned() {
    let old = AppState::from_json(r#"{"schema": 2, "overlays": {"axes": false}}"#).unwrap();
    assert_eq!(old.rotation, Rotation::NONE);
    assert!(!old.overlays.rings && !old.overlays.axes);
    let new = AppState {
        rotation: Rotation::from_degrees([10.0, 20.0, 400.0]),
        ..AppState::default()
    };
    let read = AppState::from_json(&new.to_json().unwrap()).unwrap();
    assert_eq!(read.rotation.degrees(), [10.0, 20.0, 40.0]);
}

#[test]
fn an_export_is_chosen_by_program_and_opens_again() {
    let folder = tempfile::tempdir().unwrap();
    let mut ui = open(small());
    let turn = Rotation::from_degrees([90.0, 0.0, 0.0]);
    run(&mut ui, Action::SetRotation(turn));
    ui.key_press_modifiers(
        egui::Modifiers::COMMAND | egui::Modifiers::SHIFT,
        egui::Key::E,
    );
    settle(&mut ui);
    ui.get_by_label("Export the environment");
    for preset in &Preset::ALL {
        ui.get_by_role_and_label(egui::Role::Button, preset.name)
            .click();
        settle(&mut ui);
    }
    ui.get_by_label("Bevy").click();
    settle(&mut ui);
    ui.get_by_label_contains("--to cube --size 512 --to-frame bevy --rotate 90,0,0");
    // A small one has been timed, without a job that anyone sees.
    ui.get_by_label_contains("s, judging by a small one");
    let choose = |ui: &mut Ui, list: &str, item: &str| {
        ui.get_by_role_and_label(egui::Role::ComboBox, list).click();
        settle(ui);
        ui.get_by_role_and_label(egui::Role::Button, item).click();
        settle(ui);
    };
    assert!(ui.query_by_label_contains("--filter").is_none());
    choose(&mut ui, "filter", "lanczos");
    ui.get_by_label_contains("--filter lanczos");
    ui.get_by_label("Blender").click();
    settle(&mut ui);
    assert!(ui.query_by_label_contains("--envmap").is_none());
    choose(&mut ui, "frame", "OpenEXR");
    ui.get_by_label_contains("--to latlong --size 512 --layout single --to-frame openexr --rotate 90,0,0 --filter lanczos");
    ui.get_by_label_contains("--envmap");
    let path = folder.path().join("sky.ktx2");
    let export = Export {
        mapping: MappingId::Cube,
        layout: Layout::Faces,
        format: Format::Ktx2,
        stored: Stored::F32,
        height: 16,
        has_levels: true,
        rotation: turn,
        path: path.display().to_string(),
        ..Export::default()
    };
    run(&mut ui, Command::Export(Box::new(export.clone())));
    assert!(told(&ui).contains("sky.ktx2"));
    ui.get_by_label_contains("s, judging by a small one");
    let Opened::Container(cube) = load::open(&path, &Progress::new()).unwrap() else {
        panic!("no container");
    };
    assert!(cube.is_cube());
    assert_eq!(cube.levels.len(), 5);
    // The environment's colour is its direction; what is seen is that of the turned viewer.
    let worst = |rotation: Rotation| {
        let mut worst = 0.0f32;
        for (chart, raster) in cube.levels[0].rasters.iter().enumerate() {
            let point = ChartPoint::new(chart as u32, 5.5 / 16.0, 11.5 / 16.0);
            let dir = MappingId::Cube.inverse::<f64>(point).unwrap();
            let wanted = light(turned(rotation.source_from_world(), dir).to_array());
            let found = raster.light(5, 11);
            for i in 0..3 {
                worst = worst.max((found[i] - wanted[i]).abs());
            }
        }
        worst
    };
    assert!((1e-6..0.02).contains(&worst(turn)), "{}", worst(turn));
    let other_way = worst(Rotation::from_degrees([-90.0, 0.0, 0.0]));
    assert!(other_way > 0.3, "control {other_way}");
    // Once more, and it is refused: the file is there.
    run(&mut ui, Command::Export(Box::new(export)));
    assert!(
        ui.state()
            .explorer()
            .messages()
            .last()
            .is_some_and(|m| m.is_error && m.text.contains("sky.ktx2"))
    );
}

/// The light that the environment has in a direction, looked up in its picture.
fn light(dir: [f64; 3]) -> [f32; 3] {
    use std::sync::LazyLock;
    static PICTURE: LazyLock<load::Loaded> =
        LazyLock::new(|| Environment::DirectionColor.image(&Progress::new()).unwrap());
    let point = MappingId::Latlong
        .forward(sixfold::math::Vec3::<f64>::from_f64(dir))
        .unwrap();
    PICTURE.image.nearest(point.u, point.v)
}

#[test]
fn no_dialog_is_clipped_or_fails_when_tiny() {
    let mut ui = open(small());
    for (width, height) in [
        (1280.0, 800.0),
        (800.0, 600.0),
        (300.0, 200.0),
        (1.0, 1.0),
        (800.0, 600.0),
    ] {
        ui.set_size(egui::vec2(width, height));
        ui.state_mut();
        ui.key_press_modifiers(
            egui::Modifiers::COMMAND | egui::Modifiers::SHIFT,
            egui::Key::E,
        );
        settle(&mut ui);
        if width >= 800.0 {
            let export = ui
                .get_by_role_and_label(egui::Role::Button, "Export")
                .rect();
            assert!(
                export.max.y < height && export.min.x > 0.0,
                "{export:?} in {width} x {height}"
            );
        }
    }
    assert_eq!(ui.state().explorer().messages(), []);
}
