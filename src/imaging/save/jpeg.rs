//! JPEG pictures: codes of sRGB, without opacity.

use std::cell::RefCell;
use std::io::{self, Write};

use image::codecs::jpeg::JpegEncoder;
use image::{GenericImageView, ImageError, Rgb};

use super::rows::{code8, values};
use super::{Fault, Job, RowsLeft};
use crate::imaging::{Channels, Raster, Transfer};

/// Sides have 16 bits.
const MOST_SIDE: u32 = 65535;

pub(super) fn write(raster: &Raster, quality: u8, job: &mut Job) -> Result<(), Fault> {
    let [width, height] = raster.size();
    if width.max(height) > MOST_SIDE {
        return Err(Fault::Unfit(format!(
            "{width} x {height} texels, the limit is {MOST_SIDE} a side; choose PNG"
        )));
    }
    let rows = Rows {
        raster,
        band: RefCell::default(),
    };
    let out = Stoppable {
        out: &mut *job.out,
        rows: &job.progress,
    };
    let mut encoder = JpegEncoder::new_with_quality(out, quality.clamp(1, 100));
    encoder.encode_image(&rows).map_err(|error| match error {
        ImageError::IoError(cause) => Fault::Io(cause),
        other => Fault::Encoder(other.to_string()),
    })?;
    job.rows_done(height)
}

/// The encoder asks for texels one by one, block by block: eight rows are kept as codes.
struct Rows<'a> {
    raster: &'a Raster,
    band: RefCell<Band>,
}

#[derive(Default)]
struct Band {
    first: u32,
    codes: Vec<u8>,
}

/// Rows of a block.
const BLOCK: u32 = 8;

impl GenericImageView for Rows<'_> {
    type Pixel = Rgb<u8>;

    fn dimensions(&self) -> (u32, u32) {
        (self.raster.width(), self.raster.height())
    }

    fn get_pixel(&self, x: u32, y: u32) -> Rgb<u8> {
        let mut band = self.band.borrow_mut();
        let first = y - y % BLOCK;
        if band.codes.is_empty() || band.first != first {
            let length = self.raster.width() as usize * 3;
            let mut shares = vec![0.0; length];
            band.codes.clear();
            for row in first..(first + BLOCK).min(self.raster.height()) {
                values(self.raster, row, Channels::Rgb, Transfer::Srgb, &mut shares);
                band.codes.extend(shares.iter().map(|s| code8(*s)));
            }
            band.first = first;
        }
        let at = ((y - first) as usize * self.raster.width() as usize + x as usize) * 3;
        Rgb([band.codes[at], band.codes[at + 1], band.codes[at + 2]])
    }
}

/// The encoder cannot be stopped but by its output.
struct Stoppable<'a, W> {
    out: W,
    rows: &'a RowsLeft<'a>,
}

impl<W: Write> Write for Stoppable<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.rows.stop_if_cancelled() {
            Ok(()) => self.out.write(bytes),
            Err(_) => Err(io::Error::other("cancelled")),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
