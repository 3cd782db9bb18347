//! Containers that are written here, read by other people's readers: each face and level where it belongs, every number as it was.

use dds::{Channels as DdsChannels, ColorFormat, Decoder, ImageViewMut, Precision};
use sixfold::imaging::load::Format;
use sixfold::imaging::{Container, Samples, Stored, Transfer};

use super::containers::{KINDS, container, write};
use super::fixtures::next;

/// Numbers without a pattern, of which the file's kind holds each exactly.
fn noise(stored: Stored, size: u32, faces: usize, transfer: Transfer) -> Container {
    let mut state = 3;
    container([size; 2], faces, stored, transfer, |_, _, _| {
        let bits = next(&mut state) >> 40;
        match stored {
            // 9 bits that share an exponent with their neighbours: the whole numbers up to 511 do.
            Stored::Rgb9e5 => (bits % 512) as f32,
            Stored::Half => half::f16::from_bits((bits % 0x7c00) as u16).to_f32(),
            Stored::F32 => bits as f32 / 1e3 - 1e3,
            _ => (bits % 256) as f32,
        }
    })
}

/// The numbers of a picture, opaque where it has no opacity.
fn rgba(samples: &Samples, stored: Stored) -> Vec<[f32; 4]> {
    let numbers: Vec<f32> = match samples {
        Samples::U8(codes) => codes.iter().map(|c| f32::from(*c)).collect(),
        Samples::U16(codes) => codes.iter().map(|c| f32::from(*c)).collect(),
        Samples::F32(light) => light.clone(),
    };
    match stored {
        Stored::Rgb9e5 => numbers.chunks(3).map(|c| [c[0], c[1], c[2], 1.0]).collect(),
        _ => numbers
            .chunks(4)
            .map(|c| [c[0], c[1], c[2], c[3]])
            .collect(),
    }
}

/// The pictures of a container, each with its size.
fn expected(container: &Container, face: usize) -> Vec<Vec<[f32; 4]>> {
    let levels = container.levels.iter();
    levels
        .map(|level| rgba(level.rasters[face].samples(), container.stored))
        .collect()
}

/// Each picture as the reader gives it, in the file's order.
fn read_dds(bytes: &[u8], stored: Stored) -> Vec<Vec<[f32; 4]>> {
    let mut decoder = Decoder::new(bytes).unwrap();
    assert!(decoder.layout().is_cube_map());
    let precision = if stored == Stored::U8 {
        Precision::U8
    } else {
        Precision::F32
    };
    let color = ColorFormat::new(DdsChannels::Rgba, precision);
    let mut pictures = Vec::new();
    while let Some(size) = decoder.surface_info().map(|surface| surface.size()) {
        let texels = (size.width * size.height) as usize;
        let mut data = vec![0; texels * usize::from(color.bytes_per_pixel())];
        decoder
            .read_surface(ImageViewMut::new(&mut data, size, color).unwrap())
            .unwrap();
        let numbers: Vec<f32> = match precision {
            Precision::U8 => data.iter().map(|c| f32::from(*c)).collect(),
            _ => data
                .chunks(4)
                .map(|c| f32::from_ne_bytes(c.try_into().unwrap()))
                .collect(),
        };
        pictures.push(
            numbers
                .chunks(4)
                .map(|c| [c[0], c[1], c[2], c[3]])
                .collect(),
        );
    }
    pictures
}

#[test]
fn dds_is_read_by_another_reader() {
    for (stored, transfer) in KINDS {
        for size in [1, 2, 8, 12] {
            let cube = noise(stored, size, 6, transfer);
            let bytes = write(&cube, Format::Dds, false);
            let read = read_dds(&bytes, stored);
            let faces: Vec<_> = (0..6).flat_map(|face| expected(&cube, face)).collect();
            assert_eq!(read, faces, "{stored:?} {transfer:?} {size}");
            // Control: one bit of the last texel changed is seen.
            let mut broken = bytes.clone();
            let last = broken.len() - 1;
            broken[last - 3] ^= 0x10;
            assert_ne!(read_dds(&broken, stored), faces);
        }
    }
}

/// A texel's numbers from its bytes, from the description of the formats.
fn texel(bytes: &[u8], stored: Stored) -> [f32; 4] {
    let part = |k: usize, n: usize| &bytes[k * n..(k + 1) * n];
    match stored {
        Stored::Half => {
            [0, 1, 2, 3].map(|k| half::f16::from_le_bytes(part(k, 2).try_into().unwrap()).to_f32())
        }
        Stored::F32 => [0, 1, 2, 3].map(|k| f32::from_le_bytes(part(k, 4).try_into().unwrap())),
        Stored::Rgb9e5 => {
            // Three numbers of 9 bits, then an exponent of 5 from -15; the point stands before the nine.
            let word = u32::from_le_bytes(bytes.try_into().unwrap());
            let scale = 2_f32.powi((word >> 27) as i32 - 15 - 9);
            let [r, g, b] = [0, 9, 18].map(|shift| (word >> shift & 511) as f32 * scale);
            [r, g, b, 1.0]
        }
        _ => [0, 1, 2, 3].map(|k| f32::from(bytes[k])),
    }
}

#[test]
fn ktx2_is_read_by_another_reader() {
    for (stored, transfer) in KINDS {
        let (format, texel_bytes) = match (stored, transfer) {
            (Stored::U8, Transfer::Srgb) => (ktx2::Format::R8G8B8A8_SRGB, 4),
            (Stored::U8, _) => (ktx2::Format::R8G8B8A8_UNORM, 4),
            (Stored::Half, _) => (ktx2::Format::R16G16B16A16_SFLOAT, 8),
            (Stored::F32, _) => (ktx2::Format::R32G32B32A32_SFLOAT, 16),
            _ => (ktx2::Format::E5B9G9R9_UFLOAT_PACK32, 4),
        };
        for zstd in [false, true] {
            let cube = noise(stored, 12, 6, transfer);
            let bytes = write(&cube, Format::Ktx2, zstd);
            let reader = ktx2::Reader::new(&bytes).unwrap();
            let header = reader.header();
            assert_eq!(header.format, Some(format));
            assert_eq!((header.pixel_width, header.pixel_height), (12, 12));
            assert_eq!((header.face_count, header.level_count), (6, 4));
            let scheme = zstd.then_some(ktx2::SupercompressionScheme::Zstandard);
            assert_eq!(header.supercompression_scheme, scheme);
            let orientation = reader
                .key_value_data()
                .find(|(key, _)| *key == "KTXorientation");
            assert_eq!(orientation.unwrap().1, b"rd\0");
            for (k, level) in reader.levels().enumerate() {
                let mut unpacked = Vec::new();
                if zstd {
                    let mut decoder = ruzstd::decoding::StreamingDecoder::new(level.data).unwrap();
                    std::io::Read::read_to_end(&mut decoder, &mut unpacked).unwrap();
                } else {
                    unpacked.extend(level.data);
                }
                assert_eq!(unpacked.len() as u64, level.uncompressed_byte_length);
                let read: Vec<_> = unpacked
                    .chunks(texel_bytes)
                    .map(|t| texel(t, stored))
                    .collect();
                let faces: Vec<_> = (0..6)
                    .flat_map(|face| expected(&cube, face)[k].clone())
                    .collect();
                assert_eq!(read, faces, "{stored:?} {zstd} level {k}");
                // Control: the faces the other way round are another map.
                let backwards: Vec<_> = (0..6)
                    .rev()
                    .flat_map(|face| expected(&cube, face)[k].clone())
                    .collect();
                assert_ne!(read, backwards);
            }
        }
    }
}
