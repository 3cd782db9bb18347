//! The explorer on a texture of its own instead of a window's surface: the same drawing code, at any size.

use std::sync::Arc;

use egui::mutex::RwLock;
use egui::{Context, FullOutput, RawInput, Rect, ViewportId, ViewportInfo, vec2};

use super::explorer::Explorer;
use super::model::Surroundings;
use super::picture::{MAX_SIDE, What};
use super::state::AppState;
use super::theme;
use crate::gpu::Gpu;
use crate::gpu::readback::read_view;

/// An explorer that draws into a texture.
pub struct Offscreen {
    /// What is drawn.
    pub explorer: Explorer,
    ctx: Context,
    gpu: Gpu,
    painter: Arc<RwLock<egui_wgpu::Renderer>>,
    texture: wgpu::Texture,
    what: What,
    size: [u32; 2],
    /// Pixels per point.
    scale: f32,
    /// Why the last frame is not whole.
    fault: Option<String>,
}

impl Offscreen {
    /// A texture of `size` pixels, 1 to [`MAX_SIDE`] a side, on which nothing is drawn yet.
    ///
    /// # Errors
    /// When the device has no room for it.
    pub fn new(gpu: &Gpu, state: AppState, what: What, size: [u32; 2]) -> Result<Self, String> {
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let texture = gpu
            .checked(|device| {
                device.create_texture(&wgpu::TextureDescriptor {
                    label: Some("picture"),
                    size: wgpu::Extent3d {
                        width: size[0],
                        height: size[1],
                        depth_or_array_layers: 1,
                    },
                    mip_level_count: 1,
                    sample_count: 1,
                    dimension: wgpu::TextureDimension::D2,
                    format,
                    usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
                    view_formats: &[],
                })
            })
            .map_err(|error| error.to_string())?;
        // Without dithering the same scene gives the same bytes.
        let options = egui_wgpu::RendererOptions {
            dithering: false,
            ..Default::default()
        };
        let painter = egui_wgpu::Renderer::new(&gpu.device, format, options);
        let painter = Arc::new(RwLock::new(painter));
        let ctx = Context::default();
        theme::install(&ctx);
        Ok(Self {
            explorer: Explorer::new(gpu.clone(), Arc::clone(&painter), state),
            ctx,
            gpu: gpu.clone(),
            painter,
            texture,
            what,
            size,
            scale: points_scale(what, size),
            fault: None,
        })
    }

    /// Puts surroundings there; from now on every map is drawn at once.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub fn show_complete(&mut self, surroundings: Surroundings) -> Result<(), String> {
        self.explorer.show_now(surroundings, true)
    }

    /// Puts surroundings there; maps are drawn one a frame, as in a window.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub fn show(&mut self, surroundings: Surroundings) -> Result<(), String> {
        self.explorer.show_now(surroundings, false)
    }

    /// Lays out and draws one frame.
    pub fn frame(&mut self) {
        let (what, explorer) = (self.what, &mut self.explorer);
        let output = self
            .ctx
            .run_ui(raw_input(self.size, self.scale), |ui| match what {
                What::Window => explorer.ui(ui),
                what => explorer.view_alone_ui(ui, what),
            });
        let gpu = self.gpu.clone();
        let painted = gpu.checked(|_| self.paint(output));
        let fault = gpu.take_error();
        self.fault = painted.err().map(|error| error.to_string()).or(fault);
    }

    /// egui's context, for commands.
    pub fn ctx(&self) -> &Context {
        &self.ctx
    }

    /// Waits for the last frame's pixels: RGBA, row 0 at the top, opaque.
    ///
    /// # Errors
    /// When the device fails.
    pub fn read(&self) -> Result<Vec<u8>, String> {
        if let Some(fault) = &self.fault {
            return Err(format!("the picture could not be drawn: {fault}"));
        }
        let pixels = read_view(&self.gpu, &self.texture).map_err(|error| error.to_string())?;
        let mut rgba = pixels.rgba;
        for pixel in rgba.chunks_exact_mut(4) {
            pixel[3] = 255;
        }
        Ok(rgba)
    }

    fn paint(&self, output: FullOutput) {
        let FullOutput {
            mut textures_delta,
            shapes,
            ..
        } = output;
        let (device, queue) = (&self.gpu.device, &self.gpu.queue);
        let mut painter = self.painter.write();
        for (id, changes) in &textures_delta.set {
            for change in changes {
                painter.update_texture(device, queue, *id, change);
            }
        }
        let freed = std::mem::take(&mut textures_delta.free);
        textures_delta.clear();
        let shapes = self.ctx.tessellate(shapes, self.scale);
        let screen = egui_wgpu::ScreenDescriptor {
            size_in_pixels: self.size,
            pixels_per_point: self.scale,
        };
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut buffers = painter.update_buffers(device, queue, &mut encoder, &shapes, &screen);
        let view = self.texture.create_view(&Default::default());
        {
            let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("picture"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    resolve_target: None,
                    depth_slice: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..Default::default()
            });
            painter.render(&mut pass.forget_lifetime(), &shapes, &screen);
        }
        buffers.push(encoder.finish());
        queue.submit(buffers);
        for id in &freed {
            painter.free_texture(id);
        }
    }
}

/// Pixels per point: text and marks keep their share of the picture, never below one pixel a point.
fn points_scale(what: What, [width, height]: [u32; 2]) -> f32 {
    let usual = match what {
        What::Window => vec2(1920.0, 1200.0),
        What::Viewport | What::Panel(_) | What::Panels | What::Budget | What::Ranking => {
            vec2(1280.0, 1000.0)
        }
        What::Microscope | What::Fold | What::Sampling => vec2(640.0, 500.0),
    };
    (width as f32 / usual.x)
        .min(height as f32 / usual.y)
        .max(1.0)
}

fn raw_input(size: [u32; 2], scale: f32) -> RawInput {
    let mut input = RawInput {
        screen_rect: Some(Rect::from_min_size(
            egui::Pos2::ZERO,
            vec2(size[0] as f32, size[1] as f32) / scale,
        )),
        max_texture_side: Some(MAX_SIDE as usize),
        ..RawInput::default()
    };
    let viewport = ViewportInfo {
        native_pixels_per_point: Some(scale),
        ..Default::default()
    };
    input.viewports.insert(ViewportId::ROOT, viewport);
    input
}
