//! Every format comes back as it was stored.

use std::io::Cursor;

use sixfold::imaging::load::LoadProblem;
use sixfold::imaging::sanitize::sanitize;
use sixfold::imaging::srgb::srgb_from_linear;

use super::fixtures::*;

#[test]
fn hdr_in_every_coding_and_orientation() {
    let expected = gradient();
    let control = mirrored(&expected, WIDTH);
    let mut old_runs = b"#?RADIANCE\n\n-Y 8 +X 16\n".to_vec();
    for row in 0..8_u8 {
        old_runs.extend([10, 20, row, 136, 1, 1, 1, 14, 9, 9, 9, 136]);
    }
    let runs = open(&old_runs).unwrap().image;
    assert_eq!(runs.texel(14, 3), Some([10.0, 20.0, 3.0]));
    assert_eq!(runs.texel(15, 3), Some([9.0; 3]));

    for bytes in [flat_hdr(), rle_hdr()] {
        let loaded = open(&bytes).unwrap();
        assert_eq!(loaded.image.pixels(), expected);
        assert_ne!(loaded.image.pixels(), control);
        assert!(loaded.bad.is_clean() && loaded.originals.is_empty());
    }
    let turned: Vec<_> = expected.iter().rev().copied().collect();
    let below: Vec<_> = expected.chunks(WIDTH).rev().flatten().copied().collect();
    let stored = [
        ("-Y 8 -X 16", control),
        ("+Y 8 -X 16", turned),
        ("+Y 8 +X 16", below),
    ];
    for (resolution, pixels) in stored {
        assert_eq!(
            open(&hdr(resolution, &pixels)).unwrap().image.pixels(),
            expected,
            "{resolution}"
        );
    }
    let xyze = b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 8 +X 16\n";
    assert!(matches!(
        open(xyze).unwrap_err().problem,
        LoadProblem::Unsupported { .. }
    ));
}

#[test]
fn hdr_values_span_the_range_of_the_exponent() {
    for (exponent, scale) in [
        (136, 1.0),
        (128, 1.0 / 256.0),
        (1, 2.0_f64.powi(-135)),
        (0, 0.0),
    ] {
        let mut bytes = b"#?RADIANCE\n\n-Y 1 +X 2\n".to_vec();
        bytes.extend([128, 64, 1, exponent, 0, 0, 0, exponent]);
        let loaded = open(&bytes).unwrap();
        let expected = [128.0, 64.0, 1.0].map(|c| (c * scale) as f32);
        assert_eq!(loaded.image.pixels(), [expected, [0.0; 3]]);
    }
}

#[test]
fn exr_in_every_compression() {
    use exr::prelude::*;
    let expected = gradient();
    let lossless = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
    ];
    let lossy = [
        Compression::PXR24,
        Compression::B44,
        Compression::DWAA(None),
        Compression::DWAB(None),
    ];
    let blocks = [Blocks::ScanLines, Blocks::Tiles(Vec2(5, 3))];
    let mut observed: f32 = 0.0;
    for (compression, budget) in lossless
        .map(|c| (c, 0.0))
        .into_iter()
        .chain(lossy.map(|c| (c, 8.0)))
    {
        for (half, blocks) in [(true, blocks[0]), (true, blocks[1]), (false, blocks[0])] {
            let encoding = Encoding {
                compression,
                blocks,
                line_order: LineOrder::Increasing,
            };
            let loaded = open(&exr_file(&expected, encoding, half)).unwrap();
            let difference = largest_difference(loaded.image.pixels(), &expected);
            assert!(
                difference <= budget,
                "{compression:?} {blocks:?} half {half}: {difference}"
            );
            observed = observed.max(difference);
            let control = largest_difference(loaded.image.pixels(), &mirrored(&expected, WIDTH));
            assert!(control > 12.0, "{compression:?}: {control}");
        }
    }
    assert!(
        observed > 0.8,
        "the lossy budget is far above the error: {observed}"
    );
}

#[test]
fn exr_of_one_luminance_channel_and_without_colour() {
    use exr::prelude::*;
    let file = |name: &str| {
        let samples = FlatSamples::F32((0..128).map(|i| i as f32).collect());
        let channels = AnyChannels::sort([AnyChannel::new(name, samples)].into_iter().collect());
        let mut bytes = Cursor::new(Vec::new());
        let image = exr::image::Image::from_channels((16, 8), channels);
        image.write().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    };
    assert_eq!(open(&file("Y")).unwrap().image.texel(3, 1), Some([19.0; 3]));
    assert_eq!(
        open(&file("view.Y")).unwrap().image.texel(3, 1),
        Some([19.0; 3])
    );
    assert!(matches!(
        open(&file("Z")).unwrap_err().problem,
        LoadProblem::Unsupported { .. }
    ));
}

#[test]
fn png_of_every_kind() {
    use png::{BitDepth, ColorType};
    let linear = |c: f64| {
        if c <= 0.04045 {
            c / 12.92
        } else {
            ((c + 0.055) / 1.055).powf(2.4)
        }
    };
    let count = WIDTH * HEIGHT;
    for (color, samples) in [
        (ColorType::Grayscale, 1),
        (ColorType::GrayscaleAlpha, 2),
        (ColorType::Rgb, 3),
        (ColorType::Rgba, 4),
    ] {
        for (depth, bytes) in [(BitDepth::Eight, 1), (BitDepth::Sixteen, 2)] {
            let data: Vec<u8> = (0..count * samples * bytes)
                .map(|i| (i * 37 % 253) as u8)
                .collect();
            let image = open(&png_file(color, depth, &data)).unwrap().image;
            let value = |texel: usize, sample: usize| {
                let at = (texel * samples + sample) * bytes;
                if bytes == 1 {
                    f64::from(data[at]) / 255.0
                } else {
                    f64::from(u16::from_be_bytes([data[at], data[at + 1]])) / 65535.0
                }
            };
            let (mut worst, mut undecoded) = (0.0_f64, 0.0_f64);
            for (texel, rgb) in image.pixels().iter().enumerate() {
                for (channel, got) in rgb.map(f64::from).into_iter().enumerate() {
                    let stored = value(texel, if samples >= 3 { channel } else { 0 });
                    worst = worst.max((got - linear(stored)).abs());
                    undecoded = undecoded.max((got - stored).abs());
                }
            }
            // f32 powf: observed below 1.2e-7.
            assert!(worst < 5e-7, "{color:?} {depth:?}: {worst}");
            assert!(undecoded > 0.2, "the control without decoding passes");
        }
    }
}

#[test]
fn interlaced_png() {
    // Two grey texels: the first comes in pass 1, the second in pass 6, each line after its filter byte.
    let lines = [0, 40, 0, 200_u8];
    let (mut low, mut high) = (1_u32, 0_u32); // Adler-32
    for byte in lines {
        low += u32::from(byte);
        high += low;
    }
    let mut zlib = vec![0x78, 0x01, 1, 4, 0, 0xfb, 0xff]; // one stored block of 4 bytes
    zlib.extend(lines);
    zlib.extend((high << 16 | low).to_be_bytes());
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |kind: &[u8; 4], body: &[u8]| {
        bytes.extend((body.len() as u32).to_be_bytes());
        let start = bytes.len();
        bytes.extend(kind);
        bytes.extend(body);
        bytes.extend(crc32(&bytes[start..]).to_be_bytes());
    };
    chunk(b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 1, 8, 0, 0, 0, 1]);
    chunk(b"IDAT", &zlib);
    chunk(b"IEND", &[]);
    let image = open(&bytes).unwrap().image;
    let back = image
        .pixels()
        .iter()
        .map(|p| (srgb_from_linear(p[0]) * 255.0).round());
    assert_eq!(back.collect::<Vec<_>>(), [40.0, 200.0]);
}

#[test]
fn jpeg_colors_come_back() {
    let image = open(&plain_jpeg()).unwrap().image;
    let to_bytes = |rgb: [f32; 3]| rgb.map(|c| srgb_from_linear(c) * 255.0);
    let off = |rgb: [f32; 3], want: [f32; 3]| {
        let got = to_bytes(rgb);
        (0..3).map(|c| (got[c] - want[c]).abs()).fold(0.0, f32::max)
    };
    let (left, right) = (image.texel(2, 3).unwrap(), image.texel(12, 3).unwrap());
    // Quality 95 rounds flat blocks by 3 steps at most.
    assert!(
        off(left, [200.0, 60.0, 40.0]) <= 3.0,
        "{:?}",
        to_bytes(left)
    );
    assert!(
        off(right, [30.0, 90.0, 180.0]) <= 3.0,
        "{:?}",
        to_bytes(right)
    );
    assert!(off(left, [30.0, 90.0, 180.0]) > 50.0);
}

#[test]
fn bad_texels_are_counted_replaced_and_remembered() {
    let mut pixels = gradient();
    pixels[3] = [f32::NAN, 1.0, 2.0];
    pixels[40] = [f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
    pixels[41] = [0.5, -1.0, 65504.0];
    pixels[100] = [1e30, -0.0, 1e-40];
    let encoding = exr::image::Encoding::UNCOMPRESSED;
    let loaded = open(&exr_file(&pixels, encoding, false)).unwrap();
    let bad = loaded.bad;
    assert_eq!(
        (bad.nan, bad.infinite, bad.negative, bad.too_bright),
        (2, 1, 1, 1)
    );
    assert_eq!(
        bad.summary().unwrap(),
        "texels replaced: 2 NaN, 1 infinite, 1 negative, 1 too bright"
    );
    let now = loaded.image.pixels();
    assert_eq!(now[3], [0.0, 1.0, 2.0]);
    assert_eq!(now[40], [65504.0, 0.0, 0.0]);
    assert_eq!(now[41], [0.5, 0.0, 65504.0]);
    assert_eq!(now[100], [65504.0, 0.0, 1e-40]);
    assert_eq!(loaded.originals.len(), 4);
    assert!(loaded.originals.get(3).unwrap()[0].is_nan());
    assert_eq!(loaded.originals.get(41), Some([0.5, -1.0, 65504.0]));
    assert_eq!(loaded.originals.get(4), None);
    assert!(now.iter().flatten().all(|c| c.is_finite()));
    assert!(
        pixels.iter().flatten().any(|c| !c.is_finite()),
        "the control is clean"
    );
    // Once clean, nothing is found again.
    let mut again = loaded.image.clone();
    assert!(sanitize(&mut again).0.is_clean());
}

#[test]
fn half_float_nan_survives_to_the_probe() {
    let mut pixels = gradient();
    pixels[7] = [f32::NAN, f32::INFINITY, -1.0];
    let loaded = open(&exr_file(
        &pixels,
        exr::image::Encoding::FAST_LOSSLESS,
        true,
    ))
    .unwrap();
    let original = loaded.originals.get(7).unwrap();
    assert!(original[0].is_nan() && original[1].is_infinite() && original[2] == -1.0);
}
