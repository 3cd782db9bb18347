//! Where charts meet: the coordinate along a seam agrees from both sides, and texels across it are neighbours.

use sixfold::mapping::cube_face::Side;
use sixfold::mapping::{Borders, ChartPoint, Domain};
use sixfold::math::inputs::Random;
use sixfold::math::{Real, Vec3, angle_rad};

use crate::report::{Finding, Worst};
use crate::round_trip::border_distance;
use crate::subject::Subject;

/// Two directions on both sides of a plane in which seams lie, as near to each other as the number type allows: the
/// planes x = 0 (and so on) and x = +-y (and so on).
fn across_a_plane<R: Real>(random: &mut Random) -> [Vec3<R>; 2] {
    let sign = |random: &mut Random| if random.below(2) == 0 { -1.0 } else { 1.0 };
    let size = sign(random) * (0.5 + 0.5 * random.unit());
    let third = 1.5 * (2.0 * random.unit() - 1.0);
    let pair = if random.below(2) == 0 {
        // Far below the last digit of the other components, even where the third is small.
        [
            [2f64.powi(-80), size, third],
            [-2f64.powi(-80), size, third],
        ]
    } else {
        let size = R::from_f64(size).to_f64();
        let (less, other_sign) = (size * (1.0 - R::EPSILON), sign(random));
        [
            [size, less * other_sign, third],
            [less, size * other_sign, third],
        ]
    };
    let turn = random.below(3) as usize;
    pair.map(|mut dir| {
        dir.rotate_left(turn);
        Vec3::from_f64(dir)
    })
}

/// Two directions on both sides of a chart's border, where that is no plane between the axes: as near to each other as the roundings of a
/// direction allow.
fn across_a_side<R: Real>(subject: &Subject, random: &mut Random) -> [Vec3<R>; 2] {
    let chart = random.below(subject.info().chart_count());
    let side = Side::ALL[random.below(4) as usize];
    let [u, v] = side.place(random.unit());
    [-1.0, 1.0].map(|sign| {
        let away = |c: f64| {
            if c == 0.0 || c == 1.0 {
                c + sign * R::EPSILON
            } else {
                c
            }
        };
        let point = ChartPoint::new(chart, away(u), away(v));
        Vec3::from_f64(subject.map.continued(point).to_f64())
    })
}

/// The coordinate along the border on which a point lies.
fn along(subject: &Subject, p: ChartPoint<f64>) -> f64 {
    let on_side = p.u.min(1.0 - p.u) < p.v.min(1.0 - p.v);
    if subject.info().domain == Domain::Disc || on_side {
        p.v
    } else {
        p.u
    }
}

/// (largest disagreement along a seam, pairs across a seam that lie on no border, seams met).
fn disagreement<R: Real>(subject: &Subject, on_border: f64) -> (f64, u32, u32) {
    let mut random = Random::new(41);
    let (mut worst, mut astray, mut met) = (Worst::default(), 0, 0);
    let has_curved_borders = subject.info().borders == Borders::BasePixelEdges;
    for _ in 0..subject.effort / 4 {
        let [a, b] = if has_curved_borders && random.below(2) == 0 {
            across_a_side::<R>(subject, &mut random)
        } else {
            across_a_plane::<R>(&mut random)
        };
        let (Some(p), Some(q)) = (subject.forward(a), subject.forward(b)) else {
            astray += 1;
            continue;
        };
        let (p, q) = (p.to_f64(), q.to_f64());
        let apart = (p.u - q.u).abs().max((p.v - q.v).abs());
        if p.chart == q.chart && apart < 1e-4 {
            continue;
        }
        met += 1;
        let distance = border_distance(subject, p).max(border_distance(subject, q));
        if distance > on_border {
            astray += 1;
            continue;
        }
        let (s, t) = (along(subject, p), along(subject, q));
        worst.see((s - t).abs().min((s + t - 1.0).abs()));
    }
    (worst.0, astray, met)
}

pub fn continuous(subject: &Subject) -> Vec<Finding> {
    let (single, single_astray, met) = disagreement::<f32>(subject, 3e-7);
    let (double, double_astray, _) = disagreement::<f64>(subject, 1e-15);
    assert!(
        met > 1000 || subject.fault.is_some(),
        "{}: only {met} seams met",
        subject.map
    );
    if !subject.info().claims.continuous {
        return vec![Finding::at_least(
            "f64 along a seam that is divided in two ways, uv",
            double,
            0.01,
        )];
    }
    vec![
        Finding::new("f32 along the seam, uv", single, 2.4e-7),
        Finding::new("f64 along the seam, uv", double, 1e-15),
        Finding::new(
            "jumps off the border",
            f64::from(single_astray + double_astray),
            0.0,
        ),
    ]
}

/// One texel of a chart of n x n.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Texel {
    chart: u32,
    place: [u32; 2],
    n: u32,
}

impl Texel {
    fn of(p: ChartPoint<f64>, n: u32) -> Self {
        let index = |c: f64| ((c * f64::from(n)) as u32).min(n - 1);
        Self {
            chart: p.chart,
            place: [index(p.u), index(p.v)],
            n,
        }
    }

    fn at(&self, x: f64, y: f64) -> ChartPoint<f64> {
        let place = |i: u32, c: f64| (f64::from(i) + c) / f64::from(self.n);
        ChartPoint::new(self.chart, place(self.place[0], x), place(self.place[1], y))
    }

    /// Centre, and the farthest of its corners and edges' middles, as an angle from it; `None` where the centre lies off
    /// a disc.
    fn extent(&self, subject: &Subject) -> Option<([f64; 3], f64)> {
        let centre = subject.map.inverse(self.at(0.5, 0.5))?.to_f64();
        let mut radius = Worst::default();
        for (x, y) in [
            (0, 0),
            (1, 0),
            (2, 0),
            (0, 1),
            (2, 1),
            (0, 2),
            (1, 2),
            (2, 2),
        ] {
            let corner = self.at(0.5 * f64::from(x), 0.5 * f64::from(y));
            if let Some(dir) = subject.map.inverse(corner) {
                radius.see(angle_rad(dir.to_f64(), centre));
            }
        }
        Some((centre, radius.0))
    }
}

/// Steps over the border from every border texel, at several chart sizes: the texel met there must touch it.
pub fn neighbours(subject: &Subject) -> Vec<Finding> {
    let info = subject.info();
    let (mut wrong, mut seen) = (0, 0);
    for n in [1, 2, 3, 4, 256] {
        for chart in 0..info.chart_count() {
            for step in 0..4 * n {
                let s = (f64::from(step % n) + 0.5) / f64::from(n);
                let border = match (info.domain, step / n) {
                    (Domain::Disc, _) => {
                        let turn = (f64::from(step) + 0.5) / f64::from(4 * n);
                        let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
                        [0.5 + 0.5 * cos, 0.5 + 0.5 * sin]
                    }
                    (_, 0) => [0.0, s],
                    (_, 1) => [1.0, s],
                    (_, 2) => [s, 0.0],
                    _ => [s, 1.0],
                };
                // A millionth of the way to the chart's centre, and as far beyond the border on the sphere.
                let inward = |share: f64| {
                    let c = |c: f64| c + (0.5 - c) * share;
                    ChartPoint::new(chart, c(border[0]), c(border[1]))
                };
                let (edge, inside) = (inward(1e-9), inward(1e-6));
                let (Some(at), Some(within)) =
                    (subject.map.inverse(edge), subject.map.inverse(inside))
                else {
                    wrong += 1;
                    continue;
                };
                let beyond = at + (at - within);
                let Some(met) = subject.forward(beyond) else {
                    wrong += 1;
                    continue;
                };
                let (own, other) = (Texel::of(inside, n), Texel::of(met, n));
                if other.chart >= info.chart_count() {
                    wrong += 1;
                    continue;
                }
                if let (Some((a, r)), Some((b, s))) = (own.extent(subject), other.extent(subject)) {
                    seen += 1;
                    // They touch, so their centres are no farther apart than both their radii.
                    wrong += u32::from(angle_rad(a, b) > r + s + 1e-5);
                }
            }
        }
    }
    assert!(
        seen > 500 || subject.fault.is_some(),
        "{}: only {seen} pairs",
        subject.map
    );
    vec![Finding::new(
        "texels whose neighbour is far away",
        f64::from(wrong),
        0.0,
    )]
}
