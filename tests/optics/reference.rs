//! The optics at one interface in double precision, by the textbooks, and the rays on which others are held against it.

use sixfold::math::inputs::Random;
use sixfold::math::{Vec3, angle_rad};
use sixfold::optics::Formula;
use sixfold::optics::metal::Metal;
use sixfold::optics::reflectance::Shape;

/// What every direction keeps, in radians.
pub const LAW_RAD: f64 = 1.5e-6;
/// What every reflectance keeps.
pub const LAW_REFLECTANCE: f64 = 1e-5;

/// A ray at an interface.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Towards the surface.
    pub incident: Vec3<f32>,
    /// On either side.
    pub normal: Vec3<f32>,
    /// n1/n2.
    pub eta: f32,
    /// Which formula.
    pub formula: Formula,
    /// Its numbers.
    pub shape: Shape<f32>,
    /// n and k.
    pub metal: [f32; 2],
}

/// What somebody made of it.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    pub reflected: [f64; 3],
    /// None or the mirrored ray at total reflection.
    pub refracted: Option<[f64; 3]>,
    pub k: f64,
    pub reflectance: f64,
    pub metal_reflectance: f64,
}

/// `count` rays: every angle between ray and normal from 0 to 180 degrees, eta from 0.3 to 3; half of them crowd around the
/// critical angle, the grazing one and the head-on one, and a third of the etas around 1.
pub fn cases(count: usize) -> Vec<Case> {
    let mut random = Random::new(31);
    (0..count).map(|i| case(i, &mut random)).collect()
}

fn case(i: usize, random: &mut Random) -> Case {
    let eta = match i % 6 {
        0 => [0.3, 0.66, 0.999, 1.0, 1.0001, 1.001, 1.5, 3.0][random.below(8) as usize],
        1 | 2 => 1.0 + signed_power(random, 7.0),
        _ => 0.3 + 2.7 * random.unit(),
    };
    let eta = eta as f32;
    let critical = (1.0 / f64::from(eta)).min(1.0).asin();
    let quarter = std::f64::consts::FRAC_PI_2;
    let angle = match random.below(8) {
        0 => quarter + signed_power(random, 8.0),
        1 | 2 => critical + signed_power(random, 8.0),
        3 => signed_power(random, 8.0),
        _ => 2.0 * quarter * random.unit(),
    };
    // From behind as often as from the front.
    let angle = if random.below(2) == 0 {
        angle
    } else {
        2.0 * quarter - angle
    };
    let unit = |v: [f32; 3]| Vec3::from_f64(v.map(f64::from)).normalized();
    let incident: Vec3<f64> = unit(random.direction());
    let across = incident.cross(unit(random.direction())).normalized();
    let normal = -incident * angle.cos() + across * angle.sin();
    let narrow = |v: Vec3<f64>| Vec3::from(v.to_array().map(|c| c as f32));
    let metal = Metal::ALL[random.below(5) as usize].index_rgb()[random.below(3) as usize];
    Case {
        incident: narrow(incident),
        normal: narrow(normal),
        eta,
        formula: Formula::ALL[i % Formula::ALL.len()],
        shape: Shape {
            exponent: 1.0 + 15.0 * random.unit() as f32,
            bias: random.unit() as f32,
            scale: 4.0 * random.unit() as f32,
            power: 1.0 + 15.0 * random.unit() as f32,
        },
        metal: metal.map(|c| c as f32),
    }
}

/// A number of either sign, of every size down to ten to the minus `digits`.
fn signed_power(random: &mut Random, digits: f64) -> f64 {
    let size = 10f64.powf(-1.0 - (digits - 1.0) * random.unit());
    if random.below(2) == 0 { size } else { -size }
}

/// The same numbers, widened, by the textbook. A direction is what its vector says, whatever its length.
pub fn exact(case: &Case) -> Found {
    let wide = |v: Vec3<f32>| Vec3::<f64>::from_f64(v.to_f64());
    let (incident, normal) = (wide(case.incident), wide(case.normal));
    let eta = f64::from(case.eta);
    let lengths = incident.dot(incident) * normal.dot(normal);
    let along = incident.dot(normal);
    let cos = (along.abs() / lengths.sqrt()).min(1.0);
    // Both cancel where k is 0, but only what rounding left of exact products: sqrt(k) is good to 1e-8 of eta cos.
    let k = (1.0 - eta) * (1.0 + eta) + eta * eta * (along * along / lengths);
    let refracted = refracted(incident.normalized(), normal.normalized(), eta, cos, k);
    Found {
        reflected: (incident - normal * (2.0 * along / normal.dot(normal))).to_f64(),
        refracted: (k >= 0.0).then(|| refracted.to_f64()),
        k,
        reflectance: reflectance(case, eta, cos, k),
        metal_reflectance: metal(cos, case.metal.map(f64::from)),
    }
}

fn refracted(incident: Vec3<f64>, normal: Vec3<f64>, eta: f64, cos: f64, k: f64) -> Vec3<f64> {
    let side = if incident.dot(normal) > 0.0 {
        1.0
    } else {
        -1.0
    };
    // The part along the surface grows by eta (Snell), the part along the normal makes up for it.
    let along_surface = incident - normal * (side * cos);
    along_surface * eta + normal * (side * k.max(0.0).sqrt())
}

fn reflectance(case: &Case, eta: f64, cos: f64, k: f64) -> f64 {
    let wide = |x: f32| f64::from(x);
    let Shape {
        exponent,
        bias,
        scale,
        power,
    } = case.shape;
    let f = ((1.0 - eta) / (1.0 + eta)).powi(2);
    let [s, p] = fresnel(eta, cos, k);
    match case.formula {
        Formula::Fresnel => 0.5 * (s + p),
        Formula::FresnelS => s,
        Formula::FresnelP => p,
        Formula::Schlick => f + (1.0 - f) * (1.0 - cos).powf(wide(exponent)),
        Formula::Cg => (wide(bias) + wide(scale) * (1.0 - cos).powf(wide(power))).clamp(0.0, 1.0),
        Formula::Simple => 1.0 - cos.powf(wide(power)),
        Formula::PrintedSign => f + (1.0 - f) * (1.0 + cos).powf(wide(power)),
        Formula::PrintedMix => f,
    }
}

/// Reflectance of s and p, with n1 = eta and n2 = 1 (Born and Wolf, section 1.5).
pub fn fresnel(eta: f64, cos: f64, k: f64) -> [f64; 2] {
    if k < 0.0 {
        return [1.0; 2];
    }
    if eta == 1.0 {
        return [0.0; 2];
    }
    let cos_refracted = k.sqrt();
    let s = (eta * cos - cos_refracted) / (eta * cos + cos_refracted);
    let p = (cos - eta * cos_refracted) / (cos + eta * cos_refracted);
    [s * s, p * p]
}

/// The metal's by complex numbers: Fresnel's formulas with m = n + i k in place of the index.
fn metal(cos: f64, [n, k]: [f64; 2]) -> f64 {
    type Complex = [f64; 2];
    let times = |a: Complex, b: Complex| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
    let size2 = |a: Complex| a[0] * a[0] + a[1] * a[1];
    let m2 = times([n, k], [n, k]);
    // m cos of the refracted ray = sqrt(m^2 - sin^2).
    let square = [m2[0] - (1.0 - cos * cos), m2[1]];
    let length = size2(square).sqrt();
    let root = [
        ((length + square[0]) / 2.0).max(0.0).sqrt(),
        ((length - square[0]) / 2.0).max(0.0).sqrt(),
    ];
    let s = size2([cos - root[0], -root[1]]) / size2([cos + root[0], root[1]]);
    let there = m2.map(|c| c * cos);
    let p = size2([there[0] - root[0], there[1] - root[1]])
        / size2([there[0] + root[0], there[1] + root[1]]);
    0.5 * (s + p)
}

/// Largest errors.
#[derive(Clone, Copy, Debug, Default)]
pub struct Errors {
    /// Of the mirrored ray, in radians.
    pub reflected_rad: f64,
    /// Of the refracted ray, in radians.
    pub refracted_rad: f64,
    /// Of every dielectric's reflectance; of the one line that exceeds 1 relative to it.
    pub reflectance: f64,
    /// Of metals' reflectance.
    pub metal: f64,
    /// Largest |k| at which total reflection was decided the other way.
    pub decided_wrongly: f64,
}

impl Errors {
    /// (what, observed, budget) of each kind.
    pub fn beside(self, budget: Self) -> [(&'static str, f64, f64); 5] {
        [
            ("reflected (rad)", self.reflected_rad, budget.reflected_rad),
            ("refracted (rad)", self.refracted_rad, budget.refracted_rad),
            ("reflectance", self.reflectance, budget.reflectance),
            ("metal", self.metal, budget.metal),
            (
                "k decided wrongly",
                self.decided_wrongly,
                budget.decided_wrongly,
            ),
        ]
    }
}

/// What was found against what is right. NaN counts as infinitely wrong.
pub fn compare(cases: &[Case], found: impl IntoIterator<Item = Found>) -> Errors {
    let mut errors = Errors::default();
    let worse = |worst: &mut f64, error: f64| {
        *worst = if error.is_nan() {
            f64::INFINITY
        } else {
            worst.max(error)
        };
    };
    for (case, found) in cases.iter().zip(found) {
        let right = exact(case);
        worse(
            &mut errors.reflected_rad,
            angle_rad(found.reflected, right.reflected),
        );
        if (found.k < 0.0) == (right.k < 0.0) {
            let dir = right.refracted.unwrap_or(right.reflected);
            if let Some(found) = found.refracted {
                worse(&mut errors.refracted_rad, angle_rad(found, dir));
            } else if right.refracted.is_some() {
                worse(&mut errors.refracted_rad, f64::INFINITY);
            }
        } else {
            // At the critical angle itself the ray jumps from one way to the other.
            worse(&mut errors.decided_wrongly, right.k.abs());
        }
        let size = right.reflectance.max(1.0);
        worse(
            &mut errors.reflectance,
            (found.reflectance - right.reflectance).abs() / size,
        );
        worse(
            &mut errors.metal,
            (found.metal_reflectance - right.metal_reflectance).abs(),
        );
    }
    errors
}
