//! How long an export will take: a small one like it is made in memory and timed, off the window's thread.

use std::sync::Arc;

use super::export::Export;
use super::job::{Job, Outcome};
use super::object::Jobs;
use crate::gpu::Shared;
use crate::imaging::Loaded;

/// How fast an export will be, in texels a second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// As a small one like it was.
    Measured(f64),
    /// As the last one was, whatever that made.
    OfLast(f64),
    /// Nothing is known yet.
    Unknown,
}

/// What a measurement is of.
#[derive(Clone, Debug, PartialEq)]
struct Key {
    /// Without its place on disk.
    export: Export,
    loaded: Shared<Loaded>,
}

impl Key {
    fn new(export: &Export, loaded: &Arc<Loaded>) -> Self {
        Self {
            export: placeless(export),
            loaded: Arc::clone(loaded).into(),
        }
    }
}

fn placeless(export: &Export) -> Export {
    Export {
        path: String::new(),
        force: false,
        ..export.clone()
    }
}

/// What is known of the pace, and the job that finds out more.
#[derive(Default)]
pub struct Paces {
    last: Option<f64>,
    /// No rate where none could be measured: it is not tried again.
    known: Option<(Key, Option<f64>)>,
    job: Option<(Key, Job<Result<f64, String>>)>,
}

impl Paces {
    /// Measures the export that somebody thinks about, and stops measuring any other.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(
        &mut self,
        wanted: Option<(&Export, &Arc<Loaded>)>,
        jobs: &mut Jobs<'_>,
    ) -> Result<(), String> {
        let wanted = wanted.map(|(export, loaded)| Key::new(export, loaded));
        self.job.take_if(|(key, _)| Some(&*key) != wanted.as_ref());
        if wanted.is_none() {
            // It would keep the surroundings in memory for nobody.
            self.known = None;
        }
        let is_known = |key: &Key| self.known.as_ref().is_some_and(|(known, _)| known == key);
        let Some(key) = wanted.filter(|key| self.job.is_none() && !is_known(key)) else {
            return Ok(());
        };
        let (export, loaded) = (key.export.clone(), key.loaded.clone());
        let job = jobs.start("timing a small export".to_owned(), move |progress| {
            export.measured_rate(&loaded.image, progress)
        })?;
        self.job = Some((key, job));
        Ok(())
    }

    /// Takes in what the job has found.
    pub fn poll(&mut self) {
        if let Some((key, job)) = self.job.take() {
            match job.poll() {
                Outcome::Running => self.job = Some((key, job)),
                Outcome::Done(rate) => self.known = Some((key, rate.ok())),
                Outcome::Failed => self.known = Some((key, None)),
            }
        }
    }

    /// An export has made so many texels a second.
    pub fn learn(&mut self, rate: f64) {
        self.last = Some(rate);
    }

    /// What is known of an export.
    pub fn of(&self, export: &Export) -> Pace {
        let known = self.known.as_ref();
        let measured = known.filter(|(key, _)| key.export == placeless(export));
        match (measured.and_then(|(_, rate)| *rate), self.last) {
            (Some(rate), _) => Pace::Measured(rate),
            (None, Some(rate)) => Pace::OfLast(rate),
            (None, None) => Pace::Unknown,
        }
    }

    /// True while something is measured.
    pub fn is_busy(&self) -> bool {
        self.job.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_export_says_more_than_the_last_one_and_that_more_than_nothing() {
        let export = Export::default();
        let mut paces = Paces::default();
        assert_eq!(paces.of(&export), Pace::Unknown);
        paces.learn(1e6);
        assert_eq!(paces.of(&export), Pace::OfLast(1e6));
        let image = crate::imaging::Image::new(2, 1, vec![[0.5; 3]; 2]).unwrap();
        let loaded = Arc::new(Loaded::from_image(image, &crate::imaging::Progress::new()));
        paces.known = Some((Key::new(&export, &loaded), Some(2e6)));
        let elsewhere = Export {
            path: "other.exr".to_owned(),
            ..export.clone()
        };
        assert_eq!(paces.of(&elsewhere), Pace::Measured(2e6));
        let finer = Export {
            height: 1000,
            ..export.clone()
        };
        assert_eq!(paces.of(&finer), Pace::OfLast(1e6));
        paces.known = Some((Key::new(&export, &loaded), None));
        assert_eq!(paces.of(&export), Pace::OfLast(1e6));
    }
}
