//! Rays through bodies.

use super::{Camera, Target};

/// Traces a view.
pub fn trace_view(
    target: &Target,
    camera: &Camera,
    size_px: [u32; 2],
    eta: f32,
    bounces: u32,
    stop: &(dyn Fn(f32) -> bool + Sync),
) -> Option<Traced> {
    let _ = (target, camera, size_px, eta, bounces, stop(0.0));
    None
}

/// The ways out for every pixel of a view.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Ways out that each pixel has room for.
    pub layers: u32,
    /// Layer by layer, row by row: direction and weight.
    pub dirs: Vec<[f32; 4]>,
}
