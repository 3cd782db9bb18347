//! The table below the plot: the same measurements, a line each.

use std::cmp::Ordering;

use egui::{Button, RichText, Ui};

use super::choices::change;
use super::plot::{Shown, look, use_evaluator};
use super::words::worst_text;
use crate::app::model::Model;
use crate::app::numbers::significant;
use crate::app::state::Column;
use crate::app::theme;
use crate::lab::bench::Row;
use crate::lab::choice::reference_beside;
use crate::lab::filter::device_name;
use crate::mapping::MappingId;

/// Each column with its title and width in letters; the words stand at the left.
const COLUMNS: [(Column, &str, usize); 9] = [
    (Column::Mapping, "mapping", 23),
    (Column::Evaluator, "evaluator", 17),
    (Column::Device, "device", 13),
    (Column::Time, "ns", 9),
    (Column::Copies, "× copy", 9),
    (Column::Reference, "× reference", 13),
    (Column::Largest, "max rad", 10),
    (Column::Rms, "RMS rad", 10),
    (Column::Texels, "max texel", 11),
];
/// Columns of words.
const WORDS: usize = 3;
/// Size of the letters, and height of a line.
const LETTER: f32 = 11.0;
const LINE: f32 = 15.0;

/// A measurement with what is told of it.
struct Entry<'a> {
    row: &'a Row,
    on_front: bool,
    /// Its time over the reference's.
    reference: Option<f64>,
    texels: f64,
}

impl Entry<'_> {
    fn cell(&self, column: Column) -> String {
        let row = self.row;
        let error = |value: f64| match row.holes {
            0 => significant(value),
            holes => format!("{holes} holes"),
        };
        match column {
            Column::Mapping => row.mapping.to_owned(),
            Column::Evaluator => row.evaluator.to_owned(),
            Column::Device => device_name(row),
            Column::Time => significant(row.ns),
            Column::Copies => significant(row.copy_ratio),
            Column::Reference => self.reference.map_or("–".to_owned(), significant),
            Column::Largest => error(row.max_error_rad),
            Column::Rms => error(row.rms_error_rad),
            Column::Texels => error(self.texels),
        }
    }

    /// The whole line.
    fn line(&self) -> String {
        let cell = |(k, (column, _, width)): (usize, &(Column, &str, usize))| {
            padded(&self.cell(*column), k, *width)
        };
        let cells: String = COLUMNS.iter().enumerate().map(cell).collect();
        format!("{cells}  {}", worst_text(self.row))
    }
}

/// A cell as wide as its column; an adapter's long name is cut.
fn padded(text: &str, column: usize, width: usize) -> String {
    let text: String = text.chars().take(width - 1).collect();
    if column < WORDS {
        format!("{text:width$}")
    } else {
        format!("{text:>width$}")
    }
}

/// In the order of a column; what has no number comes last either way.
fn sort(entries: &mut [Entry<'_>], column: Column, descending: bool) {
    let number = |entry: &Entry<'_>| {
        let (row, is_sound) = (entry.row, entry.row.holes == 0);
        match column {
            Column::Time => Some(row.ns),
            Column::Copies => Some(row.copy_ratio),
            Column::Reference => entry.reference,
            Column::Largest => Some(row.max_error_rad).filter(|_| is_sound),
            Column::Rms => Some(row.rms_error_rad).filter(|_| is_sound),
            Column::Texels => Some(entry.texels).filter(|_| is_sound),
            Column::Mapping | Column::Evaluator | Column::Device => None,
        }
    };
    let turned = |order: Ordering| if descending { order.reverse() } else { order };
    entries.sort_by(|a, b| match column {
        Column::Mapping | Column::Evaluator | Column::Device => {
            turned(a.cell(column).cmp(&b.cell(column)))
        }
        _ => match (number(a), number(b)) {
            (Some(a), Some(b)) => turned(a.total_cmp(&b)),
            (a, b) => b.is_some().cmp(&a.is_some()),
        },
    });
}

/// The table, `height` high; a click on a line uses its evaluator, one on a title sorts.
pub fn table_ui(ui: &mut Ui, model: &mut Model<'_>, shown: &[Shown<'_>], height: f32) {
    let laboratory = &model.state.laboratory;
    let (column, descending) = (laboratory.sort, laboratory.descending);
    let measured = model.labs.bench.rows();
    let texels = |row: &Row| {
        let map = MappingId::ALL
            .iter()
            .find(|map| map.info().id == row.mapping);
        let height = map.map_or(row.texels, |map| model.map_size(*map)[1]);
        row.error_texels_at(height)
    };
    let mut entries: Vec<Entry<'_>> = shown
        .iter()
        .map(|&(row, on_front)| Entry {
            row,
            on_front,
            reference: reference_beside(measured, row).map(|reference| row.ns / reference.ns),
            texels: texels(row),
        })
        .collect();
    sort(&mut entries, column, descending);
    ui.scope(|ui| {
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        ui.spacing_mut().item_spacing = egui::Vec2::ZERO;
        ui.spacing_mut().button_padding = egui::Vec2::ZERO;
        ui.spacing_mut().interact_size.y = LINE;
        let sideways = egui::ScrollArea::horizontal().id_salt("table");
        sideways.show(ui, |ui| {
            ui.horizontal(|ui| head_ui(ui, model, column, descending));
            let lines = egui::ScrollArea::vertical()
                .id_salt("lines")
                .max_height(height - 2.0 * LINE);
            lines.show_rows(ui, LINE, entries.len(), |ui, range| {
                for entry in &entries[range] {
                    line_ui(ui, model, entry);
                }
            });
        });
    });
}

fn mono(text: String) -> RichText {
    RichText::new(text).monospace().size(LETTER)
}

fn head_ui(ui: &mut Ui, model: &mut Model<'_>, sorted: Column, descending: bool) {
    for (k, (column, title, width)) in COLUMNS.iter().enumerate() {
        let is_sorted = *column == sorted;
        let text = match (is_sorted, descending) {
            (true, false) => format!("{title}↑"),
            (true, true) => format!("{title}↓"),
            _ => (*title).to_owned(),
        };
        let text = mono(padded(&text, k, *width)).strong();
        let text = if is_sorted {
            text.color(theme::TEXEL)
        } else {
            text
        };
        let response = ui.add(Button::new(text).frame(false));
        let label = format!("Sort by {title}");
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &label));
        if response.on_hover_text(&label).clicked() {
            change(model, |laboratory| {
                laboratory.descending = is_sorted && !laboratory.descending;
                laboratory.sort = *column;
            });
        }
    }
}

fn line_ui(ui: &mut Ui, model: &mut Model<'_>, entry: &Entry<'_>) {
    let row = entry.row;
    let is_used = model.used.is_some_and(|used| {
        let choice = used.measured.as_ref();
        choice.is_some_and(|choice| {
            (choice.row.mapping, choice.row.evaluator) == (row.mapping, row.evaluator)
        })
    });
    let text = mono(entry.line());
    // The front in its mapping's colour.
    let text = if entry.on_front {
        text.color(look(row.mapping).0)
    } else {
        text
    };
    if ui.selectable_label(is_used, text).clicked() {
        use_evaluator(model, row);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Progress;
    use crate::lab::bench::{Plan, bench};
    use crate::lab::clock::Clock;
    use crate::lab::devices::Devices;
    use crate::mapping::NoDevice;

    #[test]
    fn every_line_tells_speed_and_error_and_columns_sort_both_ways() {
        let plan = Plan {
            maps: vec![MappingId::Ccm],
            inputs: vec![crate::lab::inputs::Inputs::Adversarial],
            few: 64,
            many: 64,
            judged: 4096,
            clock: Clock {
                samples: 1,
                shortest: std::time::Duration::ZERO,
            },
            devices: Devices::Cpu,
            ..Plan::full()
        };
        let rows = bench(&plan, &NoDevice("not asked"), &Progress::new()).rows;
        let entry = |row| Entry {
            row,
            on_front: false,
            reference: reference_beside(&rows, row).map(|r| row.ns / r.ns),
            texels: row.error_texels_at(512),
        };
        let mut entries: Vec<Entry<'_>> = rows.iter().map(entry).collect();
        assert!(entries.iter().any(|e| e.row.holes > 0), "control: no holes");
        for entry in &entries {
            let line = entry.line();
            assert!(line.contains(&significant(entry.row.ns)), "{line}");
            let error = match entry.row.holes {
                0 => significant(entry.row.max_error_rad),
                holes => format!("{holes} holes"),
            };
            assert!(line.contains(&error) && line.contains("worst"), "{line}");
        }
        let errors = |entries: &[Entry<'_>]| -> Vec<f64> {
            let sound = entries.iter().filter(|e| e.row.holes == 0);
            sound.map(|e| e.row.max_error_rad).collect()
        };
        sort(&mut entries, Column::Largest, false);
        assert!(errors(&entries).is_sorted());
        assert!(entries.last().is_some_and(|e| e.row.holes > 0));
        sort(&mut entries, Column::Largest, true);
        assert!(errors(&entries).is_sorted_by(|a, b| a >= b));
        assert!(entries.last().is_some_and(|e| e.row.holes > 0));
        sort(&mut entries, Column::Evaluator, false);
        assert!(entries.is_sorted_by_key(|e| e.row.evaluator));
        assert!(!errors(&entries).is_sorted(), "control");
    }
}
