//! Cubes whose faces are divided by a formula of their own: what such a mapping has to say, and all that follows from it.
//!
//! A face's gnomonic plane has (a, b) in [-1, 1]^2 ([`cube_face`]), its square (p, q) in [-1, 1]^2 with p = 2u - 1, q = 2v - 1.

use super::chart::{to_signed, to_unit};
use super::cube_face::{
    self, face_lanes, frame_lanes, from_gnomonic, gnomonic, is_side, largest_component,
    largest_component_lane, shallow_latitudes,
};
use super::{AngleLanes, ChartPoint, DirLanes, Lane, Line, Mapping, MappingInfo, PointLanes, Step};
use crate::math::{Real, Vec3};

/// The same formula on all six faces, between the gnomonic plane and the square: a smooth bijection that keeps the border.
pub trait FaceMap {
    /// See [`Mapping::INFO`].
    const INFO: MappingInfo;
    /// How u and v are computed from a and b, in letters.
    const FORMULAS: [&'static str; 2];
    /// Whether a depends on p alone, so that columns of the upright faces are meridians.
    const HAS_COLUMNS: bool = false;

    /// See [`Mapping::FACETS`].
    const FACETS: u32 = 1;

    /// (p, q) of (a, b).
    fn from_plane<R: Real>(a: R, b: R) -> (R, R);

    /// (a, b) of (p, q): the inverse of [`from_plane`](Self::from_plane).
    fn to_plane<R: Real>(p: R, q: R) -> (R, R);

    /// See [`Mapping::facet`].
    fn facet<R: Real>(p: R, q: R) -> u32 {
        let _ = (p, q);
        0
    }

    /// [`to_plane`](Self::to_plane) by the formula of one facet.
    fn to_plane_of<R: Real>(facet: u32, p: R, q: R) -> (R, R) {
        let _ = facet;
        Self::to_plane(p, q)
    }

    /// See [`Mapping::line`].
    fn line(coordinate: f64) -> Line {
        [to_signed(coordinate) as f32, 0.0, 0.0, 0.0]
    }

    /// (a, b) of the texel where a column and a row cross.
    #[inline(always)]
    fn crossing(column: f32, row: f32) -> (f32, f32) {
        Self::to_plane(column, row)
    }
}

/// One function that divides both axes alike: odd, increasing, with -1, 0 and 1 where they are.
pub trait Warp {
    /// See [`Mapping::INFO`].
    const INFO: MappingInfo;
    /// See [`FaceMap::FORMULAS`].
    const FORMULAS: [&'static str; 2];

    /// p of a, in [-1, 1].
    fn from_plane<R: Real>(a: R) -> R;

    /// a of p, in [-1, 1].
    fn to_plane<R: Real>(p: R) -> R;
}

impl<W: Warp> FaceMap for W {
    const INFO: MappingInfo = W::INFO;
    const FORMULAS: [&'static str; 2] = W::FORMULAS;
    const HAS_COLUMNS: bool = true;

    #[inline(always)]
    fn from_plane<R: Real>(a: R, b: R) -> (R, R) {
        (W::from_plane(a), W::from_plane(b))
    }

    #[inline(always)]
    fn to_plane<R: Real>(p: R, q: R) -> (R, R) {
        (W::to_plane(p), W::to_plane(q))
    }

    /// What a column or a row shares is its place on the plane.
    fn line(coordinate: f64) -> Line {
        [W::to_plane(to_signed(coordinate)) as f32, 0.0, 0.0, 0.0]
    }

    #[inline(always)]
    fn crossing(column: f32, row: f32) -> (f32, f32) {
        (column, row)
    }
}

/// The direction of a chart point on a face or beyond it: there twice the border's nearest point of the plane, less the point of
/// what lies as far inside the square as the point lies outside.
fn on_or_beyond<R: Real>(point: ChartPoint<R>, to_plane: impl Fn(R, R) -> (R, R)) -> Vec3<R> {
    let (p, q) = (to_signed(point.u), to_signed(point.v));
    let border = |c: R| c.max(-R::one()).min(R::one());
    let (at_p, at_q) = (border(p), border(q));
    if at_p == p && at_q == q {
        let (a, b) = to_plane(p, q);
        return from_gnomonic(point.chart, a, b);
    }
    let (a, b) = to_plane(at_p, at_q);
    let (inner_a, inner_b) = to_plane(R::two() * at_p - p, R::two() * at_q - q);
    from_gnomonic(point.chart, R::two() * a - inner_a, R::two() * b - inner_b)
}

impl<F: FaceMap> Mapping for F {
    const INFO: MappingInfo = F::INFO;

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let (face, a, b) = gnomonic(dir, largest_component)?;
        let (p, q) = F::from_plane(a, b);
        Some(ChartPoint::new(face, to_unit(p), to_unit(q)).clamped())
    }

    /// Beyond the face: on along its plane, so that neither place nor slope jumps at the border, whatever the formula.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        on_or_beyond(point, F::to_plane)
    }

    const FACETS: u32 = F::FACETS;

    fn facet<R: Real>(point: ChartPoint<R>) -> u32 {
        F::facet(to_signed(point.u), to_signed(point.v))
    }

    fn extended<R: Real>(facet: u32, point: ChartPoint<R>) -> Vec3<R> {
        on_or_beyond(point, |p, q| F::to_plane_of(facet, p, q))
    }

    // What reads by lanes knows charts only.
    const HAS_LANES: bool = F::FACETS == 1;

    #[inline(always)]
    fn forward_lanes(dirs: &DirLanes, points: &mut PointLanes) {
        face_lanes(dirs, points, largest_component_lane, Self::from_middle);
    }

    const HAS_FACES: bool = F::FACETS == 1;

    #[inline(always)]
    fn from_middle(_: u32, a: f32, b: f32) -> (f32, f32) {
        let (p, q) = F::from_plane(a, b);
        (0.5 * p, 0.5 * q)
    }

    fn line(_: usize, coordinate: f64) -> Line {
        <F as FaceMap>::line(coordinate)
    }

    #[inline(always)]
    fn inverse_lanes(face: u32, columns: [&Lane; 4], row: Line, dirs: &mut DirLanes) {
        frame_lanes(face, dirs, |k| {
            let (a, b) = F::crossing(columns[0][k], row[0]);
            (a, b, 1.0)
        });
    }

    fn has_meridians(face: u32) -> bool {
        F::HAS_COLUMNS && is_side(face)
    }

    /// The tangent is the height on the plane over the distance from the y axis.
    #[inline(always)]
    fn latitude_lanes(columns: [&Lane; 4], row: Line, latitudes: &mut AngleLanes) {
        shallow_latitudes(latitudes, |k| {
            let (a, b) = F::crossing(columns[0][k], row[0]);
            -b / (1.0 + a * a).sqrt()
        });
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let Some(point) = Self::forward(dir) else {
            return Vec::new();
        };
        let [of_u, of_v] = F::FORMULAS;
        cube_face::steps(dir, |a, b| {
            [
                Step::new("u", of_u, format!("with a = {a}, b = {b}: {}", point.u)),
                Step::new("v", of_v, format!("with a = {a}, b = {b}: {}", point.v)),
            ]
        })
    }
}
