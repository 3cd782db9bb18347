//! Bilinear lookups of many texels at once, from bytes to bytes or from floats to floats: places, light and samples in one.
//!
//! Both neighbours of a row come with one load, and all four taps are mixed without asking whether they lie on the chart. Texels
//! whose taps do not are found again one by one with the gutter.

use pulp::NullaryFnOnce;

use super::encode::Encoder;
use super::filter::Sampler;
use super::lane_places::{LanePlaces, LaneScratch};
use super::lookups::Lookups;
use super::stored::Stored;
use super::strips::{Kernel, Run, Scratch};
use super::texels::{Pixel, Strides};
use crate::imaging::EnvironmentMap;
use crate::mapping::{LANES, Lane};

/// Samples a pixel: opacity goes the general way.
const RGB: usize = 3;

/// Samples that a load takes: two neighbours, and two more that fill the register.
const LOAD: usize = 8;

/// The charts of a source, upright, as the loop finds them: more than any mapping has, so that an index is masked, not checked.
const MOST_CHARTS: usize = 16;

#[derive(Clone, Copy)]
struct Chart<'a, S> {
    samples: &'a [S],
    base: usize,
    down: usize,
}

/// The kernel for samples of type `S`.
pub(super) struct Fused<'a, S> {
    places: &'a LanePlaces,
    charts: [Chart<'a, S>; MOST_CHARTS],
    /// Columns and rows less one: the last texel that has a neighbour.
    last: [i32; 2],
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
        };
        let mut charts = [nothing; MOST_CHARTS];
        for (chart, placement) in shape.charts.iter().enumerate() {
            let placement = placement.as_ref()?;
            let raster = &source.rasters()[placement.raster];
            let strides = Strides::of(placement, shape, raster.width());
            if strides.right != RGB as isize {
                return None;
            }
            *charts.get_mut(chart)? = Chart {
                samples: S::slice(raster.samples())?,
                base: usize::try_from(strides.base).ok()?,
                down: usize::try_from(strides.down).ok()?,
            };
        }
        Some(Self {
            places,
            charts,
            last: shape.size.map(|n| n as i32 - 1),
            sampler,
            encoder,
        })
    }

    /// Both rows' samples from each place on. Returns whether any place has taps off its chart; those are marked.
    #[inline(always)]
    fn load(
        &self,
        scratch: &LaneScratch,
        above: &mut [[S; LOAD]; LANES],
        under: &mut [[S; LOAD]; LANES],
        is_off: &mut [bool; LANES],
    ) -> bool {
        let places = &scratch.places;
        let [last_column, last_row] = self.last;
        let mut any = false;
        for k in 0..LANES {
            let (column, row) = (places.column[k], places.row[k]);
            let chart = &self.charts[places.chart[k] as usize % MOST_CHARTS];
            let at = chart.base + row.max(0) as usize * chart.down + column.max(0) as usize * RGB;
            let is_on = (column >= 0) & (column < last_column) & (row >= 0) & (row < last_row);
            let first = chart.samples.get(at..).and_then(<[S]>::first_chunk);
            let second = chart
                .samples
                .get(at + chart.down..)
                .and_then(<[S]>::first_chunk);
            match (first, second) {
                (Some(first), Some(second)) if is_on => {
                    (above[k], under[k]) = (*first, *second);
                    is_off[k] = false;
                }
                _ => {
                    is_off[k] = true;
                    any = true;
                }
            }
        }
        any
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

/// One run, or the blocks of it, compiled for a set of instructions.
struct Rows<'k, 'a, 'o, S, M> {
    kernel: &'k Fused<'a, S>,
    run: &'k Run,
    out: &'o mut [S],
    mix: M,
}

/// What becomes of the two rows of samples at each place.
trait Mixing<S>: Copy {
    fn mix(
        self,
        above: &[[S; LOAD]; LANES],
        under: &[[S; LOAD]; LANES],
        right: &Lane,
        below: &Lane,
        out: &mut [[S; RGB]; LANES],
    );
}

impl<S: Stored, M: Mixing<S>> NullaryFnOnce for Rows<'_, '_, '_, S, M> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (kernel, run) = (self.kernel, self.run);
        let mut scratch = LaneScratch::default();
        let mut above = [[S::default(); LOAD]; LANES];
        let mut under = above;
        let mut is_off = [false; LANES];
        let mut mixed = [[S::default(); RGB]; LANES];
        for (index, out) in self.out.chunks_mut(LANES * RGB).enumerate() {
            let first = index * LANES;
            let column = run.columns.start + first as u32;
            kernel
                .places
                .fill_lanes(run.chart, run.row, column, &mut scratch);
            let any = kernel.load(&scratch, &mut above, &mut under, &mut is_off);
            let places = &scratch.places;
            self.mix
                .mix(&above, &under, &places.right, &places.below, &mut mixed);
            let count = out.len();
            out.copy_from_slice(&mixed.as_flattened()[..count]);
            if any {
                kernel.mend(run, first, &scratch, &is_off, out);
            }
        }
    }
}

/// Bytes: mixed as floats, rounded to the nearest; off by half a step and 1e-4.
#[derive(Clone, Copy)]
struct Bytes;

impl Mixing<u8> for Bytes {
    #[inline(always)]
    fn mix(
        self,
        above: &[[u8; LOAD]; LANES],
        under: &[[u8; LOAD]; LANES],
        right: &Lane,
        below: &Lane,
        out: &mut [[u8; RGB]; LANES],
    ) {
        let (mut upper, mut lower) = ([0_u64; LANES], [0_u64; LANES]);
        for k in 0..LANES {
            upper[k] = u64::from_le_bytes(above[k]);
            lower[k] = u64::from_le_bytes(under[k]);
        }
        let byte = |word: u64, index: usize| ((word >> (8 * index)) as u32 & 255) as i32 as f32;
        let mut packed = [0_u32; LANES];
        for channel in 0..RGB {
            for k in 0..LANES {
                let next = channel + RGB;
                let (a, b) = (byte(upper[k], channel), byte(upper[k], next));
                let (c, d) = (byte(lower[k], channel), byte(lower[k], next));
                let (a, c) = (a + (b - a) * right[k], c + (d - c) * right[k]);
                let mixed = a + (c - a) * below[k];
                packed[k] |= ((mixed + 0.5) as i32 as u32) << (8 * channel);
            }
        }
        for k in 0..LANES {
            let [r, g, b, _] = packed[k].to_le_bytes();
            out[k] = [r, g, b];
        }
    }
}

/// Floats.
#[derive(Clone, Copy)]
struct Floats;

impl Mixing<f32> for Floats {
    #[inline(always)]
    fn mix(
        self,
        above: &[[f32; LOAD]; LANES],
        under: &[[f32; LOAD]; LANES],
        right: &Lane,
        below: &Lane,
        out: &mut [[f32; RGB]; LANES],
    ) {
        for k in 0..LANES {
            let mut column = [0.0; LOAD];
            for (index, mixed) in column.iter_mut().enumerate() {
                *mixed = above[k][index] + (under[k][index] - above[k][index]) * below[k];
            }
            for channel in 0..RGB {
                let (left, next) = (column[channel], column[channel + RGB]);
                out[k][channel] = left + (next - left) * right[k];
            }
        }
    }
}

impl Kernel<u8> for Fused<'_, u8> {
    fn write(&self, run: &Run, _: &mut Scratch, out: &mut [u8]) {
        self.places.isa.run(Rows {
            kernel: self,
            run,
            out,
            mix: Bytes,
        });
    }
}

impl Kernel<f32> for Fused<'_, f32> {
    fn write(&self, run: &Run, _: &mut Scratch, out: &mut [f32]) {
        self.places.isa.run(Rows {
            kernel: self,
            run,
            out,
            mix: Floats,
        });
    }
}
