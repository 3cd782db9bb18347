//! The microscope's picture with what one needs to read it: scale bar, legend, counts.

use egui::{
    Align2, Color32, PointerButton, Pos2, Rect, Response, RichText, Sense, Ui, Vec2, pos2, vec2,
};

use super::action::Action;
use super::marks::{colour_bar, edged_line, edged_text, ring};
use super::model::Model;
use super::stability::Shown;
use super::state::StabilityState;
use super::theme;
use super::wheel::{ZOOM_PER_POINT, wheel_zoom};
use crate::lab::stress::microscope::{Picture, Pixel, Verdict, View};
use crate::lab::stress::palette::{SCALE_RAD, colour, colour_at, place_of};
use crate::math::Isa;

/// Below this height the legend is left out for the picture.
const LEAST_PICTURE: f32 = 60.0;
/// Most pixels of a picture: a larger pane shows each twice as large.
const MOST_PIXELS: f32 = (1 << 20) as f32;

/// Shows the microscope in all the space there is.
pub fn microscope_ui(ui: &mut Ui, model: &mut Model<'_>) {
    let Some(whole) = theme::picture_room(ui) else {
        return;
    };
    theme::paint_ground(ui.painter(), whole);
    let below = legend_height(whole.width());
    let has_legend = whole.height() >= LEAST_PICTURE + below;
    let mut rect = whole;
    if has_legend {
        rect.max.y -= below;
    }
    picture_ui(ui, model, rect);
    if has_legend {
        let place = Rect::from_min_max(pos2(whole.left(), rect.bottom()), whole.max).shrink(3.0);
        let mut legend = ui.new_child(egui::UiBuilder::new().max_rect(place));
        legend.set_clip_rect(place.intersect(ui.clip_rect()));
        if let Some(shown) = model.labs.stability.shown() {
            legend_ui(&mut legend, &shown.picture);
        }
    }
    ui.advance_cursor_after_rect(whole);
}

/// Room for the legend below a picture of this width: its words fill two lines, or more.
fn legend_height(width: f32) -> f32 {
    const LINE: f32 = 17.0;
    let lines = match width {
        width if width >= 560.0 => 2.0,
        width if width >= 330.0 => 3.0,
        _ => 4.0,
    };
    lines * LINE + 6.0
}

fn picture_ui(ui: &mut Ui, model: &mut Model<'_>, rect: Rect) {
    let response = ui.interact(
        rect,
        ui.scope_id().with("microscope"),
        Sense::click_and_drag(),
    );
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Microscope"));
    let pixels = rect.size() * ui.ctx().pixels_per_point();
    let coarser = (pixels.x * pixels.y / MOST_PIXELS).sqrt().max(1.0);
    let side = |length: f32| (length / coarser).round().max(1.0) as usize;
    let size = [side(pixels.x), side(pixels.y)];
    model.microscope_px = Some(size);
    let view = model.state.stability.view(model.state.mapping, size);
    pointer(ui, model, &view, rect, &response);
    let painter = ui.painter_at(rect);
    let labs = model.labs;
    let Some(shown) = labs.stability.shown() else {
        let text = "looking …";
        edged_text(
            &painter,
            rect.center(),
            Align2::CENTER_CENTER,
            text,
            theme::PROBE,
        );
        return;
    };
    paint_picture(&painter, shown, &view, rect);
    let on_screen = |place: [f64; 2]| {
        let share = [0, 1].map(|k: usize| (place[k] / size[k] as f64) as f32);
        rect.min + vec2(share[0], share[1]) * rect.size()
    };
    if model.state.overlays.probe
        && let Some(place) = view.place(model.state.probe.map(f64::from))
        && rect.expand(20.0).contains(on_screen(place))
    {
        // Its cross would hide what is as small as a hole of one direction.
        ring(&painter, on_screen(place), theme::PROBE);
    }
    paint_scale_bar(&painter, &view, rect);
    let words = format!("{} by {}", view.map, view.evaluator);
    let at = rect.left_top() + vec2(6.0, 5.0);
    edged_text(&painter, at, Align2::LEFT_TOP, &words, theme::PROBE);
    if let Some(pixel) = hovered(&shown.picture, &view, rect, &response) {
        let text = pixel_text(pixel);
        response.on_hover_text_at_pointer(RichText::new(text).monospace());
    }
}

/// The last picture where it belongs: a view that is still being looked at shows the old one moved and magnified.
fn paint_picture(painter: &egui::Painter, shown: &Shown, view: &View, rect: Rect) {
    let old = &shown.picture.view;
    if (old.map, old.evaluator) != (view.map, view.evaluator) {
        return;
    }
    let Some(middle) = view.place(old.center) else {
        return;
    };
    let scale = old.pitch() / view.pitch();
    let points = rect.width() / view.size[0] as f32;
    let half = [0, 1].map(|k: usize| 0.5 * old.size[k] as f64 * scale);
    // Far outside of the screen nothing is seen, and f32 would lose its digits.
    const FAR: f64 = 1e6;
    let corner = |sign: f64| {
        let at = [0, 1].map(|k: usize| (middle[k] + sign * half[k]).clamp(-FAR, FAR) as f32);
        rect.min + vec2(at[0], at[1]) * points
    };
    let place = Rect::from_min_max(corner(-1.0), corner(1.0));
    let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
    painter.image(shown.texture.id(), place, whole, Color32::WHITE);
}

/// Drags pan, the wheel zooms, a click puts the probe there.
fn pointer(ui: &Ui, model: &mut Model<'_>, view: &View, rect: Rect, response: &Response) {
    let pixels = |v: Vec2| {
        let scale = view.size[0] as f32 / rect.width();
        [v.x * scale, v.y * scale].map(f64::from)
    };
    let set = |model: &mut Model<'_>, view: View| {
        let stability = StabilityState {
            center: view.center,
            span_deg: view.span_deg,
            ..model.state.stability.clone()
        };
        model.push(Action::SetStability(Box::new(stability)));
    };
    let is_drag = response.dragged_by(PointerButton::Primary)
        || response.dragged_by(PointerButton::Secondary)
        || response.dragged_by(PointerButton::Middle);
    if is_drag {
        set(model, view.panned(pixels(response.drag_delta())));
        return;
    }
    let Some(pos) = response.hover_pos().or(response.interact_pointer_pos()) else {
        return;
    };
    if let Some(factor) = wheel_zoom(ui, response, ZOOM_PER_POINT) {
        set(model, view.zoomed(factor.into(), pixels(pos - rect.min)));
    }
    if response.clicked() {
        let dir = view.directions()(pixels(pos - rect.min));
        model.keep_probe(dir);
    }
}

/// The pixel under the pointer, if it is that of the view.
fn hovered<'a>(
    picture: &'a Picture,
    view: &View,
    rect: Rect,
    response: &Response,
) -> Option<&'a Pixel> {
    let pos = response.hover_pos().filter(|_| picture.view == *view)?;
    let share = (pos - rect.min) / rect.size();
    let index = |share: f32, n: usize| (share.max(0.0) * n as f32) as usize;
    picture.at([index(share.x, view.size[0]), index(share.y, view.size[1])])
}

fn pixel_text(pixel: &Pixel) -> String {
    let has_error = matches!(
        pixel.verdict,
        Verdict::WrongChart | Verdict::OutOfRange | Verdict::TooFar | Verdict::Right
    );
    let error = if has_error {
        format!(", error {:.2e} rad", pixel.error_rad)
    } else {
        String::new()
    };
    format!(
        "{}{error}\n{}",
        pixel.verdict.name(),
        vector_text(pixel.dir)
    )
}

/// The components as bits and as decimals.
pub(super) fn vector_text(dir: [f32; 3]) -> String {
    let names = ["x", "y", "z"];
    let line = |k: usize| format!("{} 0x{:08x} = {:e}", names[k], dir[k].to_bits(), dir[k]);
    [line(0), line(1), line(2)].join("\n")
}

/// A bar of a round number of degrees, at most a third of the picture; it holds in the middle.
fn paint_scale_bar(painter: &egui::Painter, view: &View, rect: Rect) {
    let pixels = |points: f64| points * view.size[0] as f64 / f64::from(rect.width());
    // In the middle an angle spans twice the tangent of its half.
    let third = pixels(f64::from(rect.width()) / 3.0) * view.pitch();
    let deg = round_below(2.0 * (0.5 * third).atan().to_degrees());
    let length = 2.0 * (0.5 * deg.to_radians()).tan() / view.pitch() / pixels(1.0);
    let length = length as f32;
    let left = rect.left_bottom() + vec2(8.0, -10.0);
    let right = left + vec2(length, 0.0);
    for end in [left, right] {
        edged_line(
            painter,
            vec![end - vec2(0.0, 4.0), end + vec2(0.0, 4.0)],
            1.5,
            theme::PROBE,
        );
    }
    edged_line(painter, vec![left, right], 1.5, theme::PROBE);
    let text = format!("{}  ({:.1e} rad)", degrees_text(deg), deg.to_radians());
    let at = left - vec2(0.0, 6.0);
    edged_text(painter, at, Align2::LEFT_BOTTOM, &text, theme::PROBE);
}

/// The largest of 1, 2 and 5 times a power of ten that is not above a positive number.
fn round_below(x: f64) -> f64 {
    let power = 10f64.powf(x.log10().floor());
    let step = [5.0, 2.0].into_iter().find(|step| step * power <= x);
    step.unwrap_or(1.0) * power
}

/// Degrees with the digits that count.
pub(super) fn degrees_text(deg: f64) -> String {
    let places = (1 - deg.log10().floor() as i32).max(0) as usize;
    let text = format!("{deg:.places$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    format!("{text}°")
}

/// What the colours mean, and how many pixels have each.
fn legend_ui(ui: &mut Ui, picture: &Picture) {
    ui.spacing_mut().item_spacing = vec2(8.0, 2.0);
    ui.horizontal_wrapped(|ui| {
        let kinds = [
            Verdict::Hole,
            Verdict::NotFinite,
            Verdict::WrongChart,
            Verdict::OutOfRange,
            Verdict::Uncovered,
        ];
        for kind in kinds {
            let count = picture.count(kind);
            if count > 0 || kind == Verdict::Hole {
                chip(ui, colour(kind, 0.0));
                ui.label(RichText::new(count_text(picture, kind.name(), count)).small());
            }
        }
    });
    // On a line of its own, so that the scale keeps its ends.
    ui.horizontal_wrapped(|ui| {
        scale_ui(ui, picture.allowed_rad);
        let over = picture.count(Verdict::TooFar);
        let largest = format!(
            "largest error {:.1e}, allowed {:.1e} rad",
            picture.largest_error_rad, picture.allowed_rad
        );
        let largest = match over {
            0 => largest,
            over => format!("{largest}; over it {over}"),
        };
        ui.label(RichText::new(largest).small());
        ui.label(RichText::new(way_text(&picture.view)).small());
    });
}

fn count_text(picture: &Picture, name: &str, count: usize) -> String {
    let share = 100.0 * count as f64 / picture.pixels.len().max(1) as f64;
    match count {
        0 => format!("{name}: none"),
        _ if share < 0.1 => format!("{name}: {count} pixels"),
        _ => format!("{name}: {count} pixels, {share:.1} %"),
    }
}

/// How the evaluator was run.
fn way_text(view: &View) -> String {
    match view.map.processor(view.evaluator) {
        None => "computed by a shader".to_owned(),
        Some(processor) if processor.is_vector => {
            format!("computed on {} vectors", Isa::best().id())
        }
        Some(_) => "computed one by one".to_owned(),
    }
}

fn chip(ui: &mut Ui, [r, g, b]: [u8; 3]) {
    let (rect, _) = ui.allocate_exact_size(vec2(10.0, 10.0), Sense::hover());
    ui.painter()
        .rect_filled(rect, 1.0, Color32::from_rgb(r, g, b));
    let stroke = egui::Stroke::new(1.0, Color32::from_gray(150));
    ui.painter()
        .rect_stroke(rect, 1.0, stroke, egui::StrokeKind::Outside);
}

/// The scale of errors with its ends, and a mark at what is allowed.
fn scale_ui(ui: &mut Ui, allowed_rad: f64) {
    let end = |rad: f64| RichText::new(format!("{rad:.0e}")).small();
    ui.label(end(SCALE_RAD[0]));
    let (rect, response) = ui.allocate_exact_size(vec2(110.0, 10.0), Sense::hover());
    colour_bar(ui.painter(), rect, |place| {
        let [r, g, b] = colour_at(f64::from(place));
        Color32::from_rgb(r, g, b)
    });
    let x = rect.left() + place_of(allowed_rad) as f32 * rect.width();
    let mark = vec![pos2(x, rect.top() - 2.0), pos2(x, rect.bottom() + 2.0)];
    edged_line(ui.painter(), mark, 1.5, theme::PROBE);
    response.on_hover_text("The error in radians; the mark is what is allowed");
    ui.label(RichText::new(format!("{:.0} rad", SCALE_RAD[1])).small());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_bar_is_round() {
        for (x, round) in [
            (0.037, 0.02),
            (9.99, 5.0),
            (1.0, 1.0),
            (30.0, 20.0),
            (2.1e-5, 2e-5),
        ] {
            assert!((round_below(x) / round - 1.0).abs() < 1e-12, "{x}");
        }
    }

    #[test]
    fn degrees_keep_the_digits_that_count() {
        for (deg, text) in [
            (0.02, "0.02°"),
            (90.0, "90°"),
            (5e-5, "0.00005°"),
            (0.126, "0.13°"),
        ] {
            assert_eq!(degrees_text(deg), text);
        }
    }
}
