//! What becomes of a command, and how one state follows another.

use egui::Context;

use super::Explorer;
use crate::app::action::{Action, apply};
use crate::app::command::Command;
use crate::app::dialogs::Dialog;
use crate::app::state::{AppState, unit};
use crate::app::{panes, viewport};
use crate::imaging::Environment;

impl Explorer {
    /// Carries out a command.
    pub fn run(&mut self, ctx: &Context, command: Command) {
        match command {
            Command::Do(action) => self.act(action),
            Command::Undo => {
                if let Some(state) = self.history.undo(&self.state) {
                    self.replace(ctx, state);
                }
            }
            Command::Redo => {
                if let Some(state) = self.history.redo(&self.state) {
                    self.replace(ctx, state);
                }
            }
            Command::LoadEnvironment(environment) => self.load(ctx, environment),
            Command::LoadFile(file) => {
                let pictures = self.reading.as_ref().filter(|reading| reading.is_of(&file));
                let pictures = pictures.and_then(|reading| reading.pictures().cloned());
                self.load_from(ctx, Environment::File(file), pictures);
            }
            Command::ShowDialog(dialog) => self.dialog = Some(dialog),
            Command::Browse => {
                if let Some(dialog) = self.dialog.clone() {
                    self.ask(ctx, dialog);
                }
            }
            Command::Open(path) => self.open(ctx, path),
            Command::ShowFigure(figure) => {
                let mut scene = self.scene();
                figure.show(&mut scene);
                self.show_scene(ctx, scene);
            }
            Command::SaveScene { path, force } => self.save_scene(ctx, path, force),
            Command::MakePicture(request) => self.make_picture(ctx, request),
            Command::ShowExport => {
                self.dialog = Some(Dialog::Export(Box::new(self.last_export.clone())));
            }
            Command::Export(export) => self.export(ctx, *export),
            Command::Cancel(id) => self.cancel(id),
            Command::MeasureEvaluators => self.measure_evaluators(ctx),
            Command::SaveBench { folder, force } => self.save_bench(ctx, folder, force),
            Command::MeasureRanking => self.labs.ranking.try_again(),
            Command::MeasureLoss => self.labs.loss.try_again(),
            Command::MeasureStability => self.measure_stability(ctx),
            Command::Dismiss(index) => {
                if index < self.messages.len() {
                    self.messages.remove(index);
                }
            }
            Command::CopyText(text) => ctx.copy_text(text),
            Command::ResetArrangement => {
                self.act(Action::SetMaximised(None));
                self.tree = panes::first_tree(&self.state);
            }
            Command::Quit => self.quit = true,
        }
    }

    /// Changes the state, remembering how to take it back.
    pub(super) fn act(&mut self, action: Action) {
        let before = self.state.clone();
        apply(&mut self.state, action.clone());
        self.follow_material(&before);
        if before != self.state {
            self.history.record(before, &action);
            self.follow_state();
        }
    }

    /// The ray that found the probe looks up what the changed material says.
    fn follow_material(&mut self, before: &AppState) {
        let state = &self.state;
        let is_changed = state.pointed_material() != before.pointed_material();
        if let Some(eye) = state.eye_ray.filter(|_| is_changed) {
            let material = state.pointed_material();
            let dir = viewport::looked_up(self.object.target(), eye.ray(), material);
            self.state.probe = unit(dir.to_array());
        }
    }

    /// Another state altogether: its surroundings may have to be loaded.
    pub(super) fn replace(&mut self, ctx: &Context, state: AppState) {
        let environment = state.environment.clone();
        let is_arranged_otherwise = state.arrangement != self.state.arrangement;
        self.state = state;
        if is_arranged_otherwise {
            self.tree = panes::tree_of(&self.state);
        }
        // What moved when the state was left does not move anew.
        self.state.fold.towards = None;
        self.follow_state();
        let shown = self
            .surroundings
            .as_ref()
            .is_some_and(|s| s.environment == environment);
        if shown {
            // What was being loaded belongs to the state that was left.
            self.loading = None;
        } else {
            self.load(ctx, environment);
        }
    }

    fn follow_state(&mut self) {
        panes::follow(&mut self.tree, &self.state);
    }
}
