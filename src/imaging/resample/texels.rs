//! The source's texels where they lie, and the light of the gutter around them.

use std::sync::Mutex;

use super::filter::Mix;
use super::gutter::{Gutter, Slot};
use super::prefetch::prefetch;
use super::stored::{Decoder, Stored};
use super::strips::Threads;
use crate::imaging::{EnvironmentMap, MapShape, Placement};

/// Where the pixels of a chart lie in a picture: sample 0 of the pixel of texel (0, 0), and the steps to the next texel to the
/// right and to the one below, all in samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Strides {
    pub raster: usize,
    pub base: isize,
    pub right: isize,
    pub down: isize,
}

impl Strides {
    pub fn of(placement: &Placement, shape: &MapShape, raster_width: u32) -> Self {
        let count = shape.channels.count() as isize;
        let offset = |[x, y]: [u32; 2]| (y as isize * raster_width as isize + x as isize) * count;
        let [x, y] = placement.turn.cell_from_chart([0, 0], shape.size);
        let base = offset([placement.origin[0] + x, placement.origin[1] + y]);
        // The steps do not depend on the size: those of 2 x 2 texels.
        let corner = |texel| offset(placement.turn.cell_from_chart(texel, [2, 2]));
        Self {
            raster: placement.raster,
            base,
            right: corner([1, 0]) - corner([0, 0]),
            down: corner([0, 1]) - corner([0, 0]),
        }
    }

    /// Sample 0 of a texel.
    pub fn at(&self, column: i32, row: i32) -> usize {
        (self.base + self.right * column as isize + self.down * row as isize) as usize
    }
}

/// Sweeps over the gutter's texels whose light depends on others': at corners a second one is needed, along rims a fourth changes
/// the sixth digit.
const SWEEPS: u32 = 4;

/// What weighs less than this in a gutter texel is left out, and where others of the gutter weigh no more together, it is not found
/// again: what they change is below a float's last digit.
const LITTLE: f32 = 1.0 / (1_u32 << 20) as f32;

/// How many gutter texels ahead their memory is asked for.
const AHEAD: usize = 16;

/// A colour to mix, and opacity. Not premultiplied.
pub(super) type Pixel = [f32; 4];

/// The source's texels, decoded as they are read. `N`: samples a pixel.
pub(super) struct Texels<'a, S, const N: usize> {
    charts: Vec<Option<(&'a [S], Strides)>>,
    decoder: Decoder,
    gutter: &'a Gutter,
    /// Light of the gutter's texels.
    light: Vec<[f32; N]>,
}

impl<'a, S: Stored, const N: usize> Texels<'a, S, N> {
    /// `is_nearest` when no light is mixed: then the gutter's texels are the nearest of the charts' own.
    pub fn new(
        map: &'a EnvironmentMap,
        decoder: Decoder,
        gutter: &'a Gutter,
        is_nearest: bool,
        threads: &Threads,
    ) -> Self {
        let shape = map.shape();
        let charts = shape.charts.iter().map(|placement| {
            let placement = placement.as_ref()?;
            let raster = &map.rasters()[placement.raster];
            let strides = Strides::of(placement, shape, raster.width());
            Some((S::slice(raster.samples())?, strides))
        });
        let mut texels = Self {
            charts: charts.collect(),
            decoder,
            gutter,
            light: Vec::new(),
        };
        texels.fill_gutter(is_nearest, threads);
        texels
    }

    fn fill_gutter(&mut self, is_nearest: bool, threads: &Threads) {
        let mut light = vec![[0.0; N]; self.gutter.len()];
        if is_nearest {
            threads.fill_each(&mut light, |index| stored(self.nearest_own(index)));
            self.light = light;
            return;
        }
        // Most lie between texels that charts own, or nearly: what they get at first is final.
        let others = Mutex::new(Vec::new());
        threads.fill_each(&mut light, |index| {
            self.foresee(index + AHEAD);
            let (light, is_final) = self.settled(index, |index| self.nearest_own(index));
            if !is_final && let Ok(mut others) = others.lock() {
                others.push(index);
            }
            stored(light)
        });
        self.light = light;
        let mut others = others.into_inner().unwrap_or_default();
        // In the same order however many threads there are.
        others.sort_unstable();
        for _ in 1..SWEEPS {
            for index in &others {
                let (light, _) = self.settled(*index, |index| self.in_gutter(index));
                self.light[*index] = stored(light);
            }
        }
    }

    /// Asks for the memory of what a gutter texel shows.
    fn foresee(&self, index: usize) {
        if index < self.gutter.len()
            && let Some((chart, [column, row])) = self.gutter.nearest_own(index)
            && let Some(Some((samples, strides))) = self.charts.get(chart as usize)
        {
            prefetch(samples, strides.at(column, row));
        }
    }

    /// The texel of a chart nearest to a gutter texel's place; black where there is none.
    fn nearest_own(&self, index: usize) -> Pixel {
        match self.gutter.nearest_own(index) {
            Some((chart, [column, row])) => self.own(chart, column, row),
            None => kept([0.0; N]),
        }
    }

    /// The light of a gutter texel, as between the four texels around its place.
    ///
    /// Just beyond a rim, the texels around that place lie just beyond the other side's rim, and theirs is this texel again.
    /// Passing light to and fro between the two would take for ever, so where a texel of the gutter comes in, its own four are
    /// put in its place, and what comes back to this texel is left out of the mean: that solves the pair. `known` says what is
    /// known so far of the others that still come in. Also tells whether they count for little.
    fn settled(&self, index: usize, known: impl Fn(usize) -> Pixel) -> (Pixel, bool) {
        let mut mix = Mix::around(known(index));
        let mut open = 0.0;
        for (part, [column, row], weight) in self.gutter.around(index) {
            match self.gutter.slot(part, column, row) {
                Slot::Own => {
                    let (chart, _) = self.gutter.chart(part);
                    mix.add(self.own(chart, column, row), weight);
                }
                Slot::Gutter(other) if other == index || weight < LITTLE => {}
                Slot::Gutter(other) => {
                    for (part, [column, row], share) in self.gutter.around(other) {
                        if weight * share < LITTLE {
                            continue;
                        }
                        let slot = self.gutter.slot(part, column, row);
                        let light = match slot {
                            Slot::Own => self.own(self.gutter.chart(part).0, column, row),
                            Slot::Gutter(third) if third == index => continue,
                            Slot::Gutter(third) => {
                                open += weight * share;
                                known(third)
                            }
                            Slot::Beyond => [0.0; 4],
                        };
                        mix.add(light, weight * share);
                    }
                }
                Slot::Beyond => {}
            }
        }
        let is_final = open <= LITTLE * mix.weight();
        (mix.mean(), is_final)
    }

    fn in_gutter(&self, index: usize) -> Pixel {
        kept(self.light[index])
    }

    #[inline]
    fn pixel(&self, samples: &[S], at: usize) -> Pixel {
        let Some(stored) = samples.get(at..at + N) else {
            return [0.0; 4];
        };
        let mut pixel = [0.0, 0.0, 0.0, 1.0];
        for (value, stored) in pixel.iter_mut().zip(&stored[..3]) {
            *value = stored.decoded(self.decoder);
        }
        if N == 4 {
            pixel[3] = stored[3].share();
        }
        pixel
    }

    /// A texel of a chart.
    #[inline]
    pub fn own(&self, chart: u32, column: i32, row: i32) -> Pixel {
        match self.charts.get(chart as usize) {
            Some(Some((samples, strides))) => self.pixel(samples, strides.at(column, row)),
            _ => [0.0; 4],
        }
    }

    /// A texel of a part or of its gutter.
    pub fn texel(&self, part: u32, column: i32, row: i32) -> Pixel {
        self.in_slot(self.gutter.slot(part, column, row), part, column, row)
    }

    fn in_slot(&self, slot: Slot, part: u32, column: i32, row: i32) -> Pixel {
        match slot {
            Slot::Own => self.own(self.gutter.chart(part).0, column, row),
            Slot::Gutter(index) => self.in_gutter(index),
            Slot::Beyond => [0.0; 4],
        }
    }

    /// The K x K texels from (`column`, `row`) on, row by row.
    pub fn block<const K: usize>(&self, part: u32, column: i32, row: i32) -> [[Pixel; K]; K] {
        let reach = K as i32;
        let mut block = [[[0.0; 4]; K]; K];
        let (chart, facet) = self.gutter.chart(part);
        if self
            .gutter
            .owns(facet, column..column + reach, row..row + reach)
        {
            let Some(Some((samples, strides))) = self.charts.get(chart as usize) else {
                return block;
            };
            let mut start =
                strides.base + strides.right * column as isize + strides.down * row as isize;
            for line in &mut block {
                let mut at = start;
                for pixel in line {
                    *pixel = self.pixel(samples, at as usize);
                    at += strides.right;
                }
                start += strides.down;
            }
            return block;
        }
        for (line, row) in block.iter_mut().zip(row..) {
            for (pixel, column) in line.iter_mut().zip(column..) {
                *pixel = self.texel(part, column, row);
            }
        }
        block
    }
}

/// What of a pixel a gutter texel keeps.
fn stored<const N: usize>(pixel: Pixel) -> [f32; N] {
    std::array::from_fn(|channel| pixel[channel])
}

/// What a gutter texel keeps, as a pixel: opaque where opacity is not kept.
fn kept<const N: usize>(light: [f32; N]) -> Pixel {
    let mut pixel = [0.0, 0.0, 0.0, 1.0];
    pixel[..N].copy_from_slice(&light);
    pixel
}
