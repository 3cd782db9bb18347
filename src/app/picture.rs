//! Pictures without a window: the same drawing code as on the screen, into a texture of its own at any size.

use std::path::PathBuf;
use std::sync::Arc;

use super::laboratory::Measured;
use super::line_art;
use super::model::Surroundings;
use super::offscreen::Offscreen;
use super::state::{AppState, Overlays};
use crate::gpu::Gpu;
use crate::imaging::{Progress, atomic, png_out};
use crate::mapping::MappingId;

pub use crate::imaging::png_out::MAX_SIDE;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// The whole window.
    Window,
    /// The viewport alone.
    Viewport,
    /// The unfolded picture of a mapping.
    Panel(MappingId),
    /// The panels that are open, side by side.
    Panels,
    /// What the microscope of the stability pane shows.
    Microscope,
    /// The map that is folded.
    Fold,
    /// The pictures of the equal texel budget.
    Budget,
    /// The pane that ranks all mappings.
    Ranking,
    /// The cut through the horizon.
    Sampling,
}

impl What {
    /// Its name in lists.
    pub fn name(self) -> String {
        match self {
            Self::Window => "the whole window".to_owned(),
            Self::Viewport => "the viewport".to_owned(),
            Self::Microscope => "the microscope".to_owned(),
            Self::Fold => "the folded map".to_owned(),
            Self::Budget => "the equal texel budget".to_owned(),
            Self::Ranking => "the ranking".to_owned(),
            Self::Sampling => "the sampling of the horizon".to_owned(),
            Self::Panels => "all open panels".to_owned(),
            Self::Panel(mapping) => format!("the panel {}", mapping.info().name),
        }
    }
}

/// Where a picture goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Destination {
    /// A PNG file with the scene in it, or an SVG file of lines by its name's end.
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

impl PictureRequest {
    /// The state as the picture shows it.
    pub fn shown(&self, state: &AppState) -> AppState {
        let overlays = if self.overlays {
            state.overlays
        } else {
            Overlays::NONE
        };
        AppState {
            overlays,
            ..state.clone()
        }
    }
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
    make_with(gpu, state, surroundings, None, request, progress)
}

/// The same with what the laboratory has measured, which is no part of a scene.
pub fn make_with(
    gpu: &Gpu,
    state: &AppState,
    surroundings: Surroundings,
    measured: Option<Arc<Measured>>,
    request: &PictureRequest,
    progress: &Progress,
) -> Result<Picture, String> {
    let own = own_device(gpu)?;
    let gpu = own.as_ref().unwrap_or(gpu);
    let picture = draw_with(gpu, state, surroundings, measured, request, progress)?;
    if let Destination::File { path, force } = &request.to {
        let [width, height] = picture.size;
        let scene = state.to_json().map_err(|error| error.to_string())?;
        let bytes = png_out::encode_png(width, height, &picture.rgba, Some(&scene))
            .map_err(|error| error.to_string())?;
        check_cancelled(progress)?;
        atomic::write_atomically(path, *force, &bytes).map_err(|error| error.to_string())?;
    }
    Ok(picture)
}

/// On GL a device belongs to one thread at a time: a picture on the window's device would make the window wait. `None` where
/// both can work side by side.
fn own_device(gpu: &Gpu) -> Result<Option<Gpu>, String> {
    if gpu.adapter_info.backend != wgpu::Backend::Gl {
        return Ok(None);
    }
    Gpu::open(&[wgpu::Backends::GL])
        .map(Some)
        .map_err(|error| error.to_string())
}

/// Draws a picture on a device of its own, loading the state's environment first, or writes lines as SVG: what `sixfold render` does.
///
/// # Errors
/// One line that says what failed; nothing is written then.
pub fn render(state: &AppState, request: &PictureRequest) -> Result<(), String> {
    if let Some(written) = line_art::written(state, request) {
        return written;
    }
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
    draw_with(gpu, state, surroundings, None, request, progress)
}

fn draw_with(
    gpu: &Gpu,
    state: &AppState,
    surroundings: Surroundings,
    measured: Option<Arc<Measured>>,
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
    let mut screen = Offscreen::new(gpu, request.shown(state), request.what, size)?;
    screen.show_complete(surroundings)?;
    if let Some(measured) = measured {
        screen.explorer.labs_mut().bench.show(measured);
    }
    for pass in 0..LAYOUT_PASSES {
        check_cancelled(progress)?;
        progress.step(pass, LAYOUT_PASSES + 1);
        screen.frame();
    }
    if let Some(error) = screen.explorer.messages().iter().find(|m| m.is_error) {
        return Err(error.text.clone());
    }
    let rgba = screen.read()?;
    progress.step(1, 1);
    Ok(Picture { size, rgba })
}
