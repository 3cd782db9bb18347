//! The ray story: one ray, step by step, from the eye to its lookups; or Hoff's sphere map, line by line.

mod ray;
mod refraction;
mod sphere_map;
mod steps;
#[cfg(test)]
mod tests;

use egui::{Color32, Grid, RichText, Slider, Ui};

pub use steps::{
    Arrow, StoryStep, dir_of, incidence_rad, point_of, refracted_vector, steps, vectors,
};

use super::action::Action;
use super::model::Model;
use super::narrow::slider_ui;
use super::state::{AppState, StoryKind, StoryState};
use super::theme;
use crate::scene::Target;

/// The steps while the pane is open: nothing is told to nobody.
pub fn steps_if_open(state: &AppState, target: &Target) -> Vec<StoryStep> {
    if state.story.open {
        steps(state, target)
    } else {
        Vec::new()
    }
}

/// One step further, or back; `None` at the end.
pub fn walked(story: StoryState, steps: &[StoryStep], forward: bool) -> Option<Action> {
    let last = steps.len().checked_sub(1)?;
    let now = story.step.min(last);
    let step = if forward {
        (now < last).then_some(now + 1)?
    } else {
        now.checked_sub(1)?
    };
    Some(Action::SetStory(StoryState { step, ..story }))
}

/// Shows the story in all the space there is.
pub fn story_ui(ui: &mut Ui, model: &mut Model<'_>) {
    theme::pane_frame(ui).show(ui, |ui| {
        kind_ui(ui, model);
        let Some((index, step)) = model.story_step().map(|(i, step)| (i, step.clone())) else {
            ui.label("Point at the object in the viewport and click: the story is that of the ray through that point.");
            return;
        };
        walk_ui(ui, model, index);
        ui.separator();
        egui::ScrollArea::vertical()
            .auto_shrink([false, false])
            .show(ui, |ui| step_ui(ui, model, &step));
    });
}

/// Which story.
fn kind_ui(ui: &mut Ui, model: &mut Model<'_>) {
    ui.horizontal_wrapped(|ui| {
        let story = model.state.story;
        for (kind, name, about) in [
            (StoryKind::Ray, "A ray", "From the eye to the lookups"),
            (
                StoryKind::SphereMap,
                "The sphere map",
                "Hoff's derivation for the probe's direction",
            ),
        ] {
            let response = ui
                .selectable_label(story.kind == kind, name)
                .on_hover_text(about);
            if response.clicked() && story.kind != kind {
                model.push(Action::SetStory(StoryState {
                    kind,
                    step: 0,
                    ..story
                }));
            }
        }
    });
}

/// Back, forward, and straight to a step.
fn walk_ui(ui: &mut Ui, model: &mut Model<'_>, index: usize) {
    let story = model.state.story;
    let count = model.story.len();
    ui.horizontal_wrapped(|ui| {
        for (name, key, forward) in [("Previous", ",", false), ("Next", ".", true)] {
            let action = walked(story, &model.story, forward);
            let button = egui::Button::new(name);
            let response = ui
                .add_enabled(action.is_some(), button)
                .on_hover_text(format!("Key: {key}"));
            if response.clicked()
                && let Some(action) = action
            {
                model.push(action);
            }
        }
        let label = ui.label(format!("step {} of {count}", index + 1));
        let mut step = index + 1;
        let slider = Slider::new(&mut step, 1..=count).show_value(false);
        ui.spacing_mut().slider_width = 240.0;
        if slider_ui(ui, slider, label.id, "").changed() {
            model.push(Action::SetStory(StoryState {
                step: step.saturating_sub(1),
                ..story
            }));
        }
    });
}

fn step_ui(ui: &mut Ui, model: &mut Model<'_>, step: &StoryStep) {
    ui.label(RichText::new(&step.title).heading().strong());
    ui.label(&step.text);
    ui.add_space(4.0);
    numbers_ui(ui, &step.numbers);
    if model.state.story.kind == StoryKind::SphereMap {
        ui.add_space(4.0);
        if ui.button("Go to the singular direction").clicked() {
            model.push(Action::FollowPointer(false));
            model.push(Action::SetProbe {
                dir: sphere_map::SINGULAR,
                eye_ray: None,
            });
        }
    }
}

/// Labels and values side by side, or one below the other where there is no room.
fn numbers_ui(ui: &mut Ui, numbers: &[(String, String)]) {
    const SIDE_BY_SIDE: f32 = 400.0;
    let value_ui = |ui: &mut Ui, value: &str| {
        let text = RichText::new(value).monospace();
        ui.add(egui::Label::new(text).wrap().selectable(true));
    };
    if ui.available_width() >= SIDE_BY_SIDE {
        Grid::new("numbers")
            .num_columns(2)
            .spacing([10.0, 3.0])
            .striped(true)
            .show(ui, |ui| {
                for (label, value) in numbers {
                    ui.label(label);
                    value_ui(ui, value);
                    ui.end_row();
                }
            });
        return;
    }
    for (label, value) in numbers {
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new(label).color(Color32::from_gray(170)));
            value_ui(ui, value);
        });
    }
}
