//! Error over run time, both logarithmic, with the front.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, RichText, Sense, Stroke, Ui, Vec2, vec2};
use egui_plot::{AxisHints, GridMark, MarkerShape, PlotPoint, PlotTransform, Points};

use super::words::row_text;
use crate::app::action::Action;
use crate::app::model::Model;
use crate::app::plots::still_plot;
use crate::app::theme;
use crate::lab::bench::{CPU, Row};
use crate::lab::scatter::{LogAxis, costs, front_steps};
use crate::mapping::MappingId;

/// A measurement that is shown, and whether it is on the front of those.
pub type Shown<'a> = (&'a Row, bool);

/// Radius of a point on the front, and of another, in points.
const RADIUS: [f32; 2] = [4.5, 2.8];
/// Width of a mapping's name in the legend.
const NAME_WIDTH: f32 = 190.0;
/// Radius around a point within which the pointer is on it.
const REACH: f32 = 6.0;

/// A mapping's colour and marker: no two mappings have both alike.
pub fn look(map: &str) -> (Color32, MarkerShape) {
    const SHAPES: [MarkerShape; 5] = [
        MarkerShape::Circle,
        MarkerShape::Diamond,
        MarkerShape::Square,
        MarkerShape::Up,
        MarkerShape::Down,
    ];
    let place = MappingId::ALL.iter().position(|m| m.info().id == map);
    let place = place.unwrap_or(0);
    (
        theme::SERIES[place % theme::SERIES.len()],
        SHAPES[place % SHAPES.len()],
    )
}

/// The mappings with their colours, and which of them were not measured.
pub fn legend_ui(ui: &mut Ui, model: &Model<'_>, maps: &[MappingId]) {
    ui.scope(|ui| names_ui(ui, model, maps));
}

fn names_ui(ui: &mut Ui, model: &Model<'_>, maps: &[MappingId]) {
    let rows = model.labs.bench.rows();
    ui.spacing_mut().interact_size.y = 14.0;
    for line in maps.chunks((ui.available_width() / NAME_WIDTH).max(1.0) as usize) {
        ui.horizontal(|ui| {
            for map in line {
                let info = map.info();
                let (color, shape) = look(info.id);
                let (rect, _) = ui.allocate_exact_size(Vec2::splat(10.0), Sense::hover());
                paint_marker(ui.painter(), rect.center(), shape, color);
                let is_measured = rows.iter().any(|row| row.mapping == info.id);
                let text = if is_measured {
                    info.name.to_owned()
                } else {
                    format!("{} (not measured yet)", info.name)
                };
                let name = egui::Label::new(RichText::new(&text).small());
                ui.add(name.truncate()).on_hover_text(text);
            }
        });
    }
}

/// A marker as the plot draws it.
pub fn paint_marker(painter: &Painter, at: Pos2, shape: MarkerShape, color: Color32) {
    let r = RADIUS[0];
    let corners = |corners: &[[f32; 2]]| {
        let points = corners.iter().map(|[x, y]| at + r * vec2(*x, *y));
        egui::Shape::convex_polygon(points.collect(), color, Stroke::NONE)
    };
    // Corners of an equilateral triangle, the half and the whole of whose height lie about its middle.
    let side = 0.75_f32.sqrt();
    painter.add(match shape {
        MarkerShape::Diamond => corners(&[[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]),
        MarkerShape::Square => corners(&[[-0.7, -0.7], [0.7, -0.7], [0.7, 0.7], [-0.7, 0.7]]),
        MarkerShape::Up => corners(&[[0.0, -1.0], [side, 0.5], [-side, 0.5]]),
        MarkerShape::Down => corners(&[[0.0, 1.0], [-side, -0.5], [side, -0.5]]),
        _ => egui::Shape::circle_filled(at, r, color),
    });
}

/// True for what has a place on logarithmic axes.
fn has_place(row: &Row) -> bool {
    row.holes == 0 && row.ns > 0.0 && row.max_error_rad > 0.0
}

/// The plot of the rows that are shown; a click on a point uses its evaluator.
pub fn plot_ui(ui: &mut Ui, model: &mut Model<'_>, shown: &[Shown<'_>], size: Vec2) {
    let mut placed: Vec<Shown<'_>> = shown
        .iter()
        .copied()
        .filter(|(row, _)| has_place(row))
        .collect();
    // The front on top.
    placed.sort_by_key(|(_, is_on)| *is_on);
    if placed.is_empty() {
        ui.allocate_ui(size, |ui| {
            ui.label("nothing that is shown was measured: press Measure, or choose other inputs, threads or devices");
        });
        return;
    }
    let time = LogAxis::over(placed.iter().map(|(row, _)| row.ns));
    let error = LogAxis::over(placed.iter().map(|(row, _)| row.max_error_rad));
    let plot = still_plot("run time and error")
        .width(size.x - 14.0)
        .height(size.y)
        .x_grid_spacer(move |_| marks(time))
        .y_grid_spacer(move |_| marks(error))
        .grid_spacing(8.0..=60.0)
        .grid_color(Color32::from_gray(70))
        .custom_x_axes(vec![
            AxisHints::new_x()
                .label(RichText::new("run time, ns a direction").small())
                .formatter(|mark, _| power_text(mark.value))
                .label_spacing(22.0..=30.0),
        ])
        .custom_y_axes(vec![
            AxisHints::new_y()
                .label(RichText::new("largest error, rad").small())
                .formatter(|mark, _| power_text(mark.value))
                .label_spacing(12.0..=18.0),
        ])
        .label_formatter(|_| None);
    let maps = maps_of(&placed);
    let response = plot.show(ui, |plot| {
        plot.set_plot_bounds_x(time.low..=time.high);
        plot.set_plot_bounds_y(error.low..=error.high);
        for map in &maps {
            let (color, shape) = look(map);
            let own = || placed.iter().filter(|(row, _)| row.mapping == *map);
            for (is_on, radius) in [(false, RADIUS[1]), (true, RADIUS[0])] {
                let points = own().filter(|shown| shown.1 == is_on);
                let points: Vec<[f64; 2]> = points.map(|(row, _)| place(row)).collect();
                plot.points(
                    Points::new(format!("{map} {is_on}"), points)
                        .shape(shape)
                        .radius(radius)
                        .filled(is_on)
                        .color(color),
                );
            }
        }
    });
    let transform = response.transform;
    let painter = ui.painter_at(*transform.frame());
    for map in maps {
        for is_processor in [true, false] {
            let of_device = |(row, _): &&Shown<'_>| (row.device == CPU) == is_processor;
            let own: Vec<Shown<'_>> = placed.iter().filter(of_device).copied().collect();
            paint_front(&painter, map, &own, &transform);
        }
    }
    points_ui(ui, model, &placed, &transform);
    paint_names(&painter, &placed, &transform);
}

/// A mapping's front as a stair; the plot's own lines grow thick at corners that are close together.
fn paint_front(painter: &Painter, map: &str, placed: &[Shown<'_>], transform: &PlotTransform) {
    let front = placed
        .iter()
        .filter(|(row, is_on)| *is_on && row.mapping == map);
    let mut front: Vec<&Row> = front.map(|(row, _)| *row).collect();
    front.sort_by(|a, b| a.ns.total_cmp(&b.ns));
    let corners = front_steps(&costs(&front)).into_iter();
    let corners = corners.map(|at| {
        let [x, y] = at.map(f64::log10);
        transform.position_from_point(&PlotPoint::new(x, y))
    });
    let corners: Vec<Pos2> = corners.collect();
    let stroke = Stroke::new(1.2, look(map).0);
    for pair in corners.windows(2) {
        painter.line_segment([pair[0], pair[1]], stroke);
    }
}

/// The mappings of the rows, each once.
fn maps_of(shown: &[Shown<'_>]) -> Vec<&'static str> {
    let mut maps: Vec<&'static str> = shown.iter().map(|(row, _)| row.mapping).collect();
    maps.sort_unstable();
    maps.dedup();
    maps
}

fn place(row: &Row) -> [f64; 2] {
    [row.ns.log10(), row.max_error_rad.log10()]
}

fn marks(axis: LogAxis) -> Vec<GridMark> {
    let mark = |value: f64| {
        let value = value.log10();
        let is_power = (value - value.round()).abs() < 1e-9;
        GridMark {
            value,
            step_size: if is_power { 1.0 } else { 0.3 },
        }
    };
    axis.marks().into_iter().map(mark).collect()
}

/// The number whose decimal logarithm this is: "0.5", "20", "1e-5".
fn power_text(exponent: f64) -> String {
    let value = 10_f64.powf(exponent);
    if (-2.1..4.0).contains(&exponent) {
        // 1, 2 and 5 times a power of ten have one digit that counts.
        let places = (-exponent.floor()).max(0.0) as usize;
        format!("{value:.places$}")
    } else {
        format!("{value:.0e}")
    }
}

/// Each point's numbers under the pointer; a click uses its evaluator.
fn points_ui(ui: &mut Ui, model: &mut Model<'_>, placed: &[Shown<'_>], transform: &PlotTransform) {
    let used = model.used;
    for (k, (row, _)) in placed.iter().enumerate() {
        let [x, y] = place(row);
        let at = transform.position_from_point(&PlotPoint::new(x, y));
        let rect = Rect::from_center_size(at, Vec2::splat(2.0 * REACH));
        let response = ui.interact(rect, ui.scope_id().with(("point", k)), Sense::click());
        let text = |model: &Model<'_>| {
            let map = MappingId::ALL
                .iter()
                .find(|map| map.info().id == row.mapping);
            let height = map.map_or(row.texels, |map| model.map_size(*map)[1]);
            row_text(row, model.labs.bench.rows(), height)
        };
        response.widget_info(|| {
            let name = format!("Point: {}", text(model));
            egui::WidgetInfo::labeled(egui::Role::Button, true, name)
        });
        if response.clicked() {
            use_evaluator(model, row);
        }
        let is_used = used.is_some_and(|used| {
            let is_it = |choice: &crate::lab::choice::Choice<'_>| {
                (choice.row.mapping, choice.row.evaluator) == (row.mapping, row.evaluator)
            };
            used.measured.as_ref().is_some_and(is_it)
        });
        let painter = ui.painter();
        if is_used {
            painter.circle_stroke(at, RADIUS[0] + 4.0, Stroke::new(2.0, theme::PROBE));
        }
        if response.hovered() {
            painter.circle_stroke(at, RADIUS[0] + 2.0, Stroke::new(1.0, theme::PROBE));
            egui::Tooltip::for_widget(&response)
                .at_pointer()
                .show(|ui| ui.label(text(model)));
        }
    }
}

/// The row's mapping is looked up by its evaluator.
pub fn use_evaluator(model: &mut Model<'_>, row: &Row) {
    let map = MappingId::ALL
        .iter()
        .find(|map| map.info().id == row.mapping);
    if let Some(map) = map {
        model.push(Action::UseEvaluator(*map, row.evaluator.to_owned()));
    }
}

/// Names of the front's points, each where it covers no point of the front and no other name; where there is no such place the
/// pointer tells it.
fn paint_names(painter: &Painter, placed: &[Shown<'_>], transform: &PlotTransform) {
    let front = placed.iter().filter(|(_, is_on)| *is_on);
    let front: Vec<&Row> = front.map(|(row, _)| *row).collect();
    let at = |row: &Row| {
        let [x, y] = place(row);
        transform.position_from_point(&PlotPoint::new(x, y))
    };
    let mut taken: Vec<Rect> = front
        .iter()
        .map(|row| Rect::from_center_size(at(row), Vec2::splat(2.0 * RADIUS[0])))
        .collect();
    for row in front {
        let (color, _) = look(row.mapping);
        let font = FontId::proportional(11.0);
        let galley = painter.layout_no_wrap(row.evaluator.to_owned(), font, color);
        if let Some(rect) = free_place(at(row), galley.size(), *transform.frame(), &taken) {
            painter.galley(rect.min, galley, color);
            taken.push(rect);
        }
    }
}

/// A place for a name of that size beside a point: at its right first.
pub fn free_place(at: Pos2, size: Vec2, frame: Rect, taken: &[Rect]) -> Option<Rect> {
    let gap = RADIUS[0] + 2.0;
    let places = [
        (Align2::LEFT_CENTER, vec2(gap, 0.0)),
        (Align2::LEFT_BOTTOM, vec2(gap, -2.0)),
        (Align2::LEFT_TOP, vec2(gap, 2.0)),
        (Align2::CENTER_BOTTOM, vec2(0.0, -gap)),
        (Align2::CENTER_TOP, vec2(0.0, gap)),
        (Align2::RIGHT_TOP, vec2(-gap, 2.0)),
        (Align2::RIGHT_CENTER, vec2(-gap, 0.0)),
        (Align2::RIGHT_BOTTOM, vec2(-gap, -2.0)),
    ];
    places
        .into_iter()
        .map(|(anchor, offset)| anchor.anchor_size(at + offset, size))
        .find(|rect| frame.contains_rect(*rect) && !taken.iter().any(|t| t.intersects(*rect)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_mappings_look_alike() {
        let looks: Vec<_> = MappingId::ALL.iter().map(|m| look(m.info().id)).collect();
        for (k, own) in looks.iter().enumerate() {
            assert!(!looks[..k].contains(own), "{}", MappingId::ALL[k]);
        }
    }

    #[test]
    fn marks_are_told_as_they_are_read() {
        for (value, text) in [
            (0.02, "0.02"),
            (0.5, "0.5"),
            (1.0, "1"),
            (20.0, "20"),
            (5000.0, "5000"),
            (1e-7, "1e-7"),
        ] {
            assert_eq!(power_text(f64::log10(value)), text);
        }
    }

    #[test]
    fn names_cover_neither_each_other_nor_points_and_stay_inside() {
        let frame = Rect::from_min_size(Pos2::ZERO, vec2(200.0, 100.0));
        let size = vec2(40.0, 12.0);
        let mut taken = Vec::new();
        for k in 0..60 {
            // All in a corner: there is no room for most.
            let at = Pos2::new(190.0 - (k % 8) as f32, 50.0 + (k / 8) as f32);
            if let Some(rect) = free_place(at, size, frame, &taken) {
                assert!(frame.contains_rect(rect));
                assert!(!taken.iter().any(|t: &Rect| t.intersects(rect)));
                taken.push(rect);
            }
        }
        assert!(taken.len() > 1 && taken.len() < 60, "{}", taken.len());
        assert!(free_place(Pos2::new(500.0, 50.0), size, frame, &[]).is_none());
    }
}
