//! Why a picture does not open.

use std::io;

use thiserror::Error;

use super::{
    Format, MOST_BALL, MOST_FILE_BYTES, MOST_HEIGHT, MOST_RASTER_BYTES, MOST_SIDE, MOST_WIDTH,
};
use crate::imaging::ReadProblem;

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
    /// No bytes.
    #[error("the file is empty; fetch or export it again")]
    Empty,
    /// No known signature.
    #[error(
        "the file starts with {start:02x?}, which no format here does; choose an HDR, EXR, PNG, JPEG, KTX2 or DDS file"
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
    /// The header declares more than any picture may have. Nothing was decoded.
    #[error(
        "the file declares {width} x {height} ({bytes} bytes unpacked), the limit is {MOST_SIDE} a side and {MOST_RASTER_BYTES} bytes; scale it down"
    )]
    TooManyBytes {
        /// Declared texels in a row.
        width: u64,
        /// Declared rows.
        height: u64,
        /// Bytes of all its texels, as far as they are known.
        bytes: u64,
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
        "the picture is {width} x {height}, but a latlong is twice as wide as high; `sixfold convert` makes one of any other map"
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
    /// It opens, but does not fit together, or nothing comes out of it.
    #[error("{0}")]
    Unclear(String),
    /// It opens, but which map it is cannot be told, or is not what was said of it. Another word of the user's may help.
    #[error("{0}")]
    Untold(String),
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
    pub(crate) fn damaged(format: Format, reason: impl ToString) -> Self {
        Self::Damaged {
            format,
            reason: reason.to_string(),
        }
    }
}
