//! The orbit camera: where the eye is, what it sees in which pixel, and the way back.
//!
//! Frames, all left-handed:
//!
//! - world: +x right, +y up, +z forward; the object sits at the origin and the default eye on -z looks to +z;
//! - view: the eye at the origin, +x to the right of the screen, +y up, +z away from the viewer;
//! - clip: x and y in -w..w (y up), z in 0..w, 0 at the near plane; the conventional depth, not reversed: clear the
//!   depth buffer to 1 and keep what is less;
//! - `uv`: `[0, 1]^2` over the screen, (0, 0) the upper left corner, v down.
//!
//! ```
//! use glam::Vec3;
//! use sixfold::scene::Camera;
//!
//! let camera = Camera::default();
//! assert!((camera.eye().normalize() - Vec3::NEG_Z).length() < 1e-6);
//! // The middle of the screen looks forward, and what lies to the right in the world is seen on the right.
//! let ray = camera.ray((0.5, 0.5), 1.0);
//! assert!((ray.dir - Vec3::Z).length() < 1e-6);
//! let (u, v) = camera.project(Vec3::new(0.5, 0.5, 0.0), 1.0).unwrap();
//! assert!(u > 0.5 && v < 0.5);
//! ```

use std::f32::consts::{PI, TAU};

use glam::{Mat4, Vec3, Vec4};
use serde::{Deserialize, Serialize};

/// Nearest eye, in world units: just outside the unit ball that holds every object, so that the eye is never inside.
pub const MIN_DISTANCE: f32 = 1.1;
/// Farthest eye, in world units; the object is then a few pixels wide.
pub const MAX_DISTANCE: f32 = 50.0;
/// Steepest pitch, 89 degrees: short of the pole, where the yaw would lose its meaning.
pub const MAX_PITCH_RAD: f32 = 89.0 / 180.0 * PI;
/// Narrowest vertical field of view, 1 degree.
pub const MIN_FOV_Y_RAD: f32 = PI / 180.0;
/// Widest vertical field of view, 120 degrees.
pub const MAX_FOV_Y_RAD: f32 = 120.0 / 180.0 * PI;
/// Near plane, in world units: half the gap between the nearest eye and the unit ball.
pub const NEAR: f32 = 0.5 * (MIN_DISTANCE - 1.0);
/// Far plane, in world units: twice the farthest eye, so that nothing of the scene is cut off.
pub const FAR: f32 = 2.0 * MAX_DISTANCE;

const DEFAULT_DISTANCE: f32 = 3.2;
/// 40 degrees: at the default distance the unit ball, 2 asin(1 / 3.2) = 36.4 degrees wide, fills nine tenths.
const DEFAULT_FOV_Y_RAD: f32 = 40.0 / 180.0 * PI;

/// A half-line in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, in world units.
    pub origin: Vec3,
    /// Where it goes; unit length when made by [`Camera::ray`].
    pub dir: Vec3,
}

/// Everything a full-screen pass needs to find the direction through a pixel: with `ndc` in [-1,1]^2 and y up,
/// the direction is `forward + ndc.x * right + ndc.y * up`, not normalized.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayFrame {
    /// The eye, in world units.
    pub eye: Vec3,
    /// The unit direction through the middle of the screen.
    pub forward: Vec3,
    /// From the middle to the right border on the plane one unit ahead.
    pub right: Vec3,
    /// From the middle to the upper border on the plane one unit ahead.
    pub up: Vec3,
}

impl RayFrame {
    /// The part of the screen around `uv` that has this share of its width and of its height, as a screen of its own. Its plane
    /// is the same, so that `forward` need not stand upright on it.
    #[must_use]
    pub fn part(&self, uv: (f32, f32), [width, height]: [f32; 2]) -> Self {
        let forward = self.towards(uv);
        let scale = forward.length().recip();
        Self {
            eye: self.eye,
            forward: scale * forward,
            right: scale * width * self.right,
            up: scale * height * self.up,
        }
    }

    /// From the eye to the plane.
    fn towards(&self, (u, v): (f32, f32)) -> Vec3 {
        self.forward + (2.0 * u - 1.0) * self.right + (1.0 - 2.0 * v) * self.up
    }

    /// The ray from the eye through `uv` in `[0, 1]^2`, v down; points beyond the screen are as good.
    ///
    /// No matrix is inverted: the direction is a sum of the screen's own vectors, so that its error stays at the
    /// rounding of a unit vector, also for a narrow field of view.
    #[must_use]
    pub fn ray(&self, uv: (f32, f32)) -> Ray {
        let dir = self.towards(uv);
        Ray {
            origin: self.eye,
            dir: dir.try_normalize().unwrap_or(self.forward),
        }
    }
}

/// An eye that circles the origin and always looks at it.
///
/// Plain data: any numbers may stand in the fields, and every method reads them through [`Camera::sanitized`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Camera {
    /// Turn around +y in radians; 0 looks to +z, a quarter turn looks to +x (the eye is then on -x).
    pub yaw_rad: f32,
    /// Height of the eye over the horizon in radians, within +-[`MAX_PITCH_RAD`]; positive is above.
    pub pitch_rad: f32,
    /// From the eye to the origin in world units, [`MIN_DISTANCE`] to [`MAX_DISTANCE`].
    pub distance: f32,
    /// Vertical field of view in radians, [`MIN_FOV_Y_RAD`] to [`MAX_FOV_Y_RAD`].
    pub fov_y_rad: f32,
}

impl Default for Camera {
    /// Straight ahead: the eye on -z, looking to +z.
    fn default() -> Self {
        Self {
            yaw_rad: 0.0,
            pitch_rad: 0.0,
            distance: DEFAULT_DISTANCE,
            fov_y_rad: DEFAULT_FOV_Y_RAD,
        }
    }
}

/// Unit axes of the view, in the world.
#[derive(Clone, Copy, Debug)]
struct Axes {
    right: Vec3,
    up: Vec3,
    forward: Vec3,
}

impl Camera {
    /// The nearest camera that makes sense: numbers that are not finite become the default's, the others are clamped
    /// and the yaw is wrapped to -pi..=pi.
    #[must_use]
    pub fn sanitized(self) -> Self {
        let default = Self::default();
        let finite = |value: f32, fallback: f32| if value.is_finite() { value } else { fallback };
        let yaw_rad = finite(self.yaw_rad, default.yaw_rad);
        Self {
            // A yaw already in range passes untouched, so that cleaning twice changes nothing.
            yaw_rad: if yaw_rad.abs() <= PI {
                yaw_rad
            } else {
                ((yaw_rad + PI).rem_euclid(TAU) - PI).clamp(-PI, PI)
            },
            pitch_rad: finite(self.pitch_rad, default.pitch_rad)
                .clamp(-MAX_PITCH_RAD, MAX_PITCH_RAD),
            distance: finite(self.distance, default.distance).clamp(MIN_DISTANCE, MAX_DISTANCE),
            fov_y_rad: finite(self.fov_y_rad, default.fov_y_rad)
                .clamp(MIN_FOV_Y_RAD, MAX_FOV_Y_RAD),
        }
    }

    /// Follows a drag of the pointer, `dx_rad` to the right and `dy_rad` down: the side of the object that faces the
    /// viewer goes with the pointer, so the eye goes to the left and up.
    pub fn orbit(&mut self, dx_rad: f32, dy_rad: f32) {
        let clean = self.sanitized();
        *self = Self {
            yaw_rad: clean.yaw_rad + dx_rad,
            pitch_rad: clean.pitch_rad + dy_rad,
            ..clean
        };
        if !(dx_rad.is_finite() && dy_rad.is_finite()) {
            *self = clean;
        }
        *self = self.sanitized();
    }

    /// Comes nearer for `factor` > 1 and goes away for `factor` < 1: the distance is divided by it. Factors that are
    /// not positive and finite do nothing.
    pub fn zoom(&mut self, factor: f32) {
        *self = self.sanitized();
        if factor.is_finite() && factor > 0.0 {
            self.distance = (self.distance / factor).clamp(MIN_DISTANCE, MAX_DISTANCE);
        }
    }

    /// Goes around until the eye is where `dir` points: there a mirror in the middle shows the light from `dir`. Over a pole
    /// it stops at [`MAX_PITCH_RAD`].
    pub fn go_to(&mut self, dir: Vec3) {
        let turned = Self {
            yaw_rad: f32::atan2(-dir.x, -dir.z),
            pitch_rad: f32::atan2(dir.y, dir.x.hypot(dir.z)),
            ..*self
        };
        if dir.is_finite() {
            *self = turned.sanitized();
        }
    }

    /// Back to the default: straight ahead from -z.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Where the eye is, in world units.
    #[must_use]
    pub fn eye(&self) -> Vec3 {
        -self.sanitized().distance * self.axes().forward
    }

    /// The view's unit axes. In closed form: they need no normalization and hold at any pitch.
    fn axes(&self) -> Axes {
        let clean = self.sanitized();
        let (sin_yaw, cos_yaw) = clean.yaw_rad.sin_cos();
        let (sin_pitch, cos_pitch) = clean.pitch_rad.sin_cos();
        Axes {
            right: Vec3::new(cos_yaw, 0.0, -sin_yaw),
            up: Vec3::new(sin_yaw * sin_pitch, cos_pitch, cos_yaw * sin_pitch),
            forward: Vec3::new(sin_yaw * cos_pitch, -sin_pitch, cos_yaw * cos_pitch),
        }
    }

    /// Half the width and half the height of the screen on the plane one unit ahead.
    fn half_extent(&self, aspect: f32) -> (f32, f32) {
        let half_height = (0.5 * self.sanitized().fov_y_rad).tan();
        (half_height * sane_aspect(aspect), half_height)
    }

    /// World to view: the eye goes to the origin, the view direction to +z. A rotation (determinant +1) and a shift,
    /// because both frames are left-handed.
    #[must_use]
    pub fn view_from_world(&self) -> Mat4 {
        let Axes { right, up, forward } = self.axes();
        // The eye is -distance * forward, so the shift is exactly (0, 0, distance).
        Mat4::from_cols(
            Vec4::new(right.x, up.x, forward.x, 0.0),
            Vec4::new(right.y, up.y, forward.y, 0.0),
            Vec4::new(right.z, up.z, forward.z, 0.0),
            Vec4::new(0.0, 0.0, self.sanitized().distance, 1.0),
        )
    }

    /// View to clip space of a screen of width / height = `aspect`: w is the view's z, depth runs from 0 at [`NEAR`]
    /// to 1 at [`FAR`]. Aspects that are not positive and finite count as 1.
    #[must_use]
    pub fn clip_from_view(&self, aspect: f32) -> Mat4 {
        let (half_width, half_height) = self.half_extent(aspect);
        // depth = (a z + b) / z with depth(NEAR) = 0 and depth(FAR) = 1.
        let a = FAR / (FAR - NEAR);
        Mat4::from_cols(
            Vec4::new(1.0 / half_width, 0.0, 0.0, 0.0),
            Vec4::new(0.0, 1.0 / half_height, 0.0, 0.0),
            Vec4::new(0.0, 0.0, a, 1.0),
            Vec4::new(0.0, 0.0, -a * NEAR, 0.0),
        )
    }

    /// World to clip space; see [`Camera::clip_from_view`].
    #[must_use]
    pub fn clip_from_world(&self, aspect: f32) -> Mat4 {
        self.clip_from_view(aspect) * self.view_from_world()
    }

    /// The eye and the three vectors that span the screen.
    #[must_use]
    pub fn ray_frame(&self, aspect: f32) -> RayFrame {
        let Axes { right, up, forward } = self.axes();
        let (half_width, half_height) = self.half_extent(aspect);
        RayFrame {
            eye: self.eye(),
            forward,
            right: half_width * right,
            up: half_height * up,
        }
    }

    /// The ray from the eye through `uv`; see [`RayFrame::ray`].
    #[must_use]
    pub fn ray(&self, uv: (f32, f32), aspect: f32) -> Ray {
        self.ray_frame(aspect).ray(uv)
    }

    /// Where `point` of the world is seen; `None` when it is not in front of the eye. The result may lie outside
    /// `[0, 1]^2`: beside the screen.
    #[must_use]
    pub fn project(&self, point: Vec3, aspect: f32) -> Option<(f32, f32)> {
        self.projection(aspect).project(point)
    }

    /// What projects many points onto a screen of width / height = `aspect`.
    #[must_use]
    pub fn projection(&self, aspect: f32) -> Projection {
        Projection {
            axes: self.axes(),
            distance: self.sanitized().distance,
            half_extent: self.half_extent(aspect),
        }
    }

    /// Where the point at infinity in direction `dir` (of any length) is seen, a star of the sky; `None` when it is
    /// not in front of the eye.
    #[must_use]
    pub fn project_direction(&self, dir: Vec3, aspect: f32) -> Option<(f32, f32)> {
        let dir = dir.try_normalize()?;
        let projection = self.projection(aspect);
        projection.uv_of_view(projection.axes.view_of(dir))
    }
}

impl Axes {
    fn view_of(&self, dir: Vec3) -> Vec3 {
        Vec3::new(self.right.dot(dir), self.up.dot(dir), self.forward.dot(dir))
    }
}

/// A camera before a screen of some shape: it finds where points are seen, as [`Camera::project`] does, but what is the same for all of them
/// only once.
#[derive(Clone, Copy, Debug)]
pub struct Projection {
    axes: Axes,
    distance: f32,
    /// Of the width and of the height, one unit ahead.
    half_extent: (f32, f32),
}

impl Projection {
    /// Where `point` of the world is seen; see [`Camera::project`].
    #[must_use]
    pub fn project(&self, point: Vec3) -> Option<(f32, f32)> {
        self.uv_of_view(self.axes.view_of(point) + self.distance * Vec3::Z)
    }

    fn uv_of_view(&self, view: Vec3) -> Option<(f32, f32)> {
        let (half_width, half_height) = self.half_extent;
        let x = view.x / (view.z * half_width);
        let y = view.y / (view.z * half_height);
        (view.z > 0.0 && x.is_finite() && y.is_finite()).then_some((0.5 + 0.5 * x, 0.5 - 0.5 * y))
    }
}

/// The smallest and largest positive aspect keep every matrix finite; a window of no height has aspect 1.
fn sane_aspect(aspect: f32) -> f32 {
    if aspect.is_finite() && aspect > 0.0 {
        aspect.clamp(1e-4, 1e4)
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_eye_goes_where_it_is_sent() {
        for dir in [Vec3::X, Vec3::NEG_Z, Vec3::new(0.3, -0.8, 0.5)] {
            for mut camera in cameras() {
                let before = (camera.distance, camera.fov_y_rad);
                camera.go_to(dir);
                let apart = camera.eye().angle_between(dir);
                assert!(apart < 1e-3, "{dir}: {apart}");
                assert_eq!((camera.distance, camera.fov_y_rad), before);
            }
        }
        let mut camera = Camera::default();
        camera.go_to(Vec3::Y);
        assert_eq!(camera.pitch_rad, MAX_PITCH_RAD);
        let before = camera;
        camera.go_to(Vec3::splat(f32::NAN));
        assert_eq!(camera, before);
    }

    /// Cameras over the whole range, the borders included.
    fn cameras() -> Vec<Camera> {
        let mut all = Vec::new();
        for yaw in -6..=6 {
            for pitch in [-MAX_PITCH_RAD, -0.7, 0.0, 0.4, MAX_PITCH_RAD] {
                for distance in [MIN_DISTANCE, 3.0, MAX_DISTANCE] {
                    for fov_y_rad in [MIN_FOV_Y_RAD, 0.7, MAX_FOV_Y_RAD] {
                        all.push(Camera {
                            yaw_rad: yaw as f32 * PI / 6.0,
                            pitch_rad: pitch,
                            distance,
                            fov_y_rad,
                        });
                    }
                }
            }
        }
        all
    }

    fn screen() -> impl Iterator<Item = (f32, f32)> {
        (0..=8).flat_map(|i| (0..=8).map(move |j| (i as f32 / 8.0, j as f32 / 8.0)))
    }

    /// Worst distance in uv, times the half height of the screen: the error as an angle near the middle.
    fn worst_round_trip(perturb: Vec3) -> (f32, f32) {
        let (mut worst_dir, mut worst_point) = (0.0f32, 0.0f32);
        for camera in cameras() {
            for aspect in [0.5, 1.0, 16.0 / 9.0] {
                let scale = (0.5 * camera.fov_y_rad).tan();
                for (u, v) in screen() {
                    let ray = camera.ray((u, v), aspect);
                    let dir = ray.dir + perturb;
                    let (a, b) = camera.project_direction(dir, aspect).unwrap();
                    worst_dir = worst_dir.max(scale * (a - u).abs().max((b - v).abs()));
                    let point = ray.origin + camera.distance * dir;
                    let (a, b) = camera.project(point, aspect).unwrap();
                    worst_point = worst_point.max(scale * (a - u).abs().max((b - v).abs()));
                }
            }
        }
        (worst_dir, worst_point)
    }

    #[test]
    fn a_ray_is_seen_where_it_was_shot() {
        let (dir, point) = worst_round_trip(Vec3::ZERO);
        println!("round trip: direction {dir:e}, point {point:e}");
        // Widest case: the corner at 120 degrees multiplies the rounding of a unit vector by 1 / cos^2 of 74 degrees.
        for observed in [dir, point] {
            assert!(observed < 4e-6, "{observed:e}");
            assert!(observed > 4e-8, "budget far above {observed:e}");
        }
        // Control: a direction off by a tenth of a milliradian is seen.
        let (dir, point) = worst_round_trip(Vec3::new(1e-4, 0.0, 0.0));
        assert!(dir > 1e-5 && point > 1e-5);
    }

    #[test]
    fn the_matrices_agree_with_the_closed_form() {
        let mut worst = 0.0f32;
        for camera in cameras() {
            for aspect in [0.5, 2.0] {
                let clip_from_world = camera.clip_from_world(aspect);
                for point in [Vec3::ZERO, Vec3::X, Vec3::new(0.2, -0.5, 0.3)] {
                    let clip = clip_from_world * point.extend(1.0);
                    let Some((u, v)) = camera.project(point, aspect) else {
                        assert!(clip.w <= 0.0);
                        continue;
                    };
                    let scale = clip.w * (0.5 * camera.fov_y_rad).tan();
                    let expected = (0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w);
                    worst = worst.max(scale * (u - expected.0).abs().max((v - expected.1).abs()));
                }
            }
        }
        println!("matrix against closed form: {worst:e}");
        assert!(worst < 2e-5 && worst > 0.0, "{worst:e}");
        // Control: the mirrored frame would put +x on the left.
        let front = Camera::default();
        let clip = front.clip_from_world(1.0) * Vec3::X.extend(1.0);
        assert!(clip.x / clip.w > 0.5 && -clip.x / clip.w < 0.0);
    }

    #[test]
    fn depth_runs_from_zero_to_one() {
        let clip_from_view = Camera::default().clip_from_view(1.5);
        let depth = |z: f32| {
            let clip = clip_from_view * Vec4::new(0.0, 0.0, z, 1.0);
            clip.z / clip.w
        };
        assert!(depth(NEAR).abs() < 1e-6 && (depth(FAR) - 1.0).abs() < 1e-6);
        assert!(depth(1.0) < depth(2.0), "not reversed");
        assert!(depth(0.5 * NEAR) < 0.0 && depth(2.0 * FAR) > 1.0, "control");
    }

    #[test]
    fn the_view_is_a_rotation() {
        for camera in cameras() {
            let view = glam::Mat3::from_mat4(camera.view_from_world());
            let deviation = view * view.transpose() - glam::Mat3::IDENTITY;
            let worst = deviation.to_cols_array().into_iter().fold(0.0, f32::max);
            assert!(worst < 4e-7, "{worst:e}");
            // +1: both frames are left-handed. A right-handed view (z towards the viewer) would give -1.
            assert!((view.determinant() - 1.0).abs() < 1e-6);
            let mirrored = glam::Mat3::from_diagonal(Vec3::new(1.0, 1.0, -1.0)) * view;
            assert!((mirrored.determinant() + 1.0).abs() < 1e-6, "control");
            let eye = camera
                .view_from_world()
                .transform_point3(camera.eye())
                .length();
            assert!(eye < 1e-5 * camera.distance, "{eye:e}");
        }
    }

    #[test]
    fn the_object_follows_the_pointer() {
        let mut camera = Camera::default();
        let before = camera.project(Vec3::NEG_Z, 1.0).unwrap();
        camera.orbit(0.1, 0.2);
        let after = camera.project(Vec3::NEG_Z, 1.0).unwrap();
        assert!(after.0 > before.0 && after.1 > before.1, "{after:?}");
        // Control: what lies behind the origin goes the other way.
        assert!(camera.project(Vec3::Z, 1.0).unwrap().0 < 0.5);
        for _ in 0..1000 {
            camera.orbit(0.9, 0.9);
        }
        assert!(camera.yaw_rad.abs() <= PI && camera.pitch_rad == MAX_PITCH_RAD);
        let distance = camera.distance;
        camera.zoom(2.0);
        assert_eq!(camera.distance, 0.5 * distance);
        camera.zoom(1e30);
        assert_eq!(camera.distance, MIN_DISTANCE);
    }

    #[test]
    fn any_number_gives_a_picture() {
        let wild = [f32::NAN, f32::INFINITY, -1e38, 0.0, 1e-40, 7.0];
        for a in wild {
            for b in wild {
                let mut camera = Camera {
                    yaw_rad: a,
                    pitch_rad: b,
                    distance: a,
                    fov_y_rad: b,
                };
                let clean = camera.sanitized();
                assert_eq!(clean, clean.sanitized());
                assert!(camera.clip_from_world(a).is_finite());
                let ray = camera.ray((a, b), b);
                assert!(ray.origin.is_finite() && (ray.dir.length() - 1.0).abs() < 1e-5);
                for seen in [
                    camera.project(Vec3::new(a, b, a), a),
                    camera.project_direction(Vec3::new(a, b, b), b),
                ] {
                    assert!(seen.is_none_or(|(u, v)| u.is_finite() && v.is_finite()));
                }
                camera.orbit(a, b);
                camera.zoom(a);
                assert_eq!(camera, camera.sanitized());
            }
        }
        assert!(
            Camera::default()
                .project_direction(Vec3::ZERO, 1.0)
                .is_none()
        );
        assert!(Camera::default().project(Vec3::NEG_Z * 9.0, 1.0).is_none());
    }

    #[test]
    fn survives_being_saved() {
        let camera = Camera::default();
        let text = serde_json::to_string(&camera).unwrap();
        assert_eq!(serde_json::from_str::<Camera>(&text).unwrap(), camera);
        let partial: Camera = serde_json::from_str(r#"{"distance": 1e39}"#).unwrap();
        assert!(!partial.distance.is_finite() || partial.distance == MAX_DISTANCE);
        assert_eq!(partial.sanitized(), Camera::default(), "1e39 is not an f32");
    }
}
