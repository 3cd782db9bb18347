//! What the pointer hits: rays against a mesh.
//!
//! The test of one triangle shears space so that the ray runs along an axis through the origin (after Woop, Benthin,
//! Wald: Watertight Ray/Triangle Intersection, JCGT 2013). A sheared vertex is rounded once, to f32, alike for all
//! triangles that share it; products of f32 are exact in f64, so the three edge tests have exact signs and a ray
//! through a common edge or vertex hits at least one of its triangles. A tree of boxes finds the few triangles worth
//! the test; its boxes are widened by more than the rounding of the sheared vertices.

use glam::{DVec3, Vec3};

use super::{Mesh, Ray};

/// Where a ray meets a surface first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The point on the mesh, world units.
    pub point: Vec3,
    /// The unit outward normal there, interpolated from the vertices as the renderer does. Close to a silhouette it
    /// may point a little away from the viewer, as there.
    pub normal: Vec3,
    /// From the ray's origin, in world units, positive.
    pub distance: f32,
}

/// A mesh prepared for many rays.
#[derive(Clone, Debug)]
pub struct Target {
    mesh: Mesh,
    /// Sound triangles in the order of the leaves.
    triangles: Vec<[u32; 3]>,
    nodes: Vec<Node>,
    /// Largest coordinate of any vertex: the scale of rounding.
    reach: f32,
}

/// A box around `count` triangles from `first` on; or, with `count` 0, around two nodes: the next one and `first`.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: Vec3,
    high: Vec3,
    first: u32,
    count: u32,
}

/// Triangles in a leaf: fewer cost more boxes than they save tests.
const LEAF: usize = 4;
/// Halving 2^32 triangles never goes deeper.
const MAX_DEPTH: usize = 33;

/// A ray and a triangle in f64, before the normal is looked up.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    triangle: [u32; 3],
    /// Barycentric, sum 1.
    weights: [f64; 3],
    distance: f64,
}

/// A ray turned into the shear that lays it along the axis `z`.
struct Shear {
    origin: DVec3,
    axes: [usize; 3],
    slope: [f64; 2],
    /// Distance along the ray for one unit along the axis.
    stretch: f64,
}

impl Shear {
    /// `None` when the ray has no direction or is not finite.
    fn new(ray: Ray) -> Option<Self> {
        let (origin, dir) = (ray.origin.as_dvec3(), ray.dir.as_dvec3());
        if !(origin.is_finite() && dir.is_finite()) || dir == DVec3::ZERO {
            return None;
        }
        let z = dir.abs().max_position();
        let (x, y) = ((z + 1) % 3, (z + 2) % 3);
        Some(Self {
            origin,
            axes: [x, y, z],
            slope: [dir[x] / dir[z], dir[y] / dir[z]],
            stretch: dir.length() / dir[z],
        })
    }

    /// The vertex with the ray as third axis; the first two coordinates rounded to f32.
    fn apply(&self, position: [f32; 3]) -> [f64; 3] {
        let p = Vec3::from(position).as_dvec3() - self.origin;
        let [x, y, z] = self.axes.map(|axis| p[axis]);
        let round = |value: f64| f64::from(value as f32);
        [
            round(x - self.slope[0] * z),
            round(y - self.slope[1] * z),
            z,
        ]
    }

    /// Where the ray crosses the triangle, from either side, in front of its origin.
    fn cross(&self, mesh: &Mesh, triangle: [u32; 3]) -> Option<Crossing> {
        let [a, b, c] = triangle.map(|i| self.apply(mesh.positions[i as usize]));
        let edge = |p: [f64; 3], q: [f64; 3]| p[0] * q[1] - p[1] * q[0];
        let areas = [edge(b, c), edge(c, a), edge(a, b)];
        let total: f64 = areas.iter().sum();
        let inside = areas.iter().all(|&e| e >= 0.0) || areas.iter().all(|&e| e <= 0.0);
        if !inside || !total.is_finite() || total == 0.0 {
            return None;
        }
        let weights = areas.map(|e| e / total);
        let along = weights[0] * a[2] + weights[1] * b[2] + weights[2] * c[2];
        let distance = along * self.stretch;
        (distance.is_finite() && distance > 0.0).then_some(Crossing {
            triangle,
            weights,
            distance,
        })
    }
}

impl Target {
    /// Builds the tree. Triangles with a missing or non-finite vertex are never hit.
    #[must_use]
    pub fn new(mesh: Mesh) -> Self {
        let corner = |i: u32| mesh.positions.get(i as usize).copied().map(Vec3::from);
        let mut boxed: Vec<([u32; 3], Vec3, Vec3)> = mesh
            .triangles()
            .filter_map(|triangle| {
                let [a, b, c] = triangle.map(corner);
                let (a, b, c) = (a?, b?, c?);
                let sound = a.is_finite() && b.is_finite() && c.is_finite();
                sound.then(|| (triangle, a.min(b).min(c), a.max(b).max(c)))
            })
            .collect();
        let mut nodes = Vec::with_capacity(boxed.len());
        if !boxed.is_empty() {
            build(&mut nodes, &mut boxed, 0);
        }
        let reach = nodes.first().map_or(0.0, |root| {
            root.low.abs().max(root.high.abs()).max_element()
        });
        let triangles = boxed.into_iter().map(|(triangle, ..)| triangle).collect();
        Self {
            mesh,
            triangles,
            nodes,
            reach,
        }
    }

    /// The mesh that is hit.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The first point that `ray` meets; `None` when it misses, is not finite or has no direction. The direction may
    /// have any length.
    ///
    /// ```
    /// use glam::Vec3;
    /// use sixfold::scene::{Camera, Object, Target};
    ///
    /// let sphere = Target::new(Object::Sphere.mesh());
    /// let camera = Camera::default();
    /// let hit = sphere.cast(camera.ray((0.5, 0.5), 1.0)).unwrap();
    /// assert!((hit.point - Vec3::NEG_Z).length() < 1e-4);
    /// assert!((hit.normal - Vec3::NEG_Z).length() < 1e-4);
    /// assert!(sphere.cast(camera.ray((0.01, 0.01), 1.0)).is_none());
    /// ```
    #[must_use]
    pub fn cast(&self, ray: Ray) -> Option<Hit> {
        let shear = Shear::new(ray)?;
        let crossing = self.nearest(&shear, ray)?;
        let blend = |values: &[[f32; 3]]| -> Option<DVec3> {
            let mut sum = DVec3::ZERO;
            for (i, weight) in crossing.triangle.into_iter().zip(crossing.weights) {
                sum += weight * Vec3::from(*values.get(i as usize)?).as_dvec3();
            }
            Some(sum)
        };
        let face = || {
            let [a, b, c] = crossing
                .triangle
                .map(|i| Vec3::from(self.mesh.positions[i as usize]).as_dvec3());
            (b - a).cross(c - a).try_normalize()
        };
        Some(Hit {
            point: blend(&self.mesh.positions)?.as_vec3(),
            normal: blend(&self.mesh.normals)
                .and_then(DVec3::try_normalize)
                .or_else(face)?
                .as_vec3(),
            distance: crossing.distance as f32,
        })
    }

    fn nearest(&self, shear: &Shear, ray: Ray) -> Option<Crossing> {
        // One rounding of a sheared vertex is at most 2^-24 of its size, below sqrt(3) (reach + |origin|) on each
        // of two axes; sixteen times as much costs nothing.
        let pad = Vec3::splat(16.0 * f32::EPSILON * (self.reach + ray.origin.abs().max_element()));
        // Scaled to its largest component: only the order along the ray matters, and 1 / dir stays finite or infinite.
        let inverse = ray.dir.abs().max_element() / ray.dir.as_dvec3().as_vec3();
        let entry = |node: &Node| {
            let low = (node.low - pad - ray.origin) * inverse;
            let high = (node.high + pad - ray.origin) * inverse;
            let (mut near, mut far) = (0.0f32, f32::INFINITY);
            for axis in 0..3 {
                // 0 times infinity: the ray runs within this side of the box, which then says nothing.
                if !low[axis].is_nan() && !high[axis].is_nan() {
                    near = near.max(low[axis].min(high[axis]));
                    far = far.min(low[axis].max(high[axis]));
                }
            }
            (near <= far * (1.0 + 4.0 * f32::EPSILON)).then_some(near)
        };
        // Distance per unit of the boxes' parameter.
        let unit = shear.stretch.abs();

        let mut best: Option<Crossing> = None;
        let mut open = [(0u32, 0.0f32); MAX_DEPTH + 1];
        let mut count = 0;
        if let Some(near) = self.nodes.first().and_then(entry) {
            open[0] = (0, near);
            count = 1;
        }
        while count > 0 {
            count -= 1;
            let (index, near) = open[count];
            // The entry is widened like the exit.
            let near = f64::from(near) * (1.0 - 4.0 * f64::from(f32::EPSILON)) * unit;
            if best.is_some_and(|best| best.distance < near) {
                continue;
            }
            let node = self.nodes[index as usize];
            if node.count > 0 {
                let range = node.first as usize..(node.first + node.count) as usize;
                for &triangle in &self.triangles[range] {
                    if let Some(crossing) = shear.cross(&self.mesh, triangle)
                        && best.is_none_or(|best| crossing.distance < best.distance)
                    {
                        best = Some(crossing);
                    }
                }
                continue;
            }
            let mut push = |child: Option<(u32, f32)>| {
                if let Some(child) = child
                    && count < open.len()
                {
                    open[count] = child;
                    count += 1;
                }
            };
            // The nearer child last, so that it is opened first.
            let visit = |i: u32| entry(&self.nodes[i as usize]).map(|near| (i, near));
            let (left, right) = (visit(index + 1), visit(node.first));
            let left_first =
                left.map_or(f32::INFINITY, |c| c.1) <= right.map_or(f32::INFINITY, |c| c.1);
            let (nearer, farther) = if left_first {
                (left, right)
            } else {
                (right, left)
            };
            push(farther);
            push(nearer);
        }
        best
    }
}

/// Adds the node over `boxed`, whose first triangle has the number `first`, and all below it. Halves at the median
/// along the longest side of the box, so the depth is the logarithm of the number of triangles.
fn build(nodes: &mut Vec<Node>, boxed: &mut [([u32; 3], Vec3, Vec3)], first: u32) {
    let low = boxed.iter().fold(Vec3::INFINITY, |low, b| low.min(b.1));
    let high = boxed
        .iter()
        .fold(Vec3::NEG_INFINITY, |high, b| high.max(b.2));
    let index = nodes.len();
    let count = boxed.len() as u32;
    nodes.push(Node {
        low,
        high,
        first,
        count,
    });
    if boxed.len() <= LEAF {
        return;
    }
    let axis = (high - low).max_position();
    let middle = boxed.len() / 2;
    // Halved before the sum, which could overflow.
    let centre = |b: &([u32; 3], Vec3, Vec3)| 0.5 * b.1[axis] + 0.5 * b.2[axis];
    boxed.select_nth_unstable_by(middle, |a, b| centre(a).total_cmp(&centre(b)));
    let (left, right) = boxed.split_at_mut(middle);
    build(nodes, left, first);
    nodes[index].first = nodes.len() as u32;
    nodes[index].count = 0;
    build(nodes, right, first + middle as u32);
}

#[cfg(test)]
mod tests {
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
                assert!(
                    (found.distance - expected).abs() < 2e-4 / (1.0 - closest * closest).sqrt()
                );
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
}
