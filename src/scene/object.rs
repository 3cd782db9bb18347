//! The objects on which an environment is mirrored.

use std::f64::consts::{FRAC_PI_4, TAU};
use std::fmt;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{Mesh, teapot};

/// A closed body around the origin, within the unit ball.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Object {
    /// The unit sphere: shows nearly every direction at once.
    #[default]
    Sphere,
    /// A ring around +z, its hole towards the default eye: every direction comes twice.
    Torus,
    /// A cube with rounded edges and corners: flat mirrors next to strongly curved ones.
    RoundedCube,
    /// Newell's teapot, spout to +x: creases, saddles, a familiar shape.
    Teapot,
}

/// Distance from the torus' centre to the middle of its tube; with [`TORUS_MINOR`] it reaches the unit sphere.
pub const TORUS_MAJOR: f64 = 1.0 - TORUS_MINOR;
/// Radius of the torus' tube.
pub const TORUS_MINOR: f64 = 0.34;
/// Radius of the rounded cube's edges and corners.
pub const CUBE_ROUNDING: f64 = 0.2;

/// The density of [`Object::mesh`], to which the numbers of steps below belong.
pub const FULL_DENSITY: u32 = 32;

/// Quads in 45 degrees of the sphere. An edge then spans 90 / 64 degrees and its middle lies 1 - cos(0.7 degrees) =
/// 7.5e-5 below the sphere: a tenth of a pixel on a disc of 2000 pixels across.
const SPHERE_STEPS: u32 = 32;
/// Quads in 45 degrees of the rounded cube: the rounding is a fifth of the sphere's radius and needs half the steps.
const CUBE_STEPS: u32 = 16;
/// Quads around the torus and around its tube: 1.9 and 3.75 degrees, 1.3e-4 and 1.8e-4 below the surface.
const TORUS_STEPS: [u32; 2] = [192, 96];

impl Object {
    /// Every object, in the order of menus.
    pub const ALL: [Self; 4] = [Self::Sphere, Self::Torus, Self::RoundedCube, Self::Teapot];

    /// The English name, lower case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Torus => "torus",
            Self::RoundedCube => "rounded cube",
            Self::Teapot => "teapot",
        }
    }

    /// Builds the surface at [`FULL_DENSITY`]: some ten thousand triangles, some milliseconds; build it once.
    #[must_use]
    pub fn mesh(self) -> Mesh {
        self.mesh_at(FULL_DENSITY)
    }

    /// The surface with coarser triangles, still a closed body of the same size: `density` from 1 to [`FULL_DENSITY`]
    /// (others are clamped) is in proportion to the quads along a side.
    #[must_use]
    pub fn mesh_at(self, density: u32) -> Mesh {
        let steps = |full: u32, least: u32| steps_at(density, full, least);
        match self {
            Self::Sphere => rounded_cube(1.0, steps(SPHERE_STEPS, 1)),
            Self::Torus => {
                let [around, across] = TORUS_STEPS;
                // Fewer around would leave no hole, fewer across would cut far into the tube.
                torus([steps(around, 6), steps(across, 4)])
            }
            Self::RoundedCube => rounded_cube(CUBE_ROUNDING, steps(CUBE_STEPS, 1)),
            // With one step each half of the handle would be the same flat band.
            Self::Teapot => teapot::mesh(steps(teapot::STEPS, 2)),
        }
    }
}

impl fmt::Display for Object {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Steps at a density, of `full` at the full one.
fn steps_at(density: u32, full: u32, least: u32) -> u32 {
    (full * density.clamp(1, FULL_DENSITY) / FULL_DENSITY).max(least)
}

/// All points at `radius` from a cube whose corners lie at 1 - `radius` from the origin: a sphere for radius 1.
///
/// Each face is a grid of gnomonic coordinates with equal angles, as on an equi-angular cube map: no poles, triangles
/// of nearly one size, and the normal interpolated over a chord of the sphere is exactly the normal of the sphere.
fn rounded_cube(radius: f64, steps: u32) -> Mesh {
    let core = (1.0 - radius) / 3f64.sqrt();
    // A station is the core's coordinate and the normal's gnomonic coordinate; exactly +-1 at the border, so that
    // neighbouring faces meet in the same bits. Between the two roundings lies the flat part.
    let rounding = |i: u32| {
        if i == steps {
            1.0
        } else {
            (FRAC_PI_4 * f64::from(i) / f64::from(steps)).tan()
        }
    };
    let low = (0..=steps).rev().map(|i| (-core, -rounding(i)));
    let high = (u32::from(core == 0.0)..=steps).map(|i| (core, rounding(i)));
    let stations: Vec<(f64, f64)> = low.chain(high).collect();
    let quads = stations.len() as u32 - 1;

    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let (mut first, mut second) = ((axis + 1) % 3, (axis + 2) % 3);
            if sign < 0.0 {
                (first, second) = (second, first); // first x second points outwards
            }
            mesh.add_grid(quads, quads, |i, j| {
                let (mut middle, mut normal) = ([0.0; 3], [0.0; 3]);
                (middle[axis], normal[axis]) = (sign * core, sign);
                (middle[first], normal[first]) = stations[i as usize];
                (middle[second], normal[second]) = stations[j as usize];
                let normal = DVec3::from(normal).normalize();
                let position = DVec3::from(middle) + radius * normal;
                (position.as_vec3().to_array(), normal.as_vec3().to_array())
            });
        }
    }
    mesh
}

fn torus([around, across]: [u32; 2]) -> Mesh {
    // The last vertex of a turn is the first one again, in the same bits.
    let turn = |i: u32, n: u32| (TAU * f64::from(i % n) / f64::from(n)).sin_cos();
    let mut mesh = Mesh::default();
    mesh.add_grid(around, across, |i, j| {
        let (sin_ring, cos_ring) = turn(i, around);
        let (sin_tube, cos_tube) = turn(j, across);
        let outwards = DVec3::new(cos_ring, sin_ring, 0.0);
        let normal = cos_tube * outwards + sin_tube * DVec3::Z;
        let position = TORUS_MAJOR * outwards + TORUS_MINOR * normal;
        (position.as_vec3().to_array(), normal.as_vec3().to_array())
    });
    mesh
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::super::mesh::tests::{check, open_edges, volume};
    use super::*;

    #[test]
    fn every_mesh_keeps_the_laws() {
        // Smallest cosine between face and vertex normals: observed, and the budget beside it. The teapot's is at a
        // crease-free but strongly bent place, the spout's lip.
        for (object, budget) in [
            (Object::Sphere, 0.999),
            (Object::Torus, 0.998),
            (Object::RoundedCube, 0.998),
            (Object::Teapot, 0.8),
        ] {
            let mesh = object.mesh();
            let worst = check(&mesh).unwrap();
            println!(
                "{object}: {} vertices, {} triangles, worst cosine {worst}, volume {}",
                mesh.positions.len(),
                mesh.indices.len() / 3,
                volume(&mesh)
            );
            assert!(worst > budget, "{object}: {worst}");
            let reach = mesh
                .positions
                .iter()
                .map(|&p| glam::Vec3::from(p).length())
                .fold(0.0, f32::max);
            assert!(reach > 0.9999, "{object} fills only {reach} of the ball");
        }
    }

    /// Largest angle between the normals of a triangle and of its corners that the steps allow, in radians. A plane through
    /// three corners is turned by no more than half the diagonal of its quad, measured in normals; on a face of the sphere,
    /// whose quads are sheared towards the corners, by no more than one step.
    fn largest_turn_rad(object: Object, density: u32) -> Option<f64> {
        let steps = |full, least| f64::from(steps_at(density, full, least));
        match object {
            Object::Sphere => Some(FRAC_PI_4 / steps(SPHERE_STEPS, 1)),
            Object::RoundedCube => Some(FRAC_PI_4 / steps(CUBE_STEPS, 1)),
            Object::Torus => {
                let [around, across] = TORUS_STEPS;
                Some(0.5 * f64::hypot(TAU / steps(around, 6), TAU / steps(across, 4)))
            }
            // The rim and the lip turn by half a circle within a patch.
            Object::Teapot => None,
        }
    }

    #[test]
    fn every_density_keeps_the_laws() {
        for object in Object::ALL {
            assert_eq!(object.mesh_at(FULL_DENSITY), object.mesh());
            assert_eq!(object.mesh_at(0), object.mesh_at(1));
            assert_eq!(object.mesh_at(u32::MAX), object.mesh());
            let mut triangles = 0;
            for density in [1, 2, 3, 7, 8, 13, 31, 32] {
                let mesh = object.mesh_at(density);
                let worst = f64::from(check(&mesh).unwrap());
                if let Some(budget) = largest_turn_rad(object, density) {
                    let turn = worst.acos();
                    assert!(
                        (0.25 * budget..1.0001 * budget).contains(&turn),
                        "{object} {density}: {turn}, allowed {budget}"
                    );
                    assert_eq!(open_edges(&mesh).len(), 0, "{object} {density}");
                }
                assert!(mesh.indices.len() >= triangles, "{object} {density}");
                triangles = mesh.indices.len();
            }
            // Control: half the density is beyond what the full one may do.
            let half = f64::from(check(&object.mesh_at(16)).unwrap()).acos();
            assert!(largest_turn_rad(object, 32).is_none_or(|budget| half > budget));
        }
    }

    #[test]
    fn the_coarse_teapot_is_the_same_body() {
        // A surface of chords misses volume as the square of its steps: 0.41 / steps^2 at the finest two.
        let volume_at = |density| f64::from(volume(&Object::Teapot.mesh_at(density)));
        let steps = |density| f64::from(steps_at(density, teapot::STEPS, 2));
        let full = volume_at(FULL_DENSITY) + 0.41 / steps(FULL_DENSITY).powi(2);
        for density in [1, 2, 3, 7, 8, 13, 31, 32] {
            let missing = (full - volume_at(density)) * steps(density).powi(2);
            assert!((0.38..0.44).contains(&missing), "{density}: {missing}");
            let open = open_edges(&Object::Teapot.mesh_at(density)).len();
            assert_eq!(open as f64, 6.0 * steps(density), "{density}");
        }
        // Control: with the full mesh's steps the coarse one would miss far more.
        assert!((full - volume_at(8)) * steps(16).powi(2) > 0.5);
    }

    #[test]
    fn closed_bodies_have_no_open_edge() {
        for object in [Object::Sphere, Object::Torus, Object::RoundedCube] {
            let mut mesh = object.mesh();
            assert_eq!(open_edges(&mesh).len(), 0, "{object}");
            // Controls: one vertex moved by the smallest step, one triangle lost.
            let x = &mut mesh.positions[7][0];
            *x = x.next_up();
            assert!(!open_edges(&mesh).is_empty(), "{object}");
        }
    }

    #[test]
    fn volumes_are_those_of_the_bodies() {
        let edge = 2.0 * (1.0 - CUBE_ROUNDING) / 3f64.sqrt();
        let r = CUBE_ROUNDING;
        // Steiner: core, six slabs, twelve quarter cylinders, eight eighths of a ball.
        let cube = edge.powi(3)
            + 6.0 * edge.powi(2) * r
            + 3.0 * PI * edge * r.powi(2)
            + 4.0 / 3.0 * PI * r.powi(3);
        for (object, expected) in [
            (Object::Sphere, 4.0 / 3.0 * PI),
            (
                Object::Torus,
                2.0 * PI * PI * TORUS_MAJOR * TORUS_MINOR.powi(2),
            ),
            (Object::RoundedCube, cube),
        ] {
            let missing = 1.0 - f64::from(volume(&object.mesh())) / expected;
            println!("{object}: {missing:e} of the volume is missing");
            assert!((1e-6..2e-3).contains(&missing), "{object}: {missing:e}");
        }
    }

    #[test]
    fn normals_are_the_analytic_ones() {
        for (position, normal) in Object::Sphere
            .mesh()
            .positions
            .iter()
            .zip(Object::Sphere.mesh().normals)
        {
            assert_eq!(*position, normal.map(|x| x + 0.0));
        }
        let gap = |p: &[f32; 3], n: &[f32; 3], minor: f64| {
            let p = DVec3::from(p.map(f64::from));
            let ring = DVec3::new(p.x, p.y, 0.0).normalize() * (1.0 - minor);
            ((p - ring) / minor - DVec3::from(n.map(f64::from))).length()
        };
        let mesh = Object::Torus.mesh();
        let worst = |minor| {
            mesh.positions
                .iter()
                .zip(&mesh.normals)
                .map(|(p, n)| gap(p, n, minor))
                .fold(0.0, f64::max)
        };
        assert!(worst(TORUS_MINOR) < 4e-7, "{:e}", worst(TORUS_MINOR));
        assert!(worst(0.3) > 1e-2, "control");
    }

    #[test]
    fn names_are_stable() {
        let saved = serde_json::to_string(&Object::ALL).unwrap();
        assert_eq!(saved, r#"["sphere","torus","rounded-cube","teapot"]"#);
        assert_eq!(
            serde_json::from_str::<[Object; 4]>(&saved).unwrap(),
            Object::ALL
        );
        assert!(serde_json::from_str::<Object>(r#""kettle""#).is_err());
    }
}
