//! The explorer: state, renderer and jobs behind one window, or behind a picture drawn without one.

mod ask;
mod commands;
mod jobs;
mod labs;

use std::path::PathBuf;
use std::sync::Arc;

use egui::mutex::RwLock;
use egui::{Context, Panel, Ui};

use super::arrangement::{Arrangement, Pane};
use super::budget;
use super::command::Command;
use super::dialogs::{Dialog, dialog_ui};
use super::distortion::HeatWanted;
use super::export::Export;
use super::files::Opened;
use super::fold::SheetWanted;
use super::frame::frame_of;
use super::history::History;
use super::job::Job;
use super::laboratory::{self, Used};
use super::labs::Labs;
use super::model::{Message, Model, Surroundings};
use super::object::{Jobs, ObjectData};
use super::pace::Paces;
use super::panes;
use super::picture;
use super::reading::{Reading, Refusal};
use super::sampling::CutsWanted;
use super::state::AppState;
use super::texel_color::{TexelColor, TexelKey};
use super::views::{ViewKey, Views};
use super::{bars, keys, sides, story};
use crate::gpu::{Gpu, Renderer};
use crate::mapping::MappingId;

use jobs::{Errand, Ready};

/// A dialog of the system that has not been answered: what it asks for, and the file when there is one.
type Asked = (Dialog, Job<Option<PathBuf>>);

/// Surroundings, and how their file was read.
type Loading = (Ready, Option<String>);

/// Everything behind the window.
pub struct Explorer {
    state: AppState,
    history: History,
    gpu: Gpu,
    renderer: Renderer,
    views: Views,
    tree: egui_tiles::Tree<Pane>,
    object: ObjectData,
    labs: Labs,
    /// The panes that were drawn last.
    seen: Vec<Pane>,
    /// Pixels of the microscope's picture that was drawn last.
    microscope_px: Option<[usize; 2]>,
    /// The pictures of the equal texel budget as they were laid out last.
    budget_view: Option<budget::View>,
    /// The views that were laid out last, with their size in pixels.
    laid_out: Vec<(ViewKey, [u32; 2])>,
    errors_wanted: Option<laboratory::Wanted>,
    heat_wanted: Vec<HeatWanted>,
    folds: bool,
    sheet_wanted: Option<SheetWanted>,
    cuts_wanted: Option<CutsWanted>,
    ellipses_wanted: Vec<MappingId>,
    surroundings: Option<Surroundings>,
    loading: Option<Job<Result<Loading, Refusal>>>,
    opening: Option<Job<Result<Opened, String>>>,
    /// Jobs that end in a message, and perhaps in a picture for the clipboard.
    errands: Vec<Job<Result<Errand, String>>>,
    asked: Option<Asked>,
    /// The file of the dialog about how it is read.
    reading: Option<Reading>,
    paces: Paces,
    messages: Vec<Message>,
    dialog: Option<Dialog>,
    /// What was wanted of the last export: what failed for its name alone need not be said anew.
    last_export: Export,
    next_job: u64,
    frames: u64,
    plan: String,
    /// Draw every map at once instead of one a frame: for pictures.
    complete: bool,
    /// Something that is seen has not been drawn yet.
    pending: bool,
    /// It waits for a shader.
    waits: bool,
    texel_color: TexelColor,
    probed: Option<[f32; 3]>,
    quit: bool,
    /// Not even the default surroundings could be loaded.
    is_bare: bool,
}

impl Explorer {
    /// An explorer on a device. `painter` is the renderer that draws egui's shapes on the same device.
    pub fn new(gpu: Gpu, painter: Arc<RwLock<egui_wgpu::Renderer>>, state: AppState) -> Self {
        let state = state.sanitized();
        Self {
            renderer: Renderer::new(gpu.clone()),
            views: Views::new(&gpu, painter),
            tree: panes::tree_of(&state),
            object: ObjectData::new(&state),
            history: History::default(),
            labs: Labs::default(),
            seen: Vec::new(),
            microscope_px: None,
            budget_view: None,
            laid_out: Vec::new(),
            errors_wanted: None,
            heat_wanted: Vec::new(),
            folds: false,
            sheet_wanted: None,
            cuts_wanted: None,
            ellipses_wanted: Vec::new(),
            surroundings: None,
            loading: None,
            opening: None,
            errands: Vec::new(),
            asked: None,
            reading: None,
            paces: Paces::default(),
            messages: Vec::new(),
            dialog: None,
            last_export: Export::default(),
            next_job: 1,
            frames: 0,
            plan: String::new(),
            complete: false,
            pending: false,
            waits: false,
            texel_color: TexelColor::default(),
            probed: None,
            quit: false,
            is_bare: false,
            gpu,
            state,
        }
    }

    /// True while a job runs or a map waits to be drawn.
    pub fn is_busy(&self) -> bool {
        self.pending
            || self.object.is_busy()
            || self.labs.is_busy()
            || self.paces.is_busy()
            || self.loading.is_some()
            || self.opening.is_some()
            || !self.errands.is_empty()
            || self.reading.as_ref().is_some_and(|r| r.job().is_some())
    }

    /// Shows surroundings that are there already, without a job; `complete` asks for every map at once from now on.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub(super) fn show_now(
        &mut self,
        surroundings: Surroundings,
        complete: bool,
    ) -> Result<(), String> {
        self.complete = complete;
        self.install(Ready::new(&self.gpu, surroundings)?);
        Ok(())
    }

    /// What has to happen before a frame: results of jobs, dropped files, keys.
    pub fn logic(&mut self, ctx: &Context) {
        if self.surroundings.is_none() && self.loading.is_none() && !self.is_bare {
            self.load(ctx, self.state.environment.clone());
        }
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        if let Some(file) = dropped.first() {
            if dropped.len() > 1 {
                self.tell(format!("Of {} files the first is opened", dropped.len()));
            }
            self.run(ctx, Command::Open(file.path().to_owned()));
        }
        for command in keys::commands(ctx, &self.state, self.object.target(), &mut self.dialog) {
            self.run(ctx, command);
        }
        self.poll_jobs(ctx);
        if let Some(error) = self.gpu.take_error() {
            self.fail(format!("the graphics device reported a fault: {error}"));
        }
        if ctx.input(|i| i.pointer.any_released()) {
            self.history.end_run();
        }
        if self.quit {
            ctx.send_viewport_cmd(egui::ViewportCommand::Close);
        }
    }

    /// Draws one frame into the whole of `ui`.
    pub fn ui(&mut self, ui: &mut Ui) {
        self.frames += 1;
        let ctx = ui.ctx().clone();
        let mut dialog = self.dialog.take();
        let mut tree = std::mem::replace(
            &mut self.tree,
            egui_tiles::Tree::empty(egui::Id::unique("moved")),
        );
        let (commands, laid_out) = self.with_model(|model| {
            window_ui(ui, model, &mut tree, &mut dialog);
            dialog_ui(&ctx, model, &mut dialog);
        });
        self.tree = tree;
        self.dialog = dialog;
        let before = self.state.clone();
        let any = !commands.is_empty();
        for command in commands {
            self.run(&ctx, command);
        }
        self.draw_views(&ctx, &laid_out);
        self.measure_loss(&ctx);
        self.look(&ctx);
        self.compare_budget(&ctx);
        self.picture_errors(&ctx);
        self.paint_heat(&ctx);
        self.trace_ellipses(&ctx);
        self.light_fold(&ctx);
        self.trace_fold(&ctx);
        self.rank(&ctx);
        self.cut_horizon(&ctx);
        self.measure_pace(&ctx);
        // What was just changed is seen in the next frame; a still window asks for none.
        let draws_on = (self.pending && !self.waits) || self.laid_out != laid_out;
        self.laid_out = laid_out;
        if (any && before != self.state) || draws_on || self.texel_color.is_waiting() {
            ctx.request_repaint();
        } else if self.waits {
            ctx.request_repaint_after(std::time::Duration::from_millis(20));
        } else if self.is_busy() {
            ctx.request_repaint_after(std::time::Duration::from_millis(100));
        }
    }

    /// Draws one view alone into the whole of `ui`: for pictures.
    pub(super) fn view_alone_ui(&mut self, ui: &mut Ui, what: picture::What) {
        let (_, laid_out) = self.with_model(|model| match what {
            picture::What::Viewport => super::viewport::viewport_ui(ui, model),
            picture::What::Panel(mapping) => super::map_panel::map_panel_ui(ui, model, mapping),
            picture::What::Microscope => super::microscope::microscope_ui(ui, model),
            picture::What::Fold => super::fold::surface_ui(ui, model),
            picture::What::Budget => {
                super::budget_panel::pictures_ui(ui, model);
            }
            picture::What::Sampling => super::sampling::sheet_ui(ui, model),
            picture::What::Panels => super::panels::panels_ui(ui, model),
            picture::What::Ranking => panes::pane_ui(ui, model, Pane::Ranking),
            picture::What::Window => {}
        });
        let ctx = ui.ctx().clone();
        self.draw_views(&ctx, &laid_out);
        self.look(&ctx);
        self.paint_heat(&ctx);
        self.trace_ellipses(&ctx);
        self.light_fold(&ctx);
        self.trace_fold(&ctx);
        self.compare_budget(&ctx);
        self.rank(&ctx);
        self.cut_horizon(&ctx);
    }

    /// Runs `show` on a model of what there is; gives back what was asked for and what was laid out.
    fn with_model(
        &mut self,
        show: impl FnOnce(&mut Model<'_>),
    ) -> (Vec<Command>, Vec<(ViewKey, [u32; 2])>) {
        let adapter = self.gpu.name();
        let jobs = self.jobs();
        let (state, map) = (&self.state, self.state.mapping);
        let pixels = laboratory::largest_pixels_per_texel(state, &self.laid_out, map);
        let form = laboratory::used_form(state, self.labs.bench.rows(), pixels);
        let mut model = Model {
            state: &self.state,
            form,
            history: &self.history,
            is_ball: self.object.is_ball(),
            target: self.object.target(),
            surroundings: self.surroundings.as_ref(),
            story: story::steps_if_open(&self.state, self.object.target()),
            labs: &self.labs,
            used: Used::of(state, self.labs.bench.rows(), map, pixels),
            pixels_per_texel: pixels,
            errors_wanted: None,
            heat_wanted: Vec::new(),
            folds: false,
            sheet_wanted: None,
            cuts_wanted: None,
            ellipses_wanted: Vec::new(),
            seen: Vec::new(),
            microscope_px: None,
            budget_view: None,
            texel_color: self.probed,
            plan: &self.plan,
            frames: self.frames,
            adapter: &adapter,
            jobs: &jobs,
            paces: &self.paces,
            reading: self.reading.as_ref(),
            messages: &self.messages,
            gpu: &self.gpu,
            views: &mut self.views,
            commands: Vec::new(),
            laid_out: Vec::new(),
        };
        show(&mut model);
        let (commands, laid_out) = (model.commands, model.laid_out);
        self.microscope_px = model.microscope_px;
        self.budget_view = model.budget_view;
        (self.seen, self.errors_wanted) = (model.seen, model.errors_wanted);
        (self.heat_wanted, self.folds) = (model.heat_wanted, model.folds);
        self.cuts_wanted = model.cuts_wanted;
        (self.sheet_wanted, self.ellipses_wanted) = (model.sheet_wanted, model.ellipses_wanted);
        (commands, laid_out)
    }

    /// Brings the textures of the views that are seen up to date, and nothing else.
    fn draw_views(&mut self, ctx: &Context, laid_out: &[(ViewKey, [u32; 2])]) {
        if self.gpu.is_lost() {
            return;
        }
        let viewport = laid_out.iter().find(|(key, _)| *key == ViewKey::Viewport);
        let size_px = viewport.map(|(_, size_px)| *size_px);
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        let followed = if self.complete {
            self.object.complete(&self.state, size_px)
        } else {
            self.object.follow(&self.state, size_px, &mut jobs)
        };
        if let Err(why) = followed {
            self.fail(why);
        }
        let object = self.object.frames(&self.state, size_px);
        let pixels =
            laboratory::largest_pixels_per_texel(&self.state, laid_out, self.state.mapping);
        let form = laboratory::used_form(&self.state, self.labs.bench.rows(), pixels);
        let frame = frame_of(&self.state, form, object, laid_out, self.complete);
        match self.renderer.draw(&frame) {
            Ok(report) => {
                self.pending = report.is_pending();
                self.waits = self.pending && report.ran.is_empty();
                self.plan = report.to_string();
            }
            Err(error) => {
                self.pending = false;
                self.fail(error.to_string());
            }
        }
        for (key, _) in laid_out {
            let renderer = &self.renderer;
            let texture = match key {
                ViewKey::Viewport => renderer.viewport().zip(renderer.viewport_id()),
                ViewKey::Panel(mapping) => {
                    renderer.panel(*mapping).zip(renderer.panel_id(*mapping))
                }
            };
            self.views.show(&self.gpu, *key, texture);
        }
        self.views
            .retain(|key| laid_out.iter().any(|(shown, _)| *shown == key));
        self.probed = self.probed_color();
    }

    /// Linear colour of the probed texel, when it has come back from the device.
    fn probed_color(&mut self) -> Option<[f32; 3]> {
        let mapping = self.state.mapping;
        let point = mapping.forward(self.state.probe_f64())?;
        let size = crate::gpu::map_size(mapping, self.state.texel_budget);
        let key = TexelKey {
            mapping,
            chart: point.chart,
            texel: super::probe::texel_of(point, size),
            bakes: self.renderer.report().totals.map_bakes,
        };
        self.texel_color.get(&self.renderer, key)
    }

    fn tell(&mut self, text: String) {
        self.message(Message {
            text,
            is_error: false,
        });
    }

    fn fail(&mut self, text: String) {
        self.message(Message {
            text,
            is_error: true,
        });
    }

    /// Shows a message once. The newest four stay; of those that only tell what went well one, and the one before it, which
    /// may be of the same deed.
    fn message(&mut self, message: Message) {
        const MOST: usize = 4;
        const MOST_TOLD: usize = 2;
        if self.messages.last() != Some(&message) {
            self.messages.push(message);
        }
        let told = self.messages.iter().filter(|m| !m.is_error).count();
        let mut over = told.saturating_sub(MOST_TOLD);
        self.messages.retain(|message| {
            let goes = !message.is_error && over > 0;
            over -= usize::from(goes);
            !goes
        });
        while self.messages.len() > MOST {
            self.messages.remove(0);
        }
    }

    /// The scene as it is seen: with the surroundings that are there and the panes as they lie.
    fn scene(&self) -> AppState {
        let mut scene = self.state.clone();
        if let Some(shown) = &self.surroundings {
            scene.environment = shown.environment.clone();
        }
        scene.arrangement = Arrangement::of_tree(&self.tree);
        scene
    }

    /// Saves the scene where it is found again after the device was lost, and says where.
    pub fn rescue(&self) -> String {
        let name = format!("sixfold-rescued-{}.json", std::process::id());
        let path = std::env::temp_dir().join(name);
        match jobs::write_scene(&self.scene(), &path, true) {
            Ok(()) => format!("the scene is in {}", path.display()),
            Err(why) => format!("the scene could not be saved: {why}"),
        }
    }
}

/// Everything in the window, from the borders inwards.
fn window_ui(
    ui: &mut Ui,
    model: &mut Model<'_>,
    tree: &mut egui_tiles::Tree<Pane>,
    dialog: &mut Option<Dialog>,
) {
    Panel::top("menu").show(ui, |ui| bars::menu_ui(ui, model, dialog));
    Panel::bottom("status").show(ui, |ui| bars::status_ui(ui, model));
    sides::sides_ui(ui, model, tree);
}
