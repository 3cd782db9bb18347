//! Where on the sphere an evaluator errs: its distance from the reference in each pixel of a map's picture.

use rayon::iter::{IntoParallelIterator, ParallelIterator};
use std::sync::atomic::{AtomicUsize, Ordering};

use super::accuracy::Off;
use crate::imaging::{Progress, Stage};
use crate::mapping::{ChartPoint, DirList, MappingId, PointList, Processor};
use crate::math::{Isa, Vec3};

/// What is found in a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pixel {
    /// No direction that the mapping covers.
    Outside,
    /// A direction without a result.
    Hole,
    /// Its error in radians.
    Error(f32),
}

/// Errors over a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMap {
    /// Columns and rows.
    pub size: [usize; 2],
    /// Row after row from the top.
    pub pixels: Vec<Pixel>,
    /// The largest error in radians; 0 where there is none.
    pub max_rad: f64,
    /// The largest error in texels.
    pub max_texels: f64,
    /// The direction with the largest error in radians.
    pub worst: [f64; 3],
    /// Pixels that are holes.
    pub holes: usize,
}

/// A row of pixels and the worst of it.
struct Line {
    pixels: Vec<Pixel>,
    worst: Option<(Off, [f64; 3])>,
}

/// Compares the evaluator's chart points of `map` with the reference's, `rows` texels along a chart's height, for the direction
/// of each pixel's middle in the unfolded picture of `shown`, which has `size` columns and rows. `None` when it is cancelled.
pub fn error_map(
    map: MappingId,
    evaluator: &Processor,
    rows: u32,
    shown: MappingId,
    size: [usize; 2],
    progress: &Progress,
) -> Option<ErrorMap> {
    progress.enter(Stage::Computing);
    let done = AtomicUsize::new(0);
    let line = |y: usize| {
        if progress.is_cancelled() {
            return None;
        }
        let dirs: Vec<Option<[f32; 3]>> = (0..size[0])
            .map(|x| direction(map, shown, [x, y], size))
            .collect();
        let line = line(map, evaluator, rows, &dirs);
        progress.step(done.fetch_add(1, Ordering::Relaxed) + 1, size[1]);
        Some(line)
    };
    let lines: Option<Vec<Line>> = (0..size[1]).into_par_iter().map(line).collect();
    let lines = lines?;
    let mut found = ErrorMap {
        size,
        pixels: Vec::with_capacity(size[0] * size[1]),
        max_rad: 0.0,
        max_texels: 0.0,
        worst: [0.0; 3],
        holes: 0,
    };
    for Line { pixels, worst } in lines {
        found.holes += pixels.iter().filter(|p| **p == Pixel::Hole).count();
        found.pixels.extend(pixels);
        if let Some((off, dir)) = worst {
            if off.rad > found.max_rad {
                (found.max_rad, found.worst) = (off.rad, dir);
            }
            found.max_texels = found.max_texels.max(off.texels);
        }
    }
    Some(found)
}

/// The direction of a pixel's middle; `None` beside the charts and where `map` covers nothing.
fn direction(
    map: MappingId,
    shown: MappingId,
    pixel: [usize; 2],
    size: [usize; 2],
) -> Option<[f32; 3]> {
    let place = [0, 1].map(|k| (pixel[k] as f64 + 0.5) / size[k] as f64);
    let point: ChartPoint<f64> = shown.info().layout.chart_from_picture(place)?;
    let dir = shown.inverse(point)?.to_f64();
    let is_covered = map.info().coverage.contains(dir);
    is_covered.then(|| dir.map(|c| c as f32))
}

fn line(map: MappingId, evaluator: &Processor, rows: u32, dirs: &[Option<[f32; 3]>]) -> Line {
    let asked: DirList = dirs.iter().flatten().copied().collect();
    let mut points = PointList::zeros(asked.len());
    (evaluator.forward)(Isa::best(), asked.view(), points.view_mut());
    let points = points.view();
    let mut worst: Option<(Off, [f64; 3])> = None;
    let mut next = 0;
    let pixel = |dir: &Option<[f32; 3]>| {
        let Some(dir) = dir else {
            return Pixel::Outside;
        };
        let point = points.at(next);
        next += 1;
        let dir = dir.map(f64::from);
        let exact = map.forward(Vec3::<f64>::from_f64(dir));
        let Some(off) = exact.and_then(|exact| Off::of(map, dir, exact, point, rows)) else {
            return Pixel::Hole;
        };
        let (rad, texels) = worst.map_or((0.0, 0.0), |(worst, _)| (worst.rad, worst.texels));
        let at = match worst {
            Some((_, at)) if off.rad <= rad => at,
            _ => dir,
        };
        let largest = Off {
            rad: off.rad.max(rad),
            texels: off.texels.max(texels),
            ..off
        };
        worst = Some((largest, at));
        Pixel::Error(off.rad as f32)
    };
    let pixels = dirs.iter().map(pixel).collect();
    Line { pixels, worst }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::accuracy::ForwardTruth;

    const SIZE: [usize; 2] = [64, 32];

    fn of(map: MappingId, evaluator: &str) -> ErrorMap {
        let evaluator = map.processor(evaluator).unwrap();
        let shown = MappingId::Latlong;
        error_map(map, evaluator, 512, shown, SIZE, &Progress::new()).unwrap()
    }

    #[test]
    fn it_has_the_errors_of_its_directions() {
        let [coarse, fine] = ["atan-5", "reference"].map(|id| of(MappingId::Ccm, id));
        for found in [&coarse, &fine] {
            assert_eq!(found.pixels.len(), SIZE[0] * SIZE[1]);
            let largest = found.pixels.iter().map(|pixel| match pixel {
                Pixel::Error(rad) => f64::from(*rad),
                _ => panic!("{pixel:?} on the whole sphere"),
            });
            let largest = largest.fold(0.0, f64::max);
            assert!((largest / found.max_rad - 1.0).abs() < 1e-6);
        }
        // The largest is what the tables' own measure says of these directions.
        let dirs = (0..SIZE[0] * SIZE[1]).filter_map(|k| {
            let pixel = [k % SIZE[0], k / SIZE[0]];
            direction(MappingId::Ccm, MappingId::Latlong, pixel, SIZE)
        });
        let truth = ForwardTruth::new(MappingId::Ccm, dirs.collect());
        let mut points = PointList::zeros(truth.dirs().len());
        let evaluator = MappingId::Ccm.processor("atan-5").unwrap();
        (evaluator.forward)(Isa::best(), truth.dirs(), points.view_mut());
        let errors = truth.errors(&points, 512);
        assert_eq!(
            (coarse.max_rad, coarse.max_texels, coarse.worst),
            (errors.max_rad, errors.max_texels, errors.worst)
        );
        // Control: the reference errs by what its result is rounded by, a thousand times less.
        assert!(fine.max_rad < 1e-3 * coarse.max_rad && fine.max_rad > 0.0);
    }

    #[test]
    fn what_is_not_covered_is_outside_and_what_is_not_found_is_a_hole() {
        let matcap = of(MappingId::Matcap, "f32");
        let outside = matcap.pixels.iter().filter(|p| **p == Pixel::Outside);
        let share = outside.count() as f64 / (SIZE[0] * SIZE[1]) as f64;
        assert!((share - 0.5).abs() < 0.05, "{share}");
        assert_eq!(matcap.holes, 0);
        // Half of the sphere without a result is half of the picture without an error.
        let half = Processor {
            is_vector: false,
            forward: Box::new(|_, dirs, mut points| {
                for k in 0..dirs.len() {
                    let dir = dirs.at(k);
                    points.set(k, MappingId::Ccm.forward(dir).filter(|_| dir.y > 0.0));
                }
            }),
            inverse: None,
        };
        let shown = MappingId::Latlong;
        let found = error_map(MappingId::Ccm, &half, 512, shown, SIZE, &Progress::new());
        let pixels = found.unwrap().pixels;
        let is_hole = |pixel: &Pixel| *pixel == Pixel::Hole;
        let (upper, lower) = pixels.split_at(pixels.len() / 2);
        assert!(lower.iter().all(is_hole) && !upper.iter().any(is_hole));
    }

    #[test]
    fn it_stops_when_it_is_asked_to() {
        let progress = Progress::new();
        progress.cancel();
        let evaluator = MappingId::Ccm.processor("f32").unwrap();
        let found = error_map(
            MappingId::Ccm,
            evaluator,
            512,
            MappingId::Cube,
            SIZE,
            &progress,
        );
        assert_eq!(found, None);
    }
}
