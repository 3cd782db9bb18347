//! HEALPix: twelve squares with the same solid angle in every texel, in rings of equal latitude.
//!
//! Charts are the base pixels in HEALPix's own order: 0 to 3 around the north pole, 4 to 7 on the equator, 8 to 11 around the south pole.
//! HEALPix's z is +y, the pole; its longitude starts at +z and grows towards +x, as the [latlong](super::latlong)'s does. Its place
//! (x, y) within a base pixel, counted from the southern corner to the north-east and to the north-west, is (u, 1 - v): a chart is
//! HEALPix's picture turned by an eighth clockwise, seen from inside and not mirrored, with north at the right upper corner.
//!
//! Where |sin latitude| <= 2/3, in the belt, columns and rows are straight lines of longitude and sin latitude. Around the poles a
//! quarter of longitude becomes a triangle. On four charts and on the other four both meet along the diagonal u = v, where the map is bent.
//! Around a pole a chart begins with its quarter: the meridians +z, +x, -z and -x belong to the chart east of them. In the belt a
//! border belongs to the chart beyond it to the east, as nearly as the number type can tell.

use super::cube_face::{Neighbour, Side};
use super::{Borders, ChartPoint, Claims, Family, Layout, Mapping, MappingInfo, Step, evaluator};
use crate::math::{Real, Vec3};
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// See the [module](self).
pub struct Healpix;

/// Sine of the latitude at which the belt ends.
const BELT: f64 = 2.0 / 3.0;

impl Mapping for Healpix {
    const INFO: MappingInfo = MappingInfo {
        id: "healpix",
        name: "HEALPix",
        about: "Twelve squares with the same solid angle in every texel, whose centres lie on rings of equal latitude.",
        source: "Gorski et al. 2005; Calabretta and Roukema 2007",
        family: Family::EqualPixels,
        charts: &[
            "n0", "n1", "n2", "n3", "e0", "e1", "e2", "e3", "s0", "s1", "s2", "s3",
        ],
        layout: Layout::Staircase,
        claims: Claims {
            equal_area: true,
            ..MappingInfo::PLAIN.claims
        },
        evaluators: evaluator::shaders_with_arctangents,
        borders: Borders::BasePixelEdges,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        let n = d.length();
        let quarter = quarter(d);
        let share = share(d, quarter);
        if d.y.abs() > n * R::from_f64(BELT) {
            let radius = cap_radius(d, n);
            let (along, rest) = (radius * share, radius * (R::one() - share));
            return Some(if d.y > R::zero() {
                ChartPoint::new(quarter, R::one() - rest, along).clamped()
            } else {
                ChartPoint::new(8 + quarter, along, R::one() - rest).clamped()
            });
        }
        let height = d.y / n * R::from_f64(0.75);
        let middle = share - R::half();
        let (right, down) = (middle + height, middle - height);
        let next = (quarter + 1) % 4;
        let (is_right, is_down) = (right >= R::zero(), down >= R::zero());
        let chart = match (is_right, is_down) {
            (true, true) => 4 + next,
            (false, false) => 4 + quarter,
            (true, false) => quarter,
            (false, true) => 8 + quarter,
        };
        let u = if is_right { right } else { R::one() + right };
        let v = if is_down { down } else { R::one() + down };
        Some(ChartPoint::new(chart, u, v).clamped())
    }

    /// Beyond a side: on the chart across it, as far within. Beyond two, the side that is farther off is crossed first.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let ChartPoint { chart, u, v } = step_over(step_over(point));
        let is_cap = match chart / 4 {
            0 => u > v,
            1 => false,
            _ => v > u,
        };
        if is_cap {
            cap(chart, u, v)
        } else {
            belt(chart, u, v)
        }
    }

    /// What lies on either side of the diagonal.
    const FACETS: u32 = 2;

    fn facet<R: Real>(point: ChartPoint<R>) -> u32 {
        u32::from(point.u > point.v)
    }

    /// The formula of the half goes on, as far as it has sense: not around a pole, where four charts meet in a point, nor over one.
    fn extended<R: Real>(facet: u32, point: ChartPoint<R>) -> Vec3<R> {
        let ChartPoint { chart, u, v } = point;
        let is_cap = matches!((chart / 4, facet), (0, 1) | (2, 0));
        if is_cap {
            let (along, rest) = legs(chart, u, v);
            let radius = along + rest;
            // Half a quarter turn beyond its own, and down to the equator.
            let is_near = along.min(rest) * R::two() > -radius;
            if is_near && radius < R::from_f64(1.5) {
                return cap(chart, u, v);
            }
        } else if belt_height(chart, u, v).abs() < R::from_f64(0.9) {
            return belt(chart, u, v);
        }
        Self::continued(point)
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let n = d.length();
        let quarter = quarter(d);
        let t = share(d, quarter);
        let mut steps = vec![
            Step::length(d, n),
            Step::new(
                "longitude",
                "k + t = (2/π) atan2(x, z), k whole, 0 ≤ t < 1",
                format!("(2/π) atan2({}, {}) = {quarter} + {t}", d.x, d.z),
            ),
        ];
        let [u, v] = if d.y.abs() > n * R::from_f64(BELT) {
            steps.push(Step::new(
                "cap (|y| > 2n/3)",
                "σ = √(3(1 − |y|/n))",
                format!("√(3(1 − |{}|/{n})) = {}", d.y, cap_radius(d, n)),
            ));
            if d.y > R::zero() {
                ["u = 1 − (1 − t)σ", "v = tσ"]
            } else {
                ["u = tσ", "v = 1 − (1 − t)σ"]
            }
        } else {
            let h = d.y / n * R::from_f64(0.75);
            steps.push(Step::new(
                "belt (|y| ≤ 2n/3)",
                "h = 3y/(4n)",
                format!("3 · {}/(4 · {n}) = {h}", d.y),
            ));
            ["u = frac(1/2 + t + h)", "v = frac(1/2 + t − h)"]
        };
        steps.push(Step::new("u", u, format!("{}", point.u)));
        steps.push(Step::new("v", v, format!("{}", point.v)));
        steps
    }
}

/// What lies across a side of a base pixel.
pub fn across(chart: u32, side: Side) -> Neighbour {
    let (ring, here) = (chart / 4, chart % 4);
    let (east, west) = ((here + 1) % 4, (here + 3) % 4);
    let (face, side, is_reversed) = match (ring, side) {
        (0, Side::Left) => (4 + here, Side::Right, false),
        (0, Side::Bottom) => (4 + east, Side::Top, false),
        (0, Side::Right) => (east, Side::Top, true),
        (0, Side::Top) => (west, Side::Right, true),
        (1, Side::Left) => (8 + west, Side::Right, false),
        (1, Side::Right) => (here, Side::Left, false),
        (1, Side::Top) => (west, Side::Bottom, false),
        (1, Side::Bottom) => (8 + here, Side::Top, false),
        (_, Side::Right) => (4 + east, Side::Left, false),
        (_, Side::Top) => (4 + here, Side::Bottom, false),
        (_, Side::Left) => (8 + west, Side::Bottom, true),
        (_, Side::Bottom) => (8 + east, Side::Left, true),
    };
    Neighbour {
        face,
        side,
        is_reversed,
    }
}

/// A point beyond a side on the chart across it; any other as it is.
fn step_over<R: Real>(point: ChartPoint<R>) -> ChartPoint<R> {
    let ChartPoint { chart, u, v } = point;
    let beyond = |c: R| (-c).max(c - R::one());
    let (aside, above) = (beyond(u), beyond(v));
    if !(aside > R::zero() || above > R::zero()) {
        return point;
    }
    let (side, depth, along) = if aside >= above {
        let side = if u < R::zero() {
            Side::Left
        } else {
            Side::Right
        };
        (side, aside, v)
    } else {
        let side = if v < R::zero() {
            Side::Top
        } else {
            Side::Bottom
        };
        (side, above, u)
    };
    let to = across(chart, side);
    let along = if to.is_reversed {
        R::one() - along
    } else {
        along
    };
    let (u, v) = match to.side {
        Side::Left => (depth, along),
        Side::Right => (R::one() - depth, along),
        Side::Top => (along, depth),
        Side::Bottom => (along, R::one() - depth),
    };
    ChartPoint::new(to.face, u, v)
}

/// The quarter of longitude from +z, +x, -z or -x on; 0 at a pole. By signs alone, so that it is the same in every number type.
fn quarter<R: Real>(d: Vec3<R>) -> u32 {
    let zero = R::zero();
    let is_on_axis = d.x == zero;
    if d.x < zero || (is_on_axis && d.z < zero) {
        if d.z < zero { 2 } else { 3 }
    } else if d.z > zero || is_on_axis {
        0
    } else {
        1
    }
}

/// How much of its quarter lies west of a direction, in [0, 1].
fn share<R: Real>(d: Vec3<R>, quarter: u32) -> R {
    let (from, to) = match quarter {
        0 => (d.z, d.x),
        1 => (d.x, -d.z),
        2 => (-d.z, -d.x),
        _ => (-d.x, d.z),
    };
    to.atan2(from) * R::from_f64(2.0 * FRAC_1_PI)
}

/// sqrt(3 (1 - |y|/n)), which is 0 at the pole and 1 where the belt begins, from the distance to the axis: nothing cancels.
fn cap_radius<R: Real>(d: Vec3<R>, n: R) -> R {
    let across = d.x.hypot(d.z);
    R::from_f64(3.0_f64.sqrt()) * across / (n * (n + d.y.abs())).sqrt()
}

/// The direction at a share of a quarter, so far from the axis, and so high.
fn in_quarter<R: Real>(quarter: u32, [from, to]: [R; 2], height: R) -> Vec3<R> {
    match quarter {
        0 => Vec3::new(to, height, from),
        1 => Vec3::new(from, height, -to),
        2 => Vec3::new(-to, height, -from),
        _ => Vec3::new(-from, height, to),
    }
}

/// Of a point of a cap's triangle: distances from the pole along the quarter's end and along its beginning.
fn legs<R: Real>(chart: u32, u: R, v: R) -> (R, R) {
    if chart < 4 {
        (v, R::one() - u)
    } else {
        (u, R::one() - v)
    }
}

fn cap<R: Real>(chart: u32, u: R, v: R) -> Vec3<R> {
    let (along, rest) = legs(chart, u, v);
    let radius = along + rest;
    let third = R::from_f64(1.0 / 3.0);
    let square = radius * radius * third;
    let height = if chart < 4 {
        R::one() - square
    } else {
        square - R::one()
    };
    if radius <= R::zero() {
        // At the pole there is no share, and no one slope: that of the meridian at which the quarter begins.
        let slope = R::from_f64((2.0_f64 / 3.0).sqrt());
        let turn = R::from_f64(FRAC_PI_2) * along;
        return in_quarter(chart % 4, [slope * radius, slope * turn], height);
    }
    let (sin, cos) = (along / radius * R::from_f64(0.25)).sin_cos_turns();
    let across = radius * ((R::two() - square).max(R::zero()) * third).sqrt();
    in_quarter(chart % 4, [across * cos, across * sin], height)
}

/// sin latitude by the belt's formula.
fn belt_height<R: Real>(chart: u32, u: R, v: R) -> R {
    let ring = R::from_f64(1.0 - f64::from(chart / 4));
    (u - v + ring) * R::from_f64(BELT)
}

fn belt<R: Real>(chart: u32, u: R, v: R) -> Vec3<R> {
    let height = belt_height(chart, u, v);
    // On the equator a chart lies on both sides of the meridian at which its quarter begins.
    let begin = if chart / 4 == 1 { R::one() } else { R::zero() };
    let (sin, cos) = ((u + v - begin) * R::from_f64(0.125)).sin_cos_turns();
    let across = ((R::one() - height) * (R::one() + height))
        .max(R::zero())
        .sqrt();
    in_quarter(chart % 4, [across * cos, across * sin], height)
}
