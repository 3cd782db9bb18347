//! What the Jacobian says: derivatives, solid angles, and the claims that rest on them.

use sixfold::mapping::{ChartPoint, Domain, MappingId};
use sixfold::math::Vec3;

use crate::inputs::inner_points;
use crate::report::{Finding, Worst};
use crate::subject::{Fault, Subject};

/// The dual numbers' Jacobian against differences over five points, relative to its larger column.
pub fn jacobian(subject: &Subject) -> Vec<Finding> {
    let info = subject.info();
    // The rule's error is h^4/30 times the fifth derivative, which near a rim or a pole is the inverse fifth power of the
    // margin and more; the digits lost by the difference are f64's over h.
    const STEP: f64 = 5e-5;
    const MARGIN: f64 = 0.02;
    let points = inner_points(
        31,
        info.chart_count(),
        info.domain,
        MARGIN,
        subject.effort / 10,
    );
    let mut worst = Worst::default();
    for p in points {
        let at = |du: f64, dv: f64| {
            let moved = ChartPoint::new(p.chart, p.u + du * STEP, p.v + dv * STEP);
            subject
                .map
                .inverse(moved)
                .unwrap_or(Vec3::from_f64([f64::NAN; 3]))
        };
        // As far from a bend as from a border.
        let is_bent = [[MARGIN, 0.0], [-MARGIN, 0.0], [0.0, MARGIN], [0.0, -MARGIN]]
            .into_iter()
            .any(|[du, dv]| {
                let moved = ChartPoint::new(p.chart, p.u + du, p.v + dv);
                subject.map.facet(moved) != subject.map.facet(p)
            });
        if is_bent {
            continue;
        }
        let difference = |du: f64, dv: f64| {
            let near = at(du, dv) - at(-du, -dv);
            let far = at(2.0 * du, 2.0 * dv) - at(-2.0 * du, -2.0 * dv);
            (near * 8.0 - far) * (1.0 / (12.0 * STEP))
        };
        let Some(jacobian) = subject.jacobian(p) else {
            worst.see(f64::NAN);
            continue;
        };
        let size = jacobian.du.length().max(jacobian.dv.length());
        worst.see((jacobian.du - difference(1.0, 0.0)).length() / size);
        worst.see((jacobian.dv - difference(0.0, 1.0)).length() / size);
    }
    vec![Finding::new("relative", worst.0, 3e-11)]
}

/// Nodes and weights of Gauss-Legendre quadrature on [0, 1], by Newton's method on the Legendre polynomial.
fn gauss<const N: usize>() -> [(f64, f64); N] {
    std::array::from_fn(|i| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (N as f64 + 0.5)).cos();
        let mut slope = 0.0;
        for _ in 0..10 {
            let (mut p, mut last) = (1.0, 0.0);
            for k in 0..N {
                let k = k as f64;
                (p, last) = (((2.0 * k + 1.0) * x * p - k * last) / (k + 1.0), p);
            }
            slope = N as f64 * (x * p - last) / (x * x - 1.0);
            x -= p / slope;
        }
        (0.5 + 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope))
    })
}

/// Sum of the solid angles of all texels; the chart's area scale integrated over the domain.
fn covered_sr(subject: &Subject) -> f64 {
    let info = subject.info();
    let scale = |chart, u, v| {
        let jacobian = subject.jacobian(ChartPoint::new(chart, u, v));
        jacobian.map_or(f64::NAN, |jacobian| jacobian.area_scale())
    };
    let rule = gauss::<24>();
    let mut sum = 0.0;
    for chart in 0..info.chart_count() {
        sum += match (info.domain, subject.map) {
            // rho = sin(t)/2 takes away the root at the rim; the periodic direction needs no weights.
            (Domain::Disc, _) => (0..96)
                .map(|turn| {
                    let (sin, cos) = (std::f64::consts::TAU * f64::from(turn) / 96.0).sin_cos();
                    let spoke = rule.iter().map(|(node, weight)| {
                        let (sin_t, cos_t) = (node * std::f64::consts::FRAC_PI_2).sin_cos();
                        let rho = 0.5 * sin_t;
                        let area = rho * 0.5 * cos_t * std::f64::consts::FRAC_PI_2;
                        weight * area * scale(chart, 0.5 + rho * cos, 0.5 + rho * sin)
                    });
                    spoke.sum::<f64>() * std::f64::consts::TAU / 96.0
                })
                .sum::<f64>(),
            // The area scale has a crease along the diamond: its triangles one by one (p = s, q = (1 - s) t, and folded).
            (Domain::Square, MappingId::Octahedral | MappingId::OctahedralEqualArea) => {
                let mut sum = 0.0;
                for (s, weight_s) in rule {
                    for (t, weight_t) in rule {
                        let (p, q) = (s, (1.0 - s) * t);
                        for (p, q) in [(p, q), (1.0 - q, 1.0 - p)] {
                            for sign in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
                                let (u, v) = (0.5 + 0.5 * sign[0] * p, 0.5 + 0.5 * sign[1] * q);
                                let area = 0.25 * (1.0 - s) * weight_s * weight_t;
                                sum += area * scale(chart, u, v);
                            }
                        }
                    }
                }
                sum
            }
            // Members of the cube family may be bent along the middles of their faces or along the diagonals: the eight triangles
            // between them one by one (p = s, q = s t, and exchanged).
            (Domain::Square, map) if map.info().chart_count() == 6 => {
                let mut sum = 0.0;
                for (s, weight_s) in rule {
                    for (t, weight_t) in rule {
                        for (p, q) in [(s, s * t), (s * t, s)] {
                            for sign in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
                                let (u, v) = (0.5 + 0.5 * sign[0] * p, 0.5 + 0.5 * sign[1] * q);
                                sum += 0.25 * s * weight_s * weight_t * scale(chart, u, v);
                            }
                        }
                    }
                }
                sum
            }
            (Domain::Square, _) => rule
                .iter()
                .flat_map(|u| rule.iter().map(move |v| (u, v)))
                .map(|((u, weight_u), (v, weight_v))| weight_u * weight_v * scale(chart, *u, *v))
                .sum::<f64>(),
        };
    }
    sum
}

/// Sum of the solid angles of all texels at `height` rows a chart, by the library's own rule.
fn texel_sum_sr(subject: &Subject, height: u32) -> f64 {
    let info = subject.info();
    let width = (f64::from(height) * info.aspect).round() as u32;
    let size = [width, height];
    let mut sum = 0.0;
    for chart in 0..info.chart_count() {
        for texel in 0..width * height {
            let texel = [texel % width, texel / width];
            sum += subject.map.texel_solid_angle_sr(chart, texel, size);
        }
    }
    sum * if subject.is(Fault::Skewed) { 1.05 } else { 1.0 }
}

/// Solid angles sum to the coverage.
pub fn solid_angles(subject: &Subject) -> Vec<Finding> {
    let coverage = subject.info().coverage.solid_angle_sr();
    let off = |sum: f64| (sum - coverage).abs();
    let integral = Finding::new("integral, sr", off(covered_sr(subject)), 5e-13);
    let texels = off(texel_sum_sr(subject, 64));
    let texels = match subject.info().domain {
        // Texels that a rim cuts count by the nodes inside: no better than a part of a texel around the rim.
        Domain::Disc => Finding::new("texels of a disc of 64 x 64, sr", texels, 0.15),
        Domain::Square if subject.map == MappingId::Octahedral => {
            Finding::new("64 x 64 texels, with creases, sr", texels, 6e-4)
        }
        // Its root is near the border, and nine nodes a texel follow it less well.
        Domain::Square if subject.map == MappingId::Everitt => {
            Finding::new("64 x 64 texels, by a root, sr", texels, 2.5e-9)
        }
        Domain::Square => Finding::new("64 x 64 texels, sr", texels, 1e-11),
    };
    vec![integral, texels]
}

/// (largest over smallest area scale, largest anisotropy) over inner points.
fn distortion(subject: &Subject) -> (f64, f64) {
    let info = subject.info();
    let points = inner_points(
        32,
        info.chart_count(),
        info.domain,
        1e-3,
        subject.effort / 10,
    );
    let (mut least, mut most, mut anisotropy) = (f64::INFINITY, Worst::default(), Worst::default());
    for p in points {
        let Some(jacobian) = subject.jacobian(p) else {
            most.see(f64::NAN);
            continue;
        };
        let scale = jacobian.area_scale();
        least = least.min(scale);
        most.see(scale);
        anisotropy.see(jacobian.anisotropy());
    }
    (most.0 / least, anisotropy.0)
}

/// Equal-area and conformal maps are what they say, and the others are seen not to be.
pub fn claims(subject: &Subject) -> Vec<Finding> {
    let claims = subject.info().claims;
    let (ratio, anisotropy) = distortion(subject);
    vec![
        if claims.equal_area {
            Finding::new("equal-area: area scale, spread", ratio - 1.0, 2e-13)
        } else {
            Finding::at_least("not equal-area, yet constant", ratio - 1.0, 0.01)
        },
        if claims.conformal {
            // The difference of the axes is the root of a difference that cancels.
            Finding::new("conformal: anisotropy - 1", anisotropy - 1.0, 1e-7)
        } else {
            Finding::at_least("not conformal, yet round", anisotropy - 1.0, 0.1)
        },
    ]
}

/// The area scale in the middle of the first chart over that a ten thousandth beside it.
fn middle_over_beside(map: MappingId) -> f64 {
    let [middle, beside] = [[0.5, 0.5], [0.5 + 1e-4, 0.5 + 3e-5]].map(|[u, v]| {
        let (_, jacobian) = map.jacobian(ChartPoint::new(0, u, v)).unwrap();
        jacobian.area_scale()
    });
    middle / beside
}

/// In the middle formulas meet that divide by the distance from it: the texel that lies there counts like the others.
#[test]
fn the_middle_of_a_chart_has_the_area_that_is_around_it() {
    for &map in MappingId::ALL {
        let ratio = middle_over_beside(map);
        // Observed: 1 to within 1e-3, where the octahedron's creases meet.
        assert!((ratio - 1.0).abs() < 1.5e-3, "{map}: {ratio}");
    }
    // Control: elsewhere on a face the area is another.
    let corner = MappingId::Cube
        .jacobian(ChartPoint::new(0, 0.0, 0.0))
        .unwrap();
    let middle = MappingId::Cube
        .jacobian(ChartPoint::new(0, 0.5, 0.5))
        .unwrap();
    let ratio: f64 = corner.1.area_scale() / middle.1.area_scale();
    assert!((ratio - 1.0).abs() > 0.5, "{ratio}");
}

#[test]
fn gauss_integrates_polynomials() {
    let rule = gauss::<24>();
    let integral = |power: i32| rule.iter().map(|(x, w)| w * x.powi(power)).sum::<f64>();
    for power in [0, 1, 2, 17, 47] {
        assert!((integral(power) - 1.0 / f64::from(power + 1)).abs() < 1e-14);
    }
    assert!((rule.iter().map(|(x, w)| w / x).sum::<f64>()).is_finite());
}
