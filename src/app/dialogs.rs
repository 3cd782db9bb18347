//! The small windows over the panels: opening, saving, pictures and messages.

use std::path::PathBuf;

use egui::{ComboBox, DragValue, Key, Modal, TextEdit, Ui};

use super::action::Action;
use super::command::Command;
use super::export::Export;
use super::export_dialog::export_ui;
use super::lists;
use super::model::Model;
use super::picture::{Destination, MAX_SIDE, PictureRequest, What};
use super::reading_dialog::{reading_ui, reading_width};
use crate::imaging::MapFile;
use crate::mapping::MappingId;
use crate::optics::Material;
use crate::optics::material::{BallPicture, Surface, View};

/// Which dialog is open, and what was typed into it. It belongs to the window, not to the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Dialog {
    /// A path to open.
    Open(String),
    /// A picture of a ball to open.
    OpenBall(String),
    /// Where to save the scene.
    SaveScene(SaveDialog),
    /// What picture, how large, where to.
    Picture(PictureDialog),
    /// The environment for another program.
    Export(Box<Export>),
    /// Where to write what the laboratory has measured.
    SaveBench(SaveDialog),
    /// How the map in a file is read.
    Reading(MapFile),
}

/// The fields of the dialog that saves the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SaveDialog {
    /// The file.
    pub path: String,
    /// Replace the file if it is there.
    pub force: bool,
}

impl Default for SaveDialog {
    fn default() -> Self {
        Self {
            path: "scene.sixfold.json".to_owned(),
            force: false,
        }
    }
}

impl Dialog {
    /// The path that is typed, where one is.
    pub fn path_mut(&mut self) -> Option<&mut String> {
        Some(match self {
            Self::Open(path) | Self::OpenBall(path) => path,
            Self::SaveScene(fields) | Self::SaveBench(fields) => &mut fields.path,
            Self::Picture(fields) => &mut fields.path,
            Self::Export(export) => &mut export.path,
            Self::Reading(_) => return None,
        })
    }

    /// The same dialog with the path that was chosen in the system's dialog, which has asked about replacing already.
    pub fn with_chosen(mut self, path: &std::path::Path) -> Self {
        if let Some(typed) = self.path_mut() {
            *typed = path.display().to_string();
        }
        match &mut self {
            Self::Open(_) | Self::OpenBall(_) | Self::Reading(_) => {}
            Self::SaveScene(fields) | Self::SaveBench(fields) => fields.force = true,
            Self::Picture(fields) => fields.force = true,
            Self::Export(export) => export.force = true,
        }
        self
    }
}

/// The fields of the picture dialog.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureDialog {
    /// What is drawn.
    pub what: What,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// With the overlays that are switched on.
    pub overlays: bool,
    /// The file.
    pub path: String,
    /// Replace the file if it is there.
    pub force: bool,
}

impl Default for PictureDialog {
    fn default() -> Self {
        Self {
            what: What::Window,
            size: [1920, 1200],
            overlays: true,
            path: "sixfold.png".to_owned(),
            force: false,
        }
    }
}

/// Shows the open dialog; it closes itself.
pub fn dialog_ui(ctx: &egui::Context, model: &mut Model<'_>, dialog: &mut Option<Dialog>) {
    let Some(open) = dialog else { return };
    let mut close = false;
    // Below the order of lists and menus, which open over the dialog however often it is shown.
    let id = egui::Id::unique("dialog");
    let area = Modal::default_area(id).order(egui::Order::Middle);
    let response = Modal::new(id).area(area).show(ctx, |ui| {
        ui.set_width(match open {
            Dialog::Reading(_) => reading_width(ui),
            _ => 430.0,
        });
        close = match open {
            Dialog::Open(path) => open_ui(ui, model, path),
            Dialog::OpenBall(path) => open_ball_ui(ui, model, path),
            Dialog::SaveScene(fields) => save_ui(ui, model, fields),
            Dialog::SaveBench(fields) => save_bench_ui(ui, model, fields),
            Dialog::Picture(fields) => picture_ui(ui, model, fields),
            Dialog::Export(export) => export_ui(ui, model, export),
            Dialog::Reading(file) => reading_ui(ui, model, file),
        };
    });
    if close || response.should_close() {
        *dialog = None;
    }
}

/// A line for a path and a button for the system's own dialog; true when Enter ends the path. A line that is still empty
/// takes what is typed without a click.
pub(super) fn path_ui(ui: &mut Ui, model: &mut Model<'_>, path: &mut String) -> bool {
    let mut is_entered = false;
    ui.horizontal(|ui| {
        let name = ui.label("file");
        let width = ui.available_width() - 84.0;
        let line = ui
            .add(TextEdit::singleline(path).desired_width(width))
            .labelled_by(name.id);
        is_entered = line.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if path.is_empty() && ui.memory(|memory| memory.focused().is_none()) {
            line.request_focus();
        }
        if ui.button("Browse …").clicked() {
            model.push(Command::Browse);
        }
    });
    is_entered
}

fn open_ui(ui: &mut Ui, model: &mut Model<'_>, path: &mut String) -> bool {
    ui.heading("Open");
    ui.label("An environment (HDR, EXR, PNG, JPEG, KTX2 or DDS: a latlong, a cube in any layout, or one of six files named px, nx and so on), a model (OBJ, glTF or GLB), a scene, or a picture that Sixfold saved. Dropping the file onto the window does the same.");
    let is_entered = path_ui(ui, model, path);
    buttons_ui(ui, "Open", !path.trim().is_empty(), is_entered, || {
        model.push(Command::Open(PathBuf::from(path.trim())));
    })
}

fn open_ball_ui(ui: &mut Ui, model: &mut Model<'_>, path: &mut String) -> bool {
    ui.heading("Open a picture of a ball");
    ui.label("A square picture (PNG, JPEG, HDR or EXR) that the ball fills: a matcap. Each point of the object takes the colour of the ball where it faces the same way.");
    let is_entered = path_ui(ui, model, path);
    buttons_ui(ui, "Open", !path.trim().is_empty(), is_entered, || {
        let action = ball_from(&model.state.material, PathBuf::from(path.trim()));
        model.push(action);
    })
}

/// The material with another picture of a ball.
pub fn ball_from(material: &Material, path: PathBuf) -> Action {
    Action::SetMaterial(Box::new(Material {
        surface: Surface::Ball,
        view: View::Whole,
        ball: BallPicture::File(path),
        ..material.clone()
    }))
}

fn save_ui(ui: &mut Ui, model: &mut Model<'_>, fields: &mut SaveDialog) -> bool {
    ui.heading("Save the scene");
    ui.label("Everything that the window shows, as a small text file; an environment's file is named, not copied.");
    let is_entered = path_ui(ui, model, &mut fields.path);
    ui.checkbox(&mut fields.force, "replace the file if it exists");
    let path = fields.path.trim();
    buttons_ui(ui, "Save", !path.is_empty(), is_entered, || {
        model.push(Command::SaveScene {
            path: PathBuf::from(path),
            force: fields.force,
        });
    })
}

fn save_bench_ui(ui: &mut Ui, model: &mut Model<'_>, fields: &mut SaveDialog) -> bool {
    ui.heading("Save the measurements");
    ui.label("A folder for bench.json, bench.csv, bench.svg, bench.png and bench_machine.json, as \"sixfold bench --out\" writes them; it is made if it is not there.");
    let is_entered = path_ui(ui, model, &mut fields.path);
    ui.checkbox(&mut fields.force, "replace files that exist");
    let path = fields.path.trim();
    buttons_ui(ui, "Save", !path.is_empty(), is_entered, || {
        model.push(Command::SaveBench {
            folder: PathBuf::from(path),
            force: fields.force,
        });
    })
}

/// The last row: the deed, which Enter asks for too, and a way out; true when the dialog is done with.
pub(super) fn buttons_ui(
    ui: &mut Ui,
    deed: &str,
    ready: bool,
    is_entered: bool,
    act: impl FnOnce(),
) -> bool {
    ui.add_space(6.0);
    let mut done = false;
    ui.horizontal(|ui| {
        let button = ui.add_enabled(ready, egui::Button::new(deed));
        if button.clicked() || (ready && is_entered) {
            act();
            done = true;
        }
        done |= ui.button("Cancel").clicked();
    });
    done
}

fn picture_ui(ui: &mut Ui, model: &mut Model<'_>, fields: &mut PictureDialog) -> bool {
    ui.heading("Save a picture");
    ui.label(
        "Drawn anew at the size you choose. A PNG holds the scene, so Sixfold can open it again. Panels, the folded map and the sampling of the horizon can also be written as lines alone, without light, heat maps and tints: let the name end in .svg.",
    );
    ui.horizontal(|ui| {
        let label = ui.label("picture of");
        ComboBox::from_id_salt("picture of")
            .selected_text(fields.what.name())
            .height(lists::HEIGHT)
            .show_ui(ui, |ui| {
                let maps = MappingId::ALL.iter().map(|m| What::Panel(*m));
                let first = [
                    What::Window,
                    What::Viewport,
                    What::Microscope,
                    What::Fold,
                    What::Budget,
                    What::Ranking,
                    What::Sampling,
                    What::Panels,
                ];
                let all = first.into_iter().chain(maps);
                lists::entries_ui(
                    ui,
                    &mut fields.what,
                    all,
                    |what| what.name(),
                    |what| match what {
                        What::Panel(map) => Some(map.info().family),
                        _ => None,
                    },
                );
            })
            .response
            .labelled_by(label.id);
        ui.checkbox(&mut fields.overlays, "with overlays");
    });
    ui.horizontal(|ui| {
        ui.label("size");
        ui.add(DragValue::new(&mut fields.size[0]).range(1..=MAX_SIDE));
        ui.label("×");
        ui.add(DragValue::new(&mut fields.size[1]).range(1..=MAX_SIDE));
        ui.label(format!("pixels, at most {MAX_SIDE} a side"));
    });
    let is_entered = path_ui(ui, model, &mut fields.path);
    ui.checkbox(&mut fields.force, "replace the file if it exists");
    ui.add_space(6.0);
    let mut done = false;
    ui.horizontal(|ui| {
        let request = |to| PictureRequest {
            what: fields.what,
            size: fields.size,
            overlays: fields.overlays,
            to,
        };
        let path = fields.path.trim();
        let name = path.to_ascii_lowercase();
        let is_svg = name.ends_with(".svg") && fields.what.is_line_art();
        let fits = name.ends_with(".png") || is_svg;
        let save = ui.add_enabled(fits, egui::Button::new("Save"));
        let save = save.on_disabled_hover_text(
            "The name must end in .png, or in .svg where the picture is one of lines: a panel, all panels, the folded map, the sampling",
        );
        if save.clicked() || (fits && is_entered) {
            let to = Destination::File {
                path: PathBuf::from(path),
                force: fields.force,
            };
            model.push(Command::MakePicture(request(to)));
            done = true;
        }
        if ui.button("Copy to the clipboard").clicked() {
            model.push(Command::MakePicture(request(Destination::Clipboard)));
            done = true;
        }
        done |= ui.button("Cancel").clicked();
    });
    done
}

/// The messages, each until it is dismissed.
pub fn messages_ui(ui: &mut Ui, model: &mut Model<'_>) {
    for (i, message) in model.messages.iter().enumerate() {
        ui.horizontal(|ui| {
            if ui.small_button("Dismiss").clicked() {
                model.commands.push(Command::Dismiss(i));
            }
            let color = if message.is_error {
                egui::Color32::from_rgb(255, 150, 120)
            } else {
                egui::Color32::from_rgb(150, 220, 160)
            };
            ui.add(egui::Label::new(egui::RichText::new(&message.text).color(color)).wrap());
        });
    }
}
