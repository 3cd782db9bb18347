//! Bilinear lookups of many texels at once, from bytes to bytes or from floats to floats: places, light and samples in one.
//!
//! All four taps are mixed without asking whether they lie on the chart. Texels whose taps do not are found again one by one with
//! the gutter.

use pulp::NullaryFnOnce;

use super::encode::Encoder;
use super::filter::Sampler;
use super::lane_places::{LanePlaces, LaneScratch, PlaceLanes};
use super::prefetch::prefetch;
use super::stored::Stored;
use super::strips::{Kernel, Patch, Run, Scratch};
use super::texels::Strides;
use crate::imaging::EnvironmentMap;
use crate::mapping::LANES;

/// Samples a pixel: opacity goes the general way.
const RGB: usize = 3;

/// Samples that are read at once: those of two neighbours, and two more that fill a register.
const LOAD: usize = 2 * RGB + 2;

/// Samples of a neighbour in a register of its own: a pixel, and one more.
const TAP: usize = RGB + 1;

/// What comes from memory at once, on all processors that are common.
const CACHE_LINE_BYTES: usize = 64;

/// How many rows beside its own a block asks for: fewer come late, more are forgotten again.
const ROWS_AHEAD: usize = 4;

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

/// The places of [`LANES`] texels, found in the source.
#[repr(align(64))]
struct Block {
    places: PlaceLanes,
    /// The chart of all places, when there is but one.
    chart: Option<u32>,
    /// Where the samples of each begin; 0 where its taps leave the chart.
    starts: [u32; LANES],
    /// 1 for those whose taps do.
    off: [u32; LANES],
    has_off: bool,
}

impl Default for Block {
    fn default() -> Self {
        Self {
            places: PlaceLanes::default(),
            chart: None,
            starts: [0; LANES],
            off: [0; LANES],
            has_off: false,
        }
    }
}

impl<'a, S> Chart<'a, S> {
    /// Hands over the samples of the four taps of a place.
    ///
    /// Both slices are equally long, so that one comparison serves both, for the compiler too where it sees how they were made.
    #[inline(always)]
    fn take<M: Mixing<S>>([above, under]: [&'a [S]; 2], mixing: &mut M, block: &Block, k: usize) {
        let (at, places) = (block.starts[k] as usize, &block.places);
        if let (Some(above), Some(under)) = (above.get(at..at + LOAD), under.get(at..at + LOAD))
            && let (Some(above), Some(under)) = (above.first_chunk(), under.first_chunk())
        {
            mixing.take(k, [above, under], places.right[k], places.below[k]);
        }
    }

    /// The samples, and those from a row below on.
    #[inline(always)]
    fn rows(&self) -> [&'a [S]; 2] {
        let under = self.samples.get(self.down as usize..).unwrap_or_default();
        [&self.samples[..under.len()], under]
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

    /// Finds where the samples of a block's places begin, and asks for the memory that the rows beside it will need.
    #[inline(always)]
    fn locate(&self, block: &mut Block) {
        let places = &block.places;
        let first = places.chart[0];
        let mut difference = 0;
        for chart in &places.chart {
            difference |= chart ^ first;
        }
        block.chart = (difference == 0).then_some(first);
        if let Some(chart) = block.chart {
            let chart = self.chart(chart);
            for k in 0..LANES {
                let (column, row) = (places.column[k], places.row[k]);
                (block.starts[k], block.off[k]) = self.at(chart, column, row);
            }
        } else {
            // Charts meet in few blocks.
            for k in 0..LANES {
                let (column, row) = (places.column[k], places.row[k]);
                (block.starts[k], block.off[k]) = self.at(self.chart(places.chart[k]), column, row);
            }
        }
        block.has_off = block.off.iter().fold(0, |any, off| any | off) != 0;
        // Neighbours may lie in rows of their own: each fourth stands for those that share a line with it.
        for k in (0..LANES).step_by(4) {
            let chart = self.chart(places.chart[k]);
            let (at, down) = (block.starts[k] as usize, chart.down as usize);
            prefetch(chart.samples, at);
            prefetch(chart.samples, at.wrapping_add(down));
        }
        for k in (0..LANES).step_by(CACHE_LINE_BYTES / (RGB * size_of::<S>())) {
            let chart = self.chart(places.chart[k]);
            let (at, ahead) = (block.starts[k] as usize, ROWS_AHEAD * chart.down as usize);
            prefetch(chart.samples, at.wrapping_add(ahead));
            prefetch(chart.samples, at.wrapping_sub(ahead));
        }
    }

    #[inline(always)]
    fn chart(&self, index: u32) -> &Chart<'a, S> {
        &self.charts[index as usize % MOST_CHARTS]
    }

    /// Where the samples of a place begin, and 0; (0, 1) where its taps leave the chart.
    #[inline(always)]
    fn at(&self, chart: &Chart<'a, S>, column: i32, row: i32) -> (u32, u32) {
        let [last_column, last_row] = self.last;
        // Negative numbers become too large ones.
        let (column, row) = (column as u32, row as u32);
        let at = chart
            .base
            .wrapping_add(row.wrapping_mul(chart.down))
            .wrapping_add(column.wrapping_mul(RGB as u32));
        let is_on = (column < last_column) & (row < last_row) & (at < chart.end);
        if is_on { (at, 0) } else { (0, 1) }
    }

    /// Hands the samples at a block's places to `mixing`.
    #[inline(always)]
    fn load<M: Mixing<S>>(&self, block: &Block, mixing: &mut M) {
        if let Some(chart) = block.chart {
            let rows = self.chart(chart).rows();
            for k in 0..LANES {
                Chart::take::<M>(rows, mixing, block, k);
            }
        } else {
            for k in 0..LANES {
                let rows = self.chart(block.places.chart[k]).rows();
                Chart::take::<M>(rows, mixing, block, k);
            }
        }
    }

    fn run<M: Mixing<S>, const ROUNDS: bool>(
        &self,
        patch: &Patch,
        scratch: &mut Scratch,
        out: &mut [S],
        mixing: M,
    ) {
        self.places.isa.run(Work::<_, _, ROUNDS> {
            kernel: self,
            patch,
            scratch,
            out,
            mixing,
        });
    }

    /// Finds the marked texels again, with the gutter.
    #[cold]
    #[inline(never)]
    fn mend(&self, run: &Run, block: &Block, scratch: &mut Scratch, out: &mut [S]) {
        let Scratch { lookups, pixels } = scratch;
        let texels = out.len() / RGB;
        let marked = || (0..texels).filter(|k| block.off[*k] != 0);
        let places = &block.places;
        lookups.resize(marked().count());
        for (index, k) in marked().enumerate() {
            lookups.chart[index] = places.chart[k];
            (lookups.column[index], lookups.row[index]) = (places.column[k], places.row[k]);
            (lookups.right[index], lookups.below[index]) = (places.right[k], places.below[k]);
        }
        pixels.resize(lookups.chart.len(), [0.0; 4]);
        self.sampler.sample(lookups, pixels);
        for (pixel, k) in pixels.chunks(1).zip(marked()) {
            let column = run.columns.start + k as u32;
            let texel = Run {
                columns: column..column + 1,
                ..run.clone()
            };
            self.encoder
                .write(&texel, pixel, &mut out[RGB * k..RGB * (k + 1)]);
        }
    }
}

/// A patch, compiled for a set of instructions.
struct Work<'k, 'a, 'o, S, M, const ROUNDS: bool> {
    kernel: &'k Fused<'a, S>,
    patch: &'k Patch,
    scratch: &'o mut Scratch,
    out: &'o mut [S],
    mixing: M,
}

/// What becomes of the samples at the places of a block.
trait Mixing<S> {
    /// The texel at a place and the one to its right, and those of the row below.
    fn take(&mut self, k: usize, rows: [&[S; LOAD]; 2], right: f32, below: f32);

    /// The block's samples, pixel after pixel; what was not taken is left over from before.
    fn finish(&mut self, places: &PlaceLanes) -> &[S; LANES * RGB];
}

impl<S: Stored, M: Mixing<S>, const ROUNDS: bool> NullaryFnOnce for Work<'_, '_, '_, S, M, ROUNDS> {
    type Output = ();

    #[inline(always)]
    fn call(mut self) {
        let (kernel, patch) = (self.kernel, self.patch);
        let mut scratch = LaneScratch::default();
        let [mut now, mut next] = [&mut Block::default(), &mut Block::default()];
        // Block after block down the rows: what one row needs of the source, the next needs still, and it is a short way off.
        let rows = patch.rows.len();
        let count = rows * patch.columns.len().div_ceil(LANES);
        for index in 0..=count {
            // One block ahead, so that its memory is asked for early.
            if index < count {
                let run = patch.run(index % rows, index / rows * LANES);
                let places = &mut next.places;
                kernel.places.fill_lanes::<ROUNDS>(
                    run.chart,
                    run.row,
                    run.columns.start,
                    &mut scratch,
                    places,
                );
                kernel.locate(next);
                // Of the target, too: rows are too far apart for the processor to foresee where it will be written.
                let at = patch.at(index % rows) + index / rows * (LANES * RGB);
                for line in (0..LANES * RGB).step_by(CACHE_LINE_BYTES / size_of::<S>()) {
                    prefetch(self.out, at + line);
                }
            }
            if let Some(index) = index.checked_sub(1) {
                kernel.load::<M>(now, &mut self.mixing);
                let mixed = self.mixing.finish(&now.places);
                let (row, column) = (index % rows, index / rows * LANES);
                let at = patch.at(row) + column * RGB;
                let samples = mixed.len().min(patch.samples - column * RGB);
                let out = &mut self.out[at..at + samples];
                out.copy_from_slice(&mixed[..samples]);
                if now.has_off {
                    let run = patch.run(row, column);
                    kernel.mend(&run, now, self.scratch, out);
                }
            }
            std::mem::swap(&mut now, &mut next);
        }
    }
}

/// Between two samples; the same where they are alike.
#[inline(always)]
fn mix(from: f32, to: f32, share: f32) -> f32 {
    from + (to - from) * share
}

/// Where a byte lies in the fraction of a float of [1, 2).
const FRACTION: u32 = 15;

/// Bits moved from one place to another.
#[inline(always)]
const fn moved(bits: u32, from: u32, to: u32) -> u32 {
    if from < to {
        bits << (to - from)
    } else {
        bits >> (from - to)
    }
}

/// Bytes: mixed as floats, rounded to the nearest; off by half a step and 1e-4.
#[repr(align(64))]
struct Bytes {
    /// Two pixels, and two bytes more, of each of both rows, in halves.
    found: [[u32; 4]; LANES],
    /// The same, each half for itself: a loop over numbers of one size is as wide as vectors are.
    halves: [[u32; LANES]; 4],
    packed: [u32; LANES],
    mixed: [u8; LANES * RGB],
}

impl Bytes {
    const fn new() -> Self {
        Self {
            found: [[0; 4]; LANES],
            halves: [[0; LANES]; 4],
            packed: [0; LANES],
            mixed: [0; LANES * RGB],
        }
    }
}

impl Mixing<u8> for Bytes {
    #[inline(always)]
    fn take(&mut self, k: usize, [above, under]: [&[u8; LOAD]; 2], _: f32, _: f32) {
        let [above, under] = [u64::from_le_bytes(*above), u64::from_le_bytes(*under)];
        self.found[k] = [above, above >> 32, under, under >> 32].map(|half| half as u32);
    }

    #[inline(always)]
    fn finish(&mut self, places: &PlaceLanes) -> &[u8; LANES * RGB] {
        // As 1 + byte/256: put where the fraction's upper bits are, 15 of which are left below, it need not be converted.
        let byte = |row: [u32; 2], index: usize| {
            let (half, from) = (row[index / 4], 8 * (index % 4) as u32);
            f32::from_bits(moved(half, from, FRACTION) & (255 << FRACTION) | 1.0_f32.to_bits())
        };
        for k in 0..LANES {
            for (half, found) in self.halves.iter_mut().zip(self.found[k]) {
                half[k] = found;
            }
        }
        let [above_a, above_b, under_a, under_b] = &self.halves;
        for k in 0..LANES {
            let (right, below) = (places.right[k], places.below[k]);
            let (above, under) = ([above_a[k], above_b[k]], [under_a[k], under_b[k]]);
            let mut pixel = 0;
            for channel in 0..RGB {
                let (a, b) = (byte(above, channel), byte(above, RGB + channel));
                let (c, d) = (byte(under, channel), byte(under, RGB + channel));
                let (a, c) = (mix(a, b, right), mix(c, d, right));
                let mixed = mix(a, c, below);
                let rounded = (mixed.to_bits() + (1 << (FRACTION - 1))) & (255 << FRACTION);
                pixel |= moved(rounded, FRACTION, 8 * channel as u32);
            }
            self.packed[k] = pixel;
        }
        // Four bytes at once, of which the next pixel writes over the fourth.
        for k in 0..LANES - 1 {
            self.mixed[RGB * k..RGB * k + 4].copy_from_slice(&self.packed[k].to_le_bytes());
        }
        let last = self.packed[LANES - 1].to_le_bytes();
        self.mixed[RGB * (LANES - 1)..].copy_from_slice(&last[..RGB]);
        &self.mixed
    }
}

/// Floats.
#[repr(align(64))]
struct Floats {
    /// With room for the fourth number of the last pixel.
    mixed: [f32; LANES * RGB + 1],
}

impl Floats {
    const fn new() -> Self {
        Self {
            mixed: [0.0; LANES * RGB + 1],
        }
    }
}

impl Mixing<f32> for Floats {
    #[inline(always)]
    fn take(&mut self, k: usize, [above, under]: [&[f32; LOAD]; 2], right: f32, below: f32) {
        // Four numbers at once, of which the next pixel writes over the fourth.
        let mut pixel = [0.0; TAP];
        for i in 0..TAP {
            let above = mix(above[i], above[RGB + i], right);
            let under = mix(under[i], under[RGB + i], right);
            pixel[i] = mix(above, under, below);
        }
        self.mixed[RGB * k..RGB * k + 4].copy_from_slice(&pixel);
    }

    #[inline(always)]
    fn finish(&mut self, _: &PlaceLanes) -> &[f32; LANES * RGB] {
        self.mixed.first_chunk().unwrap_or(&[0.0; LANES * RGB])
    }
}

/// All but the mixing, which depends on the type.
macro_rules! kernel {
    ($type:ty, $mixing:ident) => {
        impl Kernel<$type> for Fused<'_, $type> {
            fn write(&self, run: &Run, scratch: &mut Scratch, out: &mut [$type]) {
                let row = Patch {
                    chart: run.chart,
                    rows: run.row..run.row + 1,
                    columns: run.columns.clone(),
                    samples: out.len(),
                    first: 0,
                    down: 0,
                };
                self.write_patch(&row, scratch, out);
            }

            fn write_patch(&self, patch: &Patch, scratch: &mut Scratch, out: &mut [$type]) {
                if self.places.rounds() {
                    self.run::<_, true>(patch, scratch, out, $mixing::new());
                } else {
                    self.run::<_, false>(patch, scratch, out, $mixing::new());
                }
            }
        }
    };
}
kernel!(u8, Bytes);
kernel!(f32, Floats);
