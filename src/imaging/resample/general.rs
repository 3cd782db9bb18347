//! The general kernel: places, then light, then encoding.

use super::encode::Encoder;
use super::filter::{Mix, Sampler};
use super::geometry::Geometry;
use super::lookups::{Lookups, Places};
use super::stored::Stored;
use super::strips::{Kernel, Run, Scratch};

/// Any way to find places with any filter.
pub(super) struct General<'a> {
    pub way: Way<'a>,
    pub sampler: &'a dyn Sampler,
    pub encoder: Encoder,
}

/// How many places a texel has, and which.
pub(super) enum Way<'a> {
    /// Its own.
    Single(&'a dyn Places),
    /// A grid of so many across and down in each texel.
    Grid(&'a Geometry, u32),
    /// As many as its footprint needs.
    Area(&'a Geometry),
}

impl<T: Stored> Kernel<T> for General<'_> {
    fn write(&self, run: &Run, scratch: &mut Scratch, out: &mut [T]) {
        let Scratch { lookups, pixels } = scratch;
        pixels.resize(run.columns.len(), [0.0; 4]);
        match &self.way {
            Way::Single(places) => {
                places.fill(run.chart, run.row, run.columns.clone(), lookups);
                self.sampler.sample(lookups, pixels);
            }
            Way::Grid(geometry, count) => {
                for (column, pixel) in run.columns.clone().zip(pixels.iter_mut()) {
                    let grid = super::area::Spots::grid(*count);
                    *pixel = self.mean(geometry, run, column, &grid, lookups);
                }
            }
            Way::Area(geometry) => {
                for (column, pixel) in run.columns.clone().zip(pixels.iter_mut()) {
                    let at = [f64::from(column), f64::from(run.row)];
                    let spots = super::area::Spots::of(geometry.footprint(run.chart, at));
                    *pixel = self.mean(geometry, run, column, &spots, lookups);
                }
            }
        }
        self.encoder.write(run, pixels, out);
    }
}

impl General<'_> {
    /// The mean over places in a texel, weighted by solid angle. A texel whose middle is nowhere stays clear black.
    fn mean(
        &self,
        geometry: &Geometry,
        run: &Run,
        column: u32,
        spots: &super::area::Spots,
        lookups: &mut Lookups,
    ) -> [f32; 4] {
        let middle = [f64::from(column), f64::from(run.row)];
        let mut mix: Option<Mix> = None;
        let weighs = !super::geometry::is_equal_area(geometry.target.mapping);
        if geometry.place(run.chart, middle).is_none() {
            return [0.0; 4];
        }
        // Row by row, so that the light of a row is found together and the memory stays small.
        let mut light = [[0.0; 4]; 64];
        spots.each_row(|row| {
            for part in row.chunks(light.len()) {
                lookups.resize(part.len());
                for (index, spot) in part.iter().enumerate() {
                    let at = [middle[0] + spot[0], middle[1] + spot[1]];
                    lookups.set(index, geometry.place(run.chart, at));
                }
                let light = &mut light[..part.len()];
                self.sampler.sample(lookups, light);
                for (index, (spot, pixel)) in part.iter().zip(light.iter()).enumerate() {
                    if lookups.chart[index] == Lookups::NOWHERE {
                        continue;
                    }
                    let at = [middle[0] + spot[0], middle[1] + spot[1]];
                    let weight = if weighs {
                        geometry.weight(run.chart, at) as f32
                    } else {
                        1.0
                    };
                    mix.get_or_insert_with(|| Mix::around(*pixel))
                        .add(*pixel, weight);
                }
            }
        });
        mix.map_or([0.0; 4], Mix::mean)
    }
}
