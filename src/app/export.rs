//! The environment into a file that another program loads: what is wanted of it, and how large it gets.

mod make;

use std::path::{Path, PathBuf};

use crate::imaging::load::{EnvmapKind, Format};
use crate::imaging::resample::{Filter, chart_size, equal_rows};
use crate::imaging::{OpenHints, SampleKind, Stored, face_name};
use crate::mapping::{Frame, Layout, MappingId};
use crate::math::Rotation;

/// Rows that a chart may have: a float cube of it still fits into the memory of a plain machine.
pub const MOST_ROWS: u32 = 8192;

/// What stands in the name of six files for the name of each.
pub const FACE: &str = "%f";

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
    /// The rows follow the environment: [`Export::follow`].
    pub as_fine: bool,
    /// All smaller levels too.
    pub has_levels: bool,
    /// Levels are compressed.
    pub zstd: bool,
    /// How values between texels are found; `None`: the one that suits, as
    /// [`Conversion::filter`](crate::imaging::resample::Conversion::filter).
    pub filter: Option<Filter>,
    /// Noise of one step hides steps; for whole numbers only.
    pub dither: bool,
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
            as_fine: true,
            has_levels: false,
            zstd: false,
            filter: None,
            dither: false,
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
        self.dither &= self.can_dither();
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

    /// Takes over from the scene what belongs to it: the turn, and as many texels around the horizon as its latlong picture
    /// of `size` has, unless the rows were chosen.
    pub fn follow(&mut self, rotation: Rotation, size: Option<[u32; 2]>) {
        self.rotation = rotation;
        if let Some(size) = size.filter(|_| self.as_fine) {
            self.height = equal_rows(self.mapping, MappingId::Latlong, size).clamp(1, MOST_ROWS);
        }
    }

    /// Whether samples are whole numbers, whose steps noise can hide.
    pub fn can_dither(&self) -> bool {
        self.stored.kind() != SampleKind::F32
    }

    /// What OpenEXR's attribute says of the file, where it says anything: that its axes are OpenEXR's.
    fn envmap(&self) -> Option<EnvmapKind> {
        if self.format != Format::Exr || self.frame != Some("openexr") {
            return None;
        }
        match (self.mapping, self.layout) {
            (MappingId::Latlong, _) => Some(EnvmapKind::Latlong),
            (MappingId::Cube, Layout::Column) => Some(EnvmapKind::Cube),
            _ => None,
        }
    }

    /// A file for each chart.
    pub fn is_six_files(&self) -> bool {
        self.layout == Layout::Faces && !self.format.is_container()
    }

    /// Texels of all charts, levels included.
    pub fn texels(&self) -> u64 {
        let [width, height] = self.size();
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
        if let Some(filter) = self.filter {
            add("--filter", Some(filter.id()));
        }
        if let Some(depth) = kind_names(self.stored).1 {
            add("--depth", Some(depth));
        }
        for (name, is_wanted) in [
            ("--dither", self.dither),
            ("--mips", self.has_levels),
            ("--zstd", self.zstd),
            ("--envmap", self.envmap().is_some()),
            ("--force", self.force),
        ] {
            if is_wanted {
                add(name, None);
            }
        }
        words.join(" ")
    }

    /// Texels of a chart.
    fn size(&self) -> [u32; 2] {
        chart_size(self.mapping, self.height)
    }

    /// The files that are written.
    pub fn paths(&self) -> Vec<PathBuf> {
        if self.is_six_files() {
            let charts = self.mapping.info().charts.iter();
            let path = Path::new(&self.path);
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            charts
                .map(|chart| path.with_file_name(name.replace(FACE, &face_name(chart))))
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
        let hints = OpenHints {
            mapping: Some(MappingId::Octahedral),
            ..OpenHints::default()
        };
        let line = bevy.command_line("sky.exr", &hints);
        assert!(
            line.contains("environment.ktx2 --from octahedral --to cube"),
            "{line}"
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
