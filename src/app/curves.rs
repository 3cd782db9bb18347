//! Reflectance over the angle of incidence: the approximations beside the exact curve.

use egui::Ui;

use super::model::Model;

/// Shows the curves in all the space there is.
pub fn curves_ui(ui: &mut Ui, model: &mut Model<'_>) {
    ui.label(model.state.material.formula.name());
}
