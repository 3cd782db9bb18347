//! Reflectance over the angle of incidence: curves, and how far an approximation is from the exact one.

use std::f64::consts::FRAC_PI_2;

use super::reflectance::{Formula, Shape, metal_reflectance};
use super::refraction::{Meeting, critical_angle_rad};

/// A material's numbers in f64.
#[must_use]
pub fn widened(shape: Shape<f32>) -> Shape<f64> {
    Shape {
        exponent: shape.exponent.into(),
        bias: shape.bias.into(),
        scale: shape.scale.into(),
        power: shape.power.into(),
    }
}

/// Angle of incidence at which no light polarised in the plane of incidence is reflected, in radians: its tangent is n2/n1.
#[must_use]
pub fn brewster_angle_rad(eta: f64) -> f64 {
    f64::atan2(1.0, eta)
}

/// A reflectance that depends on the angle of incidence alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Of a dielectric by a formula.
    Dielectric {
        /// The formula.
        formula: Formula,
        /// n1/n2.
        eta: f64,
        /// The numbers of the approximations.
        shape: Shape<f64>,
    },
    /// Of a metal of index [n, k].
    Metal {
        /// [n, k], relative to the outside.
        index: [f64; 2],
    },
    /// Schlick's approximation for that metal: from its own reflectance head-on up to 1.
    MetalSchlick {
        /// [n, k], relative to the outside.
        index: [f64; 2],
        /// 5 in Schlick's article.
        exponent: f64,
    },
}

/// Where an approximation is farthest from the exact reflectance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestError {
    /// The approximation less the exact reflectance.
    pub error: f64,
    /// The angle of incidence there, in radians.
    pub angle_rad: f64,
}

impl Law {
    /// The reflectance at an angle of incidence in radians, 0 to a right angle.
    #[must_use]
    pub fn reflectance(&self, angle_rad: f64) -> f64 {
        let cos = angle_rad.cos();
        match *self {
            Self::Dielectric {
                formula,
                eta,
                shape,
            } => formula.reflectance(&Meeting::at_cosine(cos, eta), &shape),
            Self::Metal { index: [n, k] } => metal_reflectance(cos, n, k),
            Self::MetalSchlick {
                index: [n, k],
                exponent,
            } => {
                let head_on = metal_reflectance(1.0, n, k);
                head_on + (1.0 - head_on) * (1.0 - cos).powf(exponent)
            }
        }
    }

    /// What this law approximates; itself when it is exact for unpolarised light.
    #[must_use]
    pub fn exact(self) -> Self {
        match self {
            Self::Dielectric { eta, shape, .. } => Self::Dielectric {
                formula: Formula::Fresnel,
                eta,
                shape,
            },
            Self::Metal { index } | Self::MetalSchlick { index, .. } => Self::Metal { index },
        }
    }

    /// The critical angle in radians, where the exact curve has a kink.
    #[must_use]
    pub fn critical_angle_rad(&self) -> Option<f64> {
        match self {
            Self::Dielectric { eta, .. } => critical_angle_rad(*eta),
            Self::Metal { .. } | Self::MetalSchlick { .. } => None,
        }
    }

    /// Points [angle of incidence in radians, reflectance] from 0 to a right angle, `samples` spans or twice as many where the
    /// critical angle parts the curve. It is one of the points, and they crowd towards it: there the exact curve has the slope
    /// of a square root, which becomes that of a line.
    #[must_use]
    pub fn curve(&self, samples: u32) -> Vec<[f64; 2]> {
        let angles = angles(self.critical_angle_rad(), samples).into_iter();
        angles
            .map(|angle_rad| [angle_rad, self.reflectance(angle_rad)])
            .collect()
    }

    /// Where it is farthest from [`exact`](Self::exact), to 1e-8 rad; 0 at angle 0 for the exact laws themselves.
    ///
    /// Found on a grid and refined by golden section (Kiefer 1953) between the grid's neighbours.
    #[must_use]
    pub fn largest_error(&self) -> LargestError {
        let exact = self.exact();
        let at = |angle_rad: f64| LargestError {
            error: self.reflectance(angle_rad) - exact.reflectance(angle_rad),
            angle_rad,
        };
        let grid = angles(self.critical_angle_rad(), SEARCH);
        let mut best = (0, at(0.0));
        for (i, &angle_rad) in grid.iter().enumerate() {
            let here = at(angle_rad);
            if here.error.abs() > best.1.error.abs() {
                best = (i, here);
            }
        }
        let (index, on_grid) = best;
        // The kink may be the peak of two slopes: each side of the best point is searched by itself.
        let sides = [index.checked_sub(1), index.checked_add(1)];
        sides
            .into_iter()
            .filter_map(|i| grid.get(i?))
            .map(|&neighbour| refined(&at, on_grid.angle_rad, neighbour))
            .fold(on_grid, LargestError::or_larger)
    }
}

impl LargestError {
    fn or_larger(self, other: Self) -> Self {
        if other.error.abs() > self.error.abs() {
            other
        } else {
            self
        }
    }
}

/// Spans of the first search: the formulas have at most a few hills, which are degrees wide.
const SEARCH: u32 = 180;

/// Angles from 0 to a right angle, crowded towards the kink if there is one.
fn angles(kink_rad: Option<f64>, samples: u32) -> Vec<f64> {
    let samples = samples.max(1);
    let spans = |from: f64, to: f64| {
        (0..=samples).map(move |i| {
            let left = 1.0 - f64::from(i) / f64::from(samples);
            // At both ends exactly.
            let left = if kink_rad == Some(to) {
                left * left
            } else {
                left
            };
            to - (to - from) * left
        })
    };
    match kink_rad {
        Some(kink) => spans(0.0, kink)
            .chain(spans(kink, FRAC_PI_2).skip(1))
            .collect(),
        None => spans(0.0, FRAC_PI_2).collect(),
    }
}

/// Golden section for the largest absolute value between two angles.
fn refined(at: &impl Fn(f64) -> LargestError, from: f64, to: f64) -> LargestError {
    /// (sqrt 5 - 1)/2.
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    /// A maximum is flat: below the square root of f64's epsilon its place cannot be told apart.
    const NARROW: f64 = 1e-8;
    let (mut low, mut high) = (from.min(to), from.max(to));
    let inner = |low: f64, high: f64| {
        let step = GOLDEN * (high - low);
        (at(high - step), at(low + step))
    };
    let (mut left, mut right) = inner(low, high);
    while high - low > NARROW {
        if left.error.abs() < right.error.abs() {
            low = left.angle_rad;
        } else {
            high = right.angle_rad;
        }
        (left, right) = inner(low, high);
    }
    left.or_larger(right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optics::metal::Metal;

    const GLASS: f64 = 0.66;

    fn law(formula: Formula, eta: f64) -> Law {
        let shape = Shape::default();
        Law::Dielectric {
            formula,
            eta,
            shape,
        }
    }

    fn error(law: &Law, angle_rad: f64) -> f64 {
        (law.reflectance(angle_rad) - law.exact().reflectance(angle_rad)).abs()
    }

    /// The largest error on a million angles and at the kink, by nothing but comparison.
    fn brute_force(law: &Law) -> f64 {
        let n = 1_000_000;
        let scanned = (0..=n).map(|i| FRAC_PI_2 * f64::from(i) / f64::from(n));
        scanned
            .chain(law.critical_angle_rad())
            .map(|angle| error(law, angle))
            .fold(0.0, f64::max)
    }

    #[test]
    fn the_largest_error_is_what_a_million_angles_find() {
        for eta in [GLASS, 1.0 / GLASS, 0.41, 1.33, 3.0] {
            for formula in Formula::ALL {
                let law = law(formula, eta);
                let largest = law.largest_error();
                let found = largest.error.abs();
                let scanned = brute_force(&law);
                // The scan is 8e-7 rad off at most, which counts where the Cg curve is cut off at 1.
                let budget = if formula == Formula::Cg { 1e-6 } else { 1e-9 };
                assert!(
                    (-1e-12..budget).contains(&(found - scanned)),
                    "{formula:?} at eta {eta}: {found}, by scanning {scanned}"
                );
                assert_eq!(found, error(&law, largest.angle_rad));
            }
        }
        // The grid alone is not enough: that is what the refinement is for.
        let schlick = law(Formula::Schlick, GLASS);
        let on_grid = angles(None, SEARCH)
            .into_iter()
            .map(|angle| error(&schlick, angle))
            .fold(0.0, f64::max);
        assert!(brute_force(&schlick) - on_grid > 1e-9);
    }

    #[test]
    fn errors_of_closed_form() {
        let head_on = ((1.0 - GLASS) / (1.0 + GLASS)).powi(2);
        // The constant of R2 is farthest off at grazing incidence, where all is reflected.
        let constant = law(Formula::PrintedMix, GLASS).largest_error();
        assert!((constant.error - (head_on - 1.0)).abs() < 1e-12);
        assert_eq!(constant.angle_rad, FRAC_PI_2);
        // The sign of R1 adds (1 - f) 2^2 head-on.
        let sign = law(Formula::PrintedSign, GLASS).largest_error();
        assert!(
            (sign.error - 4.0 * (1.0 - head_on)).abs() < 1e-9,
            "{sign:?}"
        );
        assert!(sign.angle_rad < 1e-3);
        // From inside, Schlick's curve misses total reflection most where it begins.
        let inside = law(Formula::Schlick, 1.0 / GLASS).largest_error();
        assert_eq!(Some(inside.angle_rad), critical_angle_rad(1.0 / GLASS));
        let exact = law(Formula::Fresnel, GLASS).largest_error();
        assert_eq!((exact.error, exact.angle_rad), (0.0, 0.0));
    }

    #[test]
    fn a_curve_ends_at_the_borders_and_has_the_kink() {
        for eta in [GLASS, 1.0 / GLASS] {
            let points = law(Formula::Fresnel, eta).curve(60);
            assert_eq!(points[0][0], 0.0);
            // The cosine of f64's right angle is 6e-17, and the curve is steep there.
            let [last, grazing] = points[points.len() - 1];
            assert!(last == FRAC_PI_2 && grazing > 1.0 - 1e-14, "{grazing}");
            assert!(points.windows(2).all(|w| w[0][0] < w[1][0]));
            let longest = points.windows(2).map(|w| (w[1][1] - w[0][1]).abs());
            let longest = longest.fold(0.0, f64::max);
            assert!(
                (0.02..0.2).contains(&longest),
                "eta {eta}: a stroke of {longest}"
            );
            if let Some(critical) = critical_angle_rad(eta) {
                let at = points.iter().position(|p| p[0] == critical).unwrap();
                assert!(points[at][1] > 1.0 - 1e-6 && points[at - 1][1] < 1.0);
                assert!(points[at + 1..].iter().all(|p| p[1] == 1.0));
            }
        }
    }

    #[test]
    fn at_brewsters_angle_p_vanishes_and_s_does_not() {
        for eta in [GLASS, 1.0 / GLASS, 0.3, 3.0] {
            let angle = brewster_angle_rad(eta);
            let p = law(Formula::FresnelP, eta).reflectance(angle);
            assert!(p < 1e-28, "{p} at eta {eta}");
            assert!(law(Formula::FresnelS, eta).reflectance(angle) > 0.01);
        }
    }

    #[test]
    fn schlick_for_a_metal_is_right_at_both_ends_and_wrong_between() {
        for metal in Metal::ALL {
            for index in metal.index_rgb() {
                let schlick = Law::MetalSchlick {
                    index,
                    exponent: 5.0,
                };
                assert!(error(&schlick, 0.0) < 1e-12 && error(&schlick, FRAC_PI_2) < 1e-12);
                let found = schlick.largest_error().error.abs();
                let scanned = brute_force(&schlick);
                assert!(
                    (found - scanned).abs() < 1e-9 && found > 1e-3,
                    "{found} {scanned}"
                );
                assert_eq!(Law::Metal { index }.largest_error().error, 0.0);
            }
        }
    }
}
