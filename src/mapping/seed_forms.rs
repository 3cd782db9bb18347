//! Formulas as the literature prints them, in f32 with the standard library's functions: what they lose is their point.

use std::f32::consts::{FRAC_1_PI, FRAC_2_PI, FRAC_PI_4, PI, SQRT_2, TAU};

use super::ccm::{self, HALF_EDGE_RAD, from_s_t, to_s_t};
use super::cube_face::sign_table;
use super::evaluator::SeedForm;
use super::{ChartPoint, Domain};
use crate::math::Vec3;

type Point = Option<ChartPoint<f32>>;
type Dir = Option<Vec3<f32>>;

pub(super) const LATLONG: &[SeedForm] = &[
    SeedForm {
        id: "textbook",
        about: "v = acos(y/n)/π: half the digits are lost at the poles",
        source: "Grimm and Niebruegge, eq. 1-4, with the quadrant",
        forward: |dir| latlong(dir, f32::acos),
        inverse: Some(latlong_inverse),
    },
    SeedForm {
        id: "fast-acos",
        about: "as textbook, with a polynomial of degree 3 for acos(x)/√(1 − x)",
        source: "Hastings 1955; Abramowitz and Stegun 4.4.45; Cg's acos",
        forward: |dir| latlong(dir, fast_acos),
        inverse: None,
    },
];

pub(super) const ANGULAR: &[SeedForm] = &[
    SeedForm {
        id: "textbook",
        about: "ρ = acos(z/n)/(2π): half the digits are lost at centre and rim, and 0/0 at both",
        source: "Debevec, light probe images",
        forward: |dir| angular(dir, f32::acos),
        inverse: Some(angular_inverse),
    },
    SeedForm {
        id: "fast-acos",
        about: "as textbook, with a polynomial of degree 3 for acos(x)/√(1 − x)",
        source: "Hastings 1955; Abramowitz and Stegun 4.4.45; Cg's acos",
        forward: |dir| angular(dir, fast_acos),
        inverse: None,
    },
];

pub(super) const SPHERE: &[SeedForm] = &[
    SeedForm {
        id: "textbook",
        about: "m = 2√(x² + y² + (n − z)²) as printed: 0/0 at the rim's direction",
        source: "Hoff 1998; OpenGL's sphere map",
        forward: |dir| {
            let d = dir.scaled_direction()?.normalized();
            let m = 2.0 * (d.x * d.x + d.y * d.y + (1.0 - d.z) * (1.0 - d.z)).sqrt();
            Some(ChartPoint::new(0, 0.5 + d.x / m, 0.5 - d.y / m))
        },
        inverse: None,
    },
    SeedForm {
        id: "short-m",
        about: "m = 2√(2(1 − z)), the same in exact numbers: no digit is left around the rim",
        source: "a simplification that shaders often use",
        forward: |dir| {
            let d = dir.scaled_direction()?.normalized();
            let m = 2.0 * (2.0 * (1.0 - d.z)).sqrt();
            Some(ChartPoint::new(0, 0.5 + d.x / m, 0.5 - d.y / m))
        },
        inverse: None,
    },
];

pub(super) const OCTAHEDRAL_EQUAL_AREA: &[SeedForm] = &[SeedForm {
    id: "textbook",
    about: "r = √(1 − |y|): half the digits are lost around the poles",
    source: "Clarberg 2008; pbrt-v4",
    forward: |dir| {
        let d = dir.scaled_direction()?.normalized();
        let r = (1.0 - d.y.abs()).max(0.0).sqrt();
        let share = d.z.abs().atan2(d.x.abs()) * FRAC_2_PI;
        let (b, a) = (share * r, r - share * r);
        let (a, b) = if d.y < 0.0 {
            (1.0 - b, 1.0 - a)
        } else {
            (a, b)
        };
        let place = |c: f32, sign: f32| 0.5 * (c.copysign(sign) + 1.0);
        Some(ChartPoint::new(0, place(a, d.x), place(b, d.z)))
    },
    inverse: Some(|point| {
        if !point.is_on(1) {
            return None;
        }
        let (a, b) = (2.0 * point.u - 1.0, 2.0 * point.v - 1.0);
        let distance = 1.0 - (a.abs() + b.abs());
        let r = 1.0 - distance.abs();
        let angle = if r == 0.0 {
            FRAC_PI_4
        } else {
            ((b.abs() - a.abs()) / r + 1.0) * FRAC_PI_4
        };
        let across = r * (2.0 - r * r).sqrt();
        Some(Vec3::new(
            across * angle.cos().copysign(a),
            (1.0 - r * r).copysign(distance),
            across * angle.sin().copysign(b),
        ))
    }),
}];

pub(super) const CCM: &[SeedForm] = &[
    SeedForm {
        id: "textbook",
        about: "Eq. 5 and 6 put right, with asin; faces by comparison",
        source: "Grimm and Niebruegge, Appendix A",
        forward: |dir| {
            let d = dir.scaled_direction()?.normalized();
            let chart = sign_table(dir);
            Some(from_s_t(chart, d))
        },
        inverse: Some(|point| {
            if !point.is_on(6) {
                return None;
            }
            let (s, t, turn_back) = to_s_t(point);
            let a = SQRT_2 * ((1.0 - 2.0 * s) * HALF_EDGE_RAD as f32).tan();
            let largest = (1.0 / (2.0 + a * a).sqrt()).asin();
            let (sin, cos) = ((2.0 * t - 1.0) * largest).sin_cos();
            let y = cos / (1.0 + a * a).sqrt();
            Some(turn_back(Vec3::new(a * y, y, sin)))
        }),
    },
    SeedForm {
        id: "paper-shader",
        about: "word for word in f32: six rounded dot products, ceil, asin; has holes where ceil(-1) is taken as true",
        source: "Grimm and Niebruegge, Appendix A",
        forward: ccm::shader,
        inverse: None,
    },
    SeedForm {
        id: "fused-shader",
        about: "the listing with > 0 for ceil, products fused into sums as a compiler may choose: has holes near the corners",
        source: "Grimm and Niebruegge, Appendix A, as gcc's default contracts it",
        forward: ccm::fused_shader,
        inverse: None,
    },
    SeedForm {
        id: "printed-eq6",
        about: "Eq. 5, and Eq. 6 as it is printed: wrong by up to 0.224 of a face",
        source: "Grimm and Niebruegge, eq. 5 and 6",
        forward: ccm::printed,
        inverse: None,
    },
];

fn latlong(dir: Vec3<f32>, acos: fn(f32) -> f32) -> Point {
    let d = dir.scaled_direction()?.normalized();
    let u = 0.5 + d.x.atan2(d.z) / TAU;
    Some(ChartPoint::new(0, u, acos(d.y) * FRAC_1_PI))
}

fn latlong_inverse(point: ChartPoint<f32>) -> Dir {
    if !point.is_on(1) {
        return None;
    }
    let (sin_u, cos_u) = ((point.u - 0.5) * TAU).sin_cos();
    let (sin_v, cos_v) = (point.v * PI).sin_cos();
    Some(Vec3::new(sin_v * sin_u, cos_v, sin_v * cos_u))
}

fn angular(dir: Vec3<f32>, acos: fn(f32) -> f32) -> Point {
    let d = dir.scaled_direction()?.normalized();
    let scale = acos(d.z) / TAU / (d.x * d.x + d.y * d.y).sqrt();
    Some(ChartPoint::new(0, 0.5 + d.x * scale, 0.5 - d.y * scale))
}

fn angular_inverse(point: ChartPoint<f32>) -> Dir {
    if !(point.is_on(1) && Domain::Disc.contains(point.u, point.v)) {
        return None;
    }
    let (x, y) = (2.0 * point.u - 1.0, 1.0 - 2.0 * point.v);
    let (sin, cos) = y.atan2(x).sin_cos();
    let (across, z) = (PI * (x * x + y * y).sqrt()).sin_cos();
    Some(Vec3::new(across * cos, across * sin, z))
}

/// acos x = √(1 − x) P(x) for x >= 0, π less that of −x below: within 6.8e-5.
fn fast_acos(x: f32) -> f32 {
    let a = x.abs();
    let sum = ((-0.018_729_3 * a + 0.074_261_0) * a - 0.212_114_4) * a + 1.570_728_8;
    let angle = sum * (1.0 - a).sqrt();
    if x < 0.0 { PI - angle } else { angle }
}
