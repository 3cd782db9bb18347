//! What is written reads back: bit for bit where the format can, else as the nearest that it can.

use sixfold::imaging::load::{EnvmapKind, Format, LoadProblem, read_raster_bytes};
use sixfold::imaging::sanitize::sanitize_raster;
use sixfold::imaging::save::{Content, SaveError, SaveOptions, encode, format_of_path, save};
use sixfold::imaging::{
    Channels, Container, Level, Progress, Raster, RasterFile, Samples, Stage, Stored, Transfer,
};

use super::fixtures::{flat_hdr, next, rle_hdr};

pub fn written(raster: &Raster, format: Format, options: &SaveOptions) -> Vec<u8> {
    encode(Content::Raster(raster), format, options, &Progress::new()).unwrap()
}

pub fn read(bytes: &[u8]) -> RasterFile {
    read_raster_bytes(bytes, "here.pic", &Progress::new()).unwrap()
}

fn there_and_back(raster: &Raster, format: Format, options: &SaveOptions) -> RasterFile {
    read(&written(raster, format, options))
}

/// Bits of every sample: NaN equals itself here, and 0 is not -0.
pub fn bits(raster: &Raster) -> Vec<u32> {
    match raster.samples() {
        Samples::U8(codes) => codes.iter().map(|c| u32::from(*c)).collect(),
        Samples::U16(codes) => codes.iter().map(|c| u32::from(*c)).collect(),
        Samples::F32(light) => light.iter().map(|c| c.to_bits()).collect(),
    }
}

fn random(count: usize, mut make: impl FnMut(u64) -> f32) -> Vec<f32> {
    let mut state = 0x9E37_79B9_7F4A_7C15;
    (0..count).map(|_| make(next(&mut state))).collect()
}

fn light(size: [u32; 2], channels: Channels, samples: Vec<f32>) -> Raster {
    Raster::new(size, channels, Transfer::Linear, Samples::F32(samples)).unwrap()
}

const BOTH: [Channels; 2] = [Channels::Rgb, Channels::Rgba];

#[test]
fn png_keeps_every_code() {
    let mut state = 7;
    for channels in BOTH {
        let count = 37 * 11 * channels.count();
        let bytes: Vec<u8> = (0..count).map(|_| next(&mut state) as u8).collect();
        let words: Vec<u16> = (0..count).map(|_| next(&mut state) as u16).collect();
        for samples in [Samples::U8(bytes), Samples::U16(words)] {
            let raster = Raster::new([37, 11], channels, Transfer::Srgb, samples).unwrap();
            let bytes = written(&raster, Format::Png, &SaveOptions::default());
            let back = read(&bytes);
            assert_eq!(back.raster, raster);
            assert_eq!(back.stored.kind(), raster.samples().kind());
            assert!(bytes.windows(4).any(|chunk| chunk == b"sRGB"));
        }
    }
}

#[test]
fn codes_of_8_bits_become_16_and_back_and_light_becomes_the_nearest_code() {
    let codes: Vec<u8> = (0..=255).flat_map(|c| [c; 3]).collect();
    let raster = Raster::new(
        [16, 16],
        Channels::Rgb,
        Transfer::Srgb,
        Samples::U8(codes.clone()),
    );
    let raster = raster.unwrap();
    let stored = |stored| SaveOptions {
        stored: Some(stored),
        ..SaveOptions::default()
    };
    let wide = there_and_back(&raster, Format::Png, &stored(Stored::U16)).raster;
    let expected: Vec<u16> = codes.iter().map(|c| u16::from(*c) * 257).collect();
    assert_eq!(wide.samples(), &Samples::U16(expected));
    let narrow = there_and_back(&wide, Format::Png, &stored(Stored::U8)).raster;
    assert_eq!(narrow, raster);
    // To light and back: EXR holds what sRGB's codes stand for, and each finds its code again.
    let exr = there_and_back(&raster, Format::Exr, &SaveOptions::default()).raster;
    assert_eq!(exr.transfer(), Transfer::Linear);
    let half_white = exr.light(15, 7)[0];
    assert!((half_white - 0.212_230_8).abs() < 1e-6, "{half_white}"); // 127 of 255
    let back = there_and_back(&exr, Format::Png, &stored(Stored::U8)).raster;
    assert_eq!(back, raster);
    // What no code stands for.
    let odd = light(
        [2, 1],
        Channels::Rgb,
        vec![f32::NAN, -3.0, 7.0, f32::INFINITY, 0.5, 1.0],
    );
    let back = there_and_back(&odd, Format::Png, &stored(Stored::U8)).raster;
    assert_eq!(back.samples(), &Samples::U8(vec![0, 0, 255, 255, 188, 255]));
}

#[test]
fn exr_keeps_every_bit_of_float_and_half() {
    for channels in BOTH {
        // Wide enough for lines that are packed alone, high enough for several blocks.
        for size in [[5, 37], [6000, 3]] {
            let count = (size[0] * size[1]) as usize * channels.count();
            let mut floats = random(count, |bits| f32::from_bits(bits as u32));
            floats[..6].copy_from_slice(&[
                f32::MAX,
                f32::MIN_POSITIVE,
                -0.0,
                f32::from_bits(1),
                f32::NEG_INFINITY,
                f32::NAN,
            ]);
            let floats = light(size, channels, floats);
            let back = there_and_back(&floats, Format::Exr, &SaveOptions::default());
            assert_eq!(bits(&back.raster), bits(&floats));
            assert_eq!(
                (back.stored, back.raster.channels()),
                (Stored::F32, channels)
            );

            let half = |bits: u64| half::f16::from_bits(bits as u16).to_f32();
            let halves = light(size, channels, random(count, half));
            let options = SaveOptions {
                stored: Some(Stored::Half),
                ..SaveOptions::default()
            };
            let back = there_and_back(&halves, Format::Exr, &options);
            let pairs = bits(&back.raster).into_iter().zip(bits(&halves));
            for (got, wanted) in pairs {
                let both_nan = f32::from_bits(got).is_nan() && f32::from_bits(wanted).is_nan();
                assert!(got == wanted || both_nan);
            }
            assert_eq!(back.stored, Stored::Half);
            // Control: floats do not fit into halves.
            let back = there_and_back(&floats, Format::Exr, &options);
            assert_ne!(bits(&back.raster), bits(&floats));
        }
    }
}

#[test]
fn halves_are_the_nearest_and_stay_finite() {
    let values = vec![65504.0, 65519.0, 1e30, -1e30, 1.0 / 3.0, f32::INFINITY];
    let options = SaveOptions {
        stored: Some(Stored::Half),
        ..SaveOptions::default()
    };
    let back = there_and_back(&light([2, 1], Channels::Rgb, values), Format::Exr, &options);
    let third = 1365.0 / 4096.0; // 11 bits
    let expected = vec![65504.0, 65504.0, 65504.0, -65504.0, third, f32::INFINITY];
    assert_eq!(back.raster.samples(), &Samples::F32(expected));
}

#[test]
fn exr_says_what_map_it_is() {
    let raster = light([2, 1], Channels::Rgb, vec![1.0; 6]);
    for envmap in [None, Some(EnvmapKind::Latlong), Some(EnvmapKind::Cube)] {
        let options = SaveOptions {
            envmap,
            ..SaveOptions::default()
        };
        let back = there_and_back(&raster, Format::Exr, &options);
        assert_eq!(back.envmap, envmap);
    }
}

/// Every RGBE texel that is normalised: its largest mantissa fills its 8 bits, or the exponent is the smallest.
fn rgbe_texels(count: usize) -> Vec<[u8; 4]> {
    let mut state = 99;
    (0..count)
        .map(|_| {
            let [mut r, g, b, e, run, ..] = next(&mut state).to_le_bytes();
            let e = e.max(1);
            if e > 1 && r.max(g).max(b) < 128 {
                r |= 128;
            }
            // Long runs of one component at times.
            [
                r,
                if run < 100 { 5 } else { g },
                if run < 200 { 200 } else { b },
                e,
            ]
        })
        .collect()
}

#[test]
fn hdr_comes_back_bit_for_bit() {
    for size in [[1, 3], [7, 5], [8, 4], [300, 9], [32767, 1], [32768, 1]] {
        let texels = rgbe_texels((size[0] * size[1]) as usize);
        let mut file = format!(
            "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n",
            size[1], size[0]
        )
        .into_bytes();
        file.extend(texels.iter().flatten());
        let first = read(&file);
        let again = written(&first.raster, Format::Hdr, &SaveOptions::default());
        let second = read(&again);
        // Narrow and very wide rows have no runs, and no texels below 2^-128, which would be marks there.
        let has_runs = (8..=32767).contains(&size[0]);
        let mut expected = bits(&first.raster);
        for (texel, color) in texels.iter().zip(expected.chunks_mut(3)) {
            if !has_runs && texel[..3].iter().all(|m| *m < 128) {
                color.fill(0);
            }
        }
        assert_eq!(bits(&second.raster), expected, "{size:?}");
        assert_eq!(second.stored, Stored::Rgbe);
        let thrice = written(&second.raster, Format::Hdr, &SaveOptions::default());
        assert_eq!(thrice, again);
    }
    for file in [flat_hdr(), rle_hdr()] {
        let first = read(&file).raster;
        let back = there_and_back(&first, Format::Hdr, &SaveOptions::default()).raster;
        assert_eq!(back, first);
    }
}

#[test]
fn hdr_packs_runs() {
    let flat = light([1000, 50], Channels::Rgb, vec![0.5; 150_000]);
    let length = written(&flat, Format::Hdr, &SaveOptions::default()).len();
    // Eight runs of at most 127 a component: (4 + 4 * 8 * 2) * 50 and the header.
    assert!((3400..3500).contains(&length), "{length}");
}

#[test]
fn hdr_rounds_to_nearest() {
    let samples = random(30_000, |bits| {
        let exponent = (bits >> 32) as i32 % 30;
        (bits as u32 as f32) * 2.0_f32.powi(exponent - 40)
    });
    let raster = light([100, 100], Channels::Rgb, samples.clone());
    let back = there_and_back(&raster, Format::Hdr, &SaveOptions::default()).raster;
    let Samples::F32(back) = back.samples() else {
        panic!("no light");
    };
    // In steps of the common exponent, of which the largest component has 128 to 255.
    let mut worst = 0.0_f32;
    for (was, is) in samples.chunks(3).zip(back.chunks(3)) {
        let largest = is.iter().copied().fold(0.0, f32::max);
        let step = 2.0_f32.powi(largest.log2().floor() as i32 - 7);
        for (was, is) in was.iter().zip(is) {
            worst = worst.max((was - is).abs() / step);
        }
    }
    // Rounding down, as many writers do, would come near 1.
    assert!(worst > 0.49 && worst <= 0.5, "{worst}");
    let odd = light(
        [2, 1],
        Channels::Rgb,
        vec![f32::NAN, -1.0, 0.0, f32::INFINITY, f32::MAX, 1.0],
    );
    let back = there_and_back(&odd, Format::Hdr, &SaveOptions::default()).raster;
    let most = 255.0 * 2.0_f32.powi(119);
    let expected = vec![0.0, 0.0, 0.0, most, most, 0.0];
    assert_eq!(back.samples(), &Samples::F32(expected));
}

#[test]
fn jpeg_keeps_colours_nearly() {
    let codes: Vec<u8> = (0..64 * 24)
        .flat_map(|i| {
            if i % 64 < 32 {
                [200, 60, 40, 9]
            } else {
                [30, 90, 180, 9]
            }
        })
        .collect();
    let raster = Raster::new(
        [64, 24],
        Channels::Rgba,
        Transfer::Srgb,
        Samples::U8(codes.clone()),
    )
    .unwrap();
    let at = |jpeg_quality| {
        let options = SaveOptions {
            jpeg_quality,
            ..SaveOptions::default()
        };
        written(&raster, Format::Jpeg, &options)
    };
    let back = read(&at(95)).raster;
    assert_eq!((back.channels(), back.size()), (Channels::Rgb, [64, 24]));
    let Samples::U8(back) = back.samples() else {
        panic!("no codes");
    };
    let worst = codes
        .chunks(4)
        .zip(back.chunks(3))
        .flat_map(|(was, is)| (0..3).map(|k| was[k].abs_diff(is[k])))
        .max();
    assert!(worst.is_some_and(|w| w <= 3), "{worst:?}");
    assert!(at(20).len() < at(95).len());
}

#[test]
fn pictures_are_refused_by_what_their_format_cannot_hold() {
    let raster = light([2, 1], Channels::Rgb, vec![1.0; 6]);
    let try_to = |content: Content, format, options: &SaveOptions| {
        encode(content, format, options, &Progress::new()).unwrap_err()
    };
    for (format, stored) in [
        (Format::Png, Stored::Half),
        (Format::Exr, Stored::U8),
        (Format::Hdr, Stored::F32),
        (Format::Ktx2, Stored::Rgbe),
    ] {
        let options = SaveOptions {
            stored: Some(stored),
            ..SaveOptions::default()
        };
        let error = try_to(Content::Raster(&raster), format, &options);
        assert!(matches!(error, SaveError::Unfit { .. }), "{error}");
        let text = error.to_string();
        assert!(
            text.contains("choose") && text.ends_with(": memory"),
            "{text}"
        );
    }
    let container = Container {
        levels: vec![Level {
            rasters: vec![raster],
        }],
        stored: Stored::Half,
        format: Format::Ktx2,
    };
    let error = try_to(
        Content::Container(&container),
        Format::Png,
        &SaveOptions::default(),
    );
    assert!(error.to_string().contains("faces and levels"), "{error}");
    assert_eq!(format_of_path("a/b.EXR".as_ref()).unwrap(), Format::Exr);
    for (name, format) in [
        ("x.hdr", Format::Hdr),
        ("x.png", Format::Png),
        ("x.jpeg", Format::Jpeg),
        ("x.ktx2", Format::Ktx2),
        ("x.dds", Format::Dds),
    ] {
        assert_eq!(format_of_path(name.as_ref()).unwrap(), format);
    }
    let error = format_of_path("a/b.gif".as_ref()).unwrap_err().to_string();
    assert!(error.ends_with(": a/b.gif"), "{error}");
}

#[test]
fn files_are_written_whole_or_not_at_all_and_stopped_between_rows() {
    let folder = tempfile::tempdir().unwrap();
    let raster = light([2, 64], Channels::Rgb, vec![0.25; 384]);
    let options = SaveOptions::default();
    let all = [
        Format::Hdr,
        Format::Exr,
        Format::Png,
        Format::Jpeg,
        Format::Ktx2,
        Format::Dds,
    ];
    for format in all {
        let path = folder.path().join(format.name());
        let content = Content::Raster(&raster);
        let progress = Progress::new();
        save(&path, false, content, format, &options, &progress).unwrap();
        assert_eq!(
            (progress.stage(), progress.fraction()),
            (Stage::Writing, 1.0),
            "{format:?}"
        );
        let bytes = std::fs::read(&path).unwrap();
        assert_eq!(
            bytes,
            encode(content, format, &options, &Progress::new()).unwrap()
        );
        assert!(save(&path, false, content, format, &options, &progress).is_err());
        progress.cancel();
        let error = save(&path, true, content, format, &options, &progress).unwrap_err();
        assert!(matches!(error, SaveError::Cancelled), "{format:?}: {error}");
        assert_eq!(std::fs::read(&path).unwrap(), bytes);
    }
    // No temporary file is left.
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), all.len());
    let nowhere = folder.path().join("missing/x.hdr");
    let content = Content::Raster(&raster);
    let error = save(
        &nowhere,
        false,
        content,
        Format::Hdr,
        &options,
        &Progress::new(),
    );
    assert!(error.unwrap_err().to_string().ends_with("x.hdr"));
}

/// Asks for the end once a part of the file has been written.
fn cancelled_midway(path: &std::path::Path, size: u32, format: Format) -> Result<(), SaveError> {
    let count = (size * size * 3) as usize;
    let mut state = 5;
    let noise = (0..count).map(|_| next(&mut state) as f32 / u64::MAX as f32);
    let raster = light([size; 2], Channels::Rgb, noise.collect());
    let progress = Progress::new();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while progress.stage() != Stage::Writing || progress.fraction() < 0.02 {
                std::thread::yield_now();
            }
            progress.cancel();
        });
        let options = SaveOptions::default();
        save(
            path,
            true,
            Content::Raster(&raster),
            format,
            &options,
            &progress,
        )
    })
}

#[test]
fn cancelled_while_it_writes_nothing_is_left() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("map");
    for format in [Format::Hdr, Format::Exr, Format::Ktx2, Format::Dds] {
        std::fs::write(&path, "as it was").unwrap();
        // On a fast machine a small file is whole before anyone can ask.
        let mut sizes = [256, 512, 1024, 2048].into_iter();
        let cancelled = sizes.find_map(|size| {
            let outcome = cancelled_midway(&path, size, format);
            if outcome.is_ok() {
                std::fs::write(&path, "as it was").unwrap();
            }
            outcome.err()
        });
        assert!(
            matches!(cancelled, Some(SaveError::Cancelled)),
            "{format:?}: {cancelled:?}"
        );
        assert_eq!(std::fs::read(&path).unwrap(), b"as it was", "{format:?}");
        assert_eq!(
            std::fs::read_dir(folder.path()).unwrap().count(),
            1,
            "{format:?}"
        );
    }
}

#[test]
fn only_what_no_filter_may_meet_is_replaced() {
    let samples = vec![
        f32::NAN,
        -7.0,
        1e30,
        f32::INFINITY,
        2.0,
        f32::NEG_INFINITY,
        0.0,
        -0.0,
        1.0,
    ];
    let mut raster = light([3, 1], Channels::Rgb, samples);
    let (bad, originals) = sanitize_raster(&mut raster);
    assert_eq!(originals.len(), 2);
    assert_eq!(
        originals.get(1),
        Some([f32::INFINITY, 2.0, f32::NEG_INFINITY])
    );
    assert!(originals.get(0).unwrap()[0].is_nan());
    assert_eq!(
        (bad.nan, bad.infinite, bad.negative, bad.too_bright),
        (1, 1, 0, 0)
    );
    let expected = vec![0.0, -7.0, 1e30, 65504.0, 2.0, 0.0, 0.0, -0.0, 1.0];
    assert_eq!(raster.samples(), &Samples::F32(expected));
    assert!(sanitize_raster(&mut raster).0.is_clean());
}

#[test]
fn pictures_of_any_shape_open_within_the_limits() {
    // A column of six faces, as OpenEXR has it.
    let column = light([2, 12], Channels::Rgba, vec![0.5; 96]);
    assert_eq!(
        there_and_back(&column, Format::Exr, &SaveOptions::default()).raster,
        column
    );
    let refused = |size: &str| {
        let bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").into_bytes();
        let error = read_raster_bytes(&bytes, "here.pic", &Progress::new()).unwrap_err();
        let is_too_much = matches!(error.problem, LoadProblem::TooManyBytes { .. });
        (is_too_much, error.to_string())
    };
    for size in [
        "-Y 49153 +X 1",
        "-Y 1 +X 49153",
        "-Y 49152 +X 49152",
        "-Y 30000 +X 6000",
    ] {
        let (is_too_much, text) = refused(size);
        assert!(is_too_much && text.contains("49152 a side"), "{text}");
    }
    // The largest declared size that is allowed is only cut off.
    assert!(!refused("-Y 29126 +X 6144").0);
}
