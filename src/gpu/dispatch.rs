//! Arrays of words through a compute pass and back.

use super::forms::FORM_GROUP;
use super::stopwatch::{StampPair, Timed};
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
    module: wgpu::ShaderModule,
    layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
    /// What the pass reads besides, as [`FORM_GROUP`].
    form: Option<wgpu::BindGroup>,
    given: wgpu::Buffer,
    found: wgpu::Buffer,
    read_back: wgpu::Buffer,
    given_words: usize,
    found_words: usize,
}

impl Dispatch {
    /// Reads the pass. An element has `given_words` words (a multiple of 4, not 0) and `found_words` (the same); `form` is the
    /// layout and the group of what the pass reads besides.
    pub fn new(
        gpu: &Gpu,
        source: &str,
        [given_words, found_words]: [usize; 2],
        form: Option<(&wgpu::BindGroupLayout, &wgpu::BindGroup)>,
    ) -> Result<Self, GpuError> {
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
            let with_form = [Some(&layout), None, form.map(|(layout, _)| layout)];
            let groups = if form.is_some() { 3 } else { 1 };
            let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("evaluate"),
                bind_group_layouts: &with_form[..groups],
                immediate_size: 0,
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
            Self {
                given: buffer("given", given_words, worked_on),
                found: buffer(
                    "found",
                    found_words,
                    worked_on | wgpu::BufferUsages::COPY_SRC,
                ),
                read_back: buffer("read back", found_words, read),
                gpu: gpu.clone(),
                module,
                layout,
                pipeline_layout,
                form: form.map(|(_, group)| group.clone()),
                given_words,
                found_words,
            }
        })
    }

    /// Compiles one of the pass's entry points.
    pub fn pipeline(&self, entry_point: &str) -> Result<wgpu::ComputePipeline, GpuError> {
        self.gpu.checked(|device| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&self.pipeline_layout),
                module: &self.module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        })
    }

    /// Sends elements, at most [`BATCH`], and makes ready to compute them.
    pub fn send(&self, given: &[u32]) -> Result<Sent, GpuError> {
        let count = given.len() / self.given_words;
        let found_bytes = (count * self.found_words) as u64 * WORD;
        self.gpu.checked(|device| {
            let queue = &self.gpu.queue;
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
                    part(0, &self.given, given.len() as u64 * WORD),
                    part(1, &self.found, found_bytes),
                ],
            });
            Sent {
                group,
                form: self.form.clone(),
                count,
                found_bytes,
            }
        })
    }

    /// One dispatch of at most [`BATCH`] elements; the found words as bytes.
    pub fn run(
        &self,
        pipeline: &wgpu::ComputePipeline,
        given: &[u32],
    ) -> Result<Vec<u8>, GpuError> {
        if given.len() < self.given_words {
            return Ok(Vec::new());
        }
        let sent = self.send(given)?;
        self.gpu.checked(|device| {
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
                label: Some("evaluate"),
            });
            sent.dispatch(&mut encoder, pipeline, 1, None);
            encoder.copy_buffer_to_buffer(&self.found, 0, &self.read_back, 0, sent.found_bytes);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        let data = self.gpu.read_buffer(&self.read_back, sent.found_bytes)?;
        let (count, element_bytes) = (sent.count, self.found_words * WORD as usize);
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

/// Elements on the device.
pub(super) struct Sent {
    group: wgpu::BindGroup,
    form: Option<wgpu::BindGroup>,
    /// How many.
    pub count: usize,
    found_bytes: u64,
}

impl Sent {
    /// Computes them so many times, in one pass.
    fn dispatch(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::ComputePipeline,
        times: u32,
        stamps: Option<StampPair<'_>>,
    ) {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("evaluate"),
            timestamp_writes: stamps.map(|pair| wgpu::ComputePassTimestampWrites {
                query_set: pair.queries,
                beginning_of_pass_write_index: Some(pair.begin),
                end_of_pass_write_index: Some(pair.end),
            }),
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        if let Some(form) = &self.form {
            pass.set_bind_group(FORM_GROUP, form, &[]);
        }
        for _ in 0..times {
            pass.dispatch_workgroups(self.count.div_ceil(WORKGROUP) as u32, 1, 1);
        }
    }
}

impl Timed for (&Sent, &wgpu::ComputePipeline) {
    fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        times: u32,
        stamps: Option<StampPair<'_>>,
    ) {
        self.0.dispatch(encoder, self.1, times, stamps);
    }
}
