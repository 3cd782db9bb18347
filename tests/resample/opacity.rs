//! Opacity through every filter, and maps of which faces are missing.

use crate::fixtures::*;
use sixfold::imaging::resample::{Conversion, Filter};
use sixfold::imaging::{Channels, EnvironmentMap, MapShape, Raster, Samples, Transfer};
use sixfold::mapping::MappingId;

/// A map of floats with opacity.
fn map_with_opacity(shape: &MapShape, light: impl Fn(Dir) -> [f32; 4]) -> EnvironmentMap {
    let parts = [0, 1].map(|half| {
        map_of(shape, |d| {
            let [r, g, b, a] = light(d);
            if half == 0 { [r, g, b] } else { [a; 3] }
        })
    });
    let [colours, opacity] = parts.map(|map| map.into_parts().1);
    let rasters = colours.iter().zip(&opacity).map(|(colours, opacity)| {
        let (Samples::F32(rgb), Samples::F32(a)) = (colours.samples(), opacity.samples()) else {
            panic!("floats")
        };
        let pixels = rgb.chunks(3).zip(a.chunks(3));
        let samples = pixels.flat_map(|(c, a)| [c[0], c[1], c[2], a[0]]).collect();
        Raster::new(
            colours.size(),
            Channels::Rgba,
            Transfer::Linear,
            Samples::F32(samples),
        )
        .unwrap()
    });
    let shape = MapShape {
        channels: Channels::Rgba,
        ..shape.clone()
    };
    EnvironmentMap::new(shape, rasters.collect()).unwrap()
}

/// Smooth colours and opacity, none of them 0.
fn smooth([x, y, z]: Dir) -> [f32; 4] {
    let waves = [
        x + 0.3 * y * z,
        y - 0.2 * x * z,
        z + 0.4 * x * y,
        0.7 * x - 0.6 * z + 0.2 * y,
    ];
    waves.map(|wave| (0.5 + 0.35 * wave) as f32)
}

fn pairs() -> [(MappingId, MappingId); 3] {
    [
        (MappingId::Cube, MappingId::Latlong),
        (MappingId::Latlong, MappingId::Ccm),
        (MappingId::Eac, MappingId::Cube),
    ]
}

fn turned(source: &EnvironmentMap, to: MappingId, filter: Filter) -> Conversion {
    // Coarser by a third for `area`, finer for the others.
    let height = if filter == Filter::Area { 32 } else { 70 };
    Conversion {
        rotation: askew(),
        ..conversion(source.shape(), to, size_of(to, height), filter)
    }
}

/// The largest error of a colour and of the opacity.
fn errors(
    map: &EnvironmentMap,
    conversion: &Conversion,
    exact: impl Fn(Dir) -> [f32; 4],
) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for (chart, texel, dir) in texels(map.shape()) {
        let (light, exact) = (
            map.light(chart, texel),
            exact(rotated(conversion.rotation, dir)),
        );
        for c in 0..4 {
            let error = f64::from((light[c] - exact[c]).abs());
            worst[c / 3] = if error.is_nan() {
                error
            } else {
                worst[c / 3].max(error)
            };
        }
    }
    worst
}

#[test]
fn colours_and_opacity_come_through_every_filter() {
    let mut budgets = Budgets::default();
    // From the largest texels: half of their width for the nearest, its square for those that mix two, less for the others; an area is
    // a mean and not the value in its middle.
    for (filter, budget) in [
        (Filter::Nearest, [1.5e-2, 1.2e-2]),
        (Filter::Bilinear, [3e-4, 2e-4]),
        (Filter::Bicubic, [3e-5, 1e-5]),
        (Filter::Lanczos, [3e-5, 1e-5]),
        (Filter::Area, [1e-2, 1e-2]),
    ] {
        let mut worst = [0.0_f64; 2];
        let mut least_broken = [f64::INFINITY; 2];
        for (from, to) in pairs() {
            let source = map_with_opacity(&shape(from, size_of(from, 96)), smooth);
            let conversion = turned(&source, to, filter);
            let (target, _) = run(&source, &conversion);
            // Controls: colours that are weighed twice by their opacity, and opaque where it is not.
            let broken = errors(&target, &conversion, |d| {
                let [r, g, b, a] = smooth(d);
                [r * a, g * a, b * a, 1.0]
            });
            let observed = errors(&target, &conversion, smooth);
            worst = [0, 1].map(|i| worst[i].max(observed[i]));
            least_broken = [0, 1].map(|i| least_broken[i].min(broken[i]));
        }
        for (i, part) in ["colour", "opacity"].iter().enumerate() {
            budgets.hold(&format!("{}, {part}", filter.id()), worst[i], budget[i]);
            budgets.must_break(
                &format!("{part}, weighed twice or opaque"),
                least_broken[i],
                budget[i],
            );
        }
    }
    budgets.check();
}

/// What is clear has a colour that nobody shall see.
#[test]
fn clear_texels_do_not_bleed() {
    const HIDDEN: f32 = 10.0;
    for (from, to) in pairs() {
        let clear = |d: Dir| d[0] + 0.5 * d[1] > 0.2;
        let source = map_with_opacity(&shape(from, size_of(from, 48)), |d| {
            if clear(d) {
                [HIDDEN, 0.0, HIDDEN, 0.0]
            } else {
                [0.25, 0.5, 0.75, 1.0]
            }
        });
        for filter in [Filter::Nearest, Filter::Bilinear, Filter::Area] {
            let (target, _) = run(&source, &turned(&source, to, filter));
            let (mut opaque, mut between, mut none) = (0, 0, 0);
            for (chart, texel, _) in texels(target.shape()) {
                let [r, g, b, a] = target.light(chart, texel);
                if a > 0.0 {
                    let off = [r - 0.25, g - 0.5, b - 0.75].map(f32::abs);
                    assert!(
                        off.iter().all(|off| *off < 1e-4),
                        "{from} {to} {filter:?}: {r} {g} {b} {a}"
                    );
                }
                match a {
                    1.0 => opaque += 1,
                    0.0 => none += 1,
                    _ => between += 1,
                }
            }
            assert!(opaque > 100 && none > 100, "{opaque} {none}");
            // Control: filters that mix leave an edge that is neither.
            assert_eq!(
                between > 0,
                filter != Filter::Nearest,
                "{filter:?} {between}"
            );
        }
    }
}

#[test]
fn what_is_opaque_stays_so_to_the_bit() {
    for (from, to) in pairs() {
        let opaque = map_with_opacity(&shape(from, size_of(from, 24)), |d| {
            let [r, g, b, _] = smooth(d);
            [r, g, b, 1.0]
        });
        let plain = map_of(&shape(from, size_of(from, 24)), |d| {
            let [r, g, b, _] = smooth(d);
            [r, g, b]
        });
        for filter in Filter::ALL {
            let (target, _) = run(&opaque, &turned(&opaque, to, filter));
            let mut added = turned(&plain, to, filter);
            added.channels = Channels::Rgba;
            let (other, _) = run(&plain, &added);
            for (chart, texel, _) in texels(target.shape()) {
                assert_eq!(target.light(chart, texel)[3], 1.0, "{from} {to} {filter:?}");
                assert_eq!(other.light(chart, texel)[3], 1.0, "{from} {to} {filter:?}");
            }
        }
    }
}

/// A cube of which a face is missing: nothing where it was, and everything else as it is with it.
#[test]
fn a_missing_face_leaves_a_hole_and_nothing_else() {
    for channels in [Channels::Rgb, Channels::Rgba] {
        let whole = shape(MappingId::Cube, [32, 32]);
        let whole = match channels {
            Channels::Rgba => map_with_opacity(&whole, |d| {
                let [r, g, b, _] = smooth(d);
                [r, g, b, 1.0]
            }),
            Channels::Rgb => map_of(&whole, |d| {
                let [r, g, b, _] = smooth(d);
                [r, g, b]
            }),
        };
        for missing in 0..6 {
            let mut holed = whole.shape().clone();
            holed.charts[missing as usize] = None;
            let holed = EnvironmentMap::new(holed, whole.rasters().to_vec()).unwrap();
            for filter in Filter::ALL {
                let conversion = turned(&whole, MappingId::Latlong, filter);
                let (full, _) = run(&whole, &conversion);
                let (part, _) = run(&holed, &conversion);
                let mut seen = [0, 0];
                for (_, texel, dir) in texels(full.shape()) {
                    let dir = rotated(conversion.rotation, dir);
                    let (full, part) = (full.light(0, texel), part.light(0, texel));
                    assert!(part.iter().all(|c| c.is_finite()));
                    // How deep in the missing face, or away from it: 1 at its edges.
                    let axis =
                        dir[missing as usize / 2] * if missing % 2 == 0 { 1.0 } else { -1.0 };
                    let others = (0..3).filter(|k| *k != missing as usize / 2);
                    let across = others.fold(0.0_f64, |most, k| most.max(dir[k].abs()));
                    if axis > 1.3 * across {
                        let nothing = if channels == Channels::Rgba {
                            [0.0; 4]
                        } else {
                            [0.0, 0.0, 0.0, 1.0]
                        };
                        assert_eq!(part, nothing, "{missing} {filter:?}");
                        seen[0] += 1;
                    } else if axis < 0.7 * across {
                        // Another kernel may do it, with other roundings.
                        let off = (0..4).map(|c| (part[c] - full[c]).abs());
                        let off = off.fold(0.0, f32::max);
                        assert!(off < 1e-6, "{missing} {filter:?}: {part:?}, {full:?}");
                        seen[1] += 1;
                    }
                }
                assert!(seen[0] > 20 && seen[1] > 200, "{seen:?}");
            }
        }
    }
}
