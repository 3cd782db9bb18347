//! How well the charts of a map meet, as one number that no unit and no exposure changes.
//!
//! Across a seam lie two texels that are neighbours on the sphere; inside, near the same seam, lie two that are neighbours in
//! the picture. The mean difference of the former over that of the latter is 1 where a map is as smooth across its seams as
//! beside them, and several times that where charts are exchanged or turned.

use std::f64::consts::TAU;

use super::{MapShape, Placement, Raster, Samples, Transfer};
use crate::mapping::Borders;
use crate::mapping::cube_face::Side;

/// Most texels that are asked along a seam: the mean of so many differences is as good as that of all.
pub(super) const MOST_ALONG: u32 = 256;

/// Differences below this are none: a twentieth of a step of 8 bits.
const NOTHING: f64 = 2e-4;

/// Differences across the seams of a map and beside them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seams {
    across: f64,
    inside: f64,
    count: u64,
}

impl Seams {
    /// Mean difference across the seams.
    pub fn across(&self) -> f64 {
        self.across / self.count.max(1) as f64
    }

    /// Mean difference beside them.
    pub fn inside(&self) -> f64 {
        self.inside / self.count.max(1) as f64
    }

    /// The former over the latter; `None` where all is so even that nothing can be told.
    pub fn score(&self) -> Option<f64> {
        ratio(self.across(), self.inside())
    }
}

/// A mean difference across seams over one beside them; `None` where there is no difference at all.
pub(super) fn ratio(across: f64, inside: f64) -> Option<f64> {
    (across.max(inside) > NOTHING).then(|| across / inside.max(NOTHING))
}

/// How the charts of a map meet; `None` for a mapping that has no seam (a hemisphere's).
pub fn seams(shape: &MapShape, rasters: &[Raster]) -> Option<Seams> {
    let mut sums = Sums {
        texels: Texels { shape, rasters },
        seams: Seams::default(),
    };
    let [width, height] = shape.size;
    if width < 2 || height < 2 {
        return None;
    }
    match shape.mapping.info().borders {
        borders @ (Borders::CubeEdges | Borders::BasePixelEdges) => sums.edges(borders),
        Borders::DateLineAndPoles => {
            sums.date_line();
            sums.poles();
        }
        // Towards its poles a texel reaches over many degrees: no neighbour there is near.
        Borders::DateLine => sums.date_line(),
        Borders::TwoRims => sums.two_rims(),
        Borders::FoldedSides => sums.folded_sides(),
        Borders::OneRim => sums.one_rim(),
        Borders::End => return None,
    }
    (sums.seams.count > 0).then_some(sums.seams)
}

/// The texels of a map that may lie anyhow in its pictures, as lightness.
#[derive(Clone, Copy)]
pub(super) struct Texels<'a> {
    pub shape: &'a MapShape,
    pub rasters: &'a [Raster],
}

/// A texel of a chart.
type At = (u32, [u32; 2]);

impl Texels<'_> {
    /// Red, green and blue as lightness; `None` where there is no texel.
    pub fn lightness(&self, (chart, texel): At) -> Option<[f32; 3]> {
        let Placement {
            raster,
            origin,
            turn,
        } = self.shape.charts.get(chart as usize).copied().flatten()?;
        let [x, y] = turn.cell_from_chart(texel, self.shape.size);
        lightness(self.rasters.get(raster)?, [origin[0] + x, origin[1] + y])
    }
}

/// Lightness of a pixel. Codes of sRGB are nearly even in what eyes see, and so is the cube root of light, which keeps the
/// sun from outweighing all else; as a power it leaves ratios of differences alike at every exposure.
pub(super) fn lightness(raster: &Raster, [x, y]: [u32; 2]) -> Option<[f32; 3]> {
    if x >= raster.width() || y >= raster.height() {
        return None;
    }
    let at = (y as usize * raster.width() as usize + x as usize) * raster.channels().count();
    let stored = |channel: usize| match raster.samples() {
        Samples::U8(samples) => f32::from(samples[at + channel]) / 255.0,
        Samples::U16(samples) => f32::from(samples[at + channel]) / 65535.0,
        Samples::F32(samples) => samples[at + channel],
    };
    Some([0, 1, 2].map(|channel| {
        let value = stored(channel);
        match raster.transfer() {
            _ if !value.is_finite() => 0.0,
            Transfer::Srgb => value,
            Transfer::Linear => value.max(0.0).cbrt(),
        }
    }))
}

/// Mean absolute difference of two colours.
pub(super) fn difference(a: [f32; 3], b: [f32; 3]) -> f64 {
    let sum: f32 = a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum();
    f64::from(sum) / 3.0
}

/// At most `most` of `count` texels in a row, evenly spread; read from the other end they are the same.
pub(super) fn spread(count: u32, most: u32) -> impl Iterator<Item = u32> {
    let taken = count.min(most);
    (0..taken).map(move |i| {
        let mirrored = i >= taken.div_ceil(2);
        let nearer = if mirrored { taken - 1 - i } else { i };
        let at = ((2 * u64::from(nearer) + 1) * u64::from(count) / (2 * u64::from(taken))) as u32;
        if mirrored { count - 1 - at } else { at }
    })
}

/// The texel so far along a side, and so many texels from it; `along` and `depth` must lie in the chart.
pub(super) fn beside(side: Side, along: u32, depth: u32, [width, height]: [u32; 2]) -> [u32; 2] {
    match side {
        Side::Left => [depth, along],
        Side::Right => [width - 1 - depth, along],
        Side::Top => [along, depth],
        Side::Bottom => [along, height - 1 - depth],
    }
}

struct Sums<'a> {
    texels: Texels<'a>,
    seams: Seams,
}

impl Sums<'_> {
    /// Counts a seam's two texels, each with the next one inside.
    fn count(&mut self, [a, a_inside]: [At; 2], [b, b_inside]: [At; 2]) {
        let read = |at| self.texels.lightness(at);
        if let (Some(a), Some(a_inside), Some(b), Some(b_inside)) =
            (read(a), read(a_inside), read(b), read(b_inside))
        {
            self.seams.across += difference(a, b);
            self.seams.inside += (difference(a, a_inside) + difference(b, b_inside)) / 2.0;
            self.seams.count += 1;
        }
    }

    fn size(&self) -> [u32; 2] {
        self.texels.shape.size
    }

    /// The edges at which sides of charts meet, with the corners at their ends.
    fn edges(&mut self, borders: Borders) {
        let size = self.size();
        let count = size[0];
        if count != size[1] {
            return;
        }
        for face in 0..self.texels.shape.mapping.info().chart_count() {
            for side in Side::ALL {
                let other = borders.across(face, side);
                let Some(other) = other.filter(|other| other.face > face) else {
                    continue;
                };
                for along in spread(count, MOST_ALONG) {
                    let there = if other.is_reversed {
                        count - 1 - along
                    } else {
                        along
                    };
                    let at = |face, side, along| {
                        [0, 1].map(|depth| (face, beside(side, along, depth, size)))
                    };
                    self.count(at(face, side, along), at(other.face, other.side, there));
                }
            }
        }
    }

    fn date_line(&mut self) {
        let size = self.size();
        for row in spread(size[1], MOST_ALONG) {
            let at = |side| [0, 1].map(|depth| (0, beside(side, row, depth, size)));
            self.count(at(Side::Left), at(Side::Right));
        }
    }

    /// Half round the pole lies the texel on its other side.
    fn poles(&mut self) {
        let size = self.size();
        let half = size[0] / 2;
        for side in [Side::Top, Side::Bottom] {
            for column in spread(half, MOST_ALONG) {
                let at = |along| [0, 1].map(|depth| (0, beside(side, along, depth, size)));
                self.count(at(column), at(column + half));
            }
        }
    }

    /// Each side of the octahedron's square is folded in its middle.
    fn folded_sides(&mut self) {
        let size = self.size();
        for side in Side::ALL {
            let count = match side {
                Side::Left | Side::Right => size[1],
                Side::Top | Side::Bottom => size[0],
            };
            for along in spread(count / 2, MOST_ALONG) {
                let at = |along| [0, 1].map(|depth| (0, beside(side, along, depth, size)));
                self.count(at(along), at(count - 1 - along));
            }
        }
    }

    /// The texel of a disc at an angle, so many steps from the rim; the first step keeps the whole texel inside.
    fn in_disc(&self, chart: u32, [cos, sin]: [f64; 2], steps: f64) -> At {
        let [width, height] = self.size().map(f64::from);
        // A texel reaches at most half of its diagonal from its middle.
        let step = std::f64::consts::SQRT_2 / width.min(height);
        let radius = (1.0 - steps * step).max(0.0);
        let texel =
            |c: f64, size: f64| ((c * radius + 1.0) / 2.0 * size).clamp(0.0, size - 1.0) as u32;
        (chart, [texel(cos, width), texel(sin, height)])
    }

    /// What the front disc has at an angle, the back one has at the angle mirrored left to right.
    fn two_rims(&mut self) {
        for [cos, sin] in angles() {
            let front = [1.0, 3.0].map(|steps| self.in_disc(0, [cos, sin], steps));
            let back = [1.0, 3.0].map(|steps| self.in_disc(1, [-cos, sin], steps));
            self.count(front, back);
        }
    }

    /// The whole rim is one direction, so what lies opposite is near.
    fn one_rim(&mut self) {
        for [cos, sin] in angles() {
            let here = [1.0, 3.0].map(|steps| self.in_disc(0, [cos, sin], steps));
            let opposite = [1.0, 3.0].map(|steps| self.in_disc(0, [-cos, -sin], steps));
            self.count(here, opposite);
        }
    }
}

/// Directions round a rim, x to the right, y down.
fn angles() -> impl Iterator<Item = [f64; 2]> {
    (0..MOST_ALONG).map(|i| {
        let (sin, cos) = (f64::from(i) / f64::from(MOST_ALONG) * TAU).sin_cos();
        [cos, sin]
    })
}
