//! Reflectance over the angle of incidence: the approximations beside the exact curve.

mod table;

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use egui::cache::{ComputerMut, FrameCache};
use egui::{Align2, Color32, RichText, Stroke, Ui};
use egui_plot::{
    AxisHints, GridMark, HoverPosition, Line, LineStyle, PlotPoint, PlotPoints, Text, VLine,
};

use super::action::Action;
use super::model::Model;
use super::plots::still_plot;
use super::state::CurvesState;
use super::story::incidence_rad;
use super::theme;
use crate::optics::curve::{LargestError, Law, brewster_angle_rad, widened};
use crate::optics::material::{Material, Surface};
use crate::optics::reflectance::Shape;
use crate::optics::wavelengths::wavelengths;
use crate::optics::{Formula, critical_angle_rad};

/// Spans of a curve: half a degree each.
const SAMPLES: u32 = 180;
/// A little above 1, so that a curve at 1 is seen.
const TOP: f64 = 1.05;
/// Width from which the table stands beside the plot.
const WIDE: f32 = 640.0;
/// Width of the table there.
const TABLE_WIDTH: f32 = 310.0;
/// The angle under the pointer.
const POINTER: &str = "θ";
/// Room for a marked angle's name, and for the numbers at the plot's left, in points.
const NAME_WIDTH: f64 = 78.0;
const AXIS_WIDTH: f64 = 40.0;
/// Height of a row of the table.
const ROW_HEIGHT: f32 = 21.0;
/// Below this height curves cannot be told apart.
const LOWEST_PLOT: f32 = 130.0;
/// Red, green and blue of a metal: Okabe and Ito's vermilion, bluish green and sky blue.
const CHANNELS: [(&str, Color32); 3] = [
    ("red", Color32::from_rgb(235, 110, 40)),
    ("green", theme::VECTORS[2]),
    ("blue", theme::VECTORS[1]),
];

/// One curve and its row in the table.
struct Row {
    name: String,
    color: Color32,
    style: LineStyle,
    width: f32,
    law: Law,
    /// What a click on its name chooses.
    formula: Option<Formula>,
    shown: bool,
}

/// Shows the curves in all the space there is.
pub fn curves_ui(ui: &mut Ui, model: &mut Model<'_>) {
    theme::pane_frame(ui).show(ui, |ui| {
        let rows = rows(&model.state.material, &model.state.curves);
        let eta = eta(&model.state.material, &model.state.curves);
        let incidence = incidence(model);
        header_ui(ui, model, eta);
        let size = ui.available_size();
        if size.x >= WIDE {
            ui.horizontal_top(|ui| {
                plot_ui(
                    ui,
                    &rows,
                    eta,
                    incidence,
                    size.x - TABLE_WIDTH - 10.0,
                    size.y,
                );
                ui.vertical(|ui| table::table_ui(ui, model, &rows, incidence));
            });
        } else {
            // One below the other. Where both have no room, one scrolls: a flat plot could not be read.
            let table = ROW_HEIGHT * (rows.len() + 1) as f32;
            let height = (size.y - table - 6.0).max(LOWEST_PLOT.min(size.y));
            let scroll = egui::ScrollArea::vertical().auto_shrink([false, false]);
            scroll.show(ui, |ui| {
                plot_ui(ui, &rows, eta, incidence, size.x, height);
                table::table_ui(ui, model, &rows, incidence);
            });
        }
    });
}

/// The angle of incidence where the probe's ray meets the object, in radians.
fn incidence(model: &Model<'_>) -> Option<f64> {
    let ray = model.state.eye_ray?.ray();
    let hit = model.target.cast(ray)?;
    Some(incidence_rad(ray, &hit))
}

/// n1/n2 of the dielectric that is shown; `None` for a metal.
fn eta(material: &Material, curves: &CurvesState) -> Option<f64> {
    if material.surface == Surface::Metal {
        return None;
    }
    let all = wavelengths(material);
    let eta = f64::from(all.get(all.len() / 2)?.eta);
    Some(if curves.from_inside { 1.0 / eta } else { eta })
}

fn rows(material: &Material, curves: &CurvesState) -> Vec<Row> {
    match eta(material, curves) {
        None => metal_rows(material),
        Some(eta) => formula_rows(material, curves, eta),
    }
}

fn formula_rows(material: &Material, curves: &CurvesState, eta: f64) -> Vec<Row> {
    let shape = widened(material.shape);
    let row = |formula: Formula| {
        let is_exact = formula == Formula::Fresnel;
        let (color, style) = look(formula);
        Row {
            name: named(formula, material),
            color,
            style,
            width: if is_exact { 4.0 } else { 1.8 },
            law: Law::Dielectric {
                formula,
                eta,
                shape,
            },
            formula: Some(formula),
            shown: is_exact || curves.shown.contains(&formula),
        }
    };
    Formula::ALL.into_iter().map(row).collect()
}

/// A formula's name, with its exponent where that is not the published one.
fn named(formula: Formula, material: &Material) -> String {
    let exponent = material.shape.exponent;
    let is_usual = exponent == Shape::<f32>::default().exponent;
    if formula == Formula::Schlick && !is_usual {
        format!("{}, power {exponent}", formula.name())
    } else {
        formula.name().to_owned()
    }
}

/// Okabe and Ito's colours, the dark blue lightened for a dark ground; faults are not drawn through.
fn look(formula: Formula) -> (Color32, LineStyle) {
    let [orange, sky_blue, green] = theme::VECTORS;
    match formula {
        Formula::Fresnel => (Color32::from_gray(235), LineStyle::Solid),
        Formula::FresnelS => (orange, LineStyle::Solid),
        Formula::FresnelP => (sky_blue, LineStyle::Solid),
        Formula::Schlick => (green, LineStyle::Solid),
        Formula::Cg => (theme::TEXEL, LineStyle::Solid),
        Formula::Simple => (Color32::from_rgb(204, 121, 167), LineStyle::Solid),
        Formula::PrintedSign => (
            Color32::from_rgb(235, 110, 40),
            LineStyle::Dotted { spacing: 5.0 },
        ),
        Formula::PrintedMix => (
            Color32::from_rgb(70, 150, 230),
            LineStyle::Dashed { length: 7.0 },
        ),
    }
}

fn metal_rows(material: &Material) -> Vec<Row> {
    let exponent = f64::from(material.shape.exponent);
    let channels = CHANNELS.into_iter().zip(material.metal.index_rgb());
    channels
        .flat_map(|((name, color), index)| {
            let row = |name: String, law: Law, style: LineStyle, width: f32| Row {
                name,
                color,
                style,
                width,
                law,
                formula: None,
                shown: true,
            };
            [
                row(
                    format!("{name}, exact"),
                    Law::Metal { index },
                    LineStyle::Solid,
                    3.0,
                ),
                row(
                    format!("{name}, Schlick"),
                    Law::MetalSchlick { index, exponent },
                    LineStyle::Dashed { length: 6.0 },
                    1.8,
                ),
            ]
        })
        .collect()
}

/// Which side the light comes from, and the angles that have a name.
fn header_ui(ui: &mut Ui, model: &mut Model<'_>, eta: Option<f64>) {
    let Some(eta) = eta else {
        ui.label(format!(
            "{}, for red, green and blue light",
            model.state.material.metal.name()
        ));
        return;
    };
    ui.horizontal_wrapped(|ui| {
        let curves = &model.state.curves;
        for (from_inside, name) in [(false, "from outside"), (true, "from inside")] {
            let response = ui.selectable_label(curves.from_inside == from_inside, name);
            if response.clicked() && curves.from_inside != from_inside {
                model.push(Action::SetCurves(CurvesState {
                    from_inside,
                    ..curves.clone()
                }));
            }
        }
        ui.label(RichText::new(format!("η\u{a0}=\u{a0}{eta:.3}")).monospace());
    });
    ui.label(RichText::new(angles_text(eta)).small());
}

/// "Brewster's angle 56.31°, critical angle 41.81°".
fn angles_text(eta: f64) -> String {
    let brewster = brewster_angle_rad(eta).to_degrees();
    match critical_angle_rad(eta) {
        Some(critical) => {
            let critical = critical.to_degrees();
            format!("Brewster's angle {brewster:.2}°, critical angle {critical:.2}°")
        }
        None => format!("Brewster's angle {brewster:.2}°, no total reflection"),
    }
}

/// The curves and the angles that are marked.
fn plot_ui(
    ui: &mut Ui,
    rows: &[Row],
    eta: Option<f64>,
    incidence_rad: Option<f64>,
    width: f32,
    height: f32,
) {
    let shown: Vec<(&Row, Arc<Computed>)> = rows
        .iter()
        .filter(|row| row.shown)
        .map(|row| (row, computed(ui.ctx(), row.law)))
        .collect();
    let heights = shown.iter().flat_map(|(_, c)| c.points.iter().map(|p| p.y));
    let highest = heights.fold(1.0, f64::max);
    let top = highest * TOP;
    let plot = still_plot("curves")
        // The last number of the axis stands out by half its width.
        .width(width - 14.0)
        .height(height)
        .default_x_bounds(0.0, 90.0)
        .x_grid_spacer(|_| marks(90.0, 15.0))
        .y_grid_spacer(move |_| marks(top, if top > 2.0 { 1.0 } else { 0.25 }))
        .custom_x_axes(vec![
            AxisHints::new_x()
                .formatter(|mark, _| format!("{:.0}°", mark.value))
                .label_spacing(34.0..=44.0),
        ])
        .y_axis_formatter(|mark, _| match mark.value {
            // The corner belongs to the other axis.
            0.0 => String::new(),
            value => value.to_string(),
        })
        .grid_color(Color32::from_gray(70))
        .grid_spacing(8.0..=60.0)
        .label_formatter(|hover| match hover {
            HoverPosition::NearDataPoint {
                plot_name,
                position,
                ..
            } => Some(format!(
                "{plot_name}\n{:.1}°: {:.4}",
                position.x, position.y
            )),
            HoverPosition::Elsewhere { .. } => None,
        });
    plot.show(ui, |plot| {
        plot.set_plot_bounds_x(0.0..=90.0);
        plot.set_plot_bounds_y(0.0..=top);
        let faint = Color32::from_gray(150);
        let mut mark = |name: &str, angle_rad: f64, at: f64, color: Color32| {
            let angle = angle_rad.to_degrees();
            plot.vline(
                VLine::new(name, angle)
                    .stroke(Stroke::new(1.0, color))
                    .style(LineStyle::Dashed { length: 4.0 })
                    .allow_hover(false),
            );
            // The named angles at their right, the pointer's at its left, unless there is no room.
            let left = angle / 90.0 * f64::from(width);
            let right = f64::from(width) - left;
            let is_right = if name == POINTER {
                left < NAME_WIDTH
            } else {
                right > NAME_WIDTH + AXIS_WIDTH
            };
            let (anchor, text) = if is_right {
                (Align2::LEFT_CENTER, format!(" {name} {angle:.1}°"))
            } else {
                (Align2::RIGHT_CENTER, format!("{name} {angle:.1}° "))
            };
            let text = RichText::new(text).color(color);
            plot.text(
                Text::new(name, PlotPoint::new(angle, at * top), text)
                    .anchor(anchor)
                    .allow_hover(false),
            );
        };
        if let Some(eta) = eta {
            mark("Brewster", brewster_angle_rad(eta), 0.3, faint);
            if let Some(critical) = critical_angle_rad(eta) {
                mark("critical", critical, 0.8, theme::TEXEL);
            }
        }
        if let Some(angle) = incidence_rad {
            mark(POINTER, angle, 0.56, theme::PROBE);
        }
        for (row, computed) in shown {
            plot.line(
                Line::new(&row.name, PlotPoints::Owned(computed.points.clone()))
                    .color(row.color)
                    .width(row.width)
                    .style(row.style),
            );
        }
    });
}

/// Grid lines from 0 on; every second one is stronger.
fn marks(to: f64, step: f64) -> Vec<GridMark> {
    let count = (to / step).floor() as u32;
    (0..=count)
        .map(|i| GridMark {
            value: f64::from(i) * step,
            step_size: if i % 2 == 0 { 2.0 * step } else { step },
        })
        .collect()
}

/// What is computed once for each curve that is shown, and kept while it is.
struct Computed {
    points: Vec<PlotPoint>,
    largest: LargestError,
}

#[derive(Default)]
struct Computer;

impl ComputerMut<Key, Arc<Computed>> for Computer {
    fn compute(&mut self, Key(law): Key) -> Arc<Computed> {
        let points = law.curve(SAMPLES).into_iter();
        Arc::new(Computed {
            points: points
                .map(|[x, y]| PlotPoint::new(x.to_degrees(), y))
                .collect(),
            largest: law.largest_error(),
        })
    }
}

fn computed(ctx: &egui::Context, law: Law) -> Arc<Computed> {
    type Cache = FrameCache<Arc<Computed>, Computer>;
    ctx.memory_mut(|memory| Arc::clone(memory.caches.cache::<Cache>().get(Key(law))))
}

/// A law as a key: numbers count by their bits.
#[derive(Clone, Copy)]
struct Key(Law);

impl Hash for Key {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let mut numbers = |kind: u8, numbers: &[f64]| {
            kind.hash(state);
            numbers.iter().for_each(|x| x.to_bits().hash(state));
        };
        match self.0 {
            Law::Dielectric {
                formula,
                eta,
                shape,
            } => {
                numbers(
                    0,
                    &[eta, shape.exponent, shape.bias, shape.scale, shape.power],
                );
                formula.hash(state);
            }
            Law::Metal { index: [n, k] } => numbers(1, &[n, k]),
            Law::MetalSchlick {
                index: [n, k],
                exponent,
            } => numbers(2, &[n, k, exponent]),
        }
    }
}
