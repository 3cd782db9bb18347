//! Why `sixfold convert` ended early.

use std::io;

use crate::imaging::resample::ResampleError;
use crate::imaging::save::SaveError;
use crate::imaging::{LoadError, LoadProblem, atomic};

/// Each message is one line: what is wrong, what to do, the path last.
#[derive(Debug, thiserror::Error)]
pub(in crate::cli) enum ConvertError {
    /// What is asked for makes no sense.
    #[error("{0}")]
    Usage(String),
    /// The map does not open.
    #[error(transparent)]
    Load(LoadError),
    /// Which map it is cannot be told.
    #[error("{} (--from, --from-layout): {}", .0.problem, .0.name)]
    Untold(LoadError),
    /// The conversion cannot be done.
    #[error(transparent)]
    Resample(#[from] ResampleError),
    /// The result cannot be written.
    #[error(transparent)]
    Save(#[from] SaveError),
    /// A name cannot be used.
    #[error(transparent)]
    Name(#[from] atomic::WriteError),
    /// There are no frames.
    #[error("no file has such a name; check the folder and the number's digits: {0}")]
    NoFrames(String),
    /// The folder of the frames cannot be read.
    #[error("the folder cannot be read ({0}); check its name and rights: {1}")]
    Folder(io::Error, String),
    /// A raw frame is not whole.
    #[error(
        "standard input ends {bytes} bytes into frame {frame}, which has {whole}; check the size after --raw"
    )]
    CutShort {
        /// Counted from 1.
        frame: u64,
        /// Bytes that came.
        bytes: usize,
        /// Bytes of a frame.
        whole: u64,
    },
    /// The pipe before.
    #[error("standard input cannot be read: {0}")]
    Read(io::Error),
    /// The pipe behind.
    #[error("standard output cannot be written: {0}")]
    Write(io::Error),
    /// There is no room.
    #[error("there is no memory for {0} bytes; choose a smaller size or close something")]
    OutOfMemory(u64),
    /// The user has asked it to stop.
    #[error("interrupted; no file is left half-written")]
    Interrupted,
    /// A thread ended before its time.
    #[error("a thread of the conversion broke off; please report what you converted")]
    Broken,
}

impl From<LoadError> for ConvertError {
    fn from(error: LoadError) -> Self {
        match error.problem {
            LoadProblem::Untold(_) => Self::Untold(error),
            _ => Self::Load(error),
        }
    }
}

impl ConvertError {
    /// Wrong usage, said in one line.
    pub fn usage(line: impl Into<String>) -> Self {
        Self::Usage(line.into())
    }
}
