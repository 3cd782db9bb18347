//! What the keys do.

use egui::{Context, Key, Modifiers};

use super::action::Action;
use super::command::Command;
use super::dialogs::{Dialog, PictureDialog, SaveDialog};
use super::state::AppState;
use super::story;
use crate::scene::Target;

/// Radians that one press turns the camera: five degrees.
const TURN_RAD: f32 = 5.0 * std::f32::consts::PI / 180.0;
/// Factor of one press on the eye's distance.
const STEP: f32 = 1.1;
/// Texels that Shift with an arrow moves the probe.
const STRIDE: i32 = 10;

/// The commands of the keys that were pressed. While text is typed or a dialog is open, the keys belong there.
pub fn commands(
    ctx: &Context,
    state: &AppState,
    target: &Target,
    dialog: &mut Option<Dialog>,
) -> Vec<Command> {
    let mut commands = Vec::new();
    if ctx.egui_wants_keyboard_input() || dialog.is_some() {
        return commands;
    }
    shortcuts(ctx, &mut commands, dialog);
    let pressed = |key| ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key));
    let with_shift = |key| ctx.input_mut(|i| i.consume_key(Modifiers::SHIFT, key));
    for (key, columns, rows) in [
        (Key::ArrowLeft, -1, 0),
        (Key::ArrowRight, 1, 0),
        (Key::ArrowUp, 0, -1),
        (Key::ArrowDown, 0, 1),
    ] {
        let stride = if with_shift(key) {
            STRIDE
        } else if pressed(key) {
            1
        } else {
            continue;
        };
        if state.probe_follows {
            commands.push(Action::FollowPointer(false).into());
        }
        commands.push(
            Action::StepProbe {
                columns: stride * columns,
                rows: stride * rows,
            }
            .into(),
        );
    }
    for (key, dx_rad, dy_rad) in [
        (Key::A, -TURN_RAD, 0.0),
        (Key::D, TURN_RAD, 0.0),
        (Key::W, 0.0, -TURN_RAD),
        (Key::S, 0.0, TURN_RAD),
    ] {
        if pressed(key) {
            commands.push(Action::Orbit { dx_rad, dy_rad }.into());
        }
    }
    if pressed(Key::Plus) || pressed(Key::Equals) {
        commands.push(Action::Zoom(STEP).into());
    }
    if pressed(Key::Minus) {
        commands.push(Action::Zoom(1.0 / STEP).into());
    }
    for (keys, forward) in [
        ([Key::Comma, Key::PageUp], false),
        ([Key::Period, Key::PageDown], true),
    ] {
        if state.story.open && keys.into_iter().any(pressed) {
            let steps = story::steps_if_open(state, target);
            commands.extend(story::walked(state.story, &steps, forward).map(Command::from));
        }
    }
    if pressed(Key::R) {
        commands.push(Action::ResetCamera.into());
    }
    // A menu that is open takes it.
    if !egui::Popup::is_any_open(ctx) && pressed(Key::Escape) {
        if state.maximised.is_some() {
            commands.push(Action::SetMaximised(None).into());
        }
        commands.push(Action::FollowPointer(true).into());
    }
    commands
}

fn shortcuts(ctx: &Context, commands: &mut Vec<Command>, dialog: &mut Option<Dialog>) {
    let control = |modifiers: Modifiers, key| {
        ctx.input_mut(|i| i.consume_key(Modifiers::COMMAND | modifiers, key))
    };
    // The longer combination first: it would also count as the shorter one.
    if control(Modifiers::SHIFT, Key::Z) || control(Modifiers::NONE, Key::Y) {
        commands.push(Command::Redo);
    }
    if control(Modifiers::NONE, Key::Z) {
        commands.push(Command::Undo);
    }
    if control(Modifiers::NONE, Key::O) {
        *dialog = Some(Dialog::Open(String::new()));
    }
    if control(Modifiers::NONE, Key::S) {
        *dialog = Some(Dialog::SaveScene(SaveDialog::default()));
    }
    if control(Modifiers::SHIFT, Key::E) {
        commands.push(Command::ShowExport);
    }
    if control(Modifiers::NONE, Key::E) {
        *dialog = Some(Dialog::Picture(PictureDialog::default()));
    }
    if control(Modifiers::NONE, Key::Q) {
        commands.push(Command::Quit);
    }
}
