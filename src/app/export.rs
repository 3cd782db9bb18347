//! The environment into a file that another program loads: what is wanted of it, how large it gets, and the making of it.

use std::path::{Path, PathBuf};

use crate::imaging::load::{EnvmapKind, Format};
use crate::imaging::resample::{Conversion, chart_size, levels, resample};
use crate::imaging::save::{Content, SaveOptions, save};
use crate::imaging::{
    Channels, Container, EnvironmentMap, Image, OpenHints, Progress, SampleKind, Stored, Transfer,
};
use crate::mapping::{Frame, Layout, MappingId};
use crate::math::Rotation;

/// What stands in the name of six files for the name of each.
pub const FACE: &str = "%f";
/// The six names, in the order of the pictures.
const FACE_NAMES: [&str; 6] = ["px", "nx", "py", "ny", "pz", "nz"];

/// A program, and the file that it likes best.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// The program's name.
    pub name: &'static str,
    frame: &'static str,
    mapping: MappingId,
    format: Format,
    stored: Stored,
    has_levels: bool,
}

impl Preset {
    /// Every program, by name.
    pub const ALL: [Self; 6] = [
        Self::latlong("Blender", "blender", Format::Exr, Stored::Half),
        // Bevy's skybox and environment maps are cube textures with levels.
        Self {
            name: "Bevy",
            frame: "bevy",
            mapping: MappingId::Cube,
            format: Format::Ktx2,
            stored: Stored::Half,
            has_levels: true,
        },
        Self::latlong("Godot", "godot", Format::Exr, Stored::Half),
        Self::latlong("three.js", "threejs", Format::Hdr, Stored::Rgbe),
        Self::latlong("Unity", "unity", Format::Exr, Stored::Half),
        // Its importer takes latlong pictures as cube textures from HDR alone.
        Self::latlong("Unreal Engine", "unreal", Format::Hdr, Stored::Rgbe),
    ];

    const fn latlong(
        name: &'static str,
        frame: &'static str,
        format: Format,
        stored: Stored,
    ) -> Self {
        Self {
            name,
            frame,
            mapping: MappingId::Latlong,
            format,
            stored,
            has_levels: false,
        }
    }
}

/// What is wanted.
#[derive(Clone, Debug, PartialEq)]
pub struct Export {
    /// The mapping.
    pub mapping: MappingId,
    /// The program whose axes it has, by id; `None`: ours.
    pub frame: Option<&'static str>,
    /// How the charts lie; a picture for each: six files, or the faces of a container.
    pub layout: Layout,
    /// The file.
    pub format: Format,
    /// How it stores a sample.
    pub stored: Stored,
    /// Rows of a chart.
    pub height: u32,
    /// All smaller levels too.
    pub has_levels: bool,
    /// Levels are compressed.
    pub zstd: bool,
    /// How the environment is turned.
    pub rotation: Rotation,
    /// The file's path; of six files, with [`FACE`] in its name.
    pub path: String,
    /// Replace what is there.
    pub force: bool,
}

impl Default for Export {
    fn default() -> Self {
        Self {
            mapping: MappingId::Cube,
            frame: None,
            layout: Layout::Cross,
            format: Format::Exr,
            stored: Stored::Half,
            height: 512,
            has_levels: false,
            zstd: false,
            rotation: Rotation::NONE,
            path: "environment.exr".to_owned(),
            force: false,
        }
    }
}

/// Every format that is written, with the ending of its names.
pub const FORMATS: [(Format, &str); 6] = [
    (Format::Exr, "exr"),
    (Format::Hdr, "hdr"),
    (Format::Ktx2, "ktx2"),
    (Format::Dds, "dds"),
    (Format::Png, "png"),
    (Format::Jpeg, "jpg"),
];

/// How a format can store samples, the best for light first.
pub const fn kinds(format: Format) -> &'static [Stored] {
    match format {
        Format::Hdr => &[Stored::Rgbe],
        Format::Exr => &[Stored::Half, Stored::F32],
        Format::Png => &[Stored::U16, Stored::U8],
        Format::Jpeg => &[Stored::U8],
        Format::Ktx2 | Format::Dds => &[Stored::Half, Stored::F32, Stored::Rgb9e5, Stored::U8],
    }
}

/// The name of a kind of samples: for people, and after `--depth`.
pub const fn kind_names(stored: Stored) -> (&'static str, Option<&'static str>) {
    match stored {
        Stored::U8 => ("8 bits", Some("8")),
        Stored::U16 => ("16 bits", Some("16")),
        Stored::Half => ("half float", Some("half")),
        Stored::F32 => ("float", Some("float")),
        Stored::Rgbe => ("RGBE", None),
        Stored::Rgb9e5 => ("RGB9E5", Some("rgb9e5")),
    }
}

impl Export {
    /// Everything as the program likes it; size, turn and place stay.
    pub fn set_preset(&mut self, preset: &Preset) {
        self.mapping = preset.mapping;
        self.frame = Some(preset.frame);
        self.layout = if preset.format.is_container() {
            Layout::Faces
        } else {
            preset.mapping.info().layout
        };
        self.format = preset.format;
        self.stored = preset.stored;
        self.has_levels = preset.has_levels;
        self.mend();
    }

    /// Brings together what does not go together: the layout has the mapping's charts, the format holds the samples, the
    /// name ends as the format's do.
    pub fn mend(&mut self) {
        let charts = self.mapping.info().chart_count();
        let is_container = self.format.is_container();
        let fits = self.layout.holds(charts) && (charts > 1 || self.layout != Layout::Faces);
        if is_container && charts == 6 {
            self.layout = Layout::Faces;
        } else if !fits || (is_container && self.layout == Layout::Faces) {
            self.layout = self.mapping.info().layout;
        }
        if !kinds(self.format).contains(&self.stored) {
            self.stored = kinds(self.format)[0];
        }
        self.has_levels &= is_container;
        self.zstd &= self.format == Format::Ktx2;
        let known = |id: &&str| Frame::from_id(id).is_ok_and(|frame| frame.knows(self.mapping));
        self.frame = self.frame.filter(known);
        if let Some((_, ending)) = FORMATS.iter().find(|(format, _)| *format == self.format) {
            let mut stem = Path::new(&self.path)
                .with_extension("")
                .display()
                .to_string();
            stem = match (self.is_six_files(), stem.contains(FACE)) {
                (true, false) => format!("{stem}_{FACE}"),
                (false, true) => stem.replace(&format!("_{FACE}"), "").replace(FACE, ""),
                _ => stem,
            };
            self.path = format!("{stem}.{ending}");
        }
    }

    /// A file for each chart.
    pub fn is_six_files(&self) -> bool {
        self.layout == Layout::Faces && !self.format.is_container()
    }

    /// Texels of all charts, levels included.
    pub fn texels(&self) -> u64 {
        let [width, height] = chart_size(self.mapping, self.height);
        let [columns, rows] = self.layout.grid();
        let cells = match self.layout {
            Layout::Faces => u64::from(self.mapping.info().chart_count()),
            _ => u64::from(columns) * u64::from(rows),
        };
        let one = u64::from(width) * u64::from(height) * cells;
        // Each level has a quarter of the one before.
        if self.has_levels { one * 4 / 3 } else { one }
    }

    /// Bytes before compression; containers have a fourth sample beside floats and bytes.
    pub fn bytes(&self) -> u64 {
        let samples = if self.format.is_container() { 4 } else { 3 };
        self.texels()
            * match self.stored {
                Stored::U8 => samples,
                Stored::U16 | Stored::Half => 2 * samples,
                Stored::F32 => 4 * samples,
                Stored::Rgbe | Stored::Rgb9e5 => 4,
            }
    }

    /// Whether the file may come out smaller than its samples.
    pub fn is_compressed(&self) -> bool {
        self.zstd || !self.format.is_container()
    }

    /// The words of the equal command line; `input` is the environment's id, `hints` how it is read.
    pub fn command_line(&self, input: &str, hints: &OpenHints) -> String {
        let mut words = vec![
            "sixfold".to_owned(),
            "convert".to_owned(),
            quoted(input),
            quoted(&self.path),
        ];
        let mut add = |name: &str, value: Option<&str>| {
            words.push(name.to_owned());
            words.extend(value.map(quoted));
        };
        for (name, value) in hints.options() {
            add(name, value.as_deref());
        }
        add("--to", Some(self.mapping.info().id));
        add("--size", Some(&self.height.to_string()));
        if self.layout != Layout::Faces {
            add("--layout", Some(self.layout.id()));
        }
        if let Some(frame) = self.frame {
            add("--to-frame", Some(frame));
        }
        if !self.rotation.is_none() {
            add("--rotate", Some(&self.rotation.to_string()));
        }
        if let Some(depth) = kind_names(self.stored).1 {
            add("--depth", Some(depth));
        }
        for (name, is_wanted) in [
            ("--mips", self.has_levels),
            ("--zstd", self.zstd),
            ("--force", self.force),
        ] {
            if is_wanted {
                add(name, None);
            }
        }
        words.join(" ")
    }

    fn conversion(&self, source: &EnvironmentMap) -> Result<Conversion, String> {
        let size = chart_size(self.mapping, self.height);
        let samples = self.stored.kind();
        let frame = self.frame.map(Frame::from_id).transpose();
        Ok(Conversion {
            layout: self.layout,
            rotation: self.rotation.source_from_world(),
            frame: frame.map_err(|error| error.to_string())?,
            samples,
            transfer: match samples {
                SampleKind::F32 => Transfer::Linear,
                SampleKind::U8 | SampleKind::U16 => Transfer::Srgb,
            },
            channels: Channels::Rgb,
            ..Conversion::new(self.mapping, size, source.shape())
        })
    }

    /// Converts the latlong picture and writes the file, or the six files.
    ///
    /// # Errors
    /// One line that says what failed; the file is not there then, unless it was before.
    pub fn write(&self, image: &Image, progress: &Progress) -> Result<(), String> {
        let said = |error: &dyn std::fmt::Display| error.to_string();
        let source = EnvironmentMap::of_latlong(image).map_err(|e| said(&e))?;
        let conversion = self.conversion(&source)?;
        let (map, _) = resample(&source, &conversion, progress).map_err(|e| said(&e))?;
        drop(source);
        let options = SaveOptions {
            stored: Some(self.stored),
            zstd: self.zstd,
            envmap: (self.format == Format::Exr && self.mapping == MappingId::Latlong)
                .then_some(EnvmapKind::Latlong)
                .filter(|_| self.frame == Some("openexr")),
            ..SaveOptions::default()
        };
        let put = |path: &Path, content: Content<'_>| {
            save(path, self.force, content, self.format, &options, progress).map_err(|e| said(&e))
        };
        if self.format.is_container() {
            let maps = if self.has_levels {
                levels(map, &conversion, progress).map_err(|e| said(&e))?
            } else {
                vec![map]
            };
            let container = Container::of_maps(maps, self.stored, self.format);
            return put(Path::new(&self.path), Content::Container(&container));
        }
        for (raster, path) in map.rasters().iter().zip(self.paths()) {
            put(&path, Content::Raster(raster))?;
        }
        Ok(())
    }

    /// The files that are written.
    pub fn paths(&self) -> Vec<PathBuf> {
        if self.is_six_files() {
            let count = self.mapping.info().chart_count() as usize;
            let names = FACE_NAMES.iter().take(count);
            names
                .map(|name| PathBuf::from(self.path.replace(FACE, name)))
                .collect()
        } else {
            vec![PathBuf::from(&self.path)]
        }
    }
}

/// A word as a shell reads it.
pub(super) fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./,%+:=".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_go_together_and_say_the_equal_line() {
        for preset in &Preset::ALL {
            let mut export = Export::default();
            export.set_preset(preset);
            let before = export.clone();
            export.mend();
            assert_eq!(export, before, "{}", preset.name);
            assert_eq!(export.frame, Some(preset.frame), "{}", preset.name);
            assert!(kinds(export.format).contains(&export.stored));
        }
        let mut bevy = Export::default();
        bevy.set_preset(&Preset::ALL[1]);
        bevy.rotation = Rotation::from_degrees([90.0, 0.0, -15.0]);
        assert_eq!(
            bevy.command_line("my sky.hdr", &OpenHints::default()),
            "sixfold convert 'my sky.hdr' environment.ktx2 --to cube --size 512 --to-frame bevy --rotate 90,0,-15 \
             --depth half --mips"
        );
        // 512 x 512 x 6 of 8 bytes, and a third more.
        assert_eq!(bevy.bytes(), 512 * 512 * 6 * 4 / 3 * 8);
    }

    #[test]
    fn six_files_have_their_names_and_one_file_has_none() {
        let mut six = Export {
            layout: Layout::Faces,
            ..Export::default()
        };
        six.mend();
        assert_eq!(six.path, "environment_%f.exr");
        assert_eq!(six.paths()[3], Path::new("environment_ny.exr"));
        six.mapping = MappingId::Latlong;
        six.mend();
        assert_eq!(
            (six.layout, six.path.as_str()),
            (Layout::Single, "environment.exr")
        );
    }
}
