//! Pixels as a file holds them: 8, 16 or 32 bits a sample, with or without alpha.

use serde::{Deserialize, Serialize};

use super::srgb;

/// What stands in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Channels {
    /// Red, green, blue.
    Rgb,
    /// Red, green, blue and opacity, not premultiplied.
    Rgba,
}

impl Channels {
    /// Samples in a pixel: 3 or 4.
    pub const fn count(self) -> usize {
        match self {
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }
}

/// The number type of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SampleKind {
    /// 0 to 255.
    U8,
    /// 0 to 65535.
    U16,
    /// Any finite number.
    F32,
}

impl SampleKind {
    /// Bytes of a sample.
    pub const fn bytes(self) -> usize {
        match self {
            Self::U8 => 1,
            Self::U16 => 2,
            Self::F32 => 4,
        }
    }
}

/// How a file stores a sample. [`Raster`] holds each exactly: halves and shared exponents as [`SampleKind::F32`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stored {
    /// 8 bits, whole.
    U8,
    /// 16 bits, whole.
    U16,
    /// 16 bits, floating.
    Half,
    /// 32 bits, floating.
    F32,
    /// Radiance's three mantissas of 8 bits with a common exponent.
    Rgbe,
    /// Three mantissas of 9 bits with a common exponent of 5.
    Rgb9e5,
}

impl Stored {
    /// The number type of a raster that holds it exactly.
    pub const fn kind(self) -> SampleKind {
        match self {
            Self::U8 => SampleKind::U8,
            Self::U16 => SampleKind::U16,
            Self::Half | Self::F32 | Self::Rgbe | Self::Rgb9e5 => SampleKind::F32,
        }
    }
}

/// How stored numbers become light. Opacity is always linear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Transfer {
    /// The number is the light: of an integer, its share of the largest.
    Linear,
    /// The number is a code of sRGB (IEC 61966-2-1).
    Srgb,
}

/// The samples of a picture, pixel after pixel, row after row from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// 8 bits.
    U8(Vec<u8>),
    /// 16 bits.
    U16(Vec<u16>),
    /// 32 bits, floating.
    F32(Vec<f32>),
}

impl Samples {
    /// Their number type.
    pub const fn kind(&self) -> SampleKind {
        match self {
            Self::U8(_) => SampleKind::U8,
            Self::U16(_) => SampleKind::U16,
            Self::F32(_) => SampleKind::F32,
        }
    }

    /// How many there are.
    pub const fn len(&self) -> usize {
        match self {
            Self::U8(samples) => samples.len(),
            Self::U16(samples) => samples.len(),
            Self::F32(samples) => samples.len(),
        }
    }

    /// Whether there is none.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A picture as it is stored. Unlike [`super::Image`] it keeps what the file held: codes, opacity, every bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    width: u32,
    height: u32,
    channels: Channels,
    transfer: Transfer,
    samples: Samples,
}

impl Raster {
    /// A picture from its samples; `None` when their number is not width x height x channels, or 0.
    pub fn new(
        [width, height]: [u32; 2],
        channels: Channels,
        transfer: Transfer,
        samples: Samples,
    ) -> Option<Self> {
        let expected = u64::from(width) * u64::from(height) * channels.count() as u64;
        (expected > 0 && samples.len() as u64 == expected).then_some(Self {
            width,
            height,
            channels,
            transfer,
            samples,
        })
    }

    /// Pixels in a row.
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// [width, height].
    pub const fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// What stands in a pixel.
    pub const fn channels(&self) -> Channels {
        self.channels
    }

    /// How the numbers become light.
    pub const fn transfer(&self) -> Transfer {
        self.transfer
    }

    /// The samples.
    pub const fn samples(&self) -> &Samples {
        &self.samples
    }

    /// The samples, to change in place.
    pub const fn samples_mut(&mut self) -> &mut Samples {
        &mut self.samples
    }

    /// Takes the numbers to become light in another way; none is changed.
    pub const fn retag(&mut self, transfer: Transfer) {
        self.transfer = transfer;
    }

    /// Bytes that the samples take.
    pub const fn bytes(&self) -> u64 {
        self.samples.len() as u64 * self.samples.kind().bytes() as u64
    }

    /// Colour in linear light and opacity of pixel (x, y); black and clear outside. For tests, previews and readouts: one
    /// pixel at a time.
    pub fn light(&self, x: u32, y: u32) -> [f32; 4] {
        if x >= self.width || y >= self.height {
            return [0.0; 4];
        }
        let count = self.channels.count();
        let at = (y as usize * self.width as usize + x as usize) * count;
        let mut pixel = [0.0, 0.0, 0.0, 1.0];
        for (channel, value) in pixel.iter_mut().enumerate().take(count) {
            let code = match &self.samples {
                Samples::U8(samples) => f32::from(samples[at + channel]) / 255.0,
                Samples::U16(samples) => f32::from(samples[at + channel]) / 65535.0,
                Samples::F32(samples) => samples[at + channel],
            };
            *value = match self.transfer {
                Transfer::Srgb if channel < 3 => srgb::linear_from_srgb(code),
                _ => code,
            };
        }
        pixel
    }
}
