//! Reports as files, the same from the command line and from the window.

use std::path::{Path, PathBuf};

use super::bench::Row;
use super::machine::Machine;
use super::report;
use super::scatter::scatter;
use crate::imaging::atomic;
use crate::imaging::png_out::{PngError, encode_png};

/// Names of a bench's files.
pub const BENCH: [&str; 5] = [
    "bench.json",
    "bench.csv",
    "bench_machine.json",
    "bench.svg",
    "bench.png",
];

/// Why a report was not written.
#[derive(Debug, thiserror::Error)]
pub enum LabError {
    /// The folder is not there and cannot be made.
    #[error("the folder cannot be made ({cause}): {}", path.display())]
    Folder {
        /// What the system says.
        cause: std::io::Error,
        /// The folder.
        path: PathBuf,
    },
    /// A file could not be written.
    #[error(transparent)]
    Write(#[from] atomic::WriteError),
    /// The picture could not be made.
    #[error(transparent)]
    Picture(#[from] PngError),
    /// The rows could not be put into words.
    #[error("the report cannot be put into words: {0}")]
    Words(#[from] serde_json::Error),
}

/// Makes the folder; what could not be written is refused before the long work.
///
/// # Errors
/// When the folder cannot be made, or a file is there that may not be replaced.
pub fn prepare(folder: &Path, files: &[&str], force: bool) -> Result<(), LabError> {
    std::fs::create_dir_all(folder).map_err(|cause| LabError::Folder {
        cause,
        path: folder.to_owned(),
    })?;
    for name in files {
        atomic::check_name(&folder.join(name), force)?;
    }
    Ok(())
}

/// Writes a file into the folder.
///
/// # Errors
/// When it cannot be written, or is there and may not be replaced.
pub fn write(folder: &Path, name: &str, force: bool, bytes: &[u8]) -> Result<(), LabError> {
    Ok(atomic::write_atomically(&folder.join(name), force, bytes)?)
}

/// Writes a bench's files into a folder that is there.
///
/// # Errors
/// As [`write()`].
pub fn write_bench(
    folder: &Path,
    force: bool,
    rows: &[Row],
    machine: &Machine,
) -> Result<(), LabError> {
    let picture = scatter(rows);
    let [width, height] = picture.size();
    let contents = [
        report::json(rows)?.into_bytes(),
        report::csv(rows)?.into_bytes(),
        (serde_json::to_string_pretty(machine)? + "\n").into_bytes(),
        picture.svg().into_bytes(),
        encode_png(width, height, &picture.rgba(), None)?,
    ];
    for (name, bytes) in BENCH.iter().zip(contents) {
        write(folder, name, force, &bytes)?;
    }
    Ok(())
}
