//! An environment map of any shape from files.

use std::path::PathBuf;
use std::sync::Arc;

use super::detect::{MEETS, Proposal, plain_shape};
use super::load::Format;
use super::seams::seams;
use super::solver::{Solution, solve};
use super::{
    BadTexels, EnvironmentMap, LoadError, LoadProblem, MapShape, OpenHints, Originals, Pictures,
    Progress, Raster, Siting, Stage, Stored,
};
use crate::mapping::{Layout, MappingId};

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
    /// How the six faces would meet, when they do not as they are labelled.
    pub misfit: Option<Solution>,
    /// Texels that were no numbers.
    pub bad: BadTexels,
    /// What those of the first picture held.
    pub(super) originals: Arc<Originals>,
    /// Format of the file, or of the first.
    pub format: Format,
    /// How it stores a sample.
    pub stored: Stored,
    /// The path of the first file.
    pub(super) name: String,
}

/// Opens a map: one file, or one for each chart, six in the order +x -x +y -y +z -z. In the name of a single path `%f` stands
/// for the names of the charts, six faces where the mapping is not said, and beside a file that is named like a face the other five are looked for, unless the
/// hints say that it is a map by itself.
///
/// # Errors
/// When a file does not open, the files do not fit together or to the hints, or it cannot be told what they are.
pub fn open_map(
    paths: &[PathBuf],
    hints: &OpenHints,
    progress: &Progress,
) -> Result<OpenedMap, LoadError> {
    let opened = Pictures::read(paths, hints, progress)?.taken(hints)?;
    progress.enter(Stage::Done);
    progress.step(1, 1);
    Ok(opened)
}

impl OpenedMap {
    /// Whether nobody needs to be asked: six faces meet as they are labelled.
    pub fn is_sure(&self) -> bool {
        self.misfit.is_none()
    }

    /// How it was read, such as "read as `cube` as `cross`: 4 to 3, a horizontal cross of six squares; seams 1.02", and what
    /// the user should know.
    pub fn sentence(&self) -> String {
        let notes = self.notes.iter().map(|note| format!("; {note}"));
        format!(
            "read as {}{}",
            self.chosen.sentence(),
            notes.collect::<String>()
        )
    }
}

impl Pictures {
    /// The map that the pictures are, by what is said of them. Nothing is copied.
    ///
    /// # Errors
    /// When it cannot be told what they are, or they cannot be what is said.
    pub fn taken(&self, hints: &OpenHints) -> Result<OpenedMap, LoadError> {
        let untold = |text| LoadError {
            problem: LoadProblem::Untold(text),
            name: self.name(),
        };
        let rasters = &self.rasters[..];
        let mut notes = self.notes.clone();
        let mut chosen = self.choose(hints).map_err(untold)?;
        let is_said = hints.mapping.is_some() || self.known.is_cube || self.known.envmap.is_some();
        if chosen.mapping == MappingId::Cube && !is_said {
            notes.push("taken as `cube`; pixels cannot tell it from `eac` and `ccm`".to_owned());
        }
        let (shape, misfit) = shaped(&mut chosen, hints, rasters).map_err(untold)?;
        let is_siting_said =
            hints.siting.is_some() || hints.frame.is_some() || chosen.frame.is_some();
        if chosen.siting == Siting::Edge && !is_siting_said {
            notes.push(
                "its texels are the same on both sides of its borders: taken as edge samples"
                    .to_owned(),
            );
        }
        // Of what was said it is not known yet, and faces that are arranged in another way meet in another way.
        if !hints.is_empty() {
            chosen.score = seams(&shape, rasters).and_then(|seams| seams.score());
        }
        if let Some(score) = chosen
            .score
            .filter(|score| *score > MEETS && rasters.len() == 1)
        {
            notes.push(format!(
                "`{}` meets badly at its borders ({score:.1} times as rough as beside them)",
                chosen.mapping
            ));
        }
        if let Some(solution) = &misfit {
            let sentence = solution.sentence();
            notes.push(format!("the six faces do not meet as labelled: {sentence}"));
        }
        let map = EnvironmentMap::shared(shape, Arc::clone(&self.rasters))
            .map_err(|error| untold(error.to_string()))?;
        Ok(OpenedMap {
            map,
            proposals: self.detection.proposals.clone(),
            chosen,
            notes,
            misfit,
            bad: self.bad,
            originals: Arc::clone(&self.originals),
            format: self.format,
            stored: self.stored,
            name: self.name(),
        })
    }

    /// As what the pictures are taken.
    fn choose(&self, hints: &OpenHints) -> Result<Proposal, String> {
        let (detection, rasters) = (&self.detection, &self.rasters[..]);
        let fits = |proposal: &Proposal| {
            hints
                .mapping
                .is_none_or(|mapping| mapping == proposal.mapping)
                && hints.layout.is_none_or(|layout| layout == proposal.layout)
        };
        let all = &detection.proposals;
        let fitting: Vec<&Proposal> = all.iter().filter(|proposal| fits(proposal)).collect();
        if let Some(taken) = detection.taken().filter(|taken| fits(taken)) {
            return Ok(taken.clone());
        }
        if let Some(first) = fitting.first() {
            let says_faces = hints.frame.is_some() || hints.arrange.is_some();
            let is_only = fitting.iter().all(|other| first.is_laid_like(other));
            let is_hinted = hints.mapping.is_some() || hints.layout.is_some() || says_faces;
            if hints.mapping.is_some() || rasters.len() > 1 || (is_hinted && is_only) {
                return Ok((*first).clone());
            }
        } else if let Some(mapping) = hints.mapping {
            // As it is written when nothing is said.
            let usual = if rasters.len() == 1 {
                mapping.info().layout
            } else {
                Layout::Faces
            };
            let said = Proposal::said(mapping, hints.layout.unwrap_or(usual));
            if is_whole(&said, rasters, hints.layout.is_some()) {
                return Ok(said);
            }
            let named = |layout: Layout| format!(" as `{}`", layout.id());
            let layout = hints.layout.map_or(String::new(), named);
            return Err(format!(
                "{} cannot be `{mapping}`{layout}; name another mapping or layout",
                found(rasters)
            ));
        }
        let ways: Vec<String> = all.iter().take(2).map(Proposal::sentence).collect();
        let may_be = if ways.is_empty() {
            " has the shape of no known map".to_owned()
        } else {
            format!(" may be {}", ways.join(", or "))
        };
        let notes: String = self.notes.iter().map(|note| format!("; {note}")).collect();
        Err(format!(
            "{}{may_be}{notes}; name its mapping and layout",
            found(rasters)
        ))
    }
}

/// "a picture of 64 x 64".
fn found(rasters: &[Raster]) -> String {
    let [width, height] = rasters.first().map(Raster::size).unwrap_or_default();
    match rasters.len() {
        1 => format!("a picture of {width} x {height}"),
        count => format!("{count} pictures of {width} x {height}"),
    }
}

/// Whether the pictures hold the charts: where there are many, and where nobody has said how they lie, each is square.
fn is_whole(proposal: &Proposal, rasters: &[Raster], is_laid_out: bool) -> bool {
    let shape = plain_shape(proposal.mapping, proposal.layout, rasters);
    shape.is_some_and(|shape| match shape.charts.len() {
        1 => true,
        2 if is_laid_out => true,
        _ => shape.size[0] == shape.size[1],
    })
}

/// The shape of the map, after all that is said of its orientation; and how its faces would meet, when they do not.
fn shaped(
    chosen: &mut Proposal,
    hints: &OpenHints,
    rasters: &[Raster],
) -> Result<(MapShape, Option<Solution>), String> {
    if let Some(frame) = hints.frame {
        chosen.frame = Some(frame);
        // What is known of a program says more than pixels, which are alike on both sides of an even border.
        chosen.siting = if frame.is_edge_sited {
            Siting::Edge
        } else {
            Siting::Centre
        };
    }
    chosen.siting = hints.siting.unwrap_or(chosen.siting);
    let unfit = || {
        format!(
            "{} cannot be `{}` so; name another layout",
            found(rasters),
            chosen.mapping
        )
    };
    let mut labelled = plain_shape(chosen.mapping, chosen.layout, rasters).ok_or_else(unfit)?;
    // A single sample lies on no border.
    if labelled.size.contains(&1) {
        chosen.siting = Siting::Centre;
    }
    labelled.siting = chosen.siting;
    let mut shape = labelled.clone();
    if let Some(frame) = chosen.frame {
        shape
            .apply_frame(frame, chosen.layout)
            .map_err(|error| error.to_string())?;
        labelled.apply_order(frame, chosen.layout);
    }
    if let Some(arrangement) = &hints.arrange {
        if shape.charts.len() != 6 {
            return Err(format!(
                "`{}` has no six faces to arrange; leave that out",
                chosen.mapping
            ));
        }
        shape = labelled.clone();
        shape.arrange(arrangement);
    }
    shape.siting = chosen.siting;
    let fit = solve(&shape, rasters);
    let is_misfit = fit.as_ref().is_some_and(|fit| {
        let is_other = fit.is_certain && fit.arrangement.changed() > 0;
        is_other || fit.as_labelled.is_some_and(|score| score > MEETS)
    });
    let misfit = is_misfit.then(|| solve(&labelled, rasters)).flatten();
    if hints.mirrored {
        shape.mirror();
    }
    Ok((shape, misfit))
}
