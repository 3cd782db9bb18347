//! The dialog that writes the environment for another program.

use egui::{ComboBox, DragValue, Grid, RichText, Ui};

use super::command::Command;
use super::dialogs::{buttons_ui, path_ui};
use super::export::{Export, FORMATS, MOST_ROWS, Preset, kind_names, kinds};
use super::lists;
use super::model::Model;
use super::pace::Pace;
use crate::imaging::load::Format;
use crate::imaging::resample::{Filter, chart_size};
use crate::mapping::{Family, Frame, Layout, MappingId};

/// A row of the form: a name and a list to choose from.
pub(super) fn row_ui<T: PartialEq + Clone>(
    ui: &mut Ui,
    label: &str,
    now: &mut T,
    options: &[T],
    name: impl Fn(&T) -> String,
) -> bool {
    grouped_row_ui(ui, label, now, options, name, |_| None)
}

/// The same of what belongs to mappings' families.
pub(super) fn grouped_row_ui<T: PartialEq + Clone>(
    ui: &mut Ui,
    label: &str,
    now: &mut T,
    options: &[T],
    name: impl Fn(&T) -> String,
    family: impl Fn(&T) -> Option<Family>,
) -> bool {
    let before = now.clone();
    let text = ui.label(label);
    ComboBox::from_id_salt(("export", label))
        .width(250.0)
        .height(lists::HEIGHT)
        .selected_text(name(now))
        .show_ui(ui, |ui| {
            lists::entries_ui(ui, now, options.iter().cloned(), name, family)
        })
        .response
        .labelled_by(text.id);
    ui.end_row();
    *now != before
}

/// A command line to copy, in letters of one width: two hyphens look like two.
pub(super) fn line_ui(ui: &mut Ui, model: &mut Model<'_>, line: String) {
    ui.horizontal(|ui| {
        let text = RichText::new(&line).monospace().size(LINE_SIZE);
        let copies = ui.button("Copy the line").clicked();
        ui.add(egui::Label::new(text).wrap());
        if copies {
            model.push(Command::CopyText(line));
        }
    });
}

/// Points of a command line's letters: as small as the window's smallest.
const LINE_SIZE: f32 = 11.0;

/// The whole form; true when it is done with.
pub fn export_ui(ui: &mut Ui, model: &mut Model<'_>, export: &mut Export) -> bool {
    ui.heading("Export the environment");
    ui.horizontal_wrapped(|ui| {
        ui.label("as for");
        for preset in &Preset::ALL {
            if ui.button(preset.name).clicked() {
                export.set_preset(preset);
            }
        }
    });
    Grid::new("export")
        .num_columns(2)
        .show(ui, |ui| form_ui(ui, export));
    let image = model.surroundings.map(|shown| &shown.loaded.image);
    let size = image.map(|image| [image.width(), image.height()]);
    export.follow(model.state.rotation, size);
    if !export.rotation.is_none() {
        ui.label(format!("turned as the scene is, by {}", export.rotation));
    }
    let input = model.state.environment.id();
    let is_entered = path_ui(ui, model, &mut export.path);
    ui.checkbox(&mut export.force, "replace the file if it exists");
    ui.label(estimate(export, model.paces.of(export)));
    let line = export.command_line(&input, &model.state.environment.hints());
    line_ui(ui, model, line);
    let ready = model.surroundings.is_some() && !export.path.trim().is_empty();
    buttons_ui(ui, "Export", ready, is_entered, || {
        model.push(Command::Export(Box::new(export.clone())));
    })
}

fn form_ui(ui: &mut Ui, export: &mut Export) {
    let info = |mapping: &MappingId| mapping.info().name.to_owned();
    let family = |mapping: &MappingId| Some(mapping.info().family);
    let all = MappingId::ALL;
    let mut changed = grouped_row_ui(ui, "mapping", &mut export.mapping, all, info, family);
    let knows = Frame::ALL
        .iter()
        .filter(|frame| frame.knows(export.mapping) && !frame.is_ours);
    let frames: Vec<Option<&'static str>> = std::iter::once(None)
        .chain(knows.map(|frame| Some(frame.id)))
        .collect();
    let name = |id: &Option<&'static str>| match id.map(Frame::from_id) {
        Some(Ok(frame)) => frame.name.to_owned(),
        _ => "Sixfold's own".to_owned(),
    };
    changed |= row_ui(ui, "frame", &mut export.frame, &frames, name);
    if let Some(Ok(frame)) = export.frame.map(Frame::from_id)
        && frame.is_mirrored(export.mapping)
    {
        ui.label("");
        ui.label("seen with other eyes this file is a mirror image, as the program wants it");
        ui.end_row();
    }
    let charts = export.mapping.info().chart_count();
    let fits = |layout: &Layout| layout.holds(charts) && (charts > 1 || *layout != Layout::Faces);
    let layouts: Vec<Layout> = Layout::ALL.into_iter().filter(fits).collect();
    changed |= row_ui(ui, "layout", &mut export.layout, &layouts, |layout| {
        layout.id().to_owned()
    });
    let formats = FORMATS.map(|(format, _)| format);
    let format_name = |format: &Format| format.name().to_owned();
    changed |= row_ui(ui, "format", &mut export.format, &formats, format_name);
    let kind = kinds(export.format);
    changed |= row_ui(ui, "samples", &mut export.stored, kind, |stored| {
        kind_names(*stored).0.to_owned()
    });
    let filters: Vec<Option<Filter>> = std::iter::once(None).chain(Filter::ALL.map(Some)).collect();
    let filter_name = |filter: &Option<Filter>| {
        filter
            .map_or("area if coarser, else bicubic", Filter::id)
            .to_owned()
    };
    row_ui(ui, "filter", &mut export.filter, &filters, filter_name);
    let label = ui.label("rows of a chart");
    ui.horizontal(|ui| {
        let rows = DragValue::new(&mut export.height).range(1..=MOST_ROWS);
        if ui.add(rows).labelled_by(label.id).changed() {
            export.as_fine = false;
        }
        let [width, height] = chart_size(export.mapping, export.height);
        ui.label(format!("{charts} × {width}×{height} texels"));
    });
    ui.end_row();
    ui.label("");
    ui.horizontal(|ui| {
        ui.checkbox(&mut export.as_fine, "as fine as the environment")
            .on_hover_text("As many texels around the horizon as the environment has");
    });
    ui.end_row();
    ui.label("");
    ui.horizontal(|ui| {
        let is_container = export.format.is_container();
        ui.add_enabled_ui(is_container, |ui| {
            ui.checkbox(&mut export.has_levels, "all smaller levels");
        });
        ui.add_enabled_ui(export.format == Format::Ktx2, |ui| {
            ui.checkbox(&mut export.zstd, "compressed (zstd)");
        });
        ui.add_enabled_ui(export.can_dither(), |ui| {
            ui.checkbox(&mut export.dither, "dithered");
        });
    });
    ui.end_row();
    if changed {
        export.mend();
    }
}

/// Size and time in words.
fn estimate(export: &Export, pace: Pace) -> String {
    let megabytes = export.bytes() as f64 / 1e6;
    let most = if export.is_compressed() {
        "at most"
    } else {
        "about"
    };
    let about = |rate: f64| {
        let seconds = export.texels() as f64 / rate;
        if seconds < 0.1 {
            "less than 0.1 s".to_owned()
        } else {
            format!("about {seconds:.1} s")
        }
    };
    let time = match pace {
        Pace::Measured(rate) => format!("{}, judging by a small one", about(rate)),
        Pace::OfLast(rate) => format!("{} at the rate of the last export", about(rate)),
        Pace::Unknown => "a small one is being timed".to_owned(),
    };
    format!("{most} {megabytes:.2} MB; {time}")
}
