//! All mappings beside each other: measured once in a session while the pane is seen, sorted, weighed and compared.

mod axis;
mod bump;
mod compare;
mod entry;
mod panel;
mod scatter;
mod table;

use std::collections::HashMap;
use std::sync::mpsc::{Receiver, channel};

use egui::Context;

pub use panel::ranking_ui;

use super::job::{Job, Outcome};
use super::labs::Lab;
use super::model::JobLine;
use super::object::{Jobs, job_line};
use crate::imaging::Progress;
use crate::lab::metrics::{Metrics, measure};
use crate::mapping::MappingId;

/// What was measured of every mapping, and the job that measures the others one after the other.
#[derive(Default)]
pub struct RankingLab {
    measured: HashMap<MappingId, Metrics>,
    running: Option<(Job<()>, Receiver<Metrics>)>,
    given_up: bool,
}

impl RankingLab {
    /// Measures what is missing while somebody looks. What is measured is kept.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(&mut self, is_seen: bool, jobs: &mut Jobs<'_>) -> Result<(), String> {
        if !is_seen {
            self.running = None;
            return Ok(());
        }
        let missing = self.missing();
        if self.running.is_some() || self.given_up || missing.is_empty() {
            return Ok(());
        }
        self.given_up = true;
        let (sender, receiver) = channel();
        let wake = jobs.ctx.clone();
        let title = "how every mapping distorts".to_owned();
        let job = jobs.start(title, move |progress: &Progress| {
            for (k, map) in missing.iter().enumerate() {
                progress.step(k, missing.len());
                let Some(metrics) = measure(*map, progress) else {
                    return;
                };
                if sender.send(metrics).is_err() {
                    return; // nobody looks any more
                }
                wake.request_repaint();
            }
        })?;
        self.given_up = false;
        self.running = Some((job, receiver));
        Ok(())
    }

    /// Measures what is missing at once: for pictures.
    pub fn complete(&mut self) {
        for map in self.missing() {
            if let Some(metrics) = measure(map, &Progress::new()) {
                self.measured.insert(map, metrics);
            }
        }
    }

    /// Goes on after it was cancelled.
    pub fn try_again(&mut self) {
        self.given_up = false;
    }

    /// What is known of a mapping.
    pub fn of(&self, map: MappingId) -> Option<&Metrics> {
        self.measured.get(&map)
    }

    /// True while it measures.
    pub fn is_measuring(&self) -> bool {
        self.running.is_some()
    }

    fn missing(&self) -> Vec<MappingId> {
        let is_missing = |map: &MappingId| !self.measured.contains_key(map);
        MappingId::ALL.iter().copied().filter(is_missing).collect()
    }

    fn take_in(&mut self) {
        let arrived = self.running.iter().flat_map(|(_, found)| found.try_iter());
        let arrived = arrived.map(|metrics| (metrics.mapping, metrics));
        self.measured.extend(arrived);
    }
}

impl Lab for RankingLab {
    fn poll(&mut self, _: &Context) {
        let outcome = self.running.as_ref().map(|(job, _)| job.poll());
        // After the job's own end, so that nothing which it has sent is lost.
        self.take_in();
        if let Some(Outcome::Done(()) | Outcome::Failed) = outcome {
            self.running = None;
            // What could not be measured is not tried again by itself.
            self.given_up = !self.missing().is_empty();
        }
    }

    fn jobs(&self) -> Vec<JobLine> {
        self.running.iter().map(|(job, _)| job_line(job)).collect()
    }

    fn cancel(&mut self, id: u64) {
        self.take_in();
        if self.running.take_if(|(job, _)| job.id == id).is_some() {
            self.given_up = true;
        }
    }
}
