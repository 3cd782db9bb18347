//! Continuous cube map (Grimm and Niebruegge): a cube folded onto the sphere, each edge divided by arc length.
//!
//! In the cube family's frame the paper's six rotations reduce to one warp. With alpha = atan(1/sqrt 2) and
//! L(t) = 1/2 + atan(t/sqrt 2)/(2 alpha), M(t, s) = 1/2 + atan(t q)/(2 atan q), q = 1/sqrt(1 + s^2):
//!
//! - on the y and z faces (u, v) = (L(a), M(b, a));
//! - on the x faces the roles are exchanged: (u, v) = (M(a, b), L(b)).
//!
//! Lines of equal L are great circles, lines of equal M are not circles. The face is picked by the paper's sign table.

mod appendix_b;
mod paper;

pub(super) use paper::{from_s_t, fused_shader, printed, shader, to_s_t};

use super::cube_face::{
    self, face_lanes, frame_lanes, from_frame, gnomonic, sign_table, sign_table_lane,
};
use super::{AngleLanes, DirLanes, Lane, Line, PointLanes};
use super::{ChartPoint, Convention, Erratum, Mapping, MappingInfo, ShaderForm, Step};
use super::{evaluator, seed_forms};
use crate::math::{Real, Vec3, atan_unit, sin_cos_eighth};
use std::f64::consts::{FRAC_1_PI, FRAC_1_SQRT_2, PI, SQRT_2};

/// See the [module](self).
pub struct Ccm;

/// alpha = asin(1/sqrt 3) = atan(1/sqrt 2): half an edge of a face as seen from the centre, in radians.
pub const HALF_EDGE_RAD: f64 = 0.615_479_708_670_387_3;

impl Mapping for Ccm {
    const INFO: MappingInfo = MappingInfo {
        id: "ccm",
        name: "Continuous cube map",
        about: "A cube folded onto the sphere: great circles part the faces, and every edge is divided by arc length.",
        source: "Grimm and Niebruegge, Continuous Cube Mapping",
        conventions: &[
            Convention {
                id: "paper",
                about: "Appendix A: texture index (+y -y +z -z -x +x), S and T of the direction rotated into the +y face",
                columns: ["tex_index", "s", "t"],
                forward: (paper::forward, paper::forward),
                inverse: Some((paper::inverse, paper::inverse)),
            },
            Convention {
                id: "appendix-b",
                about: "Appendix B: cases +y -y +x -x +z -z; on the x and z faces another parameterisation, poles on other axes",
                columns: ["case", "u", "v"],
                forward: (appendix_b::forward, appendix_b::forward),
                inverse: Some((appendix_b::inverse, appendix_b::inverse)),
            },
            Convention {
                id: "printed-eq6",
                about: "as paper, with Eq. 6 as it is printed: wrong by up to 0.224 in T",
                columns: ["tex_index", "s", "t"],
                forward: (paper::printed_eq6, paper::printed_eq6),
                inverse: None,
            },
        ],
        errata: &[Erratum {
            id: "Eq. 6",
            printed: "v = ½(1 + asin(Rz/√(2 + Rx²/Ry²)) / asin(1/√3))",
            right: "v = ½(1 + asin(Rz/|R|) / asin(1/√(2 + Rx²/Ry²)))",
            why: "the root belongs inside the denominator's arcsine; printed, v does not reach 1 on the edge",
            values: |dir| Some((paper::printed_eq6(dir)?.v, paper::forward(dir)?.v)),
        }],
        evaluators: || {
            let mut list = evaluator::with_arctangents_and::<Ccm>(seed_forms::CCM);
            list.push(evaluator::of_form(ShaderForm::CubeUnit));
            list
        },
        ..cube_face::FAMILY
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let (face, a, b) = gnomonic(dir, sign_table)?;
        let (u, v) = if is_x_face(face) {
            (across_edge(a, b), along_edge(b))
        } else {
            (along_edge(a), across_edge(b, a))
        };
        Some(ChartPoint::new(face, u, v).clamped())
    }

    /// Beyond the face: meridians and latitudes go on.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let (sc, tc, ma) = if is_x_face(point.chart) {
            let (long, height, axis) = from_edge(point.v, point.u);
            (height, long, axis)
        } else {
            from_edge(point.u, point.v)
        };
        from_frame(point.chart, sc, tc, ma)
    }

    const HAS_LANES: bool = true;

    #[inline(always)]
    fn forward_lanes(dirs: &DirLanes, points: &mut PointLanes) {
        face_lanes(dirs, points, sign_table_lane, Self::from_middle);
    }

    const HAS_FACES: bool = true;

    #[inline(always)]
    fn from_middle(face: u32, a: f32, b: f32) -> (f32, f32) {
        let (along, across) = if is_x_face(face) { (b, a) } else { (a, b) };
        let q = 1.0 / (1.0 + along * along).sqrt();
        let along = atan_unit(along * FRAC_1_SQRT_2 as f32) * (0.5 / HALF_EDGE_RAD) as f32;
        let across = 0.5 * atan_unit(across * q) / atan_unit(q);
        if is_x_face(face) {
            (across, along)
        } else {
            (along, across)
        }
    }

    fn line(_: usize, coordinate: f64) -> Line {
        // As the place along an edge: what `from_edge` makes of it; as the place across: the coordinate from the middle.
        let turns = (coordinate - 0.5) * HALF_EDGE_RAD / PI;
        let a = turns.tan_turns() * SQRT_2;
        let q = 1.0 / (1.0 + a * a).sqrt();
        let reach = q.atan() * FRAC_1_PI;
        [
            (q * a) as f32,
            q as f32,
            reach as f32,
            (coordinate - 0.5) as f32,
        ]
    }

    #[inline(always)]
    fn inverse_lanes(face: u32, columns: [&Lane; 4], row: Line, dirs: &mut DirLanes) {
        if is_x_face(face) {
            frame_lanes(face, dirs, |k| {
                let (sin, cos) = sin_cos_eighth(columns[3][k] * row[2]);
                (sin, cos * row[0], cos * row[1])
            });
        } else {
            frame_lanes(face, dirs, |k| {
                let (sin, cos) = sin_cos_eighth(row[3] * columns[2][k]);
                (cos * columns[0][k], sin, cos * columns[1][k])
            });
        }
    }

    /// Those around +z and -z: their meridians are those of the sphere.
    fn has_meridians(face: u32) -> bool {
        face >= 4
    }

    #[inline(always)]
    fn latitude_lanes(columns: [&Lane; 4], row: Line, latitudes: &mut AngleLanes) {
        latitudes.base = 0.0;
        for (rest, column) in latitudes.rest.iter_mut().zip(columns[2]) {
            *rest = -row[3] * column;
        }
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let Some(point) = Self::forward(dir) else {
            return Vec::new();
        };
        let mut steps = paper::steps(dir);
        let (from_s, from_t) = paper::CHART_TEXT[point.chart as usize];
        steps.push(Step::new("u", from_s, format!("{}", point.u)));
        steps.push(Step::new("v", from_t, format!("{}", point.v)));
        steps
    }
}

const fn is_x_face(face: u32) -> bool {
    face < 2
}

/// L: the place along an edge by arc length; t in [-1, 1].
fn along_edge<R: Real>(t: R) -> R {
    let angle = (t * R::from_f64(std::f64::consts::FRAC_1_SQRT_2)).atan_unit();
    R::half() + angle * R::from_f64(0.5 / HALF_EDGE_RAD)
}

/// M: the latitude over the largest latitude on this meridian; t and s in [-1, 1].
fn across_edge<R: Real>(t: R, s: R) -> R {
    let q = R::one() / (R::one() + s * s).sqrt();
    R::half() + R::half() * (t * q).atan_unit() / q.atan_unit()
}

/// The unit vector (a, b, 1)/n of a face with L(a) = `l` and M(b, a) = `m`, without a division by its length: the latitude
/// gives b, and its cosine what is left for a and 1.
fn from_edge<R: Real>(l: R, m: R) -> (R, R, R) {
    let turns = (l - R::half()) * R::from_f64(HALF_EDGE_RAD / std::f64::consts::PI);
    let a = turns.tan_turns() * R::from_f64(std::f64::consts::SQRT_2);
    let q = R::one() / (R::one() + a * a).sqrt();
    let latitude_turns = (m - R::half()) * q.atan_unit() * R::from_f64(std::f64::consts::FRAC_1_PI);
    let (sin, cos) = latitude_turns.sin_cos_turns();
    (cos * q * a, sin, cos * q)
}
