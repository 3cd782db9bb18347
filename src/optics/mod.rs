//! What happens to a ray before it looks up the map: reflection.

use glam::Vec3;

/// The mirrored ray: `incident` runs towards the surface, `normal` is unit and may point to either side of it, the result
/// runs away from the surface and is as long as `incident`.
///
/// Hoff's r = u - 2(u . n) n. (Grimm and Niebruegge print 2(N . I)N - I, which is the same for an incident vector that
/// runs *from* the surface.)
pub fn reflect(incident: Vec3, normal: Vec3) -> Vec3 {
    incident - 2.0 * incident.dot(normal) * normal
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mirrored_ray_leaves_the_surface() {
        let normal = Vec3::new(0.36, 0.48, 0.8);
        let incident = Vec3::new(0.1, -0.7, -0.5);
        let mirrored = reflect(incident, normal);
        assert!((mirrored.dot(normal) + incident.dot(normal)).abs() < 1e-6);
        assert!((mirrored.length() - incident.length()).abs() < 1e-6);
        assert!((reflect(mirrored, normal) - incident).length() < 1e-6);
        // The paper's sign with this incident vector points into the surface.
        let printed = 2.0 * normal.dot(incident) * normal - incident;
        assert!(printed.dot(normal) * mirrored.dot(normal) < 0.0);
    }
}
