//! Why a model did not open.

use std::io;

use thiserror::Error;

use super::{Format, MOST_FILE_BYTES};
use crate::imaging::{Progress, ReadProblem};

/// What is wrong and where.
#[derive(Debug, Error)]
#[error("{problem}: {name}")]
pub struct MeshError {
    /// What is wrong and what helps.
    pub problem: MeshProblem,
    /// The model's path.
    pub name: String,
}

/// Why a model did not open. Each message is one line and ends in what to do.
#[derive(Debug, Error)]
pub enum MeshProblem {
    /// The user stopped it.
    #[error("opening was cancelled; open it again to go on")]
    Cancelled,
    /// The system refused.
    #[error("the file cannot be read ({0}); check its name and rights")]
    Io(io::Error),
    /// Too many bytes.
    #[error("the file has {bytes} bytes, the limit is {MOST_FILE_BYTES}; simplify the model")]
    FileTooLong {
        /// Length of the file, or of a buffer together with those read before.
        bytes: u64,
    },
    /// Neither signature nor ending is known.
    #[error(
        "the file starts with {start:02x?}, which no format here does; choose a glTF, GLB or OBJ file"
    )]
    UnknownFormat {
        /// The first bytes, eight at most.
        start: Vec<u8>,
    },
    /// More than is allowed. Judged by the declared count, before anything of that size is made.
    #[error("the model has {count} {what}, the limit is {limit}; simplify it")]
    TooMany {
        /// Of what.
        what: &'static str,
        /// How many there are, or were when the limit was passed.
        count: u64,
        /// How many are allowed.
        limit: u64,
    },
    /// A buffer that is not a file in the model's folder. Nothing was opened.
    #[error(
        "the model asks for the file {uri}, but {reason}; put the file beside the model and name it without a folder"
    )]
    Outside {
        /// What the model asks for, quoted and cut to one line.
        uri: String,
        /// Why it is refused.
        reason: &'static str,
    },
    /// A buffer in the model's folder does not open.
    #[error("the buffer {uri} cannot be read ({reason}); put the whole file beside the model")]
    Buffer {
        /// What the model asks for, quoted and cut to one line.
        uri: String,
        /// What the system said, or which kind of file it is.
        reason: String,
    },
    /// Correct, but of a kind that does not open.
    #[error("{} of this kind does not open: {what}", format.name())]
    Unsupported {
        /// Format of the file.
        format: Format,
        /// What is not supported and what is.
        what: String,
    },
    /// Contradicts itself or its format.
    #[error("the {} is damaged ({reason}); fetch or export it again", format.name())]
    Damaged {
        /// Format of the file.
        format: Format,
        /// What was found.
        reason: String,
    },
    /// Nothing to show.
    #[error("the model has no triangle with an area ({what}); export it as a surface of triangles")]
    Empty {
        /// What it has instead.
        what: String,
    },
    /// The system has no room.
    #[error("there is no memory for {bytes} bytes; simplify the model or close something")]
    OutOfMemory {
        /// Bytes that were asked for.
        bytes: u64,
    },
}

impl From<ReadProblem> for MeshProblem {
    fn from(problem: ReadProblem) -> Self {
        match problem {
            ReadProblem::Cancelled => Self::Cancelled,
            ReadProblem::Io(error) => Self::Io(error),
            ReadProblem::TooLong(bytes) => Self::FileTooLong { bytes },
            ReadProblem::OutOfMemory(bytes) => Self::OutOfMemory { bytes },
        }
    }
}

/// What a glTF file does that its format forbids.
pub(super) fn damaged_gltf(reason: String) -> MeshProblem {
    MeshProblem::Damaged {
        format: Format::Gltf,
        reason,
    }
}

/// Fails when there are more than `limit`.
pub(super) fn judge(what: &'static str, count: u64, limit: u64) -> Result<(), MeshProblem> {
    if count > limit {
        return Err(MeshProblem::TooMany { what, count, limit });
    }
    Ok(())
}

/// Fails when the user wants to stop.
pub(super) fn stop_if_cancelled(progress: &Progress) -> Result<(), MeshProblem> {
    if progress.is_cancelled() {
        return Err(MeshProblem::Cancelled);
    }
    Ok(())
}

/// Text from a file for a message: quoted, without control characters, cut to a line's length.
pub(super) fn quoted(text: &str) -> String {
    const MOST: usize = 80;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{:?}...", &text[..end]),
        None => format!("{text:?}"),
    }
}
