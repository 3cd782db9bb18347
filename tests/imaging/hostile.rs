//! Bombs, broken headers, truncated and mutated files.

use sixfold::imaging::load::{Format, LoadProblem, declared_size};

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
