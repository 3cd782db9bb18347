//! Octahedral: the world on the eight faces of an octahedron, unfolded into one square.
//!
//! The centre of the square is +y, the four corners are -y, the edges' middles +-x and +-z.

use super::chart::{to_signed, to_unit};
use super::evaluator;
use super::{Borders, ChartPoint, Family, Mapping, MappingInfo, Step};
use crate::math::{Real, Vec3};

/// See the [module](self).
pub struct Octahedral;

impl Mapping for Octahedral {
    const INFO: MappingInfo = MappingInfo {
        id: "octahedral",
        name: "Octahedral",
        about: "One square without a trigonometric function: the lower half is folded out into the corners.",
        source: "Engelhardt and Dachsbacher 2008",
        family: Family::Octahedra,
        charts: &["square"],
        evaluators: || evaluator::plain_and::<Octahedral>(&[]),
        borders: Borders::FoldedSides,
        ..MappingInfo::PLAIN
    };

    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
        let d = dir.scaled_direction()?;
        let sum = d.x.abs() + d.y.abs() + d.z.abs();
        let (x, z) = (d.x / sum, d.z / sum);
        let (x, z) = if d.y < R::zero() { fold(x, z) } else { (x, z) };
        Some(ChartPoint::new(0, to_unit(x), to_unit(z)).clamped())
    }

    /// Beyond an edge: back in at the mirrored place.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R> {
        let (x, z) = wrap(to_signed(point.u), to_signed(point.v));
        let y = R::one() - x.abs() - z.abs();
        let (x, z) = if y < R::zero() { fold(x, z) } else { (x, z) };
        Vec3::new(x, y, z).normalized()
    }

    const FACETS: u32 = 8;

    fn facet<R: Real>(point: ChartPoint<R>) -> u32 {
        octant(point)
    }

    /// The plane of the octahedron's face goes on.
    fn extended<R: Real>(facet: u32, point: ChartPoint<R>) -> Vec3<R> {
        let Octant { signs, legs } = Octant::of(facet, point);
        let y = R::one() - legs[0] - legs[1];
        let [x, z] = if facet & BELOW == 0 {
            legs
        } else {
            [R::one() - legs[1], R::one() - legs[0]]
        };
        Vec3::new(x * signs[0], y, z * signs[1]).normalized()
    }

    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
        let (Some(d), Some(point)) = (dir.scaled_direction(), Self::forward(dir)) else {
            return Vec::new();
        };
        let Vec3 { x, y, z } = d;
        let sum = x.abs() + y.abs() + z.abs();
        let (ox, oz) = (x / sum, z / sum);
        let mut steps = vec![
            Step::new(
                "sum",
                "s = |x| + |y| + |z|",
                format!("|{x}| + |{y}| + |{z}| = {sum}"),
            ),
            Step::new("on the octahedron", "(x, z)/s", format!("({ox}, {oz})")),
        ];
        let (ox, oz) = if y < R::zero() {
            let folded = fold(ox, oz);
            steps.push(Step::new(
                "fold (y < 0)",
                "((1 − |oz|) sgn ox, (1 − |ox|) sgn oz)",
                format!("({}, {})", folded.0, folded.1),
            ));
            folded
        } else {
            (ox, oz)
        };
        steps.push(Step::new(
            "u",
            "u = (ox + 1)/2",
            format!("({ox} + 1)/2 = {}", point.u),
        ));
        steps.push(Step::new(
            "v",
            "v = (oz + 1)/2",
            format!("({oz} + 1)/2 = {}", point.v),
        ));
        steps
    }
}

/// Bits of a facet's number: x is negative, z is, y is.
const LEFT: u32 = 1;
const BEHIND: u32 = 2;
pub(super) const BELOW: u32 = 4;

/// The face of the octahedron on which a point of the square lies.
pub(super) fn octant<R: Real>(point: ChartPoint<R>) -> u32 {
    let (x, z) = (to_signed(point.u), to_signed(point.v));
    let bit = |is_so: bool, bit: u32| if is_so { bit } else { 0 };
    bit(x < R::zero(), LEFT) | bit(z < R::zero(), BEHIND) | bit(x.abs() + z.abs() > R::one(), BELOW)
}

/// A point as one face sees it.
pub(super) struct Octant<R> {
    /// Of x and z in the face.
    pub signs: [R; 2],
    /// x and z from the square's middle, counted with these signs: not negative within the face.
    pub legs: [R; 2],
}

impl<R: Real> Octant<R> {
    pub fn of(facet: u32, point: ChartPoint<R>) -> Self {
        let sign = |bit: u32| {
            if facet & bit == 0 {
                R::one()
            } else {
                -R::one()
            }
        };
        let signs = [sign(LEFT), sign(BEHIND)];
        let legs = [to_signed(point.u) * signs[0], to_signed(point.v) * signs[1]];
        Self { signs, legs }
    }
}

/// Folds a point of the square over the diamond's edge; its own inverse.
pub(super) fn fold<R: Real>(x: R, z: R) -> (R, R) {
    (
        (R::one() - z.abs()) * x.sign_or_one(),
        (R::one() - x.abs()) * z.sign_or_one(),
    )
}

/// A point beyond the square's edge, brought back: each edge is folded onto itself around its middle.
pub(super) fn wrap<R: Real>(x: R, z: R) -> (R, R) {
    let back = |c: R| c.sign_or_one() * R::two() - c;
    let (x, z) = if x.abs() > R::one() {
        (back(x), -z)
    } else {
        (x, z)
    };
    if z.abs() > R::one() {
        (-x, back(z))
    } else {
        (x, z)
    }
}
