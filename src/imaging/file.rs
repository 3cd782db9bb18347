//! Opening and reading what may be anything.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::{Progress, Stage};

/// A file's own name without its folders, for lists; the whole path where it has none.
pub fn short_name(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str());
    name.to_string_lossy().into_owned()
}

/// Opens a file for reading, and nothing else: a pipe would wait for ever when opened, and a device may never end.
///
/// # Errors
/// What the system says, or [`io::ErrorKind::InvalidInput`] when there is something that is no regular file.
pub fn open_regular(path: &Path) -> io::Result<File> {
    // The kind is asked for first: opening is what waits.
    if std::fs::metadata(path)?.is_file() {
        File::open(path)
    } else {
        let kind = io::ErrorKind::InvalidInput;
        Err(io::Error::new(kind, "it is not a regular file"))
    }
}

/// Why a file was not read.
#[derive(Debug)]
pub(crate) enum ReadProblem {
    /// The user stopped it.
    Cancelled,
    /// The system refused.
    Io(io::Error),
    /// More bytes than allowed: so many.
    TooLong(u64),
    /// No room for so many bytes.
    OutOfMemory(u64),
}

/// All bytes of a regular file of at most `most` bytes, read as the stage [`Stage::Reading`].
pub(crate) fn read_whole(
    path: &Path,
    most: u64,
    progress: &Progress,
) -> Result<Vec<u8>, ReadProblem> {
    const STEP: u64 = 1 << 22;
    progress.enter(Stage::Reading);
    let file = open_regular(path).map_err(ReadProblem::Io)?;
    let length = file.metadata().map_err(ReadProblem::Io)?.len();
    if length > most {
        return Err(ReadProblem::TooLong(length));
    }
    let mut file = file.take(most + 1);
    let mut bytes = Vec::new();
    bytes
        .try_reserve_exact(length as usize)
        .map_err(|_| ReadProblem::OutOfMemory(length))?;
    while (&mut file)
        .take(STEP)
        .read_to_end(&mut bytes)
        .map_err(ReadProblem::Io)?
        > 0
    {
        progress.step(bytes.len(), length as usize);
        if progress.is_cancelled() {
            return Err(ReadProblem::Cancelled);
        }
    }
    // The file may have grown since its length was asked for.
    if bytes.len() as u64 > most {
        return Err(ReadProblem::TooLong(bytes.len() as u64));
    }
    Ok(bytes)
}
