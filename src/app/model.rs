//! What the panels see: the state and what was made of it. They change nothing; they push commands.

use std::sync::Arc;
use std::time::Duration;

use crate::imaging::{BadTexels, Environment, Loaded};
use crate::mapping::MappingId;
use crate::scene::Target;

use super::action::Action;
use super::arrangement::Pane;
use super::command::Command;
use super::distortion::HeatWanted;
use super::fold::SheetWanted;
use super::history::History;
use super::laboratory::{Used, Wanted};
use super::labs::Labs;
use super::pace::Paces;
use super::reading::Reading;
use super::sampling::CutsWanted;
use super::state::{AppState, FormState, Overlays};
use super::story::StoryStep;
use super::views::{ViewKey, Views};
use crate::gpu::Gpu;

/// The surroundings that are shown.
#[derive(Clone)]
pub struct Surroundings {
    /// Which they are.
    pub environment: Environment,
    /// Their picture and what was wrong with it.
    pub loaded: Arc<Loaded>,
}

impl Surroundings {
    /// Texels that had to be replaced.
    pub fn bad_texels(&self) -> &BadTexels {
        &self.loaded.bad
    }
}

/// One line about a running job.
#[derive(Clone, Debug)]
pub struct JobLine {
    /// Its number, for cancelling.
    pub id: u64,
    /// What it does.
    pub title: String,
    /// How far it is, 0 to 1.
    pub fraction: f32,
    /// How long its present stage will still take, when that can be told.
    pub left: Option<Duration>,
}

/// A message that stays until it is dismissed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// What happened and what to do.
    pub text: String,
    /// It is a failure.
    pub is_error: bool,
}

/// Everything a panel may look at, and where it says what it wants.
pub struct Model<'a> {
    /// The state.
    pub state: &'a AppState,
    /// The form in which the viewport runs the shaders, and what is shown of it; the budget may have chosen it.
    pub form: FormState,
    /// What can be undone.
    pub history: &'a History,
    /// The object stands for the unit ball, whose paths are known in closed form.
    pub is_ball: bool,
    /// The object, prepared for rays.
    pub target: &'a Target,
    /// The surroundings; `None` until the first ones are there.
    pub surroundings: Option<&'a Surroundings>,
    /// The steps of the ray story; empty while its pane is closed, and where there is nothing to tell.
    pub story: Vec<StoryStep>,
    /// What the laboratories have measured.
    pub labs: &'a Labs,
    /// The evaluator that is used for the mapping that is looked up.
    pub used: Option<Used<'a>>,
    /// Pixels of the screen that a texel of that mapping takes, where it takes most.
    pub pixels_per_texel: f64,
    /// The picture of errors that is seen.
    pub errors_wanted: Option<Wanted>,
    /// The heat maps that are seen.
    pub heat_wanted: Vec<HeatWanted>,
    /// The light of the folded map is seen.
    pub folds: bool,
    /// The pieces and the lines of the folded map that is seen.
    pub sheet_wanted: Option<SheetWanted>,
    /// Cuts through the horizon that are seen.
    pub cuts_wanted: Option<CutsWanted>,
    /// The mappings over which Tissot's ellipses are seen.
    pub ellipses_wanted: Vec<MappingId>,
    /// The panes that are drawn: what only a hidden one would show is not computed.
    pub seen: Vec<Pane>,
    /// Pixels of the microscope's picture, where it is laid out.
    pub microscope_px: Option<[usize; 2]>,
    /// The pictures of the equal texel budget, where they are laid out.
    pub budget_view: Option<super::budget::View>,
    /// Linear colour of the probed texel in the selected map, when it has been read back.
    pub texel_color: Option<[f32; 3]>,
    /// The frame plan's account of the last drawing.
    pub plan: &'a str,
    /// Frames drawn so far.
    pub frames: u64,
    /// Name of the adapter.
    pub adapter: &'a str,
    /// Jobs under way.
    pub jobs: &'a [JobLine],
    /// How fast exports are.
    pub paces: &'a Paces,
    /// The file that the user is deciding about.
    pub reading: Option<&'a Reading>,
    /// Messages to show.
    pub messages: &'a [Message],
    /// The device, for naming views.
    pub gpu: &'a Gpu,
    /// Names of the renderer's textures.
    pub views: &'a mut Views,
    /// What the panels want.
    pub commands: Vec<Command>,
    /// The views that were laid out, with their size in pixels.
    pub laid_out: Vec<(ViewKey, [u32; 2])>,
}

impl Model<'_> {
    /// Asks for something.
    pub fn push(&mut self, command: impl Into<Command>) {
        self.commands.push(command.into());
    }

    /// Moves the probe to a direction and keeps it there.
    pub fn keep_probe(&mut self, dir: [f64; 3]) {
        self.push(Action::SetProbe {
            dir: dir.map(|c| c as f32),
            eye_ray: None,
        });
        if self.state.probe_follows {
            self.push(Action::FollowPointer(false));
        }
    }

    /// The step of the ray story that is shown, counted from 0, and what it tells.
    pub fn story_step(&self) -> Option<(usize, &StoryStep)> {
        let last = self.story.len().checked_sub(1)?;
        let index = self.state.story.step.min(last);
        Some((index, self.story.get(index)?))
    }

    /// The step whose arrows and marks lie over the pictures; none where a picture is wanted bare.
    pub fn painted_step(&self) -> Option<&StoryStep> {
        let is_bare = self.state.overlays == Overlays::NONE;
        self.story_step().filter(|_| !is_bare).map(|(_, step)| step)
    }

    /// Size in texels of the charts of a mapping.
    pub fn map_size(&self, mapping: MappingId) -> [u32; 2] {
        crate::gpu::map_size(mapping, self.state.texel_budget)
    }

    /// Lays a view out over a rectangle of the screen and paints its texture there.
    pub fn view_ui(&mut self, ui: &egui::Ui, key: ViewKey, rect: egui::Rect) {
        let pixels = rect.size() * ui.ctx().pixels_per_point();
        let side = |length: f32| (length.round() as u32).clamp(1, super::picture::MAX_SIDE);
        self.laid_out.push((key, [side(pixels.x), side(pixels.y)]));
        let id = self.views.id(self.gpu, key);
        let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::pos2(1.0, 1.0));
        ui.painter().image(id, rect, whole, egui::Color32::WHITE);
    }
}
