//! The light of a map in any directions: what a view of it shows.

use rayon::prelude::*;

use super::ResampleError;
use super::conversion::{Filter, FilteredIn};
use super::filter::{Filtered, Sampler, reach};
use super::grid::Grid;
use super::gutter::Gutter;
use super::lookups::Lookups;
use super::stored::{Decoder, Stored, Working};
use super::strips::Threads;
use super::texels::{Pixel, Texels};
use crate::imaging::{Channels, EnvironmentMap, Progress, SampleKind};
use crate::math::Vec3;

/// Directions that a thread takes at once.
const MANY: usize = 4096;

/// Colour in linear light and opacity of a map in `count` directions, each between the four texels around its place, across
/// seams as within a chart. `dir` tells them by number, in the world and of any length; clear black for what is no direction.
///
/// # Errors
/// [`ResampleError::Cancelled`].
pub fn light_towards(
    map: &EnvironmentMap,
    count: usize,
    dir: &(dyn Fn(usize) -> Vec3<f64> + Sync),
    progress: &Progress,
) -> Result<Vec<[f32; 4]>, ResampleError> {
    let wanted = Directions {
        count,
        dir,
        progress,
    };
    let shape = map.shape();
    match (shape.samples, shape.channels) {
        (SampleKind::U8, Channels::Rgb) => wanted.of::<u8, 3>(map),
        (SampleKind::U8, Channels::Rgba) => wanted.of::<u8, 4>(map),
        (SampleKind::U16, Channels::Rgb) => wanted.of::<u16, 3>(map),
        (SampleKind::U16, Channels::Rgba) => wanted.of::<u16, 4>(map),
        (SampleKind::F32, Channels::Rgb) => wanted.of::<f32, 3>(map),
        (SampleKind::F32, Channels::Rgba) => wanted.of::<f32, 4>(map),
    }
}

struct Directions<'a> {
    count: usize,
    dir: &'a (dyn Fn(usize) -> Vec3<f64> + Sync),
    progress: &'a Progress,
}

impl Directions<'_> {
    fn of<S: Stored, const N: usize>(
        &self,
        map: &EnvironmentMap,
    ) -> Result<Vec<Pixel>, ResampleError> {
        let shape = map.shape();
        let filter = Filter::Bilinear;
        let threads = Threads::new(0);
        let grid = Grid::of(shape);
        let gutter = Gutter::new(&grid, reach(filter), &threads);
        let working = Working::of(shape.transfer, FilteredIn::Light);
        let decoder = Decoder::of(shape.samples, shape.transfer, working);
        let texels = Texels::<S, N>::new(map, decoder, &gutter, false, &threads);
        let sampler = Filtered { texels, filter };
        let map_from_world = shape.world_from_map.inverse();
        let mut light = vec![[0.0; 4]; self.count];
        let fill = |lookups: &mut Lookups, (part, out): (usize, &mut [Pixel])| {
            if self.progress.is_cancelled() {
                return Err(ResampleError::Cancelled);
            }
            lookups.resize(out.len());
            for index in 0..out.len() {
                let dir = (self.dir)(part * MANY + index);
                let found = shape.mapping.forward(map_from_world.apply(dir));
                lookups.set(index, found.map(|point| grid.found(point)));
            }
            sampler.sample(lookups, out);
            Ok(())
        };
        light
            .par_chunks_mut(MANY)
            .enumerate()
            .try_for_each_init(Lookups::default, fill)?;
        Ok(light)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Image;
    use crate::imaging::resample::{Conversion, resample, size_of_texels};
    use crate::mapping::MappingId;
    use crate::math::inputs::Random;

    /// A latlong whose light is (1 + x, 1 + y, 1 + z) of each texel's direction.
    fn directions(rows: u32) -> EnvironmentMap {
        let [width, height] = [2 * rows, rows];
        let texel = |x: u32, y: u32| {
            let point = crate::mapping::ChartPoint::new(
                0,
                (f64::from(x) + 0.5) / f64::from(width),
                (f64::from(y) + 0.5) / f64::from(height),
            );
            let dir = MappingId::Latlong.inverse::<f64>(point).unwrap();
            dir.to_f64().map(|c| 1.0 + c as f32)
        };
        let texels = (0..height).flat_map(|y| (0..width).map(move |x| texel(x, y)));
        let image = Image::new(width, height, texels.collect()).unwrap();
        EnvironmentMap::of_latlong(&image).unwrap()
    }

    /// Largest difference from the light of the directions themselves.
    fn worst(map: &EnvironmentMap, dirs: &[Vec3<f64>]) -> f64 {
        let progress = Progress::new();
        let light = light_towards(map, dirs.len(), &|k| dirs[k], &progress).unwrap();
        let off = |(light, dir): (&[f32; 4], &Vec3<f64>)| {
            let found = light.map(f64::from);
            let exact = dir.to_f64().map(|c| 1.0 + c);
            assert_eq!(found[3], 1.0);
            (0..3)
                .map(|k| (found[k] - exact[k]).abs())
                .fold(0.0, f64::max)
        };
        light.iter().zip(dirs).map(off).fold(0.0, f64::max)
    }

    #[test]
    fn light_between_texels_and_across_seams_is_that_of_the_direction() {
        let source = directions(256);
        let mut random = Random::new(11);
        let dirs: Vec<Vec3<f64>> = (0..4000)
            .map(|_| Vec3::from_f64(random.direction().map(f64::from)).normalized())
            .collect();
        for mapping in [
            MappingId::Latlong,
            MappingId::Cube,
            MappingId::Ccm,
            MappingId::Octahedral,
            MappingId::Paraboloid,
        ] {
            let size = size_of_texels(mapping, 6 * 64 * 64);
            let conversion = Conversion::new(mapping, size, source.shape());
            let (map, _) = resample(&source, &conversion, &Progress::new()).unwrap();
            let off = worst(&map, &dirs);
            // A texel has a side of about 0.025, so that half a one beside the place would be 1e-2; what is bent between texels
            // is far below. Observed: 2.2e-3 (octahedral and latlong), the cubes a tenth.
            assert!(off < 3e-3, "{mapping}: {off:e}");
        }
        // Of few texels it is told coarsely.
        let conversion = Conversion::new(MappingId::Cube, [4, 4], source.shape());
        let (map, _) = resample(&source, &conversion, &Progress::new()).unwrap();
        let off = worst(&map, &dirs);
        assert!(off > 1e-2, "control: {off:e}");
    }

    #[test]
    fn what_is_no_direction_is_clear_and_cancelling_is_an_error() {
        let map = directions(8);
        let none = |_: usize| Vec3::new(0.0, 0.0, 0.0);
        let progress = Progress::new();
        let light = light_towards(&map, 3, &none, &progress).unwrap();
        assert_eq!(light, [[0.0; 4]; 3]);
        progress.cancel();
        let refused = light_towards(&map, 3, &none, &progress);
        assert!(matches!(refused, Err(ResampleError::Cancelled)));
    }
}
