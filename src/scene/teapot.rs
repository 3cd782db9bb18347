//! The teapot: 32 bicubic Bezier patches, drawn by Martin Newell at the University of Utah in 1975.
//!
//! The numbers are his control points in the proportions in which they were passed on (height divided by 1.3), the
//! bottom added by Frank Crow (1987) included; compared with the list of 290 points in three.js' `TeapotGeometry`.
//! They are stored by what they mean. Lid, rim, body and bottom are turned profiles: each quarter turn is one patch,
//! whose four columns are the customary cubic near-circle. Handle and spout are tubes, each half a patch.
//!
//! Two departures, both so that the outside hides the inside: the lid is widened to meet the rim (the original leaves
//! a slit), and the spout is closed by a level disc where tea would stand.

use glam::DVec3;

use super::Mesh;

/// Quads along each side of a patch: 3.75 degrees of a turn, 5e-4 of the radius below the surface.
pub(super) const STEPS: u32 = 24;

/// A point of a profile: radius, height and the near-circle's arm as a part of the radius.
type Turned = [f64; 3];

/// Newell's arm of the near-circle (0.5523 would be the customary one).
const ARM: f64 = 0.56;
/// The same for the widest part of the knob, which he rounded to 0.45 / 0.8.
const KNOB_ARM: f64 = 0.5625;
/// The lid's own radius at the bottom is 1.3; the rim's inner radius is 1.4.
const LID_WIDENING: f64 = 1.4 / 1.3;

/// From the tip of the knob down the outside to the middle of the bottom; every row is one cubic.
const PROFILE: [[Turned; 4]; 6] = [
    [
        [0.0, 3.15, ARM],
        [0.8, 3.15, KNOB_ARM],
        [0.0, 2.85, ARM],
        [0.2, 2.7, ARM],
    ],
    [
        [0.2, 2.7, ARM],
        [0.4, 2.55, ARM],
        [1.3, 2.55, ARM],
        [1.3, 2.4, ARM],
    ],
    [
        [1.4, 2.4, ARM],
        [1.3375, 2.53125, ARM],
        [1.4375, 2.53125, ARM],
        [1.5, 2.4, ARM],
    ],
    [
        [1.5, 2.4, ARM],
        [1.75, 1.875, ARM],
        [2.0, 1.35, ARM],
        [2.0, 0.9, ARM],
    ],
    [
        [2.0, 0.9, ARM],
        [2.0, 0.45, ARM],
        [1.5, 0.225, ARM],
        [1.5, 0.15, ARM],
    ],
    [
        [1.5, 0.15, ARM],
        [1.5, 0.075, ARM],
        [1.425, 0.0, ARM],
        [0.0, 0.0, ARM],
    ],
];
/// The first rows of [`PROFILE`] are the lid's.
const LID_ROWS: usize = 2;

/// A station of a tube: (x, height) on the one side, (x, height) on the other, half the width between.
type Station = [f64; 5];

/// From the body's upper part around to its lower part.
const HANDLE: [Station; 7] = [
    [-1.6, 2.025, -1.5, 2.25, 0.3],
    [-2.3, 2.025, -2.5, 2.25, 0.3],
    [-2.7, 2.025, -3.0, 2.25, 0.3],
    [-2.7, 1.8, -3.0, 1.8, 0.3],
    [-2.7, 1.575, -3.0, 1.35, 0.3],
    [-2.5, 1.125, -2.65, 0.9375, 0.3],
    [-2.0, 0.9, -1.9, 0.6, 0.3],
];

/// From inside the body to the lip, and a little into the mouth.
const SPOUT: [Station; 7] = [
    [1.7, 1.425, 1.7, 0.6, 0.66],
    [2.6, 1.425, 3.1, 0.825, 0.66],
    [2.3, 2.1, 2.4, 2.025, 0.25],
    [2.7, 2.4, 3.3, 2.4, 0.25],
    [2.8, 2.475, 3.525, 2.49375, 0.25],
    [2.9, 2.475, 3.45, 2.5125, 0.15],
    [2.8, 2.4, 3.2, 2.4, 0.15],
];

/// Control points `[row][column]`; d/dcolumn x d/drow points outwards.
#[derive(Clone, Copy, Debug)]
struct Patch([[DVec3; 4]; 4]);

impl Patch {
    /// The quarter turn number `quarter`, from +x over +z.
    fn turned(profile: &[Turned; 4], quarter: usize, widening: f64) -> Self {
        Self(profile.map(|[radius, height, arm]| {
            [(1.0, 0.0), (1.0, arm), (arm, 1.0), (0.0, 1.0)].map(|(x, z)| {
                // A quarter turn sends (x, z) to (-z, x), exactly.
                let (x, z) = (0..quarter).fold((x, z), |(x, z), _| (-z, x));
                DVec3::new(widening * radius * x, height, widening * radius * z)
            })
        }))
    }

    /// The two halves, +z and -z, of the tube over four stations.
    fn halves(stations: &[Station]) -> [Self; 2] {
        let row = |k: usize, side: f64| {
            let [ax, ay, bx, by, width] = stations[k];
            let (a, b) = (DVec3::new(ax, ay, 0.0), DVec3::new(bx, by, 0.0));
            let arm = DVec3::new(0.0, 0.0, side * width);
            let row = [a, a + arm, b + arm, b];
            // Always from the +z half's first edge around: the -z half runs back from b to a.
            if side > 0.0 {
                row
            } else {
                [b, b + arm, a + arm, a]
            }
        };
        [1.0, -1.0].map(|side| Self([0, 1, 2, 3].map(|k| row(k, side))))
    }

    /// Position and unit normal at (u, v) in [0,1]^2, u along columns and v along rows.
    fn at(&self, u: f64, v: f64) -> (DVec3, DVec3) {
        let (weights_u, slopes_u) = bernstein(u);
        let (weights_v, slopes_v) = bernstein(v);
        let sum = |row_weights: [f64; 4], column_weights: [f64; 4]| {
            let mut sum = DVec3::ZERO;
            for (row, row_weight) in self.0.iter().zip(row_weights) {
                for (point, column_weight) in row.iter().zip(column_weights) {
                    sum += row_weight * column_weight * *point;
                }
            }
            sum
        };
        let along_v = sum(slopes_v, weights_u);
        let mut along_u = sum(weights_v, slopes_u);
        if along_u.length() < 1e-9 {
            // A pole: the whole row is one point. Next to it d/du grows like the mixed derivative times the distance
            // from the pole, which gives the limit of the normal.
            let inwards = if v < 0.5 { 1.0 } else { -1.0 };
            along_u = inwards * sum(slopes_v, slopes_u);
        }
        let normal = along_u.cross(along_v).normalize_or(DVec3::Y);
        (sum(weights_v, weights_u), normal)
    }
}

/// The four cubic Bernstein polynomials at `t` and their derivatives. At 0 and 1 all but the needed ones are exactly 0,
/// so that patches with a common border agree there in every bit.
fn bernstein(t: f64) -> ([f64; 4], [f64; 4]) {
    let s = 1.0 - t;
    (
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t],
        [
            -3.0 * s * s,
            3.0 * s * (s - 2.0 * t),
            3.0 * t * (2.0 * s - t),
            3.0 * t * t,
        ],
    )
}

/// All 32 patches: 8 of the lid, 4 of the rim, 8 of the body, 4 of the bottom, 4 of the handle, 4 of the spout (the
/// last two of which end in the mouth).
fn patches(lid_widening: f64) -> Vec<Patch> {
    let mut all = Vec::with_capacity(32);
    for (k, profile) in PROFILE.iter().enumerate() {
        let widening = if k < LID_ROWS { lid_widening } else { 1.0 };
        all.extend((0..4).map(|quarter| Patch::turned(profile, quarter, widening)));
    }
    for tube in [&HANDLE, &SPOUT] {
        all.extend(Patch::halves(&tube[0..4]));
        all.extend(Patch::halves(&tube[3..7]));
    }
    all
}

/// Centre of the bounding box, and the factor that brings the farthest point to the unit sphere. Those of the full mesh, so
/// that a coarse one keeps its place; its own points count only where they lie between those of the full one and reach
/// farther.
fn fit(patches: &[Patch], steps: u32) -> (DVec3, f64) {
    let points = |steps: u32| {
        let grid = move || (0..=steps).flat_map(move |j| (0..=steps).map(move |i| (i, j)));
        let place = move |n: u32| f64::from(n) / f64::from(steps);
        patches
            .iter()
            .flat_map(move |patch| grid().map(move |(i, j)| patch.at(place(i), place(j)).0))
    };
    let low = points(STEPS).fold(DVec3::INFINITY, DVec3::min);
    let high = points(STEPS).fold(DVec3::NEG_INFINITY, DVec3::max);
    let centre = 0.5 * (low + high);
    let reach = points(STEPS)
        .chain(points(steps))
        .map(|p| p.distance(centre))
        .fold(0.0, f64::max);
    (centre, 1.0 / reach)
}

/// The teapot, y up, spout to +x, lid, handle and all, with `steps` quads along each side of a patch.
pub(super) fn mesh(steps: u32) -> Mesh {
    let patches = patches(LID_WIDENING);
    let (centre, scale) = fit(&patches, steps);
    let step = |i: u32| f64::from(i) / f64::from(steps);
    let place = |p: DVec3| (scale * (p - centre)).as_vec3().to_array();
    let mut mesh = Mesh::default();
    for patch in &patches {
        mesh.add_grid(steps, steps, |i, j| {
            let (position, normal) = patch.at(step(i), step(j));
            (place(position), normal.as_vec3().to_array())
        });
    }
    // The level of the tea: a fan over the spout's last row, which is plane.
    let up = [0.0, 1.0, 0.0];
    let last = SPOUT[6];
    let middle = mesh.add_vertex(
        place(DVec3::new(0.5 * (last[0] + last[2]), last[1], 0.0)),
        up,
    );
    for patch in &patches[patches.len() - 2..] {
        let border: Vec<u32> = (0..=steps)
            .map(|i| mesh.add_vertex(place(patch.at(step(i), 1.0).0), up))
            .collect();
        for pair in border.windows(2) {
            mesh.add_triangle([middle, pair[0], pair[1]]);
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use glam::Vec3;

    use super::super::mesh::tests::open_edges;
    use super::*;

    /// The mesh's points back in Newell's units.
    fn points() -> Vec<DVec3> {
        let (centre, scale) = fit(&patches(LID_WIDENING), STEPS);
        let back = |p| Vec3::from(p).as_dvec3() / scale + centre;
        mesh(STEPS).positions.into_iter().map(back).collect()
    }

    #[test]
    fn has_newells_patches_and_points() {
        let distinct = |patches: &[Patch]| {
            let points = patches.iter().flat_map(|p| p.0.iter().flatten());
            points
                .map(|p| p.to_array().map(|x| (x + 0.0).to_bits()))
                .collect::<HashSet<_>>()
                .len()
        };
        let mut original = patches(1.0);
        assert_eq!((original.len(), distinct(&original)), (32, 290));
        // The widened lid shares the twelve points of the rim.
        assert_eq!(distinct(&patches(LID_WIDENING)), 278);
        // Control: a corner torn from its neighbours is one point more.
        original[9].0[0][0].x += 1e-9;
        assert_eq!(distinct(&original), 291);
    }

    #[test]
    fn fills_newells_box() {
        let corner = |pick: fn(DVec3, DVec3) -> DVec3| points().into_iter().reduce(pick).unwrap();
        let (low, high) = (corner(DVec3::min), corner(DVec3::max));
        let off = |x: f64| {
            let newell = [DVec3::new(-3.0, 0.0, -2.0), DVec3::new(x, 3.15, 2.0)];
            (low - newell[0]).length().max((high - newell[1]).length())
        };
        // The lip's farthest point lies between its control points, at 3.434 of 3.525.
        assert!(off(3.43404) < 1e-5, "{low} {high}");
        assert!(off(3.525) > 1e-2, "control");
    }

    #[test]
    fn open_only_inside_the_body() {
        let (centre, scale) = fit(&patches(LID_WIDENING), STEPS);
        let open = open_edges(&mesh(STEPS));
        // Both ends of the handle and the root of the spout, two half tubes each.
        assert_eq!(open.len(), 3 * 2 * STEPS as usize);
        let body: Vec<DVec3> = (0..2000)
            .map(|k| {
                Patch::turned(&PROFILE[3 + k / 1000], 0, 1.0)
                    .at(0.0, (k % 1000) as f64 / 1000.0)
                    .0
            })
            .collect();
        let out = |p: DVec3| {
            let nearest = |a: &&DVec3, b: &&DVec3| (a.y - p.y).abs().total_cmp(&(b.y - p.y).abs());
            p.x.hypot(p.z) - body.iter().min_by(nearest).unwrap().x
        };
        let ends = open
            .iter()
            .map(|e| 0.5 * (e[0] + e[1]).as_dvec3() / scale + centre);
        let worst = ends.map(out).fold(f64::MIN, f64::max);
        // The inner edge of the handle's lower end lies on the body itself.
        assert!(worst < 2e-3, "{worst}");
        assert!(out(DVec3::new(3.0, 1.8, 0.0)) > 1.0, "control");
    }

    #[test]
    fn poles_have_the_limit_of_the_normal() {
        let patches = patches(LID_WIDENING);
        for (range, v, away, pole) in [
            (0..4, 0.0, 1e-6, DVec3::Y),
            (20..24, 1.0, -1e-6, DVec3::NEG_Y),
        ] {
            for patch in &patches[range] {
                for u in [0.0, 0.3, 1.0] {
                    assert!((patch.at(u, v).1 - pole).length() < 1e-12);
                    assert!((patch.at(u, v + away).1 - pole).length() < 1e-5);
                    // Control: further off the normal does lean.
                    assert!((patch.at(u, v + 3e5 * away).1 - pole).length() > 1e-3);
                }
            }
        }
    }

    #[test]
    fn borders_agree_in_place_and_normal() {
        let patches = patches(LID_WIDENING);
        let worst = |next: fn(usize) -> usize| {
            let mut worst = (0.0f64, 0.0f64);
            for k in 0..24 {
                for j in 0..=STEPS {
                    let (here, there) = (
                        patches[k].at(1.0, f64::from(j) / f64::from(STEPS)),
                        patches[next(k)].at(0.0, f64::from(j) / f64::from(STEPS)),
                    );
                    worst.0 = worst.0.max(here.0.distance(there.0));
                    worst.1 = worst.1.max(here.1.distance(there.1));
                }
            }
            worst
        };
        let (place, normal) = worst(|k| k / 4 * 4 + (k + 1) % 4);
        assert!(place == 0.0 && normal < 1e-12, "{place:e} {normal:e}");
        let (place, normal) = worst(|k| k / 4 * 4 + (k + 2) % 4);
        assert!(place > 1.0 && normal > 1.0, "control");
    }
}
