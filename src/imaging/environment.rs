//! What can be shown: embedded photographs, computed patterns, files.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::computed::{self, Pattern};
use super::file::short_name;
use super::load::{self, Format, LoadError, LoadProblem, Loaded};
use super::{EnvironmentMap, MapFile, OpenHints, Pictures, Progress, Stored, open_map};

/// The colours of the six faces +x -x +y -y +z -z as sRGB: three hues of the palette that Okabe and Ito chose for every kind
/// of colour vision, one pair a hue family, the positive face darker than the negative one.
pub const FACE_COLORS: [[u8; 3]; 6] = [
    [0xd5, 0x5e, 0x00], // vermilion
    [0xe6, 0x9f, 0x00], // orange
    [0x00, 0x9e, 0x73], // bluish green
    [0xf0, 0xe4, 0x42], // yellow
    [0x00, 0x72, 0xb2], // blue
    [0x56, 0xb4, 0xe9], // sky blue
];

/// The surroundings that every map stores.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Environment {
    /// Photograph of a covered yard: straight lines and things to recognise in every direction.
    #[default]
    Courtyard,
    /// Photograph of a quay with the sun low over the water.
    Sunset,
    /// Six coloured faces with names and arrows.
    LabelledFaces,
    /// Meridians and parallels.
    Graticule,
    /// The direction as colour.
    #[serde(rename = "direction-colour")] // as [`Environment::id`]
    DirectionColor,
    /// Icosahedron and dodecahedron.
    IcosahedronCrosses,
    /// A map on disk, of any mapping and layout.
    File(MapFile),
}

impl Environment {
    /// Everything but files, in the order of the menu.
    pub const ALL_BUILT_IN: [Self; 6] = [
        Self::Courtyard,
        Self::Sunset,
        Self::LabelledFaces,
        Self::Graticule,
        Self::DirectionColor,
        Self::IcosahedronCrosses,
    ];

    /// What the menu says: a file's own name without its folders.
    pub fn name(&self) -> String {
        match self {
            Self::Courtyard => "Courtyard".to_owned(),
            Self::Sunset => "Sunset".to_owned(),
            Self::LabelledFaces => "Labelled faces".to_owned(),
            Self::Graticule => "Graticule".to_owned(),
            Self::DirectionColor => "Direction as colour".to_owned(),
            Self::IcosahedronCrosses => "Icosahedron crosses".to_owned(),
            Self::File(file) => short_name(&file.path),
        }
    }

    /// The name on the command line and in scenes, kebab-case; for a file its path.
    pub fn id(&self) -> String {
        match self {
            Self::Courtyard => "courtyard".to_owned(),
            Self::Sunset => "sunset".to_owned(),
            Self::LabelledFaces => "labelled-faces".to_owned(),
            Self::Graticule => "graticule".to_owned(),
            Self::DirectionColor => "direction-colour".to_owned(),
            Self::IcosahedronCrosses => "icosahedron-crosses".to_owned(),
            Self::File(file) => file.path.display().to_string(),
        }
    }

    /// What is said of its file; nothing of the built-in ones.
    pub fn hints(&self) -> OpenHints {
        match self {
            Self::File(file) => file.hints,
            _ => OpenHints::default(),
        }
    }

    /// The built-in environment of that id; anything else is the path of a file, made absolute: a scene that is opened
    /// from elsewhere must find the file again.
    pub fn from_id(id: &str) -> Self {
        Self::ALL_BUILT_IN
            .into_iter()
            .find(|environment| environment.id() == id)
            .unwrap_or_else(|| {
                let path = std::path::absolute(id).unwrap_or_else(|_| PathBuf::from(id));
                Self::File(path.into())
            })
    }

    /// The map as conversions take it, its file's format, and how that stores a sample. A file's has its own mapping and keeps every bit; a
    /// built-in one is a latlong of floats, a computed one with at least `rows` rows.
    ///
    /// # Errors
    /// When a file does not open or the job is cancelled.
    pub fn map(
        &self,
        rows: u32,
        progress: &Progress,
    ) -> Result<(EnvironmentMap, Format, Stored), LoadError> {
        if let Self::File(MapFile { path, hints }) = self {
            let opened = open_map(std::slice::from_ref(path), hints, progress)?;
            return Ok((opened.map, opened.format, opened.stored));
        }
        // Small ones are computed larger than needed: their lines are drawn for the usual size.
        let rows = rows.clamp(computed::DEFAULT_HEIGHT, load::MOST_HEIGHT);
        let image = self.image_at(rows, progress)?.image;
        let map = EnvironmentMap::from_latlong(image).map_err(|error| LoadError {
            problem: LoadProblem::Unclear(error.to_string()),
            name: self.id(),
        })?;
        // Photographs are stored so, and no pattern needs more.
        Ok((map, Format::Exr, Stored::Half))
    }

    /// The latlong picture, computed ones at [`computed::DEFAULT_HEIGHT`].
    ///
    /// # Errors
    /// When a file does not open or the job is cancelled.
    pub fn image(&self, progress: &Progress) -> Result<Loaded, LoadError> {
        self.image_at(computed::DEFAULT_HEIGHT, progress)
    }

    /// As [`Environment::image`] with another height for the computed ones; photographs and files have their own.
    ///
    /// # Errors
    /// As [`Environment::image`].
    pub fn image_at(&self, height: u32, progress: &Progress) -> Result<Loaded, LoadError> {
        let embedded = |bytes| load::load_bytes(bytes, &self.id(), progress);
        let pattern = |pattern| {
            computed::compute(pattern, height, progress)
                .map(|image| Loaded::from_image(image, progress))
                .map_err(|problem| LoadError {
                    problem,
                    name: self.id(),
                })
        };
        match self {
            Self::Courtyard => embedded(include_bytes!("../../assets/courtyard.exr")),
            Self::Sunset => embedded(include_bytes!("../../assets/sunset.exr")),
            Self::LabelledFaces => pattern(Pattern::LabelledFaces),
            Self::Graticule => pattern(Pattern::Graticule),
            Self::DirectionColor => pattern(Pattern::DirectionColor),
            Self::IcosahedronCrosses => pattern(Pattern::IcosahedronCrosses),
            Self::File(MapFile { path, hints }) => {
                let pictures = Pictures::read(std::slice::from_ref(path), hints, progress)?;
                pictures.taken(hints)?.into_latlong(progress)
            }
        }
    }
}
