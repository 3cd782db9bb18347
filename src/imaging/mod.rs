//! Environments as pictures: reading, checking, computing, converting, writing.
//!
//! - [`Environment`]: what can be shown, and [`Environment::image`], which makes its picture;
//! - [`load`]: pictures and containers from files, refused before any allocation when they declare too much;
//! - [`Raster`]: a picture as a file holds it, every bit kept; [`Container`]: faces and levels of such;
//! - [`save`]: both into files, row by row;
//! - [`Image`]: RGB in linear light; [`sanitize`] makes every value finite and remembers what it replaced;
//! - [`Pictures`]: decoded files, and what they may be; [`open_map`] decides what they are, by [`OpenHints`] where it must;
//! - [`EnvironmentMap`] and [`resample`]: a map as it lies in memory, and from one to any other;
//! - [`ball`]: pictures of a lit ball, for sphere-map styles;
//! - [`computed`]: pictures that show where every direction went;
//! - [`compare`]: how far two maps differ, and what a conversion loses;
//! - [`open_regular`]: a file, and nothing that would wait for ever;
//! - [`png_out`] and [`atomic`]: pictures to files, whole or not at all.
//!
//! | format | read as | written |
//! |---|---|---|
//! | Radiance HDR | f32 RGB; both codings, all orientations along x | the newer runs, rounded to nearest; what was read comes back |
//! | OpenEXR | f32 RGB(A), halves exactly; every compression, lines or tiles, `envmap` | half or f32, without loss, `envmap` |
//! | PNG | codes of 8 or 16 bits, with or without opacity | the same, marked as sRGB |
//! | JPEG | codes of 8 bits | the same, by quality |
//! | KTX2 | 8 bits, half, f32, RGB9E5; cube maps and pictures, levels; plain or Zstandard | the same |
//! | DDS | the same, plain; also with the older header alone | the same, with the newer header |

pub mod atomic;
pub mod ball;
pub(crate) mod caught;
pub mod compare;
pub mod computed;
pub mod container;
pub mod detect;
mod environment;
mod environment_map;
mod evenness;
mod face_files;
mod file;
mod hints;
mod image;
pub mod load;
pub mod opacity;
pub mod open;
mod pictures;
pub mod png_out;
mod preview;
mod progress;
mod raster;
pub mod resample;
pub mod sanitize;
pub mod save;
pub mod seams;
mod shared_exponent;
pub mod solver;
pub mod srgb;
mod unfold;

pub use container::{Container, Level};
pub use environment::{Environment, FACE_COLORS};
pub use environment_map::{EnvironmentMap, MapShape, Placement, ShapeError, Siting};
pub use face_files::face_name;
pub(crate) use file::{ReadProblem, read_whole};
pub use file::{open_regular, short_name};
pub use hints::{MapFile, OpenHints};
pub use image::{Image, ImageSizeError};
pub use load::{EnvmapKind, LoadError, LoadProblem, Loaded, Opened, RasterFile};
pub use open::{OpenedMap, open_map};
pub use pictures::Pictures;
pub use preview::Preview;
pub use progress::{Progress, Stage};
pub use raster::{Channels, Raster, SampleKind, Samples, Stored, Transfer};
pub use sanitize::{BadTexels, Originals};
