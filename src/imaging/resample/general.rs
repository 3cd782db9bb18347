//! The general kernel: places, then light, then encoding.

use super::area::{Corners, Patch, Spots};
use super::encode::Encoder;
use super::filter::{Mix, Sampler};
use super::geometry::Geometry;
use super::lookups::{Lookups, Places};
use super::stored::Stored;
use super::strips::{Kernel, Run, Scratch};
use super::texels::Pixel;

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
                self.means(geometry, run, |_| Spots::grid(*count), lookups, pixels);
            }
            Way::Area(geometry) => {
                let spots = |column: u32| {
                    let at = [f64::from(column), f64::from(run.row)];
                    Spots::of(geometry.footprint(run.chart, at))
                };
                self.means(geometry, run, spots, lookups, pixels);
            }
        }
        self.encoder.write(run, pixels, out);
    }
}

impl General<'_> {
    /// The means over places in the texels of a run.
    fn means(
        &self,
        geometry: &Geometry,
        run: &Run,
        spots: impl Fn(u32) -> Spots,
        lookups: &mut Lookups,
        pixels: &mut [Pixel],
    ) {
        /// Places in a texel from which on corners, two a texel, are cheaper.
        const MANY: u32 = 4;
        let mut corners = None;
        for (index, (column, pixel)) in run.columns.clone().zip(pixels).enumerate() {
            let middle = [f64::from(column), f64::from(run.row)];
            let Some(place) = geometry.place(run.chart, middle) else {
                *pixel = [0.0; 4];
                continue;
            };
            let spots = spots(column);
            let patch = if spots.len() > MANY {
                let corners = corners.get_or_insert_with(|| Corners::of(geometry, run));
                corners.patch(index, place)
            } else {
                None
            };
            *pixel = self.mean(geometry, run.chart, middle, &spots, patch.as_ref(), lookups);
        }
    }

    /// The mean over places in a texel, weighted by solid angle. A texel whose middle is nowhere stays clear black.
    fn mean(
        &self,
        geometry: &Geometry,
        chart: u32,
        middle: [f64; 2],
        spots: &Spots,
        patch: Option<&Patch>,
        lookups: &mut Lookups,
    ) -> Pixel {
        let mut mix: Option<Mix> = None;
        let weighs = !super::geometry::is_equal_area(geometry.target.mapping);
        // Row by row, so that the light of a row is found together and the memory stays small.
        let mut light = [[0.0; 4]; 64];
        let mut weights = [1.0_f32; 64];
        spots.each_row(|row| {
            for part in row.chunks(light.len()) {
                lookups.resize(part.len());
                for (index, (spot, weight)) in part.iter().zip(&mut weights).enumerate() {
                    if let Some(patch) = patch {
                        let (place, share) = patch.at(*spot);
                        lookups.set(index, Some(place));
                        *weight = share as f32;
                        continue;
                    }
                    let at = [middle[0] + spot[0], middle[1] + spot[1]];
                    lookups.set(index, geometry.place(chart, at));
                    if weighs {
                        *weight = geometry.weight(chart, at) as f32;
                    }
                }
                let light = &mut light[..part.len()];
                self.sampler.sample(lookups, light);
                for (index, (pixel, weight)) in light.iter().zip(&weights).enumerate() {
                    if lookups.chart[index] != Lookups::NOWHERE {
                        mix.get_or_insert_with(|| Mix::around(*pixel))
                            .add(*pixel, *weight);
                    }
                }
            }
        });
        mix.map_or([0.0; 4], Mix::mean)
    }
}
