//! The chosen mappings over all criteria: a line for each, from the best of all mappings to the worst with a bound, with numbers.

use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, TextStyle, Ui, Vec2, pos2, vec2};
use egui_plot::MarkerShape;

use super::axis::Axis;
use super::entry::{Entry, NO_COST, NONE, TO_COME, corner, value_text};
use crate::app::laboratory::paint_marker;
use crate::app::model::Model;
use crate::app::narrow::{next_line_unless, text_width};
use crate::app::numbers::significant;
use crate::app::theme;
use crate::lab::ranking::Criterion;

/// Marks of the chosen, told apart by shape as well as by [`theme::SERIES`].
const SHAPES: [MarkerShape; 4] = [
    MarkerShape::Circle,
    MarkerShape::Diamond,
    MarkerShape::Square,
    MarkerShape::Up,
];
/// Widths of a criterion's name, and of a number.
const NAME: f32 = 84.0;
const NUMBER: f32 = 76.0;
/// From this width on both ends of a line have their numbers.
const WITH_ENDS: f32 = 560.0;
/// Least length of a line, and largest distance of two.
const LEAST_LINE: f32 = 90.0;
const MOST_HEIGHT: f32 = 30.0;
const LETTER: f32 = 11.5;
/// Height of the numbers below a line, width and height of a mark, and what lies between things.
const NUMBER_HEIGHT: f32 = LETTER + 3.0;
const MARK: f32 = 9.0;
const GAP: f32 = 6.0;
const QUIET: Color32 = Color32::from_gray(150);

/// The plot, `size` large.
pub fn compare_ui(ui: &mut Ui, model: &Model<'_>, entries: &[Entry<'_>], size: Vec2) {
    let of = |map| entries.iter().find(|entry| entry.map == map);
    let chosen: Vec<&Entry<'_>> = model
        .state
        .ranking
        .compared
        .iter()
        .filter_map(|m| of(*m))
        .collect();
    if chosen.is_empty() {
        ui.label("Tick up to four mappings in the table to compare them.");
        return;
    }
    let top = ui.cursor().top();
    legend_ui(ui, &chosen);
    let layout = Layout::new(ui, size - vec2(0.0, ui.cursor().top() - top), chosen.len());
    let (rect, line, height) = (layout.rect, layout.line, layout.height);
    let painter = ui.painter().clone();
    let words = |x: f32, y: f32, anchor: Align2, text: &str, color: Color32| {
        painter.text(
            pos2(x, y),
            anchor,
            text,
            FontId::proportional(LETTER),
            color,
        );
    };
    let head = rect.top() + 0.5 * height;
    words(line.left(), head, Align2::CENTER_CENTER, "best", QUIET);
    words(line.right(), head, Align2::RIGHT_CENTER, "worst", QUIET);
    if layout.is_beside() {
        for k in 0..chosen.len() {
            let at = pos2(layout.number(k, 0).0.x - 8.0, head);
            paint_marker(&painter, at, SHAPES[k % SHAPES.len()], theme::SERIES[k]);
        }
    }
    let number_ui = |ui: &Ui, k: usize, row: usize, what: &str, text: &str| {
        let (at, anchor) = layout.number(k, row);
        if !layout.is_beside() {
            let mark = at - vec2(0.5 * MARK + 2.0, 0.0);
            paint_marker(&painter, mark, SHAPES[k % SHAPES.len()], theme::SERIES[k]);
        }
        let font = FontId::proportional(LETTER);
        let place = painter.text(at, anchor, text, font, theme::SERIES[k]);
        let id = ui.scope_id().with(("compared number", row, k));
        let response = ui.interact(place, id, Sense::hover());
        let label = format!("{} by {what}: {text}", chosen[k].map.info().id);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &label));
        response
    };
    for (row, criterion) in Criterion::ALL.into_iter().enumerate() {
        let y = layout.middle(row);
        let id = ui.scope_id().with(("compare", row));
        let mut response = ui.interact(layout.reach(row), id, Sense::hover());
        let axis = Axis::over(criterion, entries);
        let told: Vec<String> = chosen
            .iter()
            .map(|entry| number(entry, criterion))
            .collect();
        let label = format!(
            "Compared by {}: {}",
            criterion.name(),
            whole_text(&chosen, criterion)
        );
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &label));
        words(
            rect.left(),
            y,
            Align2::LEFT_CENTER,
            criterion.name(),
            Color32::from_gray(225),
        );
        painter.hline(line.x_range(), y, Stroke::new(1.0, Color32::from_gray(70)));
        let mut hint = criterion.about().to_owned();
        if let Some(axis) = axis {
            let end = |value: f64| value_text(criterion, value);
            let [best, worst] = axis.ends.map(end);
            hint += &format!("\nBest of all {best}, worst with a bound {worst}.");
            if layout.has_ends {
                words(line.left() - 8.0, y, Align2::RIGHT_CENTER, &best, QUIET);
                words(line.right() + 8.0, y, Align2::LEFT_CENTER, &worst, QUIET);
            }
            if let Some(border) = axis.border() {
                let x = line.left() + border * line.width();
                painter.vline(x, y - 4.0..=y + 4.0, Stroke::new(1.0, QUIET));
            }
            if let Some(corner) = corner(criterion).filter(|c| axis.contains(c.bound)) {
                let x = line.left() + line.width() * axis.share(corner.bound, 0.0);
                let half = 0.5 * height;
                painter.vline(x, y - half..=y + half, Stroke::new(1.5, theme::TEXEL));
                let at = pos2(x + 7.0, y - 0.5 * half);
                let font = FontId::proportional(LETTER - 2.0);
                painter.text(at, Align2::LEFT_CENTER, corner.name, font, theme::TEXEL);
                hint += &format!("\n{}", corner.reason);
            }
            let place = |entry: &&Entry<'_>| {
                let share = axis.share(entry.value(criterion)?, 0.0);
                Some(line.left() + line.width() * share)
            };
            let places: Vec<Option<f32>> = chosen.iter().map(place).collect();
            for (k, x) in places.iter().enumerate().rev() {
                if let Some(x) = *x {
                    let at = pos2(x, y + lane(k, &places, height));
                    paint_marker(&painter, at, SHAPES[k % SHAPES.len()], theme::SERIES[k]);
                }
            }
        } else if criterion == Criterion::Cost {
            hint += &format!("\n{NO_COST}");
        }
        for (k, text) in told.iter().enumerate() {
            response |= number_ui(ui, k, row, criterion.name(), text);
        }
        response.on_hover_text(hint);
    }
    // No speed without its error.
    let last = Criterion::ALL.len();
    words(
        rect.left(),
        layout.middle(last),
        Align2::LEFT_CENTER,
        "its error",
        Color32::from_gray(225),
    );
    for (k, entry) in chosen.iter().enumerate() {
        let text = match entry.cost {
            Some(choice) => format!("{} texel", significant(choice.error_texels)),
            None => NONE.to_owned(),
        };
        number_ui(ui, k, last, "its error", &text);
    }
}

/// Where everything stands: the numbers at the right of the lines, or where that leaves no room for lines, below each.
struct Layout {
    rect: Rect,
    /// What the lines reach over, without the numbers at their ends.
    line: Rect,
    has_ends: bool,
    /// Height of a line.
    height: f32,
    /// Numbers in a row below a line; `None` where they stand beside it.
    in_row: Option<usize>,
    /// Height of the numbers below a line.
    below: f32,
    /// Where the numbers beside the lines begin.
    right: f32,
}

impl Layout {
    /// For `count` mappings in a space of that size: takes its width, and the height that is needed.
    fn new(ui: &mut Ui, size: Vec2, count: usize) -> Self {
        let numbers = NUMBER * count as f32 + GAP;
        let is_beside = size.x >= NAME + LEAST_LINE + numbers;
        let in_row = (!is_beside).then(|| (size.x / NUMBER).max(1.0) as usize);
        let below = in_row.map_or(0.0, |in_row| NUMBER_HEIGHT * count.div_ceil(in_row) as f32);
        // The head, the criteria and the cost's error.
        let criteria = Criterion::ALL.len() as f32;
        let height = (size.y - (criteria + 1.0) * below) / (criteria + 2.0);
        let height = height.clamp(LETTER + 4.0, MOST_HEIGHT);
        let all = height + (criteria + 1.0) * (height + below);
        let (rect, _) = ui.allocate_exact_size(vec2(size.x, all), Sense::hover());
        let right = rect.right() - if is_beside { numbers } else { GAP };
        let has_ends = is_beside && size.x >= WITH_ENDS;
        let ends = if has_ends { 48.0 } else { 8.0 };
        let line = Rect::from_x_y_ranges(rect.left() + NAME + ends..=right - ends, rect.y_range());
        Self {
            rect,
            line,
            has_ends,
            height,
            in_row,
            below,
            right,
        }
    }

    fn is_beside(&self) -> bool {
        self.in_row.is_none()
    }

    /// What belongs to a criterion.
    fn reach(&self, row: usize) -> Rect {
        let step = self.height + self.below;
        let top = self.rect.top() + self.height + row as f32 * step;
        Rect::from_x_y_ranges(self.rect.x_range(), top..=top + step)
    }

    /// Where a criterion's line lies.
    fn middle(&self, row: usize) -> f32 {
        self.reach(row).top() + 0.5 * self.height
    }

    /// Where the number of the `k`th mapping ends beside a line, or begins below it.
    fn number(&self, k: usize, row: usize) -> (egui::Pos2, Align2) {
        match self.in_row {
            None => {
                let x = self.right + NUMBER * (k as f32 + 1.0);
                (pos2(x, self.middle(row)), Align2::RIGHT_CENTER)
            }
            Some(in_row) => {
                let column = self.rect.width() / in_row as f32;
                let x = self.rect.left() + (k % in_row) as f32 * column + MARK + GAP;
                let lines = (k / in_row) as f32 + 0.5;
                let y = self.reach(row).top() + self.height + lines * NUMBER_HEIGHT;
                (pos2(x, y), Align2::LEFT_CENTER)
            }
        }
    }
}

/// How far below a criterion's line one of the marks at these places lies: those that would cover each other get a lane each, the
/// others lie on the line.
fn lane(k: usize, places: &[Option<f32>], height: f32) -> f32 {
    /// The share of the height between two lines that lanes take.
    const LANES: f32 = 0.85;
    let covers = |other: &Option<f32>| {
        let pair = places[k].zip(*other);
        pair.is_some_and(|(own, other)| (own - other).abs() < MARK)
    };
    let before = places[..k].iter().filter(|other| covers(other)).count() as f32;
    let count = places.iter().filter(|other| covers(other)).count() as f32;
    // Both end marks stay within the lanes where there is room.
    let room = (LANES * height - 0.5 * MARK).max(0.0);
    let step = MARK.min(room / (count - 1.0).max(1.0));
    (before - 0.5 * (count - 1.0).max(0.0)) * step
}

/// The chosen mappings' values, with all that belongs to them.
fn whole_text(chosen: &[&Entry<'_>], criterion: Criterion) -> String {
    let all: Vec<String> = chosen.iter().map(|entry| entry.text(criterion)).collect();
    all.join("; ")
}

/// A number as short as it can be; the cost's error has a line of its own.
fn number(entry: &Entry<'_>, criterion: Criterion) -> String {
    match entry.value(criterion) {
        Some(value) => value_text(criterion, value),
        None if criterion == Criterion::Cost => NONE.to_owned(),
        None => TO_COME.to_owned(),
    }
}

/// The chosen mappings with their marks.
fn legend_ui(ui: &mut Ui, chosen: &[&Entry<'_>]) {
    ui.horizontal_wrapped(|ui| {
        for (k, entry) in chosen.iter().enumerate() {
            const SIDE: f32 = 11.0;
            let id = entry.map.info().id;
            // The mark stays with its name.
            let gap = ui.spacing().item_spacing.x;
            next_line_unless(ui, SIDE + gap + text_width(ui, id, TextStyle::Body));
            let (rect, _) = ui.allocate_exact_size(Vec2::splat(SIDE), Sense::hover());
            let color = theme::SERIES[k];
            paint_marker(ui.painter(), rect.center(), SHAPES[k % SHAPES.len()], color);
            ui.colored_label(color, id);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_that_would_cover_each_other_get_lanes_and_the_others_lie_on_the_line() {
        let lanes = |places: &[Option<f32>], height: f32| -> Vec<f32> {
            (0..places.len()).map(|k| lane(k, places, height)).collect()
        };
        assert_eq!(
            lanes(&[Some(0.0), Some(50.0), None, Some(90.0)], 20.0),
            [0.0; 4]
        );
        // Two have room for the whole of both, four show a part of each; all within the line's height.
        assert_eq!(
            lanes(&[Some(1.0), Some(50.0), Some(2.0)], 20.0),
            [-4.5, 0.0, 4.5]
        );
        let four = lanes(&[Some(7.0); 4], 20.0);
        assert!(
            four.windows(2).all(|pair| pair[1] - pair[0] > 4.0),
            "{four:?}"
        );
        assert!(four.iter().all(|y| y.abs() < 10.0) && four.iter().sum::<f32>().abs() < 1e-4);
        // A chain, whose ends do not cover each other.
        let chain = lanes(&[Some(0.0), Some(8.0), Some(16.0)], 20.0);
        assert!(chain.is_sorted_by(|a, b| a < b), "{chain:?}");
    }
}
