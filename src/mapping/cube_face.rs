//! The six faces that the cube family shares: which one a direction meets, and the plane it is drawn on.
//!
//! Charts 0 to 5 are +x, -x, +y, -y, +z, -z. The frame of each face is the one on which OpenGL, D3D, Vulkan and WebGPU
//! agree: (a, b) = (sc, tc)/ma on the gnomonic plane, a to the right and b downwards as seen from inside.
//!
//! Faces are chosen by comparing the raw components: comparisons are exact in every language and on every adapter, while
//! rounded dot products leave holes.

use super::chart::to_signed;
use super::{
    AngleLanes, Borders, DirLanes, Family, LANES, Lane, Layout, Line, MappingInfo, PointLanes, Step,
};
use crate::math::{Real, Vec3, atan_turns};
use std::f64::consts::FRAC_1_PI;

/// Names of the six charts.
pub const FACES: &[&str] = &["+x", "-x", "+y", "-y", "+z", "-z"];

/// What every member of the family has in common: six full squares, each edge divided alike from both sides as long as
/// the warp is the same on every face.
pub const FAMILY: MappingInfo = MappingInfo {
    family: Family::Cubes,
    charts: FACES,
    borders: Borders::CubeEdges,
    layout: Layout::Cross,
    ..MappingInfo::PLAIN
};

/// The face of the largest |component|; on ties z wins over y over x (the rule that Vulkan recommends).
pub fn largest_component<R: Real>(dir: Vec3<R>) -> u32 {
    let (x, y, z) = (dir.x.abs(), dir.y.abs(), dir.z.abs());
    if z >= x && z >= y {
        if dir.z < R::zero() { 5 } else { 4 }
    } else if y >= x {
        if dir.y < R::zero() { 3 } else { 2 }
    } else if dir.x < R::zero() {
        1
    } else {
        0
    }
}

/// Normals of the great circles A to F of Grimm and Niebruegge (Appendix A, N1 to N6), times sqrt 2.
pub const GREAT_CIRCLES: [(char, [i8; 3]); 6] = [
    ('A', [1, 1, 0]),
    ('B', [-1, 1, 0]),
    ('C', [0, 1, 1]),
    ('D', [0, 1, -1]),
    ('E', [1, 0, 1]),
    ('F', [-1, 0, 1]),
];

/// A row of the paper's table (Fig. 9): the face and the sign that each check must have, where it matters.
pub struct SignRow {
    /// Index of the face.
    pub face: u32,
    /// `Some(true)`: the product with the circle's normal must be above 0; `Some(false)`: it must not; in the order A to F.
    pub checks: [Option<bool>; 6],
}

const fn row(face: u32, checks: [i8; 6]) -> SignRow {
    let mut row = SignRow {
        face,
        checks: [None; 6],
    };
    let mut i = 0;
    while i < 6 {
        if checks[i] != 0 {
            row.checks[i] = Some(checks[i] > 0);
        }
        i += 1;
    }
    row
}

/// The paper's table in its order.
pub const SIGN_TABLE: [SignRow; 6] = [
    row(2, [1, 1, 1, 1, 0, 0]),
    row(3, [-1, -1, -1, -1, 0, 0]),
    row(4, [0, 0, 1, -1, 1, 1]),
    row(5, [0, 0, -1, 1, -1, -1]),
    row(0, [1, -1, 0, 0, 1, -1]),
    row(1, [-1, 1, 0, 0, -1, 1]),
];

/// The six checks: is the product of `dir` with the normal above 0? Decided by comparing components, never by a product:
/// x + y > 0 exactly when y > -x, and so on.
pub fn great_circle_checks<R: Real>(dir: Vec3<R>) -> [bool; 6] {
    let Vec3 { x, y, z } = dir;
    [y > -x, y > x, y > -z, y > z, x > -z, z > x]
}

/// The face that the paper's sign table picks. Off the ties it is the face of the largest |component|; where faces meet,
/// the strict "> 0" gives the fixed order -y, -z, then x of either sign, +z, +y, and the first that takes part wins.
pub fn sign_table<R: Real>(dir: Vec3<R>) -> u32 {
    let [a, b, c, d, e, f] = great_circle_checks(dir);
    if a && b && c && d {
        2
    } else if !(a || b || c || d) {
        3
    } else if c && !d && e && f {
        4
    } else if !c && d && !e && !f {
        5
    } else if a && !b && e && !f {
        0
    } else {
        1
    }
}

/// (sc, tc, ma) of a direction in the frame of a face.
pub fn to_frame<R: Real>(face: u32, dir: Vec3<R>) -> (R, R, R) {
    let Vec3 { x, y, z } = dir;
    match face {
        0 => (-z, -y, x),
        1 => (z, -y, -x),
        2 => (x, z, y),
        3 => (x, -z, -y),
        4 => (x, -y, z),
        _ => (-x, -y, -z),
    }
}

/// The direction with these coordinates in the frame of a face: the inverse of [`to_frame`].
pub fn from_frame<R: Real>(face: u32, sc: R, tc: R, ma: R) -> Vec3<R> {
    match face {
        0 => Vec3::new(ma, -tc, -sc),
        1 => Vec3::new(-ma, -tc, sc),
        2 => Vec3::new(sc, ma, tc),
        3 => Vec3::new(sc, -ma, -tc),
        4 => Vec3::new(sc, -tc, ma),
        _ => Vec3::new(-sc, -tc, -ma),
    }
}

/// A side of a face's square.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// u = 0; v runs along it.
    Left,
    /// u = 1; v runs along it.
    Right,
    /// v = 0; u runs along it.
    Top,
    /// v = 1; u runs along it.
    Bottom,
}

impl Side {
    /// All four.
    pub const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Top, Self::Bottom];

    /// The place on it, in [0, 1]^2, so far along its coordinate.
    pub const fn place(self, along: f64) -> [f64; 2] {
        match self {
            Self::Left => [0.0, along],
            Self::Right => [1.0, along],
            Self::Top => [along, 0.0],
            Self::Bottom => [along, 1.0],
        }
    }

    /// The side that a place lies on, and how far along; `None` away from the sides.
    pub fn of_place([u, v]: [f64; 2]) -> Option<(Self, f64)> {
        Self::ALL.into_iter().find_map(|side| {
            let along = match side {
                Self::Left | Self::Right => v,
                Self::Top | Self::Bottom => u,
            };
            (side.place(along) == [u, v]).then_some((side, along))
        })
    }
}

/// The other face at a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Neighbour {
    /// The face.
    pub face: u32,
    /// Its side that is the same edge of the cube.
    pub side: Side,
    /// Whether the coordinates along the edge run against each other.
    pub is_reversed: bool,
}

/// What lies across a side of a face.
pub fn across(face: u32, side: Side) -> Neighbour {
    // A point of the edge, not in its middle: it lies on the other face too, where its frame gives 1 for the axis.
    const ALONG: f64 = 0.25;
    let [u, v] = side.place(ALONG);
    let point: Vec3<f64> = from_frame(face, to_signed(u), to_signed(v), 1.0);
    let found = (0..6).filter(|other| *other != face).find_map(|other| {
        let (sc, tc, ma) = to_frame(other, point);
        let place = [(sc + 1.0) / 2.0, (tc + 1.0) / 2.0];
        let (side, along) = Side::of_place(place).filter(|_| ma == 1.0)?;
        Some(Neighbour {
            face: other,
            side,
            is_reversed: along != ALONG,
        })
    });
    // Every edge has two faces; the face itself stands for one that there is not.
    found.unwrap_or(Neighbour {
        face,
        side,
        is_reversed: false,
    })
}

/// A face and the point (a, b) in [-1, 1]^2 of its gnomonic plane; `None` for a vector that is no direction.
pub fn gnomonic<R: Real>(dir: Vec3<R>, choose: fn(Vec3<R>) -> u32) -> Option<(u32, R, R)> {
    let scaled = dir.scaled_direction()?;
    let face = choose(dir);
    let (sc, tc, ma) = to_frame(face, scaled);
    Some((face, sc / ma, tc / ma))
}

/// The unit direction of a point of a face's gnomonic plane.
pub fn from_gnomonic<R: Real>(face: u32, a: R, b: R) -> Vec3<R> {
    from_frame(face, a, b, R::one()).normalized()
}

/// p in [-1, 1] of a in [-1, 1], such that strips of a face between lines of equal a hold solid angle in proportion: the strip from
/// -a to a has 4 asin(a/sqrt(2 a^2 + 2)) sr, here by the arctangent.
#[inline(always)]
pub fn strip_of_plane<R: Real>(a: R) -> R {
    (a / (a * a + R::two()).sqrt()).atan_unit() * R::from_f64(6.0 * FRAC_1_PI)
}

/// The inverse of [`strip_of_plane`]: with t = tan(pi p/6), a = t sqrt(2/(1 - t^2)).
#[inline(always)]
pub fn plane_of_strip<R: Real>(p: R) -> R {
    let t = (p * R::from_f64(1.0 / 12.0)).tan_turns();
    t * (R::two() / (R::one() - t * t)).sqrt()
}

/// The steps where the face of the largest component counts: the face, its frame, the gnomonic plane, and what `place`
/// makes of (a, b) there.
pub fn steps<R: Real + std::fmt::Display>(
    dir: Vec3<R>,
    place: impl FnOnce(R, R) -> [Step; 2],
) -> Vec<Step> {
    let (Some(d), Some((face, a, b))) = (dir.scaled_direction(), gnomonic(dir, largest_component))
    else {
        return Vec::new();
    };
    let (sc, tc, ma) = to_frame(face, d);
    let name = FACES[face as usize];
    let [u, v] = place(a, b);
    vec![
        Step::new(
            "face",
            "the largest of |x|, |y|, |z|",
            format!("{name} (z before y before x on ties)"),
        ),
        Step::new(
            "frame",
            "(sc, tc, ma) of the face",
            format!("({sc}, {tc}, {ma})"),
        ),
        Step::new("a", "a = sc/ma", format!("{sc}/{ma} = {a}")),
        Step::new("b", "b = tc/ma", format!("{tc}/{ma} = {b}")),
        u,
        v,
    ]
}

/// The faces that meet at a direction, in the order in which the sign table prefers them; one unless it is a tie.
pub fn meeting_faces<R: Real>(dir: Vec3<R>) -> Vec<u32> {
    let largest = dir.max_abs();
    let Vec3 { x, y, z } = dir;
    let signed = |c: R, plus: u32| (c.abs() == largest).then(|| plus + u32::from(c < R::zero()));
    let negative_y = signed(y, 2).filter(|f| *f == 3);
    let negative_z = signed(z, 4).filter(|f| *f == 5);
    let positive_y = signed(y, 2).filter(|f| *f == 2);
    let positive_z = signed(z, 4).filter(|f| *f == 4);
    [negative_y, negative_z, signed(x, 0), positive_z, positive_y]
        .into_iter()
        .flatten()
        .collect()
}

/// A face and a direction in its frame, found without a branch: [`to_frame`].
#[derive(Clone, Copy, Debug)]
pub struct Framed {
    /// Index of the face.
    pub face: u32,
    /// sc.
    pub across: f32,
    /// tc.
    pub down: f32,
    /// |ma|.
    pub axis: f32,
}

/// The frame of the face on the axis that is chosen.
#[inline(always)]
fn framed(is_y: bool, is_z: bool, x: f32, y: f32, z: f32) -> Framed {
    let is_x = !is_y & !is_z;
    let along = if is_y {
        y
    } else if is_z {
        z
    } else {
        x
    };
    let is_negative = along < 0.0;
    let pair = if is_y {
        2
    } else if is_z {
        4
    } else {
        0
    };
    let across = if is_x { -z } else { x };
    let down = if is_y { z } else { -y };
    // Only the y faces keep their column, and only they turn their row, when the axis is negative.
    Framed {
        face: pair + u32::from(is_negative),
        across: if is_negative & !is_y { -across } else { across },
        down: if is_negative & is_y { -down } else { down },
        axis: along.abs(),
    }
}

/// The face of [`largest_component`].
#[inline(always)]
pub fn largest_component_lane(x: f32, y: f32, z: f32) -> Framed {
    let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
    let is_z = (az >= ax) & (az >= ay);
    framed(!is_z & (ay >= ax), is_z, x, y, z)
}

/// The face of [`sign_table`]: of the largest component; on ties the first of -y, -z, +x or -x, +z, +y.
#[inline(always)]
pub fn sign_table_lane(x: f32, y: f32, z: f32) -> Framed {
    let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
    let is_y = if y < 0.0 {
        (ay >= ax) & (ay >= az)
    } else {
        (ay > ax) & (ay > az)
    };
    // +z is before +y, and where it meets -y that has been chosen.
    let is_z = !is_y & (az >= ay) & if z < 0.0 { az >= ax } else { az > ax };
    framed(is_y, is_z, x, y, z)
}

/// Chart points of many directions: their faces by `choose`, and u - 1/2 and v - 1/2 by `place` of face and gnomonic plane.
#[inline(always)]
pub fn face_lanes(
    dirs: &DirLanes,
    points: &mut PointLanes,
    choose: impl Fn(f32, f32, f32) -> Framed,
    place: impl Fn(u32, f32, f32) -> (f32, f32),
) {
    points.base = Some(0.5);
    for k in 0..LANES {
        let d = choose(dirs.x[k], dirs.y[k], dirs.z[k]);
        let inverse = 1.0 / d.axis;
        points.chart[k] = d.face;
        (points.rest_u[k], points.rest_v[k]) = place(d.face, d.across * inverse, d.down * inverse);
    }
}

/// What the directions of a meridian have in common, from their x and z where y is 0: the side face that they cross, and for
/// [`graticule_lanes`] a and the secant of the longitude, both from the face's middle, x and z.
pub fn meridian([x, z]: [f64; 2]) -> (u32, Line) {
    let face = if z.abs() >= x.abs() {
        4 + u32::from(z < 0.0)
    } else {
        u32::from(x < 0.0)
    };
    let (sc, _, ma) = to_frame(face, Vec3::new(x, 0.0, z));
    (face, [sc / ma, 1.0 / ma, x, z].map(|c| c as f32))
}

/// What the directions of a parallel have in common, from their distance from the y axis and their y, for [`graticule_lanes`]: the
/// latitude's tangent, and what x and z are multiplied by on the face that it crosses around the pole.
pub fn parallel([radius, y]: [f64; 2]) -> Line {
    let cotangent = radius / y.abs();
    let down = if y < 0.0 { -cotangent } else { cotangent };
    [y / radius, cotangent, down, 0.0].map(|c| c as f32)
}

/// Chart points of the directions in which a parallel meets meridians: no division is left.
#[inline(always)]
pub fn graticule_lanes(
    (faces, meridians): (&[u32; LANES], [&Lane; 4]),
    [tangent, across, down, _]: Line,
    points: &mut PointLanes,
    place: impl Fn(u32, f32, f32) -> (f32, f32),
) {
    let [a, secant, x, z] = meridians;
    let pole = if tangent < 0.0 { 3 } else { 2 };
    points.base = Some(0.5);
    for k in 0..LANES {
        let b = -tangent * secant[k];
        let is_side = b.abs() <= 1.0;
        let face = if is_side { faces[k] } else { pole };
        let a = if is_side { a[k] } else { x[k] * across };
        let b = if is_side { b } else { z[k] * down };
        points.chart[k] = face;
        (points.rest_u[k], points.rest_v[k]) = place(face, a, b);
    }
}

/// Whether a face stands upright around the y axis.
pub const fn is_side(face: u32) -> bool {
    face & 6 != 2
}

/// Latitudes of at most an eighth of a turn, from their tangents.
#[inline(always)]
pub fn shallow_latitudes(latitudes: &mut AngleLanes, tangent: impl Fn(usize) -> f32) {
    latitudes.base = 0.0;
    for k in 0..LANES {
        latitudes.rest[k] = atan_turns(tangent(k));
    }
}

/// Directions of a row of a face from (sc, tc, ma) of each lane: [`from_frame`].
#[inline(always)]
pub fn frame_lanes(face: u32, dirs: &mut DirLanes, frame: impl Fn(usize) -> (f32, f32, f32)) {
    match face {
        0 => each_lane(dirs, frame, |sc, tc, ma| (ma, -tc, -sc)),
        1 => each_lane(dirs, frame, |sc, tc, ma| (-ma, -tc, sc)),
        2 => each_lane(dirs, frame, |sc, tc, ma| (sc, ma, tc)),
        3 => each_lane(dirs, frame, |sc, tc, ma| (sc, -ma, -tc)),
        4 => each_lane(dirs, frame, |sc, tc, ma| (sc, -tc, ma)),
        _ => each_lane(dirs, frame, |sc, tc, ma| (-sc, -tc, -ma)),
    }
}

#[inline(always)]
fn each_lane(
    dirs: &mut DirLanes,
    frame: impl Fn(usize) -> (f32, f32, f32),
    dir: impl Fn(f32, f32, f32) -> (f32, f32, f32),
) {
    for k in 0..LANES {
        let (sc, tc, ma) = frame(k);
        (dirs.x[k], dirs.y[k], dirs.z[k]) = dir(sc, tc, ma);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_faces_of_an_edge_agree_on_it() {
        let mut edges = std::collections::HashSet::new();
        for face in 0..6 {
            for side in Side::ALL {
                let other = across(face, side);
                assert_ne!(other.face, face);
                let back = across(other.face, other.side);
                let here = (face, side, other.is_reversed);
                assert_eq!((back.face, back.side, back.is_reversed), here);
                edges.insert((face.min(other.face), face.max(other.face)));
                for along in [0.0, 0.1, 0.7] {
                    let there = if other.is_reversed {
                        1.0 - along
                    } else {
                        along
                    };
                    let dir = |face, [u, v]: [f64; 2]| -> Vec3<f64> {
                        from_gnomonic(face, to_signed(u), to_signed(v))
                    };
                    let gap =
                        dir(face, side.place(along)) - dir(other.face, other.side.place(there));
                    assert!(gap.length() < 1e-15, "{face} {side:?}");
                }
            }
        }
        assert_eq!(edges.len(), 12);
    }
}
