//! The laboratories: each measures in jobs of its own and keeps what it has measured.

use egui::Context;

use super::budget::BudgetLab;
use super::distortion::HeatMaps;
use super::ellipses::EllipsesLab;
use super::fold::FoldLab;
use super::follower::Follower;
use super::laboratory::BenchLab;
use super::loss::LossLab;
use super::model::JobLine;
use super::ranking::RankingLab;
use super::sampling::CutsWanted;
use super::stability::StabilityLab;
use crate::lab::sampling::Sampling;

/// What the window asks of every laboratory, whatever it measures.
pub trait Lab {
    /// Takes in what its jobs have brought.
    fn poll(&mut self, ctx: &Context);
    /// Its jobs under way.
    fn jobs(&self) -> Vec<JobLine>;
    /// True while a job runs.
    fn is_busy(&self) -> bool {
        !self.jobs().is_empty()
    }
    /// Stops the job of that number, if it is its own.
    fn cancel(&mut self, id: u64);
}

/// What only follows a wish is a laboratory as it stands.
impl<W, T> Lab for Follower<W, T>
where
    W: Clone + PartialEq + Send + 'static,
    T: Send + 'static,
{
    fn poll(&mut self, _: &Context) {
        Self::poll(self);
    }

    fn jobs(&self) -> Vec<JobLine> {
        self.job().into_iter().collect()
    }

    fn cancel(&mut self, id: u64) {
        Self::cancel(self, id);
    }
}

/// All of them.
#[derive(Default)]
pub struct Labs {
    /// What a conversion loses.
    pub loss: LossLab,
    /// Where evaluators break.
    pub stability: StabilityLab,
    /// Run time against error.
    pub bench: BenchLab,
    /// Heat maps of distortion.
    pub heat: HeatMaps,
    /// Tissot's ellipses.
    pub ellipses: EllipsesLab,
    /// The light of the folded map.
    pub fold: FoldLab,
    /// Two mappings with as many texels.
    pub budget: BudgetLab,
    /// How every mapping distorts.
    pub ranking: RankingLab,
    /// Cuts through the horizon.
    pub sampling: Follower<CutsWanted, Vec<Sampling>>,
}

impl Labs {
    fn all(&self) -> [&dyn Lab; 9] {
        [
            &self.loss,
            &self.bench,
            &self.stability,
            &self.heat,
            &self.ellipses,
            &self.fold,
            &self.budget,
            &self.ranking,
            &self.sampling,
        ]
    }

    fn all_mut(&mut self) -> [&mut dyn Lab; 9] {
        [
            &mut self.loss,
            &mut self.bench,
            &mut self.stability,
            &mut self.heat,
            &mut self.ellipses,
            &mut self.fold,
            &mut self.budget,
            &mut self.ranking,
            &mut self.sampling,
        ]
    }

    /// Takes in what the jobs have brought.
    pub fn poll(&mut self, ctx: &Context) {
        self.all_mut().into_iter().for_each(|lab| lab.poll(ctx));
    }

    /// The jobs under way.
    pub fn jobs(&self) -> Vec<JobLine> {
        self.all().into_iter().flat_map(Lab::jobs).collect()
    }

    /// True while a job runs.
    pub fn is_busy(&self) -> bool {
        self.all().into_iter().any(Lab::is_busy)
    }

    /// Stops the job of that number.
    pub fn cancel(&mut self, id: u64) {
        self.all_mut().into_iter().for_each(|lab| lab.cancel(id));
    }
}
