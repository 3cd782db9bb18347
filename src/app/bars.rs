//! The menu bar at the top and the status bar at the bottom.

use egui::{ProgressBar, RichText, Ui};

use super::action::Action;
use super::arrangement::Pane;
use super::command::Command;
use super::dialogs::{Dialog, PictureDialog, SaveDialog};
use super::figures::Figure;
use super::laboratory::used_text;
use super::model::{JobLine, Model};
use crate::imaging::Environment;

/// The menus. Dialogs are opened by setting `dialog`.
pub fn menu_ui(ui: &mut Ui, model: &mut Model<'_>, dialog: &mut Option<Dialog>) {
    egui::MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| {
            if ui.button("Open …   Ctrl+O").clicked() {
                *dialog = Some(Dialog::Open(String::new()));
                ui.close();
            }
            if let Environment::File(file) = &model.state.environment
                && ui.button("How the environment is read …").clicked()
            {
                *dialog = Some(Dialog::Reading(file.clone()));
                ui.close();
            }
            if ui.button("Save the scene …   Ctrl+S").clicked() {
                *dialog = Some(Dialog::SaveScene(SaveDialog::default()));
                ui.close();
            }
            if ui.button("Save a picture …   Ctrl+E").clicked() {
                *dialog = Some(Dialog::Picture(PictureDialog::default()));
                ui.close();
            }
            if ui
                .button("Export the environment …   Ctrl+Shift+E")
                .clicked()
            {
                model.push(Command::ShowExport);
                ui.close();
            }
            ui.separator();
            if ui.button("Quit   Ctrl+Q").clicked() {
                model.push(Command::Quit);
                ui.close();
            }
        });
        ui.menu_button("Edit", |ui| {
            let undo = egui::Button::new("Undo   Ctrl+Z");
            if ui.add_enabled(model.history.can_undo(), undo).clicked() {
                model.push(Command::Undo);
                ui.close();
            }
            let redo = egui::Button::new("Redo   Ctrl+Shift+Z");
            if ui.add_enabled(model.history.can_redo(), redo).clicked() {
                model.push(Command::Redo);
                ui.close();
            }
        });
        ui.menu_button("View", |ui| {
            let mut controls = model.state.controls_open;
            let mut inspector = model.state.inspector;
            if ui.checkbox(&mut controls, "Controls").changed() {
                model.push(Action::SetControlsOpen(controls));
                inspector.in_front &= !controls;
            }
            if ui.checkbox(&mut inspector.open, "Inspector").changed() {
                inspector.in_front = inspector.open;
            }
            if inspector != model.state.inspector {
                model.push(Action::SetInspector(inspector));
            }
            for pane in Pane::READ {
                let mut open = model.state.is_open(pane);
                if ui.checkbox(&mut open, pane.name()).changed() {
                    model.push(Action::SetPaneOpen(pane, open));
                }
            }
            if ui.button("Reset the view   R").clicked() {
                model.push(Action::ResetCamera);
                ui.close();
            }
            if ui.button("Arrange the panels as at first").clicked() {
                model.push(Command::ResetArrangement);
                ui.close();
            }
        });
        ui.menu_button("Figures", |ui| {
            for figure in Figure::all() {
                if ui.button(figure.title()).clicked() {
                    model.push(Command::ShowFigure(figure));
                    ui.close();
                }
            }
        });
        ui.menu_button("Help", |ui| {
            ui.set_min_width(330.0);
            for (keys, what) in HELP {
                ui.horizontal(|ui| {
                    ui.label(RichText::new(*keys).strong());
                    ui.label(*what);
                });
            }
        });
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.label(
                RichText::new(model.adapter)
                    .small()
                    .color(egui::Color32::from_gray(150)),
            );
        });
    });
}

/// What pointer and keys do.
const HELP: &[(&str, &str)] = &[
    ("move", "over any view: the probe follows"),
    (
        "click",
        "in any view: the probe stays there; Esc lets it follow again",
    ),
    ("drag", "in the viewport: turn; in a panel: move the probe"),
    (
        "right drag",
        "in the viewport: move the probe; in a panel: pan",
    ),
    ("wheel", "zoom; a double click in a panel shows it whole"),
    ("arrows", "move the probe by texels (Shift: by ten)"),
    ("W A S D", "turn the camera"),
    ("+ −", "move the camera nearer or farther"),
    (
        ", .",
        "step through the ray story (also Page Up, Page Down)",
    ),
    ("R", "reset the view"),
];

/// "42 %, 3 s left".
fn progress_text(job: &JobLine) -> String {
    let percent = format!("{:.0} %", 100.0 * job.fraction);
    match job.left.map(|left| left.as_secs_f32().ceil()) {
        Some(seconds) if seconds > 90.0 => {
            format!("{percent}, {:.0} min left", (seconds / 60.0).ceil())
        }
        Some(seconds) => format!("{percent}, {seconds:.0} s left"),
        None => percent,
    }
}

/// Jobs, the frame plan and the counters.
pub fn status_ui(ui: &mut Ui, model: &mut Model<'_>) {
    super::dialogs::messages_ui(ui, model);
    ui.horizontal(|ui| {
        for job in model.jobs {
            ui.label(RichText::new(&job.title).small());
            ui.add(
                ProgressBar::new(job.fraction)
                    .desired_width(130.0)
                    .text(RichText::new(progress_text(job)).small()),
            );
            if ui.small_button("Cancel").clicked() {
                model.commands.push(Command::Cancel(job.id));
            }
            ui.separator();
        }
        if let Some(used) = model.used.filter(|_| model.state.laboratory.budget_on) {
            let text = used_text(model.state.mapping, &used);
            ui.label(RichText::new(text).small());
            ui.separator();
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let small = |text: String| RichText::new(text).small();
            let grey = egui::Color32::from_gray(165);
            ui.label(small(format!("frame {}", model.frames)).color(grey));
            ui.separator();
            // Beside a job's progress there is little room, and its button must be in reach.
            if model.jobs.is_empty() {
                let hint = if model.state.probe_follows {
                    "the probe follows the pointer; click keeps it"
                } else {
                    "the probe is kept; Esc lets it follow"
                };
                ui.label(small(hint.to_owned()).color(grey));
                ui.separator();
            }
            ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                ui.add(egui::Label::new(small(model.plan.to_owned())).truncate());
            });
        });
    });
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn a_job_says_how_long_it_will_take() {
        let line = |fraction, left| {
            progress_text(&JobLine {
                id: 1,
                title: String::new(),
                fraction,
                left,
            })
        };
        assert_eq!(line(0.0, None), "0 %");
        assert_eq!(
            line(0.42, Some(Duration::from_millis(2100))),
            "42 %, 3 s left"
        );
        assert_eq!(line(0.5, Some(Duration::from_secs(91))), "50 %, 2 min left");
    }
}
