//! What every pass of the renderer needs: layouts, samplers, and short ways to make things.

use super::forms::{self, FormResources};
use super::map::Map;
use super::optics::{self, OPTICS};
use super::program::Program;
use super::uniforms::MOST_WAVELENGTHS;
use super::{Gpu, Overlays, overlay, shader, tone};
use crate::mapping::{MappingId, ShaderForm};
use crate::optics::material::MOST_BOUNCES;

/// What the screen gets: sRGB values in a format that does not convert them again.
pub const VIEW_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Light, linear: half floats can be filtered and drawn to on every adapter.
pub const LIGHT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// What object and sky share in the viewport's passes.
const VIEWPORT: &str = concat!(
    include_str!("../../shaders/footprint.wgsl"),
    include_str!("../../shaders/color.wgsl"),
    include_str!("../../shaders/lookup.wgsl"),
    include_str!("../../shaders/overlay.wgsl"),
    include_str!("../../shaders/viewport.wgsl"),
);
const CHART_LIGHT: &str = include_str!("../../shaders/form/chart_light.wgsl");
const CUBE_LIGHT: &str = include_str!("../../shaders/form/cube_light.wgsl");
const PLAIN: &str = include_str!("../../shaders/form/plain.wgsl");
const DIFFERENCE: &str = include_str!("../../shaders/form/difference.wgsl");
/// The sky's pass, after [`VIEWPORT`].
const SKY: &str = concat!(
    include_str!("../../shaders/screen.wgsl"),
    include_str!("../../shaders/sky.wgsl"),
);
/// The material's numbers, which every program of the object has.
const MATERIAL: &str = include_str!("../../shaders/object/material.wgsl");
/// A panel's pass on one mapping.
const PANEL: &str = concat!(
    include_str!("../../shaders/screen.wgsl"),
    include_str!("../../shaders/footprint.wgsl"),
    include_str!("../../shaders/color.wgsl"),
    include_str!("../../shaders/lookup.wgsl"),
    include_str!("../../shaders/overlay.wgsl"),
    include_str!("../../shaders/panel.wgsl"),
);
/// The pass that fills a mapping's map.
const BAKE: &str = concat!(
    include_str!("../../shaders/screen.wgsl"),
    include_str!("../../shaders/footprint.wgsl"),
    include_str!("../../shaders/bake.wgsl"),
);
/// The pass that halves a picture.
pub const HALVE: &str = concat!(
    include_str!("../../shaders/screen.wgsl"),
    include_str!("../../shaders/halve.wgsl"),
);

/// The whole text of the pass that fills a mapping's map.
#[must_use]
pub fn bake_source(id: MappingId) -> String {
    shader::for_mapping(id, BAKE)
}

/// What the viewport does. Constants of its shader, so that nothing is computed that is not seen, also on adapters that run
/// both sides of a branch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Variant {
    /// Paints the great circles.
    pub great_circles: bool,
    /// Paints the tint of the face.
    pub face_tint: bool,
    /// Paints lines of equal u and v.
    pub grid: bool,
    /// Paints the probe.
    pub probe: bool,
    /// Some pixel may cover more than a texel: the viewport works out the level for each.
    pub level: bool,
    /// The form of the mapping's shader.
    pub form: ShaderForm,
    /// Shows how far it is from the precise form instead of the light.
    pub difference: bool,
}

impl Variant {
    /// With these overlays, without probe and level.
    #[must_use]
    pub fn new(overlays: Overlays) -> Self {
        Self {
            great_circles: overlays.great_circles,
            face_tint: overlays.face_tint,
            grid: overlays.grid,
            ..Self::default()
        }
    }
}

/// The whole text of the sky's pass on a mapping.
#[must_use]
pub fn sky_source(id: MappingId, variant: Variant) -> String {
    viewport_source(id, variant, SKY)
}

/// The whole text of the object's pass on a mapping.
#[must_use]
pub fn object_source(id: MappingId, variant: Variant, program: Program) -> String {
    let [r, g, b] = MARK_COLORS[0];
    let mut text = format!("const TOTAL_REFLECTION_COLOR = vec3f({r}, {g}, {b});\n");
    let [r, g, b] = MARK_COLORS[1];
    text += &format!("const FAULT_COLOR = vec3f({r}, {g}, {b});\n");
    text += &format!("const MOST_BOUNCES: u32 = {MOST_BOUNCES}u;\n");
    text += &format!("const MOST_WAVELENGTHS: u32 = {MOST_WAVELENGTHS}u;\n");
    text += &optics::wgsl_constants();
    viewport_source(id, variant, &(text + OPTICS + MATERIAL + &program.source()))
}

/// Marks of total internal reflection and of what a fault makes, display values: Okabe and Ito's reddish purple and vermilion.
pub const MARK_COLORS: [[f32; 3]; 2] = [[0.8, 0.475, 0.655], [0.835, 0.369, 0.0]];

fn viewport_source(id: MappingId, variant: Variant, pass: &str) -> String {
    let switches = [
        ("SHOW_GREAT_CIRCLES", variant.great_circles),
        ("SHOW_FACE_TINT", variant.face_tint),
        ("SHOW_GRID", variant.grid),
        ("SHOW_PROBE", variant.probe),
        ("NEEDS_LEVEL", variant.level),
    ];
    let switches = switches.map(|(name, on)| format!("const {name} = {on};\n"));
    let mut text = switches.concat() + VIEWPORT;
    text += match variant.form {
        ShaderForm::CubeUnit => CUBE_LIGHT,
        _ => CHART_LIGHT,
    };
    if variant.difference {
        text += &forms::precise_beside(id);
        text += DIFFERENCE;
    } else {
        text += PLAIN;
    }
    show_source(id, variant.form, &(text + pass))
}

/// The whole text of a panel's pass on a mapping.
#[must_use]
pub fn panel_source(id: MappingId) -> String {
    show_source(id, ShaderForm::Precise, PANEL)
}

fn show_source(id: MappingId, form: ShaderForm, pass: &str) -> String {
    let covers_sphere = !id.info().coverage.has_cut();
    let mut text = format!("const MAP_COVERS_SPHERE = {covers_sphere};\n");
    text += &tone::wgsl_constants();
    text += &overlay::wgsl_constants();
    text += &super::map::wgsl_constants();
    shader::for_form(id, form, &(text + pass))
}

/// Layouts and samplers that all passes share.
#[derive(Clone, Debug)]
pub(super) struct Kit {
    pub gpu: Gpu,
    /// A block, a map, a sampler.
    pub lookup: wgpu::BindGroupLayout,
    /// A block at a moving offset, the environment, a sampler.
    pub bake: wgpu::BindGroupLayout,
    /// A material's block, a picture of a ball, traced paths.
    pub material: wgpu::BindGroupLayout,
    /// A picture.
    pub halve: wgpu::BindGroupLayout,
    /// A map as a cube.
    pub cube: wgpu::BindGroupLayout,
    forms: FormResources,
    /// Linear in all respects; never beyond the border.
    pub map_sampler: wgpu::Sampler,
    /// The same, but around the date line.
    pub environment_sampler: wgpu::Sampler,
}

impl Kit {
    pub fn new(gpu: Gpu) -> Self {
        let device = &gpu.device;
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries,
            })
        };
        let sampler = |label, address_mode_u| {
            device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some(label),
                address_mode_u,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                ..Default::default()
            })
        };
        let array = wgpu::TextureViewDimension::D2Array;
        let plain = wgpu::TextureViewDimension::D2;
        Self {
            lookup: layout(
                "lookup",
                &[block_entry(false), texture_entry(1, array), sampler_entry()],
            ),
            bake: layout(
                "bake",
                &[block_entry(true), texture_entry(1, plain), sampler_entry()],
            ),
            material: layout(
                "material",
                &[
                    block_entry(false),
                    texture_entry(1, plain),
                    wgpu::BindGroupLayoutEntry {
                        // Full floats, which not every adapter can filter; they are loaded.
                        ty: wgpu::BindingType::Texture {
                            sample_type: wgpu::TextureSampleType::Float { filterable: false },
                            view_dimension: array,
                            multisampled: false,
                        },
                        ..texture_entry(2, array)
                    },
                ],
            ),
            halve: layout("halve", &[texture_entry(0, plain)]),
            cube: forms::cube_layout(device),
            forms: FormResources::default(),
            map_sampler: sampler("map", wgpu::AddressMode::ClampToEdge),
            environment_sampler: sampler("environment", wgpu::AddressMode::Repeat),
            gpu,
        }
    }

    /// A pass that covers its target with one triangle and binds one group.
    pub fn screen_pipeline(
        &self,
        layout: &wgpu::BindGroupLayout,
        source: &str,
        fragment: &str,
        format: wgpu::TextureFormat,
    ) -> wgpu::RenderPipeline {
        let layout = self.pipeline_layout(&[Some(layout)]);
        self.screen_pipeline_with(&layout, source, fragment, format)
    }

    /// The same with any groups.
    pub fn screen_pipeline_with(
        &self,
        layout: &wgpu::PipelineLayout,
        source: &str,
        fragment: &str,
        format: wgpu::TextureFormat,
    ) -> wgpu::RenderPipeline {
        let module = self.module(fragment, source);
        self.gpu
            .device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(fragment),
                layout: Some(layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("screen_vertex"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(fragment),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(format.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
    }

    pub fn module(&self, label: &str, source: &str) -> wgpu::ShaderModule {
        self.gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            })
    }

    pub fn pipeline_layout(
        &self,
        layouts: &[Option<&wgpu::BindGroupLayout>],
    ) -> wgpu::PipelineLayout {
        self.gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: layouts,
                immediate_size: 0,
            })
    }

    /// The layout of the viewport's passes: what is looked up, what the object is made of, and what the form reads. One for the object
    /// and the sky, because a group is lost where the layout of one before it changes.
    pub fn viewport_layout(&self, form: ShaderForm) -> wgpu::PipelineLayout {
        let of_form = self.form_layout(form);
        let layouts = [Some(&self.lookup), Some(&self.material), of_form];
        self.pipeline_layout(&layouts[..2 + usize::from(of_form.is_some())])
    }

    /// The layout of a sky without an object.
    pub fn sky_layout(&self, form: ShaderForm) -> wgpu::PipelineLayout {
        match self.form_layout(form) {
            Some(of_form) => self.pipeline_layout(&[Some(&self.lookup), None, Some(of_form)]),
            None => self.pipeline_layout(&[Some(&self.lookup)]),
        }
    }

    fn form_layout(&self, form: ShaderForm) -> Option<&wgpu::BindGroupLayout> {
        match form {
            ShaderForm::CubeUnit => Some(&self.cube),
            _ => self.forms.of(&self.gpu, form).map(|(layout, _)| layout),
        }
    }

    /// What a form reads of a map, or besides it.
    pub fn form_group<'a>(&'a self, form: ShaderForm, map: &'a Map) -> Option<&'a wgpu::BindGroup> {
        match form {
            ShaderForm::CubeUnit => map.cube_group(),
            _ => self.forms.of(&self.gpu, form).map(|(_, group)| group),
        }
    }

    /// A buffer for one block.
    pub fn block_buffer(&self, label: &str, bytes: usize) -> wgpu::Buffer {
        self.gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }

    /// A block and a map, as [`lookup`](Self::lookup) lays them out.
    pub fn lookup_group(&self, block: &wgpu::Buffer, map: &wgpu::TextureView) -> wgpu::BindGroup {
        self.gpu
            .device
            .create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("lookup"),
                layout: &self.lookup,
                entries: &[
                    wgpu::BindGroupEntry {
                        binding: 0,
                        resource: block.as_entire_binding(),
                    },
                    wgpu::BindGroupEntry {
                        binding: 1,
                        resource: wgpu::BindingResource::TextureView(map),
                    },
                    wgpu::BindGroupEntry {
                        binding: 2,
                        resource: wgpu::BindingResource::Sampler(&self.map_sampler),
                    },
                ],
            })
    }

    /// Layers that a texture needs beyond `layers` so that it can be bound as an array of them. The GL interface takes one layer
    /// for no array and six square ones for a cube; a spare layer says what is meant.
    pub fn spare_layers(&self, layers: u32) -> u32 {
        let is_gl = self.gpu.adapter_info.backend == wgpu::Backend::Gl;
        u32::from(is_gl && (layers == 1 || layers.is_multiple_of(6)))
    }

    /// A texture of one layer and level that the screen can show and that can be read back.
    pub fn view_texture(&self, label: &str, [width, height]: [u32; 2]) -> wgpu::Texture {
        self.gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: VIEW_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        })
    }
}

fn block_entry(has_dynamic_offset: bool) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding: 0,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset,
            min_binding_size: None,
        },
        count: None,
    }
}

fn texture_entry(
    binding: u32,
    view_dimension: wgpu::TextureViewDimension,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension,
            multisampled: false,
        },
        count: None,
    }
}

fn sampler_entry() -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding: 2,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        count: None,
    }
}

/// A pass that clears its one target and draws on it.
pub(super) fn begin_pass<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    label: &str,
    target: &wgpu::TextureView,
) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Store,
            },
        })],
        depth_stencil_attachment: None,
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

/// Bytes of a texture with all its levels, layers and samples.
pub(super) fn texture_bytes(texture: &wgpu::Texture) -> u64 {
    let texel = u64::from(texture.format().block_copy_size(None).unwrap_or(4));
    let level = |l: u32| {
        u64::from((texture.width() >> l).max(1)) * u64::from((texture.height() >> l).max(1))
    };
    let texels: u64 = (0..texture.mip_level_count()).map(level).sum();
    texels * texel * u64::from(texture.depth_or_array_layers()) * u64::from(texture.sample_count())
}
