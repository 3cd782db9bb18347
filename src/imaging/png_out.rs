//! PNG files that carry the scene they show.

use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::open_regular;

/// Key of the text chunk that holds the scene as JSON.
pub const SCENE_KEY: &str = "sixfold-scene";

/// Longest scene text in bytes. A scene takes a few kilobytes; the cap stands against files made to exhaust memory.
pub const MOST_SCENE_BYTES: usize = 1 << 20;

/// Longest side of a picture in pixels: what every adapter's textures hold.
pub const MAX_SIDE: u32 = 8192;

/// Most chunks that are looked at: a picture of [`MAX_SIDE`] squared has at most about 2^15 of the usual 8 KiB.
const MOST_CHUNKS: usize = 1 << 20;

const SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Why a PNG could not be written or its scene not read.
#[derive(Debug, Error)]
pub enum PngError {
    /// The bytes do not fit the size.
    #[error(
        "{width} x {height} RGBA needs 4 bytes a pixel and at least one pixel, but got {bytes} bytes"
    )]
    WrongLength {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Bytes that were given.
        bytes: usize,
    },
    /// The scene is too long to be read back.
    #[error(
        "the scene text has {bytes} bytes, the limit is {MOST_SCENE_BYTES}; write the scene to its own file"
    )]
    SceneTooLong {
        /// Bytes of the text.
        bytes: usize,
    },
    /// The encoder refused.
    #[error("the PNG could not be encoded: {0}")]
    Encode(String),
    /// The file is no PNG or damaged.
    #[error("no scene could be read ({reason}); open the PNG that Sixfold wrote, unchanged: {}", path.display())]
    Damaged {
        /// What is wrong.
        reason: String,
        /// The file.
        path: PathBuf,
    },
    /// The system refused.
    #[error("the file cannot be read ({cause}); check its name and rights: {}", path.display())]
    Io {
        /// What the system said.
        cause: io::Error,
        /// The file.
        path: PathBuf,
    },
}

/// An 8-bit sRGB PNG from RGBA bytes (row 0 at the top, alpha not premultiplied), with the scene's JSON in an uncompressed
/// iTXt chunk before the picture's data.
///
/// # Errors
/// When `rgba` is not `width * height * 4` long or the text is longer than [`MOST_SCENE_BYTES`].
pub fn encode_png(
    width: u32,
    height: u32,
    rgba: &[u8],
    scene: Option<&str>,
) -> Result<Vec<u8>, PngError> {
    let expected = u64::from(width) * u64::from(height) * 4;
    if expected == 0 || rgba.len() as u64 != expected {
        return Err(PngError::WrongLength {
            width,
            height,
            bytes: rgba.len(),
        });
    }
    let refused = |error: png::EncodingError| PngError::Encode(error.to_string());
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    if let Some(scene) = scene {
        if scene.len() > MOST_SCENE_BYTES {
            return Err(PngError::SceneTooLong { bytes: scene.len() });
        }
        encoder
            .add_itxt_chunk(SCENE_KEY.to_owned(), scene.to_owned())
            .map_err(refused)?;
    }
    let mut writer = encoder.write_header().map_err(refused)?;
    writer.write_image_data(rgba).map_err(refused)?;
    writer.finish().map_err(refused)?;
    Ok(bytes)
}

/// The scene text of a PNG file, `None` when it is a PNG without one. Only chunk headers are read, nothing is decompressed,
/// and never more than [`MOST_SCENE_BYTES`] is held.
///
/// # Errors
/// When the file cannot be read, is no PNG, or the text is damaged, compressed or too long.
pub fn read_scene(path: &Path) -> Result<Option<String>, PngError> {
    let io = |cause| PngError::Io {
        cause,
        path: path.to_owned(),
    };
    let file = open_regular(path).map_err(io)?;
    scene_from(BufReader::new(file)).map_err(|reason| PngError::Damaged {
        reason,
        path: path.to_owned(),
    })
}

/// The scene text among the chunks of a PNG; the reason when it cannot be had.
///
/// # Errors
/// As [`read_scene`], as text without the path.
pub fn scene_from(mut png: impl Read + Seek) -> Result<Option<String>, String> {
    let truncated = |error: io::Error| format!("the file breaks off: {error}");
    let mut signature = [0; 8];
    png.read_exact(&mut signature).map_err(truncated)?;
    if signature != SIGNATURE {
        return Err("not a PNG file".to_owned());
    }
    for _ in 0..MOST_CHUNKS {
        let mut head = [0; 8];
        png.read_exact(&mut head).map_err(truncated)?;
        let [l0, l1, l2, l3, kind @ ..] = head;
        let length = u32::from_be_bytes([l0, l1, l2, l3]);
        if length > i32::MAX as u32 {
            return Err(format!(
                "a chunk declares {length} bytes, PNG allows 2147483647"
            ));
        }
        match &kind {
            b"IEND" => return Ok(None),
            b"iTXt" => {
                // The key decides before anything longer is read.
                let mut key = [0; SCENE_KEY.len() + 1];
                let look = key.len().min(length as usize);
                png.read_exact(&mut key[..look]).map_err(truncated)?;
                if look == key.len() && key.strip_suffix(&[0]) == Some(SCENE_KEY.as_bytes()) {
                    return scene_chunk(&mut png, &kind, &key, length as usize - look).map(Some);
                }
                skip(&mut png, i64::from(length) - look as i64 + 4).map_err(truncated)?;
            }
            _ => skip(&mut png, i64::from(length) + 4).map_err(truncated)?,
        }
    }
    Err(format!("more than {MOST_CHUNKS} chunks"))
}

fn skip(png: &mut impl Seek, bytes: i64) -> io::Result<()> {
    png.seek(SeekFrom::Current(bytes)).map(|_| ())
}

/// The text of an iTXt chunk whose key has been read: flags, language, translated key, text, check sum.
fn scene_chunk(
    png: &mut impl Read,
    kind: &[u8],
    key: &[u8],
    rest: usize,
) -> Result<String, String> {
    // Room for the flags and the two (empty) names beside the text.
    let most = MOST_SCENE_BYTES + 4;
    if rest > most {
        return Err(format!(
            "the scene text has {rest} bytes, the limit is {MOST_SCENE_BYTES}"
        ));
    }
    let mut body = vec![0; rest];
    let mut sum = [0; 4];
    png.read_exact(&mut body)
        .map_err(|error| format!("the scene breaks off: {error}"))?;
    png.read_exact(&mut sum)
        .map_err(|error| format!("the scene breaks off: {error}"))?;
    if crc32(&[kind, key, &body]) != u32::from_be_bytes(sum) {
        return Err("the scene's check sum is wrong".to_owned());
    }
    let Some(([compressed, _method], names)) = body.split_first_chunk() else {
        return Err("the scene's chunk is too short".to_owned());
    };
    if *compressed != 0 {
        return Err("the scene is compressed, which Sixfold never writes".to_owned());
    }
    let mut parts = names.splitn(3, |&byte| byte == 0);
    let text = parts.nth(2).ok_or("the scene's chunk has no text")?;
    String::from_utf8(text.to_vec()).map_err(|_| "the scene is not UTF-8".to_owned())
}

/// The check sum of PNG chunks (ISO 3309, reflected polynomial 0xEDB88320), bit by bit: at most a megabyte is summed.
fn crc32(parts: &[&[u8]]) -> u32 {
    let mut crc = u32::MAX;
    for byte in parts.iter().flat_map(|part| part.iter()) {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg());
        }
    }
    !crc
}
