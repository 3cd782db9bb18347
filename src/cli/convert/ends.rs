//! Both ends of `sixfold convert`: where maps come from and where they go, as the options name them.

use std::path::PathBuf;

use super::error::ConvertError;
use super::names::Name;
use super::options::ConvertOptions;
use super::raw::RawFrames;
use crate::imaging::load::Format;
use crate::imaging::resample::{Conversion, Filter};
use crate::imaging::save::format_of_path;
use crate::imaging::{Environment, OpenHints, Siting, Transfer, atomic, face_name};
use crate::mapping::{Frame, Layout, MappingId};

/// Where maps come from.
#[derive(Debug)]
pub(super) enum Input {
    /// A file, six files or the frames of a film.
    Files { name: Name, hints: OpenHints },
    /// What the program has with it.
    BuiltIn(Environment),
    /// Standard input.
    Raw {
        frames: RawFrames,
        mapping: MappingId,
        hints: OpenHints,
    },
}

/// Where they go.
#[derive(Debug)]
pub(super) enum Output {
    Files(FilesOut),
    /// Standard output.
    Raw,
    /// Nowhere: the input is only looked at.
    None,
}

/// Files of one format.
#[derive(Clone, Debug)]
pub(super) struct FilesOut {
    pub name: Name,
    pub format: Format,
    /// Names for `%f`, one for each chart; empty: the usual ones.
    pub face_names: Vec<String>,
    pub force: bool,
}

impl FilesOut {
    /// The files of a frame, one for each picture of the conversion.
    pub fn paths(&self, conversion: &Conversion, frame: u64) -> Vec<PathBuf> {
        if !self.name.has_face() {
            return vec![self.name.file("", frame)];
        }
        let charts = conversion.mapping.info().charts.iter().enumerate();
        charts
            .filter(|(chart, _)| conversion.charts & (1 << chart) != 0)
            .map(|(chart, name)| match self.face_names.get(chart) {
                Some(name) => self.name.file(name, frame),
                None => self.name.file(&face_name(name), frame),
            })
            .collect()
    }

    /// Fails when a file may not be written, before the work whose result could not be kept.
    ///
    /// # Errors
    /// As [`atomic::check_name`].
    pub fn check(&self, paths: &[PathBuf]) -> Result<(), ConvertError> {
        for path in paths {
            atomic::check_name(path, self.force)?;
        }
        Ok(())
    }
}

/// Says what is wrong with the command line.
pub(super) fn refuse<T>(line: impl Into<String>) -> Result<T, ConvertError> {
    Err(ConvertError::Usage(line.into()))
}

/// The frame of this name.
pub(super) fn frame(id: &str) -> Result<&'static Frame, ConvertError> {
    Frame::from_id(id).map_err(|error| ConvertError::usage(error.to_string()))
}

/// The layout of this name.
pub(super) fn layout(word: &str, mapping: MappingId) -> Result<Layout, ConvertError> {
    let count = mapping.info().chart_count();
    Layout::from_id(word, count).ok_or_else(|| {
        let held = Layout::ALL.into_iter().filter(|layout| layout.holds(count));
        let names: Vec<&str> = held.map(Layout::id).collect();
        ConvertError::usage(format!(
            "`{mapping}` has no layout `{word}`; it has: {}",
            names.join(", ")
        ))
    })
}

/// What cannot be asked for at once, whatever the map is.
pub(super) fn check_together(options: &ConvertOptions) -> Result<(), ConvertError> {
    let is_pipe = |path: &std::path::Path| path.as_os_str() == "-";
    let pipes =
        [Some(&options.input), options.output.as_ref()].map(|p| p.is_some_and(|p| is_pipe(p)));
    if options.raw.is_none() && pipes.contains(&true) {
        return refuse("`-` needs --raw FORMAT WxH, which says what the frames in the pipe are");
    }
    if options.raw.is_some() && pipes != [true, true] {
        return refuse(
            "--raw reads standard input and writes standard output; give `- -` for IN and OUT",
        );
    }
    if options.raw.is_some() && options.from.is_none() {
        return refuse("a raw frame does not tell what map it is; name it with --from MAP");
    }
    if options.from_frame.is_some() && options.arrange.is_some() {
        return refuse("--from-frame and --arrange both say which face is which; leave one out");
    }
    if options.to_frame.is_some()
        && options.envmap
        && options.to_frame.as_deref() != Some("openexr")
    {
        return refuse("--envmap promises OpenEXR's axes; leave --to-frame out");
    }
    let is_area = options
        .filter
        .is_some_and(|filter| filter.0 == Filter::Area);
    if is_area && options.supersample.is_some_and(|count| count > 1) {
        return refuse("`area` covers the whole texel already; leave --supersample out");
    }
    let shapes_output = [
        (options.to.is_some(), "--to"),
        (options.size.is_some(), "--size"),
        (options.layout.is_some(), "--layout"),
        (!options.faces.is_empty(), "--faces"),
        (options.to_frame.is_some(), "--to-frame"),
        (options.rotate.is_some(), "--rotate"),
        (options.samples.is_some(), "--samples"),
        (options.filter.is_some(), "--filter"),
        (options.supersample.is_some(), "--supersample"),
        (options.repeat.is_some(), "--repeat"),
        (options.isa.is_some(), "--isa"),
        (options.dither, "--dither"),
    ];
    let files_only = [
        (!options.face_names.is_empty(), "--face-names"),
        (options.depth.is_some(), "--depth"),
        (options.mips, "--mips"),
        (options.zstd, "--zstd"),
        (options.quality.is_some(), "--quality"),
        (options.envmap, "--envmap"),
        (options.force, "--force"),
        (options.json, "--json"),
    ];
    let first = |list: &[(bool, &'static str)]| {
        list.iter().find(|(given, _)| *given).map(|(_, name)| *name)
    };
    if options.inspect {
        let useless = first(&shapes_output).or_else(|| first(&files_only));
        return useless.map_or(Ok(()), |name| {
            refuse(format!("--inspect converts nothing; leave {name} out"))
        });
    }
    if options.raw.is_some() {
        let repeat = options.repeat.map(|_| "--repeat");
        return first(&files_only).or(repeat).map_or(Ok(()), |name| {
            refuse(format!(
                "a pipe of raw frames has no use for {name}; leave it out"
            ))
        });
    }
    Ok(())
}

/// Where IN comes from and how it is read.
pub(super) fn input(options: &ConvertOptions) -> Result<Input, ConvertError> {
    let arrange = options.arrange.as_deref().map(str::parse).transpose();
    let mut hints = OpenHints {
        mapping: options.from,
        layout: None,
        frame: options.from_frame.as_deref().map(frame).transpose()?,
        arrange: arrange.map_err(|error| ConvertError::usage(format!("{error}")))?,
        mirrored: options.from_mirrored,
        siting: options.from_samples.map(Siting::from),
        transfer: options.from_transfer.map(Transfer::from),
    };
    if let Some(word) = options.from_layout.as_deref() {
        let Some(mapping) = options.from else {
            return refuse("--from-layout needs the mapping too; name it with --from MAP");
        };
        hints.layout = Some(layout(word, mapping)?);
    }
    if let (Some(mapping), Some(_)) = (options.from, &hints.arrange)
        && mapping.info().chart_count() != 6
    {
        return refuse(format!(
            "--arrange is for six faces, which `{mapping}` has not; leave it out"
        ));
    }
    if let (Some(words), Some(mapping)) = (&options.raw, options.from) {
        if hints.transfer.is_some() {
            return refuse("a raw format says what its numbers are; leave --from-transfer out");
        }
        let frames = RawFrames::parse(words).map_err(ConvertError::Usage)?;
        if hints.layout == Some(Layout::Faces) {
            return refuse("a raw frame is one picture; choose another --from-layout than faces");
        }
        return Ok(Input::Raw {
            frames,
            mapping,
            hints,
        });
    }
    // A file of that name comes first.
    if let Some(environment) = built_in(options) {
        let said = [
            (
                options.from.is_some_and(|from| from != MappingId::Latlong),
                "--from",
            ),
            (options.from_frame.is_some(), "--from-frame"),
            (options.arrange.is_some(), "--arrange"),
            (options.from_mirrored, "--from-mirrored"),
            (options.from_samples.is_some(), "--from-samples"),
            (options.from_transfer.is_some(), "--from-transfer"),
        ];
        return match said.iter().find(|(given, _)| *given) {
            Some((_, name)) => refuse(format!(
                "`{}` is built in, a latlong in our axes; leave {name} out",
                environment.id()
            )),
            None => Ok(Input::BuiltIn(environment)),
        };
    }
    let is_bare = options.input.components().count() == 1 && options.input.extension().is_none();
    if is_bare && !options.input.exists() {
        let built_in = Environment::ALL_BUILT_IN.map(|environment| environment.id());
        return refuse(format!(
            "neither a file nor a built-in environment is called `{}`; built in are: {}",
            options.input.display(),
            built_in.join(", ")
        ));
    }
    Ok(Input::Files {
        name: Name::new(&options.input),
        hints,
    })
}

/// The built-in environment that IN names, when no file has its name.
fn built_in(options: &ConvertOptions) -> Option<Environment> {
    let id = options.input.to_str().filter(|_| !options.input.exists())?;
    let mut all = Environment::ALL_BUILT_IN.into_iter();
    all.find(|environment| environment.id() == id)
}

/// The files that OUT stands for.
pub(super) fn files_out(options: &ConvertOptions, path: PathBuf) -> Result<FilesOut, ConvertError> {
    let format = format_of_path(&path).map_err(|error| ConvertError::usage(error.to_string()))?;
    let name = Name::new(&path);
    let misplaced = [
        (
            options.mips && !format.is_container(),
            "--mips",
            ".ktx2 or .dds",
        ),
        (options.zstd && format != Format::Ktx2, "--zstd", ".ktx2"),
        (
            options.quality.is_some() && format != Format::Jpeg,
            "--quality",
            ".jpg",
        ),
        (options.envmap && format != Format::Exr, "--envmap", ".exr"),
    ];
    if let Some((_, option, ending)) = misplaced.iter().find(|(is_so, ..)| *is_so) {
        return refuse(format!(
            "{option} is for {ending}, not for {}; leave it out",
            format.name()
        ));
    }
    if !options.face_names.is_empty() && !name.has_face() {
        return refuse("--face-names are put in for %f, which is not in OUT");
    }
    let face_names = options.face_names.clone();
    let usable = |name: &String| !name.is_empty() && !name.contains(['/', '\\']);
    let doubled = |(at, name): (usize, &String)| face_names[..at].contains(name);
    if !face_names.iter().all(usable) || face_names.iter().enumerate().any(doubled) {
        return refuse("--face-names must differ, and none may be empty or hold a slash");
    }
    if !options.faces.is_empty() && format.is_container() {
        return refuse(format!(
            "{} holds all faces or none; leave --faces out, or write one file a face",
            format.name()
        ));
    }
    if name.has_face() && format.is_container() {
        return refuse(format!(
            "{} holds six faces by itself; leave %f out",
            format.name()
        ));
    }
    Ok(FilesOut {
        name,
        format,
        face_names,
        force: options.force,
    })
}
