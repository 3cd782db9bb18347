//! The explorer in a real window.

use std::path::Path;
use std::sync::{Arc, Mutex};

use super::explorer::Explorer;
use super::state::AppState;
use super::{files, objects, theme};
use crate::gpu::{Gpu, context};

/// Why the window did not open or had to close.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The file given is no scene and no environment.
    #[error("{0}")]
    Scene(String),
    /// No window or no device.
    #[error(
        "no window could be opened ({0}); a display and a Vulkan or OpenGL driver are needed, and `sixfold render OUT.png` draws without a display"
    )]
    Window(String),
    /// The device was lost.
    #[error("the graphics device was lost; {0}; start Sixfold again with that file")]
    DeviceLost(String),
}

/// Opens the explorer on the default scene or on a file, and returns when the window is closed.
///
/// # Errors
/// See [`RunError`].
pub fn run(file: Option<&Path>) -> Result<(), RunError> {
    if cfg!(target_os = "linux") {
        let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
        if !(is_set("DISPLAY") || is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET")) {
            let why = "there is no display: neither DISPLAY nor WAYLAND_DISPLAY is set";
            return Err(RunError::Window(why.to_owned()));
        }
    }
    let state = match file {
        Some(path) => files::open_scene(path).map_err(RunError::Scene)?,
        None => AppState::default(),
    };
    let lost = Lost::default();
    let report = Arc::clone(&lost);
    let created = eframe::run_native(
        "Sixfold",
        options(),
        Box::new(move |creation| Ok(Box::new(Window::new(creation, state, report)?))),
    );
    created.map_err(|error| RunError::Window(one_line(&error.to_string())))?;
    match lost.lock().ok().and_then(|mut why| why.take()) {
        Some(why) => Err(RunError::DeviceLost(why)),
        None => Ok(()),
    }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn options() -> eframe::NativeOptions {
    let mut setup = egui_wgpu::WgpuSetupCreateNew::without_display_handle();
    setup.device_descriptor = Arc::new(context::device_descriptor);
    eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Sixfold")
            .with_app_id("sixfold")
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([480.0, 320.0])
            .with_drag_and_drop(true),
        renderer: eframe::Renderer::Wgpu,
        wgpu_options: egui_wgpu::WgpuConfiguration {
            wgpu_setup: egui_wgpu::WgpuSetup::CreateNew(setup),
            ..Default::default()
        },
        ..Default::default()
    }
}

/// Why the device was lost, once it was.
pub type Lost = Arc<Mutex<Option<String>>>;

/// The explorer as eframe runs it.
pub struct Window {
    explorer: Explorer,
    lost: Lost,
}

impl Window {
    /// The window's content on the device that eframe has opened.
    ///
    /// # Errors
    /// When there is no such device.
    pub fn new(
        creation: &eframe::CreationContext<'_>,
        state: AppState,
        lost: Lost,
    ) -> Result<Self, String> {
        theme::install(&creation.egui_ctx);
        let device = creation
            .wgpu_render_state
            .as_ref()
            .ok_or("the window has no graphics device")?;
        let gpu = Gpu::from_parts(
            device.device.clone(),
            device.queue.clone(),
            device.adapter.get_info(),
        );
        objects::prepare_all();
        let explorer = Explorer::new(gpu, Arc::clone(&device.renderer), state);
        Ok(Self { explorer, lost })
    }

    /// What is behind the window.
    pub fn explorer(&self) -> &Explorer {
        &self.explorer
    }

    /// What is behind the window, to be told something.
    pub fn explorer_mut(&mut self) -> &mut Explorer {
        &mut self.explorer
    }
}

impl eframe::App for Window {
    fn logic(&mut self, ctx: &egui::Context, _: &mut eframe::Frame) {
        if self.explorer.is_lost() {
            if let Ok(mut lost) = self.lost.lock()
                && lost.is_none()
            {
                *lost = Some(self.explorer.rescue());
            }
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            return;
        }
        self.explorer.logic(ctx);
    }

    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        self.explorer.ui(ui);
    }
}
