//! The window by role and label, on a software adapter: panels, probe, sign table, messages, and what is left undrawn.

#![cfg(feature = "explorer")]

mod window_kit;

use std::time::Duration;

use egui_kittest::kittest::Queryable;
use sixfold::app::Lost;
use sixfold::app::action::Action;
use sixfold::app::arrangement::Pane;
use sixfold::app::command::Command;
use sixfold::app::state::AppState;
use sixfold::imaging::Environment;
use sixfold::mapping::MappingId;
use sixfold::math::Vec3;
use window_kit::{Ui, open, open_unsettled, place, probe, run, settle, small};

#[test]
fn the_first_window_shows_the_seeds_six_panels_and_the_probe() {
    let mut ui = open(small());
    ui.get_by_label("The viewport");
    for &mapping in &MappingId::ALL[..6] {
        ui.get_by_label(&format!("Panel: {}", mapping.info().name));
    }
    assert!(
        ui.query_by_label("Panel: Octahedral").is_none(),
        "the seventh is not open"
    );
    ui.get_by_label_contains("The row of");
    let picture = ui.render().unwrap();
    let colors: std::collections::HashSet<_> = picture.pixels().map(|p| p.0).collect();
    assert!(
        colors.len() > 1000,
        "the window shows {} colours",
        colors.len()
    );
}

#[test]
fn the_probe_dragged_in_one_panel_is_read_in_all_others() {
    let mut ui = open(small());
    for wanted in [[0.9, 0.3, 0.2], [-0.2, -0.8, 0.3], [0.1, 0.2, -0.9]] {
        let wanted = Vec3::<f64>::from_f64(wanted).normalized();
        let before = ui.render().unwrap();
        let start = place(&ui, MappingId::Cube, Vec3::new(0.0, 0.0, 1.0));
        let end = place(&ui, MappingId::Cube, wanted);
        ui.drag_at(start);
        ui.step();
        ui.hover_at(end);
        ui.step();
        ui.drop_at(end);
        settle(&mut ui);
        let found = probe(&ui);
        // A panel of about 200 points shows four faces across: a point is 0.03 rad.
        assert!(
            sixfold::math::angle_rad(found.to_f64(), wanted.to_f64()) < 0.03,
            "{found:?}"
        );
        let picture = ui.render().unwrap();
        for &mapping in &MappingId::ALL[..6] {
            let at = place(&ui, mapping, found);
            let ring = |picture: &image::RgbaImage| {
                // The ring of the mark has a radius of 6 points and is 1.5 points wide; it is white, or grey where the
                // map shares a texel.
                let is_mark = |radius: f32, turn: f32| {
                    let (sin, cos) = (turn * std::f32::consts::TAU).sin_cos();
                    let (x, y) = (at.x + radius * cos, at.y + radius * sin);
                    let [r, g, b, _] = picture.get_pixel(x as u32, y as u32).0;
                    r.abs_diff(g) < 8 && g.abs_diff(b) < 8 && r > 100
                };
                (0..48)
                    .map(|i| i as f32 / 48.0)
                    .filter(|turn| [5.5, 6.0, 6.5].iter().any(|radius| is_mark(*radius, *turn)))
                    .count()
            };
            assert!(
                ring(&picture) >= 24,
                "{mapping}: no mark at {at:?}: {}",
                ring(&picture)
            );
            assert!(
                ring(&before) < ring(&picture),
                "{mapping}: the mark was there before"
            );
        }
    }
}

#[test]
fn the_sign_table_lights_the_row_of_every_face_and_explains_ties() {
    let mut ui = open(small());
    for (dir, name) in [
        ([1.0, 0.1, 0.2], "+x"),
        ([-1.0, 0.1, 0.2], "-x"),
        ([0.1, 1.0, 0.2], "+y"),
        ([0.1, -1.0, 0.2], "-y"),
        ([0.1, 0.2, 1.0], "+z"),
        ([0.1, 0.2, -1.0], "-z"),
    ] {
        run(&mut ui, Action::SetProbe { dir, eye_ray: None });
        ui.get_by_label(&format!("The row of {name} matches."));
        ui.get_by_label(&format!("▶ {name}"));
        assert!(ui.query_by_label_contains("A tie").is_none());
    }
    // Where +x, +y and +z meet the paper's strict comparison prefers +x, hardware +z.
    run(
        &mut ui,
        Action::SetProbe {
            dir: [1.0, 1.0, 1.0],
            eye_ray: None,
        },
    );
    ui.get_by_label("The row of +x matches.");
    ui.get_by_label_contains("A tie: +x and +z and +y meet here");
}

#[test]
fn every_mapping_has_a_panel_and_its_steps_and_none_fails_when_tiny() {
    let mut state = small();
    state.panels.iter_mut().for_each(|p| p.open = true);
    let mut ui = open(state);
    for &mapping in MappingId::ALL {
        ui.get_by_label(&format!("Panel: {}", mapping.info().name));
        run(&mut ui, Action::SetMapping(mapping));
        let steps = mapping.steps(probe(&ui));
        assert!(steps.len() >= 3);
        for step in steps {
            assert!(
                ui.query_all_by_label_contains(step.formula)
                    .next()
                    .is_some(),
                "{mapping}: {}",
                step.formula
            );
        }
    }
    for (width, height) in [(300.0, 200.0), (40.0, 30.0), (1.0, 1.0), (1280.0, 800.0)] {
        ui.set_size(egui::vec2(width, height));
        settle(&mut ui);
    }
    assert_eq!(ui.state().explorer().messages(), []);
}

#[test]
fn a_bad_file_is_reported_and_leaves_the_scene_as_it_was() {
    let mut ui = open(small());
    let before = ui.state().explorer().state().clone();
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in [
        (
            "damaged.hdr",
            b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n".as_slice(),
        ),
        ("damaged.png", b"\x89PNG\r\n\x1a\nnot a picture".as_slice()),
        ("damaged.json", b"{".as_slice()),
        ("missing.exr", b"".as_slice()),
    ] {
        let path = folder.path().join(name);
        if name != "missing.exr" {
            std::fs::write(&path, bytes).unwrap();
        }
        run(&mut ui, Command::Open(path));
        settle(&mut ui);
        let messages = ui.state().explorer().messages();
        let last = messages
            .last()
            .unwrap_or_else(|| panic!("{name} was not reported"));
        assert!(last.is_error && last.text.contains(name), "{}", last.text);
        assert!(!last.text.contains('\n'));
        ui.get_by_label_contains(name);
        assert_eq!(*ui.state().explorer().state(), before, "{name}");
    }
}

#[test]
fn a_still_window_draws_nothing_and_a_probe_move_redraws_no_map() {
    let mut ui = open(small());
    let totals = |ui: &Ui| ui.state().explorer().report().totals;
    let still = totals(&ui);
    ui.run_steps(10);
    assert_eq!(
        totals(&ui).submissions,
        still.submissions,
        "a still window drew"
    );
    assert!(window_kit::rests(&mut ui), "a still window asks for frames");
    run(
        &mut ui,
        Action::SetProbe {
            dir: [0.0, 0.0, 1.0],
            eye_ray: None,
        },
    );
    let moved = totals(&ui);
    assert_eq!(
        (moved.map_bakes, moved.panel_draws),
        (still.map_bakes, still.panel_draws)
    );
    assert!(
        moved.viewport_draws > still.viewport_draws,
        "the probe's mark did not move"
    );
    run(
        &mut ui,
        Action::Orbit {
            dx_rad: 0.3,
            dy_rad: 0.0,
        },
    );
    assert_eq!(
        totals(&ui).map_bakes,
        still.map_bakes,
        "an orbit drew a map"
    );
    assert_eq!(
        totals(&ui).panel_draws,
        still.panel_draws,
        "an orbit drew a panel"
    );
    // A hidden panel takes its texture along, and shown again it is drawn again.
    let textures = ui.state().explorer().report().textures;
    run(
        &mut ui,
        Action::SetPaneOpen(Pane::Map(MappingId::Latlong), false),
    );
    assert_eq!(
        ui.state().explorer().report().textures,
        textures - 2,
        "the panel and its map"
    );
    run(
        &mut ui,
        Action::SetPaneOpen(Pane::Map(MappingId::Latlong), true),
    );
    assert_eq!(totals(&ui).map_bakes, still.map_bakes + 1);
}

#[test]
fn keys_move_the_probe_by_texels_and_undo_takes_changes_back() {
    let mut ui = open(small());
    let before = probe(&ui);
    ui.key_press(egui::Key::ArrowRight);
    settle(&mut ui);
    let size = sixfold::gpu::map_size(MappingId::Ccm, 6 * 64 * 64);
    let columns = |dir| MappingId::Ccm.forward::<f64>(dir).unwrap().u * f64::from(size[0]);
    assert!((columns(probe(&ui)) - columns(before) - 1.0).abs() < 1e-3);
    run(&mut ui, Action::SetMapping(MappingId::Cube));
    ui.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    settle(&mut ui);
    assert_eq!(ui.state().explorer().state().mapping, MappingId::Ccm);
}

#[test]
fn controls_are_found_by_their_labels_and_do_what_they_say() {
    let mut ui = open(small());
    // It may lie below what the window shows of the controls.
    ui.get_by_label("great circles A to F").scroll_to_me();
    ui.run_steps(30);
    ui.get_by_label("great circles A to F").click();
    ui.run_steps(3);
    assert!(ui.state().explorer().state().overlays.great_circles);
    ui.get_by_label("the seed's numbers").click();
    settle(&mut ui);
    ui.get_by_label("convention paper");
    ui.get_by_label("printed and right").click();
    settle(&mut ui);
    ui.get_by_label("Eq. 6");
    ui.get_by_label("Maximise Cube map").click();
    settle(&mut ui);
    assert!(
        ui.query_by_label("The viewport").is_none(),
        "a maximised panel hides the rest"
    );
    ui.get_by_label("Show all panels").click();
    settle(&mut ui);
    ui.get_by_label("The viewport");
}

#[test]
fn a_lost_device_ends_in_a_message_and_a_saved_scene() {
    let lost = Lost::default();
    let mut ui = open_unsettled(small(), 1280.0, 800.0, lost.clone());
    settle(&mut ui);
    ui.run_steps(2);
    assert!(lost.lock().unwrap().is_none());
    ui.state().explorer().gpu().device.destroy();
    for _ in 0..1000 {
        // The device tells of its end when it is asked.
        drop(
            ui.state()
                .explorer()
                .gpu()
                .device
                .poll(wgpu::PollType::Poll),
        );
        if ui.state().explorer().is_lost() {
            break;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    ui.step();
    let why = lost.lock().unwrap().clone().unwrap();
    let path = why
        .strip_prefix("the scene is in ")
        .unwrap_or_else(|| panic!("{why}"));
    let saved = AppState::from_json(&std::fs::read_to_string(path).unwrap()).unwrap();
    std::fs::remove_file(path).unwrap();
    let shown = ui.state().explorer().state();
    assert_eq!((saved.probe, saved.mapping), (shown.probe, shown.mapping));
}

#[test]
fn a_load_that_is_overtaken_or_cancelled_leaves_state_and_picture_alike() {
    let mut ui = open(small());
    let ctx = ui.ctx.clone();
    let tell = |ui: &mut Ui, command: Command| ui.state_mut().explorer_mut().run(&ctx, command);
    let shown = |ui: &Ui| ui.state().explorer().state().environment.clone();
    tell(&mut ui, Command::LoadEnvironment(Environment::Graticule));
    settle(&mut ui);
    assert_eq!(shown(&ui), Environment::Graticule);
    // Back to the first one, whose load begins, and on again before it ends.
    tell(&mut ui, Command::Undo);
    tell(&mut ui, Command::Redo);
    settle(&mut ui);
    assert_eq!(
        shown(&ui),
        Environment::Graticule,
        "an overtaken load was shown"
    );
    // Begun and cancelled before its result can have been taken.
    tell(&mut ui, Command::Undo);
    let job = ui.state().explorer().jobs().remove(0);
    tell(&mut ui, Command::Cancel(job.id));
    settle(&mut ui);
    assert_eq!(
        shown(&ui),
        Environment::Graticule,
        "the state names what is not shown"
    );
}

#[test]
fn undo_takes_back_changes_only_and_a_hidden_panel_is_not_maximised() {
    let mut ui = open(small());
    run(&mut ui, Action::SetMapping(MappingId::Cube));
    run(&mut ui, Command::Undo);
    // Nothing changes here, so what was undone can still be made again.
    run(&mut ui, Action::SetDivider(f32::NAN));
    run(&mut ui, Action::FollowPointer(true));
    run(&mut ui, Command::Redo);
    assert_eq!(ui.state().explorer().state().mapping, MappingId::Cube);
    let pane = Pane::Map(MappingId::Latlong);
    run(&mut ui, Action::SetMaximised(Some(pane)));
    assert_eq!(ui.state().explorer().state().maximised, Some(pane));
    run(
        &mut ui,
        Action::SetPaneOpen(Pane::Map(MappingId::Latlong), false),
    );
    assert_eq!(ui.state().explorer().state().maximised, None);
    ui.get_by_label("The viewport");
}

#[test]
fn hostile_scenes_open_mended_or_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut ui = open(small());
    for (name, text) in [
        (
            "nul.json",
            r#"{"schema":1,"environment":{"file":"a\u0000b.hdr"}}"#,
        ),
        (
            "columns.json",
            r#"{"schema":1,"arrangement":{"grid":{"columns":18446744073709551615,"children":[{"pane":"viewport"}]}}}"#,
        ),
        (
            "shares.json",
            r#"{"schema":1,"arrangement":{"row":[{"share":1e39,"content":{"pane":"viewport"}}]}}"#,
        ),
        (
            "deep.json",
            &format!(
                "{{\"schema\":1,\"arrangement\":{}",
                r#"{"tabs":{"active":9,"children":["#.repeat(400)
            ),
        ),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        run(&mut ui, Command::Open(path));
        settle(&mut ui);
        ui.get_by_label("The viewport");
    }
    // A scene whose environment has no Unicode name cannot be text: that is said, and nothing is written.
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        let name = std::ffi::OsStr::from_bytes(b"sky\xff.hdr");
        let state = AppState {
            environment: Environment::File(std::path::PathBuf::from(name).into()),
            ..small()
        };
        let why = state.to_json().unwrap_err().to_string();
        assert!(why.contains("rename") && !why.contains('\n'), "{why}");
    }
}

#[test]
fn the_divider_is_dragged_and_the_camera_turns_zooms_and_comes_back() {
    let mut ui = open(small());
    run(&mut ui, Action::SetCompare(Some(MappingId::Eac)));
    let grip = ui
        .get_by_label("Divider between the mappings")
        .rect()
        .center();
    let view = ui.get_by_label("The viewport").rect();
    let target = egui::pos2(view.left() + 0.25 * view.width(), grip.y);
    ui.drag_at(grip);
    ui.step();
    ui.hover_at(target);
    ui.step();
    ui.drop_at(target);
    settle(&mut ui);
    let state = ui.state().explorer().state().clone();
    assert!(
        (state.divider - 0.25).abs() < 0.02,
        "the divider stands at {}",
        state.divider
    );
    assert_eq!(
        state.camera,
        AppState::default().camera,
        "the divider's drag turned the camera"
    );
    // A drag beside it turns the camera, and leaves the divider.
    let start = egui::pos2(view.left() + 0.75 * view.width(), grip.y);
    ui.drag_at(start);
    ui.step();
    ui.hover_at(start + egui::vec2(40.0, 10.0));
    ui.step();
    ui.drop_at(start + egui::vec2(40.0, 10.0));
    settle(&mut ui);
    let turned = ui.state().explorer().state().clone();
    assert_ne!(turned.camera.yaw_rad, state.camera.yaw_rad);
    assert_eq!(turned.divider, state.divider);
    for key in [egui::Key::A, egui::Key::Plus, egui::Key::W] {
        ui.key_press(key);
    }
    settle(&mut ui);
    let moved = ui.state().explorer().state().camera;
    assert!(moved.distance < turned.camera.distance && moved != turned.camera);
    ui.key_press(egui::Key::R);
    settle(&mut ui);
    assert_eq!(
        ui.state().explorer().state().camera,
        AppState::default().camera
    );
}
