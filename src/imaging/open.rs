//! An environment map of any shape from files.

use std::path::PathBuf;

use super::detect::Proposal;
use super::load::Format;
use super::{
    BadTexels, EnvironmentMap, LoadError, LoadProblem, Progress, Siting, Stored, Transfer,
};
use crate::mapping::{Arrangement, Frame, Layout, MappingId};

/// What the user says of a map. What is left out is guessed where that is certain.
#[derive(Clone, Copy, Debug, Default)]
pub struct OpenHints {
    /// The mapping.
    pub mapping: Option<MappingId>,
    /// How its charts lie.
    pub layout: Option<Layout>,
    /// The program whose orientation it has.
    pub frame: Option<&'static Frame>,
    /// What each of six pictures really is; comes after the frame's own.
    pub arrange: Option<Arrangement>,
    /// Where its samples sit.
    pub siting: Option<Siting>,
    /// How its numbers become light.
    pub transfer: Option<Transfer>,
}

/// A map, and how it was taken.
#[derive(Clone, Debug)]
pub struct OpenedMap {
    /// The map; every number finite.
    pub map: EnvironmentMap,
    /// What it may be, the likeliest first.
    pub proposals: Vec<Proposal>,
    /// As what it was taken.
    pub chosen: Proposal,
    /// What the user should know, a sentence each.
    pub notes: Vec<String>,
    /// Texels that were no numbers.
    pub bad: BadTexels,
    /// Format of the file, or of the first.
    pub format: Format,
    /// How it stores a sample.
    pub stored: Stored,
}

/// Opens a map: one file, or six in the order +x -x +y -y +z -z. In the name of a single path `%f` stands for the six names
/// of the faces.
///
/// # Errors
/// When a file does not open, the files do not fit together or to the hints, or it cannot be told what they are.
pub fn open_map(
    paths: &[PathBuf],
    hints: &OpenHints,
    progress: &Progress,
) -> Result<OpenedMap, LoadError> {
    let _ = (hints, progress);
    Err(LoadError {
        problem: LoadProblem::Unclear("opening is not built yet".to_owned()),
        name: paths
            .first()
            .map(|path| path.display().to_string())
            .unwrap_or_default(),
    })
}
