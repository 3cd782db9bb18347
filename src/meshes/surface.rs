//! The model as one surface: welded by position, its edges, and which way is out.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use super::counted;
use super::raw::{Corner, Raw};

/// Triangles over welded points, in the world's frame: (b - a) x (c - a) is the front.
#[derive(Debug)]
pub(super) struct Surface {
    /// Each place once.
    pub points: Vec<Vec3>,
    /// Unit, as given by the file.
    pub normals: Vec<Vec3>,
    /// Corners whose position is a number in `points`; a normal only where the given one is usable.
    pub triangles: Vec<[Corner; 3]>,
}

impl Surface {
    /// Welds corners at bit-identical points and takes the model into the left-handed frame: the points are there
    /// already, the normals follow and the winding is reversed.
    pub fn welded(points: &[Vec3], raw: Raw) -> Self {
        let to_world = |normal: Vec3| {
            let normal = normal.as_dvec3() * DVec3::new(1.0, 1.0, -1.0);
            normal.try_normalize().map(|unit| unit.as_vec3())
        };
        let given: Vec<Option<Vec3>> = raw.normals.into_iter().map(to_world).collect();
        let mut places = HashMap::new();
        let mut welded = Vec::new();
        let mut place = |corner: Corner| {
            let point = points[corner.position as usize];
            let number = *places
                .entry(point.to_array().map(f32::to_bits))
                .or_insert_with(|| {
                    welded.push(point);
                    welded.len() as u32 - 1
                });
            let is_usable = |&n: &u32| given[n as usize].is_some();
            Corner {
                position: number,
                normal: corner.normal.filter(is_usable),
            }
        };
        let triangles = raw.triangles.into_iter();
        let triangles = triangles.map(|[a, b, c]| [a, c, b].map(&mut place));
        Self {
            triangles: triangles.collect(),
            points: welded,
            normals: given.into_iter().map(Option::unwrap_or_default).collect(),
        }
    }

    /// The corners' points.
    pub fn corners(&self, triangle: &[Corner; 3]) -> [DVec3; 3] {
        triangle.map(|corner| self.points[corner.position as usize].as_dvec3())
    }

    /// Twice the area along the front normal, of every triangle.
    pub fn areas(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.triangles.iter().map(|triangle| {
            let [a, b, c] = self.corners(triangle);
            (b - a).cross(c - a)
        })
    }

    /// All edges, the sides of each together.
    pub fn edges(&self) -> Edges {
        let mut sides: Vec<Side> = Vec::with_capacity(3 * self.triangles.len());
        for (t, triangle) in self.triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|corner| corner.position);
            sides.extend([(a, b), (b, c), (c, a)].map(|(from, to)| Side {
                ends: (from.min(to), from.max(to)),
                triangle: t as u32,
                runs_up: from < to,
            }));
        }
        sides.sort_unstable_by_key(|side| (side.ends, side.triangle));
        Edges { sides }
    }

    /// Turns the surface so that its front is outside. Says what it turned.
    ///
    /// - Closed: the enclosed volume tells. The normals follow the front when most of the area is against them.
    /// - Open: nothing tells but the given normals, when most of the area is against them.
    pub fn orient(&mut self, edges: &Edges) -> Option<&'static str> {
        let is_closed = edges.is_closed();
        if is_closed && self.volume() < 0.0 {
            self.reverse();
            if self.agreement() < 0.0 {
                self.negate_normals();
            }
            return Some("the model was inside out and was turned");
        }
        if self.agreement() >= 0.0 {
            return None;
        }
        if is_closed {
            self.negate_normals();
            Some("the normals pointed inwards and were turned")
        } else {
            self.reverse();
            Some("the faces were wound against their normals and were turned")
        }
    }

    /// Six times the enclosed volume, positive when the front is outside.
    fn volume(&self) -> f64 {
        let triangles = self.triangles.iter();
        triangles
            .map(|triangle| {
                let [a, b, c] = self.corners(triangle);
                a.dot(b.cross(c))
            })
            .sum()
    }

    /// Whether the given normals are on the front: positive when they are, over all of the area.
    fn agreement(&self) -> f64 {
        let sides = self.areas().zip(&self.triangles).map(|(area, triangle)| {
            let given = triangle.iter().filter_map(|corner| corner.normal);
            let given: DVec3 = given.map(|n| self.normals[n as usize].as_dvec3()).sum();
            area.dot(given)
        });
        sides.sum()
    }

    /// Edges stay edges: both sides of each run the other way.
    fn reverse(&mut self) {
        for triangle in &mut self.triangles {
            triangle.swap(1, 2);
        }
    }

    fn negate_normals(&mut self) {
        for normal in &mut self.normals {
            *normal = -*normal;
        }
    }
}

/// One triangle's side of an edge.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// The edge's points, the smaller number first.
    ends: (u32, u32),
    /// Number of the triangle.
    triangle: u32,
    /// From the smaller number to the larger.
    runs_up: bool,
}

/// The sides of all edges, edge by edge.
#[derive(Debug)]
pub(super) struct Edges {
    sides: Vec<Side>,
}

impl Edges {
    fn each(&self) -> impl Iterator<Item = &[Side]> {
        self.sides.chunk_by(|a, b| a.ends == b.ends)
    }

    /// Sides of an edge in excess of those that run the other way.
    fn excess(edge: &[Side]) -> usize {
        let up = edge.iter().filter(|side| side.runs_up).count();
        up.abs_diff(edge.len() - up)
    }

    /// Whether every edge is run through as often one way as the other: the surface encloses a volume.
    fn is_closed(&self) -> bool {
        self.each().all(|edge| Self::excess(edge) == 0)
    }

    /// The triangles and the points of each edge that joins exactly two triangles, front to front.
    pub fn joined(&self) -> impl Iterator<Item = ([u32; 2], (u32, u32))> {
        self.each().filter_map(|edge| match edge {
            [a, b] if a.runs_up != b.runs_up => Some(([a.triangle, b.triangle], a.ends)),
            _ => None,
        })
    }

    /// What is unusual about them.
    pub fn notes(&self) -> Vec<String> {
        let (mut open, mut against) = (0, 0);
        for edge in self.each() {
            match edge.len() {
                2 => against += usize::from(Self::excess(edge) != 0),
                _ => open += usize::from(Self::excess(edge) != 0),
            }
        }
        let mut notes = Vec::new();
        if open > 0 {
            let edges = counted(open, "edge", "edges");
            notes.push(format!("the surface is open at {edges}"));
        }
        if against > 0 {
            let edges = counted(against, "edge joins", "edges join");
            notes.push(format!("{edges} triangles that face opposite ways"));
        }
        notes
    }
}
