//! A mapping's shader code as an evaluator: arrays in, arrays out, no sampler in between.

use crate::mapping::{ChartPoint, Evaluator, EvaluatorError, MappingId};
use crate::math::Vec3;

use super::dispatch::{BATCH, Dispatch};
use super::shader::{self, NO_CHART};
use super::{Gpu, GpuError};

/// The pass; twin of this file.
pub const EVALUATE: &str = include_str!("../../shaders/evaluate.wgsl");

/// Words of an element.
const WORDS: usize = 4;
/// An element: see the pass.
type Words = [u32; WORDS];

/// A mapping computed by its shader on a device.
///
/// Vectors whose largest component is below the normal numbers get no chart, unlike on the CPU: a shader may flush them to
/// zero. NaN and infinity never reach the device, because a shader may assume that they do not occur.
#[derive(Debug)]
pub struct GpuEvaluator {
    id: MappingId,
    dispatch: Dispatch,
    forward: wgpu::ComputePipeline,
    inverse: wgpu::ComputePipeline,
}

impl GpuEvaluator {
    /// Compiles the mapping's pass.
    pub fn new(gpu: &Gpu, id: MappingId) -> Result<Self, GpuError> {
        Self::from_source(gpu, id, &Self::source(id))
    }

    /// The text of the mapping's pass.
    pub fn source(id: MappingId) -> String {
        shader::for_mapping(id, EVALUATE)
    }

    /// Compiles another text in place of the mapping's pass, so that a test can show that it notices a changed one.
    pub fn from_source(gpu: &Gpu, id: MappingId, source: &str) -> Result<Self, GpuError> {
        let entry_points = ["forward_all", "inverse_all"];
        let (dispatch, [forward, inverse]) =
            Dispatch::new(gpu, source, entry_points, WORDS, WORDS)?;
        Ok(Self {
            id,
            dispatch,
            forward,
            inverse,
        })
    }

    /// One dispatch of at most [`BATCH`] elements.
    fn run(
        &self,
        pipeline: &wgpu::ComputePipeline,
        given: &[Words],
    ) -> Result<Vec<Words>, EvaluatorError> {
        self.dispatch
            .run(pipeline, bytemuck::cast_slice(given))
            .map(|found| bytemuck::pod_collect_to_vec(&found))
            .map_err(|error| EvaluatorError::Device(error.to_string()))
    }
}

impl Evaluator for GpuEvaluator {
    fn name(&self) -> String {
        format!("shader on {}", self.dispatch.gpu().name())
    }

    fn forward(
        &mut self,
        dirs: &[Vec3<f32>],
        out: &mut [Option<ChartPoint<f32>>],
    ) -> Result<(), EvaluatorError> {
        for (dirs, out) in dirs.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            let finite = |d: &Vec3<f32>| d.to_array().iter().all(|c| c.is_finite());
            let given: Vec<Words> = dirs
                .iter()
                .map(|d| if finite(d) { words(*d) } else { [0; 4] })
                .collect();
            let found = self.run(&self.forward, &given)?;
            for (o, [chart, u, v, _]) in out.iter_mut().zip(found) {
                let point = ChartPoint::new(chart, f32::from_bits(u), f32::from_bits(v));
                *o = (chart != NO_CHART).then_some(point);
            }
        }
        Ok(())
    }

    fn inverse(
        &mut self,
        points: &[ChartPoint<f32>],
        out: &mut [Option<Vec3<f32>>],
    ) -> Result<(), EvaluatorError> {
        let info = self.id.info();
        let on_chart =
            |p: &ChartPoint<f32>| p.is_on(info.chart_count()) && info.domain.contains(p.u, p.v);
        for (points, out) in points.chunks(BATCH).zip(out.chunks_mut(BATCH)) {
            let given: Vec<Words> = points
                .iter()
                .map(|p| {
                    if on_chart(p) {
                        [p.chart, p.u.to_bits(), p.v.to_bits(), 0]
                    } else {
                        [0; 4]
                    }
                })
                .collect();
            let found = self.run(&self.inverse, &given)?;
            for ((o, [x, y, z, _]), p) in out.iter_mut().zip(found).zip(points) {
                let dir = Vec3::new(f32::from_bits(x), f32::from_bits(y), f32::from_bits(z));
                *o = on_chart(p).then_some(dir);
            }
        }
        Ok(())
    }
}

/// A direction's words.
fn words(dir: Vec3<f32>) -> Words {
    let [x, y, z] = dir.to_array().map(f32::to_bits);
    [x, y, z, 0]
}
