//! The cut through the horizon and the paper's figures, in the window.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod window_kit;

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use sixfold::app::action::Action;
use sixfold::app::arrangement::Pane;
use sixfold::app::command::Command;
use sixfold::app::dialogs::{Dialog, PictureDialog};
use sixfold::app::figures::{Figure, Paper};
use sixfold::app::picture::What;
use sixfold::app::state::{AppState, SamplingState};
use sixfold::imaging::Environment;
use sixfold::mapping::MappingId;
use window_kit::{
    TILED_SIZES, Ui, assert_within, long_names, open, panel_rect, rests, run, settle, small, tile,
    tiled,
};

const SHEET: &str = "Cut through the horizon, seen from above";

fn state(ui: &Ui) -> &AppState {
    ui.state().explorer().state()
}

fn sampled(mapping: MappingId) -> AppState {
    AppState {
        mapping,
        maximised: Some(Pane::Sampling),
        sampling: SamplingState {
            open: true,
            ..SamplingState::default()
        },
        ..small()
    }
}

#[test]
fn the_menu_opens_the_pane_and_a_list_chooses_what_it_compares() {
    let mut ui = open(small());
    assert!(ui.query_by_label(SHEET).is_none(), "control: it is shut");
    ui.get_by_label("View").click();
    settle(&mut ui);
    ui.get_by_label("Sampling of the horizon").click();
    settle(&mut ui);
    assert!(state(&ui).sampling.open);
    let mut ui = open(sampled(MappingId::Latlong));
    ui.get_by_label(SHEET);
    ui.get_by_role_and_label(Role::ComboBox, "beside").click();
    settle(&mut ui);
    ui.get_by_role_and_label(Role::Button, "Continuous cube map")
        .click();
    settle(&mut ui);
    assert_eq!(state(&ui).sampling.other, MappingId::Ccm);
    assert!(rests(&mut ui));
}

#[test]
fn it_fits_into_large_and_small_windows_alone_and_as_a_tile() {
    let maps = long_names();
    let mut scene = tiled(Pane::Sampling);
    scene.sampling.other = maps[0];
    let mut ui = open(scene);
    for (width, height) in TILED_SIZES {
        ui.set_size(egui::vec2(width, height));
        for &mapping in &maps {
            run(&mut ui, Action::SetMapping(mapping));
            for other in [maps[0], maps[1]] {
                let sampling = SamplingState {
                    other,
                    ..state(&ui).sampling
                };
                run(&mut ui, Action::SetSampling(sampling));
                run(&mut ui, Action::SetMaximised(None));
                let kinds = [Role::Slider, Role::ComboBox, Role::SpinButton, Role::Image];
                assert_within(&ui, Pane::Sampling, &kinds, |_| false);
                let tile = tile(&ui, Pane::Sampling);
                let sheet = ui.get_by_label(SHEET).rect();
                assert!(tile.contains_rect(sheet), "{mapping}: {sheet:?}");
                assert!(sheet.height() > 200.0, "{sheet:?}");
                run(&mut ui, Action::SetMaximised(Some(Pane::Sampling)));
                for role in kinds {
                    let all: Vec<_> = ui.query_all_by_role(role).collect();
                    assert!(!all.is_empty(), "{role:?}");
                    let right = all.iter().map(|node| node.rect().right());
                    assert!(right.fold(0.0, f32::max) <= width, "{role:?} in {width}");
                }
                let sheet = ui.get_by_label(SHEET).rect();
                assert!(sheet.width() > 200.0 && sheet.height() > 200.0, "{sheet:?}");
                assert!(sheet.right() <= width && sheet.bottom() <= height);
            }
        }
    }
}

#[test]
fn every_figure_is_shown_with_its_surroundings_and_can_be_taken_back() {
    let mut ui = open(small());
    let before = state(&ui).clone();
    for figure in Figure::all() {
        run(&mut ui, Command::ShowFigure(figure));
        settle(&mut ui);
        let shown = state(&ui);
        let name = figure.id();
        match figure.what() {
            What::Fold => assert_eq!(shown.maximised, Some(Pane::Fold), "{name}"),
            What::Sampling => assert_eq!(shown.maximised, Some(Pane::Sampling), "{name}"),
            What::Panel(mapping) => {
                assert_eq!(shown.maximised, Some(Pane::Map(mapping)), "{name}");
                assert_eq!(shown.mapping, mapping, "{name}");
                assert_eq!(shown.environment, Environment::IcosahedronCrosses, "{name}");
            }
            What::Panels => {
                let open: Vec<MappingId> = shown.open_panels().collect();
                assert_eq!(open, [MappingId::Cube, MappingId::Ccm], "{name}");
            }
            _ => assert_eq!(shown.maximised, None, "{name}"),
        }
        run(&mut ui, Command::Undo);
        settle(&mut ui);
        assert_eq!(state(&ui).environment, before.environment, "{name}");
        assert_eq!(state(&ui).maximised, before.maximised, "{name}");
        assert_eq!(state(&ui).mapping, before.mapping, "{name}");
    }
}

#[test]
fn the_panes_lie_again_as_before_a_figure_that_moves_them() {
    let mut ui = open(small());
    let latlong = |ui: &Ui| panel_rect(ui, MappingId::Latlong);
    let before = latlong(&ui);
    run(&mut ui, Command::ShowFigure(Figure::Paper(Paper::Cross)));
    settle(&mut ui);
    assert!(ui.query_by_label("Panel: Latlong").is_none(), "control");
    run(&mut ui, Command::Undo);
    settle(&mut ui);
    assert!((latlong(&ui).min - before.min).length() < 1.0);
    assert!((latlong(&ui).size() - before.size()).length() < 1.0);
}

#[test]
fn a_pane_that_is_opened_is_seen_though_another_one_was_alone() {
    let mut ui = open(small());
    run(&mut ui, Action::SetPaneOpen(Pane::Story, true));
    run(&mut ui, Action::SetMaximised(Some(Pane::Story)));
    run(&mut ui, Action::SetPaneOpen(Pane::Sampling, true));
    settle(&mut ui);
    ui.get_by_label(SHEET);
    run(&mut ui, Action::SetPaneOpen(Pane::Sampling, false));
    settle(&mut ui);
    assert_eq!(state(&ui).maximised, None, "what was alone is shut");
}

#[test]
fn a_list_lies_over_its_dialog_however_often_that_is_shown() {
    let mut ui = open(small());
    for what in [What::Viewport, What::Fold, What::Panels] {
        let dialog = Dialog::Picture(PictureDialog::default());
        run(&mut ui, Command::ShowDialog(dialog));
        settle(&mut ui);
        let order = |ui: &Ui, at: egui::Rect| ui.ctx.layer_id_at(at.center()).unwrap().order;
        let dialog = order(&ui, ui.get_by_label("with overlays").rect());
        ui.get_by_role_and_label(Role::ComboBox, "picture of")
            .click();
        settle(&mut ui);
        let entry = what.name();
        // Within one order what was pressed last would be on top.
        let list = ui.get_by_role_and_label(Role::Button, &entry).rect();
        assert!(order(&ui, list) > dialog, "{entry}");
        ui.get_by_role_and_label(Role::Button, &entry).click();
        settle(&mut ui);
        let list = ui.get_by_role_and_label(Role::ComboBox, "picture of");
        assert_eq!(list.value(), Some(entry));
        ui.get_by_label("Cancel").click();
        settle(&mut ui);
    }
}
