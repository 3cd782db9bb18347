//! Pixels back from the device.

use std::sync::mpsc::{Receiver, TryRecvError, channel};

use half::f16;

use super::kit::VIEW_FORMAT;
use super::renderer::RenderError;
use super::{Gpu, GpuError};

/// A picture of display values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RgbaPixels {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue, alpha, row by row from the top.
    pub rgba: Vec<u8>,
}

impl RgbaPixels {
    /// The pixel in column `x` and row `y`.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let at = 4 * (y as usize * self.width as usize + x as usize);
        self.rgba.get(at..at + 4)?.try_into().ok()
    }
}

/// A level of one chart with its gutter.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPixels {
    /// Texels in a row, both gutters included.
    pub width: u32,
    /// Rows, both gutters included.
    pub height: u32,
    /// Texels of the gutter on each side.
    pub gutter: u32,
    /// Linear light, row by row from the top.
    pub rgb: Vec<[f32; 3]>,
}

/// A part of one layer and level of a texture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub layer: u32,
    pub level: u32,
    pub origin: [u32; 2],
    pub size: [u32; 2],
}

impl Part {
    /// All of layer 0, level 0.
    pub fn whole(texture: &wgpu::Texture) -> Self {
        Self {
            layer: 0,
            level: 0,
            origin: [0, 0],
            size: [texture.width(), texture.height()],
        }
    }
}

/// Copies a part into a new buffer. Returns it with its bytes in a row and in all.
fn copy_out(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    part: Part,
) -> Result<(wgpu::Buffer, u64), GpuError> {
    let texel = u64::from(texture.format().block_copy_size(None).unwrap_or(4));
    let [width, height] = part.size;
    let row = padded(u64::from(width) * texel);
    let bytes = row * u64::from(height);
    let buffer = gpu.checked(|device| {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read back"),
            size: bytes,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: part.level,
                origin: wgpu::Origin3d {
                    x: part.origin[0],
                    y: part.origin[1],
                    z: part.layer,
                },
                aspect: wgpu::TextureAspect::All,
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row as u32),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
        );
        gpu.queue.submit([encoder.finish()]);
        buffer
    })?;
    Ok((buffer, bytes))
}

/// Bytes of a row in a buffer that a texture is copied to.
fn padded(bytes: u64) -> u64 {
    bytes.next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT))
}

/// Waits for a part and returns its bytes without padding.
pub(super) fn read_part(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    part: Part,
) -> Result<Vec<u8>, RenderError> {
    let texel = u64::from(texture.format().block_copy_size(None).unwrap_or(4));
    let row = u64::from(part.size[0]) * texel;
    let (buffer, bytes) = copy_out(gpu, texture, part)?;
    let padded_rows = gpu.read_buffer(&buffer, bytes)?;
    let rows = padded_rows.chunks_exact(padded(row) as usize);
    Ok(rows
        .flat_map(|r| r.iter().take(row as usize).copied())
        .collect())
}

/// Waits for a whole picture of display values.
pub fn read_view(gpu: &Gpu, texture: &wgpu::Texture) -> Result<RgbaPixels, RenderError> {
    if texture.format() != VIEW_FORMAT {
        return Err(RenderError::Gpu(GpuError::Refused(
            "only pictures of display values can be read".into(),
        )));
    }
    Ok(RgbaPixels {
        width: texture.width(),
        height: texture.height(),
        rgba: read_part(gpu, texture, Part::whole(texture))?,
    })
}

/// The light in bytes of half floats.
pub(super) fn light_from_bytes(bytes: &[u8]) -> Vec<[f32; 3]> {
    let half = |b: &[u8], at: usize| {
        let bits = [
            b.get(at).copied().unwrap_or(0),
            b.get(at + 1).copied().unwrap_or(0),
        ];
        f16::from_le_bytes(bits).to_f32()
    };
    bytes
        .chunks_exact(8)
        .map(|texel| [half(texel, 0), half(texel, 2), half(texel, 4)])
        .collect()
}

/// A texel on its way back from the device.
#[derive(Debug)]
pub struct TexelRead {
    gpu: Gpu,
    buffer: wgpu::Buffer,
    bytes: u64,
    mapped: Receiver<Result<(), wgpu::BufferAsyncError>>,
}

impl TexelRead {
    /// Sends for one texel.
    pub(super) fn begin(
        gpu: &Gpu,
        texture: &wgpu::Texture,
        layer: u32,
        origin: [u32; 2],
    ) -> Result<Self, RenderError> {
        let part = Part {
            layer,
            level: 0,
            origin,
            size: [1, 1],
        };
        let (buffer, bytes) = copy_out(gpu, texture, part)?;
        let (sender, mapped) = channel();
        buffer.map_async(wgpu::MapMode::Read, ..bytes, move |result| {
            // Nobody listens when the read was given up.
            let _ = sender.send(result);
        });
        Ok(Self {
            gpu: gpu.clone(),
            buffer,
            bytes,
            mapped,
        })
    }

    /// The texel's linear light once it is there; never waits. Ask again after `None`, not after an answer.
    pub fn poll(&self) -> Option<Result<[f32; 3], RenderError>> {
        if self.gpu.is_lost() {
            return Some(Err(RenderError::DeviceLost("while reading a texel".into())));
        }
        // An error here comes back through the channel or as the loss above.
        let _ = self.gpu.device.poll(wgpu::PollType::Poll);
        match self.mapped.try_recv() {
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(GpuError::Timeout.into())),
            Ok(Err(error)) => Some(Err(GpuError::Refused(error.to_string()).into())),
            Ok(Ok(())) => Some(self.texel()),
        }
    }

    fn texel(&self) -> Result<[f32; 3], RenderError> {
        let view = self
            .buffer
            .get_mapped_range(..self.bytes)
            .map_err(|error| GpuError::Refused(error.to_string()))?;
        let light = light_from_bytes(&view).first().copied();
        light.ok_or_else(|| GpuError::Refused("an empty answer".into()).into())
    }
}
