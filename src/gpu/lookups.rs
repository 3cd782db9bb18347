//! What a whole picture of lookups takes: the sky of one view, drawn again and again.

use std::collections::BTreeMap;
use std::time::Duration;

use super::environment::{EnvironmentSource, EnvironmentTexture};
use super::forms::FORM_GROUP;
use super::kit::{Kit, VIEW_FORMAT, Variant, sky_source};
use super::map::{Map, map_size};
use super::renderer::RenderError;
use super::stopwatch::{StampPair, Stopwatch, Timed};
use super::uniforms::{View, vec4};
use super::{Gpu, GpuError};
use crate::mapping::{DeviceTime, MappingId, ShaderForm};
use crate::math::Rotation;
use crate::scene::Camera;

/// A way to look a direction up.
pub type Lookup = (MappingId, ShaderForm);

/// Times pictures of lookups on one device.
#[derive(Debug)]
pub struct Lookups {
    kit: Kit,
    environment: EnvironmentTexture,
    texel_budget: u32,
    size_px: [u32; 2],
    block: wgpu::Buffer,
    target: wgpu::TextureView,
    maps: BTreeMap<MappingId, Map>,
}

impl Lookups {
    /// Pictures of this size, of maps with so many texels. Each pixel is as large as a few texels at most, so that the finest
    /// level is looked up.
    pub fn new(
        gpu: Gpu,
        environment: EnvironmentSource<'_>,
        texel_budget: u32,
        size_px: [u32; 2],
    ) -> Result<Self, RenderError> {
        let environment = EnvironmentTexture::new(&gpu, environment)?;
        let kit = Kit::new(gpu.clone());
        let (block, target) = gpu.checked(|_| {
            let block = kit.block_buffer("view", size_of::<View>());
            let [width, height] = size_px.map(|n| n as f32);
            let rays = Camera::default().ray_frame(width / height);
            let view = View {
                eye: vec4(rays.eye.to_array(), 1.0),
                forward: vec4(rays.forward.to_array(), 0.0),
                right: vec4(rays.right.to_array(), width),
                up: vec4(rays.up.to_array(), height),
                ..View::default()
            };
            gpu.queue.write_buffer(&block, 0, bytemuck::bytes_of(&view));
            let target = kit.view_texture("lookups", size_px);
            (
                block,
                target.create_view(&wgpu::TextureViewDescriptor::default()),
            )
        })?;
        Ok(Self {
            kit,
            environment,
            texel_budget,
            size_px,
            block,
            target,
            maps: BTreeMap::new(),
        })
    }

    /// Nanoseconds for a picture by the first lookup and, right after it, by the second, as often as `samples` says, each repeated
    /// until it takes `shortest`.
    pub fn time(
        &mut self,
        lookups: [Lookup; 2],
        samples: usize,
        shortest: Duration,
    ) -> Result<Vec<DeviceTime>, RenderError> {
        for (id, _) in lookups {
            self.fill(id)?;
        }
        let gpu = &self.kit.gpu;
        let [work, other] = lookups.map(|lookup| gpu.checked(|_| self.picture(lookup)));
        let (work, other) = (work?, other?);
        let (Some(work), Some(other)) = (work, other) else {
            return Ok(Vec::new());
        };
        let times = Stopwatch::new(gpu)?.time([&work, &other], samples, shortest)?;
        Ok(times)
    }

    /// Pixels of a picture.
    #[must_use]
    pub fn pixels(&self) -> u64 {
        self.size_px.map(u64::from).iter().product()
    }

    fn fill(&mut self, id: MappingId) -> Result<(), GpuError> {
        if self.maps.contains_key(&id) {
            return Ok(());
        }
        let (kit, environment) = (&self.kit, &self.environment);
        let map = kit.gpu.checked(|device| {
            let map = Map::new(kit, id, map_size(id, self.texel_budget), true);
            let mut encoder =
                device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let pipeline = Map::pipeline(kit, id);
            map.bake(
                kit,
                &mut encoder,
                &pipeline,
                id,
                environment,
                Rotation::NONE,
            );
            kit.gpu.queue.submit([encoder.finish()]);
            map
        })?;
        self.maps.insert(id, map);
        Ok(())
    }

    fn picture(&self, (id, form): Lookup) -> Option<Picture<'_>> {
        let (kit, map) = (&self.kit, self.maps.get(&id)?);
        let form = id.form_or_precise(form);
        let variant = Variant {
            form,
            ..Variant::default()
        };
        let source = sky_source(id, variant);
        let layout = kit.sky_layout(form);
        Some(Picture {
            pipeline: kit.screen_pipeline_with(&layout, &source, "sky_fragment", VIEW_FORMAT),
            lookup: kit.lookup_group(&self.block, &map.view),
            form: kit.form_group(form, map),
            target: &self.target,
        })
    }
}

struct Picture<'a> {
    pipeline: wgpu::RenderPipeline,
    lookup: wgpu::BindGroup,
    form: Option<&'a wgpu::BindGroup>,
    target: &'a wgpu::TextureView,
}

impl Timed for Picture<'_> {
    /// A pass for each, since of several pictures in one pass a device may draw only the last.
    fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        times: u32,
        stamps: Option<StampPair<'_>>,
    ) {
        for k in 0..times {
            let (is_first, is_last) = (k == 0, k + 1 == times);
            let stamps = stamps.filter(|_| is_first || is_last);
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("lookups"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: self.target,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                timestamp_writes: stamps.map(|pair| wgpu::RenderPassTimestampWrites {
                    query_set: pair.queries,
                    beginning_of_pass_write_index: is_first.then_some(pair.begin),
                    end_of_pass_write_index: is_last.then_some(pair.end),
                }),
                ..Default::default()
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.lookup, &[]);
            if let Some(form) = self.form {
                pass.set_bind_group(FORM_GROUP, form, &[]);
            }
            pass.draw(0..3, 0..1);
        }
    }
}
