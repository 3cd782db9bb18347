//! The texts of the shaders' forms, and what of them lies on the device.

use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, OnceLock};

use super::Gpu;
use super::shader::{horner, line};
use crate::mapping::{MappingId, ShaderForm};
use crate::math::{ATAN_COEFFICIENTS, COS_QUARTER_COEFFICIENTS, SIN_QUARTER_COEFFICIENTS};

/// Steps of the table in a texture: as near as a polynomial of degree 11, which needs twelve operations.
pub const TABLE_STEPS: u32 = 256;
/// Bind group of what a form reads: the table's texture.
pub const FORM_GROUP: u32 = 2;

const PRECISE: &str = include_str!("../../shaders/angles/precise.wgsl");
const SHORT: &str = include_str!("../../shaders/angles/short.wgsl");
const SERIES: &str = include_str!("../../shaders/angles/series.wgsl");
const TABLE: &str = include_str!("../../shaders/angles/table.wgsl");
const OCTANTS: &str = include_str!("../../shaders/angles/octants.wgsl");
const BUILT_IN: &str = include_str!("../../shaders/angles/built_in.wgsl");
const CCM_BENT: &str = include_str!("../../shaders/ccm_bent.wgsl");
const CUBE_BENT: &str = include_str!("../../shaders/cube_bent.wgsl");

/// The angles of a form, after `shaders/math.wgsl`.
#[must_use]
pub fn angles(form: ShaderForm) -> String {
    match form {
        ShaderForm::BuiltIn => BUILT_IN.to_owned(),
        ShaderForm::Table => {
            format!("const TABLE_STEPS: f32 = {TABLE_STEPS}.0;\n") + TABLE + OCTANTS
        }
        _ => {
            series(form)
                + if form.level().is_some() {
                    SHORT
                } else {
                    PRECISE
                }
                + SERIES
                + OCTANTS
        }
    }
}

/// The polynomials of a form: `atan_series`, `sin_quarter_series`, `cos_quarter_series`.
fn series(form: ShaderForm) -> String {
    let (atan, sin, cos) = match form.level() {
        // Shaders count in radians.
        Some(level) => (
            level.quarters.iter().map(|c| radians(*c)).collect(),
            level.sin,
            level.cos,
        ),
        None => (
            ATAN_COEFFICIENTS.to_vec(),
            &SIN_QUARTER_COEFFICIENTS[..],
            &COS_QUARTER_COEFFICIENTS[..],
        ),
    };
    let mut text = String::new();
    for (name, coefficients) in [
        ("atan_series", &atan[..]),
        ("sin_quarter_series", sin),
        ("cos_quarter_series", cos),
    ] {
        let sum = horner(coefficients, "s");
        line(
            &mut text,
            format_args!("fn {name}(s: f32) -> f32 {{ return {sum}; }}"),
        );
    }
    text
}

/// Radians of quarter turns.
#[must_use]
pub fn radians(quarters: f32) -> f32 {
    (f64::from(quarters) * FRAC_PI_2) as f32
}

/// What bends a direction of a mapping, after the mappings' files.
pub(super) fn bent(id: MappingId, form: ShaderForm) -> &'static str {
    match (form, id) {
        (ShaderForm::CubeUnit, MappingId::Cube) => CUBE_BENT,
        (ShaderForm::CubeUnit, _) => CCM_BENT,
        _ => "",
    }
}

/// The forward function of a role.
pub(super) fn forward(role: &str, prefix: &str, form: ShaderForm) -> String {
    let body = match form {
        ShaderForm::CubeUnit => format!("cube_forward({role}_bent(dir))"),
        _ => format!("{prefix}_forward(dir)"),
    };
    let forward = format!("fn {role}_forward(dir: vec3f) -> ChartPoint {{ return {body}; }}");
    match form {
        ShaderForm::CubeUnit => {
            let bent =
                format!("fn {role}_bent(dir: vec3f) -> vec3f {{ return {prefix}_bent(dir); }}");
            bent + "\n" + &forward
        }
        _ => forward,
    }
}

/// The precise functions of a mapping beside those of another form: the language has no modules, so that each name is
/// prefixed. They are called `precise_map_forward` and `precise_map_inverse`.
#[must_use]
pub fn precise_beside(id: MappingId) -> String {
    let text = angles(ShaderForm::Precise) + id.wgsl();
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let after = |keyword| {
        let declarations = text.split(keyword).skip(1);
        declarations.filter_map(move |rest| rest.split(|c| !is_name(c)).next())
    };
    let declared: Vec<&str> = after("fn ").chain(after("const ")).collect();
    let mut beside = String::new();
    let mut rest = &text[..];
    while let Some(first) = rest.chars().next() {
        let length = rest.find(|c| is_name(c) != is_name(first));
        let (word, others) = rest.split_at(length.unwrap_or(rest.len()));
        if declared.contains(&word) {
            beside.push_str("precise_");
        }
        beside.push_str(word);
        rest = others;
    }
    let prefix = id.prefix();
    beside
        + &format!(
            "fn precise_map_forward(dir: vec3f) -> ChartPoint {{ return precise_{prefix}_forward(dir); }}\n\
             fn precise_map_inverse(p: ChartPoint) -> vec3f {{ return precise_{prefix}_inverse(p); }}\n"
        )
}

/// The layout of a texture that a form reads.
fn texture_layout(
    device: &wgpu::Device,
    visibility: wgpu::ShaderStages,
    filterable: bool,
    view_dimension: wgpu::TextureViewDimension,
) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("form"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable },
                view_dimension,
                multisampled: false,
            },
            count: None,
        }],
    })
}

/// A texture as a form reads it.
pub(super) fn texture_group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    view: &wgpu::TextureView,
) -> wgpu::BindGroup {
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("form"),
        layout,
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: wgpu::BindingResource::TextureView(view),
        }],
    })
}

/// The layout of a map as a cube.
pub(super) fn cube_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let stage = wgpu::ShaderStages::FRAGMENT;
    texture_layout(device, stage, true, wgpu::TextureViewDimension::Cube)
}

/// What forms read, on one device; made when it is first asked for. Clones share it.
#[derive(Clone, Debug, Default)]
pub struct FormResources(Arc<OnceLock<Table>>);

/// The table's texture, ready to be bound as [`FORM_GROUP`].
#[derive(Debug)]
struct Table {
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
}

impl FormResources {
    /// The layout and the group that a form's passes bind; `None` where they bind none.
    pub(super) fn of(
        &self,
        gpu: &Gpu,
        form: ShaderForm,
    ) -> Option<(&wgpu::BindGroupLayout, &wgpu::BindGroup)> {
        if form != ShaderForm::Table {
            return None;
        }
        let table = self.0.get_or_init(|| Table::new(gpu));
        Some((&table.layout, &table.group))
    }
}

impl Table {
    fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let stages = wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE;
        let plain = wgpu::TextureViewDimension::D2;
        let layout = texture_layout(device, stages, false, plain);
        let size = wgpu::Extent3d {
            width: TABLE_STEPS + 1,
            height: 3,
            depth_or_array_layers: 1,
        };
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("angles"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        gpu.queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(&entries()),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * size.width),
                rows_per_image: None,
            },
            size,
        );
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let group = texture_group(device, &layout, &view);
        Self { layout, group }
    }
}

/// The rows of `shaders/angles/table.wgsl`.
fn entries() -> Vec<f32> {
    let rows: [fn(f64) -> f64; 3] = [
        f64::atan,
        |t| (t * (0.5 * FRAC_PI_2)).sin(),
        |t| (t * (0.5 * FRAC_PI_2)).cos(),
    ];
    let places = |row: fn(f64) -> f64| {
        (0..=TABLE_STEPS).map(move |k| row(f64::from(k) / f64::from(TABLE_STEPS)) as f32)
    };
    rows.into_iter().flat_map(places).collect()
}
