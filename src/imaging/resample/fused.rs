//! Bilinear lookups of many texels at once, from bytes to bytes or from floats to floats: places, light and samples in one.
//!
//! Both neighbours of a row come with one load, and all four taps are mixed without asking whether they lie on the chart. Texels
//! whose taps do not are found again one by one with the gutter.

#![expect(
    clippy::needless_range_loop,
    reason = "a lane is an index into several lists at once"
)]

use pulp::NullaryFnOnce;

use super::encode::Encoder;
use super::filter::Sampler;
use super::lane_places::{LanePlaces, LaneScratch, PlaceLanes};
use super::lookups::Lookups;
use super::stored::Stored;
use super::strips::{Kernel, Run, Scratch};
use super::texels::{Pixel, Strides};
use crate::imaging::EnvironmentMap;
use crate::mapping::LANES;
use crate::math::nearest_whole;

/// Samples a pixel: opacity goes the general way.
const RGB: usize = 3;

/// Samples that a load takes: two neighbours, and two more that fill the register.
const LOAD: usize = 8;

/// The charts of a source, upright, as the loop finds them: more than any mapping has, so that an index is masked, not checked.
const MOST_CHARTS: usize = 16;

#[derive(Clone, Copy)]
struct Chart<'a, S> {
    samples: &'a [S],
    base: u32,
    down: u32,
    /// Places that begin before it have both rows' samples.
    end: u32,
}

/// Hands over the samples of both rows from `at` on.
#[inline(always)]
fn take<S, M: Mixing<S>>(
    mixing: &mut M,
    chart: &Chart<'_, S>,
    at: u32,
    k: usize,
    places: &PlaceLanes,
) {
    let at = at as usize;
    let first = chart.samples.get(at..at + LOAD);
    let below = at + chart.down as usize;
    let second = chart.samples.get(below..below + LOAD);
    if let (Some(first), Some(second)) = (first, second)
        && let (Some(first), Some(second)) = (first.first_chunk(), second.first_chunk())
    {
        mixing.take(k, first, second, places.right[k], places.below[k]);
    }
}

/// The kernel for samples of type `S`.
pub(super) struct Fused<'a, S> {
    places: &'a LanePlaces,
    charts: [Chart<'a, S>; MOST_CHARTS],
    /// Columns and rows less one: the last texel that has a neighbour.
    last: [u32; 2],
    sampler: &'a dyn Sampler,
    encoder: Encoder,
}

impl<'a, S: Stored> Fused<'a, S> {
    /// `None` where the source's charts do not lie upright or one is missing.
    pub fn new(
        places: &'a LanePlaces,
        source: &'a EnvironmentMap,
        sampler: &'a dyn Sampler,
        encoder: Encoder,
    ) -> Option<Self> {
        let shape = source.shape();
        let nothing = Chart {
            samples: &[],
            base: 0,
            down: 0,
            end: 0,
        };
        let mut charts = [nothing; MOST_CHARTS];
        for (chart, placement) in shape.charts.iter().enumerate() {
            let placement = placement.as_ref()?;
            let raster = &source.rasters()[placement.raster];
            let strides = Strides::of(placement, shape, raster.width());
            if strides.right != RGB as isize {
                return None;
            }
            let samples = S::slice(raster.samples())?;
            let down = u32::try_from(strides.down).ok()?;
            let end = samples.len().saturating_sub(down as usize + LOAD - 1);
            *charts.get_mut(chart)? = Chart {
                samples,
                base: u32::try_from(strides.base).ok()?,
                down,
                // Counted in 32 bits: a larger picture goes the general way.
                end: u32::try_from(samples.len()).ok().map(|_| end as u32)?,
            };
        }
        Some(Self {
            places,
            charts,
            last: shape.size.map(|n| n - 1),
            sampler,
            encoder,
        })
    }

    /// Hands the samples of both rows at each place to `mixing`. Returns whether any place has taps off its chart; those are
    /// marked.
    #[inline(always)]
    fn load<M: Mixing<S>>(
        &self,
        places: &PlaceLanes,
        mixing: &mut M,
        is_off: &mut [bool; LANES],
    ) -> bool {
        let first = places.chart[0];
        let mut difference = 0;
        for chart in &places.chart {
            difference |= chart ^ first;
        }
        if difference == 0 {
            let chart = &self.charts[first as usize % MOST_CHARTS];
            return self.load_from(chart, places, mixing, is_off);
        }
        // Charts meet in few blocks: each is asked for its lanes, and a lane counts where its own chart has it.
        let mut any = false;
        for k in 0..LANES {
            let chart = &self.charts[places.chart[k] as usize % MOST_CHARTS];
            let (at, is_on) = self.at(chart, places.column[k], places.row[k]);
            is_off[k] = !is_on;
            any |= !is_on;
            if is_on {
                take(mixing, chart, at, k, places);
            }
        }
        any
    }

    /// Where the samples of a place begin; 0 where its taps leave the chart.
    #[inline(always)]
    fn at(&self, chart: &Chart<'a, S>, column: i32, row: i32) -> (u32, bool) {
        let [last_column, last_row] = self.last;
        // Negative numbers become too large ones.
        let (column, row) = (column as u32, row as u32);
        let at = chart
            .base
            .wrapping_add(row.wrapping_mul(chart.down))
            .wrapping_add(column.wrapping_mul(RGB as u32));
        let is_on = (column < last_column) & (row < last_row) & (at < chart.end);
        (if is_on { at } else { 0 }, is_on)
    }

    #[inline(always)]
    fn load_from<M: Mixing<S>>(
        &self,
        chart: &Chart<'a, S>,
        places: &PlaceLanes,
        mixing: &mut M,
        is_off: &mut [bool; LANES],
    ) -> bool {
        let mut starts = [0_u32; LANES];
        let mut off = [0_u32; LANES];
        let mut any = 0;
        for k in 0..LANES {
            let (at, is_on) = self.at(chart, places.column[k], places.row[k]);
            starts[k] = at;
            off[k] = u32::from(!is_on);
            any |= off[k];
        }
        for k in 0..LANES {
            take(mixing, chart, starts[k], k, places);
        }
        if any != 0 {
            *is_off = off.map(|off| off != 0);
        }
        any != 0
    }

    /// Finds the marked texels again, one by one.
    #[cold]
    #[inline(never)]
    fn mend(
        &self,
        run: &Run,
        first: usize,
        scratch: &LaneScratch,
        is_off: &[bool; LANES],
        out: &mut [S],
    ) {
        let places = &scratch.places;
        let mut lookups = Lookups::default();
        lookups.resize(1);
        for (k, out) in out.chunks_exact_mut(RGB).enumerate() {
            if !is_off[k] {
                continue;
            }
            lookups.chart[0] = places.chart[k];
            (lookups.column[0], lookups.row[0]) = (places.column[k], places.row[k]);
            (lookups.right[0], lookups.below[0]) = (places.right[k], places.below[k]);
            let mut light: [Pixel; 1] = [[0.0; 4]];
            self.sampler.sample(&lookups, &mut light);
            let column = run.columns.start + (first + k) as u32;
            let texel = Run {
                columns: column..column + 1,
                ..run.clone()
            };
            self.encoder.write(&texel, &light, out);
        }
    }
}

/// One run, compiled for a set of instructions.
struct Rows<'k, 'a, 'o, S, M> {
    kernel: &'k Fused<'a, S>,
    run: &'k Run,
    out: &'o mut [S],
    mixing: M,
}

/// What becomes of the samples at the places of a block.
trait Mixing<S> {
    /// The samples of the texel at a place and of those to its right, and of the row below.
    fn take(&mut self, k: usize, above: &[S; LOAD], under: &[S; LOAD], right: f32, below: f32);

    /// The block's samples, pixel after pixel; what was not taken is left over from before.
    fn finish(&mut self, places: &PlaceLanes) -> &[S];
}

impl<S: Stored, M: Mixing<S>> NullaryFnOnce for Rows<'_, '_, '_, S, M> {
    type Output = ();

    #[inline(always)]
    fn call(mut self) {
        let (kernel, run) = (self.kernel, self.run);
        let mut scratch = LaneScratch::default();
        let mut is_off = [false; LANES];
        for (index, out) in self.out.chunks_mut(LANES * RGB).enumerate() {
            let first = index * LANES;
            let column = run.columns.start + first as u32;
            kernel
                .places
                .fill_lanes(run.chart, run.row, column, &mut scratch);
            let any = kernel.load(&scratch.places, &mut self.mixing, &mut is_off);
            let mixed = self.mixing.finish(&scratch.places);
            out.copy_from_slice(&mixed[..out.len()]);
            if any {
                kernel.mend(run, first, &scratch, &is_off, out);
            }
        }
    }
}

/// Bytes: mixed as floats, rounded to the nearest; off by half a step and 1e-4.
struct Bytes {
    above: [u64; LANES],
    under: [u64; LANES],
    mixed: [u8; LANES * RGB],
}

impl Mixing<u8> for Bytes {
    #[inline(always)]
    fn take(&mut self, k: usize, above: &[u8; LOAD], under: &[u8; LOAD], _: f32, _: f32) {
        self.above[k] = u64::from_le_bytes(*above);
        self.under[k] = u64::from_le_bytes(*under);
    }

    #[inline(always)]
    fn finish(&mut self, places: &PlaceLanes) -> &[u8] {
        let byte = |word: u64, index: usize| ((word >> (8 * index)) as u32 & 255) as i32 as f32;
        let mut packed = [0_u32; LANES];
        for k in 0..LANES {
            let mut pixel = 0;
            for channel in 0..RGB {
                let next = channel + RGB;
                let (a, b) = (byte(self.above[k], channel), byte(self.above[k], next));
                let (c, d) = (byte(self.under[k], channel), byte(self.under[k], next));
                let (a, c) = (a + (b - a) * places.right[k], c + (d - c) * places.right[k]);
                let mixed = a + (c - a) * places.below[k];
                pixel |= (nearest_whole(mixed) as u32) << (8 * channel);
            }
            packed[k] = pixel;
        }
        // Four bytes at once, of which the next pixel writes over the fourth.
        for k in 0..LANES - 1 {
            self.mixed[RGB * k..RGB * k + 4].copy_from_slice(&packed[k].to_le_bytes());
        }
        let last = packed[LANES - 1].to_le_bytes();
        self.mixed[RGB * (LANES - 1)..].copy_from_slice(&last[..RGB]);
        &self.mixed
    }
}

/// Floats.
struct Floats {
    /// With room for the fourth number of the last pixel.
    mixed: [f32; LANES * RGB + 1],
}

impl Mixing<f32> for Floats {
    #[inline(always)]
    fn take(&mut self, k: usize, above: &[f32; LOAD], under: &[f32; LOAD], right: f32, below: f32) {
        let mut column = [0.0; LOAD];
        for c in 0..LOAD {
            column[c] = above[c] + (under[c] - above[c]) * below;
        }
        // Four numbers at once, of which the next pixel writes over the fourth.
        let mut pixel = [0.0; RGB + 1];
        for c in 0..RGB + 1 {
            pixel[c] = column[c] + (column[c + RGB] - column[c]) * right;
        }
        self.mixed[RGB * k..RGB * k + 4].copy_from_slice(&pixel);
    }

    #[inline(always)]
    fn finish(&mut self, _: &PlaceLanes) -> &[f32] {
        &self.mixed
    }
}

impl Kernel<u8> for Fused<'_, u8> {
    fn write(&self, run: &Run, _: &mut Scratch, out: &mut [u8]) {
        self.places.isa.run(Rows {
            kernel: self,
            run,
            out,
            mixing: Bytes {
                above: [0; LANES],
                under: [0; LANES],
                mixed: [0; LANES * RGB],
            },
        });
    }
}

impl Kernel<f32> for Fused<'_, f32> {
    fn write(&self, run: &Run, _: &mut Scratch, out: &mut [f32]) {
        self.places.isa.run(Rows {
            kernel: self,
            run,
            out,
            mixing: Floats {
                mixed: [0.0; LANES * RGB + 1],
            },
        });
    }
}
