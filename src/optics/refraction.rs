//! Snell's law at one interface.

use crate::math::{Real, Vec3};

/// A ray at an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting<R> {
    /// n1/n2.
    pub eta: R,
    /// Cosine of the angle of incidence, in [0, 1].
    pub cos_incident: R,
    /// Ramires' k (Eq. 8): 1 - eta^2 (1 - cos^2), the square of the cosine of the refracted ray. Below zero where all light
    /// is reflected.
    pub k: R,
    /// Cosine of the angle of refraction; 0 at total internal reflection.
    pub cos_refracted: R,
}

impl<R: Real> Meeting<R> {
    /// From the cosine of the angle of incidence, in [0, 1].
    pub fn at_cosine(cos_incident: R, eta: R) -> Self {
        let sin_squared = (R::one() - cos_incident) * (R::one() + cos_incident);
        let k = R::one() - eta * eta * sin_squared;
        Self {
            eta,
            cos_incident,
            k,
            cos_refracted: k.max(R::zero()).sqrt(),
        }
    }

    /// True where no light is refracted.
    pub fn is_total(&self) -> bool {
        self.k < R::zero()
    }
}

/// How a ray meets an interface. `incident` and `normal` are unit; the normal is turned to face the ray.
pub fn meet<R: Real>(incident: Vec3<R>, normal: Vec3<R>, eta: R) -> Meeting<R> {
    Meeting::at_cosine(incident.dot(normal).abs().min(R::one()), eta)
}

/// The refracted ray, unit length; `None` at total internal reflection.
pub fn refract<R: Real>(incident: Vec3<R>, normal: Vec3<R>, eta: R) -> Option<Vec3<R>> {
    let meeting = meet(incident, normal, eta);
    if meeting.is_total() {
        return None;
    }
    let facing = if incident.dot(normal) > R::zero() {
        -normal
    } else {
        normal
    };
    let along = eta * meeting.cos_incident - meeting.cos_refracted;
    Some((incident * eta + facing * along).normalized())
}

/// The angle of incidence beyond which all light is reflected, in radians; `None` for eta <= 1, where there is none.
pub fn critical_angle_rad(eta: f64) -> Option<f64> {
    // asin(1/eta) by the two sides of its triangle, accurate also where eta is nearly 1.
    (eta > 1.0).then(|| f64::atan2(1.0, ((eta - 1.0) * (eta + 1.0)).sqrt()))
}
