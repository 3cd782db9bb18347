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
    /// The unit normal of the triangle itself, outwards by its winding.
    pub face_normal: Vec3,
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

    /// Largest coordinate of any vertex, world units: the scale of rounding.
    pub(super) fn reach(&self) -> f32 {
        self.reach
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
        let [a, b, c] = crossing
            .triangle
            .map(|i| Vec3::from(self.mesh.positions[i as usize]).as_dvec3());
        let face = (b - a).cross(c - a).try_normalize();
        let normal = blend(&self.mesh.normals).and_then(DVec3::try_normalize);
        Some(Hit {
            point: blend(&self.mesh.positions)?.as_vec3(),
            normal: normal.or(face)?.as_vec3(),
            face_normal: face.or(normal)?.as_vec3(),
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
mod tests;
