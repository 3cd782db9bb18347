//! A mapping's own texture: one layer for each chart, with a gutter of true neighbours around it.

use super::environment::EnvironmentTexture;
use super::forms::texture_group;
use super::kit::{Kit, LIGHT_FORMAT, bake_source, begin_pass};
use super::uniforms::{Bake, vec4};
use crate::mapping::{ChartPoint, MappingId};
use crate::math::Rotation;

/// Mip levels of a map: texels down to a sixteenth.
pub const MAP_LEVELS: u32 = 5;
/// Texels around a chart at level 0: one is left at the last level, which linear filtering needs there.
pub const GUTTER: u32 = 1 << (MAP_LEVELS - 1);

/// The constants in capitals of `shaders/lookup.wgsl`.
pub(super) fn wgsl_constants() -> String {
    format!("const MAP_LEVELS: u32 = {MAP_LEVELS}u;\nconst GUTTER: u32 = {GUTTER}u;\n")
}

/// Widest chart in texels: with its gutters it fills a texture of 8192, which every adapter has.
pub const WIDEST: u32 = 8192 - 2 * GUTTER;

/// Width and height of a mapping's charts in texels, without the gutter, such that all charts together have about `budget`
/// texels and a texel is as high as it is wide. Multiples of [`GUTTER`], so that every level is halved exactly. A chart is never
/// wider than every adapter's textures, [`WIDEST`]; one that would be is made smaller as a whole.
#[must_use]
pub fn map_size(id: MappingId, budget: u32) -> [u32; 2] {
    let info = id.info();
    let rows = (f64::from(budget) / (f64::from(info.chart_count()) * info.aspect)).sqrt();
    let rows = rows.min(f64::from(WIDEST) / info.aspect.max(1.0));
    let unit = f64::from(GUTTER);
    // At most 2^16 * sqrt(pi): far within u32.
    [rows * info.aspect, rows].map(|n| ((n / unit).round().max(1.0) * unit) as u32)
}

/// The texture of one mapping.
#[derive(Debug)]
pub(super) struct Map {
    pub texture: wgpu::Texture,
    pub view: wgpu::TextureView,
    /// Width and height of a chart in texels.
    pub size: [u32; 2],
    /// No texel is smaller than this, in the shaders' measure.
    pub finest_rad: f32,
    /// The charts as the faces of a cube, without gutters, for the cube sampler.
    cube: Option<Cube>,
}

#[derive(Debug)]
struct Cube {
    texture: wgpu::Texture,
    group: wgpu::BindGroup,
}

/// The smallest side of a texel in radians, in the measure of `shaders/footprint.wgsl`, when charts are one texel high:
/// for N rows divide by N. Taken over a grid, with a margin of a fifth for what lies between.
fn finest_texel_rad(id: MappingId) -> f32 {
    const STEPS: u32 = 24;
    let info = id.info();
    let mut finest = f64::MAX;
    for chart in 0..info.chart_count() {
        for k in 0..STEPS * STEPS {
            let [u, v] = [k % STEPS, k / STEPS].map(|n| (f64::from(n) + 0.5) / f64::from(STEPS));
            if let Some((_, jacobian)) = id.jacobian(ChartPoint::new(chart, u, v)) {
                let longest = (jacobian.du.length() / info.aspect).max(jacobian.dv.length());
                let side = (jacobian.area_scale() / info.aspect).sqrt();
                finest = finest.min(side.max(0.5 * longest));
            }
        }
    }
    (0.8 * finest) as f32
}

/// A texture with all levels of so many charts.
fn layers(kit: &Kit, [width, height]: [u32; 2], count: u32) -> wgpu::Texture {
    kit.gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("map"),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: count,
        },
        mip_level_count: MAP_LEVELS,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: LIGHT_FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

impl Map {
    /// An empty map, `as_cube` also as a cube.
    pub fn new(kit: &Kit, id: MappingId, size: [u32; 2], as_cube: bool) -> Self {
        let charts = id.info().chart_count();
        let with_gutter = size.map(|n| n + 2 * GUTTER);
        let texture = layers(kit, with_gutter, charts + kit.spare_layers(charts));
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        let cube = (as_cube && charts == 6 && size[0] == size[1]).then(|| {
            let texture = layers(kit, size, charts);
            let view = texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::Cube),
                ..Default::default()
            });
            let group = texture_group(&kit.gpu.device, &kit.cube, &view);
            Cube { texture, group }
        });
        Self {
            texture,
            view,
            size,
            finest_rad: finest_texel_rad(id) / size[1] as f32,
            cube,
        }
    }

    /// True when it is a cube, too.
    pub fn is_cube(&self) -> bool {
        self.cube.is_some()
    }

    /// The cube as a form reads it.
    pub fn cube_group(&self) -> Option<&wgpu::BindGroup> {
        self.cube.as_ref().map(|cube| &cube.group)
    }

    /// Its textures, for the count.
    pub fn textures(&self) -> impl Iterator<Item = &wgpu::Texture> {
        let cube = self.cube.iter().map(|cube| &cube.texture);
        std::iter::once(&self.texture).chain(cube)
    }

    /// Compiles the pass that fills the maps of `id`.
    pub fn pipeline(kit: &Kit, id: MappingId) -> wgpu::RenderPipeline {
        kit.screen_pipeline(&kit.bake, &bake_source(id), "bake_fragment", LIGHT_FORMAT)
    }

    /// Fills every level of every chart.
    pub fn bake(
        &self,
        kit: &Kit,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::RenderPipeline,
        id: MappingId,
        environment: &EnvironmentTexture,
        rotation: Rotation,
    ) {
        let device = &kit.gpu.device;
        let charts = id.info().chart_count();
        let gutters = [GUTTER, 0];
        let targets: Vec<(&wgpu::Texture, u32, u32, u32)> = self
            .textures()
            .zip(gutters)
            .flat_map(|(texture, gutter)| (0..charts).map(move |chart| (texture, gutter, chart)))
            .flat_map(|(texture, gutter, chart)| {
                (0..MAP_LEVELS).map(move |level| (texture, gutter, chart, level))
            })
            .collect();

        // One block for each target, at the offsets that the device allows.
        let stride = device.limits().min_uniform_buffer_offset_alignment as usize;
        let stride = stride
            .max(size_of::<Bake>())
            .next_multiple_of(stride.max(1));
        let mut bytes = vec![0u8; stride * targets.len()];
        let [texels_per_rad, last_level] = environment.resolution();
        let columns = rotation
            .world_from_source()
            .map(|row| vec4(row.map(|x| x as f32), 0.0));
        for (place, (_, gutter, chart, level)) in bytes.chunks_exact_mut(stride).zip(&targets) {
            let block = Bake {
                chart: [
                    (self.size[0] >> level) as f32,
                    (self.size[1] >> level) as f32,
                    (gutter >> level) as f32,
                    *chart as f32,
                ],
                environment: [texels_per_rad, last_level, 0.0, 0.0],
                environment_from_world: columns,
            };
            let (head, _) = place.split_at_mut(size_of::<Bake>());
            head.copy_from_slice(bytemuck::bytes_of(&block));
        }
        let blocks = kit.block_buffer("bake", bytes.len());
        kit.gpu.queue.write_buffer(&blocks, 0, &bytes);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("bake"),
            layout: &kit.bake,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer: &blocks,
                        offset: 0,
                        size: wgpu::BufferSize::new(size_of::<Bake>() as u64),
                    }),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::TextureView(&environment.view),
                },
                wgpu::BindGroupEntry {
                    binding: 2,
                    resource: wgpu::BindingResource::Sampler(&kit.environment_sampler),
                },
            ],
        });
        for (i, (texture, _, chart, level)) in targets.into_iter().enumerate() {
            let target = texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: chart,
                array_layer_count: Some(1),
                base_mip_level: level,
                mip_level_count: Some(1),
                ..Default::default()
            });
            let mut pass = begin_pass(encoder, "bake", &target);
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &group, &[(i * stride) as u32]);
            pass.draw(0..3, 0..1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mapping_gets_the_same_number_of_texels() {
        for &id in MappingId::ALL {
            let info = id.info();
            for budget in [100_000u32, 393_216, 4_000_000] {
                let [w, h] = map_size(id, budget);
                assert!(w % GUTTER == 0 && h % GUTTER == 0);
                let texels = f64::from(w) * f64::from(h) * f64::from(info.chart_count());
                // Rounding each side to a multiple of 16 moves it by 8 at most.
                let slack = (1.0 + 8.0 / f64::from(w)) * (1.0 + 8.0 / f64::from(h)) - 1.0;
                let off = (texels / f64::from(budget) - 1.0).abs();
                assert!(off < 1.1 * slack, "{id}: {w} x {h} for {budget}");
                assert!(f64::from(w) / f64::from(h) / info.aspect - 1.0 < 1.1 * slack);
            }
            assert_eq!(map_size(id, 0)[1], GUTTER, "never empty");
            // However many texels are asked for, the widest side fits and keeps its shape.
            let [w, h] = map_size(id, u32::MAX);
            assert!(
                w.max(h) <= WIDEST && w.max(h) + GUTTER > WIDEST,
                "{id}: {w} x {h}"
            );
            assert!((f64::from(w) / f64::from(h) / info.aspect - 1.0).abs() < 0.01);
            assert!(map_size(id, u32::MAX)[0] < 1 << 18);
        }
        assert_eq!(map_size(MappingId::Ccm, 6 * 256 * 256), [256, 256]);
        assert_eq!(map_size(MappingId::Latlong, 512 * 1024), [1024, 512]);
        assert_ne!(
            map_size(MappingId::Cube, 6 * 256 * 256),
            map_size(MappingId::Sphere, 6 * 256 * 256)
        );
    }
}
