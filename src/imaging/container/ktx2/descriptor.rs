//! The data format descriptor: one basic block (Khronos Data Format Specification 1.3, section 5).

use super::damaged;
use crate::imaging::container::Fields;
use crate::imaging::container::texels::TexelFormat;
use crate::imaging::load::LoadProblem;
use crate::imaging::{Stored, Transfer};

/// The model of plain colours: red, green, blue, stencil, depth, alpha.
const RGBSDA: u8 = 1;

/// Whether the descriptor is one of plain colours. What the texels are says `vkFormat` already.
pub(super) fn check(bytes: &[u8]) -> Result<(), LoadProblem> {
    let mut fields = Fields(bytes);
    let (Some([total, kind, _block]), Some(&[model, ..])) = (fields.u32s(), fields.take(4)) else {
        return Err(damaged("its data format descriptor breaks off"));
    };
    if total as usize != bytes.len() || kind != 0 || model != RGBSDA {
        return Err(damaged("its data format descriptor contradicts its format"));
    }
    Ok(())
}

/// The descriptor of a kind of texels.
pub(super) fn write(texel: TexelFormat) -> Vec<u8> {
    const VERSION: u32 = 2;
    const BT709: u8 = 1;
    const STRAIGHT_ALPHA: u8 = 0;
    let samples = samples(texel);
    let block_bytes = 24 + 16 * samples.len() as u32;
    let mut bytes = Vec::new();
    bytes.extend((4 + block_bytes).to_le_bytes());
    bytes.extend(0_u32.to_le_bytes()); // Khronos, basic
    bytes.extend((VERSION | block_bytes << 16).to_le_bytes());
    let transfer = match texel.transfer {
        Transfer::Linear => 1,
        Transfer::Srgb => 2,
    };
    bytes.extend([RGBSDA, BT709, transfer, STRAIGHT_ALPHA]);
    bytes.extend([0; 4]); // a block is one texel
    bytes.extend([texel.bytes() as u8, 0, 0, 0, 0, 0, 0, 0]); // in one plane
    for sample in samples {
        // Lengths are stored one less.
        let place = sample.first_bit | (sample.bits - 1) << 16 | sample.kind << 24;
        for number in [place, 0, sample.lowest, sample.highest] {
            bytes.extend(number.to_le_bytes());
        }
    }
    bytes
}

/// A run of bits that belongs to one channel.
struct Sample {
    first_bit: u32,
    bits: u32,
    /// Channel and qualifiers.
    kind: u32,
    /// What stands for black, or the lowest that the channel can be.
    lowest: u32,
    /// What stands for 1.
    highest: u32,
}

/// The samples of a texel from its lowest bit; of a shared exponent each channel has its own.
fn samples(texel: TexelFormat) -> Vec<Sample> {
    const CHANNELS: [u32; 4] = [0, 1, 2, 15]; // red, green, blue, alpha
    const LINEAR: u32 = 0x10;
    const EXPONENT: u32 = 0x20;
    const SIGNED_FLOAT: u32 = 0x40 | 0x80;
    let even = |bits: u32, qualifiers: fn(u32) -> u32, lowest: u32, highest: u32| {
        let sample = |(k, channel): (u32, u32)| Sample {
            first_bit: k * bits,
            bits,
            kind: channel | qualifiers(channel),
            lowest,
            highest,
        };
        (0..).zip(CHANNELS).map(sample).collect()
    };
    let float = |bits| {
        let (lowest, highest) = ((-1.0_f32).to_bits(), 1.0_f32.to_bits());
        even(bits, |_| SIGNED_FLOAT, lowest, highest)
    };
    match (texel.stored, texel.transfer) {
        (Stored::Half, _) => float(16),
        (Stored::F32, _) => float(32),
        (Stored::Rgb9e5, _) => {
            // What stands for 1 is 256 * 2^(16 - 24): the mantissa 256 below the exponent 16. Of the exponent the samples say
            // bias and largest.
            const ONE: u32 = 16 << 9 | 256;
            let pair = |k: u32| {
                let mantissa = Sample {
                    first_bit: 9 * k,
                    bits: 9,
                    kind: CHANNELS[k as usize],
                    lowest: 0,
                    highest: ONE,
                };
                let exponent = Sample {
                    first_bit: 27,
                    bits: 5,
                    kind: CHANNELS[k as usize] | EXPONENT,
                    lowest: 15,
                    highest: 31,
                };
                [mantissa, exponent]
            };
            (0..3).flat_map(pair).collect()
        }
        // Opacity is linear beside codes of sRGB.
        (_, Transfer::Srgb) => even(8, |c| if c == 15 { LINEAR } else { 0 }, 0, 255),
        (_, Transfer::Linear) => even(8, |_| 0, 0, 255),
    }
}
