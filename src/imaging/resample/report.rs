//! What a conversion did, and what it could leave out.

use super::conversion::Filter;
use crate::math::Isa;

/// Work that was not needed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Skipped {
    /// Charts that were not asked for.
    Charts(u32),
    /// Texels outside of discs.
    OutsideDiscs(u64),
    /// No table of places was kept: rows and columns were computed apart.
    TableOfPlaces,
    /// Nothing was decoded or encoded: codes were mixed, or the numbers are the light.
    Decoding,
    /// The rotation was none.
    Rotation,
}

/// What a conversion did.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The filter, when it was left to the plan too.
    pub filter: Filter,
    /// Threads that worked.
    pub threads: usize,
    /// Instructions that were used.
    pub isa: Isa,
    /// Largest footprint of a target texel in the source, in source texels along its longer axis.
    pub largest_footprint_texels: f64,
    /// What was left out.
    pub skipped: Vec<Skipped>,
}
