//! What `sixfold convert` is to do: its options, checked against each other before anything is read.

use super::ends::{
    FilesOut, Input, Output, check_together, files_out, frame, input, layout, refuse,
};
use super::error::ConvertError;
use super::options::ConvertOptions;
use crate::imaging::load::Format;
use crate::imaging::resample::{
    Conversion, Filter, chart_size, equal_height, equal_rows, rotation_of_viewer,
};
use crate::imaging::save::SaveOptions;
use crate::imaging::{Channels, EnvmapKind, MapShape, SampleKind, Siting, Stored, Transfer};
use crate::mapping::{Frame, Layout, MappingId};

/// A command line that makes sense.
#[derive(Debug)]
pub(super) struct Task {
    pub input: Input,
    pub output: Output,
    options: ConvertOptions,
    to_frame: Option<&'static Frame>,
}

/// How a map is made and stored.
#[derive(Debug)]
pub(super) struct Target {
    pub conversion: Conversion,
    pub save: SaveOptions,
}

impl Task {
    /// Checks the options.
    ///
    /// # Errors
    /// [`ConvertError::Usage`] for what makes no sense, other errors for names that cannot be used.
    pub fn new(options: &ConvertOptions) -> Result<Self, ConvertError> {
        check_together(options)?;
        let input = input(options)?;
        let output = match &options.output {
            None => Output::None,
            Some(_) if matches!(input, Input::Raw { .. }) => Output::Raw,
            Some(path) => Output::Files(files_out(options, path.clone())?),
        };
        let to_frame = options.to_frame.as_deref().map(frame).transpose()?;
        let task = Self {
            input,
            output,
            options: options.clone(),
            to_frame,
        };
        task.check_numbers()?;
        // What is known already is checked before a large file is read.
        if let (Some(mapping), false) = (options.to.or(options.from), options.inspect) {
            task.layout(mapping)?;
            task.charts(mapping)?;
        }
        Ok(task)
    }

    /// A film goes to a film.
    fn check_numbers(&self) -> Result<(), ConvertError> {
        let comes = matches!(&self.input, Input::Files { name, .. } if name.has_number());
        let (Output::Files(files), Some(path)) = (&self.output, &self.options.output) else {
            return match comes && matches!(self.output, Output::None) {
                true => refuse("--inspect looks at one map; name one frame"),
                false => Ok(()),
            };
        };
        match (comes, files.name.has_number()) {
            (true, false) => refuse(format!(
                "IN stands for many frames; put %04d into OUT too: {}",
                path.display()
            )),
            (false, true) => refuse(format!(
                "OUT stands for many frames, IN does not; leave the number out: {}",
                path.display()
            )),
            _ => Ok(()),
        }
    }

    /// Fails early when a file of a frame may not be written, as far as its names are known before the map is.
    ///
    /// # Errors
    /// As [`atomic::check_name`].
    pub fn check_free(&self, files: &FilesOut, frame: u64) -> Result<(), ConvertError> {
        let Some(mapping) = self.options.to.or(self.options.from) else {
            return Ok(());
        };
        let mut conversion = Conversion::new(mapping, [1, 1], &PLAIN_SHAPE);
        conversion.charts = self.charts(mapping)?;
        files.check(&files.paths(&conversion, frame))
    }

    /// How many times the resampling is timed.
    pub fn repeat(&self) -> u32 {
        self.options.repeat.unwrap_or(1)
    }

    /// Whether a report is wanted on standard output.
    pub fn json(&self) -> bool {
        self.options.json
    }

    /// Whether all levels are wanted.
    pub fn mips(&self) -> bool {
        self.options.mips
    }

    /// Texels around the horizon that the options ask for; `None`: as many as the source has.
    pub fn rows_of_latlong(&self) -> Option<u32> {
        let mapping = self.options.to.unwrap_or(MappingId::Latlong);
        let size = chart_size(mapping, self.options.size?);
        Some(equal_rows(MappingId::Latlong, mapping, size))
    }

    /// How a map of this shape is converted.
    ///
    /// # Errors
    /// When an option does not fit the mapping.
    pub fn target(&self, source: &MapShape, stored_in: Stored) -> Result<Target, ConvertError> {
        let options = &self.options;
        let mapping = options.to.unwrap_or(source.mapping);
        let height = options
            .size
            .unwrap_or_else(|| equal_height(mapping, source));
        let layout = self.layout(mapping)?;
        let mut conversion = Conversion::new(mapping, chart_size(mapping, height), source);
        conversion.layout = layout;
        conversion.charts = self.charts(mapping)?;
        conversion.rotation = rotation_of_viewer(options.rotate.unwrap_or_default());
        conversion.frame = match self.to_frame {
            None if options.envmap => Some(frame("openexr")?),
            frame => frame,
        };
        conversion.siting = match (options.samples, conversion.frame) {
            (Some(at), _) => at.into(),
            (None, Some(frame)) if frame.is_edge_sited => Siting::Edge,
            _ => Siting::Centre,
        };
        conversion.filter = match (options.filter, options.supersample) {
            (Some(filter), _) => Some(filter.0),
            // Places within a texel take the place of its footprint.
            (None, Some(_)) => Some(Filter::Bicubic),
            (None, None) => None,
        };
        conversion.supersample = options.supersample.unwrap_or(1);
        conversion.filtered_in = options.transfer.into();
        conversion.exposure_ev = options.exposure;
        conversion.threads = options.threads.unwrap_or(0) as usize;
        conversion.isa = options.isa.map(super::options::IsaName::isa);
        let mut save = SaveOptions {
            zstd: options.zstd,
            envmap: self.envmap(mapping, layout)?,
            ..SaveOptions::default()
        };
        if let Some(quality) = options.quality {
            save.jpeg_quality = quality;
        }
        if let Output::Files(files) = &self.output {
            let stored = self.stored(files.format, stored_in)?;
            save.stored = Some(stored);
            conversion.samples = stored.kind();
            conversion.transfer = match stored.kind() {
                SampleKind::F32 => Transfer::Linear,
                SampleKind::U8 | SampleKind::U16 => Transfer::Srgb,
            };
            if matches!(files.format, Format::Hdr | Format::Jpeg) || stored == Stored::Rgb9e5 {
                conversion.channels = Channels::Rgb;
            }
        }
        if options.dither && conversion.samples == SampleKind::F32 {
            return refuse(
                "floating numbers have no steps that noise could hide; leave --dither out",
            );
        }
        conversion.dither = options.dither;
        Ok(Target { conversion, save })
    }

    /// How the charts of the result lie.
    fn layout(&self, mapping: MappingId) -> Result<Layout, ConvertError> {
        let files = match &self.output {
            Output::Files(files) => Some(files),
            _ => None,
        };
        let has_face = files.is_some_and(|files| files.name.has_face());
        let holds_faces = files.is_some_and(|files| files.format.is_container());
        let count = mapping.info().chart_count();
        if has_face && count == 1 {
            return refuse(format!(
                "`{mapping}` has one chart; leave %f out of the name"
            ));
        }
        let Some(word) = self.options.layout.as_deref() else {
            return Ok(match self.to_frame.and_then(|frame| frame.cube) {
                _ if has_face || (holds_faces && count == 6) => Layout::Faces,
                Some(cube) if count == 6 && cube.layout != Layout::Faces => cube.layout,
                _ if count == 6 && self.options.envmap => Layout::Column,
                _ => mapping.info().layout,
            });
        };
        let layout = layout(word, mapping)?;
        match (layout == Layout::Faces, files) {
            (true, None) => {
                refuse("a raw frame is one picture; choose another --layout than faces")
            }
            (false, Some(_)) if has_face => refuse(format!(
                "%f stands for a file of each face, which `{word}` is not; leave --layout or %f out"
            )),
            (false, Some(files)) if holds_faces && count == 6 => refuse(format!(
                "{} holds six faces by itself; leave --layout out",
                files.format.name()
            )),
            (true, Some(_)) if !has_face && count > 1 && !(holds_faces && count == 6) => {
                refuse("`faces` is a file for each face; put %f where its name shall stand in OUT")
            }
            _ => Ok(layout),
        }
    }

    /// The charts that are wanted, a bit each.
    fn charts(&self, mapping: MappingId) -> Result<u32, ConvertError> {
        let names = mapping.info().charts;
        if let Output::Files(files) = &self.output
            && !files.face_names.is_empty()
            && files.face_names.len() != names.len()
        {
            return refuse(format!(
                "{} names for the {} charts of `{mapping}`; --face-names takes one for each: {}",
                files.face_names.len(),
                names.len(),
                names.join(",")
            ));
        }
        if self.options.faces.is_empty() {
            return Ok(u32::MAX);
        }
        let mut charts = 0;
        for wanted in &self.options.faces {
            let chart = names.iter().position(|name| name == wanted);
            let chart = chart.ok_or_else(|| {
                ConvertError::usage(format!(
                    "`{mapping}` has no chart `{wanted}`; it has: {}",
                    names.join(",")
                ))
            })?;
            charts |= 1 << chart;
        }
        Ok(charts)
    }

    /// OpenEXR's attribute.
    fn envmap(
        &self,
        mapping: MappingId,
        layout: Layout,
    ) -> Result<Option<EnvmapKind>, ConvertError> {
        match (self.options.envmap, mapping, layout) {
            (false, ..) => Ok(None),
            (true, MappingId::Latlong, _) => Ok(Some(EnvmapKind::Latlong)),
            (true, MappingId::Cube, Layout::Column) => Ok(Some(EnvmapKind::Cube)),
            _ => refuse(
                "--envmap marks a latlong, or a cube in a column; choose --to latlong, or --to cube --layout column",
            ),
        }
    }

    /// How samples are stored: as exactly as they came, as far as the format can.
    fn stored(&self, format: Format, source: Stored) -> Result<Stored, ConvertError> {
        use Stored::{F32, Half, Rgb9e5, Rgbe, U8, U16};
        let possible: &[Stored] = match format {
            Format::Png => &[U8, U16],
            Format::Jpeg => &[U8],
            Format::Hdr => &[Rgbe],
            Format::Exr => &[Half, F32],
            Format::Ktx2 | Format::Dds => &[U8, Half, F32, Rgb9e5],
        };
        if let Some(depth) = self.options.depth {
            let stored = depth.stored();
            return if possible.contains(&stored) {
                Ok(stored)
            } else {
                refuse(format!(
                    "{} does not store samples so; leave --depth out, or choose {}",
                    format.name(),
                    match format {
                        Format::Png => "8 or 16",
                        Format::Jpeg => "8",
                        Format::Hdr => "another format",
                        Format::Exr => "half or float",
                        Format::Ktx2 | Format::Dds => "8, half, float or rgb9e5",
                    }
                ))
            };
        }
        if possible.contains(&source) {
            return Ok(source);
        }
        // The eight bits of a Radiance mantissa and of a code fit into a half's eleven; sixteen bits do not.
        let wished: &[Stored] = match source {
            U8 | Rgbe | Rgb9e5 | Half => &[Half, U16],
            U16 | F32 => &[F32, U16],
        };
        let best = wished.iter().find(|stored| possible.contains(stored));
        Ok(*best.unwrap_or(&possible[0]))
    }
}

/// The smallest map; stands in where a shape is needed for its mapping alone.
const PLAIN_SHAPE: MapShape = MapShape {
    mapping: MappingId::Latlong,
    size: [2, 1],
    charts: Vec::new(),
    world_from_map: crate::mapping::Axes::IDENTITY,
    siting: Siting::Centre,
    channels: Channels::Rgb,
    samples: SampleKind::F32,
    transfer: Transfer::Linear,
};
