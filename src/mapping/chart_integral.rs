//! Integrals over a chart or a part of it, to the last digits also where the mapping is bent and where a rim cuts.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

use super::{ChartPoint, Domain, MappingId};
use crate::math::Rule;

/// Lines a u + b v = c along which mappings may be bent within a chart: its middles, its diagonals, and the diamond between
/// the middles of its sides, on which the octahedron is folded.
const BENDS: [[f64; 3]; 8] = [
    [1.0, 0.0, 0.5],
    [0.0, 1.0, 0.5],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, 0.5],
    [1.0, 1.0, 1.5],
    [1.0, -1.0, 0.5],
    [1.0, -1.0, -0.5],
];

/// From u and v to what they are multiplied with.
type Range = [f64; 2];

/// Integral of `f` over the part [u range, v range] of a chart, as far as it lies in the domain. `rule` is used along each side of
/// each smooth piece.
pub fn integrate<const N: usize>(
    domain: Domain,
    part: [Range; 2],
    rule: &Rule,
    mut f: impl FnMut(f64, f64) -> [f64; N],
) -> [f64; N] {
    let mut sum = [0.0; N];
    let mut add = |u: f64, v: f64, weight: f64| {
        let value = f(u, v);
        sum.iter_mut()
            .zip(value)
            .for_each(|(sum, value)| *sum += weight * value);
    };
    match domain {
        Domain::Square if BENDS.iter().any(|bend| crosses(part, *bend)) => {
            for piece in pieces(part) {
                over_polygon(&piece, rule, &mut add);
            }
        }
        Domain::Disc => over_disc(part, rule, &mut add),
        _ => {
            for (u, weight_u) in rule.over(part[0]) {
                for (v, weight_v) in rule.over(part[1]) {
                    add(u, v, weight_u * weight_v);
                }
            }
        }
    }
    sum
}

/// How far a place lies beyond a line.
fn beyond([a, b, c]: [f64; 3], [u, v]: [f64; 2]) -> f64 {
    a * u + b * v - c
}

fn corners([u, v]: [Range; 2]) -> [[f64; 2]; 4] {
    [[u[0], v[0]], [u[1], v[0]], [u[1], v[1]], [u[0], v[1]]]
}

fn crosses(part: [Range; 2], bend: [f64; 3]) -> bool {
    let sides = corners(part).map(|corner| beyond(bend, corner));
    sides.iter().any(|d| *d > 0.0) && sides.iter().any(|d| *d < 0.0)
}

/// The convex pieces into which the bends cut a part of a chart.
fn pieces(part: [Range; 2]) -> Vec<Vec<[f64; 2]>> {
    let mut pieces = vec![corners(part).to_vec()];
    for bend in BENDS.into_iter().filter(|bend| crosses(part, *bend)) {
        let back = bend.map(|c| -c);
        pieces = pieces
            .iter()
            .flat_map(|piece| [cut(piece, bend), cut(piece, back)])
            .filter(|piece| piece.len() > 2)
            .collect();
    }
    pieces
}

/// What of a convex polygon does not lie beyond a line.
fn cut(polygon: &[[f64; 2]], line: [f64; 3]) -> Vec<[f64; 2]> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &from) in polygon.iter().enumerate() {
        let to = polygon[(k + 1) % polygon.len()];
        let (here, there) = (beyond(line, from), beyond(line, to));
        if here <= 0.0 {
            kept.push(from);
        }
        if here * there < 0.0 {
            let share = here / (here - there);
            kept.push([0, 1].map(|i: usize| from[i] + share * (to[i] - from[i])));
        }
    }
    kept
}

/// A convex polygon as a fan of triangles, each the image of a square: (s, t) to a + s (b - a) + s t (c - b).
fn over_polygon(polygon: &[[f64; 2]], rule: &Rule, add: &mut impl FnMut(f64, f64, f64)) {
    let [a, rest @ ..] = polygon else { return };
    for pair in rest.windows(2) {
        let [ab, bc] = [0, 1].map(|k: usize| {
            let [from, to] = if k == 0 {
                [*a, pair[0]]
            } else {
                [pair[0], pair[1]]
            };
            [to[0] - from[0], to[1] - from[1]]
        });
        let twice_area = (ab[0] * bc[1] - ab[1] * bc[0]).abs();
        for (s, weight_s) in rule.over([0.0, 1.0]) {
            for (t, weight_t) in rule.over([0.0, 1.0]) {
                let place = [0, 1].map(|i: usize| a[i] + s * (ab[i] + t * bc[i]));
                add(place[0], place[1], weight_s * weight_t * s * twice_area);
            }
        }
    }
}

/// Radius of a disc.
const RIM: f64 = 0.5;

/// In polar coordinates around the disc's middle: between the angles of corners, and of places where a side meets the rim, both
/// ends of a ray are smooth in the angle.
fn over_disc(part: [Range; 2], rule: &Rule, add: &mut impl FnMut(f64, f64, f64)) {
    let sides = part.map(|range| range.map(|c| c - 0.5));
    let angle = |[x, y]: [f64; 2]| f64::atan2(y, x);
    let mut breaks: Vec<f64> = corners(sides).into_iter().map(angle).collect();
    // Quarters of a turn too, so that no interval reaches around the middle.
    breaks.extend((-2..=2).map(|k| f64::from(k) * FRAC_PI_2));
    for (axis, ends) in sides.iter().enumerate() {
        for end in ends.iter().filter(|end| end.abs() < RIM) {
            let along = (RIM * RIM - end * end).sqrt();
            for along in [along, -along] {
                breaks.push(angle(if axis == 0 {
                    [*end, along]
                } else {
                    [along, *end]
                }));
            }
        }
    }
    breaks.sort_by(f64::total_cmp);
    for ends in breaks.windows(2) {
        let middle = 0.5 * (ends[0] + ends[1]);
        if ends[0] == ends[1] || ray(sides, middle).is_none() {
            continue;
        }
        for (s, weight) in rule.over([0.0, 1.0]) {
            // Where a side meets the rim, the angle r is taken by leaves like a root: a sine squared takes that away at both ends.
            let (sin_s, cos_s) = (s * FRAC_PI_2).sin_cos();
            let angle = ends[0] + (ends[1] - ends[0]) * sin_s * sin_s;
            let weight = weight * (ends[1] - ends[0]) * PI * sin_s * cos_s;
            let Some([near, far]) = ray(sides, angle) else {
                continue;
            };
            let (sin, cos) = angle.sin_cos();
            let mut add_at = |r: f64, weight: f64| add(0.5 + r * cos, 0.5 + r * sin, weight * r);
            // r = sin(t)/2 takes away a root at the rim.
            let [from, to] = [near, far].map(|r| (r / RIM).min(1.0).asin());
            for (t, weight_t) in rule.over([from, to]) {
                let (sin_t, cos_t) = t.sin_cos();
                add_at(RIM * sin_t, weight * weight_t * RIM * cos_t);
            }
        }
    }
}

/// From where to where a ray from the middle is in a box and in the disc.
fn ray(sides: [Range; 2], angle: f64) -> Option<Range> {
    let (sin, cos) = angle.sin_cos();
    let (mut near, mut far) = (0.0_f64, RIM);
    for (ends, slope) in sides.into_iter().zip([cos, sin]) {
        let [a, b] = ends.map(|end| end / slope);
        near = near.max(a.min(b));
        far = far.min(a.max(b));
    }
    (near < far).then_some([near, far])
}

/// Nodes along a side of a texel, of a square chart and of a disc: with 64 rows the sum over any mapping is right to 1e-12 sr.
static TEXEL_RULES: LazyLock<[Rule; 2]> = LazyLock::new(|| [5, 16].map(Rule::new));

impl MappingId {
    /// Solid angle in sr of the texel (column, row) of a chart of `size` = [width, height] texels, as far as it lies in the domain.
    /// Bends and rims are followed; on a square chart the error is of the tenth order of the texel's size.
    pub fn texel_solid_angle_sr(self, chart: u32, texel: [u32; 2], size: [u32; 2]) -> f64 {
        let part =
            [0, 1].map(|k: usize| [0, 1].map(|end| f64::from(texel[k] + end) / f64::from(size[k])));
        let domain = self.info().domain;
        let rule = &TEXEL_RULES[usize::from(domain == Domain::Disc)];
        let [sum] = integrate(domain, part, rule, |u, v| {
            let jacobian = self.jacobian(ChartPoint::new(chart, u, v));
            [jacobian.map_or(0.0, |(_, jacobian)| jacobian.area_scale())]
        });
        sum
    }

    /// Sum of the solid angles of all texels in sr, with `rows` texels along a chart's height; by rows and charts, as the roundings of
    /// many equal texels would add up. `None` once `goes_on`, which is asked at every row, says no.
    pub fn solid_angle_sum_sr(self, rows: u32, goes_on: impl Fn() -> bool) -> Option<f64> {
        let info = self.info();
        let columns = (f64::from(rows) * info.aspect).round() as u32;
        let row = |chart: u32, row: u32| -> f64 {
            (0..columns)
                .map(|column| self.texel_solid_angle_sr(chart, [column, row], [columns, rows]))
                .sum()
        };
        let row = |chart: u32, k: u32| goes_on().then(|| row(chart, k));
        let chart = |chart: u32| -> Option<f64> { (0..rows).map(|k| row(chart, k)).sum() };
        (0..info.chart_count()).map(chart).sum()
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    const WHOLE: [Range; 2] = [[0.0, 1.0], [0.0, 1.0]];

    #[test]
    fn a_sum_is_given_up_at_the_next_row() {
        let asked = Cell::new(0);
        let sum = |last: u32| {
            asked.set(0);
            MappingId::Cube.solid_angle_sum_sr(8, || {
                asked.set(asked.get() + 1);
                asked.get() < last
            })
        };
        assert_eq!((sum(11), asked.get()), (None, 11));
        assert!(sum(49).is_some() && asked.get() == 48, "control");
    }

    #[test]
    fn the_bends_cut_a_chart_into_sixteen_triangles() {
        let pieces = pieces(WHOLE);
        assert_eq!(pieces.len(), 16);
        assert!(pieces.iter().all(|piece| piece.len() == 3));
        assert_eq!(super::pieces([[0.0, 0.25], [0.5, 0.625]]).len(), 2);
    }

    #[test]
    fn a_bent_function_is_integrated_exactly() {
        // |u - v| + |u + v - 1/2| has creases along a diagonal and a side of the diamond.
        let bent = |u: f64, v: f64| [(u - v).abs() + (u + v - 0.5).abs()];
        let rule = Rule::new(3);
        // The mean of |u - v| is 1/3; that of |u + v - 1/2| is that of u + v - 1/2 and twice the part below: 1/2 + 2/48.
        let [sum] = integrate(Domain::Square, WHOLE, &rule, bent);
        let expected = 1.0 / 3.0 + 0.5 + 2.0 / 48.0;
        assert!((sum - expected).abs() < 1e-15, "{sum}");
        // Parts sum to the whole, wherever they are cut.
        let ends = [0.0, 0.21, 0.55, 0.83, 1.0];
        let mut parts = 0.0;
        for u in ends.windows(2) {
            for v in ends.windows(2) {
                let part = [[u[0], u[1]], [v[0], v[1]]];
                parts += integrate(Domain::Square, part, &rule, bent)[0];
            }
        }
        assert!((parts - expected).abs() < 1e-15, "{parts}");
        // Control: a crease elsewhere is not found.
        let other = |u: f64, _: f64| [(u - 0.3).abs()];
        let [sum] = integrate(Domain::Square, WHOLE, &rule, other);
        assert!((sum - (0.09 + 0.49) / 2.0).abs() > 1e-4, "{sum}");
    }

    #[test]
    fn the_parts_of_a_disc_sum_to_it() {
        // The disc's area, and half a sphere over it, whose height has a root at the rim: 2/3 pi r^3.
        let height = |u: f64, v: f64| {
            let square = 0.25 - (u - 0.5).powi(2) - (v - 0.5).powi(2);
            [1.0, square.max(0.0).sqrt()]
        };
        let expected = [0.25, 1.0 / 12.0].map(|c| c * PI);
        for count in [1, 2, 3, 16] {
            let rule = Rule::new(12);
            let mut sum = [0.0; 2];
            for column in 0..count {
                for row in 0..count {
                    let end = |k: u32| f64::from(k) / f64::from(count);
                    let part = [[end(column), end(column + 1)], [end(row), end(row + 1)]];
                    let found = integrate(Domain::Disc, part, &rule, height);
                    sum = [sum[0] + found[0], sum[1] + found[1]];
                }
            }
            for (sum, expected) in sum.into_iter().zip(expected) {
                // Observed: at most 1e-13, where one part is the whole.
                assert!(
                    (sum / expected - 1.0).abs() < 1e-12,
                    "{count}: {sum} {expected}"
                );
            }
        }
    }
}
