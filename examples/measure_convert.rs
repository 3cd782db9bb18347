//! What conversions cost, and how wrong they are: time as a ratio to copying (source + output)/2 bytes in the same run, beside the
//! largest error against the same bilinear lookup in f64.
//!
//! `cargo run --release --no-default-features --example measure_convert [NAME ...]`; names choose rows, all without.

#![expect(clippy::print_stdout, reason = "its output is the table")]

use std::time::Instant;

use sixfold::imaging::resample::{Conversion, Filter, FilteredIn, Isa, Plan};
use sixfold::imaging::{
    Channels, EnvironmentMap, MapShape, Progress, Raster, Samples, ShapeError, Transfer,
};
use sixfold::mapping::{Layout, MappingId};

/// Times that each row is run; the median is printed, and the smallest.
const REPEATS: usize = 9;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &str| names.is_empty() || names.iter().any(|n| name.contains(n.as_str()));
    println!(
        "{:<44} {:>7} {:>8} {:>8} {:>8} {:>8} {:>9}",
        "conversion", "threads", "ms", "least ms", "x copy", "ns/texel", "error"
    );
    for float in [false, true] {
        let kind = if float { "f32" } else { "u8" };
        let latlong = noise(MappingId::Latlong, [4096, 2048], Layout::Single, float)?;
        let cube = noise(MappingId::Cube, [1024, 1024], Layout::Faces, float)?;
        for isa in [Isa::Avx512, Isa::Avx2, Isa::Baseline] {
            for threads in [1, 2] {
                let with = |change: &dyn Fn(&mut Conversion)| {
                    let mut conversion =
                        Conversion::new(MappingId::Cube, [1024, 1024], latlong.shape());
                    conversion.layout = Layout::Faces;
                    conversion.filter = Some(Filter::Bilinear);
                    conversion.filtered_in = FilteredIn::Codes;
                    conversion.threads = threads;
                    conversion.isa = Some(isa);
                    change(&mut conversion);
                    conversion
                };
                let rows: Vec<(&str, Conversion, &EnvironmentMap)> = vec![
                    ("latlong to cube", with(&|_| {}), &latlong),
                    (
                        "latlong to ccm",
                        with(&|c| c.mapping = MappingId::Ccm),
                        &latlong,
                    ),
                    (
                        "latlong to eac",
                        with(&|c| c.mapping = MappingId::Eac),
                        &latlong,
                    ),
                    (
                        "latlong to cube, one face",
                        with(&|c| c.charts = 1 << 4),
                        &latlong,
                    ),
                    (
                        "latlong to cube, a pole's face",
                        with(&|c| c.charts = 1 << 2),
                        &latlong,
                    ),
                    (
                        "latlong to cube, rotated",
                        with(&|c| c.rotation = turned()),
                        &latlong,
                    ),
                    (
                        "latlong to cube, in light",
                        with(&|c| c.filtered_in = FilteredIn::Light),
                        &latlong,
                    ),
                    (
                        "cube to latlong",
                        with(&|c| {
                            (c.mapping, c.size) = (MappingId::Latlong, [4096, 2048]);
                            c.layout = Layout::Single;
                        }),
                        &cube,
                    ),
                ];
                for (name, conversion, source) in rows {
                    let name = format!("{name}, {kind}, {}", isa.id());
                    if wanted(&name) {
                        measure(&name, source, &conversion)?;
                    }
                }
            }
        }
    }
    for height in [512, 1024, 2048, 4096, 8192_u32] {
        let name = format!("scaling: latlong {} x {height}, u8", 2 * height);
        if !wanted(&name) {
            continue;
        }
        let source = noise(
            MappingId::Latlong,
            [2 * height, height],
            Layout::Single,
            false,
        )?;
        let mut conversion =
            Conversion::new(MappingId::Cube, [height / 2, height / 2], source.shape());
        conversion.layout = Layout::Faces;
        conversion.filter = Some(Filter::Bilinear);
        conversion.filtered_in = FilteredIn::Codes;
        conversion.threads = 1;
        measure(&name, &source, &conversion)?;
    }
    Ok(())
}

fn turned() -> [[f64; 3]; 3] {
    let ((s, c), (t, d)) = (0.7_f64.sin_cos(), 0.4_f64.sin_cos());
    [[c, 0.0, s], [t * s, d, -t * c], [-d * s, t, d * c]]
}

fn noise(
    mapping: MappingId,
    size: [u32; 2],
    layout: Layout,
    float: bool,
) -> Result<EnvironmentMap, ShapeError> {
    let mut bits = 1_u32;
    let mut next = || {
        bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (bits >> 24) as u8
    };
    let rasters = MapShape::raster_sizes(mapping, layout, size)
        .into_iter()
        .filter_map(|size| {
            let count = size[0] as usize * size[1] as usize * 3;
            let samples = if float {
                Samples::F32((0..count).map(|_| f32::from(next()) / 255.0).collect())
            } else {
                Samples::U8((0..count).map(|_| next()).collect())
            };
            let transfer = if float {
                Transfer::Linear
            } else {
                Transfer::Srgb
            };
            Raster::new(size, Channels::Rgb, transfer, samples)
        })
        .collect();
    EnvironmentMap::from_layout(mapping, layout, rasters)
}

fn measure(
    name: &str,
    source: &EnvironmentMap,
    conversion: &Conversion,
) -> Result<(), Box<dyn std::error::Error>> {
    let progress = Progress::new();
    let plan = Plan::new(source.shape(), conversion)?;
    let mut target = plan.black()?;
    let bytes = ((source.bytes() + target.bytes()) / 2) as usize;
    let (from, mut to) = (vec![1_u8; bytes], vec![2_u8; bytes]);
    let (mut times, mut copies) = (Vec::new(), Vec::new());
    for _ in 0..REPEATS {
        let start = Instant::now();
        copy(&from, &mut to, conversion.threads);
        std::hint::black_box(&mut to);
        copies.push(start.elapsed().as_secs_f64());
        // The plan counts too: it holds the tables of rows and columns.
        let start = Instant::now();
        let plan = Plan::new(source.shape(), conversion)?;
        plan.run_into(source, &mut target, &progress)?;
        times.push(start.elapsed().as_secs_f64());
    }
    for list in [&mut times, &mut copies] {
        list.sort_by(f64::total_cmp);
    }
    let (median, copy) = (times[REPEATS / 2], copies[REPEATS / 2]);
    let texels = conversion.size.map(f64::from).iter().product::<f64>()
        * target.shape().charts.iter().flatten().count() as f64;
    println!(
        "{name:<44} {:>7} {:>8.2} {:>8.2} {:>8.1} {:>8.2} {:>9.2e}",
        conversion.threads,
        median * 1e3,
        times[0] * 1e3,
        median / copy,
        median * 1e9 / texels,
        error(source, &target, conversion),
    );
    Ok(())
}

/// Copies with as many threads as the conversion has.
fn copy(from: &[u8], to: &mut [u8], threads: usize) {
    let part = from.len().div_ceil(threads);
    std::thread::scope(|scope| {
        for (from, to) in from.chunks(part).zip(to.chunks_mut(part)) {
            scope.spawn(|| to.copy_from_slice(from));
        }
    });
}

/// The largest error, in steps of 255 for bytes and in parts of the largest light for floats, at every 97th texel inside charts.
fn error(source: &EnvironmentMap, target: &EnvironmentMap, conversion: &Conversion) -> f64 {
    let general = |value: [f32; 4]| value.map(f64::from);
    let mut worst = 0.0_f64;
    let shape = source.shape();
    let is_bytes = matches!(source.rasters()[0].samples(), Samples::U8(_));
    let in_codes = is_bytes && conversion.filtered_in == FilteredIn::Codes;
    let code = |c: f64| {
        if c <= 0.003_130_8 {
            12.92 * c
        } else {
            1.055 * c.powf(1.0 / 2.4) - 0.055
        }
    };
    let [width, height] = target.shape().size;
    let wanted = target
        .shape()
        .charts
        .iter()
        .enumerate()
        .filter(|(_, p)| p.is_some());
    for (chart, _) in wanted {
        for index in (0..width * height).step_by(97) {
            let texel = [index % width, index / width];
            let coordinate = |k: usize| (f64::from(texel[k]) + 0.5) / f64::from([width, height][k]);
            let point =
                sixfold::mapping::ChartPoint::new(chart as u32, coordinate(0), coordinate(1));
            let Some(dir) = conversion.mapping.inverse(point) else {
                continue;
            };
            let [a, b, c] = conversion.rotation;
            let row = |r: [f64; 3]| r[0] * dir.x + r[1] * dir.y + r[2] * dir.z;
            let dir = sixfold::math::Vec3::new(row(a), row(b), row(c));
            let Some(found) = shape.mapping.forward(dir) else {
                continue;
            };
            let place = [
                found.u * f64::from(shape.size[0]) - 0.5,
                found.v * f64::from(shape.size[1]) - 0.5,
            ];
            let whole = place.map(f64::floor);
            let inside =
                (0..2).all(|k| whole[k] >= 0.0 && whole[k] + 1.0 < f64::from(shape.size[k]));
            if !inside {
                continue;
            }
            let rest = [place[0] - whole[0], place[1] - whole[1]];
            let tap = |x: u32, y: u32| {
                let texel = [whole[0] as u32 + x, whole[1] as u32 + y];
                general(source.light(found.chart, texel))
                    .map(|c| if in_codes { code(c) } else { c })
            };
            let taps = [tap(0, 0), tap(1, 0), tap(0, 1), tap(1, 1)];
            let got = general(target.light(chart as u32, texel));
            for k in 0..3 {
                let above = taps[0][k] + (taps[1][k] - taps[0][k]) * rest[0];
                let below = taps[2][k] + (taps[3][k] - taps[2][k]) * rest[0];
                let exact = above + (below - above) * rest[1];
                let error = match (is_bytes, in_codes) {
                    (false, _) => got[k] - exact,
                    (true, true) => 255.0 * (code(got[k]) - exact),
                    (true, false) => 255.0 * (code(got[k]) - code(exact)),
                };
                worst = worst.max(error.abs());
            }
        }
    }
    worst
}
