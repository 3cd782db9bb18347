//! PNG pictures of any depth and colour type: codes of sRGB. Where light is wanted, rows are decoded as they come, and opacity
//! is left out (an environment has no hole).

use std::io::Cursor;

use super::decoded::{Decoded, Texels, light_of_8, light_of_16};
use super::{Format, Job, LoadProblem, zeroed};
use crate::imaging::{Channels, Stored};

/// What the decoder may hold beside the picture: an interlaced one is decoded whole.
const MOST_DECODER_BYTES: usize = super::MOST_RASTER_BYTES as usize;

pub(super) fn decode(job: &Job) -> Result<Decoded, LoadProblem> {
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
    let row_form = RowForm {
        samples: color.samples(),
        is_wide: depth == png::BitDepth::Sixteen,
    };
    let mut texels = row_form.no_texels(job)?;
    if reader.info().interlaced {
        let size = reader
            .output_buffer_size()
            .ok_or_else(|| damaged("it is too large"))?;
        super::judged_bytes(job.width, job.height, size as u64)?;
        let mut raw = zeroed(0, size)?;
        let frame = reader.next_frame(&mut raw).map_err(damaged)?;
        for (y, row) in raw.chunks_exact(frame.line_size.max(1)).enumerate() {
            row_form.append(row, &mut texels);
            job.row_done(y + 1)?;
        }
    } else {
        let mut rows = 0;
        while let Some(row) = reader.next_row().map_err(damaged)? {
            row_form.append(row.data(), &mut texels);
            rows += 1;
            job.row_done(rows)?;
        }
    }
    Ok(Decoded {
        texels,
        stored: if row_form.is_wide {
            Stored::U16
        } else {
            Stored::U8
        },
        envmap: None,
    })
}

/// What a row holds: grey or RGB, with or without opacity (1 to 4 samples a texel), 8 or 16 bits, high byte first.
struct RowForm {
    samples: usize,
    is_wide: bool,
}

impl RowForm {
    fn channels(&self) -> Channels {
        if self.samples.is_multiple_of(2) {
            Channels::Rgba
        } else {
            Channels::Rgb
        }
    }

    fn no_texels(&self, job: &Job) -> Result<Texels, LoadProblem> {
        let channels = self.channels();
        let samples = job.texels() * channels.count();
        Ok(match (job.keeps_bits, self.is_wide) {
            (true, false) => Texels::U8(channels, job.reserved(samples)?),
            (true, true) => Texels::U16(channels, job.reserved(samples)?),
            (false, _) => Texels::Rgb(job.reserved(job.texels())?),
        })
    }

    fn append(&self, row: &[u8], texels: &mut Texels) {
        if self.is_wide {
            let (pairs, _) = row.as_chunks::<2>();
            let codes = pairs.chunks_exact(self.samples);
            let colors = codes.map(|texel| colored(texel).map(|&pair| u16::from_be_bytes(pair)));
            match texels {
                Texels::U16(channels, codes) => {
                    codes.extend(colors.flat_map(|texel| texel.into_iter().take(channels.count())));
                }
                Texels::Rgb(light) => light.extend(colors.map(|texel| light_of_16(&texel))),
                _ => {}
            }
        } else {
            let colors = row
                .chunks_exact(self.samples)
                .map(|texel| colored(texel).map(|&code| code));
            match texels {
                Texels::U8(channels, codes) if channels.count() == self.samples => {
                    codes.extend_from_slice(row);
                }
                Texels::U8(channels, codes) => {
                    codes.extend(colors.flat_map(|texel| texel.into_iter().take(channels.count())));
                }
                Texels::Rgb(light) => light.extend(colors.map(|texel| light_of_8(&texel))),
                _ => {}
            }
        }
    }
}

/// The four parts of a texel of 1 to 4 samples: grey is as much of each colour; without opacity the fourth is any.
fn colored<T>(texel: &[T]) -> [&T; 4] {
    match texel {
        [grey, alpha] => [grey, grey, grey, alpha],
        [r, g, b, rest @ ..] => [r, g, b, rest.first().unwrap_or(b)],
        _ => [&texel[0]; 4],
    }
}

fn damaged(reason: impl ToString) -> LoadProblem {
    LoadProblem::damaged(Format::Png, reason)
}
