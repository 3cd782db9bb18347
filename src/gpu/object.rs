//! What the object of one side of the divider needs on the device: its material's numbers, a picture of a ball, traced paths.

use super::frame::Side;
use super::kit::Kit;
use super::program::Program;
use super::shared::Shared;
use super::uniforms::{MOST_WAVELENGTHS, Material, vec4};
use crate::imaging::ball::BallPixels;
use crate::optics;
use crate::optics::wavelengths::wavelengths;
use crate::scene::RayFrame;
use crate::scene::trace::Traced;

/// The object of one side.
#[derive(Debug)]
pub(super) struct ObjectSide {
    block: wgpu::Buffer,
    ball: Held<BallPixels>,
    traced: Held<Traced>,
    group: wgpu::BindGroup,
}

/// Shared data and its texture; a single black texel while there is none.
#[derive(Debug)]
struct Held<T> {
    data: Option<Shared<T>>,
    texture: wgpu::Texture,
}

impl ObjectSide {
    pub fn new(kit: &Kit, side: &Side<'_>) -> Self {
        let block = kit.block_buffer("material", size_of::<Material>());
        let (ball, traced) = wanted(side);
        let ball = Held {
            texture: ball_texture(kit, ball.as_deref()),
            data: ball,
        };
        let traced = Held {
            texture: traced_texture(kit, traced.as_deref()),
            data: traced,
        };
        let group = group(kit, &block, &ball.texture, &traced.texture);
        Self {
            block,
            ball,
            traced,
            group,
        }
    }

    /// Uploads what has changed.
    pub fn prepare(&mut self, kit: &Kit, side: &Side<'_>) {
        let (ball, traced) = wanted(side);
        if self.ball.data == ball && self.traced.data == traced {
            return;
        }
        if self.ball.data != ball {
            self.ball.texture = ball_texture(kit, ball.as_deref());
            self.ball.data = ball;
        }
        if self.traced.data != traced {
            self.traced.texture = traced_texture(kit, traced.as_deref());
            self.traced.data = traced;
        }
        self.group = group(kit, &self.block, &self.ball.texture, &self.traced.texture);
    }

    /// Sends the material's numbers.
    pub fn write(&self, kit: &Kit, side: &Side<'_>, rays: RayFrame) {
        let layers = self.traced.data.as_ref().map_or(0, |traced| traced.layers);
        let block = material_block(&side.object.material, layers, rays);
        kit.gpu
            .queue
            .write_buffer(&self.block, 0, bytemuck::bytes_of(&block));
    }

    pub fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    /// The textures that hold something, for the count.
    pub fn textures(&self) -> impl Iterator<Item = &wgpu::Texture> {
        let ball = self.ball.data.is_some().then_some(&self.ball.texture);
        let traced = self.traced.data.is_some().then_some(&self.traced.texture);
        ball.into_iter().chain(traced)
    }
}

/// What the side's program looks at; what it does not is left out.
fn wanted(side: &Side<'_>) -> (Option<Shared<BallPixels>>, Option<Shared<Traced>>) {
    let is_ball = side.program == Program::Ball;
    let is_traced = matches!(side.program, Program::Traced | Program::TracedDifference(_));
    (
        side.object.ball.clone().filter(|_| is_ball),
        side.object.traced.clone().filter(|_| is_traced),
    )
}

fn material_block(material: &optics::Material, layers: u32, rays: RayFrame) -> Material {
    let by_angle = f32::from(u8::from(material.opacity_by_angle));
    let [n, k] = [0, 1].map(|part| {
        let [r, g, b] = material.metal.index_rgb().map(|index| index[part] as f32);
        [r, g, b, 0.0]
    });
    let mut block = Material {
        interface_: [
            material.eta(),
            material.opacity,
            by_angle,
            material.magnification,
        ],
        shape: [
            material.shape.exponent,
            material.shape.bias,
            material.shape.scale,
            material.shape.power,
        ],
        metal_n: n,
        metal_k: k,
        counts: [0.0, material.bounces as f32, layers as f32, 0.0],
        screen_right: vec4(rays.right.normalize_or_zero().to_array(), 0.0),
        screen_up: vec4(rays.up.normalize_or_zero().to_array(), 0.0),
        wavelengths: [[0.0; 4]; MOST_WAVELENGTHS],
    };
    let mut count = 0.0;
    for (slot, line) in block.wavelengths.iter_mut().zip(wavelengths(material)) {
        *slot = vec4(line.rgb, line.eta);
        count += 1.0;
    }
    block.counts[0] = count;
    block
}

fn ball_texture(kit: &Kit, image: Option<&BallPixels>) -> wgpu::Texture {
    let black = [0, 0, 0, 255];
    let (size, bytes): ([u32; 2], &[u8]) =
        image.map_or(([1, 1], &black), |image| (image.size, &image.rgba));
    let format = wgpu::TextureFormat::Rgba8Unorm;
    upload(kit, "ball picture", format, size, [1, 0], bytes)
}

fn traced_texture(kit: &Kit, traced: Option<&Traced>) -> wgpu::Texture {
    let none = [[0.0_f32; 4]];
    let (size, layers, dirs): ([u32; 2], u32, &[[f32; 4]]) =
        traced.map_or(([1, 1], 1, &none), |t| (t.size, t.layers, &t.dirs));
    let format = wgpu::TextureFormat::Rgba32Float;
    upload(
        kit,
        "traced",
        format,
        size,
        [layers, kit.spare_layers(layers)],
        bytemuck::cast_slice(dirs),
    )
}

/// A texture of `layers` that are filled, and `spare` ones that are not.
fn upload(
    kit: &Kit,
    label: &str,
    format: wgpu::TextureFormat,
    [width, height]: [u32; 2],
    [layers, spare]: [u32; 2],
    bytes: &[u8],
) -> wgpu::Texture {
    let size = wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: layers,
    };
    let texture = kit.gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            depth_or_array_layers: layers + spare,
            ..size
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let row = width * format.block_copy_size(None).unwrap_or(4);
    kit.gpu.queue.write_texture(
        texture.as_image_copy(),
        bytes,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: Some(height),
        },
        size,
    );
    texture
}

fn group(
    kit: &Kit,
    block: &wgpu::Buffer,
    ball: &wgpu::Texture,
    traced: &wgpu::Texture,
) -> wgpu::BindGroup {
    let ball = ball.create_view(&wgpu::TextureViewDescriptor::default());
    let traced = traced.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    });
    kit.gpu
        .device
        .create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("material"),
            layout: &kit.material,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: block.as_entire_binding(),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::TextureView(&ball),
                },
                wgpu::BindGroupEntry {
                    binding: 2,
                    resource: wgpu::BindingResource::TextureView(&traced),
                },
            ],
        })
}
