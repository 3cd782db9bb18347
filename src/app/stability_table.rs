//! The table of the stability pane: a line for each evaluator, a column for each family of inputs.

use egui::{Align2, Color32, ComboBox, FontId, RichText, ScrollArea, Sense, Ui, vec2};

use super::command::Command;
use super::microscope::vector_text;
use super::model::Model;
use super::stability::Table;
use super::stability_panel::set;
use super::state::StabilityState;
use super::theme;
use crate::lab::stress::microscope::Lengths;
use crate::lab::stress::{Family, Measure, Row, Standing};
use crate::mapping::evaluator::EvaluatorInfo;

/// A promise that is broken: vermilion, light enough for a dark ground.
const BROKEN: Color32 = Color32::from_rgb(255, 120, 70);
/// A known fault.
const KNOWN: Color32 = theme::VECTORS[1];
/// Titles, and what is only to be compared with.
const QUIET: Color32 = Color32::from_gray(150);

/// What a cell tells, for the selector.
fn measure_name(measure: Measure) -> &'static str {
    match measure {
        Measure::Holes => "holes",
        Measure::WrongChart => "wrong chart",
        Measure::OutOfRange => "out of [0, 1]",
        Measure::NotFinite => "not finite",
        Measure::RoundTrip => "round trip, rad",
        Measure::Forward => "forward error, rad",
        Measure::SeamJump => "seam jump, texels",
        Measure::Fall => "steps back, ULP",
    }
}

/// A family in a column's width.
fn family_name(family: Family) -> &'static str {
    match family {
        Family::Uniform => "uniform",
        Family::Borders => "borders",
        Family::EdgeMiddles => "middles",
        Family::Ties => "ties",
        Family::Lengths => "lengths",
        Family::NegativeZeros => "−0",
        Family::NoDirections => "none",
        Family::Bits => "bits",
        Family::Walks => "walks",
    }
}

/// What the inputs of a family are.
fn family_text(family: Family) -> &'static str {
    match family {
        Family::Uniform => "even over the sphere",
        Family::Borders => "within 64 ULP of every border, edge, corner, pole and rim",
        Family::EdgeMiddles => "within the paper's black discs, around the middles of edges",
        Family::Ties => "exact ties in all patterns of signs at 60 exponents",
        Family::Lengths => "lengths from the smallest number to the largest",
        Family::NegativeZeros => "-0 for 0",
        Family::NoDirections => "zeros, infinities and what is no number: they must get no chart",
        Family::Bits => "random bits",
        Family::Walks => "along every edge, and across it by one ULP",
    }
}

/// The angle at which the worst of a family's inputs is looked at, in degrees.
fn family_span_deg(family: Family) -> f64 {
    match family {
        Family::Uniform | Family::Lengths | Family::Bits | Family::NoDirections => 1.0,
        Family::EdgeMiddles => 0.1,
        Family::Borders | Family::Ties | Family::NegativeZeros | Family::Walks => 1e-3,
    }
}

/// Shows the table, or how to get one.
pub(super) fn table_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let mut stability = model.state.stability.clone();
    let (mapping, lab) = (model.state.mapping, &model.labs.stability);
    let table = lab.table(mapping);
    ui.horizontal_wrapped(|ui| {
        ui.strong(mapping.info().name);
        let label = ui.label("shows");
        ComboBox::from_id_salt("stability measure")
            .width(120.0_f32.min(ui.available_width()))
            .selected_text(measure_name(stability.measure))
            .show_ui(ui, |ui| {
                for measure in Measure::ALL {
                    ui.selectable_value(&mut stability.measure, measure, measure_name(measure));
                }
            })
            .response
            .labelled_by(label.id);
        let deed = if table.is_some() {
            "Measure again"
        } else {
            "Measure"
        };
        let button = egui::Button::new(deed);
        if ui.add_enabled(!lab.is_measuring(), button).clicked() {
            model.push(Command::MeasureStability);
        }
        let words = match table {
            _ if lab.is_measuring() => "measuring …".to_owned(),
            Some(table) => summary(table),
            None => "not measured yet".to_owned(),
        };
        ui.label(words);
    });
    set(model, stability);
    if let Some(table) = table {
        let signs = "! broken promise   × known fault   ? known fault that is gone; a click looks at the worst";
        ui.label(RichText::new(signs).small());
        cells_ui(ui, model, table);
    }
}

fn summary(table: &Table) -> String {
    let broken = table.rows.iter().filter(|row| row.broken).count();
    match broken {
        0 => "every promise is kept".to_owned(),
        1 => "! 1 promise is broken".to_owned(),
        broken => format!("! {broken} promises are broken"),
    }
}

/// Size of a cell, and of the column of names.
const CELL: egui::Vec2 = vec2(50.0, 17.0);
const NAME_WIDTH: f32 = 104.0;
/// Width of the whole table.
pub(super) const TABLE_WIDTH: f32 = NAME_WIDTH + CELL.x * (1 + Family::ALL.len()) as f32;

/// A line for each evaluator, a column for what is allowed and for each family.
fn cells_ui(ui: &mut Ui, model: &mut Model<'_>, table: &Table) {
    let scroll = ScrollArea::horizontal().auto_shrink([false, false]);
    scroll.show(ui, |ui| {
        ui.spacing_mut().item_spacing = vec2(0.0, 1.0);
        ui.spacing_mut().interact_size.y = CELL.y;
        ui.set_min_width(TABLE_WIDTH);
        ui.horizontal(titles_ui);
        let scroll = ScrollArea::vertical().auto_shrink([false, false]);
        scroll.show(ui, |ui| {
            for evaluator in in_order(table, model.state.stability.measure) {
                ui.horizontal(|ui| line_ui(ui, model, evaluator, rows_of(table, evaluator)));
            }
        });
    });
}

fn rows_of<'a>(table: &'a Table, evaluator: &EvaluatorInfo) -> impl Iterator<Item = &'a Row> {
    let id = evaluator.id;
    table.rows.iter().filter(move |row| row.evaluator == id)
}

/// The evaluators, those first of which there is something to tell.
fn in_order(table: &Table, measure: Measure) -> Vec<&'static EvaluatorInfo> {
    let is_plain = |evaluator: &EvaluatorInfo| {
        rows_of(table, evaluator).all(|row| row.standing(measure) == Standing::Kept)
    };
    let mut list: Vec<_> = table.mapping.evaluators().iter().collect();
    list.sort_by_cached_key(|evaluator| is_plain(evaluator));
    list
}

fn titles_ui(ui: &mut Ui) {
    cell(ui, "evaluator", Style::NAME.colored(QUIET));
    cell(ui, "allowed", Style::NUMBER.colored(QUIET))
        .on_hover_text("What an evaluator may err by, whatever the input");
    for family in Family::ALL {
        cell(ui, family_name(family), Style::NUMBER.colored(QUIET))
            .on_hover_text(family_text(family));
    }
}

/// One evaluator; a click on its name puts it under the microscope.
fn line_ui<'a>(
    ui: &mut Ui,
    model: &mut Model<'_>,
    evaluator: &'static EvaluatorInfo,
    rows: impl Iterator<Item = &'a Row>,
) {
    let (measure, mapping) = (model.state.stability.measure, model.state.mapping);
    let now = model.state.stability.evaluator_of(mapping);
    let color = if now.is_some_and(|now| now.id == evaluator.id) {
        theme::TEXEL
    } else {
        ui.visuals().text_color()
    };
    let name = cell(ui, evaluator.id, Style::NAME.colored(color).button());
    if name.on_hover_text(evaluator.about).clicked() {
        let stability = StabilityState {
            evaluator: evaluator.id.to_owned(),
            ..model.state.stability.clone()
        };
        set(model, stability);
    }
    for (k, row) in rows.enumerate() {
        if k == 0 {
            let allowed = number_text(measure, row.allowed.number(measure));
            cell(ui, &allowed, Style::NUMBER.colored(QUIET));
        }
        result_ui(ui, model, row, measure);
    }
}

/// What was seen of an evaluator on a family.
fn result_ui(ui: &mut Ui, model: &mut Model<'_>, row: &Row, measure: Measure) {
    let observed = number_text(measure, row.observed.number(measure));
    let (sign, color) = match row.standing(measure) {
        Standing::Kept if observed == "0" => ("", Color32::from_gray(120)),
        Standing::Kept => ("", ui.visuals().text_color()),
        Standing::Known => ("×", KNOWN),
        Standing::Broken => ("!", BROKEN),
        Standing::Gone => ("?", BROKEN),
    };
    let text = format!("{sign}{observed}");
    let response = cell(ui, &text, Style::NUMBER.colored(color).button());
    let name = format!("{} on {}: {text}", row.evaluator, row.family.id());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
    let worst = row.worst_of[measure as usize];
    let clicked = response.clicked();
    response.on_hover_ui(|ui| {
        ui.label(hover_text(row, measure));
        if let Some(dir) = worst {
            ui.label(RichText::new(format!("worst input\n{}", vector_text(dir))).monospace());
        }
    });
    let dir = worst.filter(|dir| dir.iter().all(|c| c.is_finite()) && *dir != [0.0; 3]);
    if let (true, Some(dir)) = (clicked, dir) {
        look_at(model, row, dir);
    }
}

fn hover_text(row: &Row, measure: Measure) -> String {
    let [observed, allowed] =
        [row.observed, row.allowed].map(|m| number_text(measure, m.number(measure)));
    let mut text = format!(
        "{} on {} ({} inputs): {observed} {}, allowed {allowed}",
        row.evaluator,
        row.family.id(),
        row.n,
        measure_name(measure)
    );
    let known = row.known(measure).map_or("", |known| known.why);
    match row.standing(measure) {
        Standing::Kept => {}
        Standing::Known => text += &format!("\nknown fault: {known}"),
        Standing::Broken => text += "\na broken promise",
        Standing::Gone => text += &format!("\nthe known fault is not seen: {known}"),
    }
    text
}

/// The microscope and the probe go to a row's worst input, at its own length.
fn look_at(model: &mut Model<'_>, row: &Row, dir: [f32; 3]) {
    let center = dir.map(f64::from);
    let stability = StabilityState {
        evaluator: row.evaluator.to_owned(),
        center,
        span_deg: family_span_deg(row.family),
        lengths: Lengths::Sphere(center.iter().map(|c| c * c).sum::<f64>().sqrt()),
        ..model.state.stability.clone()
    }
    .sanitized();
    let unit = stability.center;
    set(model, stability);
    model.keep_probe(unit);
}

/// A number in six letters.
fn number_text(measure: Measure, x: f64) -> String {
    match measure {
        _ if x == 0.0 => "0".to_owned(),
        Measure::Holes | Measure::WrongChart | Measure::OutOfRange | Measure::NotFinite => {
            format!("{x:.0}")
        }
        Measure::RoundTrip | Measure::Forward | Measure::SeamJump => format!("{x:.1e}"),
        Measure::Fall => format!("{x:.1}"),
    }
}

/// How a cell looks.
#[derive(Clone, Copy)]
struct Style {
    width: f32,
    anchor: Align2,
    color: Color32,
    is_button: bool,
}

impl Style {
    const NAME: Self = Self {
        width: NAME_WIDTH,
        anchor: Align2::LEFT_CENTER,
        color: QUIET,
        is_button: false,
    };
    const NUMBER: Self = Self {
        width: CELL.x,
        anchor: Align2::RIGHT_CENTER,
        ..Self::NAME
    };

    const fn colored(self, color: Color32) -> Self {
        Self { color, ..self }
    }

    const fn button(self) -> Self {
        Self {
            is_button: true,
            ..self
        }
    }
}

/// A text in a box of its own, cut where it is too long.
fn cell(ui: &mut Ui, text: &str, style: Style) -> egui::Response {
    let sense = if style.is_button {
        Sense::click()
    } else {
        Sense::hover()
    };
    let (rect, response) = ui.allocate_exact_size(vec2(style.width, CELL.y), sense);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, text));
    if ui.is_rect_visible(rect) {
        if response.hovered() && style.is_button {
            let lit = Color32::from_gray(60);
            ui.painter().rect_filled(rect, 2.0, lit);
        }
        let at = style.anchor.pos_in_rect(&rect.shrink2(vec2(3.0, 0.0)));
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let font = FontId::proportional(11.5);
        painter.text(at, style.anchor, text, font, style.color);
    }
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_fits_its_cell() {
        for measure in Measure::ALL {
            for x in [0.0, 1.0, 3.0, 20_736.0, 0.99] {
                let text = number_text(measure, x);
                assert!(text.len() <= 7, "{measure:?} {x}: {text}");
            }
        }
        assert_eq!(number_text(Measure::Forward, 2.44e-4), "2.4e-4");
        assert_eq!(number_text(Measure::Holes, 17.0), "17");
    }
}
