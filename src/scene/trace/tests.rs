use std::f32::consts::TAU;
use std::sync::Mutex;

use super::super::{Mesh, Object};
use std::sync::atomic::{AtomicU32, Ordering};

use super::*;
use crate::math::angle_rad;
use crate::optics::ball::{ball_paths, rainbow_angle_rad};

const GLASS: f32 = 1.0 / 1.5;

fn target(object: Object, density: u32) -> Target {
    Target::new(object.mesh_at(density))
}

fn angle(a: Vec3, b: Vec3) -> f64 {
    angle_rad(a.as_dvec3().to_array(), b.as_dvec3().to_array())
}

/// Parallel rays onto the unit disc, by their distance from its middle, up to `widest`; around it by the golden angle.
fn parallel(count: u32, widest: f32) -> impl Iterator<Item = Ray> {
    let dir = Vec3::new(0.48, -0.6, 0.64);
    let right = Vec3::new(0.8, 0.0, -0.6);
    let up = dir.cross(right);
    (0..count).map(move |k| {
        let radius = widest * (k as f32 + 0.5) / count as f32;
        let (sin, cos) = (TAU * 0.618_034 * k as f32).sin_cos();
        Ray {
            origin: radius * (cos * right + sin * up) - 2.0 * dir,
            dir,
        }
    })
}

/// Rays of a camera that looks from somewhat above, over the whole picture.
fn seen(count: u32) -> impl Iterator<Item = Ray> {
    let camera = Camera {
        yaw_rad: 0.6,
        pitch_rad: 0.4,
        ..Camera::default()
    };
    let frame = camera.ray_frame(1.0);
    (0..count * count).map(move |k| {
        let uv = [k % count, k / count].map(|i| (i as f32 + 0.37) / count as f32);
        frame.ray((uv[0], uv[1]))
    })
}

/// Worst angle in radians and worst weight between a mesh of the sphere and the sphere, up to 75 degrees of incidence.
fn off_the_ball(density: u32, eta_error: f64) -> (f64, f64) {
    let sphere = target(Object::Sphere, density);
    let bounces = 2;
    let (mut turned, mut weight) = (0.0f64, 0.0f64);
    for ray in parallel(2000, 75f32.to_radians().sin()) {
        let hit = sphere.cast(ray).unwrap();
        let [incident, normal] =
            [ray.dir, hit.normal].map(|v| math::Vec3::from(v.as_dvec3().normalize().to_array()));
        let eta = f64::from(GLASS) + eta_error;
        let exact = ball_paths(incident, normal, eta, bounces);
        let traced = trace(&sphere, ray, GLASS, bounces);
        assert_eq!(traced.as_slice().len(), exact.len());
        // The mesh's light is unpolarised at every crossing.
        let reflectance = exact[0].weight;
        let mut expected = reflectance;
        for (k, (a, b)) in traced.as_slice().iter().zip(&exact).enumerate() {
            turned = turned.max(angle_rad(a.dir.as_dvec3().to_array(), b.dir.to_f64()));
            if k > 0 {
                expected = (1.0 - reflectance).powi(2) * reflectance.powi(k as i32 - 1);
            }
            weight = weight.max((f64::from(a.weight) - expected).abs());
        }
    }
    (turned, weight)
}

#[test]
fn a_mesh_of_the_sphere_bends_like_the_sphere() {
    // The middle of a quad's diagonal lies 1.5e-4 below the sphere at full density; a ray meets it that much later, at a normal
    // turned by the depth times tan r, twice a chord. Both errors fall as the square of the density.
    for density in [32, 16, 8] {
        let scale = (32.0 / f64::from(density)).powi(2);
        let (turned, weight) = off_the_ball(density, 0.0);
        println!("density {density}: {turned:e} rad, weight {weight:e}");
        // Observed at full density: 2.5e-4 rad, 2.4e-4.
        assert!(
            (0.25..1.0).contains(&(turned / (5e-4 * scale))),
            "{turned:e}"
        );
        assert!(
            (0.25..1.0).contains(&(weight / (4e-4 * scale))),
            "{weight:e}"
        );
    }
    let (turned, weight) = off_the_ball(32, 2e-3);
    assert!(
        turned > 5e-4 && weight > 4e-4,
        "control {turned:e} {weight:e}"
    );
}

/// Largest departure of the sum of all weights from 1, without and with the lost part.
fn missing(object: Object, eta: f32, bounces: u32) -> (f64, f64) {
    let target = target(object, 8);
    let (mut kept, mut all) = (0.0f64, 0.0f64);
    for ray in seen(60) {
        let escapes = trace(&target, ray, eta, bounces);
        let sum: f64 = escapes.as_slice().iter().map(|e| f64::from(e.weight)).sum();
        assert!(sum < 1.0 + 2.5e-7);
        for escape in escapes.as_slice() {
            assert!((escape.dir.length() - 1.0).abs() < 1e-6 && escape.weight >= 0.0);
        }
        kept = kept.max(1.0 - sum);
        all = all.max((sum + f64::from(escapes.lost()) - 1.0).abs());
    }
    (kept, all)
}

#[test]
fn no_light_is_made_and_only_the_rest_is_lost() {
    let mut worst = 0.0f64;
    for object in Object::ALL {
        for eta in [GLASS, 1.0 / 2.42, 1.0, 1.5] {
            for bounces in [0, 2, u32::MAX] {
                let (kept, all) = missing(object, eta, bounces);
                worst = worst.max(all);
                // Control: without the lost part some light is missing.
                assert!(
                    kept > 1e-3 || bounces > 2 || eta >= 1.0,
                    "{object} {eta} {bounces} {kept:e}"
                );
            }
        }
    }
    // The two roundings of 1 - R and of what is left of it: one unit of f32 each.
    assert!((2.5e-7 / 4.0..2.5e-7).contains(&worst), "{worst:e}");
}

/// Rays onto the middle of the rounded cube's front, up to five degrees from its normal.
fn onto_the_flat() -> impl Iterator<Item = Ray> {
    (0..400).map(move |k| {
        let (x, y) = ((k % 20) as f32 / 10.0 - 0.95, (k / 20) as f32 / 10.0 - 0.95);
        let dir = Vec3::new(0.06 * x, 0.06 * y, 1.0).normalize();
        Ray {
            origin: Vec3::new(0.05 * y, -0.05 * x, -0.6) - 2.0 * dir,
            dir,
        }
    })
}

#[test]
fn a_slab_lets_light_out_as_it_came() {
    let worst = |object| {
        let target = target(object, 32);
        let mut worst = 0.0f64;
        for ray in onto_the_flat() {
            let escapes = trace(&target, ray, GLASS, 3);
            let list = escapes.as_slice();
            assert_eq!(list.len(), 5);
            // Through, and again after two inner reflections; back, as from the outside, after one and three.
            for (k, way) in [
                (1, ray.dir),
                (3, ray.dir),
                (2, list[0].dir),
                (4, list[0].dir),
            ] {
                worst = worst.max(angle(list[k].dir, way));
            }
        }
        worst
    };
    let observed = worst(Object::RoundedCube);
    // Across the slab directions are below 0.06, where a unit of f32 is 3.7e-9; observed 1.1e-8.
    assert!((5e-9..2e-8).contains(&observed), "{observed:e}");
    assert!(worst(Object::Sphere) > 0.1, "control");
}

#[test]
fn the_rainbow_stands_over_a_traced_drop() {
    let sphere = target(Object::Sphere, 32);
    // The angle to the point opposite to the sun is largest on the primary bow and smallest on the secondary. Rays at the rim
    // itself, where the mesh has corners, are left out: 1 - 0.98 is far beyond both bows' rays (at 0.86 and 0.95).
    let angles_deg = |index: f32, bounces: u32| {
        let angles = parallel(20_000, 0.98).map(|ray| {
            let escapes = trace(&sphere, ray, 1.0 / index, bounces);
            angle(-ray.dir, escapes.as_slice()[1 + bounces as usize].dir).to_degrees()
        });
        angles.collect::<Vec<_>>()
    };
    let primary = |index: f32| angles_deg(index, 1).into_iter().fold(0.0, f64::max);
    let secondary = |index: f32| angles_deg(index, 2).into_iter().fold(180.0, f64::min);
    let exact = |bounces| rainbow_angle_rad(1.333, bounces).unwrap().to_degrees();
    let off = [primary(1.333) - exact(1), secondary(1.333) - exact(2)];
    println!("{off:?} degrees from {} and {}", exact(1), exact(2));
    // As far off as the mesh bends light elsewhere than the sphere; observed 1.6e-4 and 2.3e-4.
    for off in off.map(|degrees| degrees.to_radians().abs()) {
        assert!((5e-4 / 4.0..5e-4).contains(&off), "{off:e}");
    }
    // Control: ice instead of water.
    assert!((primary(1.31) - exact(1)).abs() > 1.0 && (secondary(1.31) - exact(2)).abs() > 1.0);
}

/// Worst angle between where a ray came from and where its way back leads, begun off by `turn`; and the number of ways.
fn way_back(object: Object, turn: f32) -> (f64, u32) {
    let target = target(object, 32);
    let (mut worst, mut count) = (0.0f64, 0);
    for ray in seen(50) {
        let escapes = trace(&target, ray, GLASS, 2);
        for (k, escape) in escapes.as_slice().iter().enumerate().skip(1) {
            // Near grazing nearly nothing leaves, and directions are not to be had more exactly than the square root.
            if escape.weight < 0.02 {
                continue;
            }
            let back = Ray {
                origin: escape.point + 1e-2 * escape.dir,
                dir: (turn * escape.dir.any_orthonormal_vector() - escape.dir).normalize(),
            };
            let way = trace(&target, back, GLASS, k as u32 - 1);
            let end = way.as_slice().get(k).map_or(Vec3::ZERO, |end| end.dir);
            worst = worst.max(angle(end, -ray.dir));
            count += 1;
        }
    }
    (worst, count)
}

#[test]
fn the_way_back_is_the_way_there() {
    // The direction that turns back is rounded; each chord between strongly bent surfaces adds to it (see the controls).
    // Observed 6.9e-6, 6.9e-6, 3.5e-5.
    for (object, budget) in [
        (Object::Sphere, 1e-5),
        (Object::Torus, 1e-5),
        (Object::RoundedCube, 1e-4),
    ] {
        let (observed, count) = way_back(object, 0.0);
        println!("{object}: {observed:e} rad on {count} ways");
        assert!((0.25 * budget..budget).contains(&observed), "{observed:e}");
        assert!(count > 1000);
        assert!(way_back(object, 1e-3).0 > 10.0 * budget, "control");
    }
}

/// Both meshes as one; the second shrunk, and turned inside out on demand.
fn nested(outer: Mesh, inner: Mesh, scale: f32, inside_out: bool) -> Mesh {
    let first = outer.positions.len() as u32;
    let mut both = outer;
    both.positions
        .extend(inner.positions.iter().map(|p| p.map(|x| scale * x)));
    both.normals.extend(inner.normals);
    for [a, b, c] in inner.indices.as_chunks::<3>().0 {
        let [b, c] = if inside_out { [c, b] } else { [b, c] };
        both.indices.extend([a, b, c].map(|i| first + i));
    }
    both
}

#[test]
fn overlapping_parts_are_one_piece_of_glass() {
    let sphere = || Object::Sphere.mesh_at(8);
    let plain = Target::new(sphere());
    let filled = Target::new(nested(sphere(), sphere(), 0.9, false));
    let hollow = Target::new(nested(sphere(), sphere(), 0.9, true));
    let worst = |other: &Target| {
        let rays = parallel(500, 0.95);
        let pairs = rays.map(|ray| {
            let (a, b) = (trace(&plain, ray, GLASS, 1), trace(other, ray, GLASS, 1));
            a.as_slice()
                .iter()
                .zip(b.as_slice())
                .map(|(a, b)| angle(a.dir, b.dir))
                .fold(0.0, f64::max)
        });
        pairs.fold(0.0, f64::max)
    };
    // The point of entry into the second part is one more rounding on the way: observed 4.4e-7.
    let observed = worst(&filled);
    assert!((2.5e-7..1e-6).contains(&observed), "{observed:e}");
    assert!(worst(&hollow) > 0.1, "control");
}

#[test]
fn an_open_part_lets_light_go_straight_on() {
    let mesh = Mesh {
        positions: vec![[-1.0, -1.0, 0.0], [-1.0, 3.0, 0.0], [3.0, -1.0, 0.0]],
        normals: vec![[0.0, 0.0, -1.0]; 3],
        indices: vec![0, 1, 2],
    };
    let ray = Ray {
        origin: Vec3::new(-0.5, 0.0, -1.0),
        dir: Vec3::new(0.6, 0.0, 0.8),
    };
    let pane = Target::new(mesh);
    let escapes = trace(&pane, ray, GLASS, 4);
    let [outer, through] = escapes.as_slice() else {
        panic!("{escapes:?}");
    };
    assert!((outer.dir - Vec3::new(0.6, 0.0, -0.8)).length() < 1e-6);
    // sin r = 0.6 / 1.5.
    assert!((through.dir.x - 0.4).abs() < 1e-6 && through.dir.z > 0.9);
    assert!((outer.weight + through.weight - 1.0).abs() < 1e-6);
}

#[test]
fn no_ray_and_no_index_is_too_strange() {
    let sphere = target(Object::Sphere, 2);
    let straight = Ray {
        origin: Vec3::new(0.1, 0.2, -2.0),
        dir: Vec3::Z,
    };
    for dir in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
        assert!(
            trace(&sphere, Ray { dir, ..straight }, GLASS, 2)
                .as_slice()
                .is_empty()
        );
    }
    for eta in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let escapes = trace(&sphere, straight, eta, 2);
        assert!(angle(escapes.as_slice()[1].dir, Vec3::Z) < 1e-6, "{eta}");
    }
    for eta in [f32::MIN_POSITIVE, 1e-3, 1e3, f32::MAX] {
        for escape in trace(&sphere, straight, eta, u32::MAX).as_slice() {
            assert!((escape.dir.length() - 1.0).abs() < 1e-6, "{eta} {escape:?}");
            assert!((0.0..=1.0).contains(&escape.weight), "{eta} {escape:?}");
        }
    }
    let past = Ray {
        origin: Vec3::new(3.0, 0.0, -2.0),
        dir: 7.0 * Vec3::Z,
    };
    let missed = trace(&sphere, past, GLASS, 2);
    assert!(matches!(missed.as_slice(), [only] if only.dir == Vec3::Z && only.weight == 1.0));
}

#[test]
fn a_view_holds_what_single_rays_give() {
    let teapot = target(Object::Teapot, 8);
    let camera = Camera {
        yaw_rad: 1.0,
        ..Camera::default()
    };
    let (width, height, bounces) = (41, 31, 2);
    let steps = Mutex::new(Vec::new());
    let note = |part: f32| {
        steps.lock().unwrap().push(part);
        false
    };
    let traced = trace_view(&teapot, &camera, [width, height], GLASS, bounces, &note).unwrap();
    assert_eq!((traced.size, traced.layers), ([width, height], 4));
    assert_eq!(traced.dirs.len() as u32, width * height * 4);
    let (mut missed, mut through) = (0, 0);
    for y in 0..height {
        for x in 0..width {
            let uv = [(x, width), (y, height)].map(|(i, n)| (i as f32 + 0.5) / n as f32);
            let ray = camera.ray((uv[0], uv[1]), width as f32 / height as f32);
            let escapes = trace(&teapot, ray, GLASS, bounces);
            for layer in 0..4 {
                let place = (layer * height + y) * width + x;
                let expected = escapes
                    .as_slice()
                    .get(layer as usize)
                    .copied()
                    .unwrap_or_default();
                assert_eq!(
                    traced.dirs[place as usize],
                    expected.dir.extend(expected.weight).to_array()
                );
            }
            match escapes.as_slice() {
                [only] => missed += u32::from(only.weight == 1.0),
                _ => through += 1,
            }
        }
    }
    assert!(missed > 100 && through > 100, "{missed} {through}");
    let mut steps = steps.into_inner().unwrap();
    steps.sort_by(f32::total_cmp);
    assert_eq!(steps.len() as u32, height);
    assert_eq!(steps.last(), Some(&1.0));
}

#[test]
fn a_view_can_be_stopped() {
    let sphere = target(Object::Sphere, 1);
    let camera = Camera::default();
    let rows = AtomicU32::new(0);
    let stop = |part: f32| {
        rows.fetch_add(1, Ordering::Relaxed);
        part > 0.1
    };
    assert_eq!(
        trace_view(&sphere, &camera, [4, 1000], GLASS, 0, &stop),
        None
    );
    // Every thread may finish its row.
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u32;
    assert!((101..=101 + threads).contains(&rows.into_inner()));
    for size in [[0, 0], [0, 7], [7, 0], [0, u32::MAX]] {
        let empty = trace_view(&sphere, &camera, size, GLASS, 0, &|_| false).unwrap();
        assert!(empty.dirs.is_empty());
    }
    assert_eq!(
        trace_view(&sphere, &camera, [u32::MAX; 2], GLASS, 0, &|_| false),
        None
    );
}
