//! The table below the curves or beside them: each formula's value and largest error, what is drawn, what the material takes.

use egui::{Grid, RichText, Sense, Stroke, Ui, vec2};
use egui_plot::LineStyle;

use super::{Row, computed};
use crate::app::action::Action;
use crate::app::model::Model;
use crate::optics::Formula;
use crate::optics::curve::LargestError;
use crate::optics::material::Material;

/// Below this width the table's numbers are told with a place less.
const NARROW_TABLE: f32 = 310.0;
/// Below this width they stand below their formula.
const NARROW_LIST: f32 = 250.0;

/// Each formula with its value at the angle of incidence and its largest error.
pub(super) fn table_ui(
    ui: &mut Ui,
    model: &mut Model<'_>,
    rows: &[Row],
    incidence_rad: Option<f64>,
) {
    if ui.available_width() < NARROW_LIST {
        for row in rows {
            listed_ui(ui, model, row, incidence_rad);
        }
        return;
    }
    let is_narrow = ui.available_width() < NARROW_TABLE;
    egui::ScrollArea::horizontal().show(ui, |ui| {
        Grid::new("formulas")
            .num_columns(4)
            .min_col_width(0.0)
            .spacing([if is_narrow { 4.0 } else { 8.0 }, 1.0])
            .show(ui, |ui| {
                let at = incidence_rad.map_or("at θ".to_owned(), |angle| {
                    let degrees = angle.to_degrees();
                    if is_narrow {
                        format!("{degrees:.0}°")
                    } else {
                        format!("at {degrees:.1}°")
                    }
                });
                let largest = if is_narrow {
                    "largest"
                } else {
                    "largest error"
                };
                for title in ["formula", &at, largest, "at"] {
                    ui.label(RichText::new(title).small()).on_hover_text(
                        "Largest error: the formula less the exact value, where it is farthest off",
                    );
                }
                ui.end_row();
                for row in rows {
                    row_ui(ui, model, row, incidence_rad, is_narrow);
                    ui.end_row();
                }
            });
    });
}

/// A formula, and below it its value and its largest error in words.
fn listed_ui(ui: &mut Ui, model: &mut Model<'_>, row: &Row, incidence_rad: Option<f64>) {
    name_ui(ui, model, row, true);
    let Some([value, error, angle]) = numbers(ui.ctx(), row, incidence_rad, true) else {
        return;
    };
    let at = incidence_rad.map_or(String::new(), |angle| {
        format!(" at {:.0}°", angle.to_degrees())
    });
    let error = if angle.is_empty() {
        error
    } else {
        format!("largest error {error} at {angle}")
    };
    let text = RichText::new(format!("{value}{at}, {error}")).small();
    ui.add(egui::Label::new(text).wrap());
}

fn row_ui(
    ui: &mut Ui,
    model: &mut Model<'_>,
    row: &Row,
    incidence_rad: Option<f64>,
    is_narrow: bool,
) {
    name_ui(ui, model, row, is_narrow);
    for text in numbers(ui.ctx(), row, incidence_rad, is_narrow)
        .into_iter()
        .flatten()
    {
        ui.label(RichText::new(text).monospace().size(11.0));
    }
}

/// The value at the angle of incidence, the largest error and its angle where the curve is drawn; the exact one has no error.
fn numbers(
    ctx: &egui::Context,
    row: &Row,
    incidence_rad: Option<f64>,
    is_narrow: bool,
) -> Option<[String; 3]> {
    if !row.shown {
        return None;
    }
    // Places of a reflectance, and of an angle in degrees.
    let (places, angle_places) = if is_narrow { (3, 0) } else { (4, 1) };
    let value = incidence_rad.map(|angle| format!("{:.places$}", row.law.reflectance(angle)));
    let value = value.unwrap_or_else(|| "–".to_owned());
    if row.law.exact() == row.law {
        return Some([value, "exact".to_owned(), String::new()]);
    }
    let LargestError { error, angle_rad } = computed(ctx, row.law).largest;
    let degrees = angle_rad.to_degrees();
    Some([
        value,
        format!("{error:+.places$}"),
        format!("{degrees:.angle_places$}°"),
    ])
}

/// The formula's curve and name, to draw it and to take it.
fn name_ui(ui: &mut Ui, model: &mut Model<'_>, row: &Row, is_narrow: bool) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = if is_narrow { 2.0 } else { 4.0 };
        ui.spacing_mut().button_padding.x = 2.0;
        if let Some(formula) = row.formula {
            show_ui(ui, model, row, formula);
        }
        swatch_ui(ui, row);
        match row.formula {
            Some(formula) => choose_ui(ui, model, name_text(row, is_narrow), formula),
            None => {
                ui.label(name_text(row, is_narrow));
            }
        }
    });
}

/// Draws the curve or not; the exact one always is.
fn show_ui(ui: &mut Ui, model: &mut Model<'_>, row: &Row, formula: Formula) {
    let mut shown = row.shown;
    let checkbox = egui::Checkbox::without_text(&mut shown);
    let response = ui.add_enabled(formula != Formula::Fresnel, checkbox);
    let label = format!("Draw {}", row.name);
    response
        .widget_info(|| egui::WidgetInfo::selected(egui::Role::CheckBox, true, row.shown, &label));
    if response.on_hover_text(&label).changed() {
        let mut curves = model.state.curves.clone();
        curves.shown.retain(|f| *f != formula);
        if shown {
            curves.shown.push(formula);
        }
        model.push(Action::SetCurves(curves));
    }
}

fn name_text(row: &Row, is_narrow: bool) -> RichText {
    RichText::new(&row.name).size(if is_narrow { 10.0 } else { 11.0 })
}

/// Makes the formula the material's.
fn choose_ui(ui: &mut Ui, model: &mut Model<'_>, name: RichText, formula: Formula) {
    let material = &model.state.material;
    let response = ui
        .selectable_label(material.formula == formula, name)
        .on_hover_text("Click: the material reflects by this formula");
    if response.clicked() && material.formula != formula {
        model.push(Action::SetMaterial(Box::new(Material {
            formula,
            ..material.clone()
        })));
    }
}

/// A piece of the curve's line.
fn swatch_ui(ui: &mut Ui, row: &Row) {
    let (rect, _) = ui.allocate_exact_size(vec2(12.0, 10.0), Sense::hover());
    let line = [rect.left_center(), rect.right_center()];
    let stroke = Stroke::new(row.width.min(3.0), row.color);
    let shapes = match row.style {
        LineStyle::Solid => vec![egui::Shape::line_segment(line, stroke)],
        LineStyle::Dashed { .. } => egui::Shape::dashed_line(&line, stroke, 5.0, 3.0),
        LineStyle::Dotted { .. } => egui::Shape::dotted_line(&line, row.color, 4.0, 1.2),
    };
    ui.painter().extend(shapes);
}
