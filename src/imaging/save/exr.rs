//! OpenEXR pictures: scan lines, half or float, compressed without loss.

use std::io::{Seek, Write};

use exr::block::writer::ChunksWriter;
use exr::block::{BlockIndex, UncompressedBlock};
use exr::compression::Compression;
use exr::error::Error;
use exr::math::Vec2;
use exr::meta::BlockDescription;
use exr::meta::attribute::{ChannelDescription, EnvironmentMap, LineOrder, SampleType};
use exr::meta::header::{Header, LayerAttributes};
use rayon::prelude::*;

use super::rows::{half, values};
use super::{Fault, Job, RowsLeft};
use crate::imaging::load::EnvmapKind;
use crate::imaging::{Channels, Raster, Stored, Transfer};

/// Deflate looks 32 KiB back. Lines of twice that compress as well alone as sixteen together, in a sixteenth of the memory.
const LONG_LINE_BYTES: usize = 1 << 16;

pub(super) fn write(
    raster: &Raster,
    stored: Stored,
    envmap: Option<EnvmapKind>,
    job: &mut Job,
) -> Result<(), Fault> {
    let header = header(raster, stored == Stored::Half, envmap);
    let written = exr::block::writer::write_chunks_with(
        &mut *job.out,
        [header].into_iter().collect(),
        true,
        |meta, chunks| write_blocks(raster, &meta.headers, chunks, &mut job.progress),
    );
    written.map_err(|error| match error {
        Error::Io(cause) => Fault::Io(cause),
        Error::Aborted => Fault::Cancelled,
        Error::NotSupported(reason) | Error::Invalid(reason) => Fault::Encoder(reason.to_string()),
    })
}

fn header(raster: &Raster, is_half: bool, envmap: Option<EnvmapKind>) -> Header {
    // By name, as the format wants it.
    let names: &[&str] = match raster.channels() {
        Channels::Rgb => &["B", "G", "R"],
        Channels::Rgba => &["A", "B", "G", "R"],
    };
    let channel = |name: &&str| ChannelDescription {
        name: (*name).into(),
        sample_type: if is_half {
            SampleType::F16
        } else {
            SampleType::F32
        },
        quantize_linearly: *name == "A",
        sampling: Vec2(1, 1),
    };
    let size = Vec2(raster.width() as usize, raster.height() as usize);
    let line_bytes = size.0 * names.len() * if is_half { 2 } else { 4 };
    let compression = if line_bytes >= LONG_LINE_BYTES {
        Compression::ZIP1
    } else {
        Compression::ZIP16
    };
    let attributes = LayerAttributes {
        environment_map: envmap.map(|kind| match kind {
            EnvmapKind::Latlong => EnvironmentMap::LatitudeLongitude,
            EnvmapKind::Cube => EnvironmentMap::Cube,
        }),
        software_name: Some("sixfold".into()),
        ..LayerAttributes::default()
    };
    Header::new("".into(), size, names.iter().map(channel).collect())
        .with_encoding(
            compression,
            BlockDescription::ScanLines,
            LineOrder::Increasing,
        )
        .with_attributes(attributes)
}

/// As many blocks at a time as there are threads; they are written in order.
fn write_blocks<W: Write + Seek>(
    raster: &Raster,
    headers: &[Header],
    chunks: &mut exr::block::writer::ChunkWriter<W>,
    rows: &mut RowsLeft,
) -> Result<(), Error> {
    let lines = headers[0].compression.scan_lines_per_block() as u32;
    let starts: Vec<u32> = (0..raster.height()).step_by(lines as usize).collect();
    let mut index = 0;
    for batch in starts.chunks(rayon::current_num_threads().max(1)) {
        let compress = |&y: &u32| block(raster, &headers[0], y, lines).compress_to_chunk(headers);
        let compressed: Vec<_> = batch.par_iter().map(compress).collect();
        for chunk in compressed {
            chunks.write_chunk(index, chunk?)?;
            index += 1;
        }
        let done = batch.len() as u32 * lines;
        rows.rows_done(done).map_err(|_| Error::Aborted)?;
    }
    Ok(())
}

/// Lines `y` and following: each holds its channels one after another.
fn block(raster: &Raster, header: &Header, y: u32, lines: u32) -> UncompressedBlock {
    let count = raster.channels().count();
    let width = raster.width() as usize;
    let rows = y..(y + lines).min(raster.height());
    let size = Vec2(width, rows.len());
    let mut data = Vec::with_capacity(size.area() * header.channels.bytes_per_pixel);
    let mut light = vec![0.0; width * count];
    for row in rows {
        values(raster, row, raster.channels(), Transfer::Linear, &mut light);
        for (place, channel) in header.channels.list.iter().enumerate() {
            // A, B, G, R backwards are R, G, B, A.
            let samples = light.iter().skip(count - 1 - place).step_by(count);
            match channel.sample_type {
                SampleType::F16 => data.extend(samples.flat_map(|c| half(*c).to_ne_bytes())),
                _ => data.extend(samples.flat_map(|c| c.to_ne_bytes())),
            }
        }
    }
    UncompressedBlock {
        index: BlockIndex {
            layer: 0,
            pixel_position: Vec2(0, y as usize),
            pixel_size: size,
            level: Vec2(0, 0),
        },
        data,
    }
}
