//! Bombs, broken headers, truncated and mutated files.

use sixfold::imaging::load::{Format, LoadProblem, declared_size, read_raster_bytes};
use sixfold::imaging::{Progress, Stored};

use super::containers::{marked_cube, open as open_container, write};
use super::fixtures::{crc32, hdr, next, open, seeds};

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
fn impossible_counts_in_dwa_blocks_are_refused() {
    let (_, whole) = &seeds()[3];
    assert!(open(whole).is_ok());
    // The offset table's one entry stands right before the block and says where that is.
    let block = (8..whole.len() - 8)
        .find(|&at| whole[at - 8..at] == (at as u64).to_le_bytes())
        .expect("one block");
    for index in [1, 6, 7, 8, 9] {
        let mut bytes = whole.clone();
        let count = block + 8 + 8 * index;
        bytes[count..count + 8].copy_from_slice(&(1_u64 << 43).to_le_bytes());
        let error = open(&bytes).unwrap_err();
        assert!(
            matches!(error.problem, LoadProblem::TooMuch { .. }),
            "{index}: {error}"
        );
    }
}

#[test]
fn other_shapes_are_named() {
    let pixels = [[1.0; 3]; 64];
    let error = open(&hdr("-Y 8 +X 8", &pixels)).unwrap_err().to_string();
    assert!(
        error.contains("8 x 8") && error.contains("`sixfold convert`"),
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

/// Rounds for each kind of file; `SIXFOLD_MUTATIONS` sets those of a longer run. The seeds of a format share them.
fn rounds(seeds_of_format: u64) -> u64 {
    let rounds = std::env::var("SIXFOLD_MUTATIONS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(2000);
    rounds / seeds_of_format
}

fn damage(bytes: &mut Vec<u8>, state: &mut u64) {
    for _ in 0..=next(state) % 4 {
        let at = (next(state) % bytes.len() as u64) as usize;
        match next(state) % 4 {
            0 => bytes[at] = next(state) as u8,
            1 => bytes[at] ^= 1 << (next(state) % 8),
            2 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][(next(state) % 5) as usize],
            _ => drop(bytes.remove(at)),
        }
    }
}

#[test]
fn mutated_files_never_panic() {
    let seeds = seeds();
    for (format, whole) in &seeds {
        let alike = seeds.iter().filter(|(other, _)| other == format).count();
        let (mut state, mut opened, mut refused) = (0x9E37_79B9_7F4A_7C15, 0, 0);
        for round in 0..rounds(alike as u64) {
            let mut bytes = whole.clone();
            damage(&mut bytes, &mut state);
            if *format == Format::Png && round % 2 == 0 {
                repair_png(&mut bytes);
            }
            // Of any shape, with all its bits; a latlong of the same file is then what is shown.
            let raster = read_raster_bytes(&bytes, "here.pic", &Progress::new());
            match (open(&bytes), raster) {
                (Ok(loaded), Ok(file)) => {
                    opened += 1;
                    assert_eq!(file.raster.width(), loaded.image.width());
                    let mut values = loaded.image.pixels().iter().flatten();
                    assert!(values.all(|c| (0.0..=65504.0).contains(c)));
                }
                (Err(error), raster) => {
                    refused += 1;
                    assert!(error.to_string().ends_with(": here.pic"));
                    if let Err(error) = raster {
                        assert!(error.to_string().ends_with(": here.pic"));
                    }
                }
                (Ok(_), Err(error)) => panic!("{format:?}: only the latlong opens: {error}"),
            }
        }
        // Both happen, or the mutations test nothing.
        assert!(
            opened > 0 && refused > 0,
            "{format:?}: {opened} opened, {refused} refused"
        );
    }
}

#[test]
fn mutated_containers_never_panic() {
    for format in [Format::Ktx2, Format::Dds] {
        let seeds = container_seeds(format);
        for whole in &seeds {
            assert!(
                open_container(whole).is_ok(),
                "{format:?}: the whole does not open"
            );
            let (mut state, mut opened, mut refused) = (0x9E37_79B9_7F4A_7C15, 0, 0);
            for round in 0..rounds(seeds.len() as u64) {
                let mut bytes = whole.clone();
                damage(&mut bytes, &mut state);
                // Every other round aims at what stands before the texels.
                if round % 2 == 0 {
                    let at = (next(&mut state) % 260.min(bytes.len() as u64)) as usize;
                    bytes[at] = next(&mut state) as u8;
                }
                match open_container(&bytes) {
                    Ok(container) => {
                        opened += 1;
                        assert!(
                            container
                                .levels
                                .iter()
                                .all(|l| matches!(l.rasters.len(), 1 | 6))
                        );
                    }
                    Err(error) => {
                        refused += 1;
                        let text = error.to_string();
                        assert!(
                            text.ends_with(": here.pic") && !text.contains('\n'),
                            "{text}"
                        );
                    }
                }
            }
            assert!(
                opened > 0 && refused > 0,
                "{format:?}: {opened} opened, {refused} refused"
            );
        }
    }
}

fn container_seeds(format: Format) -> Vec<Vec<u8>> {
    let kinds = [Stored::Half, Stored::F32, Stored::Rgb9e5];
    let cubes = kinds.map(|stored| marked_cube(4, stored));
    let packings: &[bool] = match format {
        Format::Ktx2 => &[false, true],
        _ => &[false],
    };
    let each = |zstd: &bool| {
        cubes
            .iter()
            .map(move |cube| write(cube, format, *zstd))
            .collect()
    };
    packings
        .iter()
        .flat_map(|zstd| -> Vec<Vec<u8>> { each(zstd) })
        .collect()
}

#[test]
fn containers_that_lie_are_refused() {
    let refused = |bytes: &[u8], word: &str| {
        let text = open_container(bytes).unwrap_err().to_string();
        assert!(
            text.contains(word) && text.ends_with(": here.pic"),
            "{word}: {text}"
        );
    };
    let cube = marked_cube(4, Stored::Half);
    let plain = write(&cube, Format::Ktx2, false);
    let packed = write(&cube, Format::Ktx2, true);
    let dds = write(&cube, Format::Dds, false);
    let with = |bytes: &[u8], at: usize, value: &[u8]| {
        let mut bytes = bytes.to_vec();
        bytes[at..at + value.len()].copy_from_slice(value);
        bytes
    };
    let big = (1_u32 << 31).to_le_bytes();
    let huge = (u64::MAX - 3).to_le_bytes();
    refused(&with(&plain, 40, &big), "declares 2147483648 levels");
    refused(&with(&plain, 36, &big), "declares 2147483648 faces");
    refused(&with(&plain, 20, &[big, big].concat()), "49152 a side");
    let side = 32768_u32.to_le_bytes();
    refused(&with(&plain, 20, &[side, side].concat()), "unpacked");
    refused(&with(&plain, 24, &8_u32.to_le_bytes()), "not square");
    refused(
        &with(&plain, 48, &[0xf0; 8]),
        "descriptor lies beyond its end",
    );
    refused(
        &with(&plain, 56, &[0xf0; 8]),
        "key-value data lies beyond its end",
    );
    refused(&with(&plain, 80, &huge), "level 0 lies beyond its end");
    refused(&with(&plain, 88, &huge), "level 0 declares");
    refused(&with(&packed, 96, &huge), "level 0 declares");
    refused(&with(&plain, 80, &[0; 8]), "overlap");
    // The descriptor stands after three levels' places.
    refused(&with(&plain, 152, &[0xff; 4]), "descriptor");
    refused(&with(&plain, 152 + 12, &[163]), "descriptor");
    refused(&plain[..60], "breaks off");
    refused(&plain[..100], "beyond its end");
    refused(&dds[..100], "breaks off");
    refused(&dds[..dds.len() - 1], "bytes of texels instead of");
    refused(&with(&dds, 28, &big), "declares 2147483648 levels");
    refused(&with(&dds, 12, &[big, big].concat()), "49152 a side");
    refused(&with(&dds, 4, &big), "2147483648");

    // A bomb: Zstandard's own run of one byte, 128 KiB from four, again and again, behind a size of 4 x 4. 2.6 GB would come
    // out; no more is unpacked than the declared size, and a byte.
    let mut alone = cube.clone();
    alone.levels.truncate(1);
    let alone = write(&alone, Format::Ktx2, true);
    let start = usize::try_from(u64::from_le_bytes(alone[80..88].try_into().unwrap())).unwrap();
    let mut bomb = alone[..start].to_vec();
    bomb.extend([0x28, 0xb5, 0x2f, 0xfd, 0x00, 0x58]); // magic, no sizes, a window of 2 MiB
    for left in (0..20_000).rev() {
        let header: u32 = u32::from(left == 0) | 1 << 1 | (1 << 17) << 3;
        bomb.extend(&header.to_le_bytes()[..3]);
        bomb.push(7);
    }
    let length = (bomb.len() - start) as u64;
    let bomb = with(&bomb, 88, &length.to_le_bytes());
    refused(&bomb, "level 0 unpacks to more than it declares");
    // Control: cut short, it is damaged in another way.
    let cut = with(&bomb, 88, &6_u64.to_le_bytes());
    refused(&cut, "damaged");
}
