//! Triangle meshes of the objects.

/// A surface of triangles with a normal at each vertex.
///
/// - `positions` in world units, within the unit ball around the origin; `normals` unit and outwards, one a position;
/// - `indices`: three a triangle (a, b, c), wound so that (b - a) x (c - a) points outwards. In the left-handed world
///   frame that is clockwise as seen from outside: the front face is `Cw` on the GPU;
/// - where two parts meet, vertices are repeated at bit-identical positions: there are no cracks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions, world units.
    pub positions: Vec<[f32; 3]>,
    /// Unit outward normals, as many as positions.
    pub normals: Vec<[f32; 3]>,
    /// Vertex numbers, three a triangle.
    pub indices: Vec<u32>,
}

impl Mesh {
    /// Adds a grid of `columns` x `rows` quads, each two triangles. `vertex(i, j)` with `i <= columns` and
    /// `j <= rows` gives position and unit normal; for the winding, d/di x d/dj must point outwards. Triangles with
    /// two corners in one place (at a pole) are left out.
    pub(super) fn add_grid(
        &mut self,
        columns: u32,
        rows: u32,
        mut vertex: impl FnMut(u32, u32) -> ([f32; 3], [f32; 3]),
    ) {
        let first = self.positions.len() as u32;
        for j in 0..=rows {
            for i in 0..=columns {
                let (position, normal) = vertex(i, j);
                self.add_vertex(position, normal);
            }
        }
        for j in 0..rows {
            for i in 0..columns {
                let a = first + j * (columns + 1) + i;
                let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
                self.add_triangle([a, b, c]);
                self.add_triangle([a, c, d]);
            }
        }
    }

    /// Adds one vertex and returns its number. Negative zeros become positive, so that equal positions have equal bits.
    pub(super) fn add_vertex(&mut self, position: [f32; 3], normal: [f32; 3]) -> u32 {
        self.positions.push(position.map(|x| x + 0.0));
        self.normals.push(normal);
        self.positions.len() as u32 - 1
    }

    /// Adds a triangle of existing vertices unless two of its corners coincide.
    pub(super) fn add_triangle(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|i| self.positions[i as usize]);
        if a != b && b != c && c != a {
            self.indices.extend(corners);
        }
    }

    /// The vertex numbers of each triangle.
    pub fn triangles(&self) -> impl ExactSizeIterator<Item = [u32; 3]> + '_ {
        self.indices.as_chunks::<3>().0.iter().copied()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::collections::HashMap;

    use glam::Vec3;

    use super::*;

    /// Edges of the surface, welded by position, that are not run through exactly once in each sense.
    pub(in super::super) fn open_edges(mesh: &Mesh) -> Vec<[Vec3; 2]> {
        let key = |i: u32| mesh.positions[i as usize].map(f32::to_bits);
        let mut count: HashMap<_, i32> = HashMap::new();
        for [a, b, c] in mesh.triangles() {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *count.entry((key(from), key(to))).or_default() += 1;
            }
        }
        let point = |bits: [u32; 3]| Vec3::from(bits.map(f32::from_bits));
        count
            .iter()
            .filter(|&(&(from, to), &n)| n != 1 || count.get(&(to, from)) != Some(&1))
            .map(|(&(from, to), _)| [point(from), point(to)])
            .collect()
    }

    /// Six times the enclosed volume, positive when the winding faces outwards.
    pub(in super::super) fn volume(mesh: &Mesh) -> f32 {
        mesh.triangles()
            .map(|corners| {
                let [a, b, c] = corners.map(|i| Vec3::from(mesh.positions[i as usize]));
                a.dot(b.cross(c)) / 6.0
            })
            .sum()
    }

    /// Laws of every mesh. Returns the smallest cosine between a triangle's normal and its vertices' normals.
    pub(in super::super) fn check(mesh: &Mesh) -> Result<f32, String> {
        if mesh.positions.len() != mesh.normals.len() || !mesh.indices.len().is_multiple_of(3) {
            return Err("lengths".into());
        }
        for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
            let (position, normal) = (Vec3::from(*position), Vec3::from(*normal));
            let inside = position.length() <= 1.0 + 2.0 * f32::EPSILON;
            let unit = (normal.length() - 1.0).abs() < 4.0 * f32::EPSILON;
            if !inside {
                return Err(format!("outside the unit ball: {position}"));
            }
            if !unit {
                return Err(format!("normal {normal} at {position} is not unit"));
            }
        }
        let mut worst = 1.0f32;
        for corners in mesh.triangles() {
            if corners.iter().any(|&i| i as usize >= mesh.positions.len()) {
                return Err("index out of range".into());
            }
            let [a, b, c] = corners.map(|i| Vec3::from(mesh.positions[i as usize]).as_dvec3());
            let Some(face) = (b - a).cross(c - a).try_normalize() else {
                return Err(format!("degenerate triangle at {a}"));
            };
            for i in corners {
                worst = worst.min(face.as_vec3().dot(Vec3::from(mesh.normals[i as usize])));
            }
        }
        Ok(worst)
    }

    fn tetrahedron() -> Mesh {
        let corners = [
            [0.5, 0.5, 0.5],
            [0.5, -0.5, -0.5],
            [-0.5, 0.5, -0.5],
            [-0.5, -0.5, 0.5],
        ];
        let mut mesh = Mesh::default();
        for corner in corners {
            mesh.add_vertex(corner, Vec3::from(corner).normalize().to_array());
        }
        for triangle in [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]] {
            mesh.add_triangle(triangle);
        }
        mesh
    }

    #[test]
    fn the_checks_can_fail() {
        let good = tetrahedron();
        assert!(check(&good).unwrap() > 0.3 && open_edges(&good).is_empty() && volume(&good) > 0.0);

        let mut holed = good.clone();
        holed.indices.truncate(9);
        assert_eq!(open_edges(&holed).len(), 3);

        let mut flipped = good.clone();
        flipped.indices.swap(0, 1);
        assert!(check(&flipped).unwrap() < 0.0 && !open_edges(&flipped).is_empty());

        let mut long = good.clone();
        long.normals[0] = [0.577, 0.577, 0.578];
        assert!(check(&long).is_err());

        let mut inside_out = good;
        inside_out
            .indices
            .as_chunks_mut::<3>()
            .0
            .iter_mut()
            .for_each(|t| t.reverse());
        assert!(volume(&inside_out) < 0.0 && open_edges(&inside_out).is_empty());
    }
}
