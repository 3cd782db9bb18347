//! The wheel over a picture.

use egui::{Response, Ui};

/// Logarithm of the factor by which a point of scrolling zooms a map.
pub const ZOOM_PER_POINT: f32 = 0.005;

/// The factor by which the wheel zooms what lies under the pointer, above 1 nearer; `None` while it stands still. `per_point` is
/// the factor's logarithm a point, so that as far there and back is no change.
pub fn wheel_zoom(ui: &Ui, response: &Response, per_point: f32) -> Option<f32> {
    let scroll = ui.input(|i| i.smooth_scroll_delta.y);
    (response.contains_pointer() && scroll != 0.0).then(|| (scroll * per_point).exp())
}
