//! KTX 2.0 (Khronos, *KTX File Format Specification 2.0*): header, index of levels, data format descriptor, key-value pairs,
//! levels. Every level stands by itself, packed or not, and holds its faces one after another.

mod descriptor;

use std::io::{self, Cursor, Read, SeekFrom, Write};

use ruzstd::decoding::StreamingDecoder;
use ruzstd::encoding::{CompressionLevel, compress};

use super::texels::TexelFormat;
use super::{Container, Declared, Fields, Level, Levels, PictureReader, side_at};
use crate::imaging::caught::caught;
use crate::imaging::load::{Format, LoadProblem};
use crate::imaging::save::{Fault, Job, RowsLeft};
use crate::imaging::{Progress, Raster, Stored};

/// How every file starts.
pub(in crate::imaging) const SIGNATURE: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// Signature, nine numbers of 32 bits, and where the other parts are: four of 32 and two of 64 bits.
const HEADER_BYTES: u64 = 12 + 9 * 4 + 4 * 4 + 2 * 8;

/// Offset, length, and length when unpacked.
const LEVEL_INDEX_BYTES: u64 = 3 * 8;

/// Number of the packing by Zstandard.
const ZSTANDARD: u32 = 2;

/// Rows down, columns to the right: the only orientation that cube maps may have.
const ORIENTATION: (&str, &str) = ("KTXorientation", "rd");

/// What stands before the levels.
pub(super) struct Header {
    pub(super) declared: Declared,
    vulkan_format: u32,
    packing: u32,
    depth: u32,
    layers: u32,
    /// (offset, length) of the data format descriptor.
    descriptor: (u32, u32),
    /// (offset, length) of the key-value pairs.
    pairs: (u32, u32),
}

impl Header {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, LoadProblem> {
        let mut fields = Fields(bytes.get(SIGNATURE.len()..).unwrap_or_default());
        let mut parse = || {
            let [vulkan_format, _type_size, width, height, depth] = fields.u32s()?;
            let [layers, faces, levels, packing] = fields.u32s()?;
            let [descriptor, descriptor_length, pairs, pairs_length] = fields.u32s()?;
            Some(Self {
                declared: Declared {
                    format: Format::Ktx2,
                    width: width.into(),
                    height: height.into(),
                    faces,
                    // 0 asks the reader to make the smaller ones.
                    levels: levels.max(1),
                },
                vulkan_format,
                packing,
                depth,
                layers,
                descriptor: (descriptor, descriptor_length),
                pairs: (pairs, pairs_length),
            })
        };
        parse().ok_or_else(|| damaged("the header breaks off"))
    }

    /// The kind of texels, when everything else is of a kind that opens.
    fn texel_format(&self) -> Result<TexelFormat, LoadProblem> {
        let texel = TexelFormat::of_vulkan(self.vulkan_format).ok_or_else(|| {
            let name = vulkan_name(self.vulkan_format);
            let number = self.vulkan_format;
            unsupported(format!(
                "its texels are {name} (vkFormat {number}); store them as R8G8B8A8, R16G16B16A16_SFLOAT, \
                 R32G32B32A32_SFLOAT or E5B9G9R9"
            ))
        })?;
        if self.packing != 0 && self.packing != ZSTANDARD {
            let name = match self.packing {
                1 => "BasisLZ",
                3 => "ZLIB",
                _ => "an unknown scheme",
            };
            let number = self.packing;
            let what = format!(
                "it is packed with {name} ({number}); pack it with Zstandard or not at all"
            );
            return Err(unsupported(what));
        }
        if self.declared.faces != 1 && self.declared.faces != 6 {
            return Err(damaged(format!(
                "it declares {} faces",
                self.declared.faces
            )));
        }
        if self.layers > 1 {
            let what = format!("it is an array of {}; save one of them", self.layers);
            return Err(unsupported(what));
        }
        if self.depth > 1 || self.declared.height == 0 {
            return Err(unsupported(
                "it has three dimensions or one; save it as a cube map",
            ));
        }
        Ok(texel)
    }
}

pub(super) fn read(bytes: &[u8], progress: &Progress) -> Result<Container, LoadProblem> {
    let header = Header::parse(bytes)?;
    let texel = header.texel_format()?;
    let size = header.declared.judged(texel)?;
    descriptor::check(part(bytes, header.descriptor, "data format descriptor")?)?;
    check_pairs(part(bytes, header.pairs, "key-value data")?)?;
    let places = places(bytes, &header, size, texel)?;
    let mut pictures = PictureReader::new(&header.declared, size, texel, progress);
    let mut levels = Vec::new();
    for (k, mut data) in places.into_iter().enumerate() {
        let size = size.map(|side| side_at(side, k));
        levels.push(Level {
            rasters: if header.packing == ZSTANDARD {
                // Nothing is unpacked beyond the declared size, which has been judged.
                let mut unpacked = caught(|| StreamingDecoder::new(data))
                    .ok_or_else(|| damaged("its packed data begin with impossible values"))?
                    .map_err(damaged)?;
                let rasters = faces(header.declared.faces, size, &mut pictures, &mut unpacked)?;
                if !matches!(caught(|| unpacked.read(&mut [0])), Some(Ok(0))) {
                    return Err(damaged(format!(
                        "level {k} unpacks to more than it declares"
                    )));
                }
                rasters
            } else {
                faces(header.declared.faces, size, &mut pictures, &mut data)?
            },
        });
    }
    Ok(Container {
        levels,
        stored: texel.stored,
        format: Format::Ktx2,
    })
}

fn faces(
    count: u32,
    size: [u32; 2],
    pictures: &mut PictureReader,
    data: &mut dyn Read,
) -> Result<Vec<Raster>, LoadProblem> {
    (0..count).map(|_| pictures.next(size, data)).collect()
}

/// A part of the file that the header points to; empty where it has none.
fn part<'a>(
    bytes: &'a [u8],
    (offset, length): (u32, u32),
    what: &str,
) -> Result<&'a [u8], LoadProblem> {
    if length == 0 {
        return Ok(&[]);
    }
    slice(bytes, offset.into(), length.into())
        .ok_or_else(|| damaged(format!("its {what} lies beyond its end")))
}

fn slice(bytes: &[u8], offset: u64, length: u64) -> Option<&[u8]> {
    let start = usize::try_from(offset).ok()?;
    let end = start.checked_add(usize::try_from(length).ok()?)?;
    bytes.get(start..end)
}

/// Where each level lies, the largest first. Each within the file, beside the others and as long as its size needs.
fn places<'a>(
    bytes: &'a [u8],
    header: &Header,
    size: [u32; 2],
    texel: TexelFormat,
) -> Result<Vec<&'a [u8]>, LoadProblem> {
    let mut index = Fields(bytes.get(HEADER_BYTES as usize..).unwrap_or_default());
    let index_end = HEADER_BYTES + u64::from(header.declared.levels) * LEVEL_INDEX_BYTES;
    let mut ranges = vec![(0, index_end)];
    let mut places = Vec::new();
    for k in 0..header.declared.levels as usize {
        let (Some(offset), Some(length), Some(unpacked)) = (index.u64(), index.u64(), index.u64())
        else {
            return Err(damaged("its index of levels breaks off"));
        };
        let expected = header.declared.level_texels(size, k) * texel.bytes();
        let declared = if header.packing == 0 {
            length
        } else {
            unpacked
        };
        if declared != expected {
            return Err(damaged(format!(
                "level {k} declares {declared} bytes instead of {expected}"
            )));
        }
        let place = slice(bytes, offset, length)
            .ok_or_else(|| damaged(format!("level {k} lies beyond its end")))?;
        ranges.push((offset, offset + length));
        places.push(place);
    }
    ranges.sort_unstable();
    if ranges.windows(2).any(|pair| pair[0].1 > pair[1].0) {
        return Err(damaged("its levels overlap"));
    }
    Ok(places)
}

/// Whether the key-value pairs say that the pictures lie as they are read.
fn check_pairs(bytes: &[u8]) -> Result<(), LoadProblem> {
    let mut fields = Fields(bytes);
    while !fields.0.is_empty() {
        let pair = fields.u32().and_then(|length| {
            let pair = fields.take(length as usize)?;
            // The next begins at a multiple of 4.
            let gap = length.next_multiple_of(4) - length;
            fields.take((gap as usize).min(fields.0.len()))?;
            Some(pair)
        });
        let pair = pair.ok_or_else(|| damaged("its key-value data break off"))?;
        let mut parts = pair.splitn(2, |byte| *byte == 0);
        let key = parts.next().unwrap_or_default();
        let value = parts.next().unwrap_or_default();
        let value = value.strip_suffix(b"\0").unwrap_or(value);
        let is_plain = match key {
            b"KTXorientation" => value == ORIENTATION.1.as_bytes(),
            b"KTXswizzle" => value == b"rgba" || value == b"rgb1",
            _ => true,
        };
        if !is_plain {
            let (key, value) = (String::from_utf8_lossy(key), value.escape_ascii());
            let plain = if key == ORIENTATION.0 { "rd" } else { "rgba" };
            return Err(unsupported(format!(
                "its {key} is `{value}`; write it with `{plain}`"
            )));
        }
    }
    Ok(())
}

/// Writes a file. Offsets of packed levels are known only when they are there, so the index is written last.
pub(in crate::imaging) fn write(
    levels: &Levels,
    stored: Stored,
    is_packed: bool,
    job: &mut Job,
) -> Result<(), Fault> {
    let texel = levels.texel_format(stored)?;
    let descriptor = descriptor::write(texel);
    let pairs = pairs();
    let count = levels.0.len() as u64;
    let descriptor_at = HEADER_BYTES + count * LEVEL_INDEX_BYTES;
    let pairs_at = descriptor_at + descriptor.len() as u64;

    let type_size = match stored {
        Stored::U8 => 1,
        Stored::Half => 2,
        _ => 4,
    };
    let [width, height] = levels.first().size();
    let mut header = SIGNATURE.to_vec();
    let numbers = [
        texel.vulkan,
        type_size,
        width,
        height,
        0, // no depth
        0, // no array
        levels.faces(),
        count as u32,
        if is_packed { ZSTANDARD } else { 0 },
        descriptor_at as u32,
        descriptor.len() as u32,
        pairs_at as u32,
        pairs.len() as u32,
        // No global data for unpacking: two numbers of 64 bits.
        0,
        0,
        0,
        0,
    ];
    header.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    header.resize(descriptor_at as usize, 0);
    header.extend(descriptor);
    header.extend(pairs);
    job.out.write_all(&header)?;
    let mut at = header.len() as u64;

    // Unpacked levels begin at a common multiple of 4 and the bytes of a texel, which are 4, 8 or 16.
    let alignment = if is_packed { 1 } else { texel.bytes() };
    let mut places = vec![(0, 0); levels.0.len()];
    for k in (0..levels.0.len()).rev() {
        let start = at.next_multiple_of(alignment);
        io::copy(&mut io::repeat(0).take(start - at), &mut job.out)?;
        let mut source = LevelBytes::new(levels.0[k], texel, &mut job.progress);
        let length = if is_packed {
            pack(&mut source, &mut *job.out)?
        } else {
            io::copy(&mut source, &mut job.out)?
        };
        source.check()?;
        places[k] = (start, length);
        at = start + length;
    }
    job.out.seek(SeekFrom::Start(HEADER_BYTES))?;
    for (k, (start, length)) in places.into_iter().enumerate() {
        for number in [start, length, levels.level_bytes(k, texel)] {
            job.out.write_all(&number.to_le_bytes())?;
        }
    }
    job.out.seek(SeekFrom::End(0))?;
    Ok(())
}

/// Packs all of `source`; how many bytes came out. The packer panics when its output fails, so it gets one that never does.
fn pack(source: &mut LevelBytes, out: &mut dyn Write) -> Result<u64, Fault> {
    let mut drain = Drain {
        out,
        written: 0,
        failure: None,
    };
    caught(|| compress(source, &mut drain, CompressionLevel::Fastest))
        .ok_or_else(|| Fault::Encoder("Zstandard's packer broke off".to_owned()))?;
    match drain.failure {
        Some(failure) => Err(Fault::Io(failure)),
        None => Ok(drain.written),
    }
}

struct Drain<'a> {
    out: &'a mut dyn Write,
    written: u64,
    failure: Option<io::Error>,
}

impl Write for Drain<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.failure.is_none() {
            match self.out.write_all(bytes) {
                Ok(()) => self.written += bytes.len() as u64,
                Err(failure) => self.failure = Some(failure),
            }
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The bytes of a level, made row by row as they are asked for. Ends early when the user wants to stop.
struct LevelBytes<'a, 'b, 'c> {
    rows: Box<dyn Iterator<Item = (&'a Raster, u32)> + 'a>,
    texel: TexelFormat,
    numbers: Vec<f32>,
    row: Cursor<Vec<u8>>,
    progress: &'b mut RowsLeft<'c>,
    fault: Option<Fault>,
}

impl<'a, 'b, 'c> LevelBytes<'a, 'b, 'c> {
    fn new(rasters: &'a [Raster], texel: TexelFormat, progress: &'b mut RowsLeft<'c>) -> Self {
        let rows = rasters
            .iter()
            .flat_map(|raster| (0..raster.height()).map(move |y| (raster, y)));
        Self {
            rows: Box::new(rows),
            texel,
            numbers: Vec::new(),
            row: Cursor::default(),
            progress,
            fault: None,
        }
    }

    fn check(self) -> Result<(), Fault> {
        self.fault.map_or(Ok(()), Err)
    }
}

impl Read for LevelBytes<'_, '_, '_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.row.read(bytes)?;
        if count > 0 || bytes.is_empty() || self.fault.is_some() {
            return Ok(count);
        }
        let Some((raster, y)) = self.rows.next() else {
            return Ok(0);
        };
        self.row.set_position(0);
        let row = self.row.get_mut();
        row.clear();
        self.texel.write_row(raster, y, &mut self.numbers, row);
        if let Err(fault) = self.progress.rows_done(1) {
            self.fault = Some(fault);
            return Ok(0);
        }
        self.row.read(bytes)
    }
}

/// Orientation and writer: sorted by key, each padded to four bytes.
fn pairs() -> Vec<u8> {
    let writer = concat!("sixfold ", env!("CARGO_PKG_VERSION"));
    let mut bytes = Vec::new();
    for (key, value) in [ORIENTATION, ("KTXwriter", writer)] {
        let length = key.len() + value.len() + 2; // a zero after each
        bytes.extend((length as u32).to_le_bytes());
        bytes.extend(key.as_bytes());
        bytes.push(0);
        bytes.extend(value.as_bytes());
        bytes.push(0);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    bytes
}

/// Names of the formats that people meet, for messages.
fn vulkan_name(number: u32) -> &'static str {
    match number {
        0 => "UNDEFINED (Basis Universal)",
        9..=15 => "R8",
        16..=22 => "R8G8",
        23..=29 => "R8G8B8",
        30..=36 => "B8G8R8",
        64..=69 => "A2B10G10R10",
        70..=76 => "R16",
        77..=83 => "R16G16",
        84..=90 => "R16G16B16",
        91..=96 => "R16G16B16A16 of whole numbers",
        98..=100 => "R32",
        101..=103 => "R32G32",
        104..=106 => "R32G32B32",
        107 | 108 => "R32G32B32A32 of whole numbers",
        122 => "B10G11R11_UFLOAT",
        131..=134 => "BC1",
        135 | 136 => "BC2",
        137 | 138 => "BC3",
        139 | 140 => "BC4",
        141 | 142 => "BC5",
        143 | 144 => "BC6H",
        145 | 146 => "BC7",
        147..=152 => "ETC2",
        153..=156 => "EAC",
        157..=184 => "ASTC",
        1_000_066_000..=1_000_066_013 => "ASTC_SFLOAT",
        _ => "of a kind unknown here",
    }
}

fn damaged(reason: impl ToString) -> LoadProblem {
    LoadProblem::damaged(Format::Ktx2, reason)
}

fn unsupported(what: impl ToString) -> LoadProblem {
    LoadProblem::Unsupported {
        format: Format::Ktx2,
        what: what.to_string(),
    }
}
