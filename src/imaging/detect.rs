//! What a picture may be: mapping and layout from its shape, what its file says, and how well its charts meet.

use super::{EnvmapKind, Raster, Siting};
use crate::mapping::{Frame, Layout, MappingId};

/// One way to take a picture.
#[derive(Clone, Debug)]
pub struct Proposal {
    /// The mapping.
    pub mapping: MappingId,
    /// How its charts lie.
    pub layout: Layout,
    /// Where the samples sit.
    pub siting: Siting,
    /// Whose orientation it has; `None`: ours.
    pub frame: Option<&'static Frame>,
    /// How the charts meet: 1 as smoothly as the texels inside, larger worse; `None` where that cannot be told.
    pub score: Option<f64>,
    /// Why it is proposed, in a sentence.
    pub why: String,
}

/// What is known of the pictures beside their texels.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known {
    /// What OpenEXR's attribute says.
    pub envmap: Option<EnvmapKind>,
    /// The file says that it is a cube map.
    pub is_cube: bool,
}

/// The proposals for some pictures.
#[derive(Clone, Debug, Default)]
pub struct Detection {
    /// The likeliest first.
    pub proposals: Vec<Proposal>,
    /// Whether the first one is so much likelier than the others that nobody needs to be asked.
    pub is_certain: bool,
}

/// Proposes what the pictures are: one picture, or six faces.
pub fn detect(rasters: &[Raster], known: Known) -> Detection {
    let _ = (rasters, known);
    Detection::default()
}
