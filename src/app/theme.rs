//! Colours and sizes of the window.

use egui::{Color32, FontId, Stroke, TextStyle, Visuals};

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
    let [r, g, b] = PICTURE_BACKGROUND;
    let ground = Color32::from_rgb(r, g, b);
    ui.painter()
        .rect_filled(ui.available_rect_before_wrap(), 0.0, ground);
    egui::Frame::new().inner_margin(6.0)
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
