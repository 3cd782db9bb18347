//! Evaluators: the ways to compute one mapping, each with its own speed and error.

use super::{ChartPoint, MappingId};
use crate::math::Vec3;

/// Computes a mapping on slices: one dynamic call a batch, never one a direction.
pub trait Evaluator {
    /// Short name.
    fn name(&self) -> String;
    /// Chart points of directions, `None` where a vector is no direction; `out` has the length of `dirs`.
    fn forward(
        &mut self,
        dirs: &[Vec3<f32>],
        out: &mut [Option<ChartPoint<f32>>],
    ) -> Result<(), EvaluatorError>;
    /// Unit directions of chart points, `None` off the chart; `out` has the length of `points`.
    fn inverse(
        &mut self,
        points: &[ChartPoint<f32>],
        out: &mut [Option<Vec3<f32>>],
    ) -> Result<(), EvaluatorError>;
}

/// Why an evaluator could not run.
#[derive(Debug, thiserror::Error)]
pub enum EvaluatorError {
    /// The device behind it failed.
    #[error("the device failed: {0}")]
    Device(String),
}

/// A mapping's own f32 code on the CPU.
#[derive(Clone, Copy, Debug)]
pub struct Cpu(pub MappingId);

impl Evaluator for Cpu {
    fn name(&self) -> String {
        "f32".to_owned()
    }

    fn forward(
        &mut self,
        dirs: &[Vec3<f32>],
        out: &mut [Option<ChartPoint<f32>>],
    ) -> Result<(), EvaluatorError> {
        self.0.forward_slice(dirs, out);
        Ok(())
    }

    fn inverse(
        &mut self,
        points: &[ChartPoint<f32>],
        out: &mut [Option<Vec3<f32>>],
    ) -> Result<(), EvaluatorError> {
        self.0.inverse_slice(points, out);
        Ok(())
    }
}

/// A way to compute a mapping that only this mapping has.
#[derive(Debug)]
pub struct EvaluatorInfo {
    /// Name on the command line.
    pub id: &'static str,
    /// What it is, and whose.
    pub about: &'static str,
    /// Forward in f32; `None` also where the form itself finds no chart.
    pub forward: fn(Vec3<f32>) -> Option<ChartPoint<f32>>,
}

/// The evaluators that every mapping has: name and what it is.
pub const SHARED_EVALUATORS: [(&str, &str); 2] = [
    (
        "f32",
        "single precision, stable form, own arctangent; the default",
    ),
    (
        "reference",
        "double precision, stable form, rounded once at the end",
    ),
];
