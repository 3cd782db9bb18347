//! What the loss laboratory measures.

use serde::{Deserialize, Serialize};

use crate::imaging::resample::Filter;
use crate::mapping::MappingId;

/// Rows of a chart in the loss laboratory. At the most, six faces are compared in a second or two, and the picture of
/// their cross has a quarter of the side that every picture here may have.
pub const LOSS_ROWS: (u32, u32) = (1, 1024);
/// The largest magnification of differences: at it the last bit of a float near 1 is seen.
pub const MOST_MAGNIFIED: u32 = 1 << 20;

/// What the loss laboratory measures: a map of the environment goes to another mapping and comes back.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct LossState {
    /// The pane is shown.
    pub open: bool,
    /// The mapping of the map that goes and comes back.
    pub from: MappingId,
    /// Rows of each of its charts, in [`LOSS_ROWS`].
    pub from_rows: u32,
    /// The mapping that it goes through.
    pub via: MappingId,
    /// Rows of each chart there.
    pub via_rows: u32,
    /// The filter of both ways; `None`: the one that suits each way, as [`crate::imaging::resample::Conversion::filter`].
    pub filter: Option<Filter>,
    /// By what the differences are multiplied to be seen, a power of two up to [`MOST_MAGNIFIED`]; `None`: by what suits
    /// them.
    pub magnification: Option<u32>,
}

impl Default for LossState {
    /// A latlong through a cube map with as many texels around the horizon.
    fn default() -> Self {
        Self {
            open: false,
            from: MappingId::Latlong,
            from_rows: 256,
            via: MappingId::Cube,
            via_rows: 128,
            filter: None,
            magnification: None,
        }
    }
}

impl LossState {
    /// The nearest that makes sense.
    #[must_use]
    pub fn sanitized(mut self) -> Self {
        for rows in [&mut self.from_rows, &mut self.via_rows] {
            *rows = (*rows).clamp(LOSS_ROWS.0, LOSS_ROWS.1);
        }
        let power = |factor: u32| 1 << factor.clamp(1, MOST_MAGNIFIED).ilog2();
        self.magnification = self.magnification.map(power);
        self
    }
}
