//! Pictures in and out: orientation, every format, bad values, hostile files, scenes in PNG text.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use std::f64::consts::{PI, TAU};
use std::io::Cursor;

use sixfold::imaging::computed::{self, Pattern, dodecahedron_vertices, icosahedron_vertices};
use sixfold::imaging::load::{self, Format, LoadProblem, declared_size, load_bytes};
use sixfold::imaging::sanitize::sanitize;
use sixfold::imaging::srgb::{linear_from_srgb8, srgb_from_linear};
use sixfold::imaging::{
    Environment, FACE_COLORS, Image, LoadError, Loaded, Progress, Stage, atomic, png_out,
};

// ---------------------------------------------------------------- fixtures

const WIDTH: usize = 16;
const HEIGHT: usize = 8;

fn open(bytes: &[u8]) -> Result<Loaded, LoadError> {
    load_bytes(bytes, "here.pic", &Progress::new())
}

/// A different colour in every texel, none of them symmetric under flips, exact in RGBE and half float.
fn gradient() -> Vec<[f32; 3]> {
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

fn rgbe([r, g, b]: [f32; 3]) -> [u8; 4] {
    // All test values are whole and below 256: exponent 128 + 8.
    [r as u8, g as u8, b as u8, 136]
}

fn hdr(resolution: &str, pixels: &[[f32; 3]]) -> Vec<u8> {
    let mut bytes =
        format!("#?RADIANCE\n# note\nFORMAT=32-bit_rle_rgbe\n\n{resolution}\n").into_bytes();
    bytes.extend(pixels.iter().flat_map(|p| rgbe(*p)));
    bytes
}

fn flat_hdr() -> Vec<u8> {
    hdr("-Y 8 +X 16", &gradient())
}

fn rle_hdr() -> Vec<u8> {
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

fn exr_file(pixels: &[[f32; 3]], encoding: exr::image::Encoding, half: bool) -> Vec<u8> {
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

fn plain_exr() -> Vec<u8> {
    exr_file(&gradient(), exr::image::Encoding::FAST_LOSSLESS, true)
}

/// The first texel's bytes are those of `texel(index)`.
fn png_file(color: png::ColorType, depth: png::BitDepth, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, WIDTH as u32, HEIGHT as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

fn plain_png() -> Vec<u8> {
    let data: Vec<u8> = (0..WIDTH * HEIGHT * 3)
        .map(|i| (i * 7 % 251) as u8)
        .collect();
    png_file(png::ColorType::Rgb, png::BitDepth::Eight, &data)
}

fn plain_jpeg() -> Vec<u8> {
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

fn largest_difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

fn mirrored(pixels: &[[f32; 3]], width: usize) -> Vec<[f32; 3]> {
    pixels
        .chunks(width)
        .flat_map(|row| row.iter().rev().copied())
        .collect()
}

// ---------------------------------------------------------------- computed environments

fn picture(pattern: Pattern, height: u32) -> Image {
    computed::compute(pattern, height, &Progress::new()).unwrap()
}

/// The spec's forward map, written here again.
fn uv([x, y, z]: [f64; 3]) -> (f64, f64) {
    let n = (x * x + y * y + z * z).sqrt();
    (0.5 + x.atan2(z) / TAU, (y / n).acos() / PI)
}

#[test]
fn labelled_faces_lie_where_latlong_puts_them() {
    let image = picture(Pattern::LabelledFaces, 256);
    // Off the axis, where no letter stands: a = 0.1, b = 0.65 or the like.
    let probes = [
        [1.0, 0.1, 0.62],
        [-1.0, 0.1, 0.62],
        [0.1, 1.0, -0.62],
        [0.1, -1.0, -0.62],
        [0.1, -0.62, 1.0],
        [0.1, -0.62, -1.0],
    ];
    let count_right = |flip: bool| {
        (0..6)
            .filter(|&face| {
                let (u, v) = uv(probes[face]);
                let color = image.nearest(if flip { 1.0 - u } else { u }, v);
                color == linear_from_srgb8(FACE_COLORS[face])
            })
            .count()
    };
    assert_eq!(count_right(false), 6);
    // Mirrored, +x and -x change places, so four stay at most.
    assert!(count_right(true) <= 4, "the mirrored control looks alike");
    // The brief form of the same: the middle is +z, a quarter to the right is +x.
    let middle = |u: f64| image.nearest(u, 0.37);
    assert_eq!(middle(0.53), linear_from_srgb8(FACE_COLORS[4]));
    assert_eq!(middle(0.78), linear_from_srgb8(FACE_COLORS[0]));
    assert_ne!(middle(0.78), linear_from_srgb8(FACE_COLORS[1]));
}

/// Darkness or brightness of a letter at gnomonic (a, b) of +z, where white ink stands on blue.
fn has_ink(image: &Image, a: f64, b: f64) -> bool {
    let (u, v) = uv([a, -b, 1.0]);
    image.nearest(u, v)[0] > 0.5
}

#[test]
fn letters_read_correctly_from_inside() {
    let image = picture(Pattern::LabelledFaces, 512);
    // The R: its stem is on the left, its leg runs down to the right, and the right of the stem's foot is empty.
    let (left, top, size) = (0.62, 0.5, 0.32);
    let at = |x: f64, y: f64| has_ink(&image, left + x * size, top + y * size);
    let is_r = |x: &dyn Fn(f64) -> f64| at(x(0.0), 0.8) && at(x(0.6), 0.25) && !at(x(0.6), 0.75);
    assert!(is_r(&|x| x));
    assert!(!is_r(&|x| 0.6 - x), "the mirrored letter reads as well");
    // The u arrow runs right from the upper left corner, the v arrow down.
    assert!(has_ink(&image, -0.5, -0.8) && has_ink(&image, -0.8, -0.5));
    assert!(!has_ink(&image, 0.5, -0.8) && !has_ink(&image, -0.8, 0.5));
}

#[test]
fn direction_color_is_the_inverse_of_latlong() {
    let image = picture(Pattern::DirectionColor, 64);
    let worst = |flip_v: bool| {
        let mut worst = 0.0_f64;
        for y in 0..64 {
            for x in 0..128 {
                let rgb = image.texel(x, y).unwrap();
                let dir = rgb.map(|c| 2.0 * f64::from(c) - 1.0);
                let (u, v) = uv(dir);
                let v = if flip_v { 1.0 - v } else { v };
                let du = u - (f64::from(x) + 0.5) / 128.0;
                let dv = v - (f64::from(y) + 0.5) / 64.0;
                worst = worst.max(du.abs()).max(dv.abs());
            }
        }
        worst
    };
    // f32 storage: half an ULP of 1 in each component, over the sine of the first row's colatitude (0.025) and 2 pi.
    // Observed 5.2e-7.
    let observed = worst(false);
    assert!(observed < 2e-6, "{observed}");
    assert!(
        observed > 2e-8,
        "the budget is far above the error: {observed}"
    );
    assert!(worst(true) > 0.4);
}

#[test]
fn crosses_stand_at_dual_vertices() {
    let (twelve, twenty) = (icosahedron_vertices(), dodecahedron_vertices());
    assert_eq!((twelve.len(), twenty.len()), (12, 20));
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    // Circumradius over inradius of the icosahedron: three corners at cosine 0.79465 around each face's middle.
    let around = |a: &[[f64; 3]], b: [f64; 3], cosine: f64| {
        a.iter()
            .filter(|a| (dot(**a, b) - cosine).abs() < 1e-12)
            .count()
    };
    let inradius = ((5.0 + 2.0 * 5.0_f64.sqrt()) / 15.0).sqrt();
    assert!(twenty.iter().all(|v| around(&twelve, *v, inradius) == 3));
    assert!(twelve.iter().all(|v| around(&twenty, *v, inradius) == 5));
    // The other orientation of the dodecahedron, (0, ±1/phi, ±phi), is not dual.
    assert!(
        !twenty
            .iter()
            .all(|&[x, y, z]| around(&twelve, [y, x, z], inradius) == 3)
    );

    let image = picture(Pattern::IcosahedronCrosses, 512);
    let is = |dir: [f64; 3], channel: usize| {
        let (u, v) = uv(dir);
        let rgb = image.nearest(u, v);
        rgb[channel] > 0.5 && rgb[2 - channel] < 0.1
    };
    assert!(twelve.iter().all(|v| is(*v, 0)) && twenty.iter().all(|v| is(*v, 2)));
    assert!(!twelve.iter().any(|v| is(*v, 2)) && !twenty.iter().any(|v| is(*v, 0)));
    // Equal angular size: ink reaches 4.8 degrees from the centre up and to the side, not 5.3.
    let reaches = |degrees: f64| {
        twelve.iter().chain(&twenty).all(|&[x, y, z]| {
            let east = [z, 0.0, -x].map(|c| c / x.hypot(z));
            let angle = degrees.to_radians();
            let side = [0, 1, 2].map(|i| [x, y, z][i] * angle.cos() + east[i] * angle.sin());
            let up = (y.asin() + angle).sin_cos();
            let up = [x / x.hypot(z) * up.1, up.0, z / x.hypot(z) * up.1];
            [side, up].iter().all(|dir| {
                let (u, v) = uv(*dir);
                image.nearest(u, v)[1] < 0.4
            })
        })
    };
    assert!(reaches(4.8) && !reaches(5.4));
}

#[test]
fn the_graticule_has_its_lines() {
    let image = picture(Pattern::Graticule, 720);
    let dark = |lon: f64, lat: f64| {
        let rgb = image.nearest(0.5 + lon / 360.0, 0.5 - lat / 180.0);
        rgb[1] < 0.6
    };
    for step in -5..=5 {
        let line = f64::from(step) * 15.0;
        assert!(dark(52.5, line), "parallel {line}");
        assert!(dark(line + 0.01, 52.5), "meridian {line}");
        assert!(
            !dark(line + 7.5, 52.5) && !dark(52.5, line + 7.5),
            "off the lines at {line}"
        );
    }
    let prime = image.nearest(0.5, 0.3);
    assert!(prime[2] > 3.0 * prime[0], "meridian 0 is blue");
    let equator = image.nearest(0.52, 0.5);
    assert!(equator[0] > 3.0 * equator[2], "the equator is vermilion");
    let date_line = image.nearest(0.0, 0.3);
    assert!(
        date_line[2] < 1.5 * date_line[0],
        "the date line is not meridian 0"
    );
}

#[test]
fn sizes_out_of_range_and_cancelling_end_in_messages() {
    let fresh = Progress::new();
    for height in [0, load::MOST_HEIGHT + 1, u32::MAX] {
        let result = computed::compute(Pattern::DirectionColor, height, &fresh);
        assert!(
            matches!(result, Err(LoadProblem::TooLarge { .. })),
            "{height}"
        );
    }
    assert!(computed::compute(Pattern::Graticule, 1, &fresh).is_ok());
    let cancelled = Progress::new();
    cancelled.cancel();
    let result = computed::compute(Pattern::Graticule, 64, &cancelled);
    assert!(matches!(result, Err(LoadProblem::Cancelled)));
}

// ---------------------------------------------------------------- environments

#[test]
fn ids_and_scenes_name_every_environment() {
    let mut ids = Vec::new();
    for environment in Environment::ALL_BUILT_IN {
        let id = environment.id();
        assert_eq!(
            serde_json::to_string(&environment).unwrap(),
            format!("\"{id}\"")
        );
        assert_eq!(Environment::from_id(&id), environment);
        assert!(!environment.name().is_empty());
        ids.push(id);
    }
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), Environment::ALL_BUILT_IN.len());
    let file = Environment::from_id("some/room.exr");
    assert_eq!(
        (file.name().as_str(), file.id().as_str()),
        ("room.exr", "some/room.exr")
    );
    let text = serde_json::to_string(&file).unwrap();
    assert_eq!(serde_json::from_str::<Environment>(&text).unwrap(), file);
}

#[test]
fn embedded_photographs_decode_as_the_reference_library_decodes_them() {
    // Negative texels and the mean of green (before replacing), by the reference OpenEXR library.
    let cases = [
        (Environment::Courtyard, 1188, 0.510_655_083),
        (Environment::Sunset, 5, 0.416_061_004),
    ];
    for (environment, negative, mean_green) in cases {
        let progress = Progress::new();
        let loaded = environment.image(&progress).unwrap();
        assert_eq!((loaded.image.width(), loaded.image.height()), (1024, 512));
        assert_eq!(loaded.bad.negative, negative, "{}", environment.id());
        assert_eq!(
            (loaded.bad.nan, loaded.bad.infinite, loaded.bad.too_bright),
            (0, 0, 0)
        );
        let green =
            |(i, p): (usize, &[f32; 3])| f64::from(loaded.originals.get(i).unwrap_or(*p)[1]);
        let sum: f64 = loaded.image.pixels().iter().enumerate().map(green).sum();
        let mean = sum / (1024.0 * 512.0);
        assert!((mean - mean_green).abs() < 2e-9, "{mean}");
        assert_eq!((progress.stage(), progress.fraction()), (Stage::Done, 1.0));
    }
}

// ---------------------------------------------------------------- formats

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
                for channel in 0..3 {
                    let stored = value(texel, if samples >= 3 { channel } else { 0 });
                    worst = worst.max((f64::from(rgb[channel]) - linear(stored)).abs());
                    undecoded = undecoded.max((f64::from(rgb[channel]) - stored).abs());
                }
            }
            // f32 powf: observed below 1.2e-7.
            assert!(worst < 5e-7, "{color:?} {depth:?}: {worst}");
            assert!(undecoded > 0.2, "the control without decoding passes");
        }
    }
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
        "2 NaN, 1 infinite, 1 negative, 1 too bright"
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

// ---------------------------------------------------------------- hostile files

fn hdr_bomb() -> Vec<u8> {
    b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\n".to_vec()
}

fn png_bomb() -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR".to_vec();
    bytes.extend(100_000_u32.to_be_bytes());
    bytes.extend(100_000_u32.to_be_bytes());
    bytes.extend([8, 2, 0, 0, 0, 0x12, 0x34, 0x56, 0x78]);
    bytes
}

fn jpeg_bomb() -> Vec<u8> {
    b"\xff\xd8\xff\xc0\0\x11\x08\xff\xff\xff\xff\x03\x01\x22\0\x02\x11\x01\x03\x11\x01".to_vec()
}

/// An EXR header of one half-float RGB layer, scan lines or tiles, followed by nothing.
fn exr_header(width: i32, height: i32, tile: Option<u32>, channels: usize) -> Vec<u8> {
    let mut bytes = vec![
        0x76,
        0x2f,
        0x31,
        0x01,
        2,
        if tile.is_some() { 2 } else { 0 },
        0,
        0,
    ];
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        bytes.extend(name.as_bytes());
        bytes.push(0);
        bytes.extend(kind.as_bytes());
        bytes.push(0);
        bytes.extend((value.len() as i32).to_le_bytes());
        bytes.extend(value);
    };
    let mut list = Vec::new();
    let extra: Vec<String> = (3..channels).map(|i| format!("A{i:04}")).collect();
    for name in extra.iter().map(String::as_str).chain(["B", "G", "R"]) {
        list.extend(name.as_bytes());
        list.push(0);
        list.extend(1_i32.to_le_bytes()); // half float
        list.extend([0; 4]);
        list.extend([1, 0, 0, 0, 1, 0, 0, 0]); // sampling
    }
    list.push(0);
    attribute("channels", "chlist", &list);
    attribute("compression", "compression", &[0]);
    let window: Vec<u8> = [0, 0, width - 1, height - 1]
        .iter()
        .flat_map(|v: &i32| v.to_le_bytes())
        .collect();
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1.0_f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1.0_f32.to_le_bytes());
    if let Some(tile) = tile {
        let mut value = [tile.to_le_bytes(), tile.to_le_bytes()].concat();
        value.push(0);
        attribute("tiles", "tiledesc", &value);
    }
    bytes.push(0);
    bytes
}

#[test]
fn bombs_are_refused_by_their_declared_size() {
    let cases = [
        (hdr_bomb(), 60_000, 60_000),
        (png_bomb(), 100_000, 100_000),
        (jpeg_bomb(), 65_535, 65_535),
        (exr_header(60_000, 60_000, None, 3), 60_000, 60_000),
        (exr_header(16_384, 16_384, Some(64), 3), 16_384, 16_384),
    ];
    for (bytes, width, height) in cases {
        assert_eq!(declared_size(&bytes).unwrap(), (width, height));
        let error = open(&bytes).unwrap_err();
        assert!(
            matches!(error.problem, LoadProblem::TooLarge { .. }),
            "{error}"
        );
        let text = error.to_string();
        assert!(text.contains(&format!("{width} x {height}")), "{text}");
        assert!(
            text.contains("16384 x 8192") && text.ends_with(": here.pic"),
            "{text}"
        );
        assert!(!text.contains('\n'));
    }
}

#[test]
fn exr_headers_that_hide_their_size_are_refused() {
    let refused = |bytes: &[u8], what: &str| match open(bytes).unwrap_err().problem {
        LoadProblem::TooMuch {
            what: found,
            declared,
            limit,
        } => {
            assert_eq!(found, what);
            assert!(declared > limit);
        }
        other => panic!("{what}: {other}"),
    };
    refused(&exr_header(16, 8, Some(60_000), 3), "one block");
    refused(&exr_header(16_384, 8_192, Some(2), 3), "its offset tables");
    refused(&exr_header(16_384, 8_192, None, 2000), "all channels");
    // Within the limits, but nothing follows.
    let error = open(&exr_header(16, 8, None, 3)).unwrap_err();
    assert!(
        matches!(
            error.problem,
            LoadProblem::Damaged {
                format: Format::Exr,
                ..
            }
        ),
        "{error}"
    );
    for (width, height) in [(0, 0), (i32::MIN, 5), (i32::MAX, i32::MAX), (-7, -7)] {
        assert!(open(&exr_header(width.max(i32::MIN + 2), height, None, 3)).is_err());
    }
}

#[test]
fn other_shapes_are_named() {
    let pixels = [[1.0; 3]; 64];
    let error = open(&hdr("-Y 8 +X 8", &pixels)).unwrap_err().to_string();
    assert!(
        error.contains("8 x 8") && error.contains("only latlong"),
        "{error}"
    );
    let error = open(&hdr("-Y 0 +X 0", &[])).unwrap_err().to_string();
    assert!(error.contains("0 x 0"), "{error}");
    // Within a texel of 2:1 is still a latlong.
    assert!(open(&hdr("-Y 7 +X 15", &[[3.0; 3]; 105])).is_ok());
    assert!(open(&hdr("-Y 7 +X 16", &[[3.0; 3]; 112])).is_err());
    let error = open(b"GIF89a....").unwrap_err();
    assert!(
        matches!(error.problem, LoadProblem::UnknownFormat { .. }),
        "{error}"
    );
    assert!(open(b"").is_err());
}

fn seeds() -> [(Format, Vec<u8>); 7] {
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
    [
        (Format::Hdr, flat_hdr()),
        (Format::Hdr, rle_hdr()),
        (Format::Exr, plain_exr()),
        (Format::Exr, exr_file(&gradient(), dwa, true)),
        (Format::Exr, exr_file(&gradient(), piz, false)),
        (Format::Png, plain_png()),
        (Format::Jpeg, plain_jpeg()),
    ]
}

#[test]
fn truncated_files_end_in_a_message() {
    for (format, whole) in seeds() {
        assert!(
            open(&whole).is_ok(),
            "{format:?}: the whole file does not open"
        );
        // The last bytes of PNG and JPEG hold no texels.
        for length in (0..whole.len().saturating_sub(60))
            .step_by(97)
            .chain([1, 9, 40])
        {
            let result = open(&whole[..length]);
            // A JPEG that breaks off in its data is filled up by its decoder, as every viewer does.
            assert!(
                result.is_err() || format == Format::Jpeg,
                "{format:?} cut at {length}"
            );
        }
    }
}

fn next(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}

/// Makes the check sums of all chunks right again, so that damage reaches the decoder.
fn repair_png(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(head) = bytes.get(at..at + 4) {
        let length = u32::from_be_bytes(head.try_into().unwrap()) as usize;
        let Some(body) = bytes.get(at + 4..at + 8 + length) else {
            return;
        };
        let sum = crc32(body).to_be_bytes();
        let Some(place) = bytes.get_mut(at + 8 + length..at + 12 + length) else {
            return;
        };
        place.copy_from_slice(&sum);
        at += 12 + length;
    }
}

fn crc32(bytes: &[u8]) -> u32 {
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

#[test]
fn mutated_files_never_panic() {
    let rounds: u64 = std::env::var("SIXFOLD_MUTATIONS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(300);
    for (format, whole) in seeds() {
        let (mut state, mut opened, mut refused) = (0x9E37_79B9_7F4A_7C15, 0, 0);
        for round in 0..rounds {
            let mut bytes = whole.clone();
            for _ in 0..=next(&mut state) % 4 {
                let at = (next(&mut state) % bytes.len() as u64) as usize;
                match next(&mut state) % 4 {
                    0 => bytes[at] = next(&mut state) as u8,
                    1 => bytes[at] ^= 1 << (next(&mut state) % 8),
                    2 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][(next(&mut state) % 5) as usize],
                    _ => drop(bytes.remove(at)),
                }
            }
            if format == Format::Png && round % 2 == 0 {
                repair_png(&mut bytes);
            }
            match open(&bytes) {
                Ok(loaded) => {
                    opened += 1;
                    assert!(
                        loaded
                            .image
                            .pixels()
                            .iter()
                            .flatten()
                            .all(|c| (0.0..=65504.0).contains(c))
                    );
                }
                Err(error) => {
                    refused += 1;
                    assert!(error.to_string().ends_with(": here.pic"));
                }
            }
        }
        // Both happen, or the mutations test nothing.
        assert!(
            opened > 0 && refused > 0,
            "{format:?}: {opened} opened, {refused} refused"
        );
    }
}

// ---------------------------------------------------------------- jobs and files

#[test]
fn cancelled_loads_stop_and_files_open() {
    let folder = tempfile::tempdir().unwrap();
    for (index, (format, bytes)) in seeds().into_iter().enumerate() {
        let path = folder.path().join(format!("{index}.pic"));
        std::fs::write(&path, &bytes).unwrap();
        let progress = Progress::new();
        assert!(load::load(&path, &progress).is_ok(), "{format:?}");
        assert_eq!(progress.stage(), Stage::Done);
        progress.cancel();
        let error = load::load(&path, &progress).unwrap_err();
        assert!(
            matches!(error.problem, LoadProblem::Cancelled),
            "{format:?}: {error}"
        );
        let error = load_bytes(&bytes, "memory", &progress).unwrap_err();
        assert!(
            matches!(error.problem, LoadProblem::Cancelled),
            "{format:?}: {error}"
        );
    }
    let missing = folder.path().join("missing.hdr");
    let error = load::load(&missing, &Progress::new()).unwrap_err();
    assert!(error.to_string().ends_with("missing.hdr"), "{error}");
    let error = load::load(folder.path(), &Progress::new()).unwrap_err();
    assert!(matches!(error.problem, LoadProblem::NotAFile), "{error}");
    assert!(Environment::File(missing).image(&Progress::new()).is_err());
}

#[test]
fn a_load_is_stopped_from_another_thread() {
    // Waits for the job to get going, then stops it; the job is long enough to notice at the next row.
    let progress = Progress::new();
    let result = std::thread::scope(|scope| {
        let job = scope.spawn(|| computed::compute(Pattern::LabelledFaces, 4096, &progress));
        while progress.fraction() == 0.0 {
            std::thread::yield_now();
        }
        progress.cancel();
        job.join().unwrap()
    });
    assert!(matches!(result, Err(LoadProblem::Cancelled)));
    assert!(progress.fraction() < 1.0);
}

#[test]
fn scenes_travel_in_pngs() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shot.png");
    let scene = "{\"name\":\"R\u{e9}flexion \u{7403}\",\"x\":[1,2.5]}";
    let rgba: Vec<u8> = (0..2 * 3 * 4).map(|i| i * 9).collect();
    let bytes = png_out::encode_png(2, 3, &rgba, Some(scene)).unwrap();
    atomic::write_atomically(&path, false, &bytes).unwrap();
    assert_eq!(png_out::read_scene(&path).unwrap().as_deref(), Some(scene));
    // The pixels are untouched.
    let mut reader = png::Decoder::new(Cursor::new(&bytes)).read_info().unwrap();
    let mut back = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut back).unwrap();
    assert_eq!(back, rgba);
    // No scene is not an error; no PNG is.
    let plain = png_out::encode_png(2, 3, &rgba, None).unwrap();
    assert_eq!(png_out::scene_from(Cursor::new(&plain)).unwrap(), None);
    assert!(png_out::scene_from(Cursor::new(flat_hdr())).is_err());
    assert!(png_out::encode_png(2, 2, &rgba, None).is_err());
    assert!(png_out::encode_png(0, 0, &[], None).is_err());
    let long = "x".repeat(png_out::MOST_SCENE_BYTES + 1);
    assert!(png_out::encode_png(2, 3, &rgba, Some(&long)).is_err());
    let longest = &long[1..];
    let bytes = png_out::encode_png(2, 3, &rgba, Some(longest)).unwrap();
    assert_eq!(
        png_out::scene_from(Cursor::new(&bytes)).unwrap().as_deref(),
        Some(longest)
    );
}

#[test]
fn hostile_scene_chunks_are_refused() {
    let chunk = |declared: u32, body: &[u8], sum: Option<u32>| {
        let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
        bytes.extend(declared.to_be_bytes());
        let start = bytes.len();
        bytes.extend(b"iTXt");
        bytes.extend(body);
        let sum = sum.unwrap_or_else(|| crc32(&bytes[start..]));
        bytes.extend(sum.to_be_bytes());
        bytes.extend(b"\0\0\0\0IEND\xae\x42\x60\x82");
        bytes
    };
    let body = |rest: &[u8]| [b"sixfold-scene\0".as_slice(), rest].concat();
    let read = |bytes: Vec<u8>| png_out::scene_from(Cursor::new(bytes));
    let good = body(b"\0\0\0\0{}");
    let length = good.len() as u32;
    assert_eq!(
        read(chunk(length, &good, None)).unwrap().as_deref(),
        Some("{}")
    );
    let compressed = body(b"\x01\0\0\0x\x9c{}");
    let cases = [
        (
            "compressed",
            chunk(compressed.len() as u32, &compressed, None),
        ),
        ("limit", chunk(i32::MAX as u32, &good, None)),
        ("declares", chunk(u32::MAX, &good, None)),
        ("check sum", chunk(length, &good, Some(0))),
        ("UTF-8", chunk(length, &body(b"\0\0\0\0\xff\xff"), None)),
        ("no text", chunk(length, &body(b"\0\0abcd"), None)),
        ("too short", chunk(15, &body(b"\0"), None)),
        ("breaks off", chunk(length + 500, &good, None)),
    ];
    for (word, bytes) in cases {
        let reason = read(bytes).unwrap_err();
        assert!(reason.contains(word), "{word}: {reason}");
    }
    // Another program's text, also one that is shorter than our key.
    assert_eq!(read(chunk(3, b"a\0b", None)).unwrap(), None);
    assert_eq!(
        read(chunk(20, b"sixfold-scenery\0\0\0\0\0", None)).unwrap(),
        None
    );
}

#[test]
fn files_appear_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.bin");
    let names = || std::fs::read_dir(folder.path()).unwrap().count();
    atomic::write_atomically(&path, false, b"one").unwrap();
    let error = atomic::write_atomically(&path, false, b"two").unwrap_err();
    assert!(matches!(error, atomic::WriteError::Exists(_)), "{error}");
    assert_eq!(std::fs::read(&path).unwrap(), b"one");
    atomic::write_atomically(&path, true, b"three").unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"three");
    assert_eq!(names(), 1, "a temporary file is left");
    // A folder in the way: the rename fails and nothing is left.
    let blocked = folder.path().join("folder");
    std::fs::create_dir(&blocked).unwrap();
    std::fs::write(blocked.join("inside"), b"").unwrap();
    assert!(atomic::write_atomically(&blocked, true, b"four").is_err());
    assert_eq!(names(), 2);
    assert!(atomic::write_atomically(&folder.path().join("no/such/file"), true, b"").is_err());
    assert!(atomic::write_atomically("/".as_ref(), true, b"").is_err());
}

#[test]
fn lookups_wrap_at_the_date_line_and_the_poles() {
    let image = Image::new(4, 2, (0..8).map(|i| [i as f32; 3]).collect()).unwrap();
    assert!(Image::new(4, 2, vec![[0.0; 3]; 7]).is_err() && Image::new(0, 0, vec![]).is_err());
    assert_eq!(image.texel(3, 1), Some([7.0; 3]));
    assert_eq!((image.texel(4, 0), image.texel(0, 2)), (None, None));
    assert_eq!(image.nearest(0.99, 0.99)[0], 7.0);
    assert_eq!(
        (image.nearest(1.0, 1.0)[0], image.nearest(f64::NAN, -3.0)[0]),
        (7.0, 0.0)
    );
    // Texel centres are exact.
    assert_eq!(image.bilinear_latlong(0.375, 0.25)[0], 1.0);
    assert_eq!(image.bilinear_latlong(0.5, 0.25)[0], 1.5);
    // Between the last and the first column.
    assert_eq!(image.bilinear_latlong(0.0, 0.25)[0], 1.5);
    assert_eq!(image.bilinear_latlong(1.0, 0.25)[0], 1.5);
    // At the pole: the texel and the one half way round.
    assert_eq!(image.bilinear_latlong(0.125, 0.0)[0], 1.0);
    assert!(image.bilinear_latlong(f64::INFINITY, f64::NAN)[0].is_finite());
}
