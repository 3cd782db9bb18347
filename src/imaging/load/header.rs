//! The size that a file declares, by walks over its header; only OpenEXR's needs the crate that decodes it.

use super::{Format, LoadProblem};
use crate::imaging::container;

/// (width, height) as declared.
pub(super) fn declared_size(format: Format, bytes: &[u8]) -> Result<(u64, u64), LoadProblem> {
    match format {
        Format::Hdr => super::hdr::Header::parse(bytes).map(|header| (header.width, header.height)),
        Format::Exr => super::exr::declared_size(bytes),
        Format::Png => {
            png(bytes).ok_or_else(|| LoadProblem::damaged(format, "it does not start with IHDR"))
        }
        Format::Jpeg => {
            jpeg(bytes).ok_or_else(|| LoadProblem::damaged(format, "it has no frame header"))
        }
        Format::Ktx2 | Format::Dds => container::declared_size(format, bytes),
    }
}

/// Signature, length and name of IHDR, then width and height.
fn png(bytes: &[u8]) -> Option<(u64, u64)> {
    if bytes.get(8..16)? != b"\0\0\0\x0dIHDR" {
        return None;
    }
    Some((be32(bytes.get(16..20)?)?, be32(bytes.get(20..24)?)?))
}

fn be32(bytes: &[u8]) -> Option<u64> {
    bytes
        .try_into()
        .ok()
        .map(|b| u64::from(u32::from_be_bytes(b)))
}

/// From marker to marker until a frame header (SOF0..15 without DHT, JPG, DAC): precision, height, width.
fn jpeg(bytes: &[u8]) -> Option<(u64, u64)> {
    let mut at = 2;
    loop {
        if *bytes.get(at)? != 0xff {
            return None;
        }
        let marker = *bytes.get(at + 1)?;
        match marker {
            0xff => at += 1,               // fill byte
            0x01 | 0xd0..=0xd8 => at += 2, // no length
            0xd9 | 0xda => return None,    // the end or a scan before any frame
            0xc4 | 0xc8 | 0xcc => at += 2 + be16(bytes, at + 2)?,
            0xc0..=0xcf => {
                let height = be16(bytes, at + 5)?;
                let width = be16(bytes, at + 7)?;
                return Some((width as u64, height as u64));
            }
            _ => at += 2 + be16(bytes, at + 2)?,
        }
    }
}

fn be16(bytes: &[u8], at: usize) -> Option<usize> {
    let pair = bytes.get(at..at + 2)?.try_into().ok()?;
    Some(usize::from(u16::from_be_bytes(pair)))
}
