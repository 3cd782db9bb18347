//! PNG pictures of any depth and colour type: decoded from sRGB, alpha ignored (an environment has no hole).

use std::io::Cursor;

use super::super::srgb::{FROM_8, FROM_16};
use super::{Format, Job, LoadProblem, reserved, zeroed};

/// What the decoder may hold beside the picture: an interlaced one is decoded whole, at most 8 bytes a texel.
const MOST_DECODER_BYTES: usize = super::MOST_WIDTH as usize * super::MOST_HEIGHT as usize * 8;

pub(super) fn decode(job: &Job) -> Result<Vec<[f32; 3]>, LoadProblem> {
    let limits = png::Limits {
        bytes: MOST_DECODER_BYTES,
    };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(job.bytes), limits);
    decoder.set_transformations(png::Transformations::EXPAND);
    // Text and profiles may unpack to a thousand times their length, and are not needed.
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let mut reader = decoder.read_info().map_err(damaged)?;
    if reader.info().size() != (job.width, job.height) {
        return Err(damaged("its headers disagree about the size"));
    }
    let (color, depth) = reader.output_color_type();
    let (samples, wide) = (color.samples(), depth == png::BitDepth::Sixteen);
    let mut pixels = reserved(job.texels())?;
    if reader.info().interlaced {
        let size = reader
            .output_buffer_size()
            .ok_or_else(|| damaged("it is too large"))?;
        let mut raw = zeroed(0, size)?;
        let frame = reader.next_frame(&mut raw).map_err(damaged)?;
        for (y, row) in raw.chunks_exact(frame.line_size.max(1)).enumerate() {
            push_row(&mut pixels, row, samples, wide);
            job.row_done(y + 1)?;
        }
    } else {
        let mut rows = 0;
        while let Some(row) = reader.next_row().map_err(damaged)? {
            push_row(&mut pixels, row.data(), samples, wide);
            rows += 1;
            job.row_done(rows)?;
        }
    }
    Ok(pixels)
}

/// Appends one row: grey or RGB, with or without alpha, 8 or 16 bits (high byte first).
fn push_row(pixels: &mut Vec<[f32; 3]>, row: &[u8], samples: usize, wide: bool) {
    let sample_bytes = if wide { 2 } else { 1 };
    let step = if samples >= 3 { sample_bytes } else { 0 };
    pixels.extend(row.chunks_exact(samples * sample_bytes).map(|texel| {
        [0, 1, 2].map(|channel| {
            let at = channel * step;
            if wide {
                FROM_16[usize::from(u16::from_be_bytes([texel[at], texel[at + 1]]))]
            } else {
                FROM_8[usize::from(texel[at])]
            }
        })
    }));
}

fn damaged(reason: impl ToString) -> LoadProblem {
    LoadProblem::damaged(Format::Png, reason)
}
