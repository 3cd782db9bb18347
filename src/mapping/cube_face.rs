//! The six faces that the cube family shares: which one a direction meets, and the plane it is drawn on.
//!
//! Charts 0 to 5 are +x, -x, +y, -y, +z, -z. The frame of each face is the one on which OpenGL, D3D, Vulkan and WebGPU
//! agree: (a, b) = (sc, tc)/ma on the gnomonic plane, a to the right and b downwards as seen from inside.
//!
//! Faces are chosen by comparing the raw components: comparisons are exact in every language and on every adapter, while
//! rounded dot products leave holes.

use super::{Layout, MappingInfo, Step};
use crate::math::{Real, Vec3};

/// Names of the six charts.
pub const FACES: &[&str] = &["+x", "-x", "+y", "-y", "+z", "-z"];

/// What every member of the family has in common: six full squares, each edge divided alike from both sides as long as
/// the warp is the same on every face.
pub const FAMILY: MappingInfo = MappingInfo {
    charts: FACES,
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
