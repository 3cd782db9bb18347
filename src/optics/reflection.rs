//! The mirrored ray.

use crate::math::{Real, Vec3};

/// The mirrored ray: `incident` runs towards the surface, `normal` is unit and may point to either side of it, the result
/// runs away from the surface and is as long as `incident`.
///
/// Hoff's r = u - 2(u . n) n, which is Ramires' Eq. 1.
pub fn reflect<R: Real>(incident: Vec3<R>, normal: Vec3<R>) -> Vec3<R> {
    incident - normal * (R::two() * incident.dot(normal))
}

/// Grimm and Niebruegge's 2(N . I)N - I with the incident vector of everybody else: points into the surface (erratum P6).
/// Right for an `incident` that runs *from* the surface.
pub fn reflect_as_printed<R: Real>(incident: Vec3<R>, normal: Vec3<R>) -> Vec3<R> {
    -reflect(incident, normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mirrored_ray_leaves_the_surface() {
        let normal = Vec3::new(0.36_f32, 0.48, 0.8);
        let incident = Vec3::new(0.1, -0.7, -0.5);
        let mirrored = reflect(incident, normal);
        assert!((mirrored.dot(normal) + incident.dot(normal)).abs() < 1e-6);
        assert!((mirrored.length() - incident.length()).abs() < 1e-6);
        assert!((reflect(mirrored, normal) - incident).length() < 1e-6);
        // The paper's sign with this incident vector points into the surface.
        let printed = reflect_as_printed(incident, normal);
        assert!(printed.dot(normal) * mirrored.dot(normal) < 0.0);
    }
}
