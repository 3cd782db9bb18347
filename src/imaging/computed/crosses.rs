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

impl Cross {
    /// Once around it, a point at least every half degree of an arm.
    fn outline(&self) -> Vec<Vec3<f64>> {
        /// Points along a side of an arm.
        const STEPS: u32 = 16;
        // On the plane that touches the sphere great circles are straight: an arm's sides are so far off its middle line, its end at its
        // length's tangent. `color` has the same sides at the end of the arm but for the square of the width.
        let [length, width] = [HALF_LENGTH_RAD, HALF_WIDTH_RAD].map(f64::tan);
        let on = |e: f64, n: f64| (self.center + self.east * e + self.north * n).normalized();
        let mut outline = Vec::new();
        for quarter in 0..4 {
            let turn = |e: f64, n: f64| match quarter {
                0 => on(e, n),
                1 => on(-n, e),
                2 => on(-e, -n),
                _ => on(n, -e),
            };
            // From the inner corner out, across the end, and back to the next inner corner.
            let corners = [
                [width, -width],
                [length, -width],
                [length, width],
                [width, width],
            ];
            for side in corners.windows(2) {
                for k in 0..STEPS {
                    let t = f64::from(k) / f64::from(STEPS);
                    let along = |i: usize| side[0][i] + (side[1][i] - side[0][i]) * t;
                    outline.push(turn(along(0), along(1)));
                }
            }
        }
        outline.extend(outline.first().copied());
        outline
    }
}

/// The outlines of all crosses as closed lines of unit directions; true for those of the icosahedron, which are red.
pub fn cross_outlines() -> Vec<(bool, Vec<Vec3<f64>>)> {
    Crosses::new().outlines().collect()
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

    /// The outline of each cross as unit directions, closed, and true for those of the icosahedron.
    fn outlines(&self) -> impl Iterator<Item = (bool, Vec<Vec3<f64>>)> {
        self.0
            .iter()
            .map(|cross| (cross.color == RED, cross.outline()))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::angle_rad;

    #[test]
    fn an_outline_parts_ink_from_paper() {
        const TEXEL_RAD: f64 = 1e-6;
        let crosses = Crosses::new();
        let outlines = cross_outlines();
        assert_eq!(outlines.len(), 32);
        assert_eq!(outlines.iter().filter(|(is_red, _)| *is_red).count(), 12);
        for ((is_red, outline), cross) in outlines.iter().zip(&crosses.0) {
            let ink = if *is_red { RED } else { BLUE };
            for dir in outline {
                // Towards the middle of the arm or of the cross, and away from it.
                let (e, n) = (dir.dot(cross.east), dir.dot(cross.north));
                let off = if e.abs() > n.abs() {
                    cross.north * n
                } else {
                    cross.east * e
                };
                let along = *dir - cross.center * dir.dot(cross.center) - off;
                let moved = |by: f64| (*dir + (off * 0.5 + along * 0.01) * by).normalized();
                let is = |dir, wanted: [f32; 3]| {
                    let found = crosses.color(dir, TEXEL_RAD);
                    found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6)
                };
                assert!(is(moved(-1.0), ink));
                assert!(is(moved(1.0), PAPER), "control");
                assert!(angle_rad(dir.to_f64(), cross.center.to_f64()) < 1.1 * HALF_LENGTH_RAD);
            }
        }
    }
}
