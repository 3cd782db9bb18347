//! The f64 mathematics against the literature's formulas in 192 bits, where an arccosine loses nothing that would show.
//!
//! The formulas are those that the articles print, not the stable forms that the mappings compute, so that the two have nothing
//! in common but the map.

#![expect(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use astro_float::{BigFloat, Consts, RoundingMode};
use sixfold::mapping::cube_face::to_frame;
use sixfold::mapping::{MappingId, algebraic, everitt, tangent};
use sixfold::math::Vec3;
use sixfold::math::inputs::{Random, SIGN_PATTERNS};

/// Bits of every number: of a cosine that differs from 1 by the square of 2^-39, more than a hundred are left.
const BITS: usize = 192;
const TO_NEAREST: RoundingMode = RoundingMode::ToEven;

/// 8 x 1.2e-16 is promised, in u and v.
const PROMISED: f64 = 8.0 * 1.2e-16;

thread_local! {
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().unwrap());
}

/// A number of 192 bits.
#[derive(Clone)]
struct Big(BigFloat);

fn big(number: f64) -> Big {
    Big(BigFloat::from_f64(number, BITS))
}

/// Calls a function that needs constants.
fn call(f: impl FnOnce(&mut Consts) -> BigFloat) -> Big {
    CONSTANTS.with_borrow_mut(|constants| Big(f(constants)))
}

fn pi() -> Big {
    call(|constants| constants.pi(BITS, TO_NEAREST))
}

impl Big {
    fn sqrt(&self) -> Self {
        Self(self.0.sqrt(BITS, TO_NEAREST))
    }

    fn asin(&self) -> Self {
        call(|constants| self.0.asin(BITS, TO_NEAREST, constants))
    }

    fn acos(&self) -> Self {
        call(|constants| self.0.acos(BITS, TO_NEAREST, constants))
    }

    fn ln(&self) -> Self {
        call(|constants| self.0.ln(BITS, TO_NEAREST, constants))
    }

    fn sin_cos(&self) -> (Self, Self) {
        let sin = call(|constants| self.0.sin(BITS, TO_NEAREST, constants));
        (
            sin,
            call(|constants| self.0.cos(BITS, TO_NEAREST, constants)),
        )
    }

    fn atan(&self) -> Self {
        call(|constants| self.0.atan(BITS, TO_NEAREST, constants))
    }

    /// Angle of the point (x, self).
    fn atan2(&self, x: &Self) -> Self {
        if x.0.is_zero() && self.0.is_zero() {
            return big(0.0);
        }
        let quarter = pi() / big(2.0);
        if x.0.is_zero() {
            return if self.0.is_negative() {
                -quarter
            } else {
                quarter
            };
        }
        let angle = (self.clone() / x.clone()).atan();
        match (x.0.is_negative(), self.0.is_negative()) {
            (false, _) => angle,
            (true, false) => angle + pi(),
            (true, true) => angle - pi(),
        }
    }

    fn abs(&self) -> Self {
        if self.0.is_negative() {
            -self.clone()
        } else {
            self.clone()
        }
    }

    fn to_f64(&self) -> f64 {
        let text = CONSTANTS.with_borrow_mut(|constants| {
            self.0
                .format(astro_float::Radix::Dec, TO_NEAREST, constants)
        });
        text.unwrap().parse().unwrap()
    }
}

macro_rules! operator {
    ($name:ident, $function:ident) => {
        impl $name for Big {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(&other.0, BITS, TO_NEAREST))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for Big {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.neg())
    }
}

/// (u, v) of a direction on a chart by the formulas of the literature; `None` for a mapping that has none here, and where a formula
/// has no value.
fn literature(map: MappingId, chart: u32, dir: [f64; 3]) -> Option<[Big; 2]> {
    let [x, y, z] = dir.map(big);
    let (one, two) = (big(1.0), big(2.0));
    let half = || big(0.5);
    let square = |c: &Big| c.clone() * c.clone();
    let n = (square(&x) + square(&y) + square(&z)).sqrt();
    let across = (square(&x) + square(&y)).sqrt();
    let face = || {
        let (sc, tc, ma) = to_frame(chart, Vec3::from_f64(dir));
        [big(sc) / big(ma), big(tc) / big(ma)]
    };
    Some(match map {
        MappingId::Latlong => [half() + x.atan2(&z) / (two * pi()), (y / n).acos() / pi()],
        MappingId::Sphere => {
            let m = two * (square(&x) + square(&y) + square(&(n - z))).sqrt();
            [half() + x / m.clone(), half() - y / m]
        }
        MappingId::Matcap => [
            (x / n.clone() + one.clone()) / two.clone(),
            (one - y / n) / two,
        ],
        MappingId::Paraboloid if chart == 0 => {
            let below = two * (n + z);
            [half() + x / below.clone(), half() - y / below]
        }
        MappingId::Paraboloid => {
            let below = two * (n - z);
            [half() - x / below.clone(), half() - y / below]
        }
        MappingId::Cube => face().map(|c| (c + big(1.0)) / big(2.0)),
        MappingId::Eac => face().map(|c| big(0.5) + two.clone() / pi() * c.atan()),
        MappingId::Ccm => {
            // Into the +y face, by the paper's rotations; then S and T turned as the face lies.
            let (x, y, z) = match chart {
                2 => (x, y, z),
                3 => (x, -y, -z),
                4 => (x, z, -y),
                5 => (x, -z, y),
                1 => (y, -x, z),
                _ => (-y, x, z),
            };
            let alpha = (one.clone() / big(3.0).sqrt()).asin();
            let ratio = x / y;
            let s = half() - (ratio.clone() / two.sqrt()).atan() / (two.clone() * alpha);
            let reach = (one.clone() / (two.clone() + square(&ratio)).sqrt()).asin();
            let t = half() + (z / n).asin() / (two * reach);
            match chart {
                5 => [s, one - t],
                1 => [t, s],
                0 => [one.clone() - t, one - s],
                _ => [one - s, t],
            }
        }
        MappingId::Octahedral | MappingId::OctahedralEqualArea => {
            let (right, ahead) = if map == MappingId::Octahedral {
                let sum = x.abs() + y.abs() + z.abs();
                (x.abs() / sum.clone(), z.abs() / sum)
            } else {
                let radius = (one.clone() - y.abs() / n).sqrt();
                let share = two.clone() / pi() * z.abs().atan2(&x.abs());
                (
                    radius.clone() * (one.clone() - share.clone()),
                    radius * share,
                )
            };
            let (right, ahead) = if y.0.is_negative() {
                (one.clone() - ahead, one.clone() - right)
            } else {
                (right, ahead)
            };
            [
                (signed(right, &x) + one.clone()) / two.clone(),
                (signed(ahead, &z) + one) / two,
            ]
        }
        MappingId::Angular if across.0.is_zero() => return None,
        MappingId::Angular => {
            let rho = (z / n).acos() / (two * pi());
            [
                half() + rho.clone() * x / across.clone(),
                half() - rho * y / across,
            ]
        }
        MappingId::Fisheye | MappingId::Equisolid if across.0.is_zero() => return None,
        MappingId::Fisheye | MappingId::Equisolid => {
            let (x, z) = if chart == 0 { (x, z) } else { (-x, -z) };
            let angle = (z / n).acos();
            let radius = if map == MappingId::Fisheye {
                angle / (pi() / two.clone())
            } else {
                two.sqrt() * (angle / two.clone()).sin_cos().0
            };
            let rho = radius / two;
            [
                half() + rho.clone() * x / across.clone(),
                half() - rho * y / across,
            ]
        }
        MappingId::Stereographic if across.0.is_zero() => return None,
        MappingId::Stereographic => {
            let (sin, cos) = ((z / n).acos() / two.clone()).sin_cos();
            let rho = sin / cos / big(6.0);
            [
                half() + rho.clone() * x / across.clone(),
                half() - rho * y / across,
            ]
        }
        MappingId::Mercator => {
            let sine = y / n;
            let slope = (one.clone() + sine.clone()) / (one - sine);
            let longitude = x.atan2(&z);
            let height = slope.ln() / two.clone();
            [
                half() + longitude / (two.clone() * pi()),
                half() - height / (two * pi()),
            ]
        }
        MappingId::Healpix => {
            let three = big(3.0);
            let quarters = two.clone() / pi() * x.atan2(&z);
            let sine = y / n;
            let (ring, k) = (chart / 4, f64::from(chart % 4));
            // Of the two turns that have a quarter the one in which the chart lies.
            let turned = |from: f64| {
                let t = quarters.clone() - big(from);
                if t.to_f64() > 2.0 {
                    t - big(4.0)
                } else if t.to_f64() < -2.0 {
                    t + big(4.0)
                } else {
                    t
                }
            };
            if (sine.abs() - two.clone() / three.clone()).0.is_positive() {
                let t = turned(k);
                let sigma = (three * (one.clone() - sine.abs())).sqrt();
                let (along, rest) = (sigma.clone() * t.clone(), sigma * (one.clone() - t));
                if ring == 0 {
                    [one - rest, along]
                } else {
                    [along, one - rest]
                }
            } else {
                let [column, row] = [[1.0, 0.0], [0.0, 0.0], [0.0, 1.0]][ring as usize];
                let middle = turned(k) + half();
                let height = sine * big(0.75);
                [
                    middle.clone() + height.clone() - big(column),
                    middle - height - big(row),
                ]
            }
        }
        MappingId::CylindricalEqualArea => [
            half() + x.atan2(&z) / (two.clone() * pi()),
            (one - y / n) / two,
        ],
        MappingId::Tangent => {
            let stretch = big(tangent::STRETCH);
            face().map(|c| big(0.5) + (stretch.clone() * c).atan() / (two.clone() * stretch.atan()))
        }
        MappingId::S2Quadratic => face().map(|c| {
            let p = (big(1.0) + big(3.0) * c.abs()).sqrt() - big(1.0);
            big(0.5) + signed(p, &c) / big(2.0)
        }),
        MappingId::Everitt => face().map(|c| {
            let slope = big(everitt::SLOPE);
            let p = c.clone() * (slope.clone() + (big(1.0) - slope) * c.abs());
            big(0.5) + p / big(2.0)
        }),
        MappingId::Algebraic => face().map(|c| {
            let bend = square(&big(algebraic::BEND));
            let p = (big(1.0) + bend.clone()) / (big(1.0) + bend * square(&c));
            big(0.5) + c * p.sqrt() / big(2.0)
        }),
        MappingId::Unicube => face().map(|c| big(0.5) + strip(c)),
        MappingId::Arvo => {
            let [a, b] = face();
            let height = (square(&a) + two.clone()) / (square(&a) + square(&b) + one);
            [half() + strip(a), half() + b * height.sqrt() / two]
        }
        MappingId::Qsc => {
            let [a, b] = face();
            let is_upright = (b.abs() - a.abs()).0.is_positive();
            let (major, minor) = if is_upright { (b, a) } else { (a, b) };
            if major.0.is_zero() {
                return None;
            }
            // As printed: theta in the quarter, the angle from the middle, and its largest value on the border.
            let theta = (minor / major.clone()).atan();
            let (sin, cos) = theta.sin_cos();
            let turned = theta + (sin / two.sqrt()).acos() - pi() / two.clone();
            let slope = big(12.0) / pi() * turned;
            let from_middle = big(1.0) - major_cos(&n, chart, dir);
            let reach = one.clone() - one.clone() / (one.clone() + square(&(one / cos))).sqrt();
            let along = signed((from_middle / reach).sqrt(), &major);
            let across = along.clone() * slope;
            let [p, q] = if is_upright {
                [across, along]
            } else {
                [along, across]
            };
            [half() + p / two.clone(), half() + q / two]
        }
        _ => return None,
    })
}

/// `magnitude` with the sign of `sign`.
fn signed(magnitude: Big, sign: &Big) -> Big {
    if sign.0.is_negative() {
        -magnitude
    } else {
        magnitude
    }
}

/// Half of p where columns hold equal solid angles: (3/pi) asin(a/sqrt(2 a^2 + 2)).
fn strip(a: Big) -> Big {
    let below = (big(2.0) * a.clone() * a.clone() + big(2.0)).sqrt();
    big(3.0) / pi() * (a / below).asin()
}

/// Cosine of the angle from the middle of a face.
fn major_cos(n: &Big, chart: u32, dir: [f64; 3]) -> Big {
    let (_, _, ma) = to_frame(chart, Vec3::from_f64(dir));
    big(ma) / n.clone()
}

/// Exact f32 directions: random ones, ties with every pattern of signs, and what lies a few units in the last place beside them.
fn directions() -> Vec<[f64; 3]> {
    let mut random = Random::new(71);
    let mut dirs: Vec<[f64; 3]> = SIGN_PATTERNS.map(|signs| signs.map(f64::from)).to_vec();
    dirs.extend((0..300).map(|_| random.adversarial().map(f64::from)));
    dirs.extend((0..300).map(|_| random.direction().map(f64::from)));
    dirs.retain(|dir| {
        let largest = dir.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
        // Beyond, the 192 bits would hold no cosine; any length will do by another law.
        let smallest = dir
            .iter()
            .filter(|c| **c != 0.0)
            .fold(largest, |least, c| least.min(c.abs()));
        largest > 0.0 && largest.is_finite() && smallest > largest * 2f64.powi(-60)
    });
    dirs
}

/// Largest difference in u and v, and how many directions were compared; `spoil` is added to the formula's u.
fn worst(map: MappingId, spoil: f64) -> (f64, usize) {
    let (mut worst, mut count) = (0.0_f64, 0);
    for dir in directions()
        .into_iter()
        .filter(|dir| map.info().coverage.contains(*dir))
    {
        let found = map.forward::<f64>(Vec3::from_f64(dir)).unwrap();
        let Some([u, v]) = literature(map, found.chart, dir) else {
            continue;
        };
        count += 1;
        for (exact, found) in [(u + big(spoil), found.u), (v, found.v)] {
            let difference = (exact - big(found)).abs().to_f64();
            // The date line is both 0 and 1.
            worst = worst.max(difference.min((1.0 - difference).abs()));
        }
    }
    (worst, count)
}

#[test]
fn the_mathematics_in_f64_is_as_near_as_it_promises() {
    let (mut most, mut held) = (0.0_f64, 0);
    for &map in MappingId::ALL {
        let (observed, count) = worst(map, 0.0);
        // Three maps are known by their inverse; the laws of the way there and back hold them.
        if count == 0 {
            continue;
        }
        held += 1;
        println!("{map:24} {observed:.2e} of {PROMISED:.2e}, {count} directions");
        assert!(count > 250, "{map}: only {count} directions");
        assert!(observed <= PROMISED, "{map}: {observed:e}");
        most = most.max(observed);
    }
    assert_eq!(held, 23);
    assert!(most > PROMISED / 10.0, "the promise is far above {most:e}");
}

#[test]
fn a_difference_of_a_few_units_is_noticed() {
    for &map in MappingId::ALL {
        let (observed, count) = worst(map, 1e-15);
        assert!(count == 0 || observed > PROMISED, "{map}: {observed:e}");
    }
}
