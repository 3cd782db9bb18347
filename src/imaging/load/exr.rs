//! OpenEXR pictures: scan lines or tiles, every compression, 16- and 32-bit samples; RGB or luminance alone, with or without
//! opacity.
//!
//! The crate that reads the blocks allocates whatever a header declares and has asserts that bad headers reach, so the
//! header is judged between reading and decoding, the blocks are unpacked here one by one, and both run where a panic is
//! caught: damaged B44 blocks index out of bounds there (and a panic in that crate's own thread pool would end the process).

use std::io::Cursor;

use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock};
use exr::block::reader::ChunksReader;
use exr::compression::Compression;
use exr::math::Vec2;
use exr::meta::attribute::{ChannelList, EnvironmentMap, SampleType};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};

use super::decoded::{Decoded, Texels};
use super::{EnvmapKind, Format, Job, LoadProblem, MOST_RASTER_BYTES, MOST_SIDE};
use crate::imaging::Stored;

/// All channels of all layers together, unpacked: twice what may be shown of them.
const MOST_UNPACKED_BYTES: u64 = 2 * MOST_RASTER_BYTES;

/// One block unpacked: 256 lines (the highest block there is) of the largest width with four channels of 32 bits.
const MOST_BLOCK_BYTES: u64 = 256 * MOST_SIDE as u64 * 16;

/// Offset tables: a chunk for every 64 x 64 texels would be 2^15; a hostile header declares one for each texel.
const MOST_CHUNKS: u64 = 1 << 20;

/// The declared size of the layer that will be shown.
pub(super) fn declared_size(bytes: &[u8]) -> Result<(u64, u64), LoadProblem> {
    let meta = read_meta(bytes)?;
    let (index, _) = shown_layer(&meta)?;
    let Vec2(width, height) = meta.headers[index].layer_size;
    Ok((width as u64, height as u64))
}

pub(super) fn decode(job: &Job) -> Result<Decoded, LoadProblem> {
    let meta = read_meta(job.bytes)?;
    judge(&meta)?;
    let (layer, [r, g, b]) = shown_layer(&meta)?;
    let header = &meta.headers[layer];
    let alpha = job
        .keeps_bits
        .then(|| find(&header.channels, "A"))
        .flatten();
    let texels = match alpha {
        Some(a) => Texels::Rgba(decode_channels(job, layer, [r, g, b, a])?),
        None => Texels::Rgb(decode_channels(job, layer, [r, g, b])?),
    };
    let is_half = |index: usize| header.channels.list[index].sample_type == SampleType::F16;
    let all_half = [r, g, b].into_iter().chain(alpha).all(is_half);
    Ok(Decoded {
        texels,
        stored: if all_half { Stored::Half } else { Stored::F32 },
        envmap: header.own_attributes.environment_map.map(|map| match map {
            EnvironmentMap::LatitudeLongitude => EnvmapKind::Latlong,
            EnvironmentMap::Cube => EnvmapKind::Cube,
        }),
    })
}

/// The texels of a layer, of which the given channels are wanted.
fn decode_channels<const N: usize>(
    job: &Job,
    layer: usize,
    channels: [usize; N],
) -> Result<Vec<[f32; N]>, LoadProblem> {
    let mut picture = Picture {
        width: job.width as usize,
        channels,
        pixels: job.zeroed([0.0; N], job.texels())?,
        filled: 0,
    };
    let mut chunks = caught(|| {
        let reader = exr::block::read(Cursor::new(job.bytes), false).map_err(damaged)?;
        reader.all_chunks(false).map_err(damaged)
    })?;
    let meta = chunks.meta_data().clone();
    let total = chunks.expected_chunk_count();
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let mut done = 0;
    loop {
        // As many blocks at a time as there are cores: that also bounds what is unpacked at once.
        let mut batch = Vec::with_capacity(workers);
        while batch.len() < workers {
            let Some(chunk) = caught(|| chunks.next().transpose().map_err(damaged))? else {
                break;
            };
            done += 1;
            if chunk.layer_index == layer && is_full_size(&chunk) {
                batch.push(chunk);
            }
        }
        if batch.is_empty() {
            break;
        }
        for block in unpacked(batch, &meta)? {
            picture.insert(&block, &meta.headers[layer])?;
        }
        job.progress.step(done, total);
        super::stop_if_cancelled(job.progress)?;
    }
    if picture.filled < job.texels() {
        let missing = job.texels() - picture.filled;
        return Err(damaged(format!(
            "{missing} of {} texels are missing",
            job.texels()
        )));
    }
    Ok(picture.pixels)
}

fn read_meta(bytes: &[u8]) -> Result<MetaData, LoadProblem> {
    caught(|| MetaData::read_from_buffered(bytes, false).map_err(damaged))
}

/// Runs code that may panic on bad files.
fn caught<T>(run: impl FnOnce() -> Result<T, LoadProblem>) -> Result<T, LoadProblem> {
    crate::imaging::caught::caught(run)
        .unwrap_or_else(|| Err(damaged("the decoder stumbled over impossible values")))
}

/// Whether what the header declares, of every layer, can be unpacked within the limits.
fn judge(meta: &MetaData) -> Result<(), LoadProblem> {
    let (mut unpacked, mut chunks) = (0_u64, 0_u64);
    for header in &meta.headers {
        if header.deep {
            return Err(unsupported("deep data; flatten it"));
        }
        let Vec2(width, height) = header.layer_size;
        let texel = bytes_per_texel(&header.channels);
        let (block_width, block_height) = match header.blocks {
            BlockDescription::Tiles(tiles) => (tiles.tile_size.0, tiles.tile_size.1),
            BlockDescription::ScanLines => (width, header.compression.scan_lines_per_block()),
        };
        let bytes = |w: usize, h: usize| (w as u64).saturating_mul(h as u64).saturating_mul(texel);
        within(
            "one block",
            bytes(block_width, block_height),
            MOST_BLOCK_BYTES,
        )?;
        unpacked = unpacked.saturating_add(bytes(width, height));
        chunks = chunks.saturating_add(header.chunk_count as u64);
        if header
            .channels
            .list
            .iter()
            .any(|channel| channel.sampling != Vec2(1, 1))
        {
            return Err(unsupported("subsampled channels; save it as RGB"));
        }
    }
    within("all channels", unpacked, MOST_UNPACKED_BYTES)?;
    within(
        "its offset tables",
        chunks.saturating_mul(8),
        MOST_CHUNKS * 8,
    )
}

fn within(what: &'static str, declared: u64, limit: u64) -> Result<(), LoadProblem> {
    if declared > limit {
        Err(LoadProblem::TooMuch {
            what,
            declared,
            limit,
        })
    } else {
        Ok(())
    }
}

fn bytes_per_texel(channels: &ChannelList) -> u64 {
    channels
        .list
        .iter()
        .map(|channel| channel.sample_type.bytes_per_sample() as u64)
        .sum()
}

/// The first layer that has R, G and B (or Y alone), and the positions of these three among its channels.
fn shown_layer(meta: &MetaData) -> Result<(usize, [usize; 3]), LoadProblem> {
    for (index, header) in meta.headers.iter().enumerate() {
        let find = |name: &str| find(&header.channels, name);
        let rgb = match (find("R"), find("G"), find("B")) {
            (Some(r), Some(g), Some(b)) => Some([r, g, b]),
            _ => find("Y").filter(|_| find("RY").is_none()).map(|y| [y; 3]),
        };
        if let Some(channels) = rgb {
            return Ok((index, channels));
        }
    }
    Err(unsupported(
        "it has neither channels R, G, B nor Y alone; save it as RGB",
    ))
}

/// The channel of that name: of the layer itself before one of a layer within (`view.R`).
fn find(channels: &ChannelList, name: &str) -> Option<usize> {
    let name = name.as_bytes();
    let names = || channels.list.iter().map(|channel| channel.name.as_slice());
    names()
        .position(|full| full == name)
        .or_else(|| names().position(|full| full.rsplit(|&c| c == b'.').next() == Some(name)))
}

/// Smaller levels of a picture with levels are not needed.
fn is_full_size(chunk: &Chunk) -> bool {
    match &chunk.compressed_block {
        CompressedBlock::Tile(tile) => tile.coordinates.is_largest_resolution_level(),
        _ => true,
    }
}

/// The blocks of a batch, one thread each; a panic ends in an error.
fn unpacked(batch: Vec<Chunk>, meta: &MetaData) -> Result<Vec<UncompressedBlock>, LoadProblem> {
    let unpack = |chunk: Chunk| {
        caught(|| {
            judge_dwa(&chunk, &meta.headers[chunk.layer_index])?;
            UncompressedBlock::decompress_chunk(chunk, meta, false).map_err(damaged)
        })
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = batch
            .into_iter()
            .map(|chunk| scope.spawn(move || unpack(chunk)))
            .collect();
        threads
            .into_iter()
            .map(|thread| {
                thread
                    .join()
                    .unwrap_or_else(|_| Err(damaged("a worker broke off")))
            })
            .collect()
    })
}

/// A DWA block starts with eleven 64-bit counts, and the crate allocates what they say (up to 2^63 bytes): refuses those
/// that no block of this size can need.
fn judge_dwa(chunk: &Chunk, header: &Header) -> Result<(), LoadProblem> {
    /// Uncompressed bytes of the unknown and run-length sections, raw bytes of the latter, numbers of the 16-bit AC and DC
    /// coefficients.
    const UNPACKED_COUNTS: [usize; 5] = [1, 6, 7, 8, 9];
    let data = match &chunk.compressed_block {
        CompressedBlock::Tile(block) => &block.compressed_pixels_le,
        CompressedBlock::ScanLine(block) => &block.compressed_pixels_le,
        _ => return Ok(()),
    };
    let tile = header
        .get_block_data_indices(&chunk.compressed_block)
        .map_err(damaged)?;
    let area = header
        .get_absolute_block_pixel_coordinates(tile)
        .map_err(damaged)?;
    let Vec2(width, height) = area.size;
    let texel = bytes_per_texel(&header.channels);
    let is_raw = data.len() as u64 == width as u64 * height as u64 * texel;
    if is_raw
        || !matches!(
            header.compression,
            Compression::DWAA(_) | Compression::DWAB(_)
        )
    {
        return Ok(());
    }
    // Cosine transforms work on whole 8 x 8 squares; run lengths can make data longer by a half at most.
    let squares = (width as u64).div_ceil(8) * (height as u64).div_ceil(8);
    let most = squares * 64 * texel * 2;
    let (counts, _) = data.as_chunks::<8>();
    for count in UNPACKED_COUNTS
        .iter()
        .filter_map(|&index| counts.get(index))
    {
        within("one DWA section", u64::from_le_bytes(*count), most)?;
    }
    Ok(())
}

struct Picture<const N: usize> {
    width: usize,
    channels: [usize; N],
    pixels: Vec<[f32; N]>,
    filled: usize,
}

impl<const N: usize> Picture<N> {
    /// Copies a block's lines; each line holds its channels one after another, in alphabetical order.
    fn insert(&mut self, block: &UncompressedBlock, header: &Header) -> Result<(), LoadProblem> {
        let Vec2(x, y) = block.index.pixel_position;
        let Vec2(width, height) = block.index.pixel_size;
        let line_bytes = width * bytes_per_texel(&header.channels) as usize;
        if line_bytes * height != block.data.len() || x + width > self.width {
            return Err(damaged("a block has the wrong size"));
        }
        for (row, line) in block.data.chunks_exact(line_bytes.max(1)).enumerate() {
            let start = (y + row) * self.width + x;
            let Some(texels) = self.pixels.get_mut(start..start + width) else {
                return Err(damaged("a block lies outside of the picture"));
            };
            let mut at = 0;
            for (index, channel) in header.channels.list.iter().enumerate() {
                let size = channel.sample_type.bytes_per_sample();
                let samples = &line[at..at + size * width];
                at += size * width;
                for (target, _) in self
                    .channels
                    .iter()
                    .enumerate()
                    .filter(|(_, c)| **c == index)
                {
                    for (texel, sample) in texels.iter_mut().zip(samples.chunks_exact(size)) {
                        texel[target] = value(channel.sample_type, sample);
                    }
                }
            }
            self.filled += width;
        }
        Ok(())
    }
}

/// One sample; unpacked blocks have the byte order of the machine.
fn value(kind: SampleType, sample: &[u8]) -> f32 {
    match (kind, sample) {
        (SampleType::F16, &[a, b]) => half::f16::from_ne_bytes([a, b]).to_f32(),
        (SampleType::F32, &[a, b, c, d]) => f32::from_ne_bytes([a, b, c, d]),
        (SampleType::U32, &[a, b, c, d]) => u32::from_ne_bytes([a, b, c, d]) as f32,
        _ => 0.0,
    }
}

fn damaged(reason: impl ToString) -> LoadProblem {
    LoadProblem::damaged(Format::Exr, reason)
}

fn unsupported(what: &str) -> LoadProblem {
    LoadProblem::Unsupported {
        format: Format::Exr,
        what: what.to_owned(),
    }
}
