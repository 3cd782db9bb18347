//! Fills the target's pictures strip by strip, on all threads.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::ResampleError;
use super::lookups::Lookups;
use super::stored::Stored;
use super::texels::{Pixel, Strides};
use crate::imaging::{EnvironmentMap, MapShape, Progress};

/// A run of texels of the target.
#[derive(Clone, Debug)]
pub(super) struct Run {
    pub chart: u32,
    pub row: u32,
    pub columns: Range<u32>,
}

/// Some rows of a chart that lies upright in its picture.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    pub chart: u32,
    pub rows: Range<u32>,
    pub columns: Range<u32>,
    /// Samples in a row.
    pub samples: usize,
    /// The first row's first sample.
    pub first: usize,
    /// Samples from one row to the next.
    pub down: isize,
}

impl Patch {
    /// A row, counted from the patch's first, from a column on that is counted so too.
    #[inline(always)]
    pub fn run(&self, row: usize, column: usize) -> Run {
        Run {
            chart: self.chart,
            row: self.rows.start + row as u32,
            columns: self.columns.start + column as u32..self.columns.end,
        }
    }

    /// The first sample of a row, counted from the patch's first.
    #[inline(always)]
    pub fn at(&self, index: usize) -> usize {
        self.first.wrapping_add_signed(self.down * index as isize)
    }
}

/// What a thread keeps from run to run.
#[derive(Default)]
pub(super) struct Scratch {
    pub lookups: Lookups,
    pub pixels: Vec<Pixel>,
}

/// Makes the samples of runs of target texels: places, light and encoding in one. The general one is put together from the
/// three; a faster one may do them at once.
pub(super) trait Kernel<T>: Sync {
    /// Writes the run's samples, pixel after pixel.
    fn write(&self, run: &Run, scratch: &mut Scratch, out: &mut [T]);

    /// Writes a patch, in whatever order suits.
    fn write_patch(&self, patch: &Patch, scratch: &mut Scratch, out: &mut [T]) {
        for row in 0..patch.rows.len() {
            let at = patch.at(row);
            self.write(
                &patch.run(row, 0),
                scratch,
                &mut out[at..at + patch.samples],
            );
        }
    }
}

/// Rows of a picture that a thread takes at once: enough that taking costs nothing, few enough that all threads end together.
const STRIP_ROWS: u32 = 16;

/// Rows of a picture, all of them or some.
struct Strip<'a, T> {
    raster: usize,
    rows: Range<u32>,
    samples: &'a mut [T],
}

/// The part of a chart that lies in a strip.
fn part(shape: &MapShape, chart: usize, strip: &Range<u32>) -> Option<[Range<u32>; 2]> {
    let placement = shape.charts[chart].as_ref()?;
    let [_, height] = placement.turn.turned(shape.size);
    let top = placement.origin[1];
    let rows = strip.start.max(top)..strip.end.min(top + height);
    if rows.is_empty() {
        return None;
    }
    // The cell's rows are rows of the chart or, after odd quarter turns, its columns, from either end.
    let back = placement.turn.inverse();
    let cell_size = placement.turn.turned(shape.size);
    let first = back.cell_from_chart([0, rows.start - top], cell_size);
    let last = back.cell_from_chart([cell_size[0] - 1, rows.end - 1 - top], cell_size);
    Some([0, 1].map(|side| first[side].min(last[side])..first[side].max(last[side]) + 1))
}

/// Writes every chart of the target that is there. Other pixels are left as they are.
///
/// # Errors
/// When it is cancelled.
pub(super) fn fill<T: Stored>(
    target: &mut EnvironmentMap,
    kernel: &dyn Kernel<T>,
    threads: &Threads,
    progress: &Progress,
) -> Result<(), ResampleError> {
    let shape = target.shape().clone();
    let count = shape.channels.count();
    let mut strips = Vec::new();
    for (raster, picture) in target.rasters_mut().iter_mut().enumerate() {
        let [width, height] = picture.size();
        let Some(samples) = T::slice_mut(picture.samples_mut()) else {
            continue;
        };
        let strip_samples = STRIP_ROWS as usize * width as usize * count;
        for (index, samples) in samples.chunks_mut(strip_samples).enumerate() {
            let first = index as u32 * STRIP_ROWS;
            strips.push(Strip {
                raster,
                rows: first..height.min(first + STRIP_ROWS),
                samples,
            });
        }
    }
    let total = strips.len();
    let done = AtomicUsize::new(0);
    threads.run(|is_alone| {
        let work = |(scratch, turned): &mut (Scratch, Vec<T>), mut strip: Strip<'_, T>| {
            if progress.is_cancelled() {
                return Err(ResampleError::Cancelled);
            }
            fill_strip(&shape, kernel, &mut strip, scratch, turned);
            progress.step(done.fetch_add(1, Ordering::Relaxed) + 1, total);
            Ok(())
        };
        if is_alone {
            let mut scratch = Default::default();
            strips
                .into_iter()
                .try_for_each(|strip| work(&mut scratch, strip))
        } else {
            strips
                .into_par_iter()
                .try_for_each_init(Default::default, work)
        }
    })
}

fn fill_strip<T: Stored>(
    shape: &MapShape,
    kernel: &dyn Kernel<T>,
    strip: &mut Strip<'_, T>,
    scratch: &mut Scratch,
    turned: &mut Vec<T>,
) {
    let count = shape.channels.count();
    let width = strip.samples.len() / (strip.rows.len() * count);
    for (chart, placement) in shape.charts.iter().enumerate() {
        let Some(placement) = placement.as_ref().filter(|p| p.raster == strip.raster) else {
            continue;
        };
        let Some([columns, rows]) = part(shape, chart, &strip.rows) else {
            continue;
        };
        let strides = Strides::of(placement, shape, width as u32);
        let above = strip.rows.start as usize * width * count;
        let samples = columns.len() * count;
        if strides.right == count as isize {
            let patch = Patch {
                chart: chart as u32,
                first: strides.at(columns.start as i32, rows.start as i32) - above,
                rows,
                columns,
                samples,
                down: strides.down,
            };
            kernel.write_patch(&patch, scratch, strip.samples);
            continue;
        }
        turned.resize(samples, T::default());
        for row in rows {
            let run = Run {
                chart: chart as u32,
                row,
                columns: columns.clone(),
            };
            let mut at = strides.at(columns.start as i32, row as i32) - above;
            kernel.write(&run, scratch, turned);
            for pixel in turned.chunks_exact(count) {
                strip.samples[at..at + count].copy_from_slice(pixel);
                at = at.wrapping_add_signed(strides.right);
            }
        }
    }
}

/// The threads that a plan's runs use.
#[derive(Clone, Debug)]
pub(super) enum Threads {
    /// The caller's own, alone.
    One,
    /// As many as there are cores, shared with all other work.
    Shared,
    /// A pool of its own.
    Own(std::sync::Arc<rayon::ThreadPool>),
}

impl Threads {
    /// `count` threads; 0: as many as there are cores. Where the system gives none, the caller's own.
    pub fn new(count: usize) -> Self {
        match count {
            0 => Self::Shared,
            1 => Self::One,
            _ => rayon::ThreadPoolBuilder::new()
                .num_threads(count)
                .build()
                .map_or(Self::One, |pool| Self::Own(std::sync::Arc::new(pool))),
        }
    }

    pub fn count(&self) -> usize {
        match self {
            Self::One => 1,
            Self::Shared => rayon::current_num_threads(),
            Self::Own(pool) => pool.current_num_threads(),
        }
    }

    /// Puts at each index of a list what `value` says of it.
    pub fn fill_each<T: Send>(&self, list: &mut [T], value: impl Fn(usize) -> T + Sync) {
        /// Indices that a thread takes at once.
        const MANY: usize = 256;
        let fill = |(part, list): (usize, &mut [T])| {
            for (index, item) in (part * MANY..).zip(list) {
                *item = value(index);
            }
        };
        self.run(|is_alone| {
            if is_alone {
                list.chunks_mut(MANY).enumerate().for_each(fill);
            } else {
                list.par_chunks_mut(MANY).enumerate().for_each(fill);
            }
        });
    }

    /// Runs `work`, which is told whether it is alone.
    fn run<R: Send>(&self, work: impl FnOnce(bool) -> R + Send) -> R {
        match self {
            Self::One => work(true),
            Self::Shared => work(false),
            Self::Own(pool) => pool.install(|| work(false)),
        }
    }
}
