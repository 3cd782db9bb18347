//! Maps: every texel of every mapping, gutters and levels included, against the light that was put into the environment.

#![cfg(feature = "explorer")]
#![allow(missing_docs, clippy::unwrap_used)]

mod render;

use render::*;
use sixfold::gpu::{Frame, MapPixels, Renderer};
use sixfold::mapping::{ChartPoint, MappingId};
use sixfold::math::{Rotation, Vec3};

#[test]
fn constant_light_stays_constant() {
    let mut renderer = renderer([37, 19], |_| [0.5, 0.25, 2.0]);
    for &id in MappingId::ALL {
        let shown = shot(&mut renderer, &frame(Some(viewport(id)), &[]));
        // Means of odd sizes may be off by one step of a half float.
        let wanted = [0.5, 0.25, 2.0];
        let is_near = |t: &Light| {
            t.iter()
                .zip(wanted)
                .all(|(x, c)| (x - c).abs() <= c / 1024.0)
        };
        for chart in 0..id.info().chart_count() {
            for level in 0..5 {
                let map = renderer.read_map(id, chart, level).unwrap();
                assert!(map.rgb.iter().all(is_near), "{id} {chart} {level}");
                assert!(!is_near(&[0.501, 0.25, 2.0]), "control");
            }
        }
        assert!(
            shown.rgba.chunks(4).all(|p| p == [188, 137, 255, 255]),
            "{id}"
        );
    }
}

/// Worst distance between texels and the light of their directions, over texels that are not drawn out.
fn worst_texel(id: MappingId, chart: u32, map: &MapPixels, turn: [f64; 3]) -> f64 {
    let size = [map.width, map.height].map(|n| n - 2 * map.gutter);
    let mut worst = 0.0f64;
    for j in 0..size[1] {
        for i in 0..size[0] {
            let [u, v] = [
                (f64::from(i) + 0.5) / f64::from(size[0]),
                (f64::from(j) + 0.5) / f64::from(size[1]),
            ];
            let point = ChartPoint::new(chart, u, v);
            if texel_rad(id, point, size) > 0.04 {
                continue;
            }
            let dir = id.inverse(point).unwrap().to_f64();
            let wanted = direction_light([dir[0] * turn[0], dir[1] * turn[1], dir[2] * turn[2]]);
            let at = (j + map.gutter) * map.width + i + map.gutter;
            let light = map.rgb[at as usize];
            worst = worst.max(distance(light.map(f64::from), wanted.map(f64::from)));
        }
    }
    worst
}

#[test]
fn every_texel_holds_the_light_of_its_direction() {
    let mut renderer = renderer([1024, 512], direction_light);
    for &id in MappingId::ALL {
        renderer.draw(&frame(None, &[panel(id)])).unwrap();
        let (mut worst, mut mirrored) = (0.0f64, f64::INFINITY);
        for chart in 0..id.info().chart_count() {
            let map = renderer.read_map(id, chart, 0).unwrap();
            worst = worst.max(worst_texel(id, chart, &map, [1.0; 3]));
            for turn in [[-1.0, 1.0, 1.0], [1.0, -1.0, 1.0]] {
                mirrored = mirrored.min(worst_texel(id, chart, &map, turn));
            }
        }
        // A half float below 1 is off by 2.4e-4 at most; the mean over a texel 0.02 wide by a tenth of that.
        println!("{id}: texels off by {worst:.2e}, mirrored {mirrored:.2}");
        assert!((1e-4..1.2e-3).contains(&worst), "{id}: {worst:e}");
        assert!(mirrored > 0.3, "{id}: control {mirrored}");
    }
}

/// Every texel of every mapping, baked from an environment that is turned.
fn turned_texels(renderer: &mut Renderer, id: MappingId, rotation: Rotation) -> Vec<f32> {
    let turned = Frame {
        rotation,
        ..frame(None, &[panel(id)])
    };
    renderer.draw(&turned).unwrap();
    let charts = 0..id.info().chart_count();
    let texels = charts.map(|chart| renderer.read_map(id, chart, 0).unwrap().rgb);
    texels.flatten().flatten().collect()
}

#[test]
fn a_turned_environment_is_seen_where_it_was_turned_to() {
    let mut straight = renderer([1024, 512], direction_light);
    // What is seen at d after a yaw of 90 degrees lies in the file at (z, y, -x) of d; so with the others.
    type Seen = fn([f64; 3]) -> [f64; 3];
    let turns: [([f64; 3], Seen); 4] = [
        ([90.0, 0.0, 0.0], |[x, y, z]| [z, y, -x]),
        ([0.0, 90.0, 0.0], |[x, y, z]| [x, z, -y]),
        ([0.0, 0.0, 90.0], |[x, y, z]| [y, -x, z]),
        ([90.0, 90.0, 0.0], |[x, y, z]| [-y, z, -x]),
    ];
    let mut worst = 0.0f64;
    for (angles, source) in turns {
        let mut wanted = renderer([1024, 512], |dir| direction_light(source(dir)));
        // Every mapping has the same pass: each once, and the sense of each angle on one.
        let all = if angles == [90.0, 90.0, 0.0] {
            MappingId::ALL
        } else {
            &[MappingId::Cube]
        };
        for &id in all {
            let off = |rotation: [f64; 3], straight: &mut Renderer, wanted: &mut Renderer| {
                let rotation = Rotation::from_degrees(rotation);
                let found = turned_texels(straight, id, rotation);
                let wanted = turned_texels(wanted, id, Rotation::NONE);
                let squares = found
                    .iter()
                    .zip(&wanted)
                    .map(|(a, b)| f64::from(a - b).powi(2));
                (squares.sum::<f64>() / found.len() as f64).sqrt()
            };
            let rms = off(angles, &mut straight, &mut wanted);
            let other_way = off(angles.map(|a| -a), &mut straight, &mut wanted);
            println!("{id} {angles:?}: off by {rms:.1e}, the other way round {other_way:.2}");
            worst = worst.max(rms);
            assert!(other_way > 0.1, "{id} {angles:?}: control {other_way}");
        }
    }
    // A half float below 1 is off by 2.4e-4 at most; texels at a rim mix much of the sphere.
    assert!((2e-4..1.5e-3).contains(&worst), "{worst:e}");
}

#[test]
fn gutters_hold_the_true_neighbours() {
    let mut renderer = renderer([1024, 512], direction_light);
    let panels = [panel(MappingId::Latlong), panel(MappingId::Cube)];
    renderer.draw(&frame(None, &panels)).unwrap();
    for level in 0..5 {
        // Over the date line the first and the last columns go on.
        let map = renderer.read_map(MappingId::Latlong, 0, level).unwrap();
        let (gutter, width) = (map.gutter, map.width - 2 * map.gutter);
        let texel = |i: u32, j: u32| map.rgb[(j * map.width + i) as usize].map(f64::from);
        let mut worst = 0.0f64;
        for j in gutter..map.height - gutter {
            for k in 0..gutter {
                worst = worst.max(distance(texel(k, j), texel(k + width, j)));
            }
        }
        assert!(worst < 2e-3, "level {level}: {worst:e}");
        let j = map.height / 2;
        assert!(
            distance(texel(gutter, j), texel(gutter + width / 2, j)) > 0.5,
            "control"
        );

        // A face goes on along its own plane.
        let map = renderer.read_map(MappingId::Cube, 4, level).unwrap();
        let side = f64::from(map.width - 2 * map.gutter);
        let (mut worst, mut clamped) = (0.0f64, 0.0f64);
        for j in 0..map.height {
            for i in 0..map.width {
                let [a, b] =
                    [i, j].map(|n| (f64::from(n) + 0.5 - f64::from(map.gutter)) / side * 2.0 - 1.0);
                let light = map.rgb[(j * map.width + i) as usize].map(f64::from);
                let wanted = |a: f64, b: f64| {
                    direction_light(Vec3::new(a, -b, 1.0).normalized().to_f64()).map(f64::from)
                };
                worst = worst.max(distance(light, wanted(a, b)));
                clamped = clamped.max(distance(
                    light,
                    wanted(a.clamp(-1.0, 1.0), b.clamp(-1.0, 1.0)),
                ));
            }
        }
        println!("cube level {level}: off by {worst:.2e}, against a clamped gutter {clamped:.2e}");
        // The mean over a texel of side t is off by t^2/24; t doubles with each level, and half floats set the floor.
        let budget = 9e-4 + 6e-3 * 0.25f64.powi(4 - level as i32);
        assert!(
            (0.1 * budget..budget).contains(&worst),
            "level {level}: {worst:e}"
        );
        assert!(clamped > 3.0 * worst, "control: {clamped:e}");
    }
}
