//! How far two maps differ, and what a conversion there and back loses.
//!
//! Colours are compared in linear light, multiplied by their opacity: as they look over black. Each texel counts by the solid
//! angle it covers, so that the crowded texels of a pole weigh no more than any other part of the sphere; which texel is the
//! worst does not depend on that. Texels without a direction, and charts that either map lacks, count nothing.

use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::resample::{Conversion, Filter, Report, ResampleError, resample};
use super::{Channels, EnvironmentMap, MapShape, Progress, Raster, SampleKind, Samples, Transfer};
use crate::mapping::{ChartPoint, Layout};

/// The texel that differs most in a channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Its chart.
    pub chart: u32,
    /// Its column and row there.
    pub texel: [u32; 2],
    /// Its unit direction in the world.
    pub dir: [f64; 3],
    /// Largest |a - b| of its channels, in linear light.
    pub difference: f64,
}

/// How far two maps differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Root of the mean square over channels and solid angle, in linear light.
    pub rms: f64,
    /// What the PSNR refers to: 1, or the largest |light| of the first map where that is more.
    pub peak: f64,
    /// `peak` over `rms` in decibels; infinite for equal maps.
    pub psnr_db: f64,
    /// The worst texel.
    pub worst: Worst,
    /// |a - b| of each channel in linear light, RGB floats laid out as the first map; black where nothing is compared.
    pub residual: EnvironmentMap,
}

/// What a conversion to another mapping and back loses.
#[derive(Clone, Debug, PartialEq)]
pub struct Loss {
    /// Between the source and what came back.
    pub difference: Difference,
    /// What the conversion there did, and the one back.
    pub reports: [Report; 2],
    /// How long each took, planning included.
    pub times: [Duration; 2],
}

/// A part of a comparison: rows, then charts, then all.
#[derive(Clone, Copy, Default)]
struct Sum {
    squares: f64,
    weight: f64,
    peak: f64,
    worst: Option<Worst>,
}

impl Sum {
    /// Both; of two equally bad texels the first stays, whatever the threads did.
    fn with(self, other: Self) -> Self {
        let worst = match (self.worst, other.worst) {
            (Some(a), Some(b)) if b.difference > a.difference => Some(b),
            (a, b) => a.or(b),
        };
        Self {
            squares: self.squares + other.squares,
            weight: self.weight + other.weight,
            peak: self.peak.max(other.peak),
            worst,
        }
    }
}

/// How far `b` is from `a`. The progress is only asked whether all was cancelled.
///
/// # Errors
/// [`ResampleError::OtherShape`] unless both have the same mapping, size, siting and axes and share texels with directions;
/// [`ResampleError::Cancelled`].
pub fn compare(
    a: &EnvironmentMap,
    b: &EnvironmentMap,
    progress: &Progress,
) -> Result<Difference, ResampleError> {
    let refuse = |why: &str| ResampleError::OtherShape(why.to_owned());
    let (shape, other) = (a.shape(), b.shape());
    let is_alike = shape.mapping == other.mapping
        && shape.size == other.size
        && shape.siting == other.siting
        && shape.world_from_map == other.world_from_map;
    if !is_alike {
        return Err(refuse("the maps have other mappings, sizes or axes"));
    }
    let mut pictures: Vec<Vec<f32>> = a
        .rasters()
        .iter()
        .map(|raster| vec![0.0; raster.width() as usize * raster.height() as usize * 3])
        .collect();
    let mut total = Sum::default();
    for (chart, (placement, there)) in shape.charts.iter().zip(&other.charts).enumerate() {
        let (Some(placement), Some(_)) = (placement, there) else {
            continue;
        };
        let rows: Vec<(Sum, Vec<[f32; 3]>)> = (0..shape.size[1])
            .into_par_iter()
            .map(|row| match progress.is_cancelled() {
                true => Err(ResampleError::Cancelled),
                false => Ok(compare_row(a, b, chart as u32, row)),
            })
            .collect::<Result<_, _>>()?;
        let width = a.rasters()[placement.raster].width() as usize;
        let picture = &mut pictures[placement.raster];
        for ((sum, colours), row) in rows.into_iter().zip(0..) {
            total = total.with(sum);
            for (colour, column) in colours.into_iter().zip(0..) {
                let [x, y] = placement.turn.cell_from_chart([column, row], shape.size);
                let [x, y] = [placement.origin[0] + x, placement.origin[1] + y].map(|n| n as usize);
                let at = (y * width + x) * 3;
                picture[at..at + 3].copy_from_slice(&colour);
            }
        }
    }
    let no_texel = || refuse("no texel of the source has a direction");
    let worst = total.worst.filter(|_| total.weight > 0.0);
    let worst = worst.ok_or_else(no_texel)?;
    let rms = (total.squares / (3.0 * total.weight)).sqrt();
    let peak = total.peak.max(1.0);
    Ok(Difference {
        rms,
        peak,
        psnr_db: 20.0 * (peak / rms).log10(),
        worst,
        residual: residual(a, pictures).ok_or_else(no_texel)?,
    })
}

fn compare_row(
    a: &EnvironmentMap,
    b: &EnvironmentMap,
    chart: u32,
    row: u32,
) -> (Sum, Vec<[f32; 3]>) {
    let shape = a.shape();
    let mut sum = Sum::default();
    let colours = (0..shape.size[0]).map(|column| {
        let texel = [column, row];
        let [u, v] = [0, 1].map(|k| shape.siting.coordinate(f64::from(texel[k]), shape.size[k]));
        let Some(dir) = shape.mapping.inverse(ChartPoint::new(chart, u, v)) else {
            return [0.0; 3];
        };
        let over_black = |map: &EnvironmentMap| {
            let [r, g, b, opacity] = map.light(chart, texel);
            [r, g, b].map(|c| c * opacity)
        };
        let (from, to) = (over_black(a), over_black(b));
        let difference: [f32; 3] = std::array::from_fn(|i| (from[i] - to[i]).abs());
        let squares: f64 = difference.iter().map(|d| f64::from(*d).powi(2)).sum();
        let weight = weight(shape, chart, texel);
        sum = sum.with(Sum {
            squares: squares * weight,
            weight,
            peak: from
                .iter()
                .fold(0.0, |peak, c| peak.max(f64::from(c.abs()))),
            worst: Some(Worst {
                chart,
                texel,
                dir: shape.world_from_map.apply(dir).to_f64(),
                difference: difference
                    .iter()
                    .fold(0.0, |most, d| most.max(f64::from(*d))),
            }),
        });
        difference
    });
    let colours = colours.collect();
    (sum, colours)
}

/// Solid angle of a texel in sr to second order: of what it covers on the chart (half as much at a border on which it sits),
/// times the stretch in the middle. One look at the mapping a texel, where Gauss's rule takes nine.
fn weight(shape: &MapShape, chart: u32, texel: [u32; 2]) -> f64 {
    let sides = [0, 1].map(|k| {
        let border = |offset| {
            shape
                .siting
                .coordinate(f64::from(texel[k]) + offset, shape.size[k])
        };
        [border(-0.5).max(0.0), border(0.5).min(1.0)]
    });
    let [u, v] = sides.map(|[from, to]| 0.5 * (from + to));
    let scale = shape
        .mapping
        .jacobian(ChartPoint::new(chart, u, v))
        .map_or(0.0, |(_, jacobian)| jacobian.area_scale());
    let area: f64 = sides.iter().map(|[from, to]| to - from).product();
    if scale.is_finite() { scale * area } else { 0.0 }
}

fn residual(a: &EnvironmentMap, pictures: Vec<Vec<f32>>) -> Option<EnvironmentMap> {
    let rasters = a.rasters().iter().zip(pictures).map(|(raster, samples)| {
        let samples = Samples::F32(samples);
        Raster::new(raster.size(), Channels::Rgb, Transfer::Linear, samples)
    });
    let shape = MapShape {
        channels: Channels::Rgb,
        samples: SampleKind::F32,
        transfer: Transfer::Linear,
        ..a.shape().clone()
    };
    EnvironmentMap::new(shape, rasters.collect::<Option<_>>()?).ok()
}

/// What is lost when `source` goes through `via` and comes back at its own size. Rotation and exposure are undone; what comes
/// back is kept in floats, so that no rounding but that of `via` counts. `back` is the filter of the way back, as
/// [`Conversion::filter`].
///
/// # Errors
/// As [`resample`], for either way, and when no texel of the source has a direction.
pub fn loss(
    source: &EnvironmentMap,
    via: &Conversion,
    back: Option<Filter>,
    progress: &Progress,
) -> Result<Loss, ResampleError> {
    let start = Instant::now();
    let (there, first) = resample(source, via, progress)?;
    let middle = Instant::now();
    let shape = source.shape();
    let conversion = Conversion {
        layout: Layout::Faces,
        world_from_map: shape.world_from_map,
        siting: shape.siting,
        filter: back,
        filtered_in: via.filtered_in,
        rotation: std::array::from_fn(|i| std::array::from_fn(|j| via.rotation[j][i])),
        exposure_ev: -via.exposure_ev,
        samples: SampleKind::F32,
        transfer: Transfer::Linear,
        channels: shape.channels,
        threads: via.threads,
        isa: via.isa,
        ..Conversion::new(shape.mapping, shape.size, there.shape())
    };
    let (returned, second) = resample(&there, &conversion, progress)?;
    let times = [middle - start, middle.elapsed()];
    let difference = compare(source, &returned, progress)?;
    Ok(Loss {
        difference,
        reports: [first, second],
        times,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mapping::{Domain, MappingId};

    /// A map of floats that are all the same.
    fn grey(mapping: MappingId, size: [u32; 2]) -> EnvironmentMap {
        let charts = mapping.info().chart_count();
        let rasters = (0..charts).map(|_| {
            let samples = Samples::F32(vec![0.5; (size[0] * size[1] * 3) as usize]);
            Raster::new(size, Channels::Rgb, Transfer::Linear, samples).unwrap()
        });
        EnvironmentMap::from_layout(mapping, Layout::Faces, rasters.collect()).unwrap()
    }

    fn set(map: &mut EnvironmentMap, raster: usize, at: usize, value: f32) {
        match map.rasters_mut()[raster].samples_mut() {
            Samples::F32(samples) => samples[at] = value,
            _ => panic!("floats"),
        }
    }

    #[test]
    fn equal_maps_do_not_differ_and_others_are_not_compared() {
        let map = grey(MappingId::Cube, [4, 4]);
        let difference = compare(&map, &map, &Progress::new()).unwrap();
        assert_eq!((difference.rms, difference.peak), (0.0, 1.0));
        assert_eq!(difference.psnr_db, f64::INFINITY);
        for other in [grey(MappingId::Cube, [4, 5]), grey(MappingId::Eac, [4, 4])] {
            let refused = compare(&map, &other, &Progress::new());
            assert!(matches!(refused, Err(ResampleError::OtherShape(_))));
        }
        let progress = Progress::new();
        progress.cancel();
        let cancelled = compare(&map, &map, &progress);
        assert!(matches!(cancelled, Err(ResampleError::Cancelled)));
    }

    #[test]
    fn the_worst_texel_is_found_and_shown() {
        let map = grey(MappingId::Cube, [4, 4]);
        let mut other = map.clone();
        set(&mut other, 2, (3 * 4 + 1) * 3 + 1, 0.75);
        set(&mut other, 5, 0, 0.625);
        let difference = compare(&map, &other, &Progress::new()).unwrap();
        let worst = difference.worst;
        assert_eq!((worst.chart, worst.texel), (2, [1, 3]));
        assert_eq!(worst.difference, 0.25);
        let point = MappingId::Cube.inverse(ChartPoint::new(2, 0.375, 0.875));
        assert_eq!(Some(worst.dir), point.map(|dir| dir.to_f64()));
        assert_eq!(difference.residual.light(2, [1, 3]), [0.0, 0.25, 0.0, 1.0]);
        assert_eq!(difference.residual.light(5, [0, 0]), [0.125, 0.0, 0.0, 1.0]);
        assert_eq!(difference.residual.light(1, [0, 0]), [0.0, 0.0, 0.0, 1.0]);
    }

    #[test]
    fn weights_are_solid_angles() {
        for &mapping in MappingId::ALL {
            let map = grey(mapping, [64, 64]);
            let shape = map.shape();
            let charts = 0..mapping.info().chart_count();
            let texels = charts.flat_map(|c| (0..64 * 64).map(move |i| (c, [i % 64, i / 64])));
            let sum: f64 = texels.map(|(c, texel)| weight(shape, c, texel)).sum();
            let whole = mapping.info().coverage.solid_angle_sr();
            // Rims of discs are cut into texels coarsely, which shows most where the stretch is without bound.
            let info = mapping.info();
            let budget = match (info.domain, info.chart_count()) {
                (Domain::Disc, 1) => 0.05,
                // Observed: 2.7e-3, by the fisheye.
                (Domain::Disc, _) => 4e-3,
                _ => 2e-3,
            };
            assert!(
                (sum / whole - 1.0).abs() < budget,
                "{mapping}: {sum} of {whole}"
            );
        }
        // A row at the pole is spoiled, then one at the equator: the latter weighs as much more as its parallel is longer.
        let map = grey(MappingId::Latlong, [8, 32]);
        let rms = |row: usize| {
            let mut other = map.clone();
            (0..8).for_each(|x| set(&mut other, 0, (row * 8 + x) * 3, 1.0));
            compare(&map, &other, &Progress::new()).unwrap().rms
        };
        let sin = |row: f64| (std::f64::consts::PI * (row + 0.5) / 32.0).sin();
        let (observed, expected) = ((rms(16) / rms(0)).powi(2), sin(16.0) / sin(0.0));
        assert!(
            (observed / expected - 1.0).abs() < 1e-9,
            "{observed} {expected}"
        );
        assert!(expected > 20.0);
    }

    #[test]
    fn bright_maps_refer_to_their_own_peak() {
        let mut map = grey(MappingId::Latlong, [8, 4]);
        set(&mut map, 0, 7, -20.0);
        let mut other = map.clone();
        set(&mut other, 0, 40, 1.5);
        let difference = compare(&map, &other, &Progress::new()).unwrap();
        assert_eq!(difference.peak, 20.0);
        let expected = 20.0 * (20.0 / difference.rms).log10();
        assert!((difference.psnr_db - expected).abs() < 1e-9);
    }

    #[test]
    fn a_loss_is_of_what_cannot_come_back() {
        let mut map = grey(MappingId::Cube, [16, 16]);
        let via = Conversion {
            exposure_ev: 2.0,
            ..Conversion::new(MappingId::Eac, [32, 32], map.shape())
        };
        let bilinear = Some(Filter::Bilinear);
        let none = loss(&map, &via, bilinear, &Progress::new()).unwrap();
        assert_eq!(none.difference.rms, 0.0);
        // A spot does not come back as it was; one that is stored on a quarter of the texels even less.
        set(&mut map, 0, (7 * 16 + 7) * 3, 1.0);
        let fine = loss(&map, &via, bilinear, &Progress::new()).unwrap();
        let coarse = Conversion {
            size: [8, 8],
            ..via
        };
        let coarse = loss(&map, &coarse, bilinear, &Progress::new()).unwrap();
        assert!(fine.difference.rms > 0.0);
        assert!(coarse.difference.rms > 1.5 * fine.difference.rms);
        let worst = coarse.difference.worst;
        assert_eq!((worst.chart, worst.texel), (0, [7, 7]));
    }
}
