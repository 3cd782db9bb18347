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
    let name = paths
        .first()
        .map(|path| path.display().to_string())
        .unwrap_or_default();
    let unclear = |why: String| LoadError {
        problem: LoadProblem::Unclear(why),
        name: name.clone(),
    };
    let [path] = paths else {
        return Err(unclear("name one file".to_owned()));
    };
    let file = super::load::read_raster(path, progress)?;
    let known = super::detect::Known {
        envmap: file.envmap,
        is_cube: false,
    };
    let rasters = [file.raster];
    let detection = super::detect::detect(&rasters, known);
    let [raster] = rasters;
    let first = detection.proposals.first();
    let mapping = hints
        .mapping
        .or(first
            .filter(|_| detection.is_certain)
            .map(|first| first.mapping))
        .ok_or_else(|| {
            unclear("what map it is cannot be told; name it with --from MAP".to_owned())
        })?;
    let proposed = first.filter(|first| first.mapping == mapping);
    let layout = hints
        .layout
        .or(proposed.map(|first| first.layout))
        .unwrap_or(mapping.info().layout);
    let map = EnvironmentMap::from_layout(mapping, layout, vec![raster])
        .map_err(|error| unclear(error.to_string()))?;
    let (mut shape, rasters) = map.into_parts();
    if let Some(frame) = hints.frame {
        let applied = shape.apply_frame(frame, layout);
        applied.map_err(|error| unclear(error.to_string()))?;
    }
    if let Some(arrangement) = &hints.arrange {
        shape.arrange(arrangement);
    }
    if let Some(siting) = hints.siting {
        shape.siting = siting;
    }
    let map = EnvironmentMap::new(shape, rasters).map_err(|error| unclear(error.to_string()))?;
    Ok(OpenedMap {
        map,
        proposals: detection.proposals,
        chosen: Proposal {
            mapping,
            layout,
            siting: Siting::Centre,
            frame: None,
            score: None,
            doubt: 0.0,
            why: "it is said to be, or has the shape".to_owned(),
        },
        notes: Vec::new(),
        bad: BadTexels::default(),
        format: file.format,
        stored: file.stored,
    })
}
