//! What the window shows, as plain data: saved scenes, undo and exports are copies of it. What one pane shows is beside it.

mod budget;
mod fold;
mod form;
mod laboratory;
mod loss;
mod optics;
mod ranking;
mod sampling;
mod stability;
mod views;

use std::path::PathBuf;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::gpu::ToneCurve;
use crate::imaging::Environment;
use crate::mapping::MappingId;
use crate::math::{Rotation, Vec3};
use crate::optics::Material;
use crate::scene::object::FULL_DENSITY;
use crate::scene::{Camera, Object, Ray};

use super::arrangement::{Arrangement, Pane};
use super::objects::target_of;
use super::viewport::looked_up;

pub use budget::{BudgetState, COMPARED_TEXELS, MAGNIFIERS};
pub use fold::FoldState;
pub use form::FormState;
pub use laboratory::{BUDGET_TEXELS, Column, LaboratoryState};
pub use loss::{LOSS_ROWS, LossState, MOST_MAGNIFIED};
pub use optics::{CurvesState, StoryKind, StoryState};
pub use ranking::{Claim, MOST_COMPARED, RankingColumn, RankingPlot, RankingState};
pub use sampling::SamplingState;
pub use stability::{LENGTHS, StabilityState};
pub use views::{InspectorState, Overlays, PanelState, Precision, ZOOM_RANGE};

/// Version of the saved form. A scene of a later version is refused; earlier ones are migrated by [`AppState::from_json`].
pub const SCHEMA: u32 = 5;

/// Everything that a saved scene holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct AppState {
    /// Version of this form.
    pub schema: u32,
    /// What surrounds the object; scenes before form 4 say nothing of how its file is read.
    pub environment: Environment,
    /// How it is turned; scenes before form 3 know no turn.
    pub rotation: Rotation,
    /// The mapping that the object and the sky look up.
    pub mapping: MappingId,
    /// A second mapping right of the divider.
    pub compare: Option<MappingId>,
    /// In which form the viewport runs the shaders.
    pub form: FormState,
    /// Place of the divider, 0 (left border) to 1.
    pub divider: f32,
    /// The object.
    pub object: Object,
    /// A model from a file in place of the object.
    pub model: Option<PathBuf>,
    /// Fineness of the object's triangles, in [`DENSITY_RANGE`]; see [`Object::mesh_at`].
    pub density: u32,
    /// What the object is made of.
    pub material: Material,
    /// Another material right of the divider.
    pub compare_material: Option<Material>,
    /// The eye.
    pub camera: Camera,
    /// Exposure in stops: the light is multiplied by 2^ev.
    pub exposure_ev: f32,
    /// From light to the screen's range.
    pub tone: ToneCurve,
    /// Texels of each map, the same for every mapping.
    pub texel_budget: u32,
    /// What is drawn over the pictures.
    pub overlays: Overlays,
    /// The direction under study; unit length.
    pub probe: [f32; 3],
    /// The probe follows the pointer.
    pub probe_follows: bool,
    /// The ray from the eye that found the probe, kept in the world so that one can walk around it; `None` when a panel
    /// made the probe.
    pub eye_ray: Option<EyeRay>,
    /// One entry for each mapping, in the registry's order.
    pub panels: Vec<PanelState>,
    /// How the panes are arranged; `None` as at first.
    pub arrangement: Option<Arrangement>,
    /// The pane that is shown alone.
    pub maximised: Option<Pane>,
    /// The pane with the reflectance curves is shown.
    pub curves_open: bool,
    /// Which curves.
    pub curves: CurvesState,
    /// The ray story.
    pub story: StoryState,
    /// The loss laboratory.
    pub loss: LossState,
    /// Where evaluators break.
    pub stability: StabilityState,
    /// Two mappings with as many texels.
    pub budget: BudgetState,
    /// Run time against error, and which evaluators are used; scenes before form 5 know none.
    pub laboratory: LaboratoryState,
    /// The map that is folded.
    pub fold: FoldState,
    /// All mappings in an order.
    pub ranking: RankingState,
    /// The cut through the horizon.
    pub sampling: SamplingState,
    /// The controls at the left are shown.
    pub controls_open: bool,
    /// What the inspector shows.
    pub inspector: InspectorState,
}

/// A ray from the eye, as it was when the probe was found through it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EyeRay {
    /// Where the eye was, in world units.
    pub origin: [f32; 3],
    /// Where it looked, unit length.
    pub dir: [f32; 3],
    /// It was right of the divider, so that it met the material there.
    #[serde(default)]
    pub is_right: bool,
}

impl EyeRay {
    /// The ray as the picking code takes it.
    pub fn ray(self) -> Ray {
        Ray {
            origin: self.origin.into(),
            dir: self.dir.into(),
        }
    }
}

impl From<Ray> for EyeRay {
    fn from(ray: Ray) -> Self {
        Self {
            origin: ray.origin.to_array(),
            dir: ray.dir.to_array(),
            is_right: false,
        }
    }
}

/// Stops of exposure that the slider offers: the range of an HDR photograph.
pub const EXPOSURE_RANGE: (f32, f32) = (-12.0, 12.0);
/// Texels of a map: from a cube of 16 x 16 faces to one of 2048 x 2048.
pub const TEXEL_BUDGET_RANGE: (u32, u32) = (6 * 16 * 16, 6 * 2048 * 2048);
/// Fineness of the object's triangles: from a coarse body to the smooth one.
pub const DENSITY_RANGE: (u32, u32) = (1, FULL_DENSITY);

/// The first probe and its ray: the teapot's flank, looked at from a little to the side of the first camera, so that all
/// three vectors are seen.
static FIRST_PROBE: LazyLock<([f32; 3], EyeRay)> = LazyLock::new(|| {
    let eye = Camera {
        yaw_rad: -0.1,
        pitch_rad: 0.25,
        ..Camera::default()
    };
    let ray = eye.ray((0.5, 0.52), 1.0);
    let dir = looked_up(&target_of(Object::Teapot), ray, &Material::default());
    (unit(dir.to_array()), ray.into())
});

impl Default for AppState {
    fn default() -> Self {
        // The seeds' six, which come first in the registry, are open.
        let panels = MappingId::ALL
            .iter()
            .enumerate()
            .map(|(i, &m)| PanelState::new(m, i < 6))
            .collect();
        Self {
            schema: SCHEMA,
            environment: Environment::default(),
            rotation: Rotation::NONE,
            mapping: MappingId::Ccm,
            compare: None,
            form: FormState::default(),
            divider: 0.5,
            object: Object::Teapot,
            model: None,
            density: DENSITY_RANGE.1,
            material: Material::default(),
            compare_material: None,
            camera: Camera {
                yaw_rad: 0.5,
                pitch_rad: 0.3,
                ..Camera::default()
            },
            exposure_ev: 0.0,
            tone: ToneCurve::default(),
            texel_budget: 6 * 512 * 512,
            overlays: Overlays::default(),
            probe: FIRST_PROBE.0,
            probe_follows: true,
            eye_ray: Some(FIRST_PROBE.1),
            panels,
            arrangement: None,
            maximised: None,
            curves_open: false,
            curves: CurvesState::default(),
            story: StoryState::default(),
            loss: LossState::default(),
            stability: StabilityState::default(),
            budget: BudgetState::default(),
            laboratory: LaboratoryState::default(),
            fold: FoldState::default(),
            ranking: RankingState::default(),
            sampling: SamplingState::default(),
            controls_open: true,
            inspector: InspectorState::default(),
        }
    }
}

/// Why a scene file cannot be shown.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// Not JSON, or not a scene.
    #[error("this is not a Sixfold scene: {0}")]
    NotAScene(#[from] serde_json::Error),
    /// It cannot be written as text.
    #[error("the scene cannot be written ({0}); rename the environment's file")]
    NotText(#[source] serde_json::Error),
    /// Written by a later version.
    #[error(
        "the scene has form {found}, this program knows {SCHEMA}: open it with a newer Sixfold"
    )]
    TooNew {
        /// The form found.
        found: u32,
    },
}

impl AppState {
    /// The state as the text of a scene file.
    ///
    /// # Errors
    /// When the environment's path is not Unicode, which a text file cannot hold.
    pub fn to_json(&self) -> Result<String, SceneError> {
        serde_json::to_string_pretty(self).map_err(SceneError::NotText)
    }

    /// A state from the text of a scene file; every number is brought into its range.
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        #[derive(Deserialize)]
        struct Head {
            schema: u32,
        }
        let head: Head = serde_json::from_str(text)?;
        if head.schema > SCHEMA {
            return Err(SceneError::TooNew { found: head.schema });
        }
        Ok(serde_json::from_str::<Self>(text)?.sanitized())
    }

    /// The nearest state that makes sense: files and arguments may hold any number.
    pub fn sanitized(mut self) -> Self {
        let finite = |x: f32, or: f32| if x.is_finite() { x } else { or };
        self.schema = SCHEMA;
        self.rotation = self.rotation.sanitized();
        self.divider = finite(self.divider, 0.5).clamp(0.0, 1.0);
        self.compare = self.compare.filter(|m| *m != self.mapping);
        self.camera = self.camera.sanitized();
        self.exposure_ev = finite(self.exposure_ev, 0.0).clamp(EXPOSURE_RANGE.0, EXPOSURE_RANGE.1);
        self.texel_budget = self
            .texel_budget
            .clamp(TEXEL_BUDGET_RANGE.0, TEXEL_BUDGET_RANGE.1);
        self.overlays = self.overlays.sanitized();
        self.fold = self.fold.sanitized();
        self.density = self.density.clamp(DENSITY_RANGE.0, DENSITY_RANGE.1);
        self.material = self.material.sanitized();
        self.compare_material = self.compare_material.map(Material::sanitized);
        self.form = self.form.sanitized();
        self.loss = self.loss.sanitized();
        self.stability = self.stability.sanitized();
        self.budget = self.budget.sanitized();
        self.laboratory = self.laboratory.sanitized();
        self.ranking = self.ranking.sanitized();
        self.sampling = self.sampling.sanitized();
        self.probe = unit(self.probe);
        self.eye_ray = self.eye_ray.filter(|eye| {
            let ray = eye.ray();
            ray.origin.is_finite() && ray.dir.is_normalized()
        });
        // One panel for each mapping, whatever the file holds.
        let saved = std::mem::take(&mut self.panels);
        self.panels = MappingId::ALL
            .iter()
            .map(|&mapping| {
                let found = saved.iter().find(|p| p.mapping == mapping);
                let mut panel = found.copied().unwrap_or(PanelState::new(mapping, false));
                panel.zoom = finite(panel.zoom, 1.0).clamp(ZOOM_RANGE.0, ZOOM_RANGE.1);
                panel.center = panel.center.map(|c| finite(c, 0.5).clamp(0.0, 1.0));
                panel
            })
            .collect();
        self.show_alone(self.maximised);
        self
    }

    /// The panel of a mapping.
    pub fn panel(&self, mapping: MappingId) -> PanelState {
        let found = self.panels.iter().find(|p| p.mapping == mapping);
        found.copied().unwrap_or(PanelState::new(mapping, false))
    }

    /// The mappings whose panels are shown, in the registry's order.
    pub fn open_panels(&self) -> impl Iterator<Item = MappingId> {
        self.panels.iter().filter(|p| p.open).map(|p| p.mapping)
    }

    /// The materials left and right of the divider.
    pub fn materials(&self) -> impl Iterator<Item = &Material> {
        std::iter::once(&self.material).chain(&self.compare_material)
    }

    /// The material that the probe's ray has met.
    pub fn pointed_material(&self) -> &Material {
        self.material_at(self.eye_ray.is_some_and(|ray| ray.is_right))
    }

    /// The material on one side of the divider.
    pub fn material_at(&self, is_right: bool) -> &Material {
        let right = self.compare_material.as_ref().filter(|_| is_right);
        right.unwrap_or(&self.material)
    }

    /// True when there is a divider.
    pub fn is_divided(&self) -> bool {
        self.compare.is_some() || self.compare_material.is_some()
    }

    /// True when a pane is shown.
    pub fn is_open(&self, pane: Pane) -> bool {
        match pane {
            Pane::Viewport => true,
            Pane::Curves => self.curves_open,
            Pane::Story => self.story.open,
            Pane::Loss => self.loss.open,
            Pane::Stability => self.stability.open,
            Pane::Budget => self.budget.open,
            Pane::Laboratory => self.laboratory.open,
            Pane::Fold => self.fold.open,
            Pane::Ranking => self.ranking.open,
            Pane::Sampling => self.sampling.open,
            Pane::Map(mapping) => self.panel(mapping).open,
        }
    }

    /// Whether a pane is shown, to be changed; `None` for the viewport, which always is.
    pub fn open_mut(&mut self, pane: Pane) -> Option<&mut bool> {
        match pane {
            Pane::Viewport => None,
            Pane::Curves => Some(&mut self.curves_open),
            Pane::Story => Some(&mut self.story.open),
            Pane::Loss => Some(&mut self.loss.open),
            Pane::Stability => Some(&mut self.stability.open),
            Pane::Budget => Some(&mut self.budget.open),
            Pane::Laboratory => Some(&mut self.laboratory.open),
            Pane::Fold => Some(&mut self.fold.open),
            Pane::Ranking => Some(&mut self.ranking.open),
            Pane::Sampling => Some(&mut self.sampling.open),
            Pane::Map(mapping) => Some(&mut self.panel_mut(mapping)?.open),
        }
    }

    /// The panel of a mapping, to be changed.
    pub fn panel_mut(&mut self, mapping: MappingId) -> Option<&mut PanelState> {
        self.panels.iter_mut().find(|p| p.mapping == mapping)
    }

    /// Shows a pane alone, unless it is hidden, or all again.
    pub fn show_alone(&mut self, pane: Option<Pane>) {
        self.maximised = pane.filter(|pane| self.is_open(*pane));
    }

    /// The probe in f64.
    pub fn probe_f64(&self) -> Vec3<f64> {
        let [x, y, z] = self.probe.map(f64::from);
        Vec3::new(x, y, z)
    }
}

/// The unit vector of a direction; +z for a vector that is none.
pub fn unit(dir: [f32; 3]) -> [f32; 3] {
    let dir = Vec3::new(dir[0], dir[1], dir[2]);
    match dir.scaled_direction() {
        Some(d) => Vec3::<f64>::from_f64(d.to_f64())
            .normalized()
            .to_array()
            .map(|c| c as f32),
        None => [0.0, 0.0, 1.0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_survives_its_file() {
        let state = AppState {
            compare: Some(MappingId::Eac),
            ..AppState::default()
        };
        assert_eq!(
            AppState::from_json(&state.to_json().unwrap()).unwrap(),
            state
        );
        let other = AppState {
            compare: Some(MappingId::Cube),
            ..state.clone()
        };
        assert_ne!(
            AppState::from_json(&other.to_json().unwrap()).unwrap(),
            state
        );
    }

    #[test]
    fn numbers_out_of_range_are_brought_back() {
        let state = AppState {
            probe: [f32::NAN, 0.0, 0.0],
            texel_budget: u32::MAX,
            divider: f32::INFINITY,
            panels: Vec::new(),
            ..AppState::default()
        };
        let state = state.sanitized();
        assert_eq!(state.probe, [0.0, 0.0, 1.0]);
        assert_eq!(state.texel_budget, TEXEL_BUDGET_RANGE.1);
        assert_eq!(state.divider, 0.5);
        assert_eq!(state.panels.len(), MappingId::ALL.len());
    }

    #[test]
    fn a_later_form_and_a_foreign_file_are_refused_with_a_reason() {
        let later = AppState::from_json(r#"{"schema": 99}"#)
            .unwrap_err()
            .to_string();
        assert!(later.contains("99"), "{later}");
        assert!(AppState::from_json("{}").is_err());
        assert!(AppState::from_json("P6 1 1").is_err());
        assert!(AppState::from_json(r#"{"schema": 1}"#).is_ok());
    }

    #[test]
    fn ties_survive_normalising() {
        for pattern in crate::math::inputs::SIGN_PATTERNS {
            let dir = unit(pattern.map(f32::from));
            let size: Vec<f32> = dir.iter().map(|c| c.abs()).filter(|c| *c > 0.0).collect();
            assert!(
                size.windows(2).all(|w| w[0] == w[1]),
                "{pattern:?} became {dir:?}"
            );
        }
    }
}
