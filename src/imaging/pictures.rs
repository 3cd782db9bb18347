//! The pictures of a map as its files hold them, and what they may be.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::detect::{Detection, Known, Proposal, detect};
use super::face_files::{Named, named, of_charts};
use super::load::{self, Format};
use super::sanitize::sanitize_raster;
use super::{
    BadTexels, LoadError, LoadProblem, OpenHints, Opened, Originals, Progress, Raster, Stored,
    Transfer,
};
use crate::mapping::Layout;

/// Decoded files. They are read once; [`Pictures::taken`] says what they are, as often as the user changes what is said of
/// them.
#[derive(Clone, Debug)]
pub struct Pictures {
    /// The files that were read.
    files: Vec<PathBuf>,
    transfer: Option<Transfer>,
    /// Every number finite.
    pub(super) rasters: Arc<Vec<Raster>>,
    pub(super) known: Known,
    pub(super) detection: Detection,
    /// What the user should know, a sentence each.
    pub(super) notes: Vec<String>,
    /// Texels that were no numbers.
    pub(super) bad: BadTexels,
    /// What those of the first picture held.
    pub(super) originals: Arc<Originals>,
    /// Format of the file, or of the first.
    pub(super) format: Format,
    /// How it stores a sample.
    pub(super) stored: Stored,
}

impl Pictures {
    /// Reads the files that [`super::open_map`] would.
    ///
    /// # Errors
    /// When a file does not open, or the files do not fit together.
    pub fn read(
        paths: &[PathBuf],
        hints: &OpenHints,
        progress: &Progress,
    ) -> Result<Self, LoadError> {
        let mut notes = Vec::new();
        let files = all_paths(paths, hints, &mut notes).map_err(|problem| LoadError {
            problem,
            name: paths
                .first()
                .map(|path| path.display().to_string())
                .unwrap_or_default(),
        })?;
        let mut read = read(&files, progress, &mut notes)?;
        let (mut bad, mut originals) = (BadTexels::default(), None);
        for raster in &mut read.rasters {
            if let Some(transfer) = hints.transfer {
                raster.retag(transfer);
            }
            let (more, replaced) = sanitize_raster(raster);
            bad += more;
            originals.get_or_insert(replaced);
        }
        Ok(Self {
            files,
            transfer: hints.transfer,
            detection: detect(&read.rasters, read.known),
            rasters: Arc::new(read.rasters),
            known: read.known,
            notes,
            bad,
            originals: Arc::new(originals.unwrap_or_default()),
            format: read.format,
            stored: read.stored,
        })
    }

    /// Whether these paths with these hints stand for what was read.
    pub fn are_of(&self, paths: &[PathBuf], hints: &OpenHints) -> bool {
        self.transfer == hints.transfer
            && all_paths(paths, hints, &mut Vec::new()).is_ok_and(|files| files == self.files)
    }

    /// What they may be, the likeliest first.
    pub fn proposals(&self) -> &[Proposal] {
        &self.detection.proposals
    }

    /// What was found, such as "PNG of 8 bits, 4096 x 3072".
    pub fn sentence(&self) -> String {
        let [width, height] = self.rasters.first().map(Raster::size).unwrap_or_default();
        let count = match (self.rasters.len(), self.files.len()) {
            (1, _) => String::new(),
            (count, 1) => format!("{count} faces of "),
            (count, _) => format!("{count} files, each "),
        };
        let depth = match self.stored {
            Stored::U8 => "8 bits",
            Stored::U16 => "16 bits",
            Stored::Half => "half floats",
            Stored::F32 => "floats",
            Stored::Rgbe => "RGBE",
            Stored::Rgb9e5 => "RGB9E5",
        };
        let says = match self.known {
            Known {
                envmap: Some(load::EnvmapKind::Latlong),
                ..
            } => "; it says that it is a latlong",
            Known {
                envmap: Some(load::EnvmapKind::Cube),
                ..
            } => "; it says that it is a cube",
            Known { is_cube: true, .. } => "; it says that it is a cube map",
            _ => "; it does not say what it is",
        };
        let format = self.format.name();
        format!("{format} of {depth}: {count}{width} × {height} texels{says}")
    }

    /// The path of the first file.
    pub(super) fn name(&self) -> String {
        self.files
            .first()
            .map(|path| path.display().to_string())
            .unwrap_or_default()
    }
}

/// The files that the paths stand for.
fn all_paths(
    paths: &[PathBuf],
    hints: &OpenHints,
    notes: &mut Vec<String>,
) -> Result<Vec<PathBuf>, LoadProblem> {
    let [path] = paths else {
        return Ok(paths.to_vec());
    };
    if hints.layout.is_some_and(|layout| layout != Layout::Faces) {
        return Ok(paths.to_vec());
    }
    let charts = hints.mapping.map(|mapping| mapping.info().charts);
    if charts.is_some_and(|charts| charts.len() == 1) {
        return Ok(paths.to_vec());
    }
    if let Some(charts) = charts.filter(|charts| charts.len() != 6) {
        return match of_charts(path, charts).map_err(LoadProblem::Io)? {
            Some(Ok(files)) => Ok(files),
            Some(Err(missing)) => Err(not_there(&charts.len().to_string(), &missing)),
            None => Ok(paths.to_vec()),
        };
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
        Named::Missing(names) if !names.is_empty() => Err(not_there("six", &names)),
        Named::Missing(_) => Err(LoadProblem::Unclear(
            "no six files have usual names of faces for `%f`; name them px nx py ny pz nz"
                .to_owned(),
        )),
    }
}

/// What is said of files that are missing for `%f`.
fn not_there(count: &str, names: &[String]) -> LoadProblem {
    LoadProblem::Unclear(format!(
        "of the {count} files for `%f` {} not there: {}; add what is missing",
        if names.len() == 1 {
            "one is"
        } else {
            "some are"
        },
        names.join(", ")
    ))
}

/// The pictures of some files, and what the first of them says.
struct Read {
    rasters: Vec<Raster>,
    format: Format,
    stored: Stored,
    known: Known,
}

fn read(
    paths: &[PathBuf],
    progress: &Progress,
    notes: &mut Vec<String>,
) -> Result<Read, LoadError> {
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
    let mut read = match load::open(first, progress)? {
        Opened::Raster(file) => Read {
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
            Read {
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
        let is_alike = read
            .rasters
            .first()
            .is_some_and(|first| is_alike(first, &file.raster));
        if !is_alike {
            let text = format!(
                "the faces differ: {} after {}; make them alike",
                kind(&file.raster),
                read.rasters.first().map(kind).unwrap_or_default()
            );
            return Err(refuse(path, text));
        }
        read.rasters.push(file.raster);
    }
    Ok(read)
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
