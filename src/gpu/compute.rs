//! A mapping's shader code as an evaluator: arrays in, arrays out, no sampler in between.

use std::sync::OnceLock;
use std::time::Duration;

use crate::mapping::{
    Adapter, ChartPoint, Device, DeviceTime, Dirs, DirsMut, Evaluator, EvaluatorError, MappingId,
    NOWHERE, Points, PointsMut, Shader, ShaderForm, Work,
};
use crate::math::Vec3;

use super::dispatch::{BATCH, Dispatch};
use super::forms::FormResources;
use super::shader::{self, NO_CHART};
use super::stopwatch::{Stopwatch, Timed};
use super::{Gpu, GpuError};

/// The pass; twin of this file.
const EVALUATE: &str = include_str!("../../shaders/evaluate.wgsl");
const EVALUATE_POINT: &str = include_str!("../../shaders/evaluate_point.wgsl");
const EVALUATE_BENT: &str = include_str!("../../shaders/evaluate_bent.wgsl");

/// Words of an element.
const WORDS: usize = 4;
/// An element: see the pass.
type Words = [u32; WORDS];

// One number stands for no chart in shaders and in slices.
const _: () = assert!(NO_CHART == NOWHERE);

/// A mapping computed by a form of its shader on a device.
///
/// Vectors whose largest component is below the normal numbers get no chart, unlike on the CPU: a shader may flush them to
/// zero. NaN and infinity never reach the device, because a shader may assume that they do not occur.
#[derive(Debug)]
pub struct GpuEvaluator {
    id: MappingId,
    form: ShaderForm,
    gpu: Gpu,
    dispatch: Dispatch,
    forward: wgpu::ComputePipeline,
    inverse: wgpu::ComputePipeline,
}

impl GpuEvaluator {
    /// Compiles the pass of a mapping's precise form.
    pub fn new(gpu: &Gpu, id: MappingId) -> Result<Self, GpuError> {
        Self::of_form(gpu, id, ShaderForm::Precise, &FormResources::default())
    }

    fn of_form(
        gpu: &Gpu,
        id: MappingId,
        form: ShaderForm,
        resources: &FormResources,
    ) -> Result<Self, GpuError> {
        Self::compiled(gpu, id, form, resources, &Self::source(id, form))
    }

    /// The text of the pass.
    pub fn source(id: MappingId, form: ShaderForm) -> String {
        let found = match form {
            ShaderForm::CubeUnit => EVALUATE_BENT,
            _ => EVALUATE_POINT,
        };
        shader::for_form(id, form, &(found.to_owned() + EVALUATE))
    }

    /// Compiles another text in place of the pass, so that a test can show that it notices a changed one.
    pub fn from_source(
        gpu: &Gpu,
        id: MappingId,
        form: ShaderForm,
        source: &str,
    ) -> Result<Self, GpuError> {
        Self::compiled(gpu, id, form, &FormResources::default(), source)
    }

    fn compiled(
        gpu: &Gpu,
        id: MappingId,
        form: ShaderForm,
        resources: &FormResources,
        source: &str,
    ) -> Result<Self, GpuError> {
        let dispatch = Dispatch::new(gpu, source, [WORDS, WORDS], resources.of(gpu, form))?;
        let [forward, inverse] = ["forward_all", "inverse_all"].map(|name| dispatch.pipeline(name));
        Ok(Self {
            id,
            form,
            gpu: gpu.clone(),
            dispatch,
            forward: forward?,
            inverse: inverse?,
        })
    }

    /// One dispatch of at most [`BATCH`] elements.
    fn run(
        &self,
        pipeline: &wgpu::ComputePipeline,
        given: &[Words],
    ) -> Result<Vec<Words>, EvaluatorError> {
        let found = self.dispatch.run(pipeline, bytemuck::cast_slice(given))?;
        Ok(bytemuck::pod_collect_to_vec(&found))
    }

    /// What stands in the words that a direction found.
    fn point(&self, [a, b, c, _]: Words) -> Option<ChartPoint<f32>> {
        if self.form == ShaderForm::CubeUnit {
            // Where a sampler looks, by exact arithmetic.
            let bent = [a, b, c].map(|word| f64::from(f32::from_bits(word)));
            let point = MappingId::Cube.forward(Vec3::<f64>::from_f64(bent))?;
            return Some(ChartPoint::new(point.chart, point.u as f32, point.v as f32));
        }
        let point = ChartPoint::new(a, f32::from_bits(b), f32::from_bits(c));
        (a != NO_CHART).then_some(point)
    }

    fn is_on_chart(&self, point: ChartPoint<f32>) -> bool {
        let info = self.id.info();
        point.is_on(info.chart_count()) && info.domain.contains(point.u, point.v)
    }

    fn point_words(&self, point: ChartPoint<f32>) -> Words {
        if self.is_on_chart(point) {
            [point.chart, point.u.to_bits(), point.v.to_bits(), 0]
        } else {
            [0; WORDS]
        }
    }
}

impl Evaluator for GpuEvaluator {
    fn forward(&self, dirs: Dirs<'_>, mut points: PointsMut<'_>) -> Result<(), EvaluatorError> {
        let count = dirs.len().min(points.len());
        for start in (0..count).step_by(BATCH) {
            let batch = start..(start + BATCH).min(count);
            let given: Vec<Words> = batch.clone().map(|k| dir_words(dirs.at(k))).collect();
            for (k, words) in batch.zip(self.run(&self.forward, &given)?) {
                points.set(k, self.point(words));
            }
        }
        Ok(())
    }

    fn inverse(&self, points: Points<'_>, mut dirs: DirsMut<'_>) -> Result<(), EvaluatorError> {
        let count = points.len().min(dirs.len());
        for start in (0..count).step_by(BATCH) {
            let batch = start..(start + BATCH).min(count);
            let given: Vec<Words> = batch
                .clone()
                .map(|k| self.point_words(points.at(k)))
                .collect();
            for (k, [x, y, z, _]) in batch.zip(self.run(&self.inverse, &given)?) {
                let dir = [x, y, z].map(f32::from_bits);
                dirs.set(k, self.is_on_chart(points.at(k)).then_some(dir));
            }
        }
        Ok(())
    }
}

impl Shader for GpuEvaluator {
    fn time(
        &self,
        work: Work<'_>,
        samples: usize,
        shortest: Duration,
    ) -> Result<Vec<DeviceTime>, EvaluatorError> {
        let (pipeline, given): (_, Vec<Words>) = match work {
            Work::Forward(dirs) => {
                let words = (0..dirs.len().min(BATCH)).map(|k| dir_words(dirs.at(k)));
                (&self.forward, words.collect())
            }
            Work::Inverse(points) => {
                let words = (0..points.len().min(BATCH)).map(|k| self.point_words(points.at(k)));
                (&self.inverse, words.collect())
            }
        };
        if given.is_empty() {
            return Ok(Vec::new());
        }
        let copy = self.dispatch.pipeline("copy_all")?;
        let sent = self.dispatch.send(bytemuck::cast_slice(&given))?;
        let works = [&(&sent, pipeline) as &dyn Timed, &(&sent, &copy)];
        Ok(Stopwatch::new(&self.gpu)?.time(works, samples, shortest)?)
    }
}

/// A direction's words; zeros for what must not reach a shader.
fn dir_words(dir: Vec3<f32>) -> Words {
    let components = dir.to_array();
    if !components.iter().all(|c| c.is_finite()) {
        return [0; WORDS];
    }
    let [x, y, z] = components.map(f32::to_bits);
    [x, y, z, 0]
}

impl From<GpuError> for EvaluatorError {
    fn from(error: GpuError) -> Self {
        Self::Device(error.to_string())
    }
}

/// The adapter that runs shader forms; opened when something is first asked of it.
#[derive(Debug, Default)]
pub struct ShaderDevice {
    gpu: OnceLock<Result<Gpu, GpuError>>,
    resources: FormResources,
}

impl ShaderDevice {
    /// One that works without a window.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// One that is open.
    #[must_use]
    pub fn on(gpu: Gpu) -> Self {
        Self {
            gpu: OnceLock::from(Ok(gpu)),
            resources: FormResources::default(),
        }
    }

    fn gpu(&self) -> Result<&Gpu, EvaluatorError> {
        let gpu = self.gpu.get_or_init(Gpu::headless).as_ref();
        gpu.map_err(|error| EvaluatorError::NoDevice(error.to_string()))
    }
}

impl Device for ShaderDevice {
    fn adapter(&self) -> Result<Adapter, EvaluatorError> {
        let gpu = self.gpu()?;
        let info = &gpu.adapter_info;
        Ok(Adapter {
            name: gpu.name(),
            driver: format!("{} {}", info.driver, info.driver_info)
                .trim()
                .to_owned(),
        })
    }

    fn shader(&self, map: MappingId, form: ShaderForm) -> Result<Box<dyn Shader>, EvaluatorError> {
        if map.form_or_precise(form) != form {
            return Err(EvaluatorError::Device(format!(
                "`{map}` has no form `{form}`"
            )));
        }
        let shader = GpuEvaluator::of_form(self.gpu()?, map, form, &self.resources)?;
        Ok(Box::new(shader))
    }
}
