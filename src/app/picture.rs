//! Pictures without a window: the same drawing code as on the screen, into a texture of its own at any size.

use std::path::PathBuf;
use std::sync::Arc;

use egui::mutex::RwLock;
use egui::{Context, RawInput, Rect, ViewportId, ViewportInfo, vec2};

use super::explorer::Explorer;
use super::model::Surroundings;
use super::state::{AppState, Overlays};
use super::theme;
use crate::gpu::Gpu;
use crate::gpu::readback::read_view;
use crate::imaging::{Progress, atomic, png_out};
use crate::mapping::MappingId;

/// Longest side of a picture in pixels: what every adapter's textures hold.
pub const MAX_SIDE: u32 = 8192;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// The whole window.
    Window,
    /// The viewport alone.
    Viewport,
    /// The unfolded picture of a mapping.
    Panel(MappingId),
}

impl What {
    /// Its name in lists.
    pub fn name(self) -> String {
        match self {
            Self::Window => "the whole window".to_owned(),
            Self::Viewport => "the viewport".to_owned(),
            Self::Panel(mapping) => format!("the panel {}", mapping.info().name),
        }
    }
}

/// Where a picture goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    /// A PNG file with the scene in it.
    File {
        /// Its path.
        path: PathBuf,
        /// Replace what is there.
        force: bool,
    },
    /// The clipboard.
    Clipboard,
}

/// A picture to be made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureRequest {
    /// What is drawn.
    pub what: What,
    /// Width and height in pixels, 1 to [`MAX_SIDE`].
    pub size: [u32; 2],
    /// With the overlays that are switched on.
    pub overlays: bool,
    /// Where it goes.
    pub to: Destination,
}

/// Pixels of a picture, RGBA, row 0 at the top, opaque.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Width and height.
    pub size: [u32; 2],
    /// Four bytes a pixel.
    pub rgba: Vec<u8>,
}

impl Picture {
    /// As egui copies pictures.
    pub fn to_color_image(&self) -> egui::ColorImage {
        let size = self.size.map(|n| n as usize);
        egui::ColorImage::from_rgba_unmultiplied(size, &self.rgba)
    }
}

/// Draws a picture and, if it goes to a file, writes it there.
///
/// # Errors
/// One line that says what failed; nothing is written then.
pub fn make(
    gpu: &Gpu,
    state: &AppState,
    surroundings: Surroundings,
    request: &PictureRequest,
    progress: &Progress,
) -> Result<Picture, String> {
    let picture = draw(gpu, state, surroundings, request, progress)?;
    if let Destination::File { path, force } = &request.to {
        let [width, height] = picture.size;
        let scene = state.to_json();
        let bytes = png_out::encode_png(width, height, &picture.rgba, Some(&scene))
            .map_err(|error| error.to_string())?;
        check_cancelled(progress)?;
        atomic::write_atomically(path, *force, &bytes).map_err(|error| error.to_string())?;
    }
    Ok(picture)
}

/// Draws a picture on a device of its own, loading the state's environment first: what `sixfold render` does.
///
/// # Errors
/// One line that says what failed; nothing is written then.
pub fn render(state: &AppState, request: &PictureRequest) -> Result<(), String> {
    let progress = Progress::new();
    let gpu = Gpu::headless().map_err(|error| error.to_string())?;
    let environment = state.environment.clone();
    let loaded = environment
        .image(&progress)
        .map_err(|error| error.to_string())?;
    let surroundings = Surroundings {
        environment,
        loaded: Arc::new(loaded),
    };
    make(
        &gpu,
        &state.clone().sanitized(),
        surroundings,
        request,
        &progress,
    )
    .map(drop)
}

fn check_cancelled(progress: &Progress) -> Result<(), String> {
    if progress.is_cancelled() {
        Err("the picture was cancelled".to_owned())
    } else {
        Ok(())
    }
}

/// Passes of the layout before the picture counts: sizes of widgets settle in the second, scroll bars in the third.
const LAYOUT_PASSES: usize = 3;

/// Draws a picture.
///
/// # Errors
/// One line that says what failed.
pub fn draw(
    gpu: &Gpu,
    state: &AppState,
    surroundings: Surroundings,
    request: &PictureRequest,
    progress: &Progress,
) -> Result<Picture, String> {
    let size = request.size;
    if size.iter().any(|n| !(1..=MAX_SIDE).contains(n)) {
        return Err(format!(
            "a picture has 1 to {MAX_SIDE} pixels a side, not {}x{}",
            size[0], size[1]
        ));
    }
    let mut state = state.clone();
    if !request.overlays {
        state.overlays = Overlays::NONE;
    }
    let canvas = Canvas::new(gpu, size)?;
    let mut explorer = Explorer::new(gpu.clone(), Arc::clone(&canvas.painter), state);
    explorer.show_now(surroundings)?;
    let ctx = Context::default();
    theme::install(&ctx);
    let scale = points_scale(request.what, size);
    let mut output = None;
    for pass in 0..LAYOUT_PASSES {
        check_cancelled(progress)?;
        progress.step(pass, LAYOUT_PASSES + 1);
        let mut drawn = ctx.run_ui(raw_input(size, scale), |ui| match request.what {
            What::Window => explorer.ui(ui),
            what => explorer.view_alone_ui(ui, what),
        });
        canvas.keep_textures(gpu, &mut drawn.textures_delta);
        output = Some(drawn);
    }
    if let Some(error) = explorer.messages().iter().find(|m| m.is_error) {
        return Err(error.text.clone());
    }
    let output = output.ok_or("nothing was drawn")?;
    let rgba = canvas.paint(gpu, &ctx, output, scale)?;
    progress.step(1, 1);
    Ok(Picture { size, rgba })
}

/// Pixels per point: text and marks keep their share of the picture, never below one pixel a point.
fn points_scale(what: What, [width, height]: [u32; 2]) -> f32 {
    let usual = match what {
        What::Window => vec2(1920.0, 1200.0),
        What::Viewport | What::Panel(_) => vec2(1280.0, 1000.0),
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

/// A texture to paint on, and egui's painter for it.
struct Canvas {
    texture: wgpu::Texture,
    painter: Arc<RwLock<egui_wgpu::Renderer>>,
    size: [u32; 2],
}

impl Canvas {
    fn new(gpu: &Gpu, size: [u32; 2]) -> Result<Self, String> {
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
        Ok(Self {
            texture,
            painter: Arc::new(RwLock::new(painter)),
            size,
        })
    }

    /// Takes over the fonts and images that a pass has changed.
    fn keep_textures(&self, gpu: &Gpu, delta: &mut egui::TexturesDelta) {
        let mut painter = self.painter.write();
        for (id, changes) in &delta.set {
            for change in changes {
                painter.update_texture(&gpu.device, &gpu.queue, *id, change);
            }
        }
        delta.clear();
    }

    fn paint(
        &self,
        gpu: &Gpu,
        ctx: &Context,
        output: egui::FullOutput,
        scale: f32,
    ) -> Result<Vec<u8>, String> {
        let shapes = ctx.tessellate(output.shapes, scale);
        let screen = egui_wgpu::ScreenDescriptor {
            size_in_pixels: self.size,
            pixels_per_point: scale,
        };
        let mut painter = self.painter.write();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut buffers =
            painter.update_buffers(&gpu.device, &gpu.queue, &mut encoder, &shapes, &screen);
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
        gpu.queue.submit(buffers);
        let pixels = read_view(gpu, &self.texture).map_err(|error| error.to_string())?;
        let mut rgba = pixels.rgba;
        for pixel in rgba.chunks_exact_mut(4) {
            pixel[3] = 255;
        }
        Ok(rgba)
    }
}
