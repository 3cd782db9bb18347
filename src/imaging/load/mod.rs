//! A latlong environment from a file: Radiance HDR, OpenEXR, PNG, JPEG.
//!
//! The declared size is read from the header and judged before a decoder sees the file: failed allocations end the
//! process and cannot be caught. Reading a header holds no more than the header's own bytes.

mod exr;
mod hdr;
mod header;
mod jpeg;
mod png;

use std::io;
use std::path::Path;

use thiserror::Error;

use super::sanitize::{BadTexels, Originals, sanitize};
use super::{Image, Progress, ReadProblem, Stage, read_whole};

/// Most texels in a row: twice the largest height.
pub const MOST_WIDTH: u32 = 16384;

/// Most rows. 16384 x 8192 texels take 1.5 GiB as f32 RGB.
pub const MOST_HEIGHT: u32 = 8192;

/// Most texels a side of a ball's picture: more than any viewport shows of it, and within every device's limits.
pub const MOST_BALL: u32 = 4096;

/// Longest file: the largest allowed picture as uncompressed 32-bit RGBA.
pub const MOST_FILE_BYTES: u64 = MOST_WIDTH as u64 * MOST_HEIGHT as u64 * 16;

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
}

impl Format {
    /// The format's usual name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hdr => "Radiance HDR",
            Self::Exr => "OpenEXR",
            Self::Png => "PNG",
            Self::Jpeg => "JPEG",
        }
    }

    /// The format whose signature `bytes` start with. File names are not asked.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [b'#', b'?', ..] => Some(Self::Hdr),
            [0x76, 0x2f, 0x31, 0x01, ..] => Some(Self::Exr),
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => Some(Self::Png),
            [0xff, 0xd8, 0xff, ..] => Some(Self::Jpeg),
            _ => None,
        }
    }
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

/// What is wrong and where.
#[derive(Debug, Error)]
#[error("{problem}: {name}")]
pub struct LoadError {
    /// What is wrong and what helps.
    pub problem: LoadProblem,
    /// The file's path, or what else names the source.
    pub name: String,
}

/// Why a picture did not open. Each message ends in what to do.
#[derive(Debug, Error)]
pub enum LoadProblem {
    /// The user stopped it.
    #[error("opening was cancelled; open it again to go on")]
    Cancelled,
    /// The system refused.
    #[error("the file cannot be read ({0}); check its name and rights")]
    Io(io::Error),
    /// Too many bytes.
    #[error(
        "the file has {bytes} bytes, the limit is {MOST_FILE_BYTES}; store it compressed or smaller"
    )]
    FileTooLong {
        /// Length of the file.
        bytes: u64,
    },
    /// No known signature.
    #[error(
        "the file starts with {start:02x?}, which no format here does; choose an HDR, EXR, PNG or JPEG file"
    )]
    UnknownFormat {
        /// The first bytes, eight at most.
        start: Vec<u8>,
    },
    /// The header declares more than is allowed. Nothing was decoded.
    #[error(
        "the file declares {width} x {height}, the limit is {MOST_WIDTH} x {MOST_HEIGHT}; scale it down"
    )]
    TooLarge {
        /// Declared texels in a row.
        width: u64,
        /// Declared rows.
        height: u64,
    },
    /// A ball's picture is larger than it can be shown.
    #[error(
        "the file declares {width} x {height}, a ball's picture has at most {MOST_BALL} a side; scale it down"
    )]
    BallTooLarge {
        /// Declared texels in a row.
        width: u64,
        /// Declared rows.
        height: u64,
    },
    /// Not twice as wide as high.
    #[error(
        "the picture is {width} x {height}, but a latlong is twice as wide as high; convert it, only latlong opens for now"
    )]
    NotLatlong {
        /// Texels in a row.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// Not as wide as high.
    #[error("the picture is {width} x {height}, but a ball's is square; crop it to the ball")]
    NotSquare {
        /// Texels in a row.
        width: u64,
        /// Rows.
        height: u64,
    },
    /// The header declares more memory than the picture needs.
    #[error(
        "the header declares {declared} bytes for {what}, the limit is {limit}; store it with fewer channels, smaller tiles and without levels"
    )]
    TooMuch {
        /// What for.
        what: &'static str,
        /// How many bytes.
        declared: u64,
        /// How many are allowed.
        limit: u64,
    },
    /// Correct, but of a kind that does not open.
    #[error("{} of this kind does not open: {what}", format.name())]
    Unsupported {
        /// Format of the file.
        format: Format,
        /// What is not supported and what is.
        what: String,
    },
    /// Damaged or cut off.
    #[error("the {} is damaged ({reason}); fetch or export it again", format.name())]
    Damaged {
        /// Format of the file.
        format: Format,
        /// What the decoder said.
        reason: String,
    },
    /// The system has no room.
    #[error("there is no memory for {bytes} bytes; scale the picture down or close something")]
    OutOfMemory {
        /// Bytes that were asked for.
        bytes: u64,
    },
}

impl From<ReadProblem> for LoadProblem {
    fn from(problem: ReadProblem) -> Self {
        match problem {
            ReadProblem::Cancelled => Self::Cancelled,
            ReadProblem::Io(error) => Self::Io(error),
            ReadProblem::TooLong(bytes) => Self::FileTooLong { bytes },
            ReadProblem::OutOfMemory(bytes) => Self::OutOfMemory { bytes },
        }
    }
}

impl LoadProblem {
    fn damaged(format: Format, reason: impl ToString) -> Self {
        Self::Damaged {
            format,
            reason: reason.to_string(),
        }
    }
}

/// Opens a latlong picture.
///
/// # Errors
/// [`LoadError`], one line: what was found, what to do, the path last. Never panics on a bad file.
pub fn load(path: &Path, progress: &Progress) -> Result<Loaded, LoadError> {
    load_shaped(path, Shape::Latlong, progress)
}

/// Opens a square picture of a ball.
///
/// # Errors
/// As [`load`].
pub fn load_ball(path: &Path, progress: &Progress) -> Result<Loaded, LoadError> {
    load_shaped(path, Shape::Square, progress)
}

fn load_shaped(path: &Path, shape: Shape, progress: &Progress) -> Result<Loaded, LoadError> {
    let name = path.display().to_string();
    match read_whole(path, MOST_FILE_BYTES, progress) {
        Ok(bytes) => load_shaped_bytes(&bytes, shape, &name, progress),
        Err(problem) => Err(LoadError {
            problem: problem.into(),
            name,
        }),
    }
}

/// Opens a latlong picture that is in memory; `name` ends the error message.
///
/// # Errors
/// As [`load`].
pub fn load_bytes(bytes: &[u8], name: &str, progress: &Progress) -> Result<Loaded, LoadError> {
    load_shaped_bytes(bytes, Shape::Latlong, name, progress)
}

fn load_shaped_bytes(
    bytes: &[u8],
    shape: Shape,
    name: &str,
    progress: &Progress,
) -> Result<Loaded, LoadError> {
    decode(bytes, shape, progress)
        .map(|image| Loaded::from_image(image, progress))
        .map_err(|problem| LoadError {
            problem,
            name: name.to_owned(),
        })
}

/// Size that a file declares, without decoding it: (width, height), not judged yet.
///
/// # Errors
/// When the format is unknown or its header is damaged.
pub fn declared_size(bytes: &[u8]) -> Result<(u64, u64), LoadProblem> {
    format_of(bytes).and_then(|format| header::declared_size(format, bytes))
}

fn format_of(bytes: &[u8]) -> Result<Format, LoadProblem> {
    Format::of(bytes).ok_or_else(|| LoadProblem::UnknownFormat {
        start: bytes[..bytes.len().min(8)].to_vec(),
    })
}

fn decode(bytes: &[u8], shape: Shape, progress: &Progress) -> Result<Image, LoadProblem> {
    let format = format_of(bytes)?;
    let (width, height) = header::declared_size(format, bytes)?;
    let (width, height) = judged_size(width, height, shape)?;
    progress.enter(Stage::Decoding);
    stop_if_cancelled(progress)?;
    let job = Job {
        bytes,
        width,
        height,
        progress,
    };
    let pixels = match format {
        Format::Hdr => hdr::decode(&job)?,
        Format::Exr => exr::decode(&job)?,
        Format::Png => png::decode(&job)?,
        Format::Jpeg => jpeg::decode(&job)?,
    };
    stop_if_cancelled(progress)?;
    Image::new(width, height, pixels).map_err(|error| LoadProblem::damaged(format, error))
}

/// What every decoder gets. The size has been judged.
struct Job<'a> {
    bytes: &'a [u8],
    width: u32,
    height: u32,
    progress: &'a Progress,
}

impl Job<'_> {
    fn texels(&self) -> usize {
        self.width as usize * self.height as usize
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
}

fn judged_size(width: u64, height: u64, shape: Shape) -> Result<(u32, u32), LoadProblem> {
    match (u32::try_from(width), u32::try_from(height)) {
        (Ok(w), Ok(h)) if w <= MOST_BALL && h <= MOST_BALL && matches!(shape, Shape::Square) => {
            if w == 0 || w != h {
                return Err(LoadProblem::NotSquare { width, height });
            }
            Ok((w, h))
        }
        _ if matches!(shape, Shape::Square) => Err(LoadProblem::BallTooLarge { width, height }),
        (Ok(w), Ok(h)) if w <= MOST_WIDTH && h <= MOST_HEIGHT => {
            if w == 0 || h == 0 || w.abs_diff(2 * h) > 1 {
                return Err(LoadProblem::NotLatlong { width, height });
            }
            Ok((w, h))
        }
        _ => Err(LoadProblem::TooLarge { width, height }),
    }
}

fn stop_if_cancelled(progress: &Progress) -> Result<(), LoadProblem> {
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
