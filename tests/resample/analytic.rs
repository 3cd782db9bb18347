//! Environments that are known everywhere: spherical harmonics, a linear function of direction, a step. Across the cube's edges
//! and in its corners bilinear lookups err no more than inside, whatever the size.

use std::collections::BTreeMap;

use crate::fixtures::*;
use sixfold::imaging::EnvironmentMap;
use sixfold::imaging::resample::Filter;
use sixfold::mapping::MappingId;
use sixfold::math::inputs::Random;

type Light = Box<dyn Fn(Dir) -> [f32; 3]>;

/// A sum of Legendre polynomials of the bands 0 to 8 around three axes each: spherical harmonics of these bands. In [0, 1].
fn harmonics() -> Light {
    const BANDS: usize = 8;
    let mut random = Random::new(8);
    let axes: Vec<[Dir; BANDS + 1]> = (0..3)
        .map(|_| std::array::from_fn(|_| random.direction().map(f64::from)))
        .collect();
    let sum = move |d: Dir| {
        let mut sum = 0.0;
        for axes in &axes {
            for (band, axis) in axes.iter().enumerate() {
                let x: f64 = axis.iter().zip(d).map(|(a, b)| a * b).sum();
                // (k + 1) P(k + 1) = (2k + 1) x P(k) - k P(k - 1).
                let (mut before, mut p) = (0.0, 1.0);
                for k in 0..band {
                    let k = k as f64;
                    (before, p) = (p, ((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0));
                }
                sum += p;
            }
        }
        // 27 terms, each at most 1.
        (0.5 + sum / 54.0) as f32
    };
    Box::new(move |d| [sum(d); 3])
}

fn linear(d: Dir) -> f64 {
    0.5 + 0.45 * (0.48 * d[0] + 0.6 * d[1] - 0.64 * d[2])
}

fn scenes() -> [(&'static str, Light); 3] {
    [
        ("harmonics", harmonics()),
        ("linear", Box::new(|d| [linear(d) as f32; 3])),
        (
            "step",
            Box::new(|d| [if linear(d) > 0.5 { 0.8 } else { 0.2 }; 3]),
        ),
    ]
}

/// Where a lookup lies: between four texels of one face, across an edge, in a corner. Faces are by axis and sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Where {
    Inside,
    Edge([i8; 3]),
    Corner([i8; 3]),
}

/// Of a direction on a cube of faces of n texels: at most half a texel from the border, four texels of one face no longer surround it.
fn place(d: Dir, n: u32) -> Where {
    let largest = d.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let near = 1.0 - 1.0 / f64::from(n);
    let signs = d.map(|c| {
        let c = c / largest;
        if c.abs() > near { c.signum() as i8 } else { 0 }
    });
    match signs.iter().filter(|sign| **sign != 0).count() {
        0 | 1 => Where::Inside,
        2 => Where::Edge(signs),
        _ => Where::Corner(signs),
    }
}

/// The largest error in each place.
fn worst(target: &EnvironmentMap, n: u32, exact: &Light, shift: f32) -> BTreeMap<Where, f64> {
    let mut worst = BTreeMap::new();
    for (chart, texel, dir) in texels(target.shape()) {
        let place = place(dir, n);
        let light = target.light(chart, texel)[0];
        let off = if place == Where::Inside { 0.0 } else { shift };
        let error = f64::from((light - exact(dir)[0] + off).abs());
        let entry = worst.entry(place).or_insert(0.0_f64);
        *entry = entry.max(error);
    }
    worst
}

#[test]
fn edges_and_corners_of_any_size_err_like_the_inside() {
    let mut budgets = Budgets::default();
    for (name, light) in &scenes() {
        for n in [2, 3, 4, 16, 256] {
            // Band 8 has waves of 45 degrees: on faces of a few texels nothing of them is left to compare.
            if *name == "harmonics" && n < 16 {
                continue;
            }
            let source = map_of(&shape(MappingId::Cube, [n, n]), light);
            // Many places in each texel, fewer where texels are many.
            let finer = if n == 256 { 2 } else { 9 };
            let target = conversion(
                source.shape(),
                MappingId::Cube,
                [finer * n; 2],
                Filter::Bilinear,
            );
            let (target, _) = run(&source, &target);
            let all = worst(&target, n, light, 0.0);
            let edges = all
                .keys()
                .filter(|place| matches!(place, Where::Edge(_)))
                .count();
            let corners = all
                .keys()
                .filter(|place| matches!(place, Where::Corner(_)))
                .count();
            assert_eq!((edges, corners), (12, 8), "{name} {n}");
            let inside = all[&Where::Inside];
            let seam = |all: &BTreeMap<Where, f64>| {
                let seams = all.iter().filter(|(place, _)| **place != Where::Inside);
                seams.fold(0.0_f64, |most, (_, error)| most.max(*error))
            };
            budgets.hold(
                &format!("{name}, {n}: seams over inside"),
                seam(&all) / inside,
                1.5,
            );
            if n < 256 {
                let shifted = worst(&target, n, light, 2.0 * inside as f32);
                budgets.must_break("a seam that shows", seam(&shifted) / inside, 1.5);
            }
        }
    }
    budgets.check();
}

/// One texel a face: nothing lies inside. What is mixed stays between the six texels, and where their faces' middles are it is theirs.
#[test]
fn a_cube_of_six_texels_mixes_them() {
    for (name, light) in &scenes() {
        let source = map_of(&shape(MappingId::Cube, [1, 1]), light);
        let six: Vec<f32> = (0..6).map(|face| source.light(face, [0, 0])[0]).collect();
        let (least, most) = six
            .iter()
            .fold((f32::MAX, f32::MIN), |(a, b), c| (a.min(*c), b.max(*c)));
        for filter in [Filter::Nearest, Filter::Bilinear] {
            let target = conversion(source.shape(), MappingId::Cube, [9, 9], filter);
            let (target, _) = run(&source, &target);
            let mut mixed = 0;
            for (face, texel, _) in texels(target.shape()) {
                let light = target.light(face, texel)[0];
                assert!(
                    light >= least - 1e-6 && light <= most + 1e-6,
                    "{name}: {light}"
                );
                let own = six[face as usize];
                mixed += u32::from((light - own).abs() > 1e-3);
                if texel == [4, 4] {
                    assert!((light - own).abs() < 1e-6, "{name}: {light} for {own}");
                }
            }
            // Control: the nearest texel alone is mixed nowhere, and what is between is.
            assert_eq!(
                mixed > 0,
                filter == Filter::Bilinear,
                "{name} {filter:?}: {mixed}"
            );
        }
    }
}

/// Errors against the exact value from and to the commonest maps. Each is the interpolation's own: waves of 45 degrees on texels of
/// 0.35 degrees, by (h k)^2/8 of their height.
#[test]
fn errors_are_those_of_the_filter() {
    let mut budgets = Budgets::default();
    for (from, to, height) in [
        (MappingId::Latlong, MappingId::Cube, 256),
        (MappingId::Cube, MappingId::Latlong, 128),
        (MappingId::Cube, MappingId::Eac, 128),
    ] {
        for (name, light) in &scenes() {
            let source = map_of(&shape(from, size_of(from, height)), light);
            let error = |filter, exact: &Light| {
                let mut target = conversion(source.shape(), to, size_of(to, 90), filter);
                target.rotation = askew();
                let (map, _) = run(&source, &target);
                let (mut sum, mut count) = (0.0, 0.0);
                for (chart, texel, dir) in texels(map.shape()) {
                    let off = map.light(chart, texel)[0] - exact(rotated(target.rotation, dir))[0];
                    sum += f64::from(off).powi(2);
                    count += 1.0;
                }
                f64::sqrt(sum / count)
            };
            let budgets_of = match *name {
                "harmonics" => [3e-5, 3e-7, 2.5e-7],
                "linear" => [2e-5, 2e-7, 2e-7],
                _ => [5e-2; 3],
            };
            for (filter, budget) in [Filter::Bilinear, Filter::Bicubic, Filter::Lanczos]
                .into_iter()
                .zip(budgets_of)
            {
                let what = format!("{from} to {to}, {name}, {}, RMS", filter.id());
                budgets.hold(&what, error(filter, light), budget);
            }
            let other: Light = Box::new(|d| [linear(d) as f32 + 0.1; 3]);
            budgets.must_break(
                "another one",
                error(Filter::Bilinear, &other),
                budgets_of[0],
            );
        }
    }
    budgets.check();
}
