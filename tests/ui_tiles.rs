//! Every pane that is read, as a tile beside the others: nothing of it is cut at its right.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod window_kit;

use egui::accesskit::Role;
use sixfold::app::action::Action;
use sixfold::app::arrangement::Pane;
use sixfold::app::state::AppState;
use window_kit::{TILED_SIZES, assert_within, long_names, open, run, tiled};

/// Shows a pane's tile with the longest names in windows of both sizes.
fn each_tile(scene: AppState, pane: Pane, kinds: &[Role]) {
    let mut ui = open(scene);
    for (width, height) in TILED_SIZES {
        ui.set_size(egui::vec2(width, height));
        for mapping in long_names() {
            run(&mut ui, Action::SetMapping(mapping));
            assert_within(&ui, pane, kinds, |_| false);
        }
    }
    assert_eq!(ui.state().explorer().messages(), []);
}

#[test]
fn the_budgets_lists_slider_pictures_and_numbers() {
    let mut scene = tiled(Pane::Budget);
    let maps = long_names();
    scene.budget.maps = [Some(maps[0]), Some(maps[1])];
    scene.budget.shows_surroundings = true;
    let kinds = [
        Role::ComboBox,
        Role::Slider,
        Role::SpinButton,
        Role::Image,
        Role::Label,
    ];
    each_tile(scene.clone(), Pane::Budget, &kinds);
    // The longest number.
    scene.budget.texels = u32::MAX;
    each_tile(scene.sanitized(), Pane::Budget, &kinds);
}

#[test]
fn the_loss_laboratorys_lists_and_picture() {
    let mut scene = tiled(Pane::Loss);
    let maps = long_names();
    (scene.loss.from, scene.loss.via) = (maps[0], maps[1]);
    let kinds = [Role::ComboBox, Role::SpinButton, Role::Image, Role::Label];
    each_tile(scene, Pane::Loss, &kinds);
}

#[test]
fn the_laboratorys_lists_and_budget() {
    let mut scene = tiled(Pane::Laboratory);
    scene.laboratory.budget_on = true;
    let kinds = [Role::ComboBox, Role::Slider, Role::SpinButton, Role::Label];
    each_tile(scene, Pane::Laboratory, &kinds);
}

#[test]
fn the_microscopes_lists_and_picture() {
    let kinds = [
        Role::ComboBox,
        Role::Slider,
        Role::SpinButton,
        Role::Image,
        Role::Label,
    ];
    each_tile(tiled(Pane::Stability), Pane::Stability, &kinds);
}

#[test]
fn the_curves_numbers() {
    each_tile(
        tiled(Pane::Curves),
        Pane::Curves,
        &[Role::CheckBox, Role::Label],
    );
}

#[test]
fn the_storys_steps() {
    each_tile(
        tiled(Pane::Story),
        Pane::Story,
        &[Role::Slider, Role::Label],
    );
}
