//! KTX2 and DDS: each face and level where it belongs, every bit kept, what does not open refused by name.

use sixfold::imaging::load::{Format, LoadError, Opened, declared_size, open_bytes};
use sixfold::imaging::save::{Content, SaveOptions, encode};
use sixfold::imaging::{Channels, Container, Level, Progress, Raster, Samples, Stored, Transfer};

use super::fixtures::next;

pub fn open(bytes: &[u8]) -> Result<Container, LoadError> {
    match open_bytes(bytes, "here.pic", &Progress::new())? {
        Opened::Container(container) => Ok(container),
        Opened::Raster(_) => panic!("a picture instead of a container"),
    }
}

pub fn write(container: &Container, format: Format, zstd: bool) -> Vec<u8> {
    let options = SaveOptions {
        zstd,
        ..SaveOptions::default()
    };
    encode(
        Content::Container(container),
        format,
        &options,
        &Progress::new(),
    )
    .unwrap()
}

/// A container whose samples come from `sample(face, level, index)`.
pub fn container(
    size: [u32; 2],
    faces: usize,
    stored: Stored,
    transfer: Transfer,
    mut sample: impl FnMut(usize, usize, usize) -> f32,
) -> Container {
    let levels = size[0].max(size[1]).ilog2() as usize + 1;
    let channels = if stored == Stored::Rgb9e5 {
        Channels::Rgb
    } else {
        Channels::Rgba
    };
    let mut raster = |face: usize, level: usize| {
        let size = size.map(|side| (side >> level).max(1));
        let count = (size[0] * size[1]) as usize * channels.count();
        let values = (0..count).map(|i| sample(face, level, i));
        let samples = match stored {
            Stored::U8 => Samples::U8(values.map(|c| c as u8).collect()),
            _ => Samples::F32(values.collect()),
        };
        Raster::new(size, channels, transfer, samples).unwrap()
    };
    let levels = (0..levels)
        .map(|level| Level {
            rasters: (0..faces).map(|face| raster(face, level)).collect(),
        })
        .collect();
    Container {
        levels,
        stored,
        format: Format::Ktx2,
    }
}

pub const KINDS: [(Stored, Transfer); 5] = [
    (Stored::U8, Transfer::Srgb),
    (Stored::U8, Transfer::Linear),
    (Stored::Half, Transfer::Linear),
    (Stored::F32, Transfer::Linear),
    (Stored::Rgb9e5, Transfer::Linear),
];

const WAYS: [(Format, bool); 3] = [
    (Format::Ktx2, false),
    (Format::Ktx2, true),
    (Format::Dds, false),
];

/// Face and level as one small number, exact in every kind.
fn mark(face: usize, level: usize, _: usize) -> f32 {
    (face * 16 + level + 1) as f32
}

/// A cube map of which every picture is another constant.
pub fn marked_cube(size: u32, stored: Stored) -> Container {
    container([size; 2], 6, stored, Transfer::Linear, mark)
}

#[test]
fn faces_and_levels_come_back_where_they_were() {
    for (stored, transfer) in KINDS {
        for (size, faces) in [([16, 16], 6), ([1, 1], 6), ([12, 5], 1)] {
            let cube = container(size, faces, stored, transfer, mark);
            for (format, zstd) in WAYS {
                let bytes = write(&cube, format, zstd);
                assert_eq!(Format::of(&bytes), Some(format));
                let declared = declared_size(&bytes).unwrap();
                assert_eq!(declared, (size[0].into(), size[1].into()));
                let back = open(&bytes).unwrap();
                assert_eq!(back.is_cube(), faces == 6);
                assert_eq!((back.stored, back.format), (stored, format));
                assert_eq!(back.levels, cube.levels, "{format:?} {stored:?} {zstd}");
                // Control: another order is another map.
                let mut exchanged = back.levels.clone();
                if faces == 6 {
                    exchanged[0].rasters.swap(0, 1);
                    assert_ne!(exchanged, cube.levels);
                }
            }
        }
    }
}

/// Where a texel lies in the file is written down here a second time, from the formats' descriptions.
#[test]
fn pictures_lie_in_the_file_in_the_order_of_the_format() {
    let cube = container([4, 4], 6, Stored::F32, Transfer::Linear, mark);
    let first_at =
        |bytes: &[u8], at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());

    // DDS: after 4 + 124 + 20 bytes, face by face, 16 + 4 + 1 texels of 16 bytes each.
    let dds = write(&cube, Format::Dds, false);
    assert_eq!(dds.len(), 148 + 6 * 21 * 16);
    for face in 0..6 {
        for (level, before) in [(0, 0), (1, 16), (2, 20)] {
            let at = 148 + (face * 21 + before) * 16;
            assert_eq!(first_at(&dds, at), mark(face, level, 0));
        }
    }
    // KTX2: the index after 80 bytes; the smallest level first; in it face by face.
    let ktx2 = write(&cube, Format::Ktx2, false);
    let place = |level: usize| {
        let at = 80 + 24 * level;
        let number = |k: usize| u64::from_le_bytes(ktx2[at + 8 * k..][..8].try_into().unwrap());
        [number(0), number(1), number(2)]
    };
    let mut end = ktx2.len() as u64;
    for (level, texels) in [(0, 16), (1, 4), (2, 1)] {
        let [offset, length, unpacked] = place(level);
        assert_eq!((length, unpacked), (6 * texels * 16, 6 * texels * 16));
        assert_eq!(offset + length, end, "levels follow each other");
        assert_eq!(offset % 16, 0, "of texels of 16 bytes");
        for face in 0..6_u64 {
            let at = offset + face * texels * 16;
            assert_eq!(first_at(&ktx2, at as usize), mark(face as usize, level, 0));
        }
        end = offset;
    }
    assert!(ktx2.windows(18).any(|w| w == b"KTXorientation\0rd\0"));
}

#[test]
fn every_bit_comes_back() {
    let mut state = 5;
    for (stored, transfer) in KINDS {
        let cube = container([8, 8], 6, stored, transfer, |_, _, _| {
            let bits = next(&mut state);
            match stored {
                Stored::U8 => f32::from(bits as u8),
                Stored::Half => f32::from(half::f16::from_bits(bits as u16 & 0x7bff)),
                Stored::F32 => f32::from_bits(bits as u32 & 0xff7f_ffff),
                // Nine bits and an exponent that all three have: the largest mantissas share it.
                _ => (256 + (bits & 255)) as f32,
            }
        });
        for (format, zstd) in WAYS {
            let back = open(&write(&cube, format, zstd)).unwrap();
            assert_eq!(back.levels, cube.levels, "{format:?} {stored:?}");
        }
    }
}

#[test]
fn a_packed_file_is_smaller_and_a_constant_one_much() {
    let cube = container([64, 64], 6, Stored::Half, Transfer::Linear, |_, _, _| 1.0);
    let plain = write(&cube, Format::Ktx2, false).len();
    let packed = write(&cube, Format::Ktx2, true).len();
    assert!(packed * 20 < plain, "{packed} of {plain}");
}

#[test]
fn shared_exponents_are_the_nearest() {
    // The specification's own way, in its own words: EXT_texture_shared_exponent, section 3.8.x.
    let reference = |color: [f64; 3]| -> [f64; 3] {
        let largest = 511.0 / 512.0 * 2.0_f64.powi(16);
        let clamped = color.map(|c| c.max(0.0).min(largest));
        let most = clamped.iter().copied().fold(0.0, f64::max);
        let floor_log2 = if most > 0.0 {
            most.log2().floor()
        } else {
            f64::NEG_INFINITY
        };
        let preliminary = (-16.0_f64).max(floor_log2) + 1.0 + 15.0;
        let unit = |e: f64| 2.0_f64.powf(e - 15.0 - 9.0);
        let exponent = if (most / unit(preliminary) + 0.5).floor() > 511.0 {
            preliminary + 1.0
        } else {
            preliminary
        };
        clamped.map(|c| (c / unit(exponent) + 0.5).floor() * unit(exponent))
    };
    let mut state = 11;
    let mut colors: Vec<[f32; 3]> = (0..4096 - 8)
        .map(|_| {
            let exponent = (next(&mut state) % 40) as i32 - 22;
            [0; 3].map(|_| (next(&mut state) as u32 as f32) * 2.0_f32.powi(exponent - 32))
        })
        .collect();
    colors.extend([
        [0.0; 3],
        [-1.0, f32::NAN, 0.0],
        [f32::INFINITY, 1.0, 0.0],
        [65408.0, 65407.0, 1e9],
        [511.5, 1.0, 0.0], // rounds up to the next exponent
        [2.0_f32.powi(-24), 2.0_f32.powi(-25), 2.0_f32.powi(-26)],
        [1.0, 0.5, 0.25],
        [f32::MIN_POSITIVE, f32::from_bits(1), 0.0],
    ]);
    let samples = Samples::F32(colors.as_flattened().to_vec());
    let raster = Raster::new([64, 64], Channels::Rgb, Transfer::Linear, samples).unwrap();
    let cube = Container {
        levels: vec![Level {
            rasters: vec![raster],
        }],
        stored: Stored::Rgb9e5,
        format: Format::Dds,
    };
    let back = open(&write(&cube, Format::Dds, false)).unwrap();
    let Samples::F32(back) = back.levels[0].rasters[0].samples() else {
        panic!("no light");
    };
    let mut changed = 0;
    for (color, back) in colors.iter().zip(back.chunks(3)) {
        let expected = reference(color.map(f64::from)).map(|c| c as f32);
        assert_eq!(back, expected, "{color:?}");
        changed += usize::from(back != color);
    }
    assert!(changed > 4000, "nothing was rounded");
}

#[test]
fn rasters_of_other_kinds_become_what_is_stored() {
    // One picture without opacity, in codes, as half: light and opacity 1.
    let samples = Samples::U8(vec![0, 127, 255]);
    let raster = Raster::new([1, 1], Channels::Rgb, Transfer::Srgb, samples).unwrap();
    let options = SaveOptions {
        stored: Some(Stored::F32),
        ..SaveOptions::default()
    };
    let content = Content::Raster(&raster);
    let bytes = encode(content, Format::Ktx2, &options, &Progress::new()).unwrap();
    let back = open(&bytes).unwrap();
    let light = back.levels[0].rasters[0].light(0, 0);
    assert_eq!(light, raster.light(0, 0));
    assert_eq!((light[0], light[2], light[3]), (0.0, 1.0, 1.0));
    assert!((light[1] - 0.212_230_8).abs() < 1e-6);
    // By itself it stays what it is.
    let options = SaveOptions::default();
    let bytes = encode(content, Format::Dds, &options, &Progress::new()).unwrap();
    let back = &open(&bytes).unwrap().levels[0].rasters[0];
    assert_eq!(back.samples(), &Samples::U8(vec![0, 127, 255, 255]));
    assert_eq!(back.transfer(), Transfer::Srgb);
}

#[test]
fn what_makes_no_map_is_not_written() {
    let good = container([4, 4], 6, Stored::Half, Transfer::Linear, mark);
    let refuse = |change: &dyn Fn(&mut Container)| {
        let mut bad = good.clone();
        change(&mut bad);
        for format in [Format::Ktx2, Format::Dds] {
            let content = Content::Container(&bad);
            let options = SaveOptions::default();
            let error = encode(content, format, &options, &Progress::new()).unwrap_err();
            assert!(error.to_string().contains("cannot hold"), "{error}");
        }
    };
    refuse(&|c| c.levels.clear());
    refuse(&|c| drop(c.levels[0].rasters.pop()));
    refuse(&|c| c.levels.iter_mut().for_each(|l| l.rasters.truncate(2)));
    refuse(&|c| drop(c.levels.remove(1)));
    refuse(&|c| {
        let last = c.levels[2].clone();
        c.levels.push(last);
    });
    refuse(&|c| {
        let one = Samples::U8(vec![0; 4]);
        c.levels[2].rasters[3] = Raster::new([1, 1], Channels::Rgba, Transfer::Srgb, one).unwrap();
    });
    refuse(&|c| *c = container([4, 2], 6, Stored::Half, Transfer::Linear, mark));
    refuse(&|c| c.stored = Stored::U16);
    // Fewer levels than there may be are right.
    let mut fewer = good.clone();
    fewer.levels.truncate(1);
    assert_eq!(open(&write(&fewer, Format::Ktx2, false)).unwrap(), fewer);
}

/// A DDS header without the second one.
fn older_dds(pixel_format: [u32; 7], caps2: u32, size: u32, levels: u32) -> Vec<u8> {
    let mut numbers = vec![124, 0x1007, size, size, 0, 0, levels];
    numbers.extend([0; 11]);
    numbers.push(32);
    numbers.extend(pixel_format);
    numbers.extend([0x1000, caps2, 0, 0, 0]);
    let mut bytes = b"DDS ".to_vec();
    bytes.extend(numbers.iter().flat_map(|n: &u32| n.to_le_bytes()));
    bytes
}

const ALL_FACES: u32 = 0xfe00;
const ARGB: [u32; 7] = [0x41, 0, 32, 0xff_0000, 0xff00, 0xff, 0xff00_0000];

#[test]
fn older_dds_files_open() {
    let fill = |mut bytes: Vec<u8>, count: usize| {
        bytes.extend((0..count).map(|i| (i % 251) as u8));
        bytes
    };
    let blue_first = fill(older_dds(ARGB, ALL_FACES, 2, 2), 6 * 5 * 4);
    let cube = open(&blue_first).unwrap();
    assert!(cube.is_cube());
    let last = &cube.levels[1].rasters[5];
    // The last texel of all: bytes 116, 117, 118, 119 are blue, green, red, opacity.
    assert_eq!(last.samples(), &Samples::U8(vec![118, 117, 116, 119]));
    assert_eq!(last.transfer(), Transfer::Srgb);

    let without_alpha = [0x40, 0, 32, 0xff_0000, 0xff00, 0xff, 0];
    let picture = open(&fill(older_dds(without_alpha, 0, 1, 1), 4)).unwrap();
    assert_eq!(
        picture.levels[0].rasters[0].samples(),
        &Samples::U8(vec![2, 1, 0])
    );
    let red_first = [0x41, 0, 32, 0xff, 0xff00, 0xff_0000, 0xff00_0000];
    let picture = open(&fill(older_dds(red_first, 0, 1, 1), 4)).unwrap();
    assert_eq!(
        picture.levels[0].rasters[0].samples(),
        &Samples::U8(vec![0, 1, 2, 3])
    );
    for (number, bytes, stored) in [(113, 8, Stored::Half), (116, 16, Stored::F32)] {
        let format = [4, number, 0, 0, 0, 0, 0];
        let cube = open(&fill(older_dds(format, ALL_FACES, 1, 1), 6 * bytes)).unwrap();
        assert_eq!((cube.stored, cube.levels[0].rasters.len()), (stored, 6));
    }
}

#[test]
fn what_does_not_open_is_named() {
    let refused = |bytes: &[u8], words: &[&str]| {
        let text = open(bytes).unwrap_err().to_string();
        for word in words {
            assert!(text.contains(word), "{word}: {text}");
        }
        assert!(
            text.ends_with(": here.pic") && !text.contains('\n'),
            "{text}"
        );
    };
    let dxt5 = [4, u32::from_le_bytes(*b"DXT5"), 0, 0, 0, 0, 0];
    refused(
        &older_dds(dxt5, 0, 4, 1),
        &["DDS", "`DXT5`", "store them as"],
    );
    refused(
        &older_dds([4, 36, 0, 0, 0, 0, 0], 0, 4, 1),
        &["D3DFORMAT 36"],
    );
    let rgb24 = [0x40, 0, 24, 0xff_0000, 0xff00, 0xff, 0];
    refused(&older_dds(rgb24, 0, 4, 1), &["24 bits with masks"]);
    refused(&older_dds(ARGB, 0x600, 4, 1), &["1 of six faces"]);
    refused(&older_dds(ARGB, 0x20_0000, 4, 1), &["volume"]);

    let cube = container([4, 4], 6, Stored::Half, Transfer::Linear, mark);
    let changed = |format: Format, at: usize, number: u32| {
        let mut bytes = write(&cube, format, false);
        bytes[at..at + 4].copy_from_slice(&number.to_le_bytes());
        bytes
    };
    let dds = |at, number| changed(Format::Dds, at, number);
    refused(&dds(128, 95), &["BC6H (DXGI format 95)"]);
    refused(&dds(128, 61), &["unknown here (DXGI format 61)"]);
    refused(&dds(132, 4), &["two dimensions"]);
    refused(&dds(140, 3), &["array of 3"]);
    let ktx2 = |at, number| changed(Format::Ktx2, at, number);
    refused(
        &ktx2(12, 143),
        &["BC6H (vkFormat 143)", "R16G16B16A16_SFLOAT"],
    );
    refused(&ktx2(12, 0), &["Basis Universal"]);
    refused(&ktx2(44, 1), &["BasisLZ (1)"]);
    refused(&ktx2(44, 3), &["ZLIB (3)"]);
    refused(&ktx2(32, 5), &["array of 5"]);
    refused(&ktx2(28, 4), &["three dimensions"]);
    let upward: Vec<u8> = {
        let mut bytes = write(&cube, Format::Ktx2, false);
        let key = b"KTXorientation\0r";
        let at = bytes.windows(key.len()).position(|w| w == key).unwrap();
        bytes[at + key.len()] = b'u';
        bytes
    };
    refused(&upward, &["KTXorientation is `ru`", "`rd`"]);
}
