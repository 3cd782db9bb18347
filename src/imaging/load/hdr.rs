//! Radiance RGBE pictures (Ward, *Real Pixels*, Graphics Gems II; the Radiance file formats).
//!
//! Own code: it stops between rows, grows with what the file really holds, and knows the signatures of both spellings.
//! `EXPOSURE` lines are ignored, as other viewers do: the values are shown as they are stored.

use super::decoded::{Decoded, Texels};
use super::{Format, Job, LoadProblem};
use crate::imaging::Stored;
use crate::imaging::shared_exponent::RGBE;

/// Header lines are short; a file whose header is longer than this is not a picture.
const MOST_HEADER_BYTES: usize = 1 << 16;

/// What stands before the texels.
pub(super) struct Header {
    pub(super) width: u64,
    pub(super) height: u64,
    from_below: bool,
    from_right: bool,
    data_start: usize,
}

impl Header {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, LoadProblem> {
        let head = &bytes[..bytes.len().min(MOST_HEADER_BYTES)];
        let mut lines = Lines { bytes: head, at: 0 };
        loop {
            let line = lines
                .next()
                .ok_or_else(|| damaged("the header breaks off"))?;
            if line.is_empty() {
                break;
            }
            if let Some(format) = line.strip_prefix(b"FORMAT=")
                && format.trim_ascii() != b"32-bit_rle_rgbe"
            {
                return Err(unsupported("only FORMAT=32-bit_rle_rgbe opens, not xyze"));
            }
        }
        let size = lines
            .next()
            .ok_or_else(|| damaged("it has no resolution line"))?;
        let mut words = size
            .split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty());
        let mut word = || words.next().unwrap_or_default();
        let (y_axis, height, x_axis, width) = (word(), word(), word(), word());
        let from_below = match y_axis {
            b"-Y" => false,
            b"+Y" => true,
            b"-X" | b"+X" => return Err(unsupported("rows must run along x (-Y H +X W)")),
            _ => return Err(damaged("the resolution line is not like -Y 512 +X 1024")),
        };
        let from_right = match x_axis {
            b"+X" => false,
            b"-X" => true,
            _ => return Err(damaged("the resolution line is not like -Y 512 +X 1024")),
        };
        let number = |word: &[u8]| {
            let text = str::from_utf8(word).unwrap_or_default();
            text.parse()
                .map_err(|_| damaged("the resolution line has no whole numbers"))
        };
        Ok(Self {
            width: number(width)?,
            height: number(height)?,
            from_below,
            from_right,
            data_start: lines.at,
        })
    }
}

struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Lines<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|&byte| byte == b'\n')?;
        self.at += end + 1;
        Some(rest[..end].strip_suffix(b"\r").unwrap_or(&rest[..end]))
    }
}

pub(super) fn decode(job: &Job) -> Result<Decoded, LoadProblem> {
    let header = Header::parse(job.bytes)?;
    let mut data = job.bytes.get(header.data_start..).unwrap_or_default();
    let width = job.width as usize;
    let mut row = vec![[0_u8; 4]; width];
    let mut pixels = job.reserved(job.texels())?;
    for y in 0..job.height as usize {
        read_row(&mut data, &mut row)
            .ok_or_else(|| damaged(&format!("row {y} of {} is cut off or overlong", job.height)))?;
        if header.from_right {
            row.reverse();
        }
        pixels.extend(row.iter().copied().map(linear_from_rgbe));
        job.row_done(y + 1)?;
    }
    if header.from_below {
        for y in 0..job.height as usize / 2 {
            let (top, bottom) = pixels.split_at_mut((job.height as usize - 1 - y) * width);
            top[y * width..(y + 1) * width].swap_with_slice(&mut bottom[..width]);
        }
    }
    Ok(Decoded {
        texels: Texels::Rgb(pixels),
        stored: Stored::Rgbe,
        envmap: None,
    })
}

fn linear_from_rgbe([r, g, b, e]: [u8; 4]) -> [f32; 3] {
    // The exponent 0 means black, whatever the mantissas are.
    if e == 0 {
        return [0.0; 3];
    }
    RGBE.decode([r, g, b].map(u32::from), u32::from(e))
}

/// One row in any of the three codings; `None` when it is cut off or runs over its end.
fn read_row(data: &mut &[u8], row: &mut [[u8; 4]]) -> Option<()> {
    let first = take4(data)?;
    let [two, also_two, high, low] = first;
    let is_new = two == 2 && also_two == 2 && high < 128;
    if is_new && usize::from(u16::from_be_bytes([high, low])) == row.len() {
        read_components(data, row)
    } else {
        read_pixels(data, first, row)
    }
}

/// The four components one after another, each in runs (129..255: repeat) and literals (1..128).
fn read_components(data: &mut &[u8], row: &mut [[u8; 4]]) -> Option<()> {
    for component in 0..4 {
        let mut x = 0;
        while x < row.len() {
            let code = usize::from(take(data, 1)?[0]);
            let count = if code > 128 { code - 128 } else { code };
            let texels = row
                .get_mut(x..x + count)
                .filter(|texels| !texels.is_empty())?;
            if code > 128 {
                let value = take(data, 1)?[0];
                texels.iter_mut().for_each(|texel| texel[component] = value);
            } else {
                let values = take(data, count)?;
                for (texel, value) in texels.iter_mut().zip(values) {
                    texel[component] = *value;
                }
            }
            x += count;
        }
    }
    Some(())
}

/// Flat texels; the mantissas (1, 1, 1) repeat the last texel, and marks in a row count in base 256.
fn read_pixels(data: &mut &[u8], first: [u8; 4], row: &mut [[u8; 4]]) -> Option<()> {
    let (mut next, mut last, mut shift, mut x) = (first, None, 0, 0);
    loop {
        if let ([1, 1, 1, count], Some(texel)) = (next, last) {
            // A fifth mark in a row could only repeat 2^32 times or never.
            let count = if shift < 32 {
                u64::from(count) << shift
            } else {
                u64::MAX
            };
            let count = usize::try_from(count)
                .ok()
                .filter(|count| *count <= row.len() - x)?;
            row[x..x + count].fill(texel);
            x += count;
            shift += 8;
        } else {
            *row.get_mut(x)? = next;
            (last, shift) = (Some(next), 0);
            x += 1;
        }
        if x == row.len() {
            return Some(());
        }
        next = take4(data)?;
    }
}

fn take<'a>(data: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (taken, rest) = data.split_at_checked(count)?;
    *data = rest;
    Some(taken)
}

fn take4(data: &mut &[u8]) -> Option<[u8; 4]> {
    take(data, 4)?.try_into().ok()
}

fn damaged(reason: &str) -> LoadProblem {
    LoadProblem::damaged(Format::Hdr, reason)
}

fn unsupported(what: &str) -> LoadProblem {
    LoadProblem::Unsupported {
        format: Format::Hdr,
        what: what.to_owned(),
    }
}
