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
use window_kit::{Ui, WINDOW_SIZES, open, run, settle, small};

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
    ui.get_by_label_contains("--to latlong --size 1024 --layout single --to-frame openexr --rotate 90,0,0 --filter lanczos");
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

#[test]
fn an_export_is_as_fine_as_its_environment_until_rows_are_chosen() {
    let picture = Environment::DirectionColor.image(&Progress::new()).unwrap();
    let [width, height] = [picture.image.width(), picture.image.height()];
    let mut ui = open(small());
    run(&mut ui, Command::ShowExport);
    ui.get_by_label_contains(&format!("--to cube --size {} ", width / 4));
    ui.get_by_label("Blender").click();
    settle(&mut ui);
    ui.get_by_label_contains(&format!("--to latlong --size {height} "));
    // Another number stays, whatever the mapping.
    ui.get_by_label("as fine as the environment").click();
    settle(&mut ui);
    ui.get_by_label("Bevy").click();
    settle(&mut ui);
    ui.get_by_label_contains(&format!("--to cube --size {height} "));
    ui.get_by_label("as fine as the environment").click();
    settle(&mut ui);
    ui.get_by_label_contains(&format!("--to cube --size {} ", width / 4));
}

#[test]
fn a_refused_export_is_asked_for_again_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("taken.exr");
    std::fs::write(&path, b"mine").unwrap();
    let mut ui = open(small());
    run(&mut ui, Command::ShowExport);
    assert!(ui.query_by_label_contains("taken.exr").is_none());
    let export = Export {
        mapping: MappingId::Eac,
        path: path.display().to_string(),
        ..Export::default()
    };
    run(&mut ui, Command::Export(Box::new(export)));
    assert!(ui.state().explorer().messages()[0].is_error);
    run(&mut ui, Command::ShowExport);
    ui.get_by_label_contains("taken.exr --to eac");
    assert_eq!(std::fs::read(&path).unwrap(), b"mine");
}

#[test]
fn a_path_is_typed_without_a_click_and_ends_with_enter() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("none.hdr");
    let mut ui = open(small());
    ui.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::O);
    settle(&mut ui);
    ui.event(egui::Event::Text(path.display().to_string()));
    settle(&mut ui);
    assert_eq!(ui.state().explorer().messages(), []);
    ui.key_press(egui::Key::Enter);
    settle(&mut ui);
    let messages = ui.state().explorer().messages();
    assert!(messages[0].text.contains("none.hdr"), "{messages:?}");
    assert!(ui.query_by_label_contains("Dropping the file").is_none());
}

#[test]
fn of_what_went_well_the_newest_is_shown_and_every_failure() {
    let folder = tempfile::tempdir().unwrap();
    let mut ui = open(small());
    let mut save = |name: &str| {
        let path = folder.path().join(name);
        run(&mut ui, Command::SaveScene { path, force: false });
        let messages = ui.state().explorer().messages().iter();
        messages
            .map(|m| m.text.clone())
            .collect::<Vec<_>>()
            .join("|")
    };
    let first = save("first.json");
    assert!(first.contains("first.json"), "{first}");
    // It is there already.
    save("first.json");
    save("second.json");
    save("third.json");
    let last = save("fourth.json");
    assert!(last.contains("third.json") && last.contains("fourth.json"));
    assert!(last.contains("exists"), "{last}");
    assert!(!last.contains("second.json"), "{last}");
}

#[test]
fn a_turn_of_many_digits_leaves_the_controls_as_wide() {
    let mut ui = open(small());
    let left_of_panels = |ui: &Ui| ui.get_by_label("Viewport").rect().min.x;
    let before = left_of_panels(&ui);
    let turn = Rotation::from_degrees([-120.55, -45.55, -123.45]);
    run(&mut ui, Action::SetRotation(turn));
    assert_eq!(left_of_panels(&ui), before);
    for name in ["yaw", "pitch", "roll"] {
        let number = ui.get_by_role_and_label(egui::Role::SpinButton, name);
        assert!(number.rect().max.x < before - 4.0, "{:?}", number.rect());
    }
}

#[test]
fn a_narrow_window_is_mostly_panels_and_its_bars_do_not_overlap() {
    let mut ui = window_kit::open_sized(small(), 800.0, 600.0);
    let panels = |ui: &Ui| 800.0 - ui.get_by_label("Viewport").rect().min.x;
    assert!(panels(&ui) > 500.0, "{}", panels(&ui));
    assert!(ui.query_by_label("Which face: the sign table").is_none());
    ui.get_by_label("Inspector").click();
    settle(&mut ui);
    ui.get_by_label("Which face: the sign table");
    assert!(
        ui.query_by_label("compared, right of the divider")
            .is_none()
    );
    assert!(panels(&ui) > 380.0, "{}", panels(&ui));
    ui.get_by_label("Controls").click();
    settle(&mut ui);
    ui.get_by_label("compared, right of the divider");
    let plan = ui.get_by_label_contains("textures").rect();
    let hint = ui.get_by_label_contains("the probe follows").rect();
    assert!(plan.max.x <= hint.min.x, "{plan:?} {hint:?}");
    // A wide one has both, and no names to choose by.
    ui.set_size(egui::vec2(1280.0, 800.0));
    settle(&mut ui);
    ui.get_by_label("Which face: the sign table");
    assert!(ui.query_by_label("Inspector").is_none());
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
    for (width, height) in WINDOW_SIZES {
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
