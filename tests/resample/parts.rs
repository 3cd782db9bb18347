//! Minified, unfolded, cut to charts, stopped, sent there and back.

use crate::fixtures::*;
use sixfold::imaging::compare::{compare, loss};
use sixfold::imaging::resample::{Conversion, Filter, Plan, ResampleError, levels};
use sixfold::imaging::{EnvironmentMap, Progress};
use sixfold::mapping::{Layout, MappingId};

fn smooth([x, y, z]: Dir) -> [f32; 3] {
    [x * y + 0.3 * z, y - x * z, z * z * x].map(|c| (0.5 + 0.25 * c) as f32)
}

/// Black and white noise on latlong against the exact means over blocks of texels, each by its solid angle.
#[test]
fn minified_noise_is_its_mean_over_area() {
    let mut budgets = Budgets::default();
    for (factor, budget) in [(3_u32, 0.012), (8, 0.002)] {
        let source_shape = shape(MappingId::Latlong, [24 * factor, 12 * factor]);
        // Noise of black and white: no block is like another.
        let source = {
            let cell = std::cell::RefCell::new(sixfold::math::inputs::Random::new(9));
            map_of(&source_shape, |_| black_or_white(cell.borrow_mut().bits()))
        };
        let error = |filter| {
            let small = conversion(&source_shape, MappingId::Latlong, [24, 12], filter);
            let (target, _) = run(&source, &small);
            let (mut sum, mut count) = (0.0, 0.0);
            for (chart, [x, y], _) in texels(target.shape()) {
                let (mut mean, mut weight) = (0.0, 0.0);
                for j in 0..factor {
                    let row = y * factor + j;
                    let w = (std::f64::consts::PI * (f64::from(row) + 0.5)
                        / f64::from(12 * factor))
                    .sin();
                    for i in 0..factor {
                        mean += w * f64::from(source.light(0, [x * factor + i, row])[0]);
                        weight += w;
                    }
                }
                sum += (f64::from(target.light(chart, [x, y])[0]) - mean / weight).powi(2);
                count += 1.0;
            }
            f64::sqrt(sum / count)
        };
        let (area, bilinear) = (error(Filter::Area), error(Filter::Bilinear));
        budgets.hold(&format!("1/{factor}: rms from the box mean"), area, budget);
        budgets.must_break("the same, bilinear", bilinear, budget);
    }
    budgets.check();
}

fn black_or_white(bits: u64) -> [f32; 3] {
    [(bits >> 63) as f32; 3]
}

#[test]
fn layouts_hold_the_same_texels() {
    let source_shape = shape(MappingId::Latlong, [32, 16]);
    let source = map_of(&source_shape, smooth);
    let of = |layout| {
        let plain = conversion(&source_shape, MappingId::Cube, [7, 7], Filter::Bicubic);
        run(&source, &Conversion { layout, ..plain }).0
    };
    let faces = of(Layout::Faces);
    let mut seen = 0;
    for layout in Layout::ALL.iter().copied().filter(|layout| layout.holds(6)) {
        let other = of(layout);
        for (chart, texel, _) in texels(faces.shape()) {
            let (a, b) = (faces.light(chart, texel), other.light(chart, texel));
            assert_eq!(a, b, "{layout:?}: chart {chart}, {texel:?}");
        }
        seen += 1;
    }
    assert!(seen > 3, "{seen} layouts");
    assert_ne!(faces.light(0, [0, 0]), faces.light(0, [6, 0]));
}

#[test]
fn a_chart_alone_is_the_same_and_leaves_the_others() {
    let source_shape = shape(MappingId::Latlong, [32, 16]);
    let source = map_of(&source_shape, smooth);
    let plain = conversion(&source_shape, MappingId::Cube, [9, 9], Filter::Lanczos);
    let (whole, _) = run(&source, &plain);
    for chart in 0..6 {
        let one = Conversion {
            charts: 1 << chart,
            ..plain.clone()
        };
        let (alone, _) = run(&source, &one);
        let placements = whole.shape().charts.clone();
        for (other, placement) in placements.iter().enumerate() {
            let origin = placement.unwrap().origin;
            for (y, x) in (0..9).flat_map(|y| (0..9).map(move |x| (y, x))) {
                let at = [origin[0] + x, origin[1] + y];
                let [a, b] = [&alone, &whole].map(|map| map.rasters()[0].light(at[0], at[1]));
                if other == chart {
                    assert_eq!(a, b);
                } else {
                    assert_eq!(a[..3], [0.0; 3], "chart {other} was written");
                    assert_ne!(b[..3], [0.0; 3]);
                }
            }
        }
    }
}

#[test]
fn a_conversion_stops_when_told() {
    let source_shape = shape(MappingId::Latlong, [32, 16]);
    let source = map_of(&source_shape, smooth);
    let plain = conversion(&source_shape, MappingId::Cube, [9, 9], Filter::Bilinear);
    let plan = Plan::new(&source_shape, &plain).unwrap();
    let progress = Progress::new();
    assert!(plan.run(&source, &progress).is_ok());
    progress.cancel();
    let stopped = plan.run(&source, &progress);
    assert!(matches!(stopped, Err(ResampleError::Cancelled)));
    let stopped = loss(&source, &plain, None, &progress);
    assert!(matches!(stopped, Err(ResampleError::Cancelled)));
}

/// Mean light over the sphere, by solid angle.
fn energy(map: &EnvironmentMap) -> f64 {
    let shape = map.shape();
    let (mut sum, mut weight) = (0.0, 0.0);
    for (chart, texel, _) in texels(shape) {
        let w = shape.mapping.texel_solid_angle_sr(chart, texel, shape.size);
        sum += w * f64::from(map.light(chart, texel)[0]);
        weight += w;
    }
    sum / weight
}

#[test]
fn mips_keep_the_mean_light() {
    let mut budgets = Budgets::default();
    let mut worst = 0.0_f64;
    for mapping in [MappingId::Cube, MappingId::Eac, MappingId::Latlong] {
        let map = map_of(&shape(mapping, size_of(mapping, 32)), smooth);
        let whole = energy(&map);
        let made = Conversion::new(mapping, map.shape().size, map.shape());
        for level in levels(map.clone(), &made, &Progress::new()).unwrap() {
            let off = (energy(&level) / whole - 1.0).abs();
            // Below, middles of texels say little of a mean.
            if level.shape().size[1] >= 4 {
                worst = worst.max(off);
            }
        }
        let other = map_of(map.shape(), |d| smooth(d).map(|c| 1.002 * c));
        budgets.must_break(
            "two thousandths more",
            (energy(&other) / whole - 1.0).abs(),
            2e-8,
        );
    }
    budgets.hold("mean light of a level, largest change", worst, 2e-8);
    budgets.check();
}

/// Smaller levels of waves against the waves themselves, which rise by 0.2 from texel to texel: no step shows at a seam. Where a
/// map is bent there, as EAC is, a mean over both sides is a fiftieth of a texel off.
#[test]
fn levels_show_no_seams() {
    let wave = |[x, y, z]: Dir| [x * y + z, y * z - x, z * x + y].map(|c| (2.0 * c) as f32);
    let mut budgets = Budgets::default();
    for (mapping, budget) in [
        (MappingId::Cube, 3e-3),
        (MappingId::Eac, 6e-3),
        (MappingId::Ccm, 6e-3),
    ] {
        let source = map_of(&shape(mapping, [64, 64]), wave);
        let made = Conversion::new(mapping, [64, 64], source.shape());
        let made = levels(source, &made, &Progress::new()).unwrap();
        let worst = |level: &EnvironmentMap, shift: f32| {
            let mut worst = 0.0_f32;
            for (chart, [x, y], dir) in texels(level.shape()) {
                if [x, y].iter().any(|at| *at == 0 || *at == 31) {
                    let (light, exact) = (level.light(chart, [x, y]), wave(dir));
                    for i in 0..3 {
                        worst = worst.max((light[i] - exact[i] + shift).abs());
                    }
                }
            }
            f64::from(worst)
        };
        let what = format!("level of {mapping} at seams");
        budgets.hold(&what, worst(&made[1], 0.0), budget);
        budgets.must_break("a tenth of a texel's rise", worst(&made[1], 0.02), budget);
    }
    budgets.check();
}

/// Every pair there and back at 48 rows: the table in decibels.
#[test]
fn there_and_back_loses_little() {
    let mut budgets = Budgets::default();
    let (mut least, mut regular) = (f64::INFINITY, f64::INFINITY);
    let is_rimmed = |m: MappingId| matches!(m, MappingId::Sphere | MappingId::Matcap);
    let whole = |m: &MappingId| m.info().coverage.solid_angle_sr() > 12.5;
    let mut table = format!("{:24}", "A to B to A, dB");
    for to in MappingId::ALL {
        table += &format!(" {:>8.8}", to.to_string());
    }
    for &from in MappingId::ALL {
        let map = map_of(&shape(from, size_of(from, 48)), smooth);
        table += &format!("\n{:24}", from.to_string());
        for &to in MappingId::ALL {
            let via = Conversion::new(to, size_of(to, 96), map.shape());
            let lost = loss(&map, &via, Some(Filter::Bicubic), &Progress::new()).unwrap();
            table += &format!(" {:8.1}", lost.difference.psnr_db);
            // Half the sphere cannot hold the whole.
            if whole(&to) {
                least = least.min(lost.difference.psnr_db);
                if !is_rimmed(from) && !is_rimmed(to) {
                    regular = regular.min(lost.difference.psnr_db);
                }
            }
        }
    }
    println!("{table}");
    budgets.at_least_db("least through whole spheres", least, 50.0);
    budgets.at_least_db("the same, without rims that are points", regular, 67.0);
    let map = map_of(&shape(MappingId::Cube, [48, 48]), smooth);
    let other = map_of(map.shape(), |d| smooth(d).map(|c| c + 0.1));
    let broken = compare(&map, &other, &Progress::new()).unwrap().psnr_db;
    budgets.must_break_db("a tenth lighter", broken, 50.0);
    budgets.check();
}

/// Waves of a band, seen by bilinear lookups: texels next to a seam err no more than others.
#[test]
fn seams_err_like_the_inside() {
    let wave = |d: Dir| {
        [0, 1, 2].map(|i| (0.5 + 0.4 * (6.0 * (d[i] + 0.3 * d[(i + 1) % 3])).sin()) as f32)
    };
    for mapping in [MappingId::Cube, MappingId::Eac, MappingId::Latlong] {
        let source_shape = shape(mapping, size_of(mapping, 32));
        let source = map_of(&source_shape, wave);
        // The same mapping, finer by an odd number: places on both sides of each border.
        let fine = size_of(mapping, 32).map(|n| 5 * n);
        let same = conversion(&source_shape, mapping, fine, Filter::Bilinear);
        let (target, _) = run(&source, &same);
        let worst = |shift: f32| {
            let mut worst = [0.0_f32; 2];
            for (chart, [x, y], dir) in texels(target.shape()) {
                let is_seam = [x, y]
                    .iter()
                    .zip(fine)
                    .any(|(at, n)| *at < 3 || *at + 3 >= n);
                let (light, exact) = (target.light(chart, [x, y]), wave(dir));
                let off = if is_seam { shift } else { 0.0 };
                for i in 0..3 {
                    let error = (light[i] - exact[i] + off).abs();
                    worst[usize::from(is_seam)] = worst[usize::from(is_seam)].max(error);
                }
            }
            worst
        };
        let [inside, seam] = worst(0.0);
        println!("{mapping}: worst inside {inside:.2e}, at a seam {seam:.2e}");
        assert!(seam <= 1.5 * inside && seam > 0.05 * inside);
        let [inside, seam] = worst(2.0 * inside);
        assert!(seam > 1.5 * inside, "a seam that shows was not noticed");
    }
}
