//! Times of conversions on this machine, in nanoseconds a texel of the target: `cargo run --release --no-default-features
//! --example measure_resample`.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::time::Instant;

use sixfold::imaging::resample::{Conversion, Filter, Plan};
use sixfold::imaging::{Channels, EnvironmentMap, Progress, Raster, Samples, Transfer};
use sixfold::mapping::{Layout, MappingId};

/// A latlong or cube map of noise.
fn source(mapping: MappingId, size: [u32; 2], bytes: bool) -> EnvironmentMap {
    let count = match mapping.info().chart_count() {
        6 => 6,
        _ => 1,
    };
    let len = (size[0] * size[1] * 3) as usize;
    let noise = |i: usize| (i as u32).wrapping_mul(2_654_435_761) >> 24;
    let rasters = (0..count).map(|_| {
        let samples = if bytes {
            Samples::U8((0..len).map(|i| noise(i) as u8).collect())
        } else {
            Samples::F32((0..len).map(|i| noise(i) as f32 / 255.0).collect())
        };
        let transfer = if bytes {
            Transfer::Srgb
        } else {
            Transfer::Linear
        };
        Raster::new(size, Channels::Rgb, transfer, samples).unwrap()
    });
    let layout = if count == 6 {
        Layout::Faces
    } else {
        Layout::Single
    };
    EnvironmentMap::from_layout(mapping, layout, rasters.collect()).unwrap()
}

fn main() {
    let askew = [[0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]];
    for bytes in [true, false] {
        for (from, from_size, to, to_size) in [
            (
                MappingId::Latlong,
                [4096, 2048],
                MappingId::Cube,
                [1024, 1024],
            ),
            (
                MappingId::Latlong,
                [4096, 2048],
                MappingId::Ccm,
                [1024, 1024],
            ),
            (
                MappingId::Cube,
                [1024, 1024],
                MappingId::Latlong,
                [4096, 2048],
            ),
            (
                MappingId::Latlong,
                [4096, 2048],
                MappingId::Cube,
                [128, 128],
            ),
        ] {
            let source = source(from, from_size, bytes);
            for filter in Filter::ALL {
                for (turned, rotation) in [(false, Conversion::UNTURNED), (true, askew)] {
                    let conversion = Conversion {
                        filter: Some(filter),
                        rotation,
                        threads: 1,
                        ..Conversion::new(to, to_size, source.shape())
                    };
                    let start = Instant::now();
                    let plan = Plan::new(source.shape(), &conversion).unwrap();
                    let planned = start.elapsed();
                    let mut target = plan.black().unwrap();
                    let mut best = f64::MAX;
                    for _ in 0..2 {
                        let start = Instant::now();
                        plan.run_into(&source, &mut target, &Progress::new())
                            .unwrap();
                        best = best.min(start.elapsed().as_secs_f64());
                    }
                    let charts = f64::from(to.info().chart_count());
                    let texels = charts * f64::from(to_size[0]) * f64::from(to_size[1]);
                    println!(
                        "{} {from} {} -> {to} {} {:8} turned {turned:5}: {:7.1} ns a texel, {:6.1} ms, plan {:5.1} ms",
                        if bytes { "u8 " } else { "f32" },
                        from_size[0],
                        to_size[0],
                        filter.id(),
                        best * 1e9 / texels,
                        best * 1e3,
                        planned.as_secs_f64() * 1e3,
                    );
                }
            }
        }
    }
}
