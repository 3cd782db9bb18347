//! Snell's law at one interface.

use crate::math::{DoubleWord, Real, Vec3};

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
        Self::new(
            eta,
            cos_incident,
            DoubleWord::product(cos_incident, cos_incident),
        )
    }

    fn new(eta: R, cos_incident: R, cos_squared: DoubleWord<R>) -> Self {
        // Near the critical angle and near eta = 1 the terms cancel, and the root then doubles the digits that were lost.
        let eta_squared = DoubleWord::product(eta, eta);
        let k = (DoubleWord::from(R::one()) + -eta_squared) + eta_squared * cos_squared;
        Self {
            eta,
            cos_incident,
            k: k.high,
            cos_refracted: k.high.max(R::zero()).sqrt(),
        }
    }

    /// True where no light is refracted, and where the numbers given were no directions and no eta.
    pub fn is_total(&self) -> bool {
        self.k < R::zero() || !self.k.is_finite()
    }
}

/// How a ray meets an interface. `incident` and `normal` are unit as well as their type can say it; what is missing is made
/// up for. The normal is turned to face the ray.
pub fn meet<R: Real>(incident: Vec3<R>, normal: Vec3<R>, eta: R) -> Meeting<R> {
    meet_along(incident, normal, eta, DoubleWord::dot(incident, normal))
}

/// [`meet`], given the inner product of the two vectors.
fn meet_along<R: Real>(
    incident: Vec3<R>,
    normal: Vec3<R>,
    eta: R,
    along: DoubleWord<R>,
) -> Meeting<R> {
    let lengths = DoubleWord::dot(incident, incident) * DoubleWord::dot(normal, normal);
    let cos_incident = along.high.abs() / lengths.high.sqrt();
    Meeting::new(eta, cos_incident.min(R::one()), along * along / lengths)
}

/// The refracted ray, unit length; `None` at total internal reflection.
pub fn refract<R: Real>(incident: Vec3<R>, normal: Vec3<R>, eta: R) -> Option<Vec3<R>> {
    let along = DoubleWord::dot(incident, normal);
    let meeting = meet_along(incident, normal, eta, along);
    if meeting.is_total() {
        return None;
    }
    let facing = if along.high > R::zero() {
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
