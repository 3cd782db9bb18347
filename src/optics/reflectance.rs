//! How much of the light is reflected: exact, approximated, and as the seeds print it.

use serde::{Deserialize, Serialize};

use super::Meeting;
use crate::math::Real;

/// A way to compute the reflectance of a dielectric.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Formula {
    /// Fresnel's equations for unpolarised light: the mean of s and p.
    #[default]
    Fresnel,
    /// Light polarised across the plane of incidence.
    FresnelS,
    /// Light polarised in the plane of incidence: none is reflected at Brewster's angle.
    FresnelP,
    /// Schlick's approximation (Ramires, Eq. 5) with a free exponent.
    Schlick,
    /// The Cg tutorial's bias + scale (1 - cos)^power (Ramires, Eq. 7), clamped to [0, 1].
    Cg,
    /// Ramires' `fresnelApprox`: 1 - cos^power.
    Simple,
    /// Ramires' first shader with the sign as printed, (1 + cos)^power: above 1 head-on (erratum R1).
    PrintedSign,
    /// Ramires' first shader's `mix(refr, refl, f)`, which ignores the angle (erratum R2).
    PrintedMix,
}

/// The numbers of the approximations.
///
/// With powers from 1 to 16 f32 is within 1e-5 of double precision. Below 1 a power's slope has no bound where its base is 0,
/// and a cosine in f32 does not say enough there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Shape<R> {
    /// Schlick's exponent; 5 in Eq. 5, 2 in Ramires' shaders.
    pub exponent: R,
    /// The Cg tutorial's reflectance head-on.
    pub bias: R,
    /// The Cg tutorial's scale.
    pub scale: R,
    /// The Cg tutorial's power, also that of [`Formula::Simple`], [`Formula::PrintedSign`].
    pub power: R,
}

impl<R: Real> Default for Shape<R> {
    /// Eq. 5's exponent, and the numbers of Ramires' shaders.
    fn default() -> Self {
        Self {
            exponent: R::from_f64(5.0),
            bias: R::from_f64(0.3),
            scale: R::from_f64(2.0),
            power: R::from_f64(2.0),
        }
    }
}

impl Formula {
    /// Every formula, the exact ones first.
    pub const ALL: [Self; 8] = [
        Self::Fresnel,
        Self::FresnelS,
        Self::FresnelP,
        Self::Schlick,
        Self::Cg,
        Self::Simple,
        Self::PrintedSign,
        Self::PrintedMix,
    ];

    /// Its name in lists.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fresnel => "Fresnel, exact",
            Self::FresnelS => "Fresnel, s",
            Self::FresnelP => "Fresnel, p",
            Self::Schlick => "Schlick",
            Self::Cg => "Cg tutorial",
            Self::Simple => "1 − cos^power",
            Self::PrintedSign => "as printed: 1 + cos (R1)",
            Self::PrintedMix => "as printed: constant (R2)",
        }
    }

    /// True where the seed's line is wrong and is kept to be seen.
    #[must_use]
    pub const fn is_fault(self) -> bool {
        matches!(self, Self::PrintedSign | Self::PrintedMix)
    }

    /// The part of the light that is reflected. In [0, 1] but for [`Formula::PrintedSign`]. Total internal reflection is known to
    /// the exact formulas alone.
    pub fn reflectance<R: Real>(self, meeting: &Meeting<R>, shape: &Shape<R>) -> R {
        let cos = meeting.cos_incident;
        let f = head_on(meeting.eta);
        let schlick = |change: R, power| f + (R::one() - f) * change.pow(power);
        match self {
            Self::Fresnel => (fresnel_s(meeting) + fresnel_p(meeting)) * R::half(),
            Self::FresnelS => fresnel_s(meeting),
            Self::FresnelP => fresnel_p(meeting),
            Self::Schlick => schlick(R::one() - cos, shape.exponent).clamp_unit(),
            Self::Cg => (shape.bias + shape.scale * (R::one() - cos).pow(shape.power)).clamp_unit(),
            Self::Simple => R::one() - cos.pow(shape.power),
            Self::PrintedSign => schlick(R::one() + cos, shape.power),
            Self::PrintedMix => f,
        }
    }
}

/// Reflectance at normal incidence, ((1 - eta)/(1 + eta))^2 (Ramires, Eq. 6).
pub fn head_on<R: Real>(eta: R) -> R {
    let ratio = (R::one() - eta) / (R::one() + eta);
    ratio * ratio
}

fn fresnel_s<R: Real>(meeting: &Meeting<R>) -> R {
    ratio_squared(
        meeting.eta * meeting.cos_incident,
        meeting.cos_refracted,
        meeting,
    )
}

fn fresnel_p<R: Real>(meeting: &Meeting<R>) -> R {
    ratio_squared(
        meeting.cos_incident,
        meeting.eta * meeting.cos_refracted,
        meeting,
    )
}

/// ((a - b)/(a + b))^2; 1 at total reflection. Where both are 0 the ray grazes an interface between equals, that is none.
fn ratio_squared<R: Real>(a: R, b: R, meeting: &Meeting<R>) -> R {
    if meeting.is_total() {
        return R::one();
    }
    let sum = a + b;
    if sum <= R::zero() {
        return R::zero();
    }
    let ratio = (a - b) / sum;
    ratio * ratio
}

/// Reflectance of a metal of complex index n + i k (relative to the outside) for unpolarised light, in [0, 1].
///
/// Born and Wolf, Principles of Optics, section 14.2, with a + i b = sqrt((n + i k)^2 - sin^2): the squares of (a - cos) and
/// (a cos - sin^2) are formed after the differences, so that nothing cancels.
pub fn metal_reflectance<R: Real>(cos_incident: R, n: R, k: R) -> R {
    let cos = cos_incident;
    let sin2 = (R::one() - cos) * (R::one() + cos);
    let d = n * n - k * k - sin2;
    let size = d.hypot(R::two() * n * k);
    let large = ((size + d.abs()) * R::half()).sqrt();
    if large <= R::zero() && cos <= R::zero() {
        // The ray grazes an interface between equals, that is none.
        return R::zero();
    }
    let small = if large > R::zero() {
        n * k / large
    } else {
        R::zero()
    };
    let (a, b) = if d < R::zero() {
        (small, large)
    } else {
        (large, small)
    };
    let s = squares(a - cos, b) / squares(a + cos, b);
    let p = s * squares(a * cos - sin2, b * cos) / squares(a * cos + sin2, b * cos);
    ((s + p) * R::half()).clamp_unit()
}

fn squares<R: Real>(a: R, b: R) -> R {
    a * a + b * b
}
