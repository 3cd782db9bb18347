//! What the pane with the cut through the horizon shows.

use serde::{Deserialize, Serialize};

use crate::lab::sampling::QUARTERS;
use crate::mapping::MappingId;

/// The selected mapping beside another one, both as fine as a cube map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct SamplingState {
    /// The pane is shown.
    pub open: bool,
    /// The mapping beside the selected one.
    pub other: MappingId,
    /// Texels on a quarter of the horizon, in [`QUARTERS`].
    pub quarter: u32,
}

impl Default for SamplingState {
    fn default() -> Self {
        Self {
            open: false,
            other: MappingId::Cube,
            quarter: 4,
        }
    }
}

impl SamplingState {
    /// With the number in its range.
    #[must_use]
    pub fn sanitized(self) -> Self {
        Self {
            quarter: self.quarter.clamp(QUARTERS.0, QUARTERS.1),
            ..self
        }
    }
}
