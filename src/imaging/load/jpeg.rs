//! JPEG pictures: codes of sRGB; grey becomes RGB, CMYK is converted by the decoder.

use std::io::Cursor;

use image::codecs::jpeg::JpegDecoder;
use image::{ColorType, ImageDecoder};

use super::decoded::{Decoded, Texels};
use super::{Format, Job, LoadProblem};
use crate::imaging::{Channels, Stored};

/// The decoder cannot be stopped, so a cancelled job ends before or after it.
pub(super) fn decode(job: &Job) -> Result<Decoded, LoadProblem> {
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
    let mut codes = job.zeroed(0, job.texels() * channels)?;
    decoder.read_image(&mut codes).map_err(damaged)?;
    if channels == 1 {
        let mut colors = job.reserved(job.texels() * 3)?;
        colors.extend(codes.iter().flat_map(|&grey| [grey; 3]));
        codes = colors;
    }
    job.row_done(job.height as usize)?;
    Ok(Decoded {
        texels: Texels::U8(Channels::Rgb, codes),
        stored: Stored::U8,
        envmap: None,
    })
}

fn damaged(reason: impl ToString) -> LoadProblem {
    LoadProblem::damaged(Format::Jpeg, reason)
}
