//! DirectDraw surfaces (Microsoft, *Programming Guide for DDS*): a header, for newer formats a second one, then the pictures,
//! face by face.
//!
//! 8-bit files without the second header say nothing about sRGB; their numbers are codes, as in PNG. With it, they are codes
//! only where the format says so.

use super::texels::TexelFormat;
use super::{Container, Declared, Fields, Level, Levels, PictureReader, side_at};
use crate::imaging::load::{Format, LoadProblem};
use crate::imaging::save::{Fault, Job};
use crate::imaging::{Progress, Stored};

/// How every file starts.
pub(in crate::imaging) const SIGNATURE: [u8; 4] = *b"DDS ";

const HEADER_BYTES: u32 = 124;
const PIXEL_FORMAT_BYTES: u32 = 32;

// Which fields of the header count, and what a surface is (its names in the guide).
const CAPS: u32 = 0x1;
const HEIGHT: u32 = 0x2;
const WIDTH: u32 = 0x4;
const PITCH: u32 = 0x8;
const PIXEL_FORMAT: u32 = 0x1000;
const MIP_MAP_COUNT: u32 = 0x2_0000;
const CAPS_COMPLEX: u32 = 0x8;
const CAPS_TEXTURE: u32 = 0x1000;
const CAPS_MIP_MAP: u32 = 0x40_0000;
const CAPS2_CUBE: u32 = 0x200;
const CAPS2_ALL_FACES: u32 = 0xfc00;
const CAPS2_VOLUME: u32 = 0x20_0000;
const ALPHA_PIXELS: u32 = 0x1;
const FOUR_CC: u32 = 0x4;
const RGB: u32 = 0x40;

// The second header.
const TEXTURE_2D: u32 = 3;
const MISC_CUBE: u32 = 0x4;

/// What stands before the pictures.
pub(super) struct Header {
    pub(super) declared: Declared,
    caps2: u32,
    /// Flags, letters, bits of a texel, masks of red, green, blue, alpha.
    pixel_format: [u32; 7],
    /// Format, dimension, flags, length of an array.
    second: Option<[u32; 4]>,
    data_start: usize,
}

impl Header {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, LoadProblem> {
        let rest = bytes.get(SIGNATURE.len()..).unwrap_or_default();
        let mut fields = Fields(rest);
        let mut parse = || {
            let [size, _flags, height, width] = fields.u32s()?;
            let [_pitch, _depth, levels] = fields.u32s()?;
            fields.take(11 * 4)?; // reserved
            let pixel_format_size = fields.u32()?;
            let pixel_format = fields.u32s::<7>()?;
            let [_caps, caps2] = fields.u32s()?;
            fields.take(3 * 4)?; // reserved
            let [flags, letters, ..] = pixel_format;
            let second = if flags & FOUR_CC != 0 && letters == u32::from_le_bytes(*b"DX10") {
                let second = fields.u32s()?;
                fields.u32()?; // how opacity is meant
                Some(second)
            } else {
                None
            };
            let is_cube = match second {
                Some([_, _, misc, _]) => misc & MISC_CUBE != 0,
                None => caps2 & CAPS2_CUBE != 0,
            };
            let header = Self {
                declared: Declared {
                    format: Format::Dds,
                    width: width.into(),
                    height: height.into(),
                    faces: if is_cube { 6 } else { 1 },
                    levels: levels.max(1),
                },
                caps2,
                pixel_format,
                second,
                data_start: bytes.len() - fields.0.len(),
            };
            let sizes = (size, pixel_format_size);
            Some((sizes, header))
        };
        match parse() {
            Some(((HEADER_BYTES, PIXEL_FORMAT_BYTES), header)) => Ok(header),
            Some(((size, part), _)) => Err(damaged(format!(
                "its headers declare {size} and {part} bytes instead of {HEADER_BYTES} and {PIXEL_FORMAT_BYTES}"
            ))),
            None => Err(damaged("the header breaks off")),
        }
    }

    /// The kind of texels, when everything else is of a kind that opens.
    fn texel_format(&self) -> Result<TexelFormat, LoadProblem> {
        if self.caps2 & CAPS2_VOLUME != 0 {
            return Err(unsupported("it is a volume; save it as a cube map"));
        }
        match self.second {
            Some([number, dimension, _, length]) => {
                if dimension != TEXTURE_2D {
                    return Err(unsupported(
                        "it is no picture of two dimensions; save it so",
                    ));
                }
                if length != 1 {
                    return Err(unsupported(format!(
                        "it is an array of {length}; save one of them"
                    )));
                }
                TexelFormat::of_dxgi(number).ok_or_else(|| {
                    other_texels(&format!("{} (DXGI format {number})", dxgi_name(number)))
                })
            }
            None => {
                let faces = self.caps2 & CAPS2_ALL_FACES;
                if self.declared.faces == 6 && faces != CAPS2_ALL_FACES {
                    let count = faces.count_ones();
                    let what = format!("it has {count} of six faces; save it with all");
                    return Err(unsupported(what));
                }
                self.older_texel_format()
            }
        }
    }

    fn older_texel_format(&self) -> Result<TexelFormat, LoadProblem> {
        const BLUE_FIRST: [u32; 3] = [0xff_0000, 0xff00, 0xff];
        const RED_FIRST: [u32; 3] = [0xff, 0xff00, 0xff_0000];
        let [flags, letters, bits, red, green, blue, alpha] = self.pixel_format;
        let has_alpha = flags & ALPHA_PIXELS != 0 && alpha == 0xff00_0000;
        let number = if flags & FOUR_CC != 0 {
            match letters {
                113 => Some(10), // A16B16G16R16F
                116 => Some(2),  // A32B32G32R32F
                _ => None,
            }
        } else if flags & RGB != 0 && bits == 32 {
            match ([red, green, blue], has_alpha) {
                (BLUE_FIRST, true) => Some(91),
                (BLUE_FIRST, false) => Some(93),
                (RED_FIRST, true) => Some(29),
                _ => None,
            }
        } else {
            None
        };
        number.and_then(TexelFormat::of_dxgi).ok_or_else(|| {
            let text = letters.to_le_bytes();
            other_texels(&if flags & FOUR_CC == 0 {
                format!("{bits} bits with masks {red:x}, {green:x}, {blue:x}, {alpha:x}")
            } else if text.iter().all(u8::is_ascii_graphic) {
                format!("`{}`", text.escape_ascii())
            } else {
                format!("D3DFORMAT {letters}")
            })
        })
    }
}

pub(super) fn read(bytes: &[u8], progress: &Progress) -> Result<Container, LoadProblem> {
    let header = Header::parse(bytes)?;
    let texel = header.texel_format()?;
    let size = header.declared.judged(texel)?;
    let mut data = bytes.get(header.data_start..).unwrap_or_default();
    let count = header.declared.levels as usize;
    let texels: u64 = (0..count)
        .map(|k| header.declared.level_texels(size, k))
        .sum();
    let needed = texels * texel.bytes();
    if (data.len() as u64) < needed {
        return Err(damaged(format!(
            "it has {} bytes of texels instead of {needed}",
            data.len()
        )));
    }
    let mut levels = vec![
        Level {
            rasters: Vec::new()
        };
        count
    ];
    let mut pictures = PictureReader::new(&header.declared, size, texel, progress);
    for _ in 0..header.declared.faces {
        for (k, level) in levels.iter_mut().enumerate() {
            let size = size.map(|side| side_at(side, k));
            level.rasters.push(pictures.next(size, &mut data)?);
        }
    }
    Ok(Container {
        levels,
        stored: texel.stored,
        format: Format::Dds,
    })
}

/// Writes a file with both headers.
pub(in crate::imaging) fn write(
    levels: &Levels,
    stored: Stored,
    job: &mut Job,
) -> Result<(), Fault> {
    let texel = levels.texel_format(stored)?;
    let count = levels.0.len() as u32;
    let [width, height] = levels.first().size();
    let is_cube = levels.faces() == 6;
    let (mut flags, mut caps, mut caps2) = (
        CAPS | HEIGHT | WIDTH | PITCH | PIXEL_FORMAT,
        CAPS_TEXTURE,
        0,
    );
    if count > 1 {
        flags |= MIP_MAP_COUNT;
        caps |= CAPS_MIP_MAP | CAPS_COMPLEX;
    }
    if is_cube {
        caps |= CAPS_COMPLEX;
        caps2 |= CAPS2_CUBE | CAPS2_ALL_FACES;
    }
    let mut numbers = vec![HEADER_BYTES, flags, height, width];
    numbers.extend([width * texel.bytes() as u32, 0, count]);
    numbers.extend([0; 11]); // reserved
    numbers.extend([PIXEL_FORMAT_BYTES, FOUR_CC, u32::from_le_bytes(*b"DX10")]);
    numbers.extend([0; 5]); // bits and masks: said by the second header
    numbers.extend([caps, caps2, 0, 0, 0]);
    numbers.extend([texel.dxgi, TEXTURE_2D]);
    // Older loaders refuse files that say how opacity is meant, so the last stays 0.
    numbers.extend([if is_cube { MISC_CUBE } else { 0 }, 1, 0]);
    job.out.write_all(&SIGNATURE)?;
    for number in numbers {
        job.out.write_all(&number.to_le_bytes())?;
    }
    let (mut room, mut row) = (Vec::new(), Vec::new());
    for face in 0..levels.faces() as usize {
        for level in &levels.0 {
            for y in 0..level[face].height() {
                row.clear();
                texel.write_row(&level[face], y, &mut room, &mut row);
                job.out.write_all(&row)?;
                job.rows_done(1)?;
            }
        }
    }
    Ok(())
}

/// Names of the formats that people meet, for messages.
fn dxgi_name(number: u32) -> &'static str {
    match number {
        3..=8 => "R32G32B32",
        9 | 11..=14 => "R16G16B16A16 of whole numbers",
        23..=25 => "R10G10B10A2",
        26 => "R11G11B10_FLOAT",
        70..=72 => "BC1",
        73..=75 => "BC2",
        76..=78 => "BC3",
        79..=81 => "BC4",
        82..=84 => "BC5",
        94..=96 => "BC6H",
        97..=99 => "BC7",
        _ => "of a kind unknown here",
    }
}

fn other_texels(name: &str) -> LoadProblem {
    unsupported(format!(
        "its texels are {name}; store them as R8G8B8A8, R16G16B16A16_FLOAT, R32G32B32A32_FLOAT or R9G9B9E5"
    ))
}

fn damaged(reason: impl ToString) -> LoadProblem {
    LoadProblem::damaged(Format::Dds, reason)
}

fn unsupported(what: impl ToString) -> LoadProblem {
    LoadProblem::Unsupported {
        format: Format::Dds,
        what: what.to_string(),
    }
}
