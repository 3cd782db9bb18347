//! One view of the same surroundings by maps of equally many texels: what each of them blurs.
//!
//! The view is given as directions, some to a pixel. Each map is made from the surroundings with the filter that suits, and
//! looked up between its texels; what is seen without a map is looked up in the surroundings themselves.

use std::f64::consts::FRAC_PI_4;

use crate::imaging::resample::{
    Conversion, ResampleError, light_towards, resample, size_of_texels, texels_of,
};
use crate::imaging::{EnvironmentMap, Progress};
use crate::mapping::{Domain, MappingId};
use crate::math::{Rotation, Vec3, turned};

/// A mapping and the size of its charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapSize {
    /// The mapping.
    pub mapping: MappingId,
    /// Texels of a chart, [width, height].
    pub size: [u32; 2],
}

impl MapSize {
    /// With as nearly `budget` texels as whole rows allow.
    pub fn of_budget(mapping: MappingId, budget: u32) -> Self {
        Self {
            mapping,
            size: size_of_texels(mapping, u64::from(budget)),
        }
    }

    /// Texels of all its charts, also those beside a disc: that is what is stored.
    pub fn texels(&self) -> u64 {
        texels_of(self.mapping, self.size)
    }

    /// The part of them that holds no direction: what lies beside a disc.
    pub fn unused(&self) -> f64 {
        match self.mapping.info().domain {
            Domain::Square => 0.0,
            Domain::Disc => 1.0 - FRAC_PI_4,
        }
    }

    /// The map of surroundings that are turned.
    ///
    /// # Errors
    /// As [`resample`].
    pub fn map(
        &self,
        source: &EnvironmentMap,
        rotation: Rotation,
        progress: &Progress,
    ) -> Result<EnvironmentMap, ResampleError> {
        let conversion = Conversion {
            rotation: rotation.source_from_world(),
            ..Conversion::new(self.mapping, self.size, source.shape())
        };
        Ok(resample(source, &conversion, progress)?.0)
    }
}

/// Which directions are seen in the pixels of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Rays {
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Rays along each side of a pixel.
    pub per_side: u32,
    /// Row by row of rays from the top, `per_side` times as many each way as pixels; and whether the ray counts in a
    /// comparison.
    pub rays: Vec<([f32; 3], bool)>,
}

impl Rays {
    /// Pixels of the picture.
    fn pixels(&self) -> usize {
        self.size[0] as usize * self.size[1] as usize
    }

    /// The indices of the rays of a pixel.
    fn of_pixel(&self, pixel: usize) -> impl Iterator<Item = usize> {
        let (width, side) = (self.size[0].max(1) as usize, self.per_side as usize);
        let [x, y] = [pixel % width, pixel / width].map(|k| k * side);
        (0..side * side).map(move |k| (y + k / side) * width * side + x + k % side)
    }

    /// The mean light of each pixel in a map, row by row, in linear light; `rotation` turns the map.
    ///
    /// # Errors
    /// [`ResampleError::Cancelled`].
    pub fn light(
        &self,
        map: &EnvironmentMap,
        rotation: Rotation,
        progress: &Progress,
    ) -> Result<Vec<[f32; 3]>, ResampleError> {
        let rows = rotation.source_from_world();
        let dir = |index: usize| {
            let (dir, _) = self.rays[index];
            turned(rows, Vec3::from_f64(dir.map(f64::from)))
        };
        let light = light_towards(map, self.rays.len(), &dir, progress)?;
        let share = 1.0 / (self.per_side * self.per_side).max(1) as f32;
        let mean = |pixel: usize| {
            let rays = self.of_pixel(pixel).filter_map(|index| light.get(index));
            rays.fold([0.0; 3], |sum, [r, g, b, _]| {
                [sum[0] + share * r, sum[1] + share * g, sum[2] + share * b]
            })
        };
        Ok((0..self.pixels()).map(mean).collect())
    }

    /// Root of the mean square difference of two pictures over the channels of the pixels all of whose rays count; `None` when
    /// there is no such pixel.
    pub fn rms(&self, a: &[[f32; 3]], b: &[[f32; 3]]) -> Option<f64> {
        let counts = |pixel: &usize| {
            let mut rays = self.of_pixel(*pixel);
            rays.all(|index| self.rays.get(index).is_some_and(|(_, counts)| *counts))
        };
        let mut sum = 0.0;
        let mut count = 0_u64;
        let pixels = (0..self.pixels().min(a.len()).min(b.len())).filter(counts);
        for pixel in pixels {
            for (a, b) in a[pixel].iter().zip(b[pixel]) {
                sum += f64::from(a - b).powi(2);
                count += 1;
            }
        }
        (count > 0).then(|| (sum / count as f64).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Environment;

    /// A quarter of the sky as seen from its middle, `per_side` rays to a pixel; the right half counts.
    fn rays(size: [u32; 2], per_side: u32) -> Rays {
        let [width, height] = size.map(|n| n * per_side);
        let all = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        let ray = |[x, y]: [u32; 2]| {
            let place = |k: u32, n: u32| 2.0 * (k as f32 + 0.5) / n as f32 - 1.0;
            ([place(x, width), -place(y, height), 1.0], 2 * x >= width)
        };
        Rays {
            size,
            per_side,
            rays: all.map(ray).collect(),
        }
    }

    fn surroundings(environment: &Environment) -> EnvironmentMap {
        let image = environment.image(&Progress::new()).unwrap().image;
        EnvironmentMap::of_latlong(&image).unwrap()
    }

    #[test]
    fn budgets_are_kept_and_discs_are_counted_whole() {
        let budget = 6 * 48 * 48;
        for &mapping in MappingId::ALL {
            let map = MapSize::of_budget(mapping, budget);
            // Half a row more or less.
            let row = f64::from(map.size[1]).recip();
            let off = map.texels() as f64 / f64::from(budget) - 1.0;
            assert!(off.abs() < 1.5 * row, "{mapping}: {off}");
        }
        let unused = |mapping| MapSize::of_budget(mapping, budget).unused();
        assert!((unused(MappingId::Sphere) - 0.2146).abs() < 1e-4);
        assert_eq!(unused(MappingId::Cube), 0.0);
    }

    #[test]
    fn more_texels_come_nearer_to_the_surroundings() {
        let source = surroundings(&Environment::LabelledFaces);
        let view = rays([64, 64], 2);
        let turn = Rotation::from_degrees([20.0, 10.0, 0.0]);
        let progress = Progress::new();
        let truth = view.light(&source, turn, &progress).unwrap();
        let rms = |mapping, budget| {
            let map = MapSize::of_budget(mapping, budget);
            let map = map.map(&source, turn, &progress).unwrap();
            let light = view.light(&map, Rotation::NONE, &progress).unwrap();
            view.rms(&light, &truth).unwrap()
        };
        for mapping in [MappingId::Cube, MappingId::Latlong, MappingId::Paraboloid] {
            let [coarse, fine] = [6 * 16 * 16, 6 * 256 * 256].map(|budget| rms(mapping, budget));
            assert!(fine < 0.4 * coarse, "{mapping}: {coarse} {fine}");
            assert!(coarse > 1e-3, "control: {coarse}");
        }
        // Turned otherwise than the map it is another view.
        let other = view.light(&source, Rotation::NONE, &progress).unwrap();
        assert!(view.rms(&other, &truth).unwrap() > rms(MappingId::Cube, 6 * 16 * 16));
    }

    #[test]
    fn rays_are_averaged_in_their_pixel_and_only_some_count() {
        let source = surroundings(&Environment::DirectionColor);
        let progress = Progress::new();
        let [one, nine] = [1, 3].map(|per_side| {
            let view = rays([6, 4], per_side);
            view.light(&source, Rotation::NONE, &progress).unwrap()
        });
        assert_eq!((one.len(), nine.len()), (24, 24));
        for (pixel, (one, nine)) in one.iter().zip(&nine).enumerate() {
            let off = (0..3).map(|k| (one[k] - nine[k]).abs()).fold(0.0, f32::max);
            assert!(off < 0.03, "{pixel}: {one:?} {nine:?}");
        }
        let view = rays([6, 4], 3);
        let mut other = nine.clone();
        other[0] = [9.0; 3];
        assert_eq!(
            view.rms(&nine, &other),
            Some(0.0),
            "the left half does not count"
        );
        other[5] = nine[5].map(|c| c + 1.0);
        let expected = (1.0_f64 / 12.0).sqrt();
        assert!((view.rms(&nine, &other).unwrap() - expected).abs() < 1e-6);
        let none = Rays {
            rays: view.rays.iter().map(|(dir, _)| (*dir, false)).collect(),
            ..view
        };
        assert_eq!(none.rms(&nine, &other), None);
    }
}
