//! Colours and sizes of the window.

use egui::{Color32, FontId, Stroke, TextStyle, Visuals};

use crate::lab::stress::palette::between;

/// Background of the panels' pictures: dark and neutral, so that colours are judged against grey.
pub const PICTURE_BACKGROUND: [u8; 3] = [24, 24, 27];
/// The probe and its marks.
pub const PROBE: Color32 = Color32::from_rgb(255, 255, 255);
/// Around the probe's marks, so that they are seen on white too.
pub const PROBE_EDGE: Color32 = Color32::from_rgb(0, 0, 0);
/// The texel's footprint: Okabe and Ito's yellow, told from white by every kind of colour vision on a dark edge.
pub const TEXEL: Color32 = Color32::from_rgb(240, 228, 66);
/// The incident, normal and reflected vectors: Okabe and Ito's orange, sky blue and bluish green.
pub const VECTORS: [Color32; 3] = [
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(0, 200, 140),
];
/// The refracted vector: their reddish purple, a little lighter.
pub const REFRACTED: Color32 = Color32::from_rgb(222, 140, 186);
/// The x, y and z axes: the colours that such axes have everywhere, light enough for a dark ground.
pub const AXES: [Color32; 3] = [
    Color32::from_rgb(255, 110, 90),
    Color32::from_rgb(120, 220, 110),
    Color32::from_rgb(110, 160, 255),
];
/// The lit row of the sign table.
pub const LIT: Color32 = Color32::from_rgb(0, 92, 140);

/// A pane that shows text: the pictures' ground, with a margin, over all the space there is.
pub fn pane_frame(ui: &mut egui::Ui) -> egui::Frame {
    paint_ground(ui.painter(), ui.available_rect_before_wrap());
    egui::Frame::new().inner_margin(6.0)
}

/// The room for a picture; `None` where there is none.
pub fn picture_room(ui: &egui::Ui) -> Option<egui::Rect> {
    let rect = ui.available_rect_before_wrap();
    (rect.width() >= 1.0 && rect.height() >= 1.0).then_some(rect)
}

/// Takes all the room there is for a picture of that name.
pub fn picture_ui(ui: &mut egui::Ui, name: &str, sense: egui::Sense) -> Option<egui::Response> {
    let rect = picture_room(ui)?;
    let response = ui.allocate_rect(rect, sense);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, name));
    Some(response)
}

/// What lies behind pictures that do not fill their place.
pub fn paint_ground(painter: &egui::Painter, rect: egui::Rect) {
    let [r, g, b] = PICTURE_BACKGROUND;
    painter.rect_filled(rect, 0.0, Color32::from_rgb(r, g, b));
}

/// A pane of text that scrolls: down where it is long, sideways below a width. `content` is told the pane's height.
pub fn scrolled_pane(
    ui: &mut egui::Ui,
    least_width: f32,
    content: impl FnOnce(&mut egui::Ui, f32),
) {
    pane_frame(ui).show(ui, |ui| {
        let size = ui.available_size();
        let scroll = egui::ScrollArea::both().auto_shrink([false, false]);
        scroll.show(ui, |ui| {
            ui.set_max_width(size.x.max(least_width) - ui.spacing().scroll.allocated_width());
            content(ui, size.y);
        });
    });
}

/// Sets fonts and colours of a fresh context.
pub fn install(ctx: &egui::Context) {
    ctx.set_theme(egui::Theme::Dark);
    ctx.all_styles_mut(|style| {
        style
            .text_styles
            .insert(TextStyle::Body, FontId::proportional(13.5));
        style
            .text_styles
            .insert(TextStyle::Button, FontId::proportional(13.5));
        style
            .text_styles
            .insert(TextStyle::Small, FontId::proportional(11.0));
        style
            .text_styles
            .insert(TextStyle::Heading, FontId::proportional(16.0));
        style
            .text_styles
            .insert(TextStyle::Monospace, FontId::monospace(12.5));
        style.spacing.item_spacing = egui::vec2(6.0, 4.0);
        // Nothing fades: a fade would draw frames in a still window.
        style.animation_time = 0.0;
        // Nor does the text cursor blink.
        style.visuals.text_cursor.blink = false;
    });
    ctx.style_mut_of(egui::Theme::Dark, |style| {
        let mut visuals = Visuals::dark();
        visuals.text_cursor.blink = false;
        visuals.override_text_color = Some(Color32::from_gray(225));
        visuals.widgets.noninteractive.bg_stroke = Stroke::new(1.0, Color32::from_gray(55));
        style.visuals = visuals;
    });
}

/// Where an evaluator has no result: no colour of [`scale`].
pub const HOLE: Color32 = Color32::from_rgb(235, 60, 60);

/// A colour for a share of the largest value, in [0, 1]: viridis (Smith and van der Walt 2015, CC0), whose lightness grows evenly
/// and which is read with every kind of colour vision; eight straight pieces of it.
pub fn scale(share: f32) -> Color32 {
    const VIRIDIS: [[u8; 3]; 9] = [
        [68, 1, 84],
        [71, 44, 122],
        [59, 81, 139],
        [44, 113, 142],
        [33, 144, 141],
        [39, 173, 129],
        [92, 200, 99],
        [170, 220, 50],
        [253, 231, 37],
    ];
    // What is no number is beyond every number.
    let share = if share.is_finite() { share } else { 1.0 };
    let [r, g, b] = between(&VIRIDIS, f64::from(share));
    Color32::from_rgb(r, g, b)
}

/// Colours of series that are told apart by their markers' shapes, too: Okabe and Ito's, the dark blue lightened.
pub const SERIES: [Color32; 7] = [
    VECTORS[0],
    VECTORS[1],
    VECTORS[2],
    TEXEL,
    Color32::from_rgb(235, 110, 40),
    REFRACTED,
    Color32::from_rgb(110, 150, 255),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_grows_lighter_from_end_to_end() {
        let light = |share: f32| {
            let [r, g, b, _] = scale(share).to_array().map(f32::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let steps: Vec<f32> = (0..=64).map(|k| light(k as f32 / 64.0)).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(scale(f32::NAN), scale(1.0));
        assert_eq!(scale(-1.0), scale(0.0));
    }
}
