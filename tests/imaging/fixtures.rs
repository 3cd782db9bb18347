//! Small files in every format, made in memory.

use std::io::Cursor;

use sixfold::imaging::load::{Format, load_bytes};
use sixfold::imaging::{LoadError, Loaded, Progress};

pub const WIDTH: usize = 16;
pub const HEIGHT: usize = 8;

pub fn open(bytes: &[u8]) -> Result<Loaded, LoadError> {
    load_bytes(bytes, "here.pic", &Progress::new())
}

/// A different colour in every texel, none of them symmetric under flips, exact in RGBE and half float.
pub fn gradient() -> Vec<[f32; 3]> {
    (0..WIDTH * HEIGHT)
        .map(|i| {
            [
                128.0 + i as f32 / 2.0,
                64.0 + (i % WIDTH) as f32,
                1.0 + (i / WIDTH) as f32,
            ]
        })
        .map(|c| c.map(|v| v.round()))
        .collect()
}

pub fn rgbe([r, g, b]: [f32; 3]) -> [u8; 4] {
    // All test values are whole and below 256: exponent 128 + 8.
    [r as u8, g as u8, b as u8, 136]
}

pub fn hdr(resolution: &str, pixels: &[[f32; 3]]) -> Vec<u8> {
    let mut bytes =
        format!("#?RADIANCE\n# note\nFORMAT=32-bit_rle_rgbe\n\n{resolution}\n").into_bytes();
    bytes.extend(pixels.iter().flat_map(|p| rgbe(*p)));
    bytes
}

pub fn flat_hdr() -> Vec<u8> {
    hdr("-Y 8 +X 16", &gradient())
}

pub fn rle_hdr() -> Vec<u8> {
    let mut bytes = b"#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
    for row in gradient().chunks(WIDTH) {
        bytes.extend([2, 2, 0, WIDTH as u8]);
        for component in 0..3 {
            bytes.push(WIDTH as u8);
            bytes.extend(row.iter().map(|p| rgbe(*p)[component]));
        }
        bytes.extend([128 + WIDTH as u8, 136]);
    }
    bytes
}

pub fn exr_file(pixels: &[[f32; 3]], encoding: exr::image::Encoding, half: bool) -> Vec<u8> {
    use exr::prelude::*;
    let at = |p: Vec2<usize>| pixels[p.y() * WIDTH + p.x()];
    let mut bytes = Cursor::new(Vec::new());
    let attributes = LayerAttributes::default();
    if half {
        let channels = SpecificChannels::rgb(|p: Vec2<usize>| {
            let [r, g, b] = at(p).map(f16::from_f32);
            (r, g, b)
        });
        let layer = Layer::new((WIDTH, HEIGHT), attributes, encoding, channels);
        exr::image::Image::from_layer(layer)
            .write()
            .to_buffered(&mut bytes)
            .unwrap();
    } else {
        let channels = SpecificChannels::rgb(|p: Vec2<usize>| {
            let [r, g, b] = at(p);
            (r, g, b)
        });
        let layer = Layer::new((WIDTH, HEIGHT), attributes, encoding, channels);
        exr::image::Image::from_layer(layer)
            .write()
            .to_buffered(&mut bytes)
            .unwrap();
    }
    bytes.into_inner()
}

pub fn plain_exr() -> Vec<u8> {
    exr_file(&gradient(), exr::image::Encoding::FAST_LOSSLESS, true)
}

pub fn png_file(color: png::ColorType, depth: png::BitDepth, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, WIDTH as u32, HEIGHT as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

pub fn plain_png() -> Vec<u8> {
    let data: Vec<u8> = (0..WIDTH * HEIGHT * 3)
        .map(|i| (i * 7 % 251) as u8)
        .collect();
    png_file(png::ColorType::Rgb, png::BitDepth::Eight, &data)
}

pub fn plain_jpeg() -> Vec<u8> {
    // Eight by eight blocks of one colour survive the compression almost exactly.
    let pixels: Vec<u8> = (0..WIDTH * HEIGHT)
        .flat_map(|i| {
            if i % WIDTH < 8 {
                [200, 60, 40]
            } else {
                [30, 90, 180]
            }
        })
        .collect();
    let mut bytes = Vec::new();
    image::codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, 95)
        .encode(
            &pixels,
            WIDTH as u32,
            HEIGHT as u32,
            image::ExtendedColorType::Rgb8,
        )
        .unwrap();
    bytes
}

pub fn largest_difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

pub fn mirrored(pixels: &[[f32; 3]], width: usize) -> Vec<[f32; 3]> {
    pixels
        .chunks(width)
        .flat_map(|row| row.iter().rev().copied())
        .collect()
}

pub fn seeds() -> [(Format, Vec<u8>); 8] {
    use exr::prelude::*;
    let dwa = Encoding {
        compression: Compression::DWAB(None),
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let piz = Encoding {
        compression: Compression::PIZ,
        blocks: Blocks::Tiles(Vec2(7, 5)),
        line_order: LineOrder::Increasing,
    };
    let b44 = Encoding {
        compression: Compression::B44,
        ..dwa
    };
    [
        (Format::Hdr, flat_hdr()),
        (Format::Hdr, rle_hdr()),
        (Format::Exr, plain_exr()),
        (Format::Exr, exr_file(&gradient(), dwa, true)),
        (Format::Exr, exr_file(&gradient(), piz, false)),
        (Format::Exr, exr_file(&gradient(), b44, true)),
        (Format::Png, plain_png()),
        (Format::Jpeg, plain_jpeg()),
    ]
}

pub fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte), |crc, _| {
            if crc & 1 == 1 {
                (crc >> 1) ^ 0xEDB8_8320
            } else {
                crc >> 1
            }
        })
    })
}

pub fn next(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}
