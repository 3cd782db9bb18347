//! How well each side of each picture fits each side of every other.

use crate::imaging::seams::{MOST_ALONG, Texels, beside, difference, spread};
use crate::imaging::{MapShape, Raster};
use crate::mapping::Turn;
use crate::mapping::cube_face::Side;

/// A side of a picture as it lies in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct PictureSide {
    pub picture: usize,
    pub side: Side,
}

impl PictureSide {
    fn index(self) -> usize {
        4 * self.picture + self.side as usize
    }
}

/// Mean differences between the outermost texels of all pairs of sides.
pub(super) struct Borders {
    /// By the two sides' indices, and whether the second is read backwards.
    apart: Vec<[f64; 2]>,
    /// Mean difference between the outermost texels and the next ones inside.
    pub inside: f64,
    /// The smallest of all mean differences.
    pub least: f64,
}

const SIDES: usize = 24;

impl Borders {
    /// Reads the sides of six square charts; `None` where one is missing.
    pub fn read(shape: &MapShape, rasters: &[Raster]) -> Option<Self> {
        let texels = Texels { shape, rasters };
        let size = shape.size;
        if shape.charts.len() != 6 || size[0] != size[1] || size[0] < 2 {
            return None;
        }
        let mut strips = Vec::with_capacity(SIDES);
        let (mut inside, mut count) = (0.0, 0.0);
        for picture in 0..6 {
            for side in Side::ALL {
                let mut strip = Vec::new();
                for along in spread(size[0], MOST_ALONG) {
                    let at = |depth| texels.lightness((picture, beside(side, along, depth, size)));
                    let (outermost, next) = (at(0)?, at(1)?);
                    inside += difference(outermost, next);
                    count += 1.0;
                    strip.push(outermost);
                }
                strips.push(strip);
            }
        }
        let mut apart = Vec::with_capacity(SIDES * SIDES);
        let mut least = f64::INFINITY;
        for (i, a) in strips.iter().enumerate() {
            for (j, b) in strips.iter().enumerate() {
                let forwards = mean(a.iter().zip(b));
                let backwards = mean(a.iter().zip(b.iter().rev()));
                apart.push([forwards, backwards]);
                if i / 4 != j / 4 {
                    least = least.min(forwards).min(backwards);
                }
            }
        }
        Some(Self {
            apart,
            inside: inside / count,
            least,
        })
    }

    /// Mean difference of two sides, the second read backwards or not.
    pub fn apart(&self, a: PictureSide, b: PictureSide, is_reversed: bool) -> f64 {
        self.apart[SIDES * a.index() + b.index()][usize::from(is_reversed)]
    }
}

fn mean<'a>(pairs: impl ExactSizeIterator<Item = (&'a [f32; 3], &'a [f32; 3])>) -> f64 {
    let count = pairs.len().max(1) as f64;
    pairs.map(|(a, b)| difference(*a, *b)).sum::<f64>() / count
}

/// Where a side of a chart comes to lie in its picture, and whether it runs backwards there.
pub(super) fn side_in_picture(turn: Turn, side: Side) -> (Side, bool) {
    // Exact in binary, and not in the middle.
    const ALONG: f64 = 0.25;
    let place = turn.cell_place(side.place(ALONG));
    Side::of_place(place).map_or((side, false), |(side, along)| (side, along != ALONG))
}
