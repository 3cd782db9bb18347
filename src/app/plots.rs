//! Plots of curves and points.

use egui::Sense;
use egui_plot::Plot;

/// A plot that shows all that it has: it is neither moved nor magnified.
pub fn still_plot<'a>(name: &'static str) -> Plot<'a> {
    Plot::new(name)
        .allow_zoom(false)
        .allow_drag(false)
        .allow_scroll(false)
        .allow_axis_zoom_drag(false)
        .allow_boxed_zoom(false)
        .allow_double_click_reset(false)
        .sense(Sense::hover())
        .show_crosshair(false)
}
