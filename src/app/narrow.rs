//! What stays within a pane however narrow it is: sliders, names of lists, and a picture below controls.

use egui::text::LayoutJob;
use egui::{FontSelection, Id, Rect, Response, Slider, Ui, UiBuilder, pos2};

use super::theme;

/// Shortest rail on which a value can still be found by hand, in points.
const SHORTEST_RAIL: f32 = 60.0;

/// A slider named by `name`, its rail as long as the style has it or as the rest of its line allows; in a wrapped layout it gets a line of its
/// own where less than the shortest rail is left. `widest` is the longest text of its number, empty where none is shown. A slider does not tell its size before it is placed,
/// so no layout would wrap it, and it would widen its pane.
pub fn slider_ui(ui: &mut Ui, slider: Slider<'_>, name: Id, widest: &str) -> Response {
    let number = if widest.is_empty() {
        0.0
    } else {
        let style = ui.style().drag_value_text_style.clone();
        let padding = 2.0 * ui.spacing().button_padding.x;
        let text = text_width(ui, widest, style) + padding;
        text.max(ui.spacing().interact_size.x) + ui.spacing().item_spacing.x
    };
    let left = next_line_unless(ui, SHORTEST_RAIL + number) - number;
    let rail = &mut ui.spacing_mut().slider_width;
    *rail = rail.min(left.max(1.0));
    ui.add(slider).labelled_by(name)
}

/// Ends a line of a wrapped layout that has less room than `width`, in points. Gives back the room of the line that goes on or begins.
pub fn next_line_unless(ui: &mut Ui, width: f32) -> f32 {
    let left = ui.available_size_before_wrap().x;
    let begins = left > ui.available_width() - 1.0;
    if left >= width || begins || !ui.layout().main_wrap() {
        return left;
    }
    ui.end_row();
    ui.available_size_before_wrap().x
}

/// Width of a text on one line, in points.
pub fn text_width(ui: &Ui, text: &str, font: impl Into<FontSelection>) -> f32 {
    let font = font.into().resolve(ui.style());
    let job = LayoutJob::simple_singleline(text.to_owned(), font, egui::Color32::WHITE);
    ui.fonts_mut(|fonts| fonts.layout_job(job)).size().x
}

/// A pane with controls above a picture. The picture has the width that the pane has, whatever the controls take.
pub fn picture_pane<T>(
    ui: &mut Ui,
    shown: &mut T,
    controls: impl FnOnce(&mut Ui, &mut T),
    picture: impl FnOnce(&mut Ui, &mut T),
) {
    theme::pane_frame(ui).show(ui, |ui| {
        let pane = ui.available_rect_before_wrap();
        controls(ui, shown);
        let top = ui.cursor().top().min(pane.bottom());
        let room = Rect::from_min_max(pos2(pane.left(), top), pane.max);
        ui.scope_builder(UiBuilder::new().max_rect(room), |ui| picture(ui, shown));
    });
}
