//! JPEG pictures: decoded from sRGB; grey becomes RGB, CMYK is converted by the decoder.

use std::io::Cursor;

use image::codecs::jpeg::JpegDecoder;
use image::{ColorType, ImageDecoder};

use super::super::srgb::linear_from_srgb8;
use super::{Format, Job, LoadProblem, reserved, zeroed};

/// The decoder cannot be stopped, so a cancelled job ends before or after it.
pub(super) fn decode(job: &Job) -> Result<Vec<[f32; 3]>, LoadProblem> {
    let decoder = JpegDecoder::new(Cursor::new(job.bytes)).map_err(damaged)?;
    if decoder.dimensions() != (job.width, job.height) {
        return Err(damaged("its frame headers disagree about the size"));
    }
    let channels = match decoder.color_type() {
        ColorType::L8 => 1,
        ColorType::Rgb8 => 3,
        other => {
            let what = format!("{other:?}; save it as 8-bit grey or RGB");
            return Err(LoadProblem::Unsupported {
                format: Format::Jpeg,
                what,
            });
        }
    };
    let mut raw = zeroed(0, job.texels() * channels)?;
    decoder.read_image(&mut raw).map_err(damaged)?;
    let mut pixels = reserved(job.texels())?;
    for (y, row) in raw.chunks_exact(job.width as usize * channels).enumerate() {
        pixels.extend(row.chunks_exact(channels).map(|texel| match *texel {
            [r, g, b] => linear_from_srgb8([r, g, b]),
            _ => linear_from_srgb8([texel[0]; 3]),
        }));
        job.row_done(y + 1)?;
    }
    Ok(pixels)
}

fn damaged(reason: impl ToString) -> LoadProblem {
    LoadProblem::damaged(Format::Jpeg, reason)
}
