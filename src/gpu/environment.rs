//! The environment as the maps are baked from it: a latlong picture with its mip chain.

use half::f16;

use super::Gpu;
use super::kit::{HALVE, Kit, LIGHT_FORMAT, begin_pass};
use super::renderer::RenderError;

/// A latlong picture of linear light, borrowed: row 0 at the top, the centre looks along +z, +x to the right.
#[derive(Clone, Copy, Debug)]
pub struct EnvironmentSource<'a> {
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green and blue, row by row; finite and not negative.
    pub pixels: &'a [[f32; 3]],
}

/// The environment on the device. It can be made on any thread and handed to the renderer.
#[derive(Debug)]
pub struct EnvironmentTexture {
    pub(super) texture: wgpu::Texture,
    pub(super) view: wgpu::TextureView,
}

impl EnvironmentTexture {
    /// Uploads the picture and halves it on the device down to one texel. A picture larger than the device's textures is
    /// halved before that until it fits. Takes long for a large picture, so it belongs on a thread of its own.
    pub fn new(gpu: &Gpu, source: EnvironmentSource<'_>) -> Result<Self, RenderError> {
        let (width, height) = (source.width as usize, source.height as usize);
        if width == 0 || height == 0 || source.pixels.len() != width.saturating_mul(height) {
            return Err(RenderError::BadEnvironment {
                width: source.width,
                height: source.height,
                pixels: source.pixels.len(),
            });
        }
        let kit = &Kit::new(gpu.clone());
        let most = kit.gpu.device.limits().max_texture_dimension_2d as usize;
        let shrink = width.max(height).div_ceil(most).next_power_of_two();
        let size = [(width / shrink).max(1), (height / shrink).max(1)];
        let half = halves(source.pixels, [width, height], size, shrink);
        kit.gpu
            .checked(|_| Self::upload(kit, &half, size.map(|n| n as u32)))
            .map_err(RenderError::from)
    }

    fn upload(kit: &Kit, half: &[[f16; 4]], [width, height]: [u32; 2]) -> Self {
        let device = &kit.gpu.device;
        let size = wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        };
        let levels = size.max_mips(wgpu::TextureDimension::D2);
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("environment"),
            size,
            mip_level_count: levels,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: LIGHT_FORMAT,
            usage: wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        kit.gpu.queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(half),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(width * size_of::<[f16; 4]>() as u32),
                rows_per_image: None,
            },
            size,
        );

        let pipeline = kit.screen_pipeline(&kit.halve, HALVE, "halve_fragment", LIGHT_FORMAT);
        let level_view = |level| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                base_mip_level: level,
                mip_level_count: Some(1),
                ..Default::default()
            })
        };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for level in 1..levels {
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("halve"),
                layout: &kit.halve,
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&level_view(level - 1)),
                }],
            });
            let target = level_view(level);
            let mut pass = begin_pass(&mut encoder, "halve", &target);
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &group, &[]);
            pass.draw(0..3, 0..1);
        }
        kit.gpu.queue.submit([encoder.finish()]);
        Self {
            view: texture.create_view(&wgpu::TextureViewDescriptor::default()),
            texture,
        }
    }

    /// Texels in a radian, and the last level.
    pub(super) fn resolution(&self) -> [f32; 2] {
        [
            self.texture.height() as f32 * std::f32::consts::FRAC_1_PI,
            (self.texture.mip_level_count() - 1) as f32,
        ]
    }
}

/// Half floats of the picture at `size`, each the mean of `shrink` x `shrink` texels.
fn halves(
    pixels: &[[f32; 3]],
    [width, _]: [usize; 2],
    size: [usize; 2],
    shrink: usize,
) -> Vec<[f16; 4]> {
    let mut result = Vec::with_capacity(size[0] * size[1]);
    let weight = 1.0 / (shrink * shrink) as f32;
    for j in 0..size[1] {
        for i in 0..size[0] {
            let mut sum = [0.0f32; 3];
            for y in 0..shrink {
                let start = (j * shrink + y) * width + i * shrink;
                for pixel in pixels.iter().skip(start).take(shrink) {
                    for (total, light) in sum.iter_mut().zip(pixel) {
                        *total += light * weight;
                    }
                }
            }
            let [r, g, b] = sum.map(half_from);
            result.push([r, g, b, f16::ONE]);
        }
    }
    result
}

/// The nearest half float, at most the largest one; 0 for what is no light.
fn half_from(x: f32) -> f16 {
    f16::from_f32(x.max(0.0).min(f16::MAX.to_f32()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_means_and_finite() {
        let pixels = [[0.0; 3], [2.0; 3], [4.0; 3], [6.0; 3]];
        let one = halves(&pixels, [2, 2], [1, 1], 2);
        assert_eq!(one[0][0].to_f32(), 3.0);
        assert_eq!(halves(&pixels, [2, 2], [2, 2], 1)[3][2].to_f32(), 6.0);
        assert_eq!(half_from(1e9).to_f32(), 65504.0);
        assert_eq!(half_from(f32::NAN).to_f32(), 0.0);
    }
}
