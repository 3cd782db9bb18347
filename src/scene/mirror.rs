//! A mirror before its surroundings: which direction is seen through each pixel.

use glam::Vec3;

use super::rows::fill_rows;
use super::{Ray, RayFrame, Target};
use crate::math;
use crate::optics::reflect;

/// What a ray from the eye sees of the surroundings.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seen {
    /// The direction whose light comes along the ray; of unit length to a rounding.
    pub dir: Vec3,
    /// It comes by way of the mirror; else it is the sky beside it.
    pub is_mirrored: bool,
}

/// What `ray` sees, the object being a mirror whose normals are interpolated from the vertices. Light meets it once: what is
/// reflected into the object again is not followed.
#[must_use]
pub fn seen(target: &Target, ray: Ray) -> Seen {
    match target.cast(ray) {
        None => Seen {
            dir: ray.dir,
            is_mirrored: false,
        },
        Some(hit) => {
            let [incident, normal] = [ray.dir, hit.normal].map(|v| math::Vec3::from(v.to_array()));
            Seen {
                dir: reflect(incident, normal).to_array().into(),
                is_mirrored: true,
            }
        }
    }
}

/// What is seen through the middle of each pixel of a screen of `size_px`, row by row from the top; on all cores. `stop` is asked after each
/// row, from several threads, with the part that is done in [0, 1]; true cancels. `None` when cancelled or when it does not
/// fit in memory.
#[must_use]
pub fn mirror_view(
    target: &Target,
    frame: &RayFrame,
    size_px: [u32; 2],
    stop: &(dyn Fn(f32) -> bool + Sync),
) -> Option<Vec<Seen>> {
    let [width, height] = size_px;
    let pixels = (width as usize).checked_mul(height as usize)?;
    let mut view = Vec::new();
    view.try_reserve_exact(pixels).ok()?;
    view.resize(pixels, Seen::default());
    let layers = std::iter::once(view.as_mut_slice());
    let is_whole = fill_rows(layers, size_px, stop, |y, row| {
        let v = (y as f32 + 0.5) / height as f32;
        for (x, place) in row.iter_mut().flat_map(|part| part.iter_mut().enumerate()) {
            let u = (x as f32 + 0.5) / width as f32;
            *place = seen(target, frame.ray((u, v)));
        }
    });
    is_whole.then_some(view)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Object};

    #[test]
    fn the_middle_of_a_ball_shows_the_eye_and_its_rim_what_is_behind_it() {
        let ball = Target::new(Object::Sphere.mesh());
        let camera = Camera::default();
        let size = [101, 101];
        let view = mirror_view(&ball, &camera.ray_frame(1.0), size, &|_| false).unwrap();
        let at = |x: usize, y: usize| view[y * 101 + x];
        let middle = at(50, 50);
        assert!(
            middle.is_mirrored && middle.dir.dot(Vec3::NEG_Z) > 0.999,
            "{middle:?}"
        );
        assert!(!at(0, 0).is_mirrored);
        assert_eq!(
            at(0, 0).dir,
            camera.ray((0.5 / 101.0, 0.5 / 101.0), 1.0).dir
        );
        // Along the row through the middle the mirrored direction goes from one side over the eye to the other.
        let row: Vec<Seen> = (0..101)
            .map(|x| at(x, 50))
            .filter(|s| s.is_mirrored)
            .collect();
        assert!(row.len() > 80, "{}", row.len());
        assert!(row.windows(2).all(|w| {
            let angle = |s: &Seen| f32::atan2(s.dir.x, -s.dir.z);
            angle(&w[0]) < angle(&w[1])
        }));
        assert!(row[0].dir.z > 0.3, "{:?}", row[0]);
    }

    #[test]
    fn a_part_of_the_screen_is_the_same_view_enlarged() {
        let ball = Target::new(Object::Sphere.mesh());
        let frame = Camera::default().ray_frame(1.5);
        let whole = mirror_view(&ball, &frame, [120, 80], &|_| false).unwrap();
        // The pixels 30 to 50 across and 10 to 24 down.
        let part = |uv| {
            let frame = frame.part(uv, [20.0 / 120.0, 14.0 / 80.0]);
            mirror_view(&ball, &frame, [20, 14], &|_| false).unwrap()
        };
        let off = |part: &[Seen]| {
            let places = (0..20 * 14).map(|k| (part[k], whole[(10 + k / 20) * 120 + 30 + k % 20]));
            let off = places.map(|(part, whole)| (part.dir - whole.dir).length());
            off.fold(0.0, f32::max)
        };
        let same = part((40.0 / 120.0, 17.0 / 80.0));
        assert!(off(&same) < 1e-4, "{}", off(&same));
        let elsewhere = part((0.5, 0.5));
        assert!(off(&elsewhere) > 0.1, "control");
    }

    #[test]
    fn it_stops_when_it_is_asked_to_and_takes_no_size() {
        let ball = Target::new(Object::Sphere.mesh());
        let frame = Camera::default().ray_frame(1.0);
        assert_eq!(mirror_view(&ball, &frame, [64, 64], &|_| true), None);
        for size in [[0, 5], [5, 0], [0, 0]] {
            let view = mirror_view(&ball, &frame, size, &|_| false);
            assert_eq!(view, Some(Vec::new()), "{size:?}");
        }
    }
}
