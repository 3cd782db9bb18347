//! How near the light comes to what is exact.

use std::f64::consts::PI;

use crate::fixtures::*;
use sixfold::imaging::resample::{Conversion, Filter, FilteredIn, Isa};
use sixfold::imaging::{Channels, EnvironmentMap, Raster, Samples, Transfer};
use sixfold::mapping::{Layout, MappingId};
use sixfold::math::Vec3;

/// Peak signal (1) over the root of the mean square of the colours' errors, in decibels.
fn psnr_db(map: &EnvironmentMap, conversion: &Conversion, exact: impl Fn(Dir) -> [f32; 3]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (chart, texel, dir) in texels(map.shape()) {
        let exact = exact(rotated(conversion.rotation, dir));
        let light = map.light(chart, texel);
        for (light, exact) in light.iter().zip(exact) {
            sum += f64::from(light - exact).powi(2);
            count += 1.0;
        }
    }
    10.0 * (count / f64::max(sum, 1e-30)).log10()
}

/// Waves of `texels` texels of a latlong map, in three directions.
fn waves(width: u32, texels: f64) -> impl Fn(Dir) -> [f32; 3] {
    let k = f64::from(width) / texels;
    move |d| std::array::from_fn(|i| (0.5 + 0.4 * (k * d[i] + i as f64).sin()) as f32)
}

/// The wave test of the field's comparison: waves of 27 texels of a latlong map, seen on cube faces of a quarter of its width.
#[test]
fn better_filters_show() {
    let mut budgets = Budgets::default();
    let source_shape = shape(MappingId::Latlong, [1024, 512]);
    let light = waves(1024, 27.0);
    let source = map_of(&source_shape, &light);
    let of = |filter, exact: &dyn Fn(Dir) -> [f32; 3]| {
        let mut conversion = conversion(&source_shape, MappingId::Cube, [256, 256], filter);
        conversion.rotation = askew();
        let (target, _) = run(&source, &conversion);
        psnr_db(&target, &conversion, exact)
    };
    for (filter, least) in [
        (Filter::Nearest, 30.0),
        (Filter::Bilinear, 60.0),
        (Filter::Bicubic, 90.0),
        (Filter::Lanczos, 125.0),
        (Filter::Area, 60.0),
    ] {
        budgets.at_least_db(
            &format!("waves of 27 texels, {}", filter.id()),
            of(filter, &light),
            least,
        );
    }
    // Waves that are a twentieth of a texel off.
    let late = |d: Dir| light([d[0], d[1], d[2] + 0.05 * 2.0 * PI / 1024.0]);
    let observed = of(Filter::Bicubic, &late);
    budgets.must_break_db("a twentieth of a texel off", observed, 60.0);
    budgets.check();
}

/// A latlong map of noise, 8 bits.
fn noise(size: [u32; 2], transfer: Transfer) -> EnvironmentMap {
    let mut random = sixfold::math::inputs::Random::new(5);
    let count = (size[0] * size[1] * 3) as usize;
    let samples = (0..count).map(|_| (random.bits() >> 56) as u8).collect();
    let raster = Raster::new(size, Channels::Rgb, transfer, Samples::U8(samples)).unwrap();
    EnvironmentMap::from_layout(MappingId::Latlong, Layout::Single, vec![raster]).unwrap()
}

/// The code of sRGB of a light, in double precision.
fn code_of_light(light: f64) -> f64 {
    255.0
        * if light <= 0.003_130_8 {
            light * 12.92
        } else {
            1.055 * light.powf(1.0 / 2.4) - 0.055
        }
}

/// Errors of an 8-bit conversion in steps against the exact value, where the four texels are the map's own: the largest, and
/// the mean with its sign.
fn steps(source: &EnvironmentMap, conversion: &Conversion, of: impl Fn(f64) -> f64) -> [f64; 2] {
    let (target, _) = run(source, conversion);
    let light = conversion.filtered_in == FilteredIn::Light;
    let [width, height] = source.shape().size;
    let (mut worst, mut sum, mut count) = (0.0_f64, 0.0, 0.0);
    for (chart, texel, dir) in texels(target.shape()) {
        let dir = rotated(conversion.rotation, dir);
        let point = MappingId::Latlong
            .forward(Vec3::<f64>::from_f64(dir))
            .unwrap();
        let place = [
            point.u * f64::from(width) - 0.5,
            point.v * f64::from(height) - 0.5,
        ];
        let [x, y] = place.map(f64::floor);
        if x < 0.0 || y < 0.0 || x > f64::from(width) - 2.0 || y > f64::from(height) - 2.0 {
            continue;
        }
        let [right, below] = [place[0] - x, place[1] - y];
        for channel in 0..3 {
            let code = |dx: u32, dy: u32| {
                let Samples::U8(samples) = source.rasters()[0].samples() else {
                    panic!("8 bits")
                };
                let at = (y as u32 + dy) * width + x as u32 + dx;
                let code = f64::from(samples[at as usize * 3 + channel]) / 255.0;
                match (light, code <= 0.04045) {
                    (false, _) => code,
                    (_, true) => code / 12.92,
                    _ => ((code + 0.055) / 1.055).powf(2.4),
                }
            };
            let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
            let upper = mix(code(0, 0), code(1, 0), right);
            let exact = of(mix(upper, mix(code(0, 1), code(1, 1), right), below));
            let stored = stored_u8(&target, chart, texel)[channel];
            let error = f64::from(stored) - exact;
            worst = worst.max(error.abs());
            sum += error;
            count += 1.0;
        }
    }
    [worst, (sum / count).abs()]
}

fn stored_u8(map: &EnvironmentMap, chart: u32, texel: [u32; 2]) -> [u8; 3] {
    let shape = map.shape();
    let placement = shape.charts[chart as usize].unwrap();
    let [x, y] = placement.turn.cell_from_chart(texel, shape.size);
    let raster = &map.rasters()[placement.raster];
    let at = ((placement.origin[1] + y) * raster.width() + placement.origin[0] + x) as usize * 3;
    match raster.samples() {
        Samples::U8(samples) => [samples[at], samples[at + 1], samples[at + 2]],
        _ => panic!("8 bits"),
    }
}

#[test]
fn bytes_are_rounded_and_not_biased() {
    let mut budgets = Budgets::default();
    // Neighbours of noise differ by up to 255 steps, so a place that is off by a thousandth of a texel shows as a quarter step.
    let source = noise([4096, 2048], Transfer::Srgb);
    let mut conversion = conversion(
        source.shape(),
        MappingId::Cube,
        [150, 150],
        Filter::Bilinear,
    );
    conversion.rotation = askew();
    for (filtered_in, what) in [(FilteredIn::Codes, "codes"), (FilteredIn::Light, "light")] {
        conversion.filtered_in = filtered_in;
        let of = |value: f64| match filtered_in {
            FilteredIn::Light => code_of_light(value),
            FilteredIn::Codes => 255.0 * value,
        };
        let [worst, mean] = steps(&source, &conversion, of);
        budgets.hold(
            &format!("8 bits mixed in {what}, largest error in steps"),
            worst,
            0.58,
        );
        budgets.within(
            &format!("8 bits mixed in {what}, mean error in steps"),
            mean,
            2e-3,
        );
        let [worst, mean] = steps(&source, &conversion, |value| of(value) + 0.1);
        budgets.must_break("a tenth of a step too dark, largest", worst, 0.58);
        budgets.must_break("a tenth of a step too dark, mean", mean, 2e-3);
    }
    conversion.dither = true;
    conversion.filtered_in = FilteredIn::Codes;
    let [worst, mean] = steps(&source, &conversion, |value| 255.0 * value);
    budgets.hold("dithered, largest error in steps", worst, 1.09);
    budgets.within("dithered, mean error in steps", mean, 4e-3);
    budgets.check();
}

/// The vector instructions change nothing: products and sums are not contracted, so every set gives the same bits; and a lookup of
/// many texels at once is one of single texels, but for a thousandth of a texel.
#[test]
fn every_instruction_set_gives_the_same_samples() {
    let latlong = noise([514, 257], Transfer::Linear);
    let cube = {
        let mut conversion = conversion(
            latlong.shape(),
            MappingId::Cube,
            [130, 130],
            Filter::Bilinear,
        );
        conversion.samples = sixfold::imaging::SampleKind::F32;
        run(&latlong, &conversion).0
    };
    for source in [&latlong, &cube] {
        for mapping in [
            MappingId::Latlong,
            MappingId::Cube,
            MappingId::Ccm,
            MappingId::Eac,
        ] {
            let mut wanted = conversion(source.shape(), mapping, [150, 150], Filter::Bilinear);
            let with = |isa, wanted: &Conversion| {
                let mut wanted = wanted.clone();
                wanted.isa = Some(isa);
                run(source, &wanted).0
            };
            let baseline = with(Isa::Baseline, &wanted);
            for isa in [Isa::Avx2, Isa::Avx512] {
                assert_eq!(with(isa, &wanted), baseline, "{mapping} by {}", isa.id());
            }
            wanted.rotation =
                sixfold::math::Rotation::from_degrees([0.1, 0.0, 0.0]).source_from_world();
            assert_ne!(with(Isa::Baseline, &wanted), baseline, "{mapping}");
            if source.shape().mapping != MappingId::Latlong || mapping == MappingId::Latlong {
                continue;
            }
            // So little that nothing moves, but the poles are tipped: the exact way.
            wanted.rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 1e-13], [0.0, -1e-13, 1.0]];
            let exact = with(Isa::Baseline, &wanted);
            for (chart, texel, _) in texels(exact.shape()) {
                let (exact, fast) = (exact.light(chart, texel), baseline.light(chart, texel));
                for (exact, fast) in exact.into_iter().zip(fast) {
                    // One step where a value lies half-way between two.
                    assert!(
                        (exact - fast).abs() < 1.5 / 255.0,
                        "{mapping} {chart} {texel:?}"
                    );
                }
            }
        }
    }
}
