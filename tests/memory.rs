//! A conversion needs the source, the result and little more: what lies along seams, not along faces.
//!
//! The kernel says how much memory the process has held at most; a test of its own program, so that no other test shares it.
#![cfg(target_os = "linux")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests say what they expect by unwrapping, and what they saw by printing"
)]

use sixfold::imaging::resample::{Conversion, Filter, Plan};
use sixfold::imaging::{Channels, EnvironmentMap, Progress, Raster, Samples, Transfer};
use sixfold::mapping::{Layout, MappingId};

/// KiB beyond source and result that are promised.
const MOST_KIB: i64 = 4096;

fn kib(key: &str) -> i64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with(key)).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

/// Held at most while `work` runs, above what was held before, less the bytes that it returns.
fn extra_kib(work: impl FnOnce() -> u64) -> i64 {
    let before = kib("VmRSS");
    // Forgets the peak so far.
    std::fs::write("/proc/self/clear_refs", "5").unwrap();
    let bytes = work();
    kib("VmHWM") - before - (bytes / 1024) as i64
}

fn map(mapping: MappingId, layout: Layout, sizes: &[[u32; 2]]) -> EnvironmentMap {
    let raster = |size: &[u32; 2]| {
        let samples = vec![100; (size[0] * size[1] * 3) as usize];
        Raster::new(*size, Channels::Rgb, Transfer::Srgb, Samples::U8(samples)).unwrap()
    };
    EnvironmentMap::from_layout(mapping, layout, sizes.iter().map(raster).collect()).unwrap()
}

#[test]
fn conversions_need_little_beside_source_and_result() {
    let latlong = map(MappingId::Latlong, Layout::Single, &[[4096, 2048]]);
    let cube = map(MappingId::Cube, Layout::Faces, &[[2048, 2048]; 6]);
    let run = |source: &EnvironmentMap, to, size, layout, filter, kept: &mut Vec<_>| {
        let mut conversion = Conversion::new(to, size, source.shape());
        (conversion.layout, conversion.filter) = (layout, Some(filter));
        let plan = Plan::new(source.shape(), &conversion).unwrap();
        let (target, _) = plan.run(source, &Progress::new()).unwrap();
        let bytes = target.bytes();
        // Kept, lest what is freed serves the next one.
        kept.push(target);
        bytes
    };
    let (to_cube, to_latlong) = (Layout::Faces, Layout::Single);
    let mut kept = Vec::new();
    for filter in [Filter::Bilinear, Filter::Lanczos] {
        for (what, source, to, size, layout) in [
            (
                "to six faces of 512",
                &latlong,
                MappingId::Cube,
                [512; 2],
                to_cube,
            ),
            (
                "from six faces of 2048",
                &cube,
                MappingId::Latlong,
                [1024, 512],
                to_latlong,
            ),
        ] {
            let extra = extra_kib(|| run(source, to, size, layout, filter, &mut kept));
            println!("{what}, {}: {extra} KiB, at most {MOST_KIB}", filter.id());
            assert!(extra < MOST_KIB, "{what}, {}: {extra} KiB", filter.id());
        }
    }
    // One more copy of a face of 2048, and the promise would be broken.
    let extra = extra_kib(|| {
        let copy = cube.rasters()[0].clone();
        std::hint::black_box(copy.bytes());
        0
    });
    assert!(
        extra > MOST_KIB,
        "a copy of a face was not noticed: {extra} KiB"
    );
}
