//! The exact path of a ray through a transparent unit ball: in, inner reflections, out.
//!
//! The path stays in the plane of incidence, and every point of it sees the same two angles: i outside, r inside, with
//! sin r = eta sin i. So one frame (outward normal, tangent along the path) describes it, and each chord turns that frame by
//! pi - 2r. Whatever leaves a point leaves it along cos(i) normal + sin(i) tangent, the outer reflection too. A ray that could
//! enter can leave: inside there is no total reflection.
//!
//! Each polarisation keeps its own reflectance R on the whole path, because the plane of incidence stays. Out of 1, R is
//! reflected outside and (1 - R)^2 R^m leaves after m inner reflections; unpolarised light is the mean of s and p of these
//! products, not the product of the means.
//!
//! `shaders/ball.wgsl` is the twin of the functions `ball_enter` to `ball_left_weight`.

use std::f64::consts::{PI, TAU};

use super::reflectance::Shape;
use super::{Formula, meet};
use crate::math::{Real, Vec3};

/// The most inner reflections that are followed. What is left then is (1 - R) R^17: 1e-13 head-on in diamond (R = 0.17),
/// and nowhere more than the maximum over R, at 17/18: 2.1 %.
pub const MAX_BOUNCES: u32 = 16;

/// Light that leaves the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exit<R> {
    /// Unit direction, away from the ball.
    pub dir: Vec3<R>,
    /// Its part of the light that came, in [0, 1].
    pub weight: R,
}

/// A ray inside the ball, about to meet its surface from within.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallRay<R> {
    /// The point that it meets, which is the unit outward normal there.
    pub normal: Vec3<R>,
    /// Unit, perpendicular to `normal`, the way the path goes on; zero head-on, where no way is better than another.
    pub tangent: Vec3<R>,
    /// Of the angle outside.
    pub cos_incident: R,
    /// Of the angle outside.
    pub sin_incident: R,
    /// Of the angle inside.
    pub cos_refracted: R,
    /// Of the angle inside.
    pub sin_refracted: R,
    /// Reflectance of the surface across the plane of incidence, from either side.
    pub reflectance_s: R,
    /// Reflectance in the plane of incidence.
    pub reflectance_p: R,
    /// Part of the s light that is in this ray.
    pub inside_s: R,
    /// Part of the p light that is in this ray.
    pub inside_p: R,
}

impl<R: Real> BallRay<R> {
    /// One chord further: the frame turns by pi - 2r.
    fn advanced(self) -> Self {
        let (cos, sin) = (self.cos_refracted, self.sin_refracted);
        let turn_cos = (sin - cos) * (sin + cos);
        let turn_sin = R::two() * sin * cos;
        Self {
            normal: self.normal * turn_cos + self.tangent * turn_sin,
            tangent: self.tangent * turn_cos - self.normal * turn_sin,
            ..self
        }
    }
}

/// The frame where `incident` meets the ball, and its light outside: nothing has entered yet.
fn ball_outside<R: Real>(incident: Vec3<R>, normal: Vec3<R>, eta: R) -> BallRay<R> {
    let meeting = meet(incident, normal, eta);
    let along = incident - normal * incident.dot(normal);
    let sin_incident = along.length();
    let shape = Shape::default();
    BallRay {
        normal,
        tangent: if sin_incident > R::zero() {
            along.normalized()
        } else {
            along
        },
        cos_incident: meeting.cos_incident,
        sin_incident,
        cos_refracted: meeting.cos_refracted,
        sin_refracted: (eta * sin_incident).min(R::one()),
        reflectance_s: Formula::FresnelS.reflectance(&meeting, &shape),
        reflectance_p: Formula::FresnelP.reflectance(&meeting, &shape),
        inside_s: R::zero(),
        inside_p: R::zero(),
    }
}

/// The ray after it has entered where the outward normal is `normal`, both unit; `eta` is the index outside over the index
/// of the ball.
///
/// At total reflection, possible for eta > 1, nothing is in the ray. A normal that points slightly away, as an interpolated
/// one does at a silhouette, stands for a ray as far on the other side of grazing.
pub fn ball_enter<R: Real>(incident: Vec3<R>, normal: Vec3<R>, eta: R) -> BallRay<R> {
    let outside = ball_outside(incident, normal, eta);
    BallRay {
        inside_s: R::one() - outside.reflectance_s,
        inside_p: R::one() - outside.reflectance_p,
        ..outside
    }
    .advanced()
}

/// The ray after one more inner reflection.
pub fn ball_bounce<R: Real>(ray: BallRay<R>) -> BallRay<R> {
    BallRay {
        inside_s: ray.inside_s * ray.reflectance_s,
        inside_p: ray.inside_p * ray.reflectance_p,
        ..ray
    }
    .advanced()
}

/// Where the ray itself goes, inside the ball; unit.
pub fn ball_inside_dir<R: Real>(ray: BallRay<R>) -> Vec3<R> {
    (ray.normal * ray.cos_refracted + ray.tangent * ray.sin_refracted).normalized()
}

/// Where that part of it goes which leaves here; unit.
pub fn ball_exit_dir<R: Real>(ray: BallRay<R>) -> Vec3<R> {
    (ray.normal * ray.cos_incident + ray.tangent * ray.sin_incident).normalized()
}

/// What leaves here, as a part of the unpolarised light that came.
pub fn ball_exit_weight<R: Real>(ray: BallRay<R>) -> R {
    let s = ray.inside_s * (R::one() - ray.reflectance_s);
    let p = ray.inside_p * (R::one() - ray.reflectance_p);
    (s + p) * R::half()
}

/// What stays inside here: lost to whoever follows the ray no further.
pub fn ball_left_weight<R: Real>(ray: BallRay<R>) -> R {
    (ray.inside_s * ray.reflectance_s + ray.inside_p * ray.reflectance_p) * R::half()
}

/// All light that leaves the ball: the outer reflection, then what comes out after 0, 1 ... `bounces` inner reflections (at
/// most [`MAX_BOUNCES`]). With `eta` and directions as for [`ball_enter`].
pub fn ball_paths<R: Real>(
    incident: Vec3<R>,
    normal: Vec3<R>,
    eta: R,
    bounces: u32,
) -> Vec<Exit<R>> {
    let outside = ball_outside(incident, normal, eta);
    let reflected = Exit {
        dir: ball_exit_dir(outside),
        weight: (outside.reflectance_s + outside.reflectance_p) * R::half(),
    };
    let rays = std::iter::successors(Some(ball_enter(incident, normal, eta)), |ray| {
        Some(ball_bounce(*ray))
    });
    let exits = rays.map(|ray| Exit {
        dir: ball_exit_dir(ray),
        weight: ball_exit_weight(ray),
    });
    let count = 1 + bounces.min(MAX_BOUNCES) as usize;
    std::iter::once(reflected)
        .chain(exits.take(count))
        .collect()
}

/// How far the light turns on its way through the ball with `bounces` inner reflections, in radians: 2 (i - r) + m (pi -
/// 2r). More than a half turn means that it crossed the line back to where it came from. `None` at total reflection;
/// `incidence_rad` in [0, pi/2].
#[must_use]
pub fn deflection_rad(incidence_rad: f64, eta: f64, bounces: u32) -> Option<f64> {
    let (sin, cos) = incidence_rad.sin_cos();
    let meeting = super::Meeting::at_cosine(cos, eta);
    let refracted_rad = f64::atan2(eta * sin, meeting.cos_refracted);
    let turned = 2.0 * (incidence_rad - refracted_rad);
    (!meeting.is_total()).then(|| turned + f64::from(bounces) * (PI - 2.0 * refracted_rad))
}

/// The angle of incidence at which the deflection with `bounces` inner reflections is smallest, in radians: Descartes' ray.
///
/// There dD/di = 0, which gives cos^2 i = (n^2 - 1) / (m (m + 2)). `None` where no angle fulfils it: m = 0, or n outside
/// (1, m + 1).
#[must_use]
pub fn descartes_incidence_rad(index: f64, bounces: u32) -> Option<f64> {
    let m = f64::from(bounces);
    let above = (index - 1.0) * (index + 1.0);
    // cos^2 and sin^2, both times m (m + 2) = (m + 1)^2 - 1.
    let below = (m + 1.0 - index) * (m + 1.0 + index);
    (above > 0.0 && below > 0.0 && bounces > 0).then(|| f64::atan2(below.sqrt(), above.sqrt()))
}

/// The radius of the rainbow of light with `bounces` inner reflections in drops of this index: the angle in radians, in [0,
/// pi], between the bow and the point opposite to the sun. `None` where there is none, see [`descartes_incidence_rad`].
#[must_use]
pub fn rainbow_angle_rad(index: f64, bounces: u32) -> Option<f64> {
    let incidence_rad = descartes_incidence_rad(index, bounces)?;
    let deflection_rad = deflection_rad(incidence_rad, 1.0 / index, bounces)?;
    // The bow is seen where the light comes from: against its direction.
    Some((deflection_rad.rem_euclid(TAU) - PI).abs())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::super::{reflect, refract};
    use super::*;
    use crate::math::angle_rad;

    type Dir = Vec3<f64>;

    /// Indices outside over inside: diamond, glass, water, a nearly invisible ball.
    const ETAS: [f64; 5] = [0.3, 1.0 / 2.42, 1.0 / 1.5, 0.75, 0.97];

    /// (incident, outward normal) from head-on to grazing, the plane of incidence turned from one to the next.
    fn meetings() -> impl Iterator<Item = (Dir, Dir)> {
        (0..=90).map(|degrees| {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let turn = Dir::new(0.36, 0.48, 0.8) * (0.7 * f64::from(degrees)).cos()
                + Dir::new(0.8, -0.6, 0.0) * (0.7 * f64::from(degrees)).sin();
            let normal = Dir::new(0.48, 0.64, -0.6);
            let across = normal.cross(turn).normalized();
            ((across * sin - normal * cos).normalized(), normal)
        })
    }

    /// The same on foot: from point to point by reflection and refraction at each.
    fn walked(incident: Dir, normal: Dir, eta: f64, bounces: u32) -> Vec<Dir> {
        let mut dirs = vec![reflect(incident, normal)];
        let (mut point, mut dir) = (normal, refract(incident, normal, eta).unwrap());
        for _ in 0..=bounces {
            point = (point - dir * (2.0 * dir.dot(point))).normalized();
            // From within, near grazing outside, the last digits may call it total.
            let out = refract(dir, point, 1.0 / eta);
            dirs.push(out.unwrap_or(dir - point * dir.dot(point)));
            dir = reflect(dir, point);
        }
        dirs
    }

    fn worst_angle(a: &[Dir], b: &[Dir]) -> f64 {
        assert_eq!(a.len(), b.len());
        let angles = a.iter().zip(b);
        angles
            .map(|(a, b)| angle_rad(a.to_f64(), b.to_f64()))
            .fold(0.0, f64::max)
    }

    fn dirs(exits: &[Exit<f64>]) -> Vec<Dir> {
        exits.iter().map(|exit| exit.dir).collect()
    }

    #[test]
    fn the_frame_goes_where_one_goes_on_foot() {
        let worst = |bounces: u32, eta_error: f64| {
            let mut worst = 0.0_f64;
            for eta in ETAS {
                for (incident, normal) in meetings() {
                    let exact = dirs(&ball_paths(incident, normal, eta + eta_error, bounces));
                    worst = worst.max(worst_angle(&exact, &walked(incident, normal, eta, bounces)));
                }
            }
            worst
        };
        // On foot the angle outside is found again at each exit. At grazing its cosine is the root of k, whose last digits are
        // worth 1/eta^2 = 11 times 2e-16, some ten roundings after four bounces: 1.5e-7. Observed 2.6e-7.
        let observed = worst(4, 0.0);
        assert!((1e-7..4e-7).contains(&observed), "{observed:e}");
        assert!(worst(4, 1e-6) > 1e-6, "control");
    }

    /// Largest error of the f32 paths against f64 of the same f32 input: direction in radians, weight.
    fn single_precision(bounces: u32, eta_error: f64) -> (f64, f64) {
        let (mut turned, mut weight) = (0.0_f64, 0.0_f64);
        for eta in ETAS.map(|eta| eta as f32) {
            for (incident, normal) in meetings() {
                let (incident, normal) = (
                    Vec3::<f32>::from_f64(incident.to_f64()),
                    Vec3::<f32>::from_f64(normal.to_f64()),
                );
                let single = ball_paths(incident, normal, eta, bounces);
                let double = ball_paths(
                    Dir::from_f64(incident.to_f64()),
                    Dir::from_f64(normal.to_f64()),
                    f64::from(eta) + eta_error,
                    bounces,
                );
                for (a, b) in single.iter().zip(double) {
                    turned = turned.max(angle_rad(a.dir.to_f64(), b.dir.to_f64()));
                    weight = weight.max((f64::from(a.weight) - b.weight).abs());
                }
            }
        }
        (turned, weight)
    }

    #[test]
    fn single_precision_keeps_the_house_accuracy() {
        // After two inner reflections; every chord adds its part. Observed 4.6e-7 rad and 1.2e-7.
        let (turned, weight) = single_precision(2, 0.0);
        assert!((2.5e-7..1e-6).contains(&turned), "{turned:e}");
        assert!((7.5e-8..3e-7).contains(&weight), "{weight:e}");
        let (turned, weight) = single_precision(2, 1e-5);
        assert!(turned > 1.5e-6 && weight > 1e-6, "control");
    }

    #[test]
    fn no_light_is_made_and_none_is_lost_but_the_rest() {
        for eta in ETAS.into_iter().chain([1.0, 1.2, 3.0]) {
            for (incident, normal) in meetings() {
                for bounces in [0, 1, 2, 7, MAX_BOUNCES] {
                    let exits = ball_paths(incident, normal, eta, bounces);
                    let sum: f64 = exits.iter().map(|exit| exit.weight).sum();
                    let mut ray = ball_enter(incident, normal, eta);
                    for _ in 0..bounces {
                        ray = ball_bounce(ray);
                    }
                    let left = ball_left_weight(ray);
                    assert!(
                        (sum + left - 1.0).abs() < 1e-14,
                        "{eta} {bounces} {sum} {left}"
                    );
                    assert!(exits.iter().all(|e| (0.0..=1.0).contains(&e.weight)));
                    // The bound that `MAX_BOUNCES` promises, reached nowhere else than at R = 17/18.
                    assert!(bounces < MAX_BOUNCES || left < 0.0211, "{left}");
                }
            }
        }
        // Control: the product of the means is another sum than the mean of the products.
        let (incident, normal) = meetings().nth(70).unwrap();
        let exits = ball_paths(incident, normal, 1.0 / 1.5, 0);
        let mean = exits[0].weight;
        let product = (1.0 - mean) * (1.0 - mean);
        assert!((exits[1].weight - product).abs() > 1e-3);
    }

    #[test]
    fn the_way_back_is_the_way_there() {
        for eta in ETAS {
            for (incident, normal) in meetings() {
                let mut ray = ball_enter(incident, normal, eta);
                for bounces in 0..4 {
                    let back = ball_paths(-ball_exit_dir(ray), ray.normal, eta, bounces);
                    let there = ball_paths(incident, normal, eta, bounces);
                    let (back, there) = (back[bounces as usize + 1], there[bounces as usize + 1]);
                    assert!((back.dir + incident).length() < 1e-13);
                    assert!((back.weight - there.weight).abs() < 1e-13);
                    ray = ball_bounce(ray);
                }
            }
        }
        // Control: another point of the same direction leads elsewhere.
        let (incident, normal) = meetings().nth(40).unwrap();
        let ray = ball_enter(incident, normal, 0.75);
        let back = ball_paths(
            -ball_exit_dir(ray),
            (ray.normal + normal * 0.1).normalized(),
            0.75,
            0,
        );
        assert!((back[1].dir + incident).length() > 1e-2);
    }

    #[test]
    fn total_reflection_lets_nothing_in_and_points_somewhere() {
        let (mut total, mut entered) = (0, 0);
        for (incident, normal) in meetings() {
            let exits = ball_paths(incident, normal, 1.5, 3);
            assert_eq!(exits.len(), 5);
            for exit in &exits {
                assert!((exit.dir.length() - 1.0).abs() < 1e-14);
            }
            if exits[0].weight == 1.0 {
                total += 1;
                assert!(exits[1..].iter().all(|exit| exit.weight == 0.0));
            } else {
                entered += 1;
                assert!(exits[1].weight > 0.0);
            }
        }
        // asin(1/1.5) = 41.8 degrees: 0 to 41 enter.
        assert_eq!((entered, total), (42, 49));
        assert_eq!(
            ball_paths(
                Dir::new(0.0, 0.0, 1.0),
                Dir::new(0.0, 0.0, -1.0),
                0.75,
                u32::MAX
            )
            .len(),
            18
        );
    }

    #[test]
    fn the_deflection_is_the_angle_between_the_rays() {
        for eta in ETAS {
            for (degrees, (incident, normal)) in meetings().enumerate() {
                let incidence = (degrees as f64).to_radians();
                for (bounces, exit) in ball_paths(incident, normal, eta, 3)[1..].iter().enumerate()
                {
                    let turned = deflection_rad(incidence, eta, bounces as u32).unwrap();
                    // Folded into [0, pi].
                    let folded = (PI - (turned.rem_euclid(TAU) - PI).abs()).abs();
                    let seen = angle_rad(incident.to_f64(), exit.dir.to_f64());
                    assert!((seen - folded).abs() < 1e-13, "{eta} {degrees} {bounces}");
                    let other = deflection_rad(incidence, eta, bounces as u32 + 1).unwrap();
                    assert!(turned < other, "control");
                }
            }
        }
        assert_eq!(deflection_rad(1.0, 1.5, 0), None);
    }

    #[test]
    fn the_rainbow_stands_where_it_is_published() {
        let degrees = |index, bounces| rainbow_angle_rad(index, bounces).unwrap().to_degrees();
        // J. A. Adam, The mathematical physics of rainbows and glories, Physics Reports 356 (2002): red light of 656 nm
        // (n = 1.3318) turns by 137.75 degrees, violet 405 nm (n = 1.3435) by 139.42.
        for (index, turned) in [(1.3318, 137.75), (1.3435, 139.42)] {
            assert!(
                (degrees(index, 1) - (180.0 - turned)).abs() < 0.01,
                "{}",
                degrees(index, 1)
            );
        }
        // Water in yellow light: 42 and 51 degrees.
        assert!((degrees(1.333, 1) - 42.08).abs() < 0.01);
        assert!((degrees(1.333, 2) - 50.89).abs() < 0.02);
        // Controls: ice's index, and no bow without an inner reflection, in air, or in too dense a drop.
        assert!((degrees(1.31, 1) - 42.08).abs() > 1.0);
        for (index, bounces) in [(1.333, 0), (1.0, 1), (2.0, 1), (f64::NAN, 1)] {
            assert_eq!(rainbow_angle_rad(index, bounces), None);
        }
    }

    #[test]
    fn descartes_ray_turns_least() {
        for (index, bounces) in [(1.333, 1), (1.333, 2), (1.5, 1), (2.42, 2)] {
            let at = descartes_incidence_rad(index, bounces).unwrap();
            let turned = |i| deflection_rad(i, 1.0 / index, bounces).unwrap();
            let smallest = (0..=10_000)
                .map(|k| turned(FRAC_PI_2 * f64::from(k) / 10_000.0))
                .fold(f64::INFINITY, f64::min);
            assert!(turned(at) <= smallest && smallest - turned(at) < 1e-7);
            let other = descartes_incidence_rad(index + 0.02, bounces).unwrap();
            assert!(turned(other) - smallest > 1e-5, "control");
        }
    }
}
