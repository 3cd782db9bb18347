//! What the laboratories are asked to measure, and when.

use std::path::PathBuf;

use egui::Context;

use super::Explorer;
use super::jobs::Errand;
use crate::app::arrangement::Pane;
use crate::app::budget;
use crate::app::ellipses::EllipsesWanted;
use crate::app::fold::{LightWanted, SheetWanted};
use crate::app::laboratory;
use crate::app::labs::Labs;
use crate::app::loss::Wanted;
use crate::app::object::Jobs;
use crate::app::sampling::CutsWanted;
use crate::app::state::AppState;
use crate::lab::files::{BENCH, LabError, prepare, write_bench};

impl Explorer {
    /// Lets a laboratory start what the state asks for; what goes wrong is told.
    fn start(
        &mut self,
        ctx: &Context,
        begin: impl FnOnce(&mut Labs, &AppState, &mut Jobs<'_>) -> Result<(), String>,
    ) {
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        if let Err(why) = begin(&mut self.labs, &self.state, &mut jobs) {
            self.fail(why);
        }
    }

    /// Measures the loss that is asked for while its pane is seen, and nothing while it is hidden.
    pub(super) fn measure_loss(&mut self, ctx: &Context) {
        let seen = self.surroundings.as_ref();
        let seen = seen.filter(|_| self.seen.contains(&Pane::Loss));
        let wanted = seen.map(|shown| Wanted::new(&self.state, &shown.loaded));
        if let (None, Some(shown)) = (&wanted, &self.surroundings) {
            self.labs.loss.forget_others(&shown.loaded);
        }
        if self.complete {
            self.labs.loss.complete(wanted, ctx);
            return;
        }
        self.start(ctx, |labs, _, jobs| labs.loss.follow(wanted, jobs));
    }

    /// Makes the pictures of two maps with as many texels while they are seen.
    pub(super) fn compare_budget(&mut self, ctx: &Context) {
        let shown = self.surroundings.as_ref();
        let view = self.budget_view;
        let wanted = shown.zip(view).map(|(shown, view)| {
            let target = self.object.shared_target();
            budget::Wanted::new(&self.state, &shown.loaded, target, view.size)
        });
        let lens = view.and_then(|view| view.lens);
        if let (None, Some(shown)) = (&wanted, shown) {
            self.labs.budget.forget_others(&shown.loaded);
        }
        if self.complete {
            self.labs.budget.complete(wanted, lens, ctx);
            return;
        }
        self.start(ctx, |labs, _, jobs| labs.budget.follow(wanted, lens, jobs));
    }

    /// Measures the evaluators that the laboratory shows.
    pub(super) fn measure_evaluators(&mut self, ctx: &Context) {
        self.start(ctx, |labs, state, jobs| labs.bench.measure(state, jobs));
    }

    /// Writes what the laboratory has measured, as the command does.
    pub(super) fn save_bench(&mut self, ctx: &Context, folder: PathBuf, force: bool) {
        let Some(measured) = self.labs.bench.measured().cloned() else {
            self.fail("nothing was measured yet: press Measure".to_owned());
            return;
        };
        self.send(ctx, "saving the measurements", move |_| {
            let said = |error: LabError| error.to_string();
            prepare(&folder, &BENCH, force).map_err(said)?;
            write_bench(&folder, force, &measured.rows, &measured.machine).map_err(said)?;
            Ok(Errand {
                message: format!("The measurements are in {}", folder.display()),
                ..Errand::default()
            })
        });
    }

    /// Makes the picture of errors that is seen.
    pub(super) fn picture_errors(&mut self, ctx: &Context) {
        let wanted = self.errors_wanted.take();
        if self.complete {
            let make = |wanted: &laboratory::Wanted, progress: &_| wanted.make(ctx, progress);
            self.labs.bench.errors.complete(wanted, make);
            return;
        }
        let painter = ctx.clone();
        let make = move |wanted: &laboratory::Wanted, progress: &_| wanted.make(&painter, progress);
        self.start(ctx, |labs, _, jobs| {
            let errors = &mut labs.bench.errors;
            errors.follow(wanted, "where it errs", jobs, make)
        });
    }

    /// Makes the heat maps that are seen.
    pub(super) fn paint_heat(&mut self, ctx: &Context) {
        let wanted = std::mem::take(&mut self.heat_wanted);
        if self.complete {
            self.labs.heat.complete(&wanted, ctx);
            return;
        }
        self.start(ctx, |labs, _, jobs| labs.heat.follow(&wanted, jobs));
    }

    /// Makes the light of the folded map that is seen.
    pub(super) fn light_fold(&mut self, ctx: &Context) {
        let seen = self.surroundings.as_ref().filter(|_| self.folds);
        let wanted = seen.map(|shown| LightWanted::new(&self.state, &shown.loaded));
        if let (None, Some(shown)) = (&wanted, &self.surroundings) {
            self.labs.fold.forget_others(&shown.loaded);
        }
        if self.complete {
            let light = &mut self.labs.fold.light;
            light.complete(wanted, |wanted, progress| wanted.make(ctx, progress));
            return;
        }
        let painter = ctx.clone();
        let make = move |wanted: &LightWanted, progress: &_| wanted.make(&painter, progress);
        self.start(ctx, |labs, _, jobs| {
            let light = &mut labs.fold.light;
            light.follow(wanted, "the light to fold", jobs, make)
        });
    }

    /// Traces the pieces and the lines of the folded map that is seen.
    pub(super) fn trace_fold(&mut self, ctx: &Context) {
        let wanted = self.sheet_wanted.take();
        if self.complete {
            self.labs.fold.sheet.complete(wanted, SheetWanted::make);
            return;
        }
        self.start(ctx, |labs, _, jobs| {
            let sheet = &mut labs.fold.sheet;
            sheet.forget(|_| wanted.is_none());
            sheet.follow(wanted, "the lines to fold", jobs, SheetWanted::make)
        });
    }

    /// Traces the ellipses that are seen.
    pub(super) fn trace_ellipses(&mut self, ctx: &Context) {
        let mappings = std::mem::take(&mut self.ellipses_wanted);
        let wanted = EllipsesWanted::new(mappings, self.state.overlays.ellipses_deg);
        if self.complete {
            self.labs.ellipses.complete(wanted);
            return;
        }
        self.start(ctx, |labs, _, jobs| labs.ellipses.follow(wanted, jobs));
    }

    /// Cuts the mappings at the horizon that are seen so.
    pub(super) fn cut_horizon(&mut self, ctx: &Context) {
        let wanted = self.cuts_wanted.take();
        if self.complete {
            self.labs.sampling.complete(wanted, CutsWanted::make);
            return;
        }
        self.start(ctx, |labs, _, jobs| {
            let cuts = &mut labs.sampling;
            cuts.follow(wanted, "texels of the horizon", jobs, CutsWanted::make)
        });
    }

    /// Measures how every mapping distorts while the ranking is seen.
    pub(super) fn rank(&mut self, ctx: &Context) {
        let is_seen = self.seen.contains(&Pane::Ranking);
        if self.complete {
            if is_seen {
                self.labs.ranking.complete();
            }
            return;
        }
        self.start(ctx, |labs, _, jobs| labs.ranking.follow(is_seen, jobs));
    }

    /// Asks the evaluators of the selected mapping where they break.
    pub(super) fn measure_stability(&mut self, ctx: &Context) {
        self.start(ctx, |labs, state, jobs| {
            labs.stability.measure(state.mapping, jobs)
        });
    }

    /// Looks through the microscope that is seen.
    pub(super) fn look(&mut self, ctx: &Context) {
        let state = &self.state;
        let view = self
            .microscope_px
            .map(|size| state.stability.view(state.mapping, size));
        if self.complete {
            self.labs.stability.look_now(view, ctx);
            return;
        }
        self.start(ctx, |labs, _, jobs| labs.stability.follow(view, jobs));
    }
}
