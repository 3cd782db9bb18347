//! Pictures from files: Radiance HDR, OpenEXR, PNG, JPEG, and the containers KTX2 and DDS.
//!
//! - [`read_raster`]: one picture of any shape, every stored bit kept;
//! - [`open`]: a picture or a container, whichever the file is;
//! - [`load`]: a latlong, decoded to light and fit to show, from the same decoders.
//!
//! The declared size is read from the header and judged before a decoder sees the file: failed allocations end the
//! process and cannot be caught. Reading a header holds no more than the header's own bytes.

mod decoded;
mod exr;
mod hdr;
mod header;
mod jpeg;
mod png;
mod problem;

use std::path::Path;

use self::decoded::Decoded;
use super::container::{self, Container};
use super::sanitize::{BadTexels, Originals, sanitize};
use super::{Image, Progress, Raster, Stage, Stored, read_whole};

pub(super) use decoded::light_of_raster;
pub use problem::{LoadError, LoadProblem};

/// Most texels in a row of a latlong that is shown: twice the largest height.
pub const MOST_WIDTH: u32 = 16384;

/// Most rows of one. 16384 x 8192 texels take 1.5 GiB as f32 RGB.
pub const MOST_HEIGHT: u32 = 8192;

/// Most texels a side of a ball's picture: more than any viewport shows of it, and within every device's limits.
pub const MOST_BALL: u32 = 4096;

/// Most texels a side of any picture: six faces of [`MOST_HEIGHT`] in a row or a column.
pub const MOST_SIDE: u32 = 6 * MOST_HEIGHT;

/// Most bytes that the texels of a file take: the largest latlong as f32 RGBA, 2 GiB.
pub const MOST_RASTER_BYTES: u64 = MOST_WIDTH as u64 * MOST_HEIGHT as u64 * 16;

/// Longest file: as much, uncompressed.
pub const MOST_FILE_BYTES: u64 = MOST_RASTER_BYTES;

/// File formats that open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Radiance RGBE.
    Hdr,
    /// OpenEXR, any compression but deep data.
    Exr,
    /// PNG, 1 to 16 bits.
    Png,
    /// JPEG, 8 bits.
    Jpeg,
    /// KTX 2.0: cube maps and pictures with levels.
    Ktx2,
    /// DirectDraw surfaces: the same.
    Dds,
}

impl Format {
    /// The format's usual name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hdr => "Radiance HDR",
            Self::Exr => "OpenEXR",
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
            Self::Ktx2 => "KTX2",
            Self::Dds => "DDS",
        }
    }

    /// Whether a file holds faces and levels instead of one picture.
    pub const fn is_container(self) -> bool {
        matches!(self, Self::Ktx2 | Self::Dds)
    }

    /// The format whose signature `bytes` start with. File names are not asked.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [b'#', b'?', ..] => Some(Self::Hdr),
            [0x76, 0x2f, 0x31, 0x01, ..] => Some(Self::Exr),
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => Some(Self::Png),
            [0xff, 0xd8, 0xff, ..] => Some(Self::Jpeg),
            _ if bytes.starts_with(&container::ktx2::SIGNATURE) => Some(Self::Ktx2),
            _ if bytes.starts_with(&container::dds::SIGNATURE) => Some(Self::Dds),
            _ => None,
        }
    }
}

/// What OpenEXR's attribute `envmap` says a picture is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnvmapKind {
    /// A latlong.
    Latlong,
    /// Six faces in a column.
    Cube,
}

/// A picture as its file holds it.
#[derive(Clone, Debug)]
pub struct RasterFile {
    /// The texels, every stored bit kept: NaN and infinite values too. OpenEXR's colours are multiplied by their opacity,
    /// where there is one; they stay so until they are converted ([`crate::imaging::opacity`]).
    pub raster: Raster,
    /// What the file was.
    pub format: Format,
    /// How it stored a sample.
    pub stored: Stored,
    /// What OpenEXR's attribute `envmap` says.
    pub envmap: Option<EnvmapKind>,
}

/// What a file may be.
#[derive(Clone, Debug)]
pub enum Opened {
    /// One picture.
    Raster(RasterFile),
    /// Faces and levels.
    Container(Container),
}

/// A picture, fit to show, and what had to be replaced for that.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// Every value finite and in [0, 65504].
    pub image: Image,
    /// How many texels were replaced, and why.
    pub bad: BadTexels,
    /// What they held.
    pub originals: Originals,
}

impl Loaded {
    /// Counts and replaces what cannot be shown.
    pub fn from_image(mut image: Image, progress: &Progress) -> Self {
        progress.enter(Stage::Checking);
        let (bad, originals) = sanitize(&mut image);
        progress.enter(Stage::Done);
        progress.step(1, 1);
        Self {
            image,
            bad,
            originals,
        }
    }
}

/// Opens whatever there is.
///
/// # Errors
/// [`LoadError`], one line: what was found, what to do, the path last. Never panics on a bad file.
pub fn open(path: &Path, progress: &Progress) -> Result<Opened, LoadError> {
    from_file(path, progress, |bytes| opened(bytes, progress))
}

/// [`open`] for bytes in memory; `name` ends the error message.
///
/// # Errors
/// As [`open`].
pub fn open_bytes(bytes: &[u8], name: &str, progress: &Progress) -> Result<Opened, LoadError> {
    opened(bytes, progress).map_err(named(name))
}

/// Reads one picture of any shape.
///
/// # Errors
/// As [`open`], and for a container.
pub fn read_raster(path: &Path, progress: &Progress) -> Result<RasterFile, LoadError> {
    from_file(path, progress, |bytes| raster_file(bytes, progress))
}

/// [`read_raster`] for bytes in memory; `name` ends the error message.
///
/// # Errors
/// As [`read_raster`].
pub fn read_raster_bytes(
    bytes: &[u8],
    name: &str,
    progress: &Progress,
) -> Result<RasterFile, LoadError> {
    raster_file(bytes, progress).map_err(named(name))
}

/// Opens a latlong picture.
///
/// # Errors
/// As [`open`], and for every other shape.
pub fn load(path: &Path, progress: &Progress) -> Result<Loaded, LoadError> {
    from_file(path, progress, |bytes| {
        loaded(bytes, Shape::Latlong, progress)
    })
}

/// Opens a square picture of a ball.
///
/// # Errors
/// As [`load`].
pub fn load_ball(path: &Path, progress: &Progress) -> Result<Loaded, LoadError> {
    from_file(path, progress, |bytes| {
        loaded(bytes, Shape::Square, progress)
    })
}

/// [`load`] for bytes in memory; `name` ends the error message.
///
/// # Errors
/// As [`load`].
pub fn load_bytes(bytes: &[u8], name: &str, progress: &Progress) -> Result<Loaded, LoadError> {
    loaded(bytes, Shape::Latlong, progress).map_err(named(name))
}

/// Size that a file declares, without decoding it: (width, height), not judged yet.
///
/// # Errors
/// When the format is unknown or its header is damaged.
pub fn declared_size(bytes: &[u8]) -> Result<(u64, u64), LoadProblem> {
    format_of(bytes).and_then(|format| header::declared_size(format, bytes))
}

fn from_file<T>(
    path: &Path,
    progress: &Progress,
    read: impl FnOnce(&[u8]) -> Result<T, LoadProblem>,
) -> Result<T, LoadError> {
    read_whole(path, MOST_FILE_BYTES, progress)
        .map_err(LoadProblem::from)
        .and_then(|bytes| read(&bytes))
        .map_err(named(&path.display().to_string()))
}

fn named(name: &str) -> impl FnOnce(LoadProblem) -> LoadError {
    move |problem| LoadError {
        problem,
        name: name.to_owned(),
    }
}

fn format_of(bytes: &[u8]) -> Result<Format, LoadProblem> {
    if bytes.is_empty() {
        return Err(LoadProblem::Empty);
    }
    Format::of(bytes).ok_or_else(|| LoadProblem::UnknownFormat {
        start: bytes[..bytes.len().min(8)].to_vec(),
    })
}

fn opened(bytes: &[u8], progress: &Progress) -> Result<Opened, LoadProblem> {
    let format = format_of(bytes)?;
    if format.is_container() {
        container::read(format, bytes, progress).map(Opened::Container)
    } else {
        raster_file(bytes, progress).map(Opened::Raster)
    }
}

fn raster_file(bytes: &[u8], progress: &Progress) -> Result<RasterFile, LoadProblem> {
    let (format, [width, height], decoded) = decode(bytes, Shape::Any, progress)?;
    let raster = decoded.texels.into_raster([width, height]);
    Ok(RasterFile {
        raster: raster.ok_or_else(|| LoadProblem::damaged(format, "it has no texels"))?,
        format,
        stored: decoded.stored,
        envmap: decoded.envmap,
    })
}

fn loaded(bytes: &[u8], shape: Shape, progress: &Progress) -> Result<Loaded, LoadProblem> {
    let (format, [width, height], decoded) = decode(bytes, shape, progress)?;
    let image = Image::new(width, height, decoded.texels.into_light()?)
        .map_err(|error| LoadProblem::damaged(format, error))?;
    Ok(Loaded::from_image(image, progress))
}

fn decode(
    bytes: &[u8],
    shape: Shape,
    progress: &Progress,
) -> Result<(Format, [u32; 2], Decoded), LoadProblem> {
    let format = format_of(bytes)?;
    let (width, height) = header::declared_size(format, bytes)?;
    let size = judged_size(width, height, shape)?;
    progress.enter(Stage::Decoding);
    stop_if_cancelled(progress)?;
    let job = Job {
        bytes,
        width: size[0],
        height: size[1],
        keeps_bits: matches!(shape, Shape::Any),
        progress,
    };
    let decoded = match format {
        Format::Hdr => hdr::decode(&job)?,
        Format::Exr => exr::decode(&job)?,
        Format::Png => png::decode(&job)?,
        Format::Jpeg => jpeg::decode(&job)?,
        Format::Ktx2 | Format::Dds => {
            return Err(LoadProblem::Unsupported {
                format,
                what: "it holds faces and levels, and one picture is wanted; convert it".to_owned(),
            });
        }
    };
    stop_if_cancelled(progress)?;
    Ok((format, size, decoded))
}

/// What every decoder gets. The sides have been judged, the bytes are when they are reserved.
struct Job<'a> {
    bytes: &'a [u8],
    width: u32,
    height: u32,
    /// Whether every bit is wanted, or else light without opacity.
    keeps_bits: bool,
    progress: &'a Progress,
}

impl Job<'_> {
    fn texels(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Room for `count` values, within the limit on the bytes of a picture.
    fn reserved<T>(&self, count: usize) -> Result<Vec<T>, LoadProblem> {
        self.judge_bytes(count, size_of::<T>())?;
        reserved(count)
    }

    /// `count` zeros, within the same limit.
    fn zeroed<T: Clone>(&self, zero: T, count: usize) -> Result<Vec<T>, LoadProblem> {
        self.judge_bytes(count, size_of::<T>())?;
        zeroed(zero, count)
    }

    fn judge_bytes(&self, count: usize, size: usize) -> Result<(), LoadProblem> {
        judged_bytes(self.width, self.height, count as u64 * size as u64)
    }

    /// Reports that `rows` are done; fails when the user wants to stop.
    fn row_done(&self, rows: usize) -> Result<(), LoadProblem> {
        self.progress.step(rows, self.height as usize);
        stop_if_cancelled(self.progress)
    }
}

/// What a picture must look like.
#[derive(Clone, Copy, Debug)]
enum Shape {
    Latlong,
    Square,
    Any,
}

fn judged_size(width: u64, height: u64, shape: Shape) -> Result<[u32; 2], LoadProblem> {
    let within = |most_width: u32, most_height: u32| {
        let [w, h] = [u32::try_from(width).ok()?, u32::try_from(height).ok()?];
        (w <= most_width && h <= most_height).then_some([w, h])
    };
    match shape {
        Shape::Latlong => {
            let size = within(MOST_WIDTH, MOST_HEIGHT);
            let [w, h] = size.ok_or(LoadProblem::TooLarge { width, height })?;
            if w == 0 || h == 0 || w.abs_diff(2 * h) > 1 {
                return Err(LoadProblem::NotLatlong { width, height });
            }
            Ok([w, h])
        }
        Shape::Square => {
            let size = within(MOST_BALL, MOST_BALL);
            let [w, h] = size.ok_or(LoadProblem::BallTooLarge { width, height })?;
            if w == 0 || w != h {
                return Err(LoadProblem::NotSquare { width, height });
            }
            Ok([w, h])
        }
        Shape::Any => judged_side(width, height),
    }
}

/// The declared sides, where they are within the limit on any picture.
pub(super) fn judged_side(width: u64, height: u64) -> Result<[u32; 2], LoadProblem> {
    let side = |n: u64| u32::try_from(n).ok().filter(|n| *n <= MOST_SIDE);
    // No format spends less than a byte on a texel in memory.
    let bytes = width.saturating_mul(height);
    match (side(width), side(height)) {
        (Some(w), Some(h)) => {
            judged_bytes(w, h, bytes)?;
            Ok([w, h])
        }
        _ => Err(LoadProblem::TooManyBytes {
            width,
            height,
            bytes,
        }),
    }
}

/// Whether that many bytes are within the limit on any picture.
pub(super) fn judged_bytes(width: u32, height: u32, bytes: u64) -> Result<(), LoadProblem> {
    if bytes > MOST_RASTER_BYTES {
        let (width, height) = (u64::from(width), u64::from(height));
        return Err(LoadProblem::TooManyBytes {
            width,
            height,
            bytes,
        });
    }
    Ok(())
}

pub(super) fn stop_if_cancelled(progress: &Progress) -> Result<(), LoadProblem> {
    if progress.is_cancelled() {
        Err(LoadProblem::Cancelled)
    } else {
        Ok(())
    }
}

/// An empty vector with room for `count`, or an error where `vec!` would end the process.
pub(super) fn reserved<T>(count: usize) -> Result<Vec<T>, LoadProblem> {
    let mut vector = Vec::new();
    vector
        .try_reserve_exact(count)
        .map_err(|_| LoadProblem::OutOfMemory {
            bytes: count as u64 * size_of::<T>() as u64,
        })?;
    Ok(vector)
}

/// `count` zeros, or an error where `vec!` would end the process. The system hands out zeroed pages only when they are
/// written, so a short file that declares much costs little.
pub(super) fn zeroed<T: Clone>(zero: T, count: usize) -> Result<Vec<T>, LoadProblem> {
    drop(reserved::<T>(count)?);
    Ok(vec![zero; count])
}
