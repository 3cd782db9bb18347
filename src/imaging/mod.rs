//! Environments as pictures: reading, checking, computing, writing.
//!
//! - [`Environment`]: what can be shown, and [`Environment::image`], which makes its picture;
//! - [`load`]: a latlong picture from a file, refused before any allocation when it declares too much;
//! - [`Image`]: RGB in linear light; [`sanitize`] makes every value finite and remembers what it replaced;
//! - [`ball`]: pictures of a lit ball, for sphere-map styles;
//! - [`computed`]: pictures that show where every direction went;
//! - [`compare`]: how far two maps differ, and what a conversion loses;
//! - [`open_regular`]: a file, and nothing that would wait for ever;
//! - [`png_out`] and [`atomic`]: pictures to files, whole or not at all.

pub mod atomic;
pub mod ball;
pub(crate) mod caught;
pub mod compare;
pub mod computed;
mod environment;
mod environment_map;
mod file;
mod image;
pub mod load;
pub mod png_out;
mod progress;
mod raster;
pub mod resample;
pub mod sanitize;
pub mod srgb;

pub use environment::{Environment, FACE_COLORS};
pub use environment_map::{EnvironmentMap, MapShape, Placement, ShapeError, Siting};
pub(crate) use file::{ReadProblem, read_whole};
pub use file::{open_regular, short_name};
pub use image::{Image, ImageSizeError};
pub use load::{LoadError, LoadProblem, Loaded};
pub use progress::{Progress, Stage};
pub use raster::{Channels, Raster, SampleKind, Samples, Transfer};
pub use sanitize::{BadTexels, Originals};
