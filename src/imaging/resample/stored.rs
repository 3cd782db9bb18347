//! Samples as they are stored, and what they stand for.

use std::sync::LazyLock;

use super::conversion::FilteredIn;
use crate::imaging::srgb::{self, FROM_8, FROM_16};
use crate::imaging::{SampleKind, Samples, Transfer};

/// What the numbers are that a filter mixes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Working {
    /// Linear light.
    Light,
    /// Codes of sRGB, as shares of the largest.
    Codes,
}

impl Working {
    pub fn of(transfer: Transfer, filtered_in: FilteredIn) -> Self {
        match (transfer, filtered_in) {
            (Transfer::Srgb, FilteredIn::Codes) => Self::Codes,
            _ => Self::Light,
        }
    }
}

/// How a stored colour becomes a number to mix.
#[derive(Clone, Copy, Debug)]
pub(super) enum Decoder {
    /// Its share of the largest; of a float itself.
    Share,
    /// By table.
    Table(&'static [f32]),
    /// The sRGB curve: for floats, which no table holds.
    Curve,
}

/// c/255 for each byte: what [`crate::imaging::Raster::light`] says of linear samples.
static SHARES_8: LazyLock<Vec<f32>> =
    LazyLock::new(|| (0..=u8::MAX).map(|c| f32::from(c) / 255.0).collect());

impl Decoder {
    pub fn of(kind: SampleKind, transfer: Transfer, working: Working) -> Self {
        let is_coded = transfer == Transfer::Srgb && working == Working::Light;
        match (kind, is_coded) {
            (SampleKind::U8, false) => Self::Table(&SHARES_8),
            (SampleKind::U8, true) => Self::Table(&FROM_8),
            (SampleKind::U16, true) => Self::Table(&FROM_16),
            (SampleKind::F32, true) => Self::Curve,
            _ => Self::Share,
        }
    }
}

/// A number type of samples.
pub(super) trait Stored: Copy + Default + Send + Sync + 'static {
    /// The samples of a picture, when they are of this type.
    fn slice(samples: &Samples) -> Option<&[Self]>;
    /// The same to write.
    fn slice_mut(samples: &mut Samples) -> Option<&mut [Self]>;
    /// The samples of a picture.
    fn samples(list: Vec<Self>) -> Samples;
    /// Its share of the largest; of a float itself.
    fn share(self) -> f32;
    /// The colour that it stands for.
    fn decoded(self, decoder: Decoder) -> f32;
    /// The sample nearest to a share of the largest. `noise` in [0, 1) takes the place of the 1/2 that is added before
    /// rounding down; floats have no steps.
    fn from_share(share: f32, noise: f32) -> Self;
    /// The sample of the sRGB code nearest to that of a light.
    fn from_light(light: f32, noise: f32) -> Self;
}

macro_rules! stored_integer {
    ($type:ty, $variant:ident, $codes:ident) => {
        impl Stored for $type {
            fn slice(samples: &Samples) -> Option<&[Self]> {
                match samples {
                    Samples::$variant(list) => Some(list),
                    _ => None,
                }
            }
            fn slice_mut(samples: &mut Samples) -> Option<&mut [Self]> {
                match samples {
                    Samples::$variant(list) => Some(list),
                    _ => None,
                }
            }
            fn samples(list: Vec<Self>) -> Samples {
                Samples::$variant(list)
            }
            fn share(self) -> f32 {
                f32::from(self) / f32::from(Self::MAX)
            }
            fn decoded(self, decoder: Decoder) -> f32 {
                match decoder {
                    Decoder::Table(table) => table[usize::from(self)],
                    Decoder::Share => self.share(),
                    Decoder::Curve => srgb::linear_from_srgb(self.share()),
                }
            }
            fn from_share(share: f32, noise: f32) -> Self {
                // In f64: of 16 bits f32 would round a two-hundredth of a step. A cast clips, and makes NaN 0.
                (f64::from(share) * f64::from(Self::MAX) + f64::from(noise)) as Self
            }
            fn from_light(light: f32, noise: f32) -> Self {
                $codes.code(light, noise) as Self
            }
        }
    };
}
stored_integer!(u8, U8, CODES_8);
stored_integer!(u16, U16, CODES_16);

impl Stored for f32 {
    fn slice(samples: &Samples) -> Option<&[Self]> {
        match samples {
            Samples::F32(list) => Some(list),
            _ => None,
        }
    }
    fn slice_mut(samples: &mut Samples) -> Option<&mut [Self]> {
        match samples {
            Samples::F32(list) => Some(list),
            _ => None,
        }
    }
    fn samples(list: Vec<Self>) -> Samples {
        Samples::F32(list)
    }
    fn share(self) -> f32 {
        self
    }
    fn decoded(self, decoder: Decoder) -> f32 {
        match decoder {
            Decoder::Curve => srgb::linear_from_srgb(self),
            _ => self,
        }
    }
    fn from_share(share: f32, _: f32) -> Self {
        share
    }
    fn from_light(light: f32, _: f32) -> Self {
        srgb::srgb_from_linear(light)
    }
}

/// From light to the nearest code of sRGB, without a power for each texel.
///
/// The floats of [2^-18, 1) are cut into 512 pieces an octave. In a piece the code hardly bends: a straight line is off by at
/// most (1/512)^2/8 of the curve's second derivative per octave, 0.03 of a 16-bit step. The code so found is put right
/// against the exact light half-way between codes.
pub(super) struct Codes {
    last: u32,
    /// Code at the start of each piece and its rise over the piece.
    lines: Vec<(f32, f32)>,
    /// The light at code k + 1/2: from there on code k + 1 is nearer.
    halfway: Vec<f32>,
}

const LOWEST: u32 = (127 - 18) << 23;
const ONE: u32 = 127 << 23;
/// 23 bits of fraction less 9 for 512 pieces.
const PIECE_BITS: u32 = 14;

static CODES_8: LazyLock<Codes> = LazyLock::new(|| Codes::new(255));
static CODES_16: LazyLock<Codes> = LazyLock::new(|| Codes::new(65535));

fn light_of_code(code: f64) -> f64 {
    if code <= 0.04045 {
        code / 12.92
    } else {
        ((code + 0.055) / 1.055).powf(2.4)
    }
}

fn code_of_light(light: f64) -> f64 {
    if light <= 0.003_130_8 {
        light * 12.92
    } else {
        1.055 * light.powf(1.0 / 2.4) - 0.055
    }
}

impl Codes {
    fn new(last: u32) -> Self {
        let scale = f64::from(last);
        let code = |piece: u32| {
            let light = f32::from_bits(LOWEST + (piece << PIECE_BITS));
            scale * code_of_light(f64::from(light))
        };
        let pieces = (ONE - LOWEST) >> PIECE_BITS;
        Self {
            last,
            lines: (0..pieces)
                .map(|k| (code(k) as f32, (code(k + 1) - code(k)) as f32))
                .collect(),
            halfway: (0..last)
                .map(|k| light_of_code((f64::from(k) + 0.5) / scale) as f32)
                .collect(),
        }
    }

    /// The code as a real number, off by at most 0.03.
    fn real(&self, light: f32) -> f32 {
        let bits = light.to_bits();
        if light <= 0.0 || light.is_nan() {
            return 0.0;
        }
        if bits >= ONE {
            return self.last as f32;
        }
        if bits < LOWEST {
            return light * 12.92 * self.last as f32;
        }
        let above = bits - LOWEST;
        let (start, rise) = self.lines[(above >> PIECE_BITS) as usize];
        let within = (above & ((1 << PIECE_BITS) - 1)) as f32 / (1 << PIECE_BITS) as f32;
        start + rise * within
    }

    fn code(&self, light: f32, noise: f32) -> u32 {
        let real = self.real(light);
        let code = ((real + noise) as u32).min(self.last);
        if noise != 0.5 {
            return code;
        }
        let index = code as usize;
        if self.halfway.get(index).is_some_and(|&edge| light >= edge) {
            code + 1
        } else if index > 0 && light < self.halfway[index - 1] {
            code - 1
        } else {
            code
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The code of a light by the curve itself.
    fn exact(light: f32, last: f64) -> u32 {
        let code = code_of_light(f64::from(light).clamp(0.0, 1.0)) * last;
        (code + 0.5).floor() as u32
    }

    #[test]
    fn codes_are_the_nearest_and_come_back() {
        for (codes, last) in [(&*CODES_8, 255_u32), (&*CODES_16, 65535)] {
            for code in 0..=last {
                let light = light_of_code(f64::from(code) / f64::from(last)) as f32;
                assert_eq!(codes.code(light, 0.5), code);
            }
            let (mut worst, mut line) = (0.0_f64, 0.0_f64);
            for step in 0..2_000_000_u32 {
                // Every fifth-hundredth float from 2^-20 to 1.
                let light = f32::from_bits(((127 - 20) << 23) + step * 84);
                let real = code_of_light(f64::from(light).min(1.0)) * f64::from(last);
                let error = (f64::from(codes.code(light, 0.5)) - real).abs();
                worst = worst.max(error);
                line = line.max((f64::from(codes.real(light)) - real).abs());
            }
            assert!(worst < 0.5005 && worst > 0.4999, "{last}: {worst}");
            assert!(line < 0.03, "{last}: {line}");
        }
        for (light, code) in [
            (f32::NAN, 0),
            (-1.0, 0),
            (0.0, 0),
            (1.0, 255),
            (9.0, 255),
            (f32::INFINITY, 255),
        ] {
            assert_eq!(CODES_8.code(light, 0.5), code, "{light}");
        }
        assert_ne!(
            exact(0.5, 255.0),
            CODES_8.code(0.51, 0.5),
            "another light has another code"
        );
    }
}
