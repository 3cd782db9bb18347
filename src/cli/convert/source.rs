//! Maps from files or from the program itself.

use std::path::PathBuf;

use super::error::ConvertError;
use super::names::Name;
use crate::imaging::detect::Proposal;
use crate::imaging::load::Format;
use crate::imaging::solver::{LatlongWay, ShaderLanguage, SkyHint, lookup_code, solve};
use crate::imaging::{Environment, EnvironmentMap, OpenHints, Progress, Stored, open_map};

/// A map, and how its file stored it.
pub(super) struct Source {
    pub map: EnvironmentMap,
    pub format: Format,
    pub stored: Stored,
    /// What the user should know, a sentence each.
    pub notes: Vec<String>,
}

/// The map of a file, or of six.
pub(super) fn open(
    path: PathBuf,
    hints: &OpenHints,
    progress: &Progress,
) -> Result<Source, ConvertError> {
    let opened = open_map(&[path], hints, progress)?;
    let mut notes = opened.notes;
    let certain = opened.misfit.filter(|solution| solution.is_certain);
    notes.extend(certain.map(|solution| format!("try {}", solution.option())));
    Ok(Source {
        map: opened.map,
        format: opened.format,
        stored: opened.stored,
        notes,
    })
}

/// What the program has with it; computed pictures have `rows`, or their usual size.
pub(super) fn built_in(
    environment: &Environment,
    rows: Option<u32>,
    progress: &Progress,
) -> Result<Source, ConvertError> {
    let (map, format, stored) = environment.map(rows.unwrap_or(0), progress)?;
    Ok(Source {
        map,
        format,
        stored,
        notes: Vec::new(),
    })
}

/// The numbers of the frames that a name stands for.
pub(super) fn frames(name: &Name) -> Result<Vec<u64>, ConvertError> {
    /// How six files name their first face.
    const FIRST_FACES: [&str; 6] = ["px", "posx", "right", "+x", "r", "R"];
    let shown = || name.path().display().to_string();
    let frames = |name: &Name| {
        name.frames()
            .map_err(|error| ConvertError::Folder(error, shown()))
    };
    if !name.has_face() {
        return frames(name)
            .and_then(|frames| some(frames).ok_or_else(|| ConvertError::NoFrames(shown())));
    }
    for face in FIRST_FACES {
        if let Some(frames) = some(frames(&name.of_face(face))?) {
            return Ok(frames);
        }
    }
    Err(ConvertError::NoFrames(shown()))
}

fn some(list: Vec<u64>) -> Option<Vec<u64>> {
    (!list.is_empty()).then_some(list)
}

/// What a map seems to be, a line for each proposal and each thing to know.
pub(super) fn look(
    path: PathBuf,
    hints: &OpenHints,
    progress: &Progress,
) -> Result<String, ConvertError> {
    let opened = open_map(&[path], hints, progress)?;
    let line = |proposal: &Proposal| {
        let score = proposal
            .score
            .map_or("-".to_owned(), |score| format!("{score:.2}"));
        let frame = proposal.frame.map_or("-", |frame| frame.id);
        format!(
            "{}\t{}\t{frame}\t{score}\t{}\n",
            proposal.mapping,
            proposal.layout.id(),
            proposal.why
        )
    };
    let mut text = "mapping\tlayout\tframe\tseams\twhy\n".to_owned();
    text.extend(opened.proposals.iter().map(line));
    if let Some(solution) = solve(opened.map.shape(), opened.map.rasters()) {
        text.push_str(&format!("{}\n", solution.sentence()));
        if solution.is_certain {
            text.push_str(&format!(
                "{}\n{}\n",
                solution.mirrored_sentence(),
                solution.option()
            ));
            text.push_str(&lookup_code(&solution.arrangement, ShaderLanguage::Wgsl));
        }
    }
    if let Some(hint) = SkyHint::of(opened.map.shape(), opened.map.rasters()) {
        text.push_str(&format!("{}\n", hint.sentence()));
        if hints.frame.is_none() {
            text.push_str("which way round it lies only its program tells:\n");
            let ways = LatlongWay::all();
            text.extend(ways.iter().map(|way| format!("{}\n", way.sentence())));
        }
    }
    text.extend(opened.notes.iter().map(|note| format!("{note}\n")));
    Ok(text)
}
