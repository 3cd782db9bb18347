//! From one environment map to any other: every texel asks the source for the light of its direction.
//!
//! - [`Conversion`]: what is wanted, plain data;
//! - [`Plan`]: what can be computed before any pixel is there; one plan serves a sequence of frames;
//! - [`Plan::run`]: fills a map, on all threads, strip by strip.

mod conversion;
#[expect(dead_code, reason = "the first user comes with the engine")]
mod lookups;
mod report;

pub use conversion::{Conversion, Filter, FilteredIn, Isa};
pub use report::{Report, Skipped};

use super::{EnvironmentMap, MapShape, Progress};

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
    /// No room.
    #[error("there is no memory for {bytes} bytes; choose a smaller size or close something")]
    OutOfMemory {
        /// Bytes that were asked for.
        bytes: u64,
    },
}

/// What a conversion needs to know that depends on the shapes alone.
#[derive(Clone, Debug)]
pub struct Plan {
    source: MapShape,
    target: MapShape,
    conversion: Conversion,
}

impl Plan {
    /// Prepares a conversion of maps of a shape.
    ///
    /// # Errors
    /// When the conversion makes no sense; see [`ResampleError`].
    pub fn new(source: &MapShape, conversion: &Conversion) -> Result<Self, ResampleError> {
        let target = conversion.target_shape(source)?;
        Ok(Self {
            source: source.clone(),
            target,
            conversion: conversion.clone(),
        })
    }

    /// Shape of the map that comes out.
    pub const fn target(&self) -> &MapShape {
        &self.target
    }

    /// Converts one map.
    ///
    /// # Errors
    /// When it is cancelled, there is no memory, or the source has another shape than the plan's.
    pub fn run(
        &self,
        source: &EnvironmentMap,
        progress: &Progress,
    ) -> Result<(EnvironmentMap, Report), ResampleError> {
        let _ = (&self.source, &self.conversion, source, progress);
        Err(ResampleError::BadNumber("not built yet".to_owned()))
    }
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
