//! A map's smaller levels.

use super::encode::Encoder;
use super::filter::Mix;
use super::grid::Grid;
use super::gutter::Gutter;
use super::pieces::Pieces;
use super::plan::Plan;
use super::stored::{Decoder, Stored};
use super::strips::{Kernel, Run, Scratch};
use super::texels::Texels;
use super::{Conversion, Filter, ResampleError};
use crate::imaging::{Channels, EnvironmentMap, MapShape, Progress, SampleKind, Siting, Stage};
use crate::mapping::Domain;

/// The map and all its smaller levels, each half as large as the one before, rounded down, to a single texel. `conversion` is
/// the one that made the map.
///
/// Each texel is a mean of the level before, weighted by solid angle, over its own texels and those around it, across seams, too
/// (see `pieces`). Every level holds the same light as the one before: the sum over texels, each times its solid angle. Only
/// of discs, whose rims no texels' borders follow, and of maps with samples on the border, this is so but for the rims.
///
/// # Errors
/// As [`Plan::run`].
pub fn levels(
    map: EnvironmentMap,
    conversion: &Conversion,
    progress: &Progress,
) -> Result<Vec<EnvironmentMap>, ResampleError> {
    let mut smaller = Conversion {
        rotation: Conversion::UNTURNED,
        supersample: 1,
        exposure_ev: 0.0,
        ..conversion.clone()
    };
    let mut levels = vec![map];
    while smaller.size != [1, 1] {
        smaller.size = smaller.size.map(|side| (side / 2).max(1));
        // Never empty: it began with one.
        let Some(last) = levels.last() else { break };
        let level = halved(last, &smaller, progress)?;
        levels.push(level);
    }
    Ok(levels)
}

fn halved(
    last: &EnvironmentMap,
    smaller: &Conversion,
    progress: &Progress,
) -> Result<EnvironmentMap, ResampleError> {
    let shape = last.shape();
    let by = |filter| Conversion {
        filter: Some(filter),
        ..smaller.clone()
    };
    if shape.mapping.info().domain != Domain::Square || shape.siting != Siting::Centre {
        let plan = Plan::new(shape, &by(Filter::Area))?;
        return Ok(plan.run(last, progress)?.0);
    }
    // The places of the texels are asked for nowhere: the plan is for all else.
    let plan = Plan::new(shape, &by(Filter::Nearest))?;
    let mut level = plan.black()?;
    let pieces = Pieces::new(shape, smaller.size);
    progress.enter(Stage::Computing);
    match (shape.samples, shape.channels) {
        (SampleKind::U8, Channels::Rgb) => {
            fill::<u8, 3>(last, &mut level, &plan, &pieces, progress)
        }
        (SampleKind::U8, Channels::Rgba) => {
            fill::<u8, 4>(last, &mut level, &plan, &pieces, progress)
        }
        (SampleKind::U16, Channels::Rgb) => {
            fill::<u16, 3>(last, &mut level, &plan, &pieces, progress)
        }
        (SampleKind::U16, Channels::Rgba) => {
            fill::<u16, 4>(last, &mut level, &plan, &pieces, progress)
        }
        (SampleKind::F32, Channels::Rgb) => {
            fill::<f32, 3>(last, &mut level, &plan, &pieces, progress)
        }
        (SampleKind::F32, Channels::Rgba) => {
            fill::<f32, 4>(last, &mut level, &plan, &pieces, progress)
        }
    }?;
    progress.enter(Stage::Done);
    Ok(level)
}

fn fill<S: Stored, const N: usize>(
    last: &EnvironmentMap,
    level: &mut EnvironmentMap,
    plan: &Plan,
    pieces: &Pieces,
    progress: &Progress,
) -> Result<(), ResampleError> {
    let shape: &MapShape = last.shape();
    let mut grid = Grid::of(shape);
    grid.facets = 1;
    // Only texels of the charts are asked for.
    let gutter = Gutter::new(&grid, 0, plan.threads());
    let decoder = Decoder::of(shape.samples, shape.transfer, plan.working());
    let kernel = Halving {
        texels: Texels::<S, N>::new(last, decoder, &gutter, true, plan.threads()),
        pieces,
        encoder: plan.encoder(),
    };
    plan.fill_by(level, &kernel, progress)
}

/// Makes the texels of a level from the one before.
struct Halving<'a, S, const N: usize> {
    texels: Texels<'a, S, N>,
    pieces: &'a Pieces,
    encoder: Encoder,
}

impl<T: Stored, S: Stored, const N: usize> Kernel<T> for Halving<'_, S, N> {
    fn write(&self, run: &Run, scratch: &mut Scratch, out: &mut [T]) {
        let pixels = &mut scratch.pixels;
        pixels.clear();
        pixels.extend(run.columns.clone().map(|column| {
            let mut mix: Option<Mix> = None;
            self.pieces.shares(run.chart, [column, run.row], |share| {
                let [x, y] = share.texel.map(|k| k as i32);
                let pixel = self.texels.own(share.chart, x, y);
                mix.get_or_insert_with(|| Mix::around(pixel))
                    .add(pixel, share.weight);
            });
            mix.map_or([0.0; 4], Mix::mean)
        }));
        self.encoder.write(run, pixels, out);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::{Raster, Samples, Transfer};
    use crate::mapping::MappingId;
    use crate::math::inputs::Random;

    fn map(mapping: MappingId, size: [u32; 2], light: impl FnMut() -> f32) -> EnvironmentMap {
        let layout = mapping.info().layout;
        let mut light = light;
        let rasters = MapShape::raster_sizes(mapping, layout, size)
            .into_iter()
            .map(|size| {
                let samples = (0..size[0] * size[1] * 3).map(|_| light()).collect();
                Raster::new(size, Channels::Rgb, Transfer::Linear, Samples::F32(samples)).unwrap()
            });
        EnvironmentMap::from_layout(mapping, layout, rasters.collect()).unwrap()
    }

    fn levels_of(map: EnvironmentMap) -> Vec<EnvironmentMap> {
        let conversion = Conversion::new(map.shape().mapping, map.shape().size, map.shape());
        levels(map, &conversion, &Progress::new()).unwrap()
    }

    fn texels(map: &EnvironmentMap) -> impl Iterator<Item = (u32, [u32; 2])> + use<> {
        let ([width, height], charts) = (map.shape().size, map.shape().charts.len() as u32);
        (0..charts).flat_map(move |c| (0..width * height).map(move |i| (c, [i % width, i / width])))
    }

    /// All light: each texel's times its solid angle, found by cutting it into many.
    fn light(map: &EnvironmentMap) -> f64 {
        let MapShape { mapping, size, .. } = *map.shape();
        let cuts = (96 / size[0].max(size[1])).max(1);
        let solid_angle = |chart, texel: [u32; 2]| -> f64 {
            (0..cuts * cuts)
                .map(|i| [texel[0] * cuts + i % cuts, texel[1] * cuts + i / cuts])
                .map(|part| mapping.texel_solid_angle_sr(chart, part, size.map(|n| n * cuts)))
                .sum()
        };
        texels(map)
            .map(|(chart, texel)| f64::from(map.light(chart, texel)[0]) * solid_angle(chart, texel))
            .sum()
    }

    /// The first level's plain means of 2 x 2 texels.
    fn plain_means(map: &EnvironmentMap, level: &EnvironmentMap) -> EnvironmentMap {
        let mut level = level.clone();
        let means: Vec<(u32, [u32; 2], f32)> = texels(&level)
            .map(|(chart, [x, y])| {
                let four = [[0, 0], [1, 0], [0, 1], [1, 1]];
                let sum: f32 = four
                    .iter()
                    .map(|[i, j]| map.light(chart, [2 * x + i, 2 * y + j])[0])
                    .sum();
                (chart, [x, y], sum / 4.0)
            })
            .collect();
        let shape = level.shape().clone();
        for (chart, texel, mean) in means {
            let placement = shape.charts[chart as usize].unwrap();
            let [x, y] = placement.turn.cell_from_chart(texel, shape.size);
            let raster = &mut level.rasters_mut()[placement.raster];
            let width = raster.width();
            let at = ((placement.origin[1] + y) * width + placement.origin[0] + x) as usize * 3;
            if let Samples::F32(samples) = raster.samples_mut() {
                samples[at] = mean;
            }
        }
        level
    }

    #[test]
    fn every_level_holds_the_same_light() {
        let mut random = Random::new(3);
        let mut noise = || {
            let unit = (random.bits() >> 40) as f32 / (1 << 24) as f32;
            // A sun here and there.
            if unit > 0.99 { 1000.0 * unit } else { unit }
        };
        for (mapping, size, budget) in [
            (MappingId::Cube, [32, 32], 3e-7),
            (MappingId::Cube, [27, 27], 3e-7),
            (MappingId::Eac, [16, 16], 3e-7),
            (MappingId::Ccm, [11, 11], 3e-7),
            (MappingId::Latlong, [64, 32], 3e-7),
            (MappingId::Latlong, [37, 19], 3e-7),
            (MappingId::CylindricalEqualArea, [50, 16], 3e-7),
            (MappingId::OctahedralEqualArea, [24, 24], 3e-7),
            // Texels that its creases cut are measured to a thousandth.
            (MappingId::Octahedral, [32, 32], 1e-4),
        ] {
            let levels = levels_of(map(mapping, size, &mut noise));
            let whole = light(&levels[0]);
            let mut worst = 0.0_f64;
            for level in &levels[1..] {
                worst = worst.max((light(level) / whole - 1.0).abs());
            }
            let plain = light(&plain_means(&levels[0], &levels[1]));
            let plain = (plain / whole - 1.0).abs();
            println!(
                "{mapping} {size:?}: {worst:.1e}, budget {budget:.0e}; plain means {plain:.1e}"
            );
            assert!(worst < budget, "{mapping} {size:?}: {worst}");
            assert!(plain > budget || mapping.info().claims.equal_area);
        }
    }

    /// One bright texel in the corner of a face, where its solid angle is least, reaches all three faces.
    #[test]
    fn light_goes_over_seams() {
        let mut at = 0;
        // The first texel of +z in the cross.
        let bright = (8 * 32 + 8) * 3;
        let map = map(MappingId::Cube, [8, 8], || {
            at += 1;
            f32::from(u8::from(at == bright + 1)) * 64.0
        });
        let levels = levels_of(map);
        let lit: Vec<_> = texels(&levels[1])
            .filter(|(chart, texel)| levels[1].light(*chart, *texel)[0] > 0.0)
            .collect();
        let charts: std::collections::BTreeSet<_> = lit.iter().map(|(chart, _)| *chart).collect();
        assert_eq!((lit.len(), charts.len()), (3, 3), "{lit:?}");
        // Half stays, a quarter each goes to the neighbours: their texels at the corner are alike.
        let mut values: Vec<f32> = lit
            .iter()
            .map(|(c, t)| levels[1].light(*c, *t)[0])
            .collect();
        values.sort_by(f32::total_cmp);
        assert!(
            (values[0] / values[1] - 1.0).abs() < 1e-5
                && (values[2] / values[1] - 2.0).abs() < 1e-5
        );
    }

    #[test]
    fn what_is_alike_stays_so_to_the_bit() {
        for &mapping in MappingId::ALL {
            for size in [1, 2, 3, 5, 8, 9] {
                for level in levels_of(map(mapping, [size + 1, size], || 0.3)) {
                    for (chart, texel) in texels(&level) {
                        let value = level.light(chart, texel)[0];
                        let is_off = mapping.info().domain != Domain::Square && value == 0.0;
                        assert!(
                            value == 0.3 || is_off,
                            "{mapping} {size} {texel:?}: {value}"
                        );
                    }
                }
            }
        }
    }
}
