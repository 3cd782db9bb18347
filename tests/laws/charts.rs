//! Exactly one chart for every direction, the same in every number type; ties by the documented order; bad input refused.

use sixfold::mapping::{ChartPoint, MappingId};
use sixfold::math::inputs::{Random, SIGN_PATTERNS};
use sixfold::math::{Real, Vec3, angle_rad};

use crate::inputs::directions;
use crate::report::{Finding, Worst};
use crate::subject::Subject;

/// The order in which faces win a tie: (axis, sign) with sign 0 for both.
fn tie_order(map: MappingId) -> &'static [(usize, i8)] {
    match map {
        MappingId::Ccm => &[(1, -1), (2, -1), (0, 0), (2, 1), (1, 1)],
        _ => &[(2, 0), (1, 0), (0, 0)],
    }
}

/// Whether a direction may get this chart, from its f32 components by comparisons of exact numbers alone; but HEALPix has borders
/// on which no f32 lies, and there both charts will do to within `slack`, as a part of a chart's side.
fn is_right(map: MappingId, dir: [f32; 3], chart: u32, slack: f64) -> bool {
    let expected = match map.info().charts.len() {
        1 => 0,
        2 => u32::from(dir[2] < 0.0),
        12 => return is_base_pixel(dir.map(f64::from), chart, slack),
        _ => {
            let largest = dir.iter().fold(0_f32, |m, c| m.max(c.abs()));
            let order = tie_order(map).iter();
            let mut winners = order.filter(|&&(axis, sign)| {
                let c = dir[axis];
                c.abs() == largest && (sign == 0 || (c < 0.0) == (sign < 0))
            });
            let &(axis, _) = winners.next().unwrap();
            2 * axis as u32 + u32::from(dir[axis] < 0.0)
        }
    };
    chart == expected
}

/// Whether a direction lies in a base pixel of HEALPix: around the poles by signs alone, in the belt by the cells of the plane.
fn is_base_pixel([x, y, z]: [f64; 3], chart: u32, slack: f64) -> bool {
    let largest = x.abs().max(y.abs()).max(z.abs());
    let [x, y, z] = [x, y, z].map(|c| c / largest);
    let sine = y / x.hypot(y).hypot(z);
    let (ring, k) = (chart / 4, chart % 4);
    let quarter = match (x, z) {
        _ if x == 0.0 && z == 0.0 => 0,
        _ if x >= 0.0 && z > 0.0 => 0,
        _ if x > 0.0 => 1,
        _ if z < 0.0 => 2,
        _ => 3,
    };
    let in_cap = ring == if y > 0.0 { 0 } else { 2 } && k == quarter;
    let in_belt = || {
        let quarters = x.atan2(z) / std::f64::consts::FRAC_PI_2;
        let off_middle = |c: f64| (c - 0.5).abs() <= 0.5 + slack;
        let [column, row] = match ring {
            0 => [k + 1, k],
            1 => [k, k],
            _ => [k, k + 1],
        };
        [-4.0, 0.0, 4.0].into_iter().any(|round| {
            let middle = quarters + round + 0.5;
            off_middle(middle + 0.75 * sine - f64::from(column))
                && off_middle(middle - 0.75 * sine - f64::from(row))
        })
    };
    let beyond = sine.abs() - 2.0 / 3.0;
    beyond > -slack && in_cap || beyond <= slack && in_belt()
}

/// Roundings at a border that is no plane: a few of the last digits of a place in [0, 1], and of half a turn of longitude.
fn slack<R: Real>() -> f64 {
    4.0 * R::EPSILON
}

/// Directions on which unevenly fused dot products leave holes (found in C compilers' output and by search).
const FUSED_COUNTEREXAMPLES: [[f32; 3]; 3] = [
    [1.000_000_1, 1.000_000_1, 1.000_000_1],
    [-1.192_897_1, -1.192_897_1, -1.192_897_1],
    [-0.577_350_3, -0.577_350_3, 0.577_350_3],
];

/// An exact tie of the two or three largest components, at a random size.
fn tie(random: &mut Random) -> [f32; 3] {
    loop {
        let pattern = SIGN_PATTERNS[random.below(26) as usize];
        if pattern.iter().filter(|sign| **sign != 0).count() > 1 {
            let size = 2f32.powi(random.below(120) as i32 - 60) * (1.0 + random.unit() as f32);
            let smaller = size * (2.0 * random.unit() as f32 - 1.0);
            return pattern.map(|sign| {
                if sign == 0 {
                    smaller
                } else {
                    size * f32::from(sign)
                }
            });
        }
    }
}

/// Counts directions whose chart is not the expected one, in f32 and (of a part of them) in f64.
pub fn one_chart(subject: &Subject) -> Vec<Finding> {
    let wrong = |dir: [f32; 3], in_f64: bool| {
        let is_right = |chart: Option<u32>, slack| {
            chart.is_some_and(|chart| is_right(subject.map, dir, chart, slack))
        };
        let single = subject.forward(Vec3::new(dir[0], dir[1], dir[2]));
        let double = || subject.forward(Vec3::<f64>::from_f64(dir.map(f64::from)));
        !is_right(single.map(|p| p.chart), slack::<f32>())
            || in_f64 && !is_right(double().map(|p| p.chart), slack::<f64>())
    };
    let mut random = Random::new(21);
    // Charts can go wrong only where there are several.
    let several = subject.info().chart_count() > 1;
    let count = if several {
        20 * subject.effort
    } else {
        subject.effort
    };
    let mut count_wrong = 0_u64;
    for i in 0..count {
        let dir = match i % 8 {
            0 | 1 => tie(&mut random),
            2..=4 => random.adversarial(),
            _ => random.direction(),
        };
        count_wrong += u64::from(wrong(dir, i % 8 == i % 64));
    }
    for dir in FUSED_COUNTEREXAMPLES {
        count_wrong += u64::from(wrong(dir, true));
    }
    vec![Finding::new(
        "directions with a wrong chart or none",
        count_wrong as f64,
        0.0,
    )]
}

/// The 20 edges and corners of the cube at 60 sizes, in both number types.
pub fn ties(subject: &Subject) -> Vec<Finding> {
    let (mut wrong, mut seen) = (0, 0);
    for pattern in SIGN_PATTERNS {
        if pattern.iter().filter(|c| **c != 0).count() < 2 {
            continue;
        }
        for step in 0..60 {
            let size = 2f32.powi(-126 + 4 * step);
            let dir = pattern.map(|c| f32::from(c) * size);
            let wide = Vec3::<f64>::from_f64(dir.map(f64::from));
            let charts = [
                subject
                    .forward(Vec3::new(dir[0], dir[1], dir[2]))
                    .map(|p| p.chart),
                subject.forward(wide).map(|p| p.chart),
                // And again at a size that f32 does not have.
                subject.forward(wide * 2f64.powi(-900)).map(|p| p.chart),
            ];
            seen += 1;
            wrong += u32::from(charts.iter().any(|chart| {
                !chart.is_some_and(|chart| is_right(subject.map, dir, chart, slack::<f32>()))
            }));
        }
    }
    assert_eq!(seen, 20 * 60);
    vec![Finding::new(
        "ties with a wrong chart",
        f64::from(wrong),
        0.0,
    )]
}

/// u and v never leave [0, 1].
pub fn in_range(subject: &Subject) -> Vec<Finding> {
    let inside = |c: f32| (0.0..=1.0).contains(&c);
    let mut random = Random::new(22);
    let charts = subject.info().chart_count();
    let mut outside = 0_u64;
    for i in 0..10 * subject.effort {
        let dir = if i % 2 == 0 {
            random.adversarial()
        } else {
            random.direction()
        };
        let point = subject.forward(Vec3::new(dir[0], dir[1], dir[2]));
        let fine = point.is_some_and(|p| p.chart < charts && inside(p.u) && inside(p.v));
        outside += u64::from(!fine);
    }
    vec![Finding::new(
        "directions without a point in [0, 1]",
        outside as f64,
        0.0,
    )]
}

/// Zero, NaN and infinite vectors have no image; points off the chart have no direction.
pub fn refuses(subject: &Subject) -> Vec<Finding> {
    fn accepted<R: Real>(subject: &Subject) -> u32 {
        let mut count = 0;
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        let mut see = |dir: [f64; 3]| {
            count += u32::from(subject.forward(Vec3::<R>::from_f64(dir)).is_some());
        };
        for zero in SIGN_PATTERNS {
            see(zero.map(|sign| if sign < 0 { -0.0 } else { 0.0 }));
        }
        for value in bad {
            for (slot, other) in [0, 1, 2]
                .into_iter()
                .flat_map(|s| [(s, 0.0), (s, 1.0), (s, value)])
            {
                let mut dir = [other; 3];
                dir[slot] = value;
                see(dir);
            }
        }
        let charts = subject.info().chart_count();
        let off = [
            -f64::MIN_POSITIVE,
            -1e-30,
            1.0 + R::EPSILON,
            -0.5,
            2.0,
            bad[0],
            bad[1],
            bad[2],
        ];
        let mut points = vec![(charts, 0.5, 0.5), (u32::MAX, 0.5, 0.5)];
        // The smallest double is zero as a float, and zero lies on the chart.
        for c in off.into_iter().filter(|c| R::from_f64(*c).to_f64() != 0.0) {
            points.extend([(0, c, 0.5), (0, 0.5, c), (0, c, c)]);
        }
        if subject.info().domain == sixfold::mapping::Domain::Disc {
            points.extend([(0, 0.0, 0.0), (0, 1.0, 0.0), (0, 0.9, 0.9)]);
        }
        for (chart, u, v) in points {
            let point = ChartPoint::new(chart, R::from_f64(u), R::from_f64(v));
            count += u32::from(subject.inverse(point).is_some());
        }
        count
    }
    let accepted = accepted::<f32>(subject) + accepted::<f64>(subject);
    vec![Finding::new(
        "bad inputs accepted",
        f64::from(accepted),
        0.0,
    )]
}

/// A direction's length does not matter: scaled by a power of two that keeps all digits the point is the same, bit for
/// bit; among the smallest and the largest numbers it is as near to the truth as elsewhere.
pub fn any_length(subject: &Subject) -> Vec<Finding> {
    fn check<R: Real>(subject: &Subject, exponents: [i32; 6], edge: f64) -> (u32, f64) {
        let (mut moved, mut worst) = (0, Worst::default());
        for (i, dir) in directions::<R>(23, subject.effort / 20).enumerate() {
            let [x, y, z] = dir.to_f64();
            let smallest = [x, y, z].into_iter().filter(|c| *c != 0.0);
            let smallest = smallest.fold(f64::INFINITY, |m, c| m.min(c.abs()));
            // Components that would become subnormal lose digits: then the direction is another one.
            if smallest > 1e-8 {
                let scale = R::from_f64(2f64.powi(exponents[i % 6]));
                moved += u32::from(subject.forward(dir * scale) != subject.forward(dir));
            }
        }
        // `edge` is the smallest positive number of the type; the truth is found at a size where f64 has all digits.
        let mut random = Random::new(24);
        for _ in 0..subject.effort / 20 {
            let bits = random.below(23) + 1;
            let mut whole = || {
                f64::from(random.below(1 << bits)) * if random.below(2) == 0 { -1.0 } else { 1.0 }
            };
            let exact = [whole(), whole(), whole()];
            if exact == [0.0; 3]
                || !subject.info().coverage.contains(exact)
                || subject.is_weak(exact)
            {
                continue;
            }
            let tiny = Vec3::<R>::from_f64(exact.map(|c| c * edge));
            let back = subject
                .forward(tiny)
                .and_then(|p| subject.exact_inverse(p.to_f64()));
            worst.see(back.map_or(f64::NAN, |back| angle_rad(back, exact)));
        }
        (moved, worst.0)
    }
    let (single, single_rad) = check::<f32>(
        subject,
        [-90, -61, -7, 9, 62, 120],
        f64::from(f32::from_bits(1)),
    );
    let (double, double_rad) =
        check::<f64>(subject, [-900, -100, -3, 5, 600, 1000], f64::from_bits(1));
    let mut findings = vec![Finding::new(
        "points moved by scaling",
        f64::from(single + double),
        0.0,
    )];
    findings.extend(match subject.weak_budget() {
        None => [
            Finding::new("f32 subnormal, rad", single_rad, 1e-6),
            Finding::new("f64 subnormal, rad", double_rad, 5e-15),
        ],
        Some(budget) => [
            Finding::new(
                "f32 subnormal outside its weak spot, rad",
                single_rad,
                budget,
            ),
            Finding::new(
                "f64 subnormal outside its weak spot, rad",
                double_rad,
                1e-13,
            ),
        ],
    });
    findings
}
