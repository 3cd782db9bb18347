//! Texels as containers store them.

use std::io::{self, Read};

use crate::imaging::load::{LoadProblem, reserved};
use crate::imaging::save::rows::{code8, half, stored_codes, values};
use crate::imaging::shared_exponent::RGB9E5;
use crate::imaging::{Channels, Raster, Samples, Stored, Transfer};

/// A kind of texel with its names in both formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TexelFormat {
    /// Number in Vulkan's VkFormat.
    pub(super) vulkan: u32,
    /// Number in DXGI_FORMAT.
    pub(super) dxgi: u32,
    /// How a sample is stored.
    pub(super) stored: Stored,
    /// How it becomes light.
    pub(super) transfer: Transfer,
    order: Order,
}

/// What stands in a texel, from the lowest byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    Rgba,
    Bgra,
    /// The fourth byte means nothing.
    Bgrx,
    /// Mantissas of 9 bits from the lowest, and their exponent.
    Packed,
}

const fn format(
    vulkan: u32,
    dxgi: u32,
    stored: Stored,
    transfer: Transfer,
    order: Order,
) -> TexelFormat {
    TexelFormat {
        vulkan,
        dxgi,
        stored,
        transfer,
        order,
    }
}

use Order::{Bgra, Bgrx, Packed, Rgba};
use Transfer::{Linear, Srgb};

/// All that open. The first that fits is written. 0 stands for what the other format does not know.
const FORMATS: [TexelFormat; 9] = [
    format(37, 28, Stored::U8, Linear, Rgba), // R8G8B8A8_UNORM
    format(43, 29, Stored::U8, Srgb, Rgba),
    format(97, 10, Stored::Half, Linear, Rgba), // R16G16B16A16_SFLOAT
    format(109, 2, Stored::F32, Linear, Rgba),  // R32G32B32A32_SFLOAT
    format(123, 67, Stored::Rgb9e5, Linear, Packed), // E5B9G9R9_UFLOAT_PACK32
    format(44, 87, Stored::U8, Linear, Bgra),   // B8G8R8A8_UNORM
    format(50, 91, Stored::U8, Srgb, Bgra),
    format(0, 88, Stored::U8, Linear, Bgrx), // B8G8R8X8_UNORM
    format(0, 93, Stored::U8, Srgb, Bgrx),
];

impl TexelFormat {
    pub(super) fn of_vulkan(number: u32) -> Option<Self> {
        FORMATS
            .into_iter()
            .find(|f| f.vulkan == number && number != 0)
    }

    pub(super) fn of_dxgi(number: u32) -> Option<Self> {
        FORMATS
            .into_iter()
            .find(|f| f.dxgi == number && number != 0)
    }

    /// What a raster is written as. Only codes of 8 bits that are no sRGB stay without it.
    pub(super) fn to_write(stored: Stored, raster: &Raster) -> Option<Self> {
        let is_linear =
            matches!(raster.samples(), Samples::U8(_)) && raster.transfer() == Transfer::Linear;
        FORMATS.into_iter().find(|f| {
            f.stored == stored && (stored != Stored::U8 || is_linear == (f.transfer == Linear))
        })
    }

    /// Bytes of a texel in the file.
    pub(super) const fn bytes(self) -> u64 {
        match self.stored {
            Stored::Half => 8,
            Stored::F32 => 16,
            _ => 4,
        }
    }

    /// Bytes of a texel of a raster.
    pub(super) const fn raster_bytes(self) -> u64 {
        (self.channels().count() * self.stored.kind().bytes()) as u64
    }

    pub(super) const fn channels(self) -> Channels {
        match self.order {
            Rgba | Bgra => Channels::Rgba,
            Bgrx | Packed => Channels::Rgb,
        }
    }

    /// One picture, row by row.
    pub(super) fn read(
        self,
        [width, height]: [u32; 2],
        bytes: &mut dyn Read,
        mut row_done: impl FnMut() -> Result<(), LoadProblem>,
        damaged: impl Fn(io::Error) -> LoadProblem,
    ) -> Result<Option<Raster>, LoadProblem> {
        let count = width as usize * height as usize * self.channels().count();
        let mut row = vec![0; width as usize * self.bytes() as usize];
        let mut samples = match self.stored {
            Stored::U8 => Samples::U8(reserved(count)?),
            _ => Samples::F32(reserved(count)?),
        };
        for _ in 0..height {
            bytes.read_exact(&mut row).map_err(&damaged)?;
            self.append(&row, &mut samples);
            row_done()?;
        }
        Ok(Raster::new(
            [width, height],
            self.channels(),
            self.transfer,
            samples,
        ))
    }

    fn append(self, row: &[u8], samples: &mut Samples) {
        let (words, _) = row.as_chunks::<4>();
        match (samples, self.stored) {
            (Samples::U8(codes), _) => match self.order {
                Bgra => codes.extend(words.iter().flat_map(|&[b, g, r, a]| [r, g, b, a])),
                Bgrx => codes.extend(words.iter().flat_map(|&[b, g, r, _]| [r, g, b])),
                _ => codes.extend_from_slice(row),
            },
            (Samples::F32(light), Stored::Half) => {
                let (pairs, _) = row.as_chunks::<2>();
                light.extend(pairs.iter().map(|p| half::f16::from_le_bytes(*p).to_f32()));
            }
            (Samples::F32(light), Stored::F32) => {
                light.extend(words.iter().map(|w| f32::from_le_bytes(*w)));
            }
            (Samples::F32(light), _) => {
                let packed = words.iter().map(|w| u32::from_le_bytes(*w));
                light.extend(packed.flat_map(|texel| {
                    let mantissas = [0, 9, 18].map(|bit| (texel >> bit) & 0x1ff);
                    RGB9E5.decode(mantissas, texel >> 27)
                }));
            }
            (Samples::U16(_), _) => {}
        }
    }

    /// Appends a row's bytes. `numbers` is room for its numbers.
    pub(super) fn write_row(
        self,
        raster: &Raster,
        y: u32,
        numbers: &mut Vec<f32>,
        bytes: &mut Vec<u8>,
    ) {
        let channels = self.channels();
        if let Some(codes) = stored_codes(raster, y, channels, self.transfer)
            && self.stored == Stored::U8
        {
            bytes.extend_from_slice(codes);
            return;
        }
        numbers.resize(raster.width() as usize * channels.count(), 0.0);
        values(raster, y, channels, self.transfer, numbers);
        match self.stored {
            Stored::Half => bytes.extend(numbers.iter().flat_map(|c| half(*c).to_le_bytes())),
            Stored::F32 => bytes.extend(numbers.iter().flat_map(|c| c.to_le_bytes())),
            Stored::Rgb9e5 => {
                let (colors, _) = numbers.as_chunks::<3>();
                bytes.extend(colors.iter().flat_map(|color| {
                    let ([r, g, b], e) = RGB9E5.encode(*color);
                    (r | g << 9 | b << 18 | e << 27).to_le_bytes()
                }));
            }
            _ => bytes.extend(numbers.iter().map(|c| code8(*c))),
        }
    }
}
