//! The vertices of the icosahedron and of its dual dodecahedron as crosses: 32 marks of equal size, spread over the whole
//! sphere, that show how each mapping stretches (the paper's Figure 10 and those after it).

use super::{blend, coverage};
use crate::math::Vec3;

const PAPER: [f32; 3] = [0.85; 3];
const RED: [f32; 3] = [0.70, 0.012, 0.012];
const BLUE: [f32; 3] = [0.012, 0.05, 0.65];

/// Half of an arm, tip to centre, and half of its width.
const HALF_LENGTH_RAD: f64 = 5.0 * std::f64::consts::PI / 180.0;
const HALF_WIDTH_RAD: f64 = 0.6 * std::f64::consts::PI / 180.0;

/// Golden ratio.
const PHI: f64 = std::f64::consts::GOLDEN_RATIO;

/// The 12 unit vertices of the icosahedron: (0, ±1, ±phi) and its cyclic turns.
pub fn icosahedron_vertices() -> Vec<Vec3<f64>> {
    let mut vertices = Vec::with_capacity(12);
    for turn in 0..3 {
        for (one, phi) in [(1.0, PHI), (-1.0, PHI), (1.0, -PHI), (-1.0, -PHI)] {
            let mut vertex = [0.0; 3];
            vertex[(turn + 1) % 3] = one;
            vertex[(turn + 2) % 3] = phi;
            vertices.push(Vec3::from_f64(vertex).normalized());
        }
    }
    vertices
}

/// The 20 unit vertices of the dual dodecahedron: the middles of the icosahedron's faces, (±1, ±1, ±1) and
/// (±1/phi, 0, ±phi) with its cyclic turns.
pub fn dodecahedron_vertices() -> Vec<Vec3<f64>> {
    let corners = icosahedron_vertices();
    // Neighbours are 63.4 degrees apart (cosine 1/sqrt 5), all others at least 116.6.
    let adjacent = |a: usize, b: usize| corners[a].dot(corners[b]) > 0.0;
    let mut vertices = Vec::with_capacity(20);
    for a in 0..corners.len() {
        for b in (0..a).filter(|&b| adjacent(a, b)) {
            for c in (0..b).filter(|&c| adjacent(a, c) && adjacent(b, c)) {
                vertices.push((corners[a] + corners[b] + corners[c]).normalized());
            }
        }
    }
    vertices
}

struct Cross {
    center: Vec3<f64>,
    east: Vec3<f64>,
    north: Vec3<f64>,
    color: [f32; 3],
}

pub(super) struct Crosses(Vec<Cross>);

impl Crosses {
    pub(super) fn new() -> Self {
        let colored = |vertices: Vec<Vec3<f64>>, color| {
            vertices.into_iter().map(move |center| {
                // No vertex lies on a pole. In the left-handed frame up x outwards points east.
                let east = Vec3::new(0.0, 1.0, 0.0).cross(center).normalized();
                Cross {
                    center,
                    east,
                    north: center.cross(east),
                    color,
                }
            })
        };
        let red = colored(icosahedron_vertices(), RED);
        Self(red.chain(colored(dodecahedron_vertices(), BLUE)).collect())
    }

    pub(super) fn color(&self, dir: Vec3<f64>, texel_rad: f64) -> [f32; 3] {
        // No two vertices are nearer than 37 degrees, so only one cross can be here.
        let reach = (HALF_LENGTH_RAD + HALF_WIDTH_RAD + texel_rad).cos();
        let Some(cross) = self.0.iter().find(|cross| dir.dot(cross.center) > reach) else {
            return PAPER;
        };
        let axis = dir.dot(cross.center);
        let (e, n) = (dir.dot(cross.east), dir.dot(cross.north));
        // Each arm lies along a great circle: the angle along it and the angle off it.
        let arm = |along: f64, off: f64| {
            let beyond = along.atan2(axis).abs() - HALF_LENGTH_RAD;
            coverage(off.abs().asin(), HALF_WIDTH_RAD, texel_rad)
                .min(coverage(beyond, 0.0, texel_rad))
        };
        blend(PAPER, cross.color, arm(e, n).max(arm(n, e)))
    }
}
