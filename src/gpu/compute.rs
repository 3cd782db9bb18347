//! A mapping's shader code as an evaluator: arrays in, arrays out, no sampler in between.

use crate::mapping::{ChartPoint, Evaluator, EvaluatorError, MappingId};
use crate::math::Vec3;

use super::shader::{self, NO_CHART};
use super::{Gpu, GpuError};

/// The pass; twin of this file.
pub const EVALUATE: &str = include_str!("../../shaders/evaluate.wgsl");

/// Elements in one dispatch: 4 MiB a buffer, and 4096 workgroups, far below every adapter's limits.
const BATCH: usize = 1 << 18;
/// Elements in a workgroup, as the pass says.
const WORKGROUP: usize = 64;
/// Bytes of an element: four words.
const STRIDE: u64 = 16;
/// What stands in an output that was never written; no index is this large.
const UNWRITTEN: u32 = u32::MAX;

/// Four words: see the pass.
type Words = [u32; 4];

/// A mapping computed by its shader on a device.
///
/// Vectors whose largest component is below the normal numbers get no chart, unlike on the CPU: a shader may flush them to
/// zero. NaN and infinity never reach the device, because a shader may assume that they do not occur.
#[derive(Debug)]
pub struct GpuEvaluator {
    gpu: Gpu,
    id: MappingId,
    layout: wgpu::BindGroupLayout,
    forward: wgpu::ComputePipeline,
    inverse: wgpu::ComputePipeline,
    given: wgpu::Buffer,
    found: wgpu::Buffer,
    read_back: wgpu::Buffer,
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
        gpu.checked(|device| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("evaluate"),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            });
            let storage = |binding, read_only| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only },
                    has_dynamic_offset: false,
                    min_binding_size: wgpu::BufferSize::new(STRIDE),
                },
                count: None,
            };
            let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("evaluate"),
                entries: &[storage(0, true), storage(1, false)],
            });
            let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("evaluate"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            let pipeline = |entry_point| {
                device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry_point),
                    layout: Some(&pipeline_layout),
                    module: &module,
                    entry_point: Some(entry_point),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    cache: None,
                })
            };
            let buffer = |label, usage| {
                device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size: BATCH as u64 * STRIDE,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let worked_on = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
            Self {
                forward: pipeline("forward_all"),
                inverse: pipeline("inverse_all"),
                given: buffer("given", worked_on),
                found: buffer("found", worked_on | wgpu::BufferUsages::COPY_SRC),
                read_back: buffer(
                    "read back",
                    wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                ),
                gpu: gpu.clone(),
                id,
                layout,
            }
        })
    }

    /// One dispatch of at most [`BATCH`] elements.
    fn run(
        &self,
        pipeline: &wgpu::ComputePipeline,
        given: &[Words],
    ) -> Result<Vec<Words>, GpuError> {
        let bytes = given.len() as u64 * STRIDE;
        let Some(size) = wgpu::BufferSize::new(bytes) else {
            return Ok(Vec::new());
        };
        let queue = &self.gpu.queue;
        self.gpu.checked(|device| {
            queue.write_buffer(&self.given, 0, bytemuck::cast_slice(given));
            let unwritten = vec![[UNWRITTEN; 4]; given.len()];
            queue.write_buffer(&self.found, 0, bytemuck::cast_slice(&unwritten));
            let part = |binding, buffer| wgpu::BindGroupEntry {
                binding,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer,
                    offset: 0,
                    size: Some(size),
                }),
            };
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("evaluate"),
                layout: &self.layout,
                entries: &[part(0, &self.given), part(1, &self.found)],
            });
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
                label: Some("evaluate"),
            });
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some("evaluate"),
                    timestamp_writes: None,
                });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &group, &[]);
                pass.dispatch_workgroups(given.len().div_ceil(WORKGROUP) as u32, 1, 1);
            }
            encoder.copy_buffer_to_buffer(&self.found, 0, &self.read_back, 0, bytes);
            queue.submit([encoder.finish()]);
        })?;
        let data = self.gpu.read_buffer(&self.read_back, bytes)?;
        let found: Vec<Words> = bytemuck::pod_collect_to_vec(&data);
        for (index, words) in found.iter().enumerate() {
            if words[3] != index as u32 {
                return Err(GpuError::Refused(format!(
                    "element {index} of {} was not computed",
                    given.len()
                )));
            }
        }
        Ok(found)
    }
}

impl Evaluator for GpuEvaluator {
    fn name(&self) -> String {
        format!("shader on {}", self.gpu.name())
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
            let found = self.run(&self.forward, &given).map_err(device_error)?;
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
            let found = self.run(&self.inverse, &given).map_err(device_error)?;
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

fn device_error(error: GpuError) -> EvaluatorError {
    EvaluatorError::Device(error.to_string())
}
