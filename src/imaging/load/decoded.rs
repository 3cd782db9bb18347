//! What a decoder leaves: texels in the form in which they become a picture without being moved.

use super::{EnvmapKind, LoadProblem, reserved};
use crate::imaging::srgb::{FROM_8, FROM_16, linear_from_srgb};
use crate::imaging::{Channels, Raster, Samples, Stored, Transfer};

/// Texels and what the file says about them.
pub(super) struct Decoded {
    pub(super) texels: Texels,
    pub(super) stored: Stored,
    pub(super) envmap: Option<EnvmapKind>,
}

/// Texels, row after row from the top.
pub(super) enum Texels {
    /// Codes of sRGB.
    U8(Channels, Vec<u8>),
    /// Codes of sRGB.
    U16(Channels, Vec<u16>),
    /// Light.
    Rgb(Vec<[f32; 3]>),
    /// Light and opacity.
    Rgba(Vec<[f32; 4]>),
}

impl Texels {
    /// Every bit; `None` when there are none.
    pub(super) fn into_raster(self, size: [u32; 2]) -> Option<Raster> {
        let (channels, transfer, samples) = match self {
            Self::U8(channels, codes) => (channels, Transfer::Srgb, Samples::U8(codes)),
            Self::U16(channels, codes) => (channels, Transfer::Srgb, Samples::U16(codes)),
            Self::Rgb(light) => {
                let samples = Samples::F32(light.into_flattened());
                (Channels::Rgb, Transfer::Linear, samples)
            }
            Self::Rgba(light) => {
                let samples = Samples::F32(light.into_flattened());
                (Channels::Rgba, Transfer::Linear, samples)
            }
        };
        Raster::new(size, channels, transfer, samples)
    }

    /// Light without opacity. What is light already is handed through.
    pub(super) fn into_light(self) -> Result<Vec<[f32; 3]>, LoadProblem> {
        match self {
            Self::U8(channels, codes) => light_of_texels(&codes, channels.count(), light_of_8),
            Self::U16(channels, codes) => light_of_texels(&codes, channels.count(), light_of_16),
            Self::Rgb(light) => Ok(light),
            Self::Rgba(light) => light_of_texels(light.as_flattened(), 4, |texel| {
                [texel[0], texel[1], texel[2]]
            }),
        }
    }
}

fn light_of_texels<T>(
    samples: &[T],
    channels: usize,
    light_of: fn(&[T]) -> [f32; 3],
) -> Result<Vec<[f32; 3]>, LoadProblem> {
    let mut light = reserved(samples.len() / channels)?;
    light.extend(samples.chunks_exact(channels).map(light_of));
    Ok(light)
}

/// Light of a texel of three or four codes.
pub(super) fn light_of_8(codes: &[u8]) -> [f32; 3] {
    [0, 1, 2].map(|channel| FROM_8[usize::from(codes[channel])])
}

/// Light of a texel of three or four codes.
pub(super) fn light_of_16(codes: &[u16]) -> [f32; 3] {
    [0, 1, 2].map(|channel| FROM_16[usize::from(codes[channel])])
}

/// Light of every texel of a picture, without opacity.
pub(in crate::imaging) fn light_of_raster(raster: &Raster) -> Result<Vec<[f32; 3]>, LoadProblem> {
    let count = raster.channels().count();
    let is_coded = raster.transfer() == Transfer::Srgb;
    match raster.samples() {
        Samples::U8(codes) if is_coded => light_of_texels(codes, count, light_of_8),
        Samples::U16(codes) if is_coded => light_of_texels(codes, count, light_of_16),
        Samples::U8(shares) => light_of_texels(shares, count, |texel| {
            [0, 1, 2].map(|channel| f32::from(texel[channel]) / 255.0)
        }),
        Samples::U16(shares) => light_of_texels(shares, count, |texel| {
            [0, 1, 2].map(|channel| f32::from(texel[channel]) / 65535.0)
        }),
        Samples::F32(codes) if is_coded => light_of_texels(codes, count, |texel| {
            [0, 1, 2].map(|channel| linear_from_srgb(texel[channel]))
        }),
        Samples::F32(light) => {
            light_of_texels(light, count, |texel| [texel[0], texel[1], texel[2]])
        }
    }
}
