//! The map that folds from its flat picture onto the sphere, in the window.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod window_kit;

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use sixfold::app::action::{Action, apply};
use sixfold::app::arrangement::Pane;
use sixfold::app::command::Command;
use sixfold::app::fold::Surface;
use sixfold::app::state::{AppState, FoldState};
use sixfold::mapping::{ChartPoint, MappingId};
use sixfold::math::angle_rad;
use window_kit::{
    TILED_SIZES, Ui, WINDOW_SIZES, assert_within, long_names, open, open_sized, probe, rests, run,
    settle, small, tile, tiled,
};

fn folded(mapping: MappingId, share: f32) -> AppState {
    AppState {
        mapping,
        maximised: Some(Pane::Fold),
        fold: FoldState {
            open: true,
            share,
            ..FoldState::default()
        },
        ..small()
    }
}

fn fold(ui: &Ui) -> FoldState {
    ui.state().explorer().state().fold
}

fn has_light(ui: &Ui, mapping: MappingId) -> bool {
    ui.state()
        .explorer()
        .labs()
        .fold
        .light_of(mapping)
        .is_some()
}

#[test]
fn the_light_is_made_for_the_selected_mapping_and_while_it_is_seen() {
    let mut ui = open(small());
    assert!(!has_light(&ui, MappingId::Ccm), "control: the pane is shut");
    let mut ui_open = open(folded(MappingId::Ccm, 0.3));
    assert!(has_light(&ui_open, MappingId::Ccm));
    ui_open.get_by_label("Continuous cube map: flat, cube, sphere");
    run(&mut ui_open, Action::SetMapping(MappingId::Octahedral));
    assert!(has_light(&ui_open, MappingId::Octahedral));
    ui_open.get_by_label("Octahedral: flat, octahedron, sphere");
    assert!(rests(&mut ui_open));
    // The menu opens it.
    ui.get_by_label("View").click();
    settle(&mut ui);
    ui.get_by_label("Fold and unfold").click();
    settle(&mut ui);
    assert!(fold(&ui).open);
    run(&mut ui, Action::SetMaximised(Some(Pane::Fold)));
    settle(&mut ui);
    assert!(has_light(&ui, MappingId::Ccm));
}

#[test]
fn the_button_folds_it_until_it_is_the_sphere_and_then_it_rests() {
    let mut ui = open(folded(MappingId::Eac, 0.0));
    ui.get_by_label("Fold").click();
    ui.step();
    ui.step();
    assert!(ui.ctx.has_requested_repaint());
    let mut last = 0.0;
    for _ in 0..10_000 {
        ui.step();
        let now = fold(&ui);
        assert!(now.share >= last);
        last = now.share;
        if now.towards.is_none() {
            break;
        }
    }
    assert_eq!(fold(&ui).share, 1.0);
    assert!(rests(&mut ui));
    // Back, and stopped on the way.
    ui.get_by_label("Unfold").click();
    ui.run_steps(3);
    ui.get_by_label("Stop").click();
    ui.run_steps(3);
    let stopped = fold(&ui);
    assert!(stopped.towards.is_none() && stopped.share < 1.0 && stopped.share > 0.0);
    assert!(rests(&mut ui));
    // One undo takes the motion back, and nothing moves anew.
    run(&mut ui, Command::Undo);
    assert!(fold(&ui).towards.is_none());
    assert!(rests(&mut ui));
}

#[test]
fn a_click_moves_the_probe_there_and_a_drag_turns_it() {
    let mut ui = open(folded(MappingId::Ccm, 1.0));
    let rect = ui.get_by_label("Folded map").rect();
    let state = fold(&ui);
    let surface = Surface::new(
        MappingId::Ccm,
        1.0,
        state.camera,
        rect.width() / rect.height(),
    );
    let point = ChartPoint::new(4, 0.4, 0.55);
    let dir = MappingId::Ccm.inverse::<f64>(point).unwrap().to_f64();
    let (at, _) = surface.seen(point).unwrap();
    let pos = rect.min + egui::vec2(at[0], at[1]) * rect.size();
    assert!(
        angle_rad(probe(&ui).to_f64(), dir) > 0.2,
        "control: it is there already"
    );
    ui.hover_at(pos);
    ui.step();
    ui.drag_at(pos);
    ui.step();
    ui.drop_at(pos);
    settle(&mut ui);
    let off = angle_rad(probe(&ui).to_f64(), dir);
    assert!(off < 0.01, "{off}");
    assert!(!ui.state().explorer().state().probe_follows);
    let before = fold(&ui).camera;
    ui.drag_at(pos);
    ui.step();
    ui.hover_at(pos + egui::vec2(60.0, 20.0));
    ui.step();
    ui.drop_at(pos + egui::vec2(60.0, 20.0));
    settle(&mut ui);
    assert_ne!(fold(&ui).camera, before);
}

#[test]
fn nothing_fails_at_any_size_with_any_mapping_or_number() {
    let mut state = folded(MappingId::Cube, 0.5);
    let wild = FoldState {
        share: f32::NAN,
        towards: Some(f32::NAN),
        ..state.fold
    };
    apply(&mut state, Action::SetFold(wild));
    assert_eq!(state.clone().sanitized(), state);
    state.fold.towards = None;
    let mut ui = open_sized(state, 640.0, 480.0);
    for (width, height) in WINDOW_SIZES {
        ui.set_size(egui::vec2(width, height));
        settle(&mut ui);
    }
    for &mapping in MappingId::ALL {
        run(&mut ui, Action::SetMapping(mapping));
        assert!(has_light(&ui, mapping), "{mapping}");
    }
}

#[test]
fn slider_and_picture_lie_within_the_tile() {
    let mut ui = open(tiled(Pane::Fold));
    for (width, height) in TILED_SIZES {
        ui.set_size(egui::vec2(width, height));
        for mapping in long_names() {
            run(&mut ui, Action::SetMapping(mapping));
            assert_within(&ui, Pane::Fold, &[Role::Slider, Role::Image], |_| false);
            let (tile, picture) = (tile(&ui, Pane::Fold), ui.get_by_label("Folded map").rect());
            assert!(tile.contains_rect(picture), "{mapping}: {picture:?}");
            // All of the tile's width, and its middle; the margin is 6 wide.
            assert!(
                picture.width() > tile.width() - 16.0 && picture.height() > 200.0,
                "{mapping}: {picture:?} in {tile:?}"
            );
        }
    }
}
