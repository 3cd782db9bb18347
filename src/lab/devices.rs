//! Where an experiment runs, and what comes of it.

use crate::mapping::{Adapter, Device, EvaluatorError, EvaluatorInfo};

/// The evaluators that take part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Devices {
    /// All; without an adapter those of the processor.
    #[default]
    Both,
    /// Those of the processor. No adapter is opened.
    Cpu,
    /// Shaders.
    Gpu,
}

impl Devices {
    /// Whether an evaluator takes part.
    #[must_use]
    pub fn include(self, evaluator: &EvaluatorInfo) -> bool {
        match self {
            Self::Both => true,
            Self::Cpu => evaluator.processor().is_some(),
            Self::Gpu => evaluator.form().is_some(),
        }
    }

    /// Opens the adapter where shaders take part.
    pub(super) fn open(self, device: &dyn Device) -> Option<Result<Adapter, EvaluatorError>> {
        (self != Self::Cpu).then(|| device.adapter())
    }
}

/// What came of an experiment.
#[derive(Debug)]
pub struct Outcome<R> {
    /// A row for each measurement.
    pub rows: Vec<R>,
    /// The adapter that ran the shaders, or why none did; `None` where none were wanted.
    pub adapter: Option<Result<Adapter, EvaluatorError>>,
    /// Shaders that could not be run to their end, a line each.
    pub faults: Vec<String>,
}
