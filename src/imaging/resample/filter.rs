//! The light between texels.
//!
//! Every filter mixes differences to one texel, so that where all texels are alike the answer is that texel, to the bit.
//! Colours weigh as much as they are opaque: what is clear has no colour to bleed. Where all is opaque this divides by 1.

use super::conversion::Filter;
use super::lookups::Lookups;
use super::stored::Stored;
use super::texels::{Pixel, Texels};

/// Finds the light of many places.
pub(super) trait Sampler: Sync {
    /// The light at each place; clear black nowhere. `out` has the length of `lookups`.
    fn sample(&self, lookups: &Lookups, out: &mut [Pixel]);
}

/// Texels with a filter.
pub(super) struct Filtered<'a, S, const N: usize> {
    pub texels: Texels<'a, S, N>,
    pub filter: Filter,
}

impl<S: Stored, const N: usize> Sampler for Filtered<'_, S, N> {
    fn sample(&self, lookups: &Lookups, out: &mut [Pixel]) {
        let texels = &self.texels;
        match self.filter {
            Filter::Nearest => each(lookups, out, |index| nearest(texels, lookups, index)),
            // An area is many places, each between its four texels: see `area`.
            Filter::Bilinear | Filter::Area => {
                each(lookups, out, |index| bilinear(texels, lookups, index));
            }
            Filter::Bicubic => each(lookups, out, |index| {
                mixed(texels, lookups, index, catmull_rom)
            }),
            Filter::Lanczos => each(lookups, out, |index| mixed(texels, lookups, index, lanczos)),
        }
    }
}

fn each(lookups: &Lookups, out: &mut [Pixel], light: impl Fn(usize) -> Pixel) {
    for (index, (out, chart)) in out.iter_mut().zip(&lookups.chart).enumerate() {
        *out = if *chart == Lookups::NOWHERE {
            [0.0; 4]
        } else {
            light(index)
        };
    }
}

/// Texels beyond the place that a filter asks for.
pub(super) const fn reach(filter: Filter) -> i32 {
    match filter {
        Filter::Nearest | Filter::Bilinear | Filter::Area => 1,
        Filter::Bicubic => 2,
        Filter::Lanczos => 3,
    }
}

fn nearest<S: Stored, const N: usize>(
    texels: &Texels<'_, S, N>,
    lookups: &Lookups,
    index: usize,
) -> Pixel {
    let next = |rest: f32| i32::from(rest >= 0.5);
    texels.texel(
        lookups.chart[index],
        lookups.column[index] + next(lookups.right[index]),
        lookups.row[index] + next(lookups.below[index]),
    )
}

/// Between the four texels around a place.
fn bilinear<S: Stored, const N: usize>(
    texels: &Texels<'_, S, N>,
    lookups: &Lookups,
    index: usize,
) -> Pixel {
    mixed(texels, lookups, index, |rest| [1.0 - rest, rest])
}

fn mixed<S: Stored, const N: usize, const K: usize>(
    texels: &Texels<'_, S, N>,
    lookups: &Lookups,
    index: usize,
    weights: impl Fn(f32) -> [f32; K],
) -> Pixel {
    let before = K as i32 / 2 - 1;
    let block = texels.block::<K>(
        lookups.chart[index],
        lookups.column[index] - before,
        lookups.row[index] - before,
    );
    let across = weights(lookups.right[index]);
    let down = weights(lookups.below[index]);
    let mut mix = Mix::around(block[K / 2 - 1][K / 2 - 1]);
    for (line, down) in block.iter().zip(down) {
        for (pixel, across) in line.iter().zip(across) {
            if N == 4 {
                mix.add(*pixel, across * down);
            } else {
                mix.add_opaque(*pixel, across * down);
            }
        }
    }
    mix.of_weight_one()
}

/// A weighted mean of pixels, as differences to one of them.
pub(super) struct Mix {
    origin: Pixel,
    colour: [f32; 3],
    opacity: f32,
    weight: f32,
}

impl Mix {
    pub fn around(origin: Pixel) -> Self {
        Self {
            origin,
            colour: [0.0; 3],
            opacity: 0.0,
            weight: 0.0,
        }
    }

    pub fn add(&mut self, pixel: Pixel, weight: f32) {
        self.weight += weight;
        self.opacity += weight * (pixel[3] - self.origin[3]);
        let weight = weight * pixel[3];
        for (sum, (value, origin)) in self.colour.iter_mut().zip(pixel.iter().zip(&self.origin)) {
            *sum += weight * (value - origin);
        }
    }

    pub fn add_opaque(&mut self, pixel: Pixel, weight: f32) {
        for (sum, (value, origin)) in self.colour.iter_mut().zip(pixel.iter().zip(&self.origin)) {
            *sum += weight * (value - origin);
        }
    }

    /// The mean when the weights add up to 1.
    pub fn of_weight_one(self) -> Pixel {
        self.divided(1.0)
    }

    /// The mean.
    pub fn mean(self) -> Pixel {
        let weight = self.weight;
        if weight > 0.0 {
            self.divided(weight)
        } else {
            self.origin
        }
    }

    fn divided(self, weight: f32) -> Pixel {
        let [red, green, blue, origin_opacity] = self.origin;
        let opacity = origin_opacity + self.opacity / weight;
        // Where nothing is opaque there is no colour to tell; the nearest texel's stays.
        if opacity <= 0.0 {
            return [red, green, blue, 0.0];
        }
        let share = weight * opacity;
        let [r, g, b] = self.colour.map(|sum| sum / share);
        [red + r, green + g, blue + b, opacity]
    }
}

/// Weights of the texels at -1, 0, 1, 2 of Catmull and Rom's cubic: through the texels, with the slope of their neighbours'
/// chord, so that parabolas come out as they are.
fn catmull_rom(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [
        -0.5 * t * s * s,
        1.0 + t * t * (1.5 * t - 2.5),
        1.0 + s * s * (1.5 * s - 2.5),
        -0.5 * s * t * t,
    ]
}

/// Weights of the texels at -2 to 3: sinc(x) sinc(x/3), divided by their sum.
fn lanczos(t: f32) -> [f32; 6] {
    // sin(pi x) is the same for all six but for its sign; of sin(pi x/3) the sixth turns are added.
    let (sin, _) = crate::math::sin_cos_turns(0.5 * t);
    let mut weights = [0.0; 6];
    for (k, weight) in weights.iter_mut().enumerate() {
        let x = t + 2.0 - k as f32;
        let (slow, _) = crate::math::sin_cos_turns(x / 6.0);
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        // x^2 sinc(x) sinc(x/3) = 3/pi^2 sin(pi x) sin(pi x/3); the factor falls out of the quotient.
        *weight = sign * sin * slow / (x * x);
    }
    // On a texel the quotient is 0/0.
    if t < 1e-4 {
        return [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    }
    if t > 1.0 - 1e-4 {
        return [0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    }
    let sum: f32 = weights.iter().sum();
    weights.map(|weight| weight / sum)
}
