//! The ray story: one ray, step by step, from the eye to its lookups.

use egui::Ui;

use super::model::Model;

/// Shows the story in all the space there is.
pub fn story_ui(ui: &mut Ui, model: &mut Model<'_>) {
    ui.label(format!("step {}", model.state.story.step));
}
