//! The light between texels.
//!
//! Every filter mixes differences to one texel, so that where all texels are alike the answer is that texel, to the bit.
//! Colours weigh as much as they are opaque: what is clear has no colour to bleed. Where all is opaque this divides by 1.

use std::f64::consts::PI;
use std::sync::LazyLock;

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

    /// Of all that has been added with opacity.
    pub const fn weight(&self) -> f32 {
        self.weight
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

/// Weights of the texels at -2 to 3.
fn lanczos(t: f32) -> [f32; 6] {
    let place = t * PHASES as f32;
    // t is below 1, so there is an entry after this one.
    let index = (place as usize).min(PHASES - 1);
    let rest = place - index as f32;
    let [from, to] = [LANCZOS[index], LANCZOS[index + 1]];
    std::array::from_fn(|k| from[k] + (to[k] - from[k]) * rest)
}

/// Entries of [`LANCZOS`]: between two, straight lines are off by at most w''/8 of the square of their distance, 5e-7.
const PHASES: usize = 1024;

/// Lanczos's weights sinc(x) sinc(x/3) at distances x = k - 2 - t, for t from 0 to 1.
///
/// As they are, or divided by their sum, they do not even keep a parabola: smooth waves come out at 64 dB. Each is multiplied
/// by one polynomial of x, chosen so that all quartics come out as they are. Were it cubics only, the weights would swing more (at a
/// quarter of a texel 1.00 and -0.20 instead of 0.89 and -0.11): a step errs by a tenth more then, waves of eight texels by
/// 9e-3 of their height instead of 7e-4.
static LANCZOS: LazyLock<Vec<[f32; 6]>> = LazyLock::new(|| {
    let weights = |phase: usize| match phase {
        0 => [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        PHASES => [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
        _ => keeping_quartics(phase as f64 / PHASES as f64).map(|weight| weight as f32),
    };
    (0..=PHASES).map(weights).collect()
});

/// Coefficients of the polynomial, and moments that are kept.
const KEPT: usize = 5;

fn keeping_quartics(t: f64) -> [f64; 6] {
    let sinc = |x: f64| (PI * x).sin() / (PI * x);
    let x: [f64; 6] = std::array::from_fn(|k| k as f64 - 2.0 - t);
    let weights = x.map(|x| sinc(x) * sinc(x / 3.0));
    // Sum over k of w p(x) x^m = 1 for m = 0, else 0: as many equations as the polynomial p has coefficients.
    let moment = |power: i32| -> f64 { (0..6).map(|k| weights[k] * x[k].powi(power)).sum() };
    let mut rows: [[f64; KEPT + 1]; KEPT] = std::array::from_fn(|m| {
        std::array::from_fn(|n| {
            if n < KEPT {
                moment((m + n) as i32)
            } else {
                f64::from(m == 0)
            }
        })
    });
    for pivot in 0..KEPT {
        let largest = (pivot..KEPT).fold(pivot, |best, row| {
            if rows[row][pivot].abs() > rows[best][pivot].abs() {
                row
            } else {
                best
            }
        });
        rows.swap(pivot, largest);
        let of = rows[pivot];
        for (_, row) in rows
            .iter_mut()
            .enumerate()
            .filter(|(index, _)| *index != pivot)
        {
            let factor = row[pivot] / of[pivot];
            for (value, of) in row.iter_mut().zip(of) {
                *value -= factor * of;
            }
        }
    }
    std::array::from_fn(|k| {
        let polynomial: f64 = (0..KEPT)
            .map(|m| rows[m][KEPT] / rows[m][m] * x[k].powi(m as i32))
            .sum();
        weights[k] * polynomial
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_keep_polynomials() {
        let mut worst = [0.0_f64; 6];
        for step in 0..1000 {
            let t = step as f32 / 1000.0;
            for (m, worst) in worst.iter_mut().enumerate() {
                let power = |x: i32| f64::from(x).powi(m as i32);
                let sum = |first: i32, weights: &[f32]| -> f64 {
                    weights
                        .iter()
                        .zip(first..)
                        .map(|(w, x)| f64::from(*w) * power(x))
                        .sum()
                };
                let exact = f64::from(t).powi(m as i32);
                *worst = worst.max((sum(-2, &lanczos(t)) - exact).abs());
                if m < 3 {
                    assert!((sum(-1, &catmull_rom(t)) - exact).abs() < 1e-6, "{t} {m}");
                }
            }
        }
        assert!(worst[..5].iter().all(|worst| *worst < 4e-6), "{worst:?}");
        assert!(worst[5] > 0.1, "not every polynomial: {worst:?}");
    }
}
