//! What the Jacobian says: derivatives, solid angles, and the claims that rest on them.

use sixfold::mapping::{ChartPoint, MappingId};
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

/// Solid angles sum to the coverage, also where a texel is cut by a bend or by a rim.
pub fn solid_angles(subject: &Subject) -> Vec<Finding> {
    let coverage = subject.info().coverage.solid_angle_sr();
    let skew = if subject.is(Fault::Skewed) { 1.05 } else { 1.0 };
    let off = |rows: u32| {
        let sum_sr = subject.map.solid_angle_sum_sr(rows, || true);
        (sum_sr.unwrap_or(f64::NAN) * skew - coverage).abs()
    };
    let fine = match subject.map {
        // Around its rim the solid angle grows without bound, and f64's u and v cannot tell how near the rim is.
        MappingId::Matcap => Finding::new("64 rows of texels, unbounded, sr", off(64), 3e-13),
        _ => Finding::new("64 rows of texels, sr", off(64), 1e-13),
    };
    // Bends cut texels anywhere, and nine in a row are few.
    vec![fine, Finding::new("9 rows of texels, sr", off(9), 1e-7)]
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
