//! What follows a wish: made in a job while it is wanted and not there, and kept until something else has been made.

use super::job::{Job, Outcome};
use super::model::JobLine;
use super::object::{Jobs, job_line};
use crate::imaging::Progress;

/// Why something is not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GivenUp {
    /// The user has stopped it.
    Cancelled,
    /// It could not be made.
    Failed,
}

/// The last thing that was made, what it was made for, and the job that makes the next one.
pub struct Follower<W, T> {
    shown: Option<(W, T)>,
    running: Option<(W, Job<Option<T>>)>,
    /// Not tried again by itself, and why.
    given_up: Option<(W, GivenUp)>,
}

impl<W, T> Default for Follower<W, T> {
    fn default() -> Self {
        Self {
            shown: None,
            running: None,
            given_up: None,
        }
    }
}

impl<W: Clone + PartialEq + Send + 'static, T: Send + 'static> Follower<W, T> {
    /// Starts what is wanted and not there; stops what is not wanted any more. `None`: nobody looks. `make` gives nothing when it
    /// cannot, or was cancelled.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(
        &mut self,
        wanted: Option<W>,
        title: impl Into<String>,
        jobs: &mut Jobs<'_>,
        make: impl FnOnce(&W, &Progress) -> Option<T> + Send + 'static,
    ) -> Result<(), String> {
        self.running
            .take_if(|(running, _)| Some(&*running) != wanted.as_ref());
        let Some(wanted) = wanted.filter(|wanted| self.is_missing(wanted)) else {
            return Ok(());
        };
        self.given_up = Some((wanted.clone(), GivenUp::Failed));
        let of = wanted.clone();
        let job = jobs.start(title.into(), move |progress| make(&of, progress))?;
        self.given_up = None;
        self.running = Some((wanted, job));
        Ok(())
    }

    /// Makes what is wanted at once: for pictures.
    pub fn complete(&mut self, wanted: Option<W>, make: impl FnOnce(&W, &Progress) -> Option<T>) {
        if let Some(wanted) = wanted.filter(|wanted| self.is_missing(wanted)) {
            let made = make(&wanted, &Progress::new());
            self.take_in(wanted, made);
        }
    }

    fn is_missing(&self, wanted: &W) -> bool {
        let is_there = self.shown.as_ref().is_some_and(|(of, _)| of == wanted);
        let is_given_up = self.given_up.as_ref().is_some_and(|(of, _)| of == wanted);
        !is_there && self.running.is_none() && !is_given_up
    }

    fn take_in(&mut self, wanted: W, made: Option<T>) {
        match made {
            Some(made) => self.shown = Some((wanted, made)),
            None => self.given_up = Some((wanted, GivenUp::Failed)),
        }
    }

    /// Takes in what the job has brought.
    pub fn poll(&mut self) {
        let Some((wanted, job)) = self.running.take() else {
            return;
        };
        match job.poll() {
            Outcome::Running => self.running = Some((wanted, job)),
            Outcome::Done(made) => self.take_in(wanted, made),
            Outcome::Failed => self.given_up = Some((wanted, GivenUp::Failed)),
        }
    }

    /// What was made last, and for which wish; perhaps not for the present one.
    pub fn shown(&self) -> Option<(&W, &T)> {
        self.shown.as_ref().map(|(wanted, made)| (wanted, made))
    }

    /// What is being made.
    pub fn making(&self) -> Option<&W> {
        self.running.as_ref().map(|(wanted, _)| wanted)
    }

    /// Why the last wish that nothing came of was given up, until something else is begun.
    pub fn given_up(&self) -> Option<GivenUp> {
        self.given_up.as_ref().map(|(_, why)| *why)
    }

    /// Lets go of what was made for a wish of that kind, which would be kept in memory for nobody.
    pub fn forget(&mut self, is_stale: impl Fn(&W) -> bool) {
        self.shown.take_if(|(wanted, _)| is_stale(wanted));
        self.given_up.take_if(|(wanted, _)| is_stale(wanted));
    }

    /// The job under way.
    pub fn job(&self) -> Option<JobLine> {
        self.running.as_ref().map(|(_, job)| job_line(job))
    }

    /// Stops the job of that number.
    pub fn cancel(&mut self, id: u64) {
        if let Some((wanted, _)) = self.running.take_if(|(_, job)| job.id == id) {
            self.given_up = Some((wanted, GivenUp::Cancelled));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settle(follower: &mut Follower<u32, u32>) {
        while follower.job().is_some() {
            follower.poll();
            std::thread::yield_now();
        }
    }

    #[test]
    fn what_is_wanted_is_made_once_and_what_failed_is_not_tried_again() {
        let ctx = egui::Context::default();
        let mut last_id = 0;
        let mut jobs = Jobs {
            last_id: &mut last_id,
            ctx: &ctx,
        };
        let mut follower = Follower::default();
        let double = |wanted: &u32, _: &Progress| (*wanted < 5).then_some(2 * wanted);
        for wanted in [Some(2), Some(2), None, Some(7), Some(7)] {
            follower
                .follow(wanted, "double", &mut jobs, double)
                .unwrap();
            settle(&mut follower);
            let failed = wanted == Some(7);
            assert_eq!(follower.given_up(), failed.then_some(GivenUp::Failed));
            // A failure, and a wish of nobody, leave the last one.
            assert_eq!(follower.shown(), Some((&2, &4)));
        }
        assert_eq!(*jobs.last_id, 2, "2 and 7 once each");
        follower.complete(Some(3), double);
        assert_eq!(follower.shown(), Some((&3, &6)));
    }

    #[test]
    fn what_was_cancelled_is_not_begun_again() {
        let ctx = egui::Context::default();
        let mut last_id = 0;
        let mut jobs = Jobs {
            last_id: &mut last_id,
            ctx: &ctx,
        };
        let wait = |_: &u32, progress: &Progress| {
            while !progress.is_cancelled() {
                std::thread::yield_now();
            }
            None
        };
        let mut follower = Follower::<u32, u32>::default();
        follower.follow(Some(1), "wait", &mut jobs, wait).unwrap();
        let id = follower.job().unwrap().id;
        follower.cancel(id + 1);
        assert!(follower.job().is_some(), "another's number");
        follower.cancel(id);
        assert_eq!(follower.given_up(), Some(GivenUp::Cancelled));
        follower.follow(Some(1), "wait", &mut jobs, wait).unwrap();
        assert!(follower.job().is_none());
        follower.follow(Some(2), "wait", &mut jobs, wait).unwrap();
        assert!(follower.job().is_some() && follower.given_up().is_none());
    }
}
