//! Cube maps and pictures with levels, as graphics programs load them: KTX2 and DDS.
//!
//! | | order of the pictures | stored kinds |
//! |---|---|---|
//! | [`ktx2`] | level by level, the smallest first; in each +x -x +y -y +z -z | 8 bits (sRGB or not), half, float, RGB9E5 |
//! | [`dds`] | face by face, +x -x +y -y +z -z; in each the largest level first | the same |
//!
//! Both lay faces out as the mapping `cube` does: seen from inside, t downwards, +x right, +y up, +z ahead.

pub mod dds;
pub mod ktx2;

use super::load::{Format, LoadProblem};
use super::{Progress, Raster, Stored};

/// One size of all pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Six faces in the order +x -x +y -y +z -z, or one picture. All alike in size, channels, bits and transfer.
    pub rasters: Vec<Raster>,
}

impl Level {
    /// [width, height] of each picture.
    pub fn size(&self) -> [u32; 2] {
        self.rasters.first().map_or([0; 2], Raster::size)
    }
}

/// A cube map or a picture, with its levels.
#[derive(Clone, Debug, PartialEq)]
pub struct Container {
    /// From the largest to the smallest, each half as large as the one before, rounded down.
    pub levels: Vec<Level>,
    /// How the file stores a sample.
    pub stored: Stored,
    /// The file.
    pub format: Format,
}

impl Container {
    /// Whether it has six faces.
    pub fn is_cube(&self) -> bool {
        self.levels
            .first()
            .is_some_and(|level| level.rasters.len() == 6)
    }
}

/// (width, height) as declared, not judged.
pub(super) fn declared_size(format: Format, bytes: &[u8]) -> Result<(u64, u64), LoadProblem> {
    let _ = bytes;
    Err(LoadProblem::damaged(format, "not built yet"))
}

/// Reads a container that is in memory.
pub(super) fn read(
    format: Format,
    bytes: &[u8],
    progress: &Progress,
) -> Result<Container, LoadProblem> {
    let _ = (bytes, progress);
    Err(LoadProblem::damaged(format, "not built yet"))
}
