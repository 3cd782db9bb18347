use super::super::object::{TORUS_MAJOR, TORUS_MINOR};
use super::super::{Camera, Object};
use super::*;

/// Rays of a camera through a screen of n x n points, some of them beside the object.
fn rays(n: u32) -> impl Iterator<Item = Ray> {
    [(0.0, 0.0), (0.9, 0.5), (-2.5, -0.8), (1.6, 1.4)]
        .into_iter()
        .flat_map(move |(yaw_rad, pitch_rad)| {
            let camera = Camera {
                yaw_rad,
                pitch_rad,
                ..Camera::default()
            };
            (0..n * n).map(move |k| {
                let uv = ((k % n) as f32 + 0.5, (k / n) as f32 + 0.5);
                camera.ray((uv.0 / n as f32, uv.1 / n as f32), 1.0)
            })
        })
}

/// Worst distance from the surface and worst angle to its normal over all hits, for a body whose nearest point
/// and normal are `surface(point)`.
fn worst(object: Object, surface: impl Fn(DVec3) -> (f64, DVec3)) -> (f64, f64, usize) {
    let target = Target::new(object.mesh());
    let (mut off, mut turned, mut hits) = (0.0f64, 0.0f64, 0);
    for hit in rays(60).filter_map(|ray| target.cast(ray)) {
        let (distance, normal) = surface(hit.point.as_dvec3());
        off = off.max(distance.abs());
        turned = turned.max((hit.normal.as_dvec3() - normal).length());
        hits += 1;
    }
    (off, turned, hits)
}

#[test]
fn sphere_and_torus_are_hit_where_they_are() {
    let sphere = |p: DVec3| (p.length() - 1.0, p.normalize());
    let (off, turned, hits) = worst(Object::Sphere, sphere);
    println!("sphere: {off:e} off, normal {turned:e}, {hits} hits");
    // A chord of 90 / 64 degrees, across the diagonal of a quad: 2 (1 - cos(0.7 degrees)).
    assert!(
        (2e-5..2e-4).contains(&off) && turned < 2e-7,
        "{off:e} {turned:e}"
    );
    assert!(hits > 5000);

    let torus = |p: DVec3, minor: f64| {
        let ring = DVec3::new(p.x, p.y, 0.0).normalize() * TORUS_MAJOR;
        ((p - ring).length() - minor, (p - ring).normalize())
    };
    let (off, turned, hits) = worst(Object::Torus, |p| torus(p, TORUS_MINOR));
    println!("torus: {off:e} off, normal {turned:e}, {hits} hits");
    assert!(
        (1e-5..5e-4).contains(&off) && turned < 2e-3,
        "{off:e} {turned:e}"
    );
    assert!(hits > 2000);
    let (off, ..) = worst(Object::Torus, |p| torus(p, 0.33));
    assert!(off > 5e-3, "control");
}

#[test]
fn misses_and_hits_are_those_of_the_sphere() {
    let target = Target::new(Object::Sphere.mesh());
    let (mut hit, mut missed) = (0, 0);
    for ray in rays(80) {
        let closest = ray.origin.cross(ray.dir).length();
        // Between the polyhedron's inner and outer radius both answers are right.
        if closest < 1.0 - 2e-4 {
            let found = target.cast(ray).unwrap();
            let expected = -ray.origin.dot(ray.dir) - (1.0 - closest * closest).sqrt();
            // Towards the silhouette the depth error grows like that of the radius over the cosine.
            assert!((found.distance - expected).abs() < 2e-4 / (1.0 - closest * closest).sqrt());
            assert!(found.point.distance(ray.origin + found.distance * ray.dir) < 2e-6);
            hit += 1;
        } else if closest > 1.0 {
            assert!(target.cast(ray).is_none());
            missed += 1;
        }
    }
    assert!(hit > 5000 && missed > 5000, "{hit} {missed}");
}

#[test]
fn the_tree_finds_what_all_triangles_give() {
    for object in Object::ALL {
        let target = Target::new(object.mesh());
        let mut hits = 0;
        for ray in rays(12) {
            let shear = Shear::new(ray).unwrap();
            let slow = (target.triangles.iter())
                .filter_map(|&triangle| shear.cross(&target.mesh, triangle))
                .map(|crossing| crossing.distance)
                .reduce(f64::min);
            let fast = target
                .nearest(&shear, ray)
                .map(|crossing| crossing.distance);
            assert_eq!(fast, slow, "{object} {ray:?}");
            hits += u32::from(fast.is_some());
        }
        assert!(hits > 50, "{object}: {hits}");
        // Control: without half of its triangles the tree answers otherwise.
        let mut half = target.clone();
        half.nodes[0] = half.nodes[half.nodes[0].first as usize];
        let differ = rays(12)
            .filter(|&ray| half.cast(ray) != target.cast(ray))
            .count();
        assert!(differ > 10, "{object}: {differ}");
    }
}

#[test]
fn only_the_outside_is_ever_seen() {
    for object in Object::ALL {
        let seen = |target: &Target, ray: Ray| -> Option<bool> {
            let crossing = target.nearest(&Shear::new(ray)?, ray)?;
            let [a, b, c] = crossing
                .triangle
                .map(|i| Vec3::from(target.mesh.positions[i as usize]).as_dvec3());
            Some((b - a).cross(c - a).dot(ray.dir.as_dvec3()) < 0.0)
        };
        let target = Target::new(object.mesh());
        let behind = rays(150)
            .filter_map(|ray| seen(&target, ray))
            .filter(|front| !front)
            .count();
        assert_eq!(behind, 0, "{object}");
        // Control: with a tenth of the triangles gone, the inside is seen through the gaps.
        let mut torn = object.mesh();
        torn.indices.truncate(torn.indices.len() / 30 * 27);
        let torn = Target::new(torn);
        let behind = rays(150)
            .filter_map(|ray| seen(&torn, ray))
            .filter(|front| !front)
            .count();
        assert!(behind > 0, "{object}");
    }
}

#[test]
fn rays_through_edges_and_vertices_hit() {
    for object in [Object::Sphere, Object::RoundedCube] {
        let mesh = object.mesh();
        let target = Target::new(mesh.clone());
        let origin = Vec3::new(0.3, -0.2, 0.1);
        let (mut cast, mut missed) = (0, 0);
        for corners in mesh.triangles().step_by(3) {
            let [a, b, c] = corners.map(|i| Vec3::from(mesh.positions[i as usize]));
            let steep = mesh.normals[corners[0] as usize][2];
            for aim in [a, 0.5 * (a + b), 0.3 * b + 0.7 * c] {
                let mut origins = vec![origin, 3.0 * aim];
                if steep.abs() > 0.1 {
                    // Along an axis, where boxes have sides in the ray; not past the silhouette.
                    origins.push(aim + Vec3::new(0.0, 0.0, 7.0 * steep.signum()));
                }
                for origin in origins {
                    let dir = aim - origin;
                    cast += 1;
                    missed += u32::from(target.cast(Ray { origin, dir }).is_none());
                }
            }
        }
        assert_eq!(missed, 0, "{object}: {missed} of {cast}");
    }
    // Control: a pinhole of one triangle lets its ray through.
    let mut mesh = Object::Sphere.mesh();
    let [a, b, c] = [0, 1, 2].map(|k| Vec3::from(mesh.positions[mesh.indices[k] as usize]));
    mesh.indices.drain(..3);
    let ray = Ray {
        origin: Vec3::ZERO,
        dir: a + b + c,
    };
    assert!(Target::new(mesh).cast(ray).is_none());
    assert!(Target::new(Object::Sphere.mesh()).cast(ray).is_some());
}

#[test]
fn no_ray_and_no_mesh_is_too_strange() {
    let wild = [
        f32::NAN,
        f32::INFINITY,
        -f32::MAX,
        0.0,
        -0.0,
        1e-45,
        1e-20,
        1.0,
        1e30,
    ];
    let target = Target::new(Object::RoundedCube.mesh());
    for a in wild {
        for b in wild {
            for c in wild {
                for (origin, dir) in [
                    (Vec3::new(a, b, -3.0), Vec3::new(0.0, c, 1.0)),
                    (Vec3::new(0.0, a, -3.0), Vec3::new(b, 0.0, c)),
                ] {
                    if let Some(hit) = target.cast(Ray { origin, dir }) {
                        assert!(hit.point.is_finite() && hit.distance > 0.0);
                        assert!((hit.normal.length() - 1.0).abs() < 1e-6);
                    }
                }
            }
        }
    }
    // A direction of any length is the same ray; one along an axis through the sides of boxes too.
    for dir in [1e-45, 1e-20, 1.0, f32::MAX] {
        let ray = Ray {
            origin: Vec3::NEG_Z * 3.0,
            dir: Vec3::Z * dir,
        };
        let hit = target.cast(ray).unwrap();
        assert!((hit.normal - Vec3::NEG_Z).length() < 1e-6 && hit.distance < 3.0);
    }
    let strange = Mesh {
        positions: vec![
            [f32::NAN; 3],
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1e38; 3],
        ],
        normals: vec![[0.0; 3]; 2],
        indices: vec![0, 1, 2, 1, 2, 9, 1, 1, 1, 1, 2, 4, 1, 2, 3, 7],
    };
    let ray = Ray {
        origin: Vec3::new(0.2, 0.2, -1.0),
        dir: Vec3::Z,
    };
    for mesh in [strange, Mesh::default()] {
        let _ = Target::new(mesh).cast(ray);
    }
}
