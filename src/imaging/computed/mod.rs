//! Environments that are computed: every picture of them can be checked by eye.
//!
//! Each is a pure function of a unit direction and the angle that a texel covers; lines and letters fade out over that
//! angle, so edges are smooth at every size without supersampling.

mod crosses;
mod faces;
mod graticule;
pub(crate) mod strokes;

use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::load::{LoadProblem, MOST_HEIGHT};
use super::{Image, Progress, Stage};
use crate::mapping::latlong;
use crate::math::Vec3;

pub use crosses::{cross_outlines, dodecahedron_vertices, icosahedron_vertices};

/// Rows of a computed environment where nothing else is asked for.
pub const DEFAULT_HEIGHT: u32 = 1024;

/// A computed environment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// The cube's six faces, each in its colour with name, u and v arrows, grid, and a letter R that shows mirroring.
    LabelledFaces,
    /// Meridians and parallels every 15 degrees with their numbers.
    Graticule,
    /// rgb = (direction + 1)/2, in linear light.
    DirectionColor,
    /// Red crosses at the vertices of the icosahedron, blue ones at those of its dual dodecahedron.
    IcosahedronCrosses,
}

/// The latlong picture of `pattern`, `height` rows of twice as many texels.
///
/// # Errors
/// When `height` is 0 or above [`MOST_HEIGHT`], when there is no memory, or when the job is cancelled.
pub fn compute(pattern: Pattern, height: u32, progress: &Progress) -> Result<Image, LoadProblem> {
    match pattern {
        Pattern::LabelledFaces => {
            let faces = faces::Faces::new();
            rasterize(height, progress, |dir, texel_rad| {
                faces.color(dir, texel_rad)
            })
        }
        Pattern::Graticule => {
            let graticule = graticule::Graticule::new();
            rasterize(height, progress, |dir, texel_rad| {
                graticule.color(dir, texel_rad)
            })
        }
        Pattern::DirectionColor => rasterize(height, progress, |dir, _| {
            dir.to_array()
                .map(|component| ((component + 1.0) / 2.0) as f32)
        }),
        Pattern::IcosahedronCrosses => {
            let crosses = crosses::Crosses::new();
            rasterize(height, progress, |dir, texel_rad| {
                crosses.color(dir, texel_rad)
            })
        }
    }
}

/// Calls `color(unit direction, angle of a texel's height)` at every texel centre, on all cores.
fn rasterize(
    height: u32,
    progress: &Progress,
    color: impl Fn(Vec3<f64>, f64) -> [f32; 3] + Sync,
) -> Result<Image, LoadProblem> {
    if height == 0 || height > MOST_HEIGHT {
        let (width, height) = (2 * u64::from(height), u64::from(height));
        return Err(LoadProblem::TooLarge { width, height });
    }
    progress.enter(Stage::Computing);
    let (rows, width) = (height as usize, 2 * height as usize);
    let mut pixels = super::load::zeroed([0.0; 3], rows * width)?;

    // Longitudes repeat in every row.
    let longitude = |x: usize| latlong::longitude((x as f64 + 0.5) / width as f64);
    let longitudes: Vec<(f64, f64)> = (0..width).map(longitude).collect();
    let texel_rad = PI / f64::from(height);
    let done = AtomicUsize::new(0);
    let fill = |y: usize, row: &mut [[f32; 3]]| {
        if progress.is_cancelled() {
            return;
        }
        let colatitude = latlong::colatitude((y as f64 + 0.5) / rows as f64);
        for (texel, longitude) in row.iter_mut().zip(&longitudes) {
            *texel = color(latlong::direction(*longitude, colatitude), texel_rad);
        }
        progress.step(done.fetch_add(1, Ordering::Relaxed) + 1, rows);
    };
    // Rows are dealt like cards: neighbours cost about the same, so every worker gets its share of the dear ones.
    let workers = std::thread::available_parallelism()
        .map_or(1, usize::from)
        .min(rows);
    type Hand<'a> = Vec<(usize, &'a mut [[f32; 3]])>;
    let mut hands: Vec<Hand> = Vec::new();
    hands.resize_with(workers, Vec::new);
    for (y, row) in pixels.chunks_mut(width).enumerate() {
        hands[y % workers].push((y, row));
    }
    std::thread::scope(|scope| {
        for hand in hands {
            scope.spawn(|| hand.into_iter().for_each(|(y, row)| fill(y, row)));
        }
    });
    if progress.is_cancelled() {
        return Err(LoadProblem::Cancelled);
    }
    Image::new(2 * height, height, pixels).map_err(|_| LoadProblem::OutOfMemory {
        bytes: (rows * width * 12) as u64,
    })
}

/// Share of a texel that ink covers: 1 where `distance` is well inside of `half_width`, 0 well outside, a ramp of the
/// texel's width between. All three in the same unit.
fn coverage(distance: f64, half_width: f64, texel: f64) -> f32 {
    (0.5 + (half_width - distance) / texel).clamp(0.0, 1.0) as f32
}

fn blend(below: [f32; 3], above: [f32; 3], amount: f32) -> [f32; 3] {
    [0, 1, 2].map(|c| below[c] + (above[c] - below[c]) * amount)
}
