//! Rows of a picture as the numbers that a format stores.

use crate::imaging::srgb::{FROM_8, FROM_16, linear_from_srgb, srgb_from_linear};
use crate::imaging::{Channels, Raster, Samples, Transfer};

/// Writes row `y` as light, or as shares of the largest code of sRGB, into `row`, which has `channels` for each texel. Opacity
/// is left out where it is not wanted, and 1 where there is none. Nothing is changed where nothing has to be.
pub(in crate::imaging) fn values(
    raster: &Raster,
    y: u32,
    channels: Channels,
    transfer: Transfer,
    row: &mut [f32],
) {
    let (from, to) = (raster.channels().count(), channels.count());
    let length = raster.width() as usize * from;
    let start = y as usize * length;
    let (is_coded, wants_codes) = (
        raster.transfer() == Transfer::Srgb,
        transfer == Transfer::Srgb,
    );
    let texels = row.chunks_exact_mut(to);
    match raster.samples() {
        Samples::F32(samples) => {
            let samples = &samples[start..start + length];
            if is_coded == wants_codes && from == to {
                row.copy_from_slice(samples);
                return;
            }
            let value: fn(&f32) -> f32 = match (is_coded, wants_codes) {
                (true, false) => |&c| linear_from_srgb(c),
                (false, true) => |&c| srgb_from_linear(c),
                _ => |&c| c,
            };
            fill(samples.chunks_exact(from), texels, value, |&c| c);
        }
        Samples::U8(samples) => {
            let share = |&c: &u8| f32::from(c) / 255.0;
            let value: fn(&u8) -> f32 = match (is_coded, wants_codes) {
                (true, false) => |&c| FROM_8[usize::from(c)],
                (false, true) => |&c| srgb_from_linear(f32::from(c) / 255.0),
                _ => share,
            };
            let samples = samples[start..start + length].chunks_exact(from);
            fill(samples, texels, value, share);
        }
        Samples::U16(samples) => {
            let share = |&c: &u16| f32::from(c) / 65535.0;
            let value: fn(&u16) -> f32 = match (is_coded, wants_codes) {
                (true, false) => |&c| FROM_16[usize::from(c)],
                (false, true) => |&c| srgb_from_linear(f32::from(c) / 65535.0),
                _ => share,
            };
            let samples = samples[start..start + length].chunks_exact(from);
            fill(samples, texels, value, share);
        }
    }
}

fn fill<'a, T: 'a>(
    from: impl Iterator<Item = &'a [T]>,
    to: impl Iterator<Item = &'a mut [f32]>,
    color: fn(&T) -> f32,
    opacity: fn(&T) -> f32,
) {
    for (from, to) in from.zip(to) {
        for (from, to) in from.iter().zip(to.iter_mut()).take(3) {
            *to = color(from);
        }
        if let Some(to) = to.get_mut(3) {
            *to = from.get(3).map_or(1.0, opacity);
        }
    }
}

/// The row's codes of 8 bits as they are, where they are what is wanted.
pub(in crate::imaging) fn stored_codes(
    raster: &Raster,
    y: u32,
    channels: Channels,
    transfer: Transfer,
) -> Option<&[u8]> {
    let Samples::U8(samples) = raster.samples() else {
        return None;
    };
    let length = raster.width() as usize * channels.count();
    (raster.channels() == channels && raster.transfer() == transfer)
        .then(|| &samples[y as usize * length..][..length])
}

/// The nearest code of a share of the largest; NaN is 0.
pub(in crate::imaging) fn code8(share: f32) -> u8 {
    (share * 255.0 + 0.5) as u8 // `as` ends at 0 and 255
}

/// The nearest code of a share of the largest; NaN is 0.
pub(in crate::imaging) fn code16(share: f32) -> u16 {
    (share * 65535.0 + 0.5) as u16
}

/// The nearest half. Finite values stay finite: what is beyond the largest half becomes that, and not infinite.
pub(in crate::imaging) fn half(value: f32) -> half::f16 {
    let most = half::f16::MAX.to_f32();
    half::f16::from_f32(if value.is_finite() {
        value.clamp(-most, most)
    } else {
        value
    })
}
