//! Directions and chart points to hold the laws against. The borders are never avoided.

use sixfold::mapping::{ChartPoint, Domain};
use sixfold::math::inputs::{Random, even_directions};
use sixfold::math::{Real, Vec3};

/// About `count` directions: even, random, on rings around the axes, and around every border, corner and tie.
pub fn directions<R: Real>(seed: u64, count: usize) -> impl Iterator<Item = Vec3<R>> {
    let even = even_directions(count / 4).map(Vec3::from_f64);
    let mut random = Random::new(seed);
    let others = (0..count * 3 / 4).map(move |i| match i % 4 {
        0 => Vec3::from_f64(random.direction().map(f64::from)),
        1 => ring(&mut random),
        _ => {
            let dir = random.adversarial().map(f64::from);
            // Digits below those of f32, in half of the cases; f32 rounds them away again.
            let fine = 2f64.powi(-24 - random.below(30) as i32);
            let scale = if i % 8 < 4 { fine } else { 0.0 };
            Vec3::from_f64(dir.map(|c| c * (1.0 + scale * (random.unit() - 0.5))))
        }
    });
    even.chain(others)
}

/// A direction at an angle of 1e-4 to pi/2 from one of the six axes, small angles as often as large ones; one in eight on the circle at
/// which HEALPix is bent, and as near to it.
fn ring<R: Real>(random: &mut Random) -> Vec3<R> {
    let angle = std::f64::consts::FRAC_PI_2 * 10f64.powf(-4.2 * random.unit());
    let bend = (2f64 / 3.0).acos() + 1e-3 * 2f64.powi(-(random.below(52) as i32));
    let angle = if random.below(8) == 0 { bend } else { angle };
    let (sin_turn, cos_turn) = (std::f64::consts::TAU * random.unit()).sin_cos();
    let (sin, cos) = angle.sin_cos();
    let side = if random.below(2) == 0 { cos } else { -cos };
    let mut dir = [sin * cos_turn, sin * sin_turn, side];
    dir.rotate_left(random.below(3) as usize);
    Vec3::from_f64(dir)
}

/// Chart points in the domain: every pair of nasty coordinates, random ones, and the rim of a disc.
pub fn chart_points<R: Real>(
    seed: u64,
    charts: u32,
    domain: Domain,
    count: usize,
) -> impl Iterator<Item = ChartPoint<R>> {
    let last_below = 1.0 - 0.5 * R::EPSILON;
    let nasty = [
        0.0,
        2f64.powi(-149),
        1e-30,
        2f64.powi(-25),
        1e-4,
        0.25,
        0.5 - 0.25 * R::EPSILON,
        0.5,
        0.5 + R::EPSILON,
        0.75,
        1.0 - 1e-4,
        last_below,
        1.0,
    ];
    let pairs = (0..nasty.len().pow(2)).map(move |i| {
        let (u, v) = (nasty[i / nasty.len()], nasty[i % nasty.len()]);
        (u, v)
    });
    let mut random = Random::new(seed);
    let others = (0..count).map(move |i| {
        if domain == Domain::Disc && i % 8 == 0 {
            // Inward from the rim by a random power of two.
            let (sin, cos) = (std::f64::consts::TAU * random.unit()).sin_cos();
            let radius = 0.5 - 0.25 * 2f64.powi(-(random.below(50) as i32));
            return (0.5 + radius * cos, 0.5 + radius * sin);
        }
        (random.unit(), random.unit())
    });
    let points = pairs.chain(others).enumerate();
    points.filter_map(move |(i, (u, v))| {
        let point = ChartPoint::new(i as u32 % charts, R::from_f64(u), R::from_f64(v));
        domain.contains(point.u, point.v).then_some(point)
    })
}

/// Chart points in f64 that keep `margin` from every border, and from the creases of octahedral maps.
pub fn inner_points(
    seed: u64,
    charts: u32,
    domain: Domain,
    margin: f64,
    count: usize,
) -> impl Iterator<Item = ChartPoint<f64>> {
    let mut random = Random::new(seed);
    let points = (0..count).map(move |i| {
        let mut inside = || margin + (1.0 - 2.0 * margin) * random.unit();
        ChartPoint::new(i as u32 % charts, inside(), inside())
    });
    points.filter(move |point| {
        let (p, q) = (2.0 * point.u - 1.0, 2.0 * point.v - 1.0);
        let off_rim = domain == Domain::Square || p.hypot(q) <= 1.0 - 2.0 * margin;
        let off_axes = p.abs().min(q.abs()) > margin;
        let off_fold = (p.abs() + q.abs() - 1.0).abs() > margin;
        off_rim && off_axes && off_fold
    })
}
