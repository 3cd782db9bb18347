//! What the laboratories are asked to measure, and when.

use std::path::PathBuf;

use egui::Context;

use super::Explorer;
use super::jobs::Errand;
use crate::app::arrangement::Pane;
use crate::app::budget;
use crate::app::fold::LightWanted;
use crate::app::laboratory;
use crate::app::loss::Wanted;
use crate::app::object::Jobs;
use crate::lab::files::{BENCH, LabError, prepare, write_bench};

impl Explorer {
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
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        if let Err(why) = self.labs.loss.follow(wanted, &mut jobs) {
            self.fail(why);
        }
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
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        if let Err(why) = self.labs.budget.follow(wanted, lens, &mut jobs) {
            self.fail(why);
        }
    }

    /// Measures the evaluators that the laboratory shows.
    pub(super) fn measure_evaluators(&mut self, ctx: &Context) {
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        if let Err(why) = self.labs.bench.measure(&self.state, &mut jobs) {
            self.fail(why);
        }
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
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        let painter = ctx.clone();
        let make = move |wanted: &laboratory::Wanted, progress: &_| wanted.make(&painter, progress);
        let errors = &mut self.labs.bench.errors;
        if let Err(why) = errors.follow(wanted, "where it errs", &mut jobs, make) {
            self.fail(why);
        }
    }

    /// Makes the heat maps that are seen.
    pub(super) fn paint_heat(&mut self, ctx: &Context) {
        let wanted = std::mem::take(&mut self.heat_wanted);
        if self.complete {
            self.labs.heat.complete(&wanted, ctx);
            return;
        }
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        if let Err(why) = self.labs.heat.follow(&wanted, &mut jobs) {
            self.fail(why);
        }
    }

    /// Makes the light of the folded map that is seen.
    pub(super) fn light_fold(&mut self, ctx: &Context) {
        let seen = self.surroundings.as_ref().filter(|_| self.folds);
        let wanted = seen.map(|shown| LightWanted::new(&self.state, &shown.loaded));
        let light = &mut self.labs.fold.light;
        if self.complete {
            light.complete(wanted, |wanted, progress| wanted.make(ctx, progress));
            return;
        }
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        let painter = ctx.clone();
        let make = move |wanted: &LightWanted, progress: &_| wanted.make(&painter, progress);
        if let Err(why) = light.follow(wanted, "the light to fold", &mut jobs, make) {
            self.fail(why);
        }
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
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        if let Err(why) = self.labs.ranking.follow(is_seen, &mut jobs) {
            self.fail(why);
        }
    }

    /// Asks the evaluators of the selected mapping where they break.
    pub(super) fn measure_stability(&mut self, ctx: &Context) {
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        let measured = self.labs.stability.measure(self.state.mapping, &mut jobs);
        if let Err(why) = measured {
            self.fail(why);
        }
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
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        if let Err(why) = self.labs.stability.follow(view, &mut jobs) {
            self.fail(why);
        }
    }
}
