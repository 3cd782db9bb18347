//! What the panes about reflection show: the curves and the ray story.

use serde::{Deserialize, Serialize};

use crate::optics::Formula;

/// What the pane with the reflectance curves shows, beside the exact one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct CurvesState {
    /// The formulas whose curves are drawn.
    pub shown: Vec<Formula>,
    /// For light that comes from inside the body: eta becomes 1/eta.
    pub from_inside: bool,
}

impl Default for CurvesState {
    fn default() -> Self {
        Self {
            shown: vec![Formula::Schlick],
            from_inside: false,
        }
    }
}

/// What the ray story tells, and how far it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct StoryState {
    /// The pane is shown.
    pub open: bool,
    /// Which story.
    pub kind: StoryKind,
    /// The step, from 0; beyond the last one it is the last one.
    pub step: usize,
}

/// A story of one ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StoryKind {
    /// From the eye to the lookups.
    #[default]
    Ray,
    /// Hoff's derivation of the sphere map, line by line.
    SphereMap,
}
