//! There and back, by direction and by chart point, and each way against f64.

use sixfold::lab::stress::allowed;
use sixfold::mapping::evaluator::SINGLE;
use sixfold::mapping::{ChartPoint, Coverage};
use sixfold::math::{Real, Vec3, angle_rad};

use crate::inputs::{chart_points, directions};
use crate::report::{Finding, Worst};
use crate::subject::Subject;

/// Largest direction -> uv -> direction error in rad: (outside, inside) of the weak spots.
fn by_direction_in<R: Real>(subject: &Subject) -> (f64, f64) {
    let (mut outside, mut inside) = (Worst::default(), Worst::default());
    for dir in directions::<R>(11, subject.effort) {
        let given = dir.to_f64();
        if !subject.info().coverage.contains(given) {
            continue;
        }
        let back = subject.forward(dir).and_then(|p| subject.inverse(p));
        let error = back.map_or(f64::NAN, |back| angle_rad(back.to_f64(), given));
        if subject.is_weak(given) {
            inside.see(error);
        } else {
            outside.see(error);
        }
    }
    (outside.0, inside.0)
}

/// The law's own budgets: f32 and f64, and inside of weak spots (where half the digits are lost, however they are
/// computed).
pub fn by_direction(subject: &Subject) -> Vec<Finding> {
    let (single, single_weak) = by_direction_in::<f32>(subject);
    let (double, double_weak) = by_direction_in::<f64>(subject);
    let Some(weak_budget) = subject.weak_budget() else {
        return vec![
            Finding::new(
                "f32, rad",
                single,
                allowed(subject.map, SINGLE).max_round_trip_rad,
            ),
            Finding::new("f64, rad", double, 5e-15),
        ];
    };
    vec![
        Finding::new("f32 outside its weak spot, rad", single, weak_budget),
        Finding::new("f64 outside its weak spot, rad", double, 3e-13),
        Finding::new("f32 in its weak spot, rad", single_weak, 1.5e-3),
        Finding::new("f64 in its weak spot, rad", double_weak, 1e-7),
    ]
}

/// Largest error of each way alone against f64, outside of weak spots: (forward, inverse) in rad.
pub fn against_f64(subject: &Subject) -> Vec<Finding> {
    let (mut forward, mut inverse) = (Worst::default(), Worst::default());
    for dir in directions::<f32>(12, subject.effort / 2) {
        let given = dir.to_f64();
        if subject.is_weak(given) || !subject.info().coverage.contains(given) {
            continue;
        }
        let point = subject.forward(dir).map(ChartPoint::to_f64);
        let exact = point.and_then(|p| subject.exact_inverse(p));
        forward.see(exact.map_or(f64::NAN, |exact| angle_rad(exact, given)));
    }
    let info = subject.info();
    for point in chart_points::<f32>(13, info.chart_count(), info.domain, subject.effort / 2) {
        let exact = subject.exact_inverse(point.to_f64());
        let (Some(exact), Some(dir)) = (exact, subject.inverse(point)) else {
            inverse.see(f64::NAN);
            continue;
        };
        if !subject.is_weak(exact) && info.coverage.contains(exact) {
            inverse.see(angle_rad(exact, dir.to_f64()));
        }
    }
    let budget = subject.weak_budget();
    match budget {
        None => vec![
            Finding::new(
                "f32 forward, rad",
                forward.0,
                allowed(subject.map, SINGLE).max_forward_rad,
            ),
            Finding::new("f32 inverse, rad", inverse.0, 7e-7),
        ],
        Some(budget) => vec![
            Finding::new("f32 forward outside its weak spot, rad", forward.0, budget),
            Finding::new("f32 inverse outside its weak spot, rad", inverse.0, budget),
        ],
    }
}

/// Largest uv -> direction -> uv error, and the number of points that came back somewhere else.
fn by_chart_point_in<R: Real>(subject: &Subject, near: f64) -> (f64, u32) {
    let info = subject.info();
    let (mut worst, mut lost) = (Worst::default(), 0);
    for point in chart_points::<R>(14, info.chart_count(), info.domain, subject.effort / 2) {
        let Some(dir) = subject.inverse(point) else {
            lost += 1;
            continue;
        };
        if matches!(info.coverage, Coverage::SphereLessPoint(p) if angle_rad(p, dir.to_f64()) < near)
        {
            continue;
        }
        let Some(back) = subject.forward(dir) else {
            lost += 1;
            continue;
        };
        let (p, q) = (point.to_f64(), back.to_f64());
        let step = [q.u - p.u, q.v - p.v];
        if p.chart != q.chart || step[0].hypot(step[1]) > 0.25 {
            // Only a point on a border may come back as another image of the same direction.
            let other = subject.exact_inverse(q);
            let other = other.map_or(f64::NAN, |other| angle_rad(other, dir.to_f64()));
            let on_border = border_distance(subject, p) < near;
            if !(on_border && other < near) {
                lost += 1;
            }
            continue;
        }
        worst.see(weighted(subject, p, step));
    }
    (worst.0, lost)
}

/// Distance of a chart point from the border of its domain.
pub fn border_distance(subject: &Subject, p: ChartPoint<f64>) -> f64 {
    match subject.info().domain {
        sixfold::mapping::Domain::Square => p.u.min(1.0 - p.u).min(p.v).min(1.0 - p.v),
        sixfold::mapping::Domain::Disc => 0.5 - (p.u - 0.5).hypot(p.v - 0.5),
    }
}

/// Size of a step on the chart where, along each axis of Tissot's indicatrix, the smaller of its length on the chart and
/// its length on the sphere counts: near a pole u may be anything, near a rim the direction may.
fn weighted(subject: &Subject, p: ChartPoint<f64>, [du, dv]: [f64; 2]) -> f64 {
    let Some(jacobian) = subject.jacobian(p) else {
        return f64::NAN;
    };
    let (uu, vv) = (jacobian.du.dot(jacobian.du), jacobian.dv.dot(jacobian.dv));
    let uv = jacobian.du.dot(jacobian.dv);
    let angle = 0.5 * (2.0 * uv).atan2(uu - vv);
    if !angle.is_finite() {
        // At a pole or on a rim itself there is no indicatrix.
        let moved = ChartPoint::new(p.chart, p.u + du, p.v + dv);
        let ends = subject.exact_inverse(p).zip(subject.exact_inverse(moved));
        return ends.map_or(f64::NAN, |(a, b)| angle_rad(a, b).min(du.hypot(dv)));
    }
    let (sin, cos) = angle.sin_cos();
    let along = |cos: f64, sin: f64| {
        let stretch: Vec3<f64> = jacobian.du * cos + jacobian.dv * sin;
        (cos * du + sin * dv) * stretch.length().min(1.0)
    };
    along(cos, sin).hypot(along(-sin, cos))
}

pub fn by_chart_point(subject: &Subject) -> Vec<Finding> {
    let (single, single_lost) = by_chart_point_in::<f32>(subject, 2e-6);
    let (double, double_lost) = by_chart_point_in::<f64>(subject, 1e-14);
    vec![
        Finding::new("f32, uv", single, 3e-7),
        Finding::new("f64, uv", double, 5e-16),
        Finding::new("points lost", f64::from(single_lost + double_lost), 0.0),
    ]
}

/// Largest distance of the inverse's length from 1.
pub fn inverse_is_unit(subject: &Subject) -> Vec<Finding> {
    fn worst<R: Real>(subject: &Subject) -> f64 {
        let info = subject.info();
        let mut worst = Worst::default();
        for point in chart_points::<R>(15, info.chart_count(), info.domain, subject.effort / 4) {
            let length = subject
                .inverse(point)
                .map_or(f64::NAN, |dir| Vec3::<f64>::from_f64(dir.to_f64()).length());
            worst.see((length - 1.0).abs());
        }
        worst.0
    }
    vec![
        Finding::new("f32", worst::<f32>(subject), 5e-7),
        Finding::new("f64", worst::<f64>(subject), 6e-16),
    ]
}
