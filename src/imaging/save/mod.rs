//! Pictures into files, whole or not at all.
//!
//! What a format holds exactly is written exactly. What it cannot hold is rounded to the nearest that it can: light becomes
//! codes of sRGB for PNG and JPEG, codes become light for HDR, EXR and float containers.

use std::path::{Path, PathBuf};

use super::atomic::WriteError;
use super::load::{EnvmapKind, Format};
use super::{Container, Progress, Raster, Stored};

/// How a file is written, beside its format.
#[derive(Clone, Debug, PartialEq)]
pub struct SaveOptions {
    /// How samples are stored; `None`: as exactly as the format can. PNG: [`Stored::U8`], [`Stored::U16`]; EXR:
    /// [`Stored::Half`], [`Stored::F32`]; containers: [`Stored::U8`], [`Stored::Half`], [`Stored::F32`], [`Stored::Rgb9e5`].
    pub stored: Option<Stored>,
    /// EXR's attribute `envmap`.
    pub envmap: Option<EnvmapKind>,
    /// JPEG's quality, 1 to 100.
    pub jpeg_quality: u8,
    /// Whether KTX2's levels are compressed with Zstandard.
    pub zstd: bool,
}

impl Default for SaveOptions {
    fn default() -> Self {
        Self {
            stored: None,
            envmap: None,
            jpeg_quality: 95,
            zstd: false,
        }
    }
}

/// What is written.
#[derive(Clone, Copy, Debug)]
pub enum Content<'a> {
    /// One picture, for any format; a container gets it as a picture of one level.
    Raster(&'a Raster),
    /// Faces and levels, for KTX2 and DDS.
    Container(&'a Container),
}

/// Why nothing was written.
#[derive(Debug, thiserror::Error)]
pub enum SaveError {
    /// The user stopped it.
    #[error("writing was cancelled; start it again to go on")]
    Cancelled,
    /// The name ends in nothing known.
    #[error("the name ends in no known format; end it in .hdr, .exr, .png, .jpg, .ktx2 or .dds: {}", .0.display())]
    UnknownFormat(PathBuf),
    /// The format cannot hold it.
    #[error("{} cannot hold {what}", format.name())]
    Unfit {
        /// The format.
        format: Format,
        /// What it cannot hold, and what to choose instead.
        what: String,
    },
    /// The encoder refused.
    #[error("the {} could not be encoded: {reason}", format.name())]
    Encode {
        /// The format.
        format: Format,
        /// What it said.
        reason: String,
    },
    /// The file could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// The format that a file's name ends in, small or capital.
///
/// # Errors
/// [`SaveError::UnknownFormat`].
pub fn format_of_path(path: &Path) -> Result<Format, SaveError> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    match ending.to_ascii_lowercase().as_str() {
        "hdr" | "pic" | "rgbe" => Ok(Format::Hdr),
        "exr" => Ok(Format::Exr),
        "png" => Ok(Format::Png),
        "jpg" | "jpeg" => Ok(Format::Jpeg),
        "ktx2" => Ok(Format::Ktx2),
        "dds" => Ok(Format::Dds),
        _ => Err(SaveError::UnknownFormat(path.to_owned())),
    }
}

/// The bytes of a file.
///
/// # Errors
/// When the format cannot hold the content, or it is cancelled.
pub fn encode(
    content: Content,
    format: Format,
    options: &SaveOptions,
    progress: &Progress,
) -> Result<Vec<u8>, SaveError> {
    let _ = (content, options, progress);
    Err(SaveError::Encode {
        format,
        reason: "not built yet".to_owned(),
    })
}

/// Writes a file, row by row, so that it appears whole or not at all; an existing one is replaced only with `force`.
///
/// # Errors
/// As [`encode`], and when the system refuses.
pub fn save(
    path: &Path,
    force: bool,
    content: Content,
    format: Format,
    options: &SaveOptions,
    progress: &Progress,
) -> Result<(), SaveError> {
    let _ = (path, force);
    encode(content, format, options, progress).map(drop)
}
