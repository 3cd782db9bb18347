//! What is alike everywhere stays so, to the bit; what is its own source stays too.

use crate::fixtures::*;
use sixfold::imaging::resample::{Conversion, Filter, FilteredIn};
use sixfold::imaging::{
    Channels, EnvironmentMap, MapShape, Raster, SampleKind, Samples, Siting, Transfer,
};
use sixfold::mapping::{Domain, MappingId};

/// A map whose pixels are all the same, opaque or not.
fn constant(shape: &MapShape, pixel: [f64; 4]) -> EnvironmentMap {
    let layout = shape.mapping.info().layout;
    let count = shape.channels.count();
    let rasters = MapShape::raster_sizes(shape.mapping, layout, shape.size)
        .into_iter()
        .map(|size| {
            let all = (size[0] * size[1]) as usize * count;
            let values = (0..all).map(|i| pixel[i % count]);
            let samples = match shape.samples {
                SampleKind::U8 => Samples::U8(values.map(|v| (v * 255.0) as u8).collect()),
                SampleKind::U16 => Samples::U16(values.map(|v| (v * 65535.0) as u16).collect()),
                SampleKind::F32 => Samples::F32(values.map(|v| v as f32).collect()),
            };
            Raster::new(size, shape.channels, shape.transfer, samples).unwrap()
        });
    EnvironmentMap::new(shape.clone(), rasters.collect()).unwrap()
}

/// The stored pixel of a texel, as numbers that tell every code and float apart.
fn pixel(map: &EnvironmentMap, chart: u32, texel: [u32; 2]) -> Vec<u32> {
    let shape = map.shape();
    let placement = shape.charts[chart as usize].unwrap();
    let [x, y] = placement.turn.cell_from_chart(texel, shape.size);
    let raster = &map.rasters()[placement.raster];
    let at = ((placement.origin[1] + y) * raster.width() + placement.origin[0] + x) as usize;
    let count = shape.channels.count();
    (at * count..(at + 1) * count)
        .map(|at| match raster.samples() {
            Samples::U8(samples) => samples[at].into(),
            Samples::U16(samples) => samples[at].into(),
            Samples::F32(samples) => samples[at].to_bits(),
        })
        .collect()
}

#[test]
fn a_constant_stays_constant_to_the_bit() {
    let kinds = [SampleKind::U8, SampleKind::U16, SampleKind::F32];
    let (mut seen, mut combination) = (0_u64, 0_usize);
    for &from in MappingId::ALL {
        for &to in MappingId::ALL {
            for filter in Filter::ALL {
                // Every pair with every filter; the other choices take turns.
                combination += 1;
                let pick = |n: usize, salt: usize| (combination * 7 + salt * combination / 5) % n;
                let siting = [Siting::Centre, Siting::Edge][pick(2, 7)];
                // The corners of a disc's square are outside: of 2 x 2 samples on the border none is on the disc.
                let size = match ([1, 2, 3, 4, 13][pick(5, 1)], siting, from.info().domain) {
                    (2, Siting::Edge, Domain::Disc) => 5,
                    (size, ..) => size,
                };
                let channels = [Channels::Rgb, Channels::Rgba][pick(2, 3)];
                let source_shape = MapShape {
                    samples: kinds[pick(3, 2)],
                    channels,
                    // Floats do not come back over the curve to the bit.
                    transfer: match kinds[pick(3, 2)] {
                        SampleKind::F32 => Transfer::Linear,
                        _ => [Transfer::Srgb, Transfer::Linear][pick(2, 5)],
                    },
                    siting,
                    ..shape(from, [size, size])
                };
                let source = constant(&source_shape, [0.3, 0.7, 0.123, 0.4]);
                let conversion = Conversion {
                    rotation: if pick(2, 11) == 0 {
                        askew()
                    } else {
                        Conversion::UNTURNED
                    },
                    filtered_in: [FilteredIn::Light, FilteredIn::Codes][pick(2, 13)],
                    supersample: 1 + pick(2, 17) as u32,
                    threads: 1,
                    ..conversion(&source_shape, to, [5, 7], filter)
                };
                let (target, _) = run(&source, &conversion);
                let first = pixel(&source, 0, [size / 2, size / 2]);
                for (chart, texel, _) in texels(target.shape()) {
                    assert_eq!(
                        pixel(&target, chart, texel),
                        first,
                        "{from} to {to}, {filter:?}, {source_shape:?}: chart {chart}, {texel:?}"
                    );
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 50_000, "{seen}");
}

#[test]
fn one_texel_is_enough_to_break_a_constant() {
    let source_shape = shape(MappingId::Cube, [4, 4]);
    let mut source = constant(&source_shape, [0.5; 4]);
    if let Samples::F32(samples) = source.rasters_mut()[0].samples_mut() {
        // The first texel of +z in the cross.
        samples[(4 * 16 + 4) * 3] = 2.0;
    }
    for filter in Filter::ALL {
        let (target, _) = run(
            &source,
            &conversion(&source_shape, MappingId::Latlong, [32, 16], filter),
        );
        let differ = texels(target.shape())
            .filter(|(chart, texel, _)| pixel(&target, *chart, *texel) != pixel(&source, 0, [3, 3]))
            .count();
        assert!(differ > 1, "{filter:?}: {differ}");
    }
}

#[test]
fn what_is_its_own_source_stays_to_the_bit() {
    for &mapping in MappingId::ALL {
        for siting in [Siting::Centre, Siting::Edge] {
            for filter in [
                Filter::Nearest,
                Filter::Bilinear,
                Filter::Bicubic,
                Filter::Lanczos,
                Filter::Area,
            ] {
                for samples in [SampleKind::U8, SampleKind::U16, SampleKind::F32] {
                    let source_shape = MapShape {
                        siting,
                        ..shape(mapping, [9, 6])
                    };
                    let floats = map_of(&source_shape, |[x, y, z]| {
                        [x, y * y, z + x * y].map(|c| (0.5 + 0.5 * c) as f32)
                    });
                    let kind = Conversion {
                        samples,
                        transfer: Transfer::Srgb,
                        siting,
                        ..conversion(&source_shape, mapping, [9, 6], Filter::Nearest)
                    };
                    let (source, _) = run(&floats, &kind);
                    let same = Conversion {
                        siting,
                        ..conversion(source.shape(), mapping, [9, 6], filter)
                    };
                    let (target, _) = run(&source, &same);
                    if samples == SampleKind::F32 {
                        // There and back over the curve rounds.
                        for (chart, texel, _) in texels(target.shape()) {
                            let (a, b) = (source.light(chart, texel), target.light(chart, texel));
                            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6));
                        }
                    } else {
                        assert_eq!(
                            source, target,
                            "{mapping} {siting:?} {filter:?} {samples:?}"
                        );
                    }
                    let raw = Conversion {
                        filtered_in: FilteredIn::Codes,
                        ..same
                    };
                    assert_eq!(source, run(&source, &raw).0, "{mapping} {filter:?} codes");
                }
            }
        }
    }
}
