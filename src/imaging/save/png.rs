//! PNG pictures of 8 or 16 bits: codes of sRGB, with opacity where there is one.

use std::io::Write;

use super::rows::{code8, code16, stored_codes, values};
use super::{Fault, Job};
use crate::imaging::{Channels, Raster, Stored, Transfer};

pub(super) fn write(raster: &Raster, stored: Stored, job: &mut Job) -> Result<(), Fault> {
    let is_wide = stored == Stored::U16;
    let [width, height] = raster.size();
    let channels = raster.channels();
    let mut encoder = png::Encoder::new(&mut *job.out, width, height);
    encoder.set_color(match channels {
        Channels::Rgb => png::ColorType::Rgb,
        Channels::Rgba => png::ColorType::Rgba,
    });
    encoder.set_depth(if is_wide {
        png::BitDepth::Sixteen
    } else {
        png::BitDepth::Eight
    });
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    let mut writer = encoder.write_header()?;
    let mut rows = writer.stream_writer()?;
    let mut shares = vec![0.0; width as usize * channels.count()];
    let mut bytes = Vec::new();
    for y in 0..height {
        match stored_codes(raster, y, channels, Transfer::Srgb) {
            Some(codes) if !is_wide => rows.write_all(codes)?,
            _ => {
                values(raster, y, channels, Transfer::Srgb, &mut shares);
                bytes.clear();
                if is_wide {
                    bytes.extend(shares.iter().flat_map(|s| code16(*s).to_be_bytes()));
                } else {
                    bytes.extend(shares.iter().map(|s| code8(*s)));
                }
                rows.write_all(&bytes)?;
            }
        }
        job.progress.rows_done(1)?;
    }
    rows.finish()?;
    Ok(writer.finish()?)
}

impl From<png::EncodingError> for Fault {
    fn from(error: png::EncodingError) -> Self {
        match error {
            png::EncodingError::IoError(cause) => Self::Io(cause),
            other => Self::Encoder(other.to_string()),
        }
    }
}
