//! An environment map of any shape from files.

use std::path::{Path, PathBuf};

use super::detect::{Detection, Known, MEETS, Proposal, detect, plain_shape};
use super::face_files::{Named, named};
use super::load::{self, Format};
use super::sanitize::sanitize_raster;
use super::solver::solve;
use super::{
    BadTexels, EnvironmentMap, LoadError, LoadProblem, MapShape, Opened, Progress, Raster, Siting,
    Stage, Stored, Transfer,
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
    /// What each of six pictures really is, instead of what the frame says.
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

/// Opens a map: one file, or one for each chart, six in the order +x -x +y -y +z -z. In the name of a single path `%f` stands
/// for the six names of the faces, and beside a file that is named like a face the other five are looked for, unless the
/// hints say that it is a map by itself.
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
    let unclear = |text| LoadError {
        problem: LoadProblem::Unclear(text),
        name: name.clone(),
    };
    let mut notes = Vec::new();
    let paths = all_paths(paths, hints, &mut notes).map_err(|problem| LoadError {
        problem,
        name: name.clone(),
    })?;
    let mut pictures = read(&paths, progress, &mut notes)?;
    let mut bad = BadTexels::default();
    for raster in &mut pictures.rasters {
        if let Some(transfer) = hints.transfer {
            raster.retag(transfer);
        }
        bad += sanitize_raster(raster);
    }
    let rasters = pictures.rasters;
    let detection = detect(&rasters, pictures.known);
    let mut chosen = choose(&detection, hints, &rasters, &notes).map_err(unclear)?;
    let is_said =
        hints.mapping.is_some() || pictures.known.is_cube || pictures.known.envmap.is_some();
    if chosen.mapping == MappingId::Cube && !is_said {
        notes.push("taken as `cube`; pixels cannot tell it from `eac` and `ccm`".to_owned());
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
    let shape = shaped(&mut chosen, hints, &rasters, &mut notes).map_err(unclear)?;
    let map = EnvironmentMap::new(shape, rasters).map_err(|error| unclear(error.to_string()))?;
    progress.enter(Stage::Done);
    progress.step(1, 1);
    Ok(OpenedMap {
        map,
        proposals: detection.proposals,
        chosen,
        notes,
        bad,
        format: pictures.format,
        stored: pictures.stored,
    })
}

/// The files that the paths stand for.
fn all_paths(
    paths: &[PathBuf],
    hints: &OpenHints,
    notes: &mut Vec<String>,
) -> Result<Vec<PathBuf>, LoadProblem> {
    let is_alone = hints.layout.is_some_and(|layout| layout != Layout::Faces)
        || hints
            .mapping
            .is_some_and(|mapping| mapping.info().chart_count() != 6);
    let [path] = paths else {
        return Ok(paths.to_vec());
    };
    if is_alone {
        return Ok(paths.to_vec());
    }
    match named(path).map_err(LoadProblem::Io)? {
        Named::Six(six) => Ok(six.into()),
        Named::One => Ok(paths.to_vec()),
        Named::Alone(missing) => {
            notes.push(format!(
                "it is named like a face, but `{missing}` is not beside it"
            ));
            Ok(paths.to_vec())
        }
        Named::Missing => Err(LoadProblem::Unclear(
            "no six files have usual names of faces for `%f`; name them px nx py ny pz nz"
                .to_owned(),
        )),
    }
}

/// The pictures of some files, and what the first of them says.
struct Pictures {
    rasters: Vec<Raster>,
    format: Format,
    stored: Stored,
    known: Known,
}

fn read(
    paths: &[PathBuf],
    progress: &Progress,
    notes: &mut Vec<String>,
) -> Result<Pictures, LoadError> {
    let refuse = |path: &Path, text: String| LoadError {
        problem: LoadProblem::Unclear(text),
        name: path.display().to_string(),
    };
    let Some((first, others)) = paths.split_first() else {
        return Err(refuse(
            Path::new("nothing"),
            "no file is named; name one, or six".to_owned(),
        ));
    };
    let mut pictures = match load::open(first, progress)? {
        Opened::Raster(file) => Pictures {
            rasters: vec![file.raster],
            format: file.format,
            stored: file.stored,
            known: Known {
                envmap: file.envmap.filter(|_| others.is_empty()),
                is_cube: false,
            },
        },
        Opened::Container(_) if !others.is_empty() => {
            return Err(refuse(
                first,
                "a container stands among several files; open it alone".to_owned(),
            ));
        }
        Opened::Container(mut container) => {
            let is_cube = container.is_cube();
            if container.levels.len() > 1 {
                notes.push(format!(
                    "the largest of {} levels is taken",
                    container.levels.len()
                ));
            }
            let rasters = container.levels.drain(..).next().map(|level| level.rasters);
            Pictures {
                rasters: rasters.unwrap_or_default(),
                format: container.format,
                stored: container.stored,
                known: Known {
                    envmap: None,
                    is_cube,
                },
            }
        }
    };
    for path in others {
        let file = match load::open(path, progress)? {
            Opened::Raster(file) => file,
            Opened::Container(_) => {
                return Err(refuse(
                    path,
                    "a container stands among several files; open it alone".to_owned(),
                ));
            }
        };
        let is_alike = pictures
            .rasters
            .first()
            .is_some_and(|first| is_alike(first, &file.raster));
        if !is_alike {
            let text = format!(
                "the faces differ: {} after {}; make them alike",
                kind(&file.raster),
                pictures.rasters.first().map(kind).unwrap_or_default()
            );
            return Err(refuse(path, text));
        }
        pictures.rasters.push(file.raster);
    }
    Ok(pictures)
}

fn is_alike(a: &Raster, b: &Raster) -> bool {
    a.size() == b.size()
        && a.channels() == b.channels()
        && a.transfer() == b.transfer()
        && a.samples().kind() == b.samples().kind()
}

/// "64 x 64 Rgb U8".
fn kind(raster: &Raster) -> String {
    let [width, height] = raster.size();
    format!(
        "{width} x {height} {:?} {:?}",
        raster.channels(),
        raster.samples().kind()
    )
}

/// As what the pictures are taken.
fn choose(
    detection: &Detection,
    hints: &OpenHints,
    rasters: &[Raster],
    notes: &[String],
) -> Result<Proposal, String> {
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
        let charts = mapping.info().chart_count();
        let layout = hints.layout.or((charts == 1).then_some(Layout::Single));
        let said = layout.map(|layout| Proposal::said(mapping, layout));
        if let Some(said) = said.filter(|said| is_whole(said, rasters)) {
            return Ok(said);
        }
        let layout = layout.map_or(String::new(), |layout| format!(" as `{}`", layout.id()));
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
    let notes: String = notes.iter().map(|note| format!("; {note}")).collect();
    Err(format!(
        "{}{may_be}{notes}; name its mapping and layout (--from, --from-layout)",
        found(rasters)
    ))
}

/// "a picture of 64 x 64".
fn found(rasters: &[Raster]) -> String {
    let [width, height] = rasters.first().map(Raster::size).unwrap_or_default();
    match rasters.len() {
        1 => format!("a picture of {width} x {height}"),
        count => format!("{count} pictures of {width} x {height}"),
    }
}

/// Whether the pictures hold the charts: those of the cube are square.
fn is_whole(proposal: &Proposal, rasters: &[Raster]) -> bool {
    let shape = plain_shape(proposal.mapping, proposal.layout, rasters);
    shape.is_some_and(|shape| shape.charts.len() != 6 || shape.size[0] == shape.size[1])
}

/// The shape of the map, after all that is said of its orientation.
fn shaped(
    chosen: &mut Proposal,
    hints: &OpenHints,
    rasters: &[Raster],
    notes: &mut Vec<String>,
) -> Result<MapShape, String> {
    if let Some(frame) = hints.frame {
        chosen.frame = Some(frame);
        // What is known of a program says more than pixels, which are alike on both sides of an even border.
        chosen.siting = if frame.is_edge_sited {
            Siting::Edge
        } else {
            Siting::Centre
        };
    } else if chosen.siting == Siting::Edge && hints.siting.is_none() && chosen.frame.is_none() {
        notes.push(
            "its texels are the same on both sides of its borders: taken as `--from-samples edge`"
                .to_owned(),
        );
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
    if is_misfit && let Some(solution) = solve(&labelled, rasters) {
        let option = if solution.is_certain {
            format!("; try {}", solution.option())
        } else {
            String::new()
        };
        notes.push(format!(
            "the six faces do not meet as labelled: {}{option}",
            solution.sentence()
        ));
    }
    Ok(shape)
}
