//! The viewport: the object before its environment, both looked up in the shown mappings' own maps.

use std::collections::BTreeMap;

use super::forms::FORM_GROUP;
use super::frame::{Body, Frame, Look, Side, ViewportFrame};
use super::kit::{Kit, VIEW_FORMAT, Variant, object_source, sky_source};
use super::map::Map;
use super::object::ObjectSide;
use super::program::Program;
use super::uniforms::{View, vec4};
use super::workshop::Workshop;
use crate::mapping::MappingId;

/// Samples of a pixel, for a smooth silhouette; light is looked up once a pixel.
const SAMPLES: u32 = 4;
/// Largest picture with several samples, in pixels: 4096 x 4096, whose samples and depths take 512 MiB.
const MOST_SAMPLED_PX: u64 = 1 << 24;
const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
/// Bytes of a vertex: position and normal.
const VERTEX_BYTES: u64 = 24;

/// Everything of the viewport on the device.
#[derive(Debug)]
pub(super) struct Viewport {
    pub view: wgpu::TextureView,
    /// Changes with every new texture.
    pub id: u64,
    targets: Targets,
    block: wgpu::Buffer,
    mesh: GpuMesh,
    /// What each side of the divider needs beyond the map.
    sides: Vec<ObjectSide>,
    pipelines: Workshop<Key>,
}

/// What the viewport is drawn on.
#[derive(Debug)]
struct Targets {
    texture: wgpu::Texture,
    /// Several samples a pixel, before they are averaged; none where one is enough.
    samples: Option<wgpu::Texture>,
    depth: wgpu::Texture,
}

/// What a pipeline draws, of which mapping, how, and with how many samples.
type Key = (Part, MappingId, Variant, u32);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    Object(Program),
    Sky,
}

#[derive(Debug)]
struct GpuMesh {
    body: Body,
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    count: u32,
}

impl Viewport {
    pub fn new(kit: &Kit, frame: &ViewportFrame, samples: u32, id: u64) -> Self {
        let targets = Targets::new(kit, frame.size_px, samples);
        Self {
            view: targets
                .texture
                .create_view(&wgpu::TextureViewDescriptor::default()),
            targets,
            id,
            block: kit.block_buffer("view", size_of::<View>()),
            mesh: GpuMesh::new(kit, &frame.body),
            sides: Vec::new(),
            pipelines: Workshop::new(pipeline),
        }
    }

    /// Makes what the frame needs and the viewport lacks; `id` becomes the new texture's, if there is one.
    pub fn prepare(&mut self, kit: &Kit, frame: &ViewportFrame, samples: u32, id: u64) {
        if !self.targets.fit(frame.size_px, samples) {
            self.targets = Targets::new(kit, frame.size_px, samples);
            self.view = self
                .targets
                .texture
                .create_view(&wgpu::TextureViewDescriptor::default());
            self.id = id;
        }
        if self.mesh.body != frame.body {
            self.mesh = GpuMesh::new(kit, &frame.body);
        }
        let sides = frame.sides();
        self.sides.truncate(sides.len());
        for (i, side) in sides.iter().enumerate() {
            match self.sides.get_mut(i) {
                Some(held) => held.prepare(kit, side),
                None => self.sides.push(ObjectSide::new(kit, side)),
            }
        }
    }

    /// Drops the pipelines of mappings that the frame does not look up.
    pub fn keep_only(&mut self, frame: &ViewportFrame) {
        self.pipelines
            .retain(|(_, id, _, _)| frame.mappings().any(|used| used == *id));
    }

    /// True when every pipeline that the frame needs is there; see [`Workshop::has`].
    pub fn is_ready(
        &mut self,
        kit: &Kit,
        frame: &ViewportFrame,
        maps: &BTreeMap<MappingId, Map>,
        samples: u32,
        aside: bool,
    ) -> bool {
        let keys = keys(frame, maps, samples);
        // Every one is asked for, so that all are compiled at the same time.
        let missing = keys.iter().flatten();
        let missing = missing.filter(|key| !self.pipelines.has(kit, **key, aside));
        missing.count() == 0
    }

    /// Draws object and sky, left and right of the divider.
    pub fn draw(
        &mut self,
        kit: &Kit,
        encoder: &mut wgpu::CommandEncoder,
        frame: &ViewportFrame,
        look: Look,
        maps: &BTreeMap<MappingId, Map>,
    ) {
        let block = view_block(frame, look);
        kit.gpu
            .queue
            .write_buffer(&self.block, 0, bytemuck::bytes_of(&block));
        let seen = frame.sides();
        let keys = keys(frame, maps, self.targets.sample_count());
        self.pipelines
            .retain(|key| keys.iter().any(|pair| pair.contains(key)));
        let samples = self
            .targets
            .samples
            .as_ref()
            .map(|s| s.create_view(&wgpu::TextureViewDescriptor::default()));
        let (target, resolve_target, store) = match &samples {
            Some(samples) => (samples, Some(&self.view), wgpu::StoreOp::Discard),
            None => (&self.view, None, wgpu::StoreOp::Store),
        };
        let depth = self
            .targets
            .depth
            .create_view(&wgpu::TextureViewDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("viewport"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target,
                depth_slice: None,
                resolve_target,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_vertex_buffer(0, self.mesh.vertices.slice(..));
        pass.set_index_buffer(self.mesh.indices.slice(..), wgpu::IndexFormat::Uint32);

        let [width, height] = frame.size_px;
        let divider = frame.divider_px();
        let parts = [(0, divider), (divider, width)];
        let rays = frame.camera.ray_frame(width as f32 / height as f32);
        let sides = self.sides.iter().zip(&seen);
        for (([object, sky_key], (start, end)), (held, side)) in
            keys.into_iter().zip(parts).zip(sides)
        {
            held.write(kit, side, rays);
            let pair = (self.pipelines.get(object), self.pipelines.get(sky_key));
            let ((Some(object), Some(sky)), Some(map)) = (pair, maps.get(&sky_key.1)) else {
                continue;
            };
            if start == end {
                continue;
            }
            pass.set_scissor_rect(start, 0, end - start, height);
            pass.set_bind_group(0, &kit.lookup_group(&self.block, &map.view), &[]);
            if let Some(group) = kit.form_group(side.form, map) {
                pass.set_bind_group(FORM_GROUP, group, &[]);
            }
            // The object first: the sky is then not computed behind it.
            pass.set_bind_group(1, held.group(), &[]);
            pass.set_pipeline(object);
            pass.draw_indexed(0..self.mesh.count, 0, 0..1);
            pass.set_pipeline(sky);
            pass.draw(0..3, 0..1);
        }
        // On GL the samples are averaged within the last scissor only.
        pass.set_scissor_rect(0, 0, width, height);
    }

    /// The picture.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.targets.texture
    }

    /// The textures, for the count.
    pub fn textures(&self) -> impl Iterator<Item = &wgpu::Texture> {
        let Targets {
            texture,
            samples,
            depth,
        } = &self.targets;
        let sides = self.sides.iter().flat_map(ObjectSide::textures);
        samples.iter().chain([texture, depth]).chain(sides)
    }

    /// Number of pipelines.
    pub fn pipeline_count(&self) -> usize {
        self.pipelines.len()
    }
}

fn view_block(frame: &ViewportFrame, look: Look) -> View {
    let [width, height] = frame.size_px.map(|n| n as f32);
    let aspect = width / height;
    let rays = frame.camera.ray_frame(aspect);
    // Only the turn of the view: the shader subtracts the eye before it multiplies.
    let mut turn = frame.camera.view_from_world();
    turn.w_axis = glam::Vec4::W;
    View {
        clip_from_relative: (frame.camera.clip_from_view(aspect) * turn).to_cols_array_2d(),
        eye: vec4(rays.eye.to_array(), look.exposure),
        forward: vec4(rays.forward.to_array(), look.tone.index() as f32),
        right: vec4(rays.right.to_array(), width),
        up: vec4(rays.up.to_array(), height),
        probe: vec4(frame.probe, frame.form_difference.unwrap_or(0.0)),
    }
}

/// Samples of a pixel in this frame. On a processor they double the time of a frame (measured: 110 against 55 ms), so there
/// they are left to complete frames; pictures beyond [`MOST_SAMPLED_PX`] do without.
pub(super) fn samples(kit: &Kit, frame: &Frame) -> u32 {
    let on_processor = kit.gpu.adapter_info.device_type == wgpu::DeviceType::Cpu;
    let [width, height] = frame
        .viewport
        .as_ref()
        .map_or([0, 0], |v| v.size_px)
        .map(u64::from);
    let is_large = width * height > MOST_SAMPLED_PX;
    if is_large || (on_processor && !frame.complete) {
        1
    } else {
        SAMPLES
    }
}

impl Targets {
    fn new(kit: &Kit, size_px: [u32; 2], samples: u32) -> Self {
        let attachment = |format| {
            kit.gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("viewport"),
                size: wgpu::Extent3d {
                    width: size_px[0],
                    height: size_px[1],
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: samples,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            })
        };
        Self {
            texture: kit.view_texture("viewport", size_px),
            samples: (samples > 1).then(|| attachment(VIEW_FORMAT)),
            depth: attachment(DEPTH_FORMAT),
        }
    }

    fn sample_count(&self) -> u32 {
        self.depth.sample_count()
    }

    fn fit(&self, size_px: [u32; 2], samples: u32) -> bool {
        [self.texture.width(), self.texture.height()] == size_px && self.sample_count() == samples
    }
}

impl GpuMesh {
    fn new(kit: &Kit, body: &Body) -> Self {
        let mesh = body.target.mesh();
        let vertices: Vec<[f32; 6]> = mesh
            .positions
            .iter()
            .zip(&mesh.normals)
            .map(|([x, y, z], [a, b, c])| [*x, *y, *z, *a, *b, *c])
            .collect();
        let buffer = |label, usage, bytes: &[u8]| {
            let buffer = kit.gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes.len() as u64,
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            kit.gpu.queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        Self {
            body: body.clone(),
            vertices: buffer(
                "vertices",
                wgpu::BufferUsages::VERTEX,
                bytemuck::cast_slice(&vertices),
            ),
            indices: buffer(
                "indices",
                wgpu::BufferUsages::INDEX,
                bytemuck::cast_slice(&mesh.indices),
            ),
            count: mesh.indices.len() as u32,
        }
    }
}

/// The pipelines of each side of the divider.
fn keys(frame: &ViewportFrame, maps: &BTreeMap<MappingId, Map>, samples: u32) -> Vec<[Key; 2]> {
    let [width, height] = frame.size_px.map(|n| n as f32);
    let rays = frame.camera.ray_frame(width / height);
    // A pixel of the sky is widest in the middle of the screen.
    let widest_rad = (2.0 * rays.right.length() / width).max(2.0 * rays.up.length() / height);
    let shown = Variant {
        probe: frame.show_probe,
        difference: frame.form_difference.is_some(),
        ..Variant::new(frame.overlays)
    };
    let pair = |Side {
                    mapping: id,
                    program,
                    form,
                    ..
                }: Side<'_>| {
        let shown = Variant { form, ..shown };
        let finest_rad = maps.get(&id).map_or(0.0, |map| map.finest_rad);
        let level = widest_rad > finest_rad;
        [
            (
                Part::Object(program),
                id,
                Variant {
                    level: true,
                    ..shown
                },
                samples,
            ),
            (Part::Sky, id, Variant { level, ..shown }, samples),
        ]
    };
    frame.sides().into_iter().map(pair).collect()
}

fn pipeline(kit: &Kit, (part, id, variant, samples): Key) -> wgpu::RenderPipeline {
    let source = match part {
        Part::Object(program) => object_source(id, variant, program),
        Part::Sky => sky_source(id, variant),
    };
    let layout = kit.viewport_layout(variant.form);
    let module = kit.module("viewport", &source);
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
    let vertex_layout = [Some(wgpu::VertexBufferLayout {
        array_stride: VERTEX_BYTES,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &attributes,
    })];
    let is_object = matches!(part, Part::Object(_));
    let (vertex, fragment, buffers, depth_compare) = match part {
        Part::Object(_) => (
            "object_vertex",
            "object_fragment",
            &vertex_layout[..],
            wgpu::CompareFunction::Less,
        ),
        // At depth 1, where nothing was drawn.
        Part::Sky => (
            "screen_vertex",
            "sky_fragment",
            &[][..],
            wgpu::CompareFunction::LessEqual,
        ),
    };
    let descriptor = wgpu::RenderPipelineDescriptor {
        label: Some(fragment),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers,
        },
        primitive: wgpu::PrimitiveState {
            // As the meshes are wound; see `scene::Mesh`.
            front_face: wgpu::FrontFace::Cw,
            cull_mode: is_object.then_some(wgpu::Face::Back),
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(is_object),
            depth_compare: Some(depth_compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState {
            count: samples,
            ..Default::default()
        },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(VIEW_FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    };
    kit.gpu.device.create_render_pipeline(&descriptor)
}
