//! Parts of a picture where nothing is drawn.

use super::Raster;
use super::seams::{difference, lightness, spread};
use crate::mapping::Domain;

/// Most texels that are asked along a side.
const MOST: u32 = 64;

/// JPEG rings by a few codes beside an edge.
const RINGING: f64 = 12.0 / 255.0;

/// Whether a part of a picture is all of one colour.
pub(super) fn is_even(raster: &Raster, at: [u32; 2], size: [u32; 2]) -> bool {
    is_even_where(raster, at, size, |_| true)
}

/// Whether a part of a picture is all of one colour outside of its disc.
pub(super) fn has_empty_corners(raster: &Raster, at: [u32; 2], size: [u32; 2]) -> bool {
    // Two texels of slack: the rim's own are drawn half over by some, and filtered ones reach one further.
    let slack = 1.0 + 4.0 / f64::from(size[0].min(size[1]).max(1));
    is_even_where(raster, at, size, |texel| {
        let [u, v] = [0, 1].map(|i| {
            let place = (f64::from(texel[i]) + 0.5) / f64::from(size[i]);
            0.5 + (place - 0.5) / slack
        });
        !Domain::Disc.contains(u, v)
    })
}

fn is_even_where(
    raster: &Raster,
    [left, top]: [u32; 2],
    size: [u32; 2],
    counts: impl Fn([u32; 2]) -> bool,
) -> bool {
    let Some(corner) = lightness(raster, [left, top]) else {
        return false;
    };
    let mut texels = spread(size[1], MOST).flat_map(|y| spread(size[0], MOST).map(move |x| [x, y]));
    texels.all(|[x, y]| {
        let color = lightness(raster, [left + x, top + y]);
        !counts([x, y]) || color.is_some_and(|color| difference(color, corner) < RINGING)
    })
}
