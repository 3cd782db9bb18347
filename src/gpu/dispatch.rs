//! Arrays of words through a compute pass and back.

use super::{Gpu, GpuError};

/// Elements in one dispatch: 4096 workgroups, far below every adapter's limits, as are the buffers with 64 bytes an element.
pub(super) const BATCH: usize = 1 << 18;
/// Elements in a workgroup, as the passes say.
const WORKGROUP: usize = 64;
/// Bytes of a word.
const WORD: u64 = 4;
/// What stands in an output that was never written; no index is this large.
const UNWRITTEN: u32 = u32::MAX;

/// Buffers of a pass that reads elements from binding 0 and writes elements to binding 1. An element is a fixed number of
/// words; the last one found is the element's own index, so that one that nobody wrote, or the wrong one, shows.
#[derive(Debug)]
pub(super) struct Dispatch {
    gpu: Gpu,
    layout: wgpu::BindGroupLayout,
    given: wgpu::Buffer,
    found: wgpu::Buffer,
    read_back: wgpu::Buffer,
    given_words: usize,
    found_words: usize,
}

impl Dispatch {
    /// Compiles the pass, with a pipeline for each entry point. An element has `given_words` words (a multiple of 4, not 0)
    /// and `found_words` (the same).
    pub fn new<const N: usize>(
        gpu: &Gpu,
        source: &str,
        entry_points: [&str; N],
        given_words: usize,
        found_words: usize,
    ) -> Result<(Self, [wgpu::ComputePipeline; N]), GpuError> {
        gpu.checked(|device| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("evaluate"),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            });
            let bytes = |words| words as u64 * WORD;
            let storage = |binding, read_only, words| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only },
                    has_dynamic_offset: false,
                    min_binding_size: wgpu::BufferSize::new(bytes(words)),
                },
                count: None,
            };
            let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("evaluate"),
                entries: &[
                    storage(0, true, given_words),
                    storage(1, false, found_words),
                ],
            });
            let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("evaluate"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            });
            let pipelines = entry_points.map(|entry_point| {
                device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry_point),
                    layout: Some(&pipeline_layout),
                    module: &module,
                    entry_point: Some(entry_point),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    cache: None,
                })
            });
            let buffer = |label, words, usage| {
                device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size: BATCH as u64 * bytes(words),
                    usage,
                    mapped_at_creation: false,
                })
            };
            let worked_on = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
            let read = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
            let dispatch = Self {
                given: buffer("given", given_words, worked_on),
                found: buffer(
                    "found",
                    found_words,
                    worked_on | wgpu::BufferUsages::COPY_SRC,
                ),
                read_back: buffer("read back", found_words, read),
                gpu: gpu.clone(),
                layout,
                given_words,
                found_words,
            };
            (dispatch, pipelines)
        })
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// One dispatch of at most [`BATCH`] elements; the found words as bytes.
    pub fn run(
        &self,
        pipeline: &wgpu::ComputePipeline,
        given: &[u32],
    ) -> Result<Vec<u8>, GpuError> {
        let count = given.len() / self.given_words;
        let given_bytes = given.len() as u64 * WORD;
        let found_bytes = (count * self.found_words) as u64 * WORD;
        if count == 0 {
            return Ok(Vec::new());
        }
        let queue = &self.gpu.queue;
        self.gpu.checked(|device| {
            queue.write_buffer(&self.given, 0, bytemuck::cast_slice(given));
            let unwritten = vec![UNWRITTEN; count * self.found_words];
            queue.write_buffer(&self.found, 0, bytemuck::cast_slice(&unwritten));
            let part = |binding, buffer, bytes| wgpu::BindGroupEntry {
                binding,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer,
                    offset: 0,
                    size: wgpu::BufferSize::new(bytes),
                }),
            };
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("evaluate"),
                layout: &self.layout,
                entries: &[
                    part(0, &self.given, given_bytes),
                    part(1, &self.found, found_bytes),
                ],
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
                pass.dispatch_workgroups(count.div_ceil(WORKGROUP) as u32, 1, 1);
            }
            encoder.copy_buffer_to_buffer(&self.found, 0, &self.read_back, 0, found_bytes);
            queue.submit([encoder.finish()]);
        })?;
        let data = self.gpu.read_buffer(&self.read_back, found_bytes)?;
        let element_bytes = self.found_words * WORD as usize;
        for (index, element) in data.chunks_exact(element_bytes).enumerate() {
            if !element.ends_with(&(index as u32).to_ne_bytes()) {
                return Err(GpuError::Refused(format!(
                    "element {index} of {count} was not computed"
                )));
            }
        }
        Ok(data)
    }
}
