//! Pictures into files, whole or not at all.
//!
//! What a format holds exactly is written exactly. What it cannot hold is rounded to the nearest that it can: light becomes
//! codes of sRGB for PNG and JPEG, codes become light for HDR, EXR and float containers.

mod exr;
mod hdr;
mod jpeg;
mod png;
pub(super) mod rows;

use std::io::{self, Cursor};
use std::path::{Path, PathBuf};

use super::atomic::{WriteError, WriteSeek, write_atomically_with};
use super::container::{self, Container};
use super::load::{EnvmapKind, Format};
use super::{Progress, Raster, SampleKind, Stage, Stored};

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
    #[error("{} cannot hold {what}: {name}", format.name())]
    Unfit {
        /// The format.
        format: Format,
        /// What it cannot hold, and what to choose instead.
        what: String,
        /// The file, or `memory`.
        name: String,
    },
    /// The encoder refused.
    #[error("the {} could not be encoded ({reason}); choose another format: {name}", format.name())]
    Encode {
        /// The format.
        format: Format,
        /// What it said.
        reason: String,
        /// The file, or `memory`.
        name: String,
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
    let mut out = Cursor::new(Vec::new());
    write(content, format, options, progress, &mut out)
        .map_err(|fault| fault.named(format, Path::new("memory")))?;
    Ok(out.into_inner())
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
    write_atomically_with(path, force, |out| {
        write(content, format, options, progress, out).map_err(|fault| fault.named(format, path))
    })
}

fn write(
    content: Content,
    format: Format,
    options: &SaveOptions,
    progress: &Progress,
    out: &mut dyn WriteSeek,
) -> Result<(), Fault> {
    progress.enter(Stage::Writing);
    let stored = options.stored;
    let mut job = Job {
        out,
        progress: RowsLeft::new(progress, content),
    };
    job.progress.stop_if_cancelled()?;
    match (format, content) {
        (Format::Ktx2 | Format::Dds, content) => {
            let levels = match content {
                Content::Raster(raster) => container::Levels::of_raster(raster),
                Content::Container(container) => container::Levels::of_container(container)?,
            };
            let stored = stored.unwrap_or(match content {
                Content::Container(container) => container.stored,
                Content::Raster(raster) => raster_stored(raster, format),
            });
            match format {
                Format::Dds => container::dds::write(&levels, fitting(format, stored)?, &mut job),
                _ => container::ktx2::write(
                    &levels,
                    fitting(format, stored)?,
                    options.zstd,
                    &mut job,
                ),
            }
        }
        (_, Content::Container(_)) => Err(Fault::Unfit(
            "faces and levels; choose KTX2 or DDS, or a layout of one picture".to_owned(),
        )),
        (_, Content::Raster(raster)) => {
            let stored = fitting(format, stored.unwrap_or(raster_stored(raster, format)))?;
            match format {
                Format::Hdr => hdr::write(raster, &mut job),
                Format::Exr => exr::write(raster, stored, options.envmap, &mut job),
                Format::Png => png::write(raster, stored, &mut job),
                _ => jpeg::write(raster, options.jpeg_quality, &mut job),
            }
        }
    }
}

/// How a format stores the raster as exactly as it can.
fn raster_stored(raster: &Raster, format: Format) -> Stored {
    match (format, raster.samples().kind()) {
        (Format::Hdr, _) => Stored::Rgbe,
        (Format::Exr, _) => Stored::F32,
        (Format::Jpeg, _) | (_, SampleKind::U8) => Stored::U8,
        (Format::Png, _) => Stored::U16,
        (Format::Ktx2 | Format::Dds, _) => Stored::F32,
    }
}

/// `stored`, where the format has it.
fn fitting(format: Format, stored: Stored) -> Result<Stored, Fault> {
    let (known, names): (&[Stored], _) = match format {
        Format::Hdr => (&[Stored::Rgbe], "rgbe"),
        Format::Exr => (&[Stored::Half, Stored::F32], "half or f32"),
        Format::Png => (&[Stored::U8, Stored::U16], "8 or 16 bits"),
        Format::Jpeg => (&[Stored::U8], "8 bits"),
        Format::Ktx2 | Format::Dds => (
            &[Stored::U8, Stored::Half, Stored::F32, Stored::Rgb9e5],
            "8 bits, half, f32 or rgb9e5",
        ),
    };
    if known.contains(&stored) {
        Ok(stored)
    } else {
        Err(Fault::Unfit(format!(
            "samples of the kind {stored:?}; choose {names}"
        )))
    }
}

/// What every writer gets.
pub(super) struct Job<'a> {
    pub(super) out: &'a mut dyn WriteSeek,
    pub(super) progress: RowsLeft<'a>,
}

impl Job<'_> {
    /// Reports rows; fails when the user wants to stop.
    pub(super) fn rows_done(&mut self, rows: u32) -> Result<(), Fault> {
        self.progress.rows_done(rows)
    }
}

/// Counts the rows that are written, of all pictures together.
pub(super) struct RowsLeft<'a> {
    progress: &'a Progress,
    done: usize,
    total: usize,
}

impl<'a> RowsLeft<'a> {
    fn new(progress: &'a Progress, content: Content) -> Self {
        let rows = |raster: &Raster| raster.height() as usize;
        let total = match content {
            Content::Raster(raster) => rows(raster),
            Content::Container(container) => container
                .levels
                .iter()
                .flat_map(|level| &level.rasters)
                .map(rows)
                .sum(),
        };
        Self {
            progress,
            done: 0,
            total,
        }
    }

    pub(super) fn rows_done(&mut self, rows: u32) -> Result<(), Fault> {
        self.done += rows as usize;
        self.progress.step(self.done, self.total);
        self.stop_if_cancelled()
    }

    pub(super) fn stop_if_cancelled(&self) -> Result<(), Fault> {
        if self.progress.is_cancelled() {
            Err(Fault::Cancelled)
        } else {
            Ok(())
        }
    }
}

/// Why a writer broke off.
#[derive(Debug)]
pub(super) enum Fault {
    /// The user stopped it.
    Cancelled,
    /// The output failed.
    Io(io::Error),
    /// The format cannot hold it.
    Unfit(String),
    /// The encoder refused.
    Encoder(String),
}

impl From<io::Error> for Fault {
    fn from(cause: io::Error) -> Self {
        Self::Io(cause)
    }
}

impl Fault {
    fn named(self, format: Format, path: &Path) -> SaveError {
        let name = path.display().to_string();
        match self {
            Self::Cancelled => SaveError::Cancelled,
            Self::Io(cause) => SaveError::Write(WriteError::Io {
                cause,
                path: path.to_owned(),
            }),
            Self::Unfit(what) => SaveError::Unfit { format, what, name },
            Self::Encoder(reason) => SaveError::Encode {
                format,
                reason,
                name,
            },
        }
    }
}
