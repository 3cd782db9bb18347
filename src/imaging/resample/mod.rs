//! From one environment map to any other: every texel asks the source for the light of its direction.
//!
//! - [`Conversion`]: what is wanted, plain data;
//! - [`Plan`]: what can be computed before any pixel is there; one plan serves a sequence of frames;
//! - [`Plan::run`]: fills a map, on all threads, strip by strip;
//! - [`light_towards`]: the light of a map in any directions, of a view's pixels for one.
//!
//! # How it works
//!
//! A target row goes through three steps, each behind a trait, so that a faster way can stand in for one of them or for all:
//!
//! 1. *Places* (`lookups`): where each texel looks in the source. The general way (`geometry`) asks the target's inverse, turns
//!    the direction, and asks the source's forward function.
//! 2. *Light* (`filter`, `Sampler`): what is there. The source is read where it lies (`texels`): a chart is a base and two
//!    strides. Texels beyond a chart are its gutter: each holds the light of its own direction, which the mapping's continued
//!    inverse tells, so that filters meet no seam.
//! 3. *Samples* (`encode`): exposure, the sRGB code, rounding.
//!
//! `strips` runs a `Kernel` over the target's pictures: `general` does the three steps one after another, for every pair of
//! mappings, every kind of samples and every filter; a kernel for one kind may do them at once. `area` says at which places a
//! texel that covers many asks.

mod area;
mod conversion;
mod encode;
mod equal;
mod filter;
mod fused;
mod general;
mod geometry;
mod grid;
mod gutter;
mod lane_places;
mod levels;
mod lookups;
mod parts;
mod pieces;
mod plan;
mod prefetch;
mod report;
mod stored;
mod strips;
mod texels;
mod towards;

pub use crate::math::Isa;
pub use conversion::{Conversion, Filter, FilteredIn};
pub use equal::{
    chart_size, equal_height, equal_rows, rotation_of_viewer, size_of_texels, texels_of,
};
pub use levels::levels;
pub use plan::{MOST_SIDE, Plan};
pub use report::{Report, Skipped};
pub use towards::light_towards;

use super::{EnvironmentMap, Progress};

/// Why a conversion cannot be done.
#[derive(Debug, thiserror::Error)]
pub enum ResampleError {
    /// The user stopped it.
    #[error("converting was cancelled; start it again to go on")]
    Cancelled,
    /// The mapping's charts cannot lie so.
    #[error("`{mapping}` has no layout `{layout}`; choose another")]
    NoSuchLayout {
        /// The mapping.
        mapping: crate::mapping::MappingId,
        /// The layout's name.
        layout: &'static str,
    },
    /// The program has no such maps.
    #[error(transparent)]
    Frame(#[from] crate::mapping::FrameError),
    /// Too many texels.
    #[error(
        "{width} x {height} texels a chart are too many, the limit is {most} a side; choose a smaller size"
    )]
    TooLarge {
        /// Texels in a row of a chart.
        width: u32,
        /// Rows of a chart.
        height: u32,
        /// The limit.
        most: u32,
    },
    /// A number that no conversion can use.
    #[error("{0}")]
    BadNumber(String),
    /// The source is not of the shape that the plan was made for.
    #[error("the frame is not like the first one: {0}; convert it by itself")]
    OtherShape(String),
    /// More than any reader here would open again.
    #[error(
        "a picture of {bytes} bytes is too large, the limit is {}; choose a smaller size, or a file a face",
        super::load::MOST_RASTER_BYTES
    )]
    TooManyBytes {
        /// Bytes of one picture.
        bytes: u64,
    },
    /// No room.
    #[error("there is no memory for {bytes} bytes; choose a smaller size or close something")]
    OutOfMemory {
        /// Bytes that were asked for.
        bytes: u64,
    },
}

/// Converts one map: [`Plan::new`] and [`Plan::run`].
///
/// # Errors
/// As both.
pub fn resample(
    source: &EnvironmentMap,
    conversion: &Conversion,
    progress: &Progress,
) -> Result<(EnvironmentMap, Report), ResampleError> {
    Plan::new(source.shape(), conversion)?.run(source, progress)
}
