//! The controls and the inspector: one at each side of the panels, or one in front of the other where the window is narrow.

use egui::{CentralPanel, Panel, Ui};

use super::action::Action;
use super::arrangement::Pane;
use super::controls::controls_ui;
use super::inspector::inspector_ui;
use super::model::Model;
use super::panes::panes_ui;

/// Points that each opens with, its margins left out.
const CONTROLS_WIDTH: f32 = 220.0;
const INSPECTOR_WIDTH: f32 = 372.0;

/// Points that the panels between them need: three maps beside each other whose marks can be told apart.
const CENTRE_WIDTH: f32 = 380.0;

/// What is shown of the two in a window of a given width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Sides {
    controls: bool,
    inspector: bool,
    /// Both are open and there is room for one.
    one_in_front: bool,
}

impl Sides {
    fn of(controls: bool, inspector: bool, in_front: bool, width: f32) -> Self {
        let is_narrow = width < CONTROLS_WIDTH + INSPECTOR_WIDTH + CENTRE_WIDTH;
        let one_in_front = controls && inspector && is_narrow;
        Self {
            controls: controls && !(one_in_front && in_front),
            inspector: inspector && (!one_in_front || in_front),
            one_in_front,
        }
    }
}

/// The sides and what lies between them.
pub fn sides_ui(ui: &mut Ui, model: &mut Model<'_>, tree: &mut egui_tiles::Tree<Pane>) {
    let state = model.state;
    let sides = Sides::of(
        state.controls_open,
        state.inspector.open,
        state.inspector.in_front,
        ui.available_width(),
    );
    if sides.controls {
        Panel::left("controls")
            .default_size(CONTROLS_WIDTH)
            .size_range(160.0..=320.0)
            .show(ui, |ui| {
                front_ui(ui, model, sides);
                controls_ui(ui, model);
            });
    }
    if sides.inspector {
        // In front of the controls it lies where they do, so that the names of both stay in their place.
        let panel = if sides.one_in_front {
            Panel::left("inspector in front")
        } else {
            Panel::right("inspector")
        };
        panel
            .default_size(INSPECTOR_WIDTH)
            .size_range(260.0..=640.0)
            .show(ui, |ui| {
                front_ui(ui, model, sides);
                inspector_ui(ui, model);
            });
    }
    CentralPanel::no_frame().show(ui, |ui| panes_ui(ui, model, tree));
}

/// The names of both, of which one is in front.
fn front_ui(ui: &mut Ui, model: &mut Model<'_>, sides: Sides) {
    if !sides.one_in_front {
        return;
    }
    let mut inspector = model.state.inspector;
    ui.horizontal(|ui| {
        ui.selectable_value(&mut inspector.in_front, false, "Controls");
        ui.selectable_value(&mut inspector.in_front, true, "Inspector");
    });
    ui.separator();
    if inspector != model.state.inspector {
        model.push(Action::SetInspector(inspector));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_narrow_window_shows_one_of_both_and_a_wide_one_what_is_open() {
        let shown = |controls, inspector, in_front, width| {
            let sides = Sides::of(controls, inspector, in_front, width);
            (sides.controls, sides.inspector, sides.one_in_front)
        };
        for in_front in [false, true] {
            assert_eq!(shown(true, true, in_front, 1280.0), (true, true, false));
            assert_eq!(
                shown(true, true, in_front, 800.0),
                (!in_front, in_front, true)
            );
            // One alone is not hidden by the other.
            assert_eq!(shown(true, false, in_front, 800.0), (true, false, false));
            assert_eq!(shown(false, true, in_front, 800.0), (false, true, false));
            assert_eq!(shown(false, false, in_front, 800.0), (false, false, false));
        }
    }
}
