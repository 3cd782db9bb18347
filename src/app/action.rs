//! Everything that can happen to the state, and what it does. Panels see the state and push actions; nothing else writes.

use std::path::PathBuf;

use crate::gpu::ToneCurve;
use crate::imaging::Environment;
use crate::mapping::{ChartPoint, EvaluatorInfo, MappingId};
use crate::math::{Rotation, Vec3};
use crate::optics::Material;
use crate::scene::{Camera, Object};

use super::arrangement::Pane;
use super::probe;
use super::state::{
    AppState, BudgetState, CurvesState, EyeRay, FoldState, FormState, InspectorState,
    LaboratoryState, LossState, Overlays, PanelState, RankingState, SamplingState, StabilityState,
    StoryState, unit,
};

/// One change of the state.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Show other surroundings.
    SetEnvironment(Environment),
    /// Turn the surroundings.
    SetRotation(Rotation),
    /// Look up another mapping; the inspector follows.
    SetMapping(MappingId),
    /// Put a second mapping right of the divider, or take it away.
    SetCompare(Option<MappingId>),
    /// Run the viewport's shaders in another form, or show its error.
    SetForm(FormState),
    /// Move the divider.
    SetDivider(f32),
    /// Another mirror object.
    SetObject(Object),
    /// A model from a file in place of the object.
    SetModel(PathBuf),
    /// Fineness of the object's triangles.
    SetDensity(u32),
    /// Another material, or other parameters.
    SetMaterial(Box<Material>),
    /// Put another material right of the divider, or take it away.
    SetCompareMaterial(Option<Box<Material>>),
    /// Show or hide a pane; the viewport always is shown.
    SetPaneOpen(Pane, bool),
    /// Other curves.
    SetCurves(CurvesState),
    /// Show or hide the ray story, or go to one of its steps.
    SetStory(StoryState),
    /// Show or hide the loss laboratory, or measure something else in it.
    SetLoss(LossState),
    /// Show or hide the stability pane, or look at something else in it.
    SetStability(Box<StabilityState>),
    /// Show or hide the equal texel budget, or compare something else in it.
    SetBudget(BudgetState),
    /// Put the eye where a mirror in the middle shows it this direction.
    FaceDirection([f32; 3]),
    /// Show or hide the laboratory, or look at something else in it.
    SetLaboratory(Box<LaboratoryState>),
    /// Show or hide the folded map, or fold it otherwise.
    SetFold(FoldState),
    /// Another eye before the folded map.
    SetFoldCamera(Camera),
    /// Show or hide the ranking, or ask it something else.
    SetRanking(Box<RankingState>),
    /// Show or hide the cut through the horizon, or compare something else in it.
    SetSampling(SamplingState),
    /// Look a mapping up and show its panel, beside the others.
    OpenMapping(MappingId),
    /// Compute a mapping, which is then looked up, by the evaluator of that name.
    UseEvaluator(MappingId, String),
    /// Turn the camera by these angles in radians.
    Orbit {
        /// To the right.
        dx_rad: f32,
        /// Upwards.
        dy_rad: f32,
    },
    /// Divide the eye's distance by a factor.
    Zoom(f32),
    /// Back to the first view.
    ResetCamera,
    /// Exposure in stops.
    SetExposure(f32),
    /// Another tone curve.
    SetTone(ToneCurve),
    /// Texels of each map.
    SetTexelBudget(u32),
    /// Switch overlays.
    SetOverlays(Overlays),
    /// Study another direction; `eye_ray` is the ray from the eye that found it.
    SetProbe {
        /// The direction; any length.
        dir: [f32; 3],
        /// From the eye, when the viewport found it.
        eye_ray: Option<EyeRay>,
    },
    /// Move the probe by texels of the selected mapping.
    StepProbe {
        /// Texels to the right.
        columns: i32,
        /// Texels downwards.
        rows: i32,
    },
    /// Let the probe follow the pointer, or keep it.
    FollowPointer(bool),
    /// Zoom and pan of a panel.
    SetPanelView(PanelState),
    /// What the inspector shows.
    SetInspector(InspectorState),
    /// Show or hide the controls.
    SetControlsOpen(bool),
    /// Show one pane alone, or all again.
    SetMaximised(Option<Pane>),
    /// A whole other scene.
    Load(Box<AppState>),
}

impl Action {
    /// Which actions one undo takes back together: a drag is many actions of one kind on one thing. `None` stands for itself.
    pub fn merges_as(&self) -> Option<(&'static str, Option<MappingId>)> {
        match self {
            Self::Orbit { .. } | Self::Zoom(_) => Some(("camera", None)),
            Self::SetDivider(_) => Some(("divider", None)),
            Self::SetRotation(_) => Some(("rotation", None)),
            Self::SetExposure(_) => Some(("exposure", None)),
            Self::SetTexelBudget(_) => Some(("texels", None)),
            Self::SetDensity(_) => Some(("density", None)),
            Self::SetMaterial(_) => Some(("material", None)),
            Self::SetOverlays(_) => Some(("overlays", None)),
            Self::SetStory(_) => Some(("story", None)),
            Self::SetLoss(_) => Some(("loss", None)),
            Self::SetStability(_) => Some(("stability", None)),
            Self::SetBudget(_) => Some(("budget", None)),
            Self::SetLaboratory(_) => Some(("laboratory", None)),
            Self::SetFold(_) | Self::SetFoldCamera(_) => Some(("fold", None)),
            Self::SetRanking(_) => Some(("ranking", None)),
            Self::SetSampling(_) => Some(("sampling", None)),
            Self::SetPanelView(view) => Some(("panel", Some(view.mapping))),
            _ => None,
        }
    }

    /// True for what undo leaves alone: the probe's moves would drown everything else.
    pub fn is_transient(&self) -> bool {
        matches!(
            self,
            Self::SetProbe { .. } | Self::StepProbe { .. } | Self::FollowPointer(_)
        )
    }
}

/// Carries out an action. Every number is brought into its range.
pub fn apply(state: &mut AppState, action: Action) {
    match action {
        Action::SetEnvironment(environment) => state.environment = environment,
        Action::SetRotation(rotation) => state.rotation = rotation.sanitized(),
        Action::SetMapping(mapping) => set_mapping(state, mapping),
        Action::SetCompare(compare) => state.compare = compare.filter(|m| *m != state.mapping),
        Action::SetForm(form) => state.form = form.sanitized(),
        Action::SetDivider(divider) if divider.is_finite() => {
            state.divider = divider.clamp(0.0, 1.0);
        }
        Action::SetDivider(_) => {}
        Action::SetObject(object) => {
            state.object = object;
            state.model = None;
            // The ray was reflected by the other object.
            state.eye_ray = None;
        }
        Action::SetModel(path) => {
            state.model = Some(path);
            state.eye_ray = None;
        }
        Action::SetDensity(density) => {
            let (low, high) = super::state::DENSITY_RANGE;
            state.density = density.clamp(low, high);
        }
        Action::SetMaterial(material) => {
            let before = state.material.formula;
            state.material = material.sanitized();
            if state.material.formula != before {
                draw_formula(state);
            }
        }
        Action::SetCompareMaterial(material) => {
            state.compare_material = material.map(|m| m.sanitized());
        }
        Action::SetPaneOpen(pane, open) => set_open(state, pane, open),
        Action::SetCurves(curves) => state.curves = curves,
        Action::SetStory(story) => {
            set_open(state, Pane::Story, story.open);
            state.story = story;
        }
        Action::SetLoss(loss) => {
            set_open(state, Pane::Loss, loss.open);
            state.loss = loss.sanitized();
        }
        Action::SetStability(stability) => {
            set_open(state, Pane::Stability, stability.open);
            state.stability = stability.sanitized();
        }
        Action::SetBudget(budget) => {
            set_open(state, Pane::Budget, budget.open);
            state.budget = budget.sanitized();
        }
        Action::FaceDirection(dir) => state.camera.go_to(unit(dir).into()),
        Action::SetLaboratory(laboratory) => {
            set_open(state, Pane::Laboratory, laboratory.open);
            state.laboratory = laboratory.sanitized();
        }
        Action::SetFold(fold) => {
            set_open(state, Pane::Fold, fold.open);
            state.fold = fold.sanitized();
        }
        Action::SetFoldCamera(camera) => state.fold.camera = camera.sanitized(),
        Action::SetRanking(ranking) => {
            set_open(state, Pane::Ranking, ranking.open);
            state.ranking = ranking.sanitized();
        }
        Action::SetSampling(sampling) => {
            set_open(state, Pane::Sampling, sampling.open);
            state.sampling = sampling.sanitized();
        }
        Action::OpenMapping(mapping) => {
            set_mapping(state, mapping);
            set_open(state, Pane::Map(mapping), true);
            state.show_alone(None);
        }
        Action::UseEvaluator(mapping, id) => {
            match mapping.evaluator(&id).and_then(EvaluatorInfo::form) {
                // The viewport draws by a shader; what the processor computes stays as it is.
                Some(form) => state.form.form = form,
                None => {
                    state.laboratory.evaluators.insert(mapping, id);
                    state.laboratory = std::mem::take(&mut state.laboratory).sanitized();
                }
            }
            set_mapping(state, mapping);
        }
        Action::Orbit { dx_rad, dy_rad } => state.camera.orbit(dx_rad, dy_rad),
        Action::Zoom(factor) => state.camera.zoom(factor),
        Action::ResetCamera => state.camera = AppState::default().camera,
        Action::SetExposure(ev) => {
            let (low, high) = super::state::EXPOSURE_RANGE;
            state.exposure_ev = if ev.is_finite() {
                ev.clamp(low, high)
            } else {
                0.0
            };
        }
        Action::SetTone(tone) => state.tone = tone,
        Action::SetTexelBudget(budget) => {
            let (low, high) = super::state::TEXEL_BUDGET_RANGE;
            state.texel_budget = budget.clamp(low, high);
        }
        Action::SetOverlays(overlays) => state.overlays = overlays.sanitized(),
        Action::SetProbe { dir, eye_ray } => {
            state.probe = unit(dir);
            state.eye_ray = eye_ray;
        }
        Action::StepProbe { columns, rows } => {
            let size = crate::gpu::map_size(state.mapping, state.texel_budget);
            if let Some(dir) = probe::stepped(state.mapping, size, state.probe_f64(), columns, rows)
            {
                state.probe = unit(dir.to_f64().map(|c| c as f32));
                state.eye_ray = None;
            }
        }
        Action::FollowPointer(follow) => state.probe_follows = follow,
        Action::SetPanelView(view) => {
            if let Some(panel) = state.panel_mut(view.mapping) {
                *panel = view;
            }
        }
        Action::SetInspector(inspector) => state.inspector = inspector,
        Action::SetControlsOpen(open) => state.controls_open = open,
        Action::SetMaximised(pane) => state.show_alone(pane),
        Action::Load(loaded) => *state = loaded.sanitized(),
    }
}

fn set_mapping(state: &mut AppState, mapping: MappingId) {
    state.mapping = mapping;
    state.inspector.mapping = mapping;
    if state.compare == Some(mapping) {
        state.compare = None;
    }
}

fn set_open(state: &mut AppState, pane: Pane, open: bool) {
    // The story's ray stays while the pointer goes to its buttons; Esc lets it follow again.
    if pane == Pane::Story && open && !state.story.open {
        state.probe_follows = false;
    }
    let was_open = state.is_open(pane);
    if let Some(is_open) = state.open_mut(pane) {
        *is_open = open;
    }
    // What was shown alone may be hidden now, and what was just opened would lie behind it.
    let opens = open && !was_open && state.maximised.is_some();
    state.show_alone(if opens { Some(pane) } else { state.maximised });
}

/// The curve of the material's formula is among those that are drawn.
pub(super) fn draw_formula(state: &mut AppState) {
    let formula = state.material.formula;
    if !state.curves.shown.contains(&formula) {
        state.curves.shown.push(formula);
    }
}

/// The probe at a chart point of a mapping, as an action; `None` off the chart.
pub fn probe_at(mapping: MappingId, point: ChartPoint<f64>) -> Option<Action> {
    let Vec3 { x, y, z } = mapping.inverse(point)?;
    Some(Action::SetProbe {
        dir: [x, y, z].map(|c| c as f32),
        eye_ray: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_mapping_is_never_the_first() {
        let mut state = AppState::default();
        apply(&mut state, Action::SetCompare(Some(MappingId::Eac)));
        assert_eq!(state.compare, Some(MappingId::Eac));
        apply(&mut state, Action::SetMapping(MappingId::Eac));
        assert_eq!(state.compare, None);
        apply(&mut state, Action::SetCompare(Some(MappingId::Eac)));
        assert_eq!(state.compare, None);
    }

    #[test]
    fn numbers_stay_in_range() {
        let mut state = AppState::default();
        for action in [
            Action::SetDivider(f32::NAN),
            Action::SetExposure(f32::INFINITY),
            Action::SetTexelBudget(0),
            Action::Zoom(f32::NAN),
            Action::Orbit {
                dx_rad: f32::NAN,
                dy_rad: 9e9,
            },
            Action::SetProbe {
                dir: [0.0; 3],
                eye_ray: None,
            },
        ] {
            apply(&mut state, action);
        }
        assert_eq!(state.clone().sanitized(), state);
    }

    #[test]
    fn four_steps_around_return_and_a_step_moves_by_one_texel() {
        for &mapping in MappingId::ALL {
            let mut state = AppState::default();
            apply(&mut state, Action::SetMapping(mapping));
            // A direction beyond the map's end has the nearest texel's place, from which no step is a whole one.
            if !mapping.info().coverage.contains(state.probe.map(f64::from)) {
                apply(
                    &mut state,
                    probe_at(mapping, ChartPoint::new(0, 0.4, 0.7)).unwrap(),
                );
            }
            let size = crate::gpu::map_size(mapping, state.texel_budget);
            let before = mapping.forward(state.probe_f64()).unwrap();
            apply(
                &mut state,
                Action::StepProbe {
                    columns: 1,
                    rows: 0,
                },
            );
            let after = mapping.forward(state.probe_f64()).unwrap();
            let moved = (after.u - before.u) * f64::from(size[0]);
            assert!(
                (moved - 1.0).abs() < 0.01,
                "{mapping}: moved by {moved} texels"
            );
            apply(
                &mut state,
                Action::StepProbe {
                    columns: 0,
                    rows: 1,
                },
            );
            apply(
                &mut state,
                Action::StepProbe {
                    columns: -1,
                    rows: -1,
                },
            );
            let back = mapping.forward(state.probe_f64()).unwrap();
            assert!(
                (back.u - before.u).abs() * f64::from(size[0]) < 0.01,
                "{mapping}"
            );
        }
    }
}
