//! Input points, and one evaluator held against double precision.

use sixfold::mapping::{
    ChartPoint, DirList, Domain, Evaluator, EvaluatorError, MappingId, PointList,
};
use sixfold::math::inputs::{Random, SIGN_PATTERNS, even_directions};
use sixfold::math::ulp::step_ulps;
use sixfold::math::{Vec3, angle_rad};

/// Largest errors of one mapping.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Angle between a direction and the exact inverse of its chart point, in radians.
    pub forward_rad: f64,
    /// Angle between the inverse of a chart point and its exact inverse, in radians.
    pub inverse_rad: f64,
    /// Both angles inside the weak spots, in reaches; see [`reach_rad`].
    pub weak_reaches: f64,
}

impl Errors {
    /// (what, observed, budget) of each kind of error.
    pub fn beside(self, budget: Self) -> [(&'static str, f64, f64); 3] {
        [
            ("forward", self.forward_rad, budget.forward_rad),
            ("inverse", self.inverse_rad, budget.inverse_rad),
            ("weak", self.weak_reaches, budget.weak_reaches),
        ]
    }
}

/// About `count` directions: even, random, exact ties of every size, and as nasty as they come.
pub fn directions(count: usize) -> Vec<Vec3<f32>> {
    let mut random = Random::new(20);
    let quarter = count / 4;
    let mut dirs: Vec<[f32; 3]> = even_directions(quarter)
        .map(|d| d.map(|c| c as f32))
        .collect();
    dirs.extend((0..quarter).map(|i| tie(i, &mut random)));
    dirs.extend((0..quarter).map(|_| random.direction()));
    dirs.extend((0..quarter).map(|_| random.adversarial()));
    dirs.into_iter()
        .map(|[x, y, z]| Vec3::new(x, y, z))
        .collect()
}

/// An exact tie of two or three components (or an axis), with few or many digits, of every size that a normal number has.
fn tie(i: usize, random: &mut Random) -> [f32; 3] {
    let exponent = random.below(254) as i32 - 126;
    let digits = if random.below(2) == 0 {
        1.0
    } else {
        1.0 + random.unit()
    };
    let size = ((digits * 2f64.powi(exponent)) as f32).min(f32::MAX);
    SIGN_PATTERNS[i % SIGN_PATTERNS.len()].map(|sign| f32::from(sign) * size)
}

/// `count` points on a mapping's charts: random, and within 32 ULP of every border, middle and quarter.
pub fn points(id: MappingId, count: usize) -> Vec<ChartPoint<f32>> {
    let info = id.info();
    let mut random = Random::new(7);
    let mut coordinate = |special: bool| {
        if !special {
            return random.unit() as f32;
        }
        let place = [0.0, 0.25, 0.5, 0.75, 1.0][random.below(5) as usize];
        step_ulps(place, random.below(65) as i32 - 32).clamp(0.0, 1.0)
    };
    (0_u32..)
        .map(|i| {
            let chart = i / 12 % info.chart_count();
            ChartPoint::new(chart, coordinate(i % 3 == 0), coordinate(i % 4 == 0))
        })
        .filter(|p| info.domain.contains(p.u, p.v))
        .take(count)
        .collect()
}

/// The point itself, or the rim's nearest where a rounding has moved it off the disc.
fn on_disc(id: MappingId, point: ChartPoint<f64>) -> ChartPoint<f64> {
    let domain = id.info().domain;
    if domain.contains(point.u, point.v) {
        return point;
    }
    let (p, q) = (2.0 * point.u - 1.0, 2.0 * point.v - 1.0);
    let radius = p.hypot(q);
    let overshoot = 4.0 * f64::from(f32::EPSILON);
    if domain != Domain::Disc || radius > 1.0 + overshoot {
        return point;
    }
    let onto_rim = |c: f64| 0.5 + 0.5 * (1.0 - f64::EPSILON) * c / radius;
    ChartPoint::new(point.chart, onto_rim(p), onto_rim(q))
}

/// The exact direction of a chart point.
fn exact_inverse(id: MappingId, point: ChartPoint<f64>) -> Option<[f64; 3]> {
    id.inverse(on_disc(id, point)).map(Vec3::to_f64)
}

/// The largest angle that one step of 2^-24 in the coordinates of a chart point makes, in radians: what the last digit of
/// a coordinate in [1/2, 1] is worth there.
pub fn reach_rad(id: MappingId, point: ChartPoint<f64>) -> f64 {
    const STEP: f64 = 1.0 / (1 << 24) as f64;
    let point = on_disc(id, point);
    let Some(dir) = exact_inverse(id, point) else {
        return 0.0;
    };
    let mut reach = 0.0_f64;
    for code in 0..9 {
        let (du, dv) = (
            f64::from(code % 3 - 1) * STEP,
            f64::from(code / 3 - 1) * STEP,
        );
        let moved = ChartPoint::new(point.chart, point.u + du, point.v + dv).clamped();
        if let Some(there) = exact_inverse(id, moved) {
            reach = reach.max(angle_rad(dir, there));
        }
    }
    reach
}

/// What an evaluator finds for directions.
pub fn forward_of(
    evaluator: &dyn Evaluator,
    dirs: &[Vec3<f32>],
) -> Result<Vec<Option<ChartPoint<f32>>>, EvaluatorError> {
    let mut points = PointList::zeros(dirs.len());
    let dirs: DirList = dirs.iter().map(|dir| dir.to_array()).collect();
    evaluator.forward(dirs.view(), points.view_mut())?;
    Ok((0..points.len()).map(|k| points.view().get(k)).collect())
}

/// What an evaluator finds for chart points.
pub fn inverse_of(
    evaluator: &dyn Evaluator,
    points: &[ChartPoint<f32>],
) -> Result<Vec<Option<Vec3<f32>>>, EvaluatorError> {
    let mut dirs = DirList::zeros(points.len());
    let points: PointList = points.iter().copied().collect();
    evaluator.inverse(points.view(), dirs.view_mut())?;
    Ok((0..dirs.len()).map(|k| dirs.view().get(k)).collect())
}

/// Everything that is wrong with an evaluator of a mapping apart from its errors' size, and its largest errors.
pub fn compare(
    id: MappingId,
    evaluator: &dyn Evaluator,
    dirs: &[Vec3<f32>],
    points: &[ChartPoint<f32>],
) -> (Vec<String>, Errors) {
    let mut errors = Errors::default();
    let mut faults = compare_forward(id, evaluator, dirs, &mut errors);
    faults.extend(compare_inverse(id, evaluator, points, &mut errors));
    (faults, errors)
}

fn compare_forward(
    id: MappingId,
    evaluator: &dyn Evaluator,
    dirs: &[Vec3<f32>],
    errors: &mut Errors,
) -> Vec<String> {
    let info = id.info();
    let mut faults = Vec::new();
    let found = forward_of(evaluator, dirs).unwrap();
    for (dir, found) in dirs.iter().zip(&found) {
        let on_cpu = id.forward(*dir).map(|p| p.chart);
        let Some(point) = found.filter(|p| Some(p.chart) == on_cpu) else {
            faults.push(format!("{dir:?}: {found:?}, on the CPU {on_cpu:?}"));
            continue;
        };
        if !point.is_on(info.chart_count()) {
            faults.push(format!("{dir:?}: {point:?} is off the chart"));
            continue;
        }
        let exact = dir.to_f64();
        if info.coverage.has_cut() && !info.coverage.contains(exact) {
            continue;
        }
        let Some(back) = exact_inverse(id, point.to_f64()) else {
            faults.push(format!("{dir:?}: {point:?} is off the disc"));
            continue;
        };
        let angle = angle_rad(exact, back);
        if is_weak(id, exact) {
            let reaches = angle / reach_rad(id, point.to_f64());
            errors.weak_reaches = errors.weak_reaches.max(reaches);
        } else {
            errors.forward_rad = errors.forward_rad.max(angle);
        }
    }
    faults
}

fn compare_inverse(
    id: MappingId,
    evaluator: &dyn Evaluator,
    points: &[ChartPoint<f32>],
    errors: &mut Errors,
) -> Vec<String> {
    let mut faults = Vec::new();
    let found = inverse_of(evaluator, points).unwrap();
    for (point, found) in points.iter().zip(&found) {
        let (Some(found), Some(exact)) = (found, exact_inverse(id, point.to_f64())) else {
            faults.push(format!("{point:?}: {found:?}"));
            continue;
        };
        let length = Vec3::<f64>::from_f64(found.to_f64()).length();
        if length.is_nan() || (length - 1.0).abs() > 1e-6 {
            faults.push(format!("{point:?}: length {length}"));
            continue;
        }
        let angle = angle_rad(exact, found.to_f64());
        if is_weak(id, exact) {
            let reaches = angle / reach_rad(id, point.to_f64());
            errors.weak_reaches = errors.weak_reaches.max(reaches);
        } else {
            errors.inverse_rad = errors.inverse_rad.max(angle);
        }
    }
    faults
}

fn is_weak(id: MappingId, dir: [f64; 3]) -> bool {
    id.info().weak_spots.iter().any(|spot| spot.contains(dir))
}

/// How many directions have no chart, or another than on the CPU.
pub fn wrong_charts(id: MappingId, evaluator: &dyn Evaluator, dirs: &[Vec3<f32>]) -> [usize; 2] {
    let found = forward_of(evaluator, dirs).unwrap();
    let on_cpu = dirs.iter().map(|dir| id.forward(*dir));
    let mut counts = [0; 2];
    for (found, on_cpu) in found.iter().zip(on_cpu) {
        match (found, on_cpu) {
            (Some(found), Some(on_cpu)) if found.chart == on_cpu.chart => {}
            (Some(_), _) => counts[1] += 1,
            (None, _) => counts[0] += 1,
        }
    }
    counts
}
