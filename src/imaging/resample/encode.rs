//! From the light of texels to the samples of the target.

use super::stored::{Stored, Working};
use super::strips::Run;
use super::texels::Pixel;
use crate::imaging::srgb::linear_from_srgb;
use crate::imaging::{Channels, Transfer};

/// How a pixel is written. Rounds to the nearest; floats are written as they are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encoder {
    /// What the filter mixed.
    pub working: Working,
    pub transfer: Transfer,
    pub channels: Channels,
    /// Factor on the light; 1 leaves every bit.
    pub gain: f32,
    pub dither: bool,
}

impl Encoder {
    /// Writes a run of pixels; `out` has room for them. Opacity that the target does not keep is dropped, the colour stays.
    pub fn write<T: Stored>(&self, run: &Run, pixels: &[Pixel], out: &mut [T]) {
        let count = self.channels.count();
        let stays = self.working == Working::Codes && self.gain == 1.0;
        for (index, (pixel, out)) in pixels.iter().zip(out.chunks_exact_mut(count)).enumerate() {
            let noise = |channel: usize| {
                if self.dither {
                    noise(
                        run.chart,
                        run.columns.start + index as u32,
                        run.row,
                        channel,
                    )
                } else {
                    0.5
                }
            };
            for (channel, (out, value)) in out.iter_mut().zip(pixel).enumerate() {
                let noise = noise(channel);
                *out = if channel == 3 {
                    T::from_share(value.clamp(0.0, 1.0), 0.5)
                } else if stays && self.transfer == Transfer::Srgb {
                    T::from_share(*value, noise)
                } else {
                    let light = match self.working {
                        Working::Light => *value,
                        Working::Codes => linear_from_srgb(*value),
                    };
                    let light = if self.gain == 1.0 {
                        light
                    } else {
                        light * self.gain
                    };
                    match self.transfer {
                        Transfer::Linear => T::from_share(light, noise),
                        Transfer::Srgb => T::from_light(light, noise),
                    }
                };
            }
        }
    }
}

/// A number in [0, 1) that looks random, the same in every run: the bits of the place, mixed (the finaliser of MurmurHash3).
fn noise(chart: u32, column: u32, row: u32, channel: usize) -> f32 {
    let mut bits = column
        .wrapping_mul(0x9e37_79b1)
        .wrapping_add(row)
        .wrapping_mul(0x85eb_ca77)
        .wrapping_add(chart * 4 + channel as u32)
        .wrapping_mul(0xc2b2_ae3d);
    for factor in [0x85eb_ca6b, 0xc2b2_ae35_u32] {
        bits = (bits ^ (bits >> 15)).wrapping_mul(factor);
    }
    bits ^= bits >> 16;
    (bits >> 8) as f32 / (1 << 24) as f32
}
