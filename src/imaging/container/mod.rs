//! Cube maps and pictures with levels, as graphics programs load them: KTX2 and DDS.
//!
//! | | order of the pictures | levels packed with |
//! |---|---|---|
//! | `ktx2` | level by level, the smallest first; in each the faces | nothing or Zstandard |
//! | `dds` | face by face; in each the levels, the largest first | nothing |
//!
//! Both hold 8 bits (sRGB or not), half, float and RGB9E5, and both lay faces out as the mapping `cube` does, in the order
//! +x -x +y -y +z -z: seen from inside, t downwards, +x right, +y up, +z ahead.

pub(super) mod dds;
pub(super) mod ktx2;
mod texels;

use std::io::Read;

use self::texels::TexelFormat;
use super::caught::caught;
use super::load::{Format, LoadProblem, judged_bytes, judged_side, stop_if_cancelled};
use super::save::Fault;
use super::{EnvironmentMap, Progress, Raster, Stage, Stored};

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
    /// From the largest to the smallest, each half as large as the one before, rounded down, and at least 1.
    pub levels: Vec<Level>,
    /// How the file stores a sample.
    pub stored: Stored,
    /// What the file was, or will be.
    pub format: Format,
}

impl Container {
    /// Maps of halving sizes, the largest first, each with a picture for each chart.
    pub fn of_maps(maps: Vec<EnvironmentMap>, stored: Stored, format: Format) -> Self {
        let level = |map: EnvironmentMap| Level {
            rasters: map.into_parts().1,
        };
        Self {
            levels: maps.into_iter().map(level).collect(),
            stored,
            format,
        }
    }

    /// Whether it has six faces.
    pub fn is_cube(&self) -> bool {
        self.levels
            .first()
            .is_some_and(|level| level.rasters.len() == 6)
    }
}

/// Side of a level that begins with `side` texels.
fn side_at(side: u32, level: usize) -> u32 {
    u32::try_from(level)
        .ok()
        .and_then(|level| side.checked_shr(level))
        .unwrap_or(0)
        .max(1)
}

/// Levels down to 1 x 1.
fn most_levels(size: [u32; 2]) -> u32 {
    u32::BITS - size[0].max(size[1]).leading_zeros()
}

/// What is written: levels that have been found to fit together.
#[derive(Debug)]
pub(super) struct Levels<'a>(Vec<&'a [Raster]>);

impl<'a> Levels<'a> {
    /// One picture of one level.
    pub(super) fn of_raster(raster: &'a Raster) -> Self {
        Self(vec![std::slice::from_ref(raster)])
    }

    pub(super) fn of_container(container: &'a Container) -> Result<Self, Fault> {
        let unfit = |what: &str| Err(Fault::Unfit(what.to_owned()));
        let levels: Vec<&[Raster]> = container
            .levels
            .iter()
            .map(|level| level.rasters.as_slice())
            .collect();
        let Some(first) = levels.first().and_then(|rasters| rasters.first()) else {
            return unfit("no pictures; give one level at least");
        };
        let size = first.size();
        let faces = levels[0].len();
        if faces != 1 && faces != 6 {
            return unfit("other than one picture or six faces; give all six");
        }
        if faces == 6 && size[0] != size[1] {
            return unfit("faces that are not square; choose a square size");
        }
        if levels.len() as u64 > u64::from(most_levels(size)) {
            return unfit("levels below 1 x 1; give fewer");
        }
        for (k, level) in levels.iter().enumerate() {
            let expected = size.map(|side| side_at(side, k));
            let is_like_first = |raster: &Raster| {
                raster.size() == expected
                    && raster.channels() == first.channels()
                    && raster.transfer() == first.transfer()
                    && raster.samples().kind() == first.samples().kind()
            };
            if level.len() != faces || !level.iter().all(is_like_first) {
                return unfit("pictures that differ in kind, or levels that do not halve");
            }
        }
        Ok(Self(levels))
    }

    fn first(&self) -> &'a Raster {
        &self.0[0][0]
    }

    fn faces(&self) -> u32 {
        self.0[0].len() as u32
    }

    fn texel_format(&self, stored: Stored) -> Result<TexelFormat, Fault> {
        TexelFormat::to_write(stored, self.first())
            .ok_or_else(|| Fault::Unfit(format!("samples of the kind {stored:?}; choose half")))
    }

    /// Bytes of all pictures of a level.
    fn level_bytes(&self, level: usize, texel: TexelFormat) -> u64 {
        let texels = |raster: &Raster| u64::from(raster.width()) * u64::from(raster.height());
        self.0[level].iter().map(texels).sum::<u64>() * texel.bytes()
    }
}

/// What a header declares.
struct Declared {
    format: Format,
    width: u64,
    height: u64,
    faces: u32,
    levels: u32,
}

impl Declared {
    /// The size, when pictures of it are within the limits; nothing has been allocated for them.
    fn judged(&self, texel: TexelFormat) -> Result<[u32; 2], LoadProblem> {
        let size = judged_side(self.width, self.height)?;
        let damaged = |reason: String| Err(LoadProblem::damaged(self.format, reason));
        if size.contains(&0) {
            return damaged("it has no texels".to_owned());
        }
        if self.faces == 6 && size[0] != size[1] {
            return damaged(format!(
                "its faces are {} x {}, not square",
                size[0], size[1]
            ));
        }
        if self.levels == 0 || self.levels > most_levels(size) {
            return damaged(format!(
                "it declares {} levels of {} x {}",
                self.levels, size[0], size[1]
            ));
        }
        let bytes = (0..self.levels as usize)
            .map(|level| self.level_texels(size, level) * texel.raster_bytes())
            .sum();
        judged_bytes(size[0], size[1], bytes)?;
        Ok(size)
    }

    /// Texels of all pictures of a level.
    fn level_texels(&self, size: [u32; 2], level: usize) -> u64 {
        let [width, height] = size.map(|side| u64::from(side_at(side, level)));
        width * height * u64::from(self.faces)
    }
}

/// (width, height) as declared, not judged.
pub(super) fn declared_size(format: Format, bytes: &[u8]) -> Result<(u64, u64), LoadProblem> {
    let declared = match format {
        Format::Dds => dds::Header::parse(bytes)?.declared,
        _ => ktx2::Header::parse(bytes)?.declared,
    };
    Ok((declared.width, declared.height))
}

/// Reads a container that is in memory.
pub(super) fn read(
    format: Format,
    bytes: &[u8],
    progress: &Progress,
) -> Result<Container, LoadProblem> {
    progress.enter(Stage::Decoding);
    stop_if_cancelled(progress)?;
    let container = match format {
        Format::Dds => dds::read(bytes, progress)?,
        _ => ktx2::read(bytes, progress)?,
    };
    progress.enter(Stage::Done);
    progress.step(1, 1);
    Ok(container)
}

/// Reads pictures of a container one after another.
struct PictureReader<'a> {
    format: Format,
    texel: TexelFormat,
    progress: &'a Progress,
    done: u64,
    total: u64,
}

impl<'a> PictureReader<'a> {
    fn new(
        declared: &Declared,
        size: [u32; 2],
        texel: TexelFormat,
        progress: &'a Progress,
    ) -> Self {
        let levels = 0..declared.levels as usize;
        Self {
            format: declared.format,
            texel,
            progress,
            done: 0,
            total: levels.map(|k| declared.level_texels(size, k)).sum(),
        }
    }

    /// The next picture. The unpacker behind `bytes` may panic on bad files.
    fn next(&mut self, size: [u32; 2], bytes: &mut dyn Read) -> Result<Raster, LoadProblem> {
        let damaged = |error: std::io::Error| LoadProblem::damaged(self.format, error);
        let row_done = || {
            self.done += u64::from(size[0]);
            self.progress.step(self.done as usize, self.total as usize);
            stop_if_cancelled(self.progress)
        };
        caught(|| self.texel.read(size, bytes, row_done, damaged))
            .unwrap_or_else(|| {
                let reason = "the decoder stumbled over impossible values";
                Err(LoadProblem::damaged(self.format, reason))
            })?
            .ok_or_else(|| LoadProblem::damaged(self.format, "it has no texels"))
    }
}

/// Little-endian numbers of a header, one after another; `None` at its end.
struct Fields<'a>(&'a [u8]);

impl<'a> Fields<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn u32(&mut self) -> Option<u32> {
        self.take(4)?.try_into().ok().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Option<u64> {
        self.take(8)?.try_into().ok().map(u64::from_le_bytes)
    }

    fn u32s<const N: usize>(&mut self) -> Option<[u32; N]> {
        let mut numbers = [0; N];
        for number in &mut numbers {
            *number = self.u32()?;
        }
        Some(numbers)
    }
}
