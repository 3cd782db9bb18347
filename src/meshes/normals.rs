//! Normals where the file has none, and the mesh made of all that.

use std::collections::HashMap;

use glam::DVec3;

use super::MOST_VERTICES;
use super::error::{MeshProblem, judge};
use super::surface::{Edges, Surface};
use crate::scene::Mesh;

/// Faces that meet at up to this angle between their normals are smooth there, others meet in a crease. A round form of
/// nine or more sides (360/9 = 40 degrees) reads as round; a hexagonal prism (60), an octahedron (70.5) and a cube (90) keep
/// their faces. glTF asks for flat normals where none are given; a mirror without a break teaches more about its map.
pub(super) const CREASE_DEG: f64 = 40.0;

/// The mesh, and how many of its vertices got a normal here. A vertex is repeated at creases and where the given normals
/// differ.
///
/// Around a point, faces that follow each other without a crease share one normal: the mean of theirs, weighted by their
/// angle there (Thürmer and Wüthrich, *Computing vertex normals from polygonal facets*, 1998), so that it does not
/// depend on how a face is cut into triangles.
pub(super) fn finished(surface: &Surface, edges: &Edges) -> Result<(Mesh, usize), MeshProblem> {
    let faces: Vec<DVec3> = surface.areas().map(DVec3::normalize_or_zero).collect();
    let all_given = surface.triangles.iter().flatten();
    let all_given = all_given.map(|corner| corner.normal).all(|n| n.is_some());
    let made = if all_given {
        Vec::new()
    } else {
        smooth(surface, edges, &faces)
    };

    /// Where a corner's normal comes from: corners at one place with one source are one vertex.
    #[derive(PartialEq, Eq, Hash)]
    enum Source {
        Given(u32),
        Smooth(u32),
        Face(u32),
    }
    let mut mesh = Mesh::default();
    let mut vertices = HashMap::new();
    let mut made_count = 0;
    for (t, triangle) in surface.triangles.iter().enumerate() {
        for (k, corner) in triangle.iter().enumerate() {
            let (source, normal) = match corner.normal {
                Some(n) => (Source::Given(n), surface.normals[n as usize].as_dvec3()),
                None => {
                    let (root, normal) = made[3 * t + k];
                    // A mean against its own face (on a needle's tip) would light it from behind.
                    if normal.dot(faces[t]) > 0.0 {
                        (Source::Smooth(root), normal)
                    } else {
                        (Source::Face(t as u32), faces[t])
                    }
                }
            };
            let is_made = !matches!(source, Source::Given(_));
            let vertex = *vertices
                .entry((corner.position, source))
                .or_insert_with(|| {
                    made_count += usize::from(is_made);
                    let point = surface.points[corner.position as usize];
                    mesh.positions.push(point.to_array());
                    mesh.normals.push(normal.as_vec3().to_array());
                    mesh.positions.len() as u32 - 1
                });
            mesh.indices.push(vertex);
        }
        let count = mesh.positions.len() as u64;
        judge("vertices, after the split at creases", count, MOST_VERTICES)?;
    }
    Ok((mesh, made_count))
}

/// For every corner (3 t + k): the number of its group and the group's unit normal, zero where there is none.
fn smooth(surface: &Surface, edges: &Edges, faces: &[DVec3]) -> Vec<(u32, DVec3)> {
    let least_cosine = CREASE_DEG.to_radians().cos();
    let mut groups = Groups::new(3 * faces.len());
    for ([a, b], ends) in edges.joined() {
        if faces[a as usize].dot(faces[b as usize]) < least_cosine {
            continue;
        }
        for place in [ends.0, ends.1] {
            let at_place = |t: u32| {
                let triangle = &surface.triangles[t as usize];
                let corner = triangle.iter().position(|c| c.position == place);
                3 * t + corner.unwrap_or_default() as u32
            };
            groups.join(at_place(a), at_place(b));
        }
    }
    let mut sums = vec![DVec3::ZERO; 3 * faces.len()];
    for (t, triangle) in surface.triangles.iter().enumerate() {
        let corners = surface.corners(triangle);
        for k in 0..3 {
            let [at, next, last] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
            // atan2 of sine and cosine keeps its digits for thin corners, where acos would lose them.
            let (u, v) = (next - at, last - at);
            let angle = u.cross(v).length().atan2(u.dot(v));
            sums[groups.root((3 * t + k) as u32) as usize] += faces[t] * angle;
        }
    }
    let corners = 0..3 * faces.len() as u32;
    let group = |corner| {
        let root = groups.root(corner);
        (root, sums[root as usize].normalize_or_zero())
    };
    corners.map(group).collect()
}

/// Disjoint sets of corners (union by order, with path halving).
struct Groups {
    parent: Vec<u32>,
}

impl Groups {
    fn new(count: usize) -> Self {
        Self {
            parent: (0..count as u32).collect(),
        }
    }

    fn root(&mut self, mut corner: u32) -> u32 {
        loop {
            let parent = self.parent[corner as usize];
            if parent == corner {
                return corner;
            }
            let above = self.parent[parent as usize];
            self.parent[corner as usize] = above;
            corner = above;
        }
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}
