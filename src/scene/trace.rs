//! Light through a transparent object of any shape: both surfaces, by tracing.
//!
//! At each crossing of the surface the ray is bent by the normal interpolated from the vertices, as the renderer shades, so
//! that a mesh looks as smooth as it is drawn. Where that normal would send light through to the wrong side of the
//! triangle, the triangle's own normal takes its place.
//!
//! Light is unpolarised at every crossing: the plane of incidence changes from one to the next, and with it what s and p
//! mean. On a sphere, where it does not, [`ball_paths`](crate::optics::ball::ball_paths) is exact; a mesh differs from it
//! in weights by that.
//!
//! Parts that overlap (the teapot's handle runs into its body) are one piece of glass: inside, a surface is only crossed
//! when its last part is left. Where a part is open, a ray that finds no way out goes straight on.

use glam::Vec3;

use super::rows::fill_rows;
use super::{Camera, Hit, Ray, Target};
use crate::math;
use crate::optics::ball::MAX_BOUNCES;
use crate::optics::reflectance::Shape;
use crate::optics::{self, Formula, meet, refract};

/// Most directions in which the light of one ray leaves: the outer reflection, and one after 0, 1 ... [`MAX_BOUNCES`] inner
/// reflections.
pub const MAX_ESCAPES: usize = 2 + MAX_BOUNCES as usize;

/// Surfaces that a ray may cross inside before it is given up: a bound for meshes of nested sheets, never met by a body.
const MAX_CROSSINGS: u32 = 64;

/// Light that leaves the object.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Escape {
    /// The point of the surface that it leaves, world units.
    pub point: Vec3,
    /// Unit direction, away from there.
    pub dir: Vec3,
    /// Its part of the light that came, in [0, 1]; 0 where all is reflected back inside.
    pub weight: f32,
}

/// Where the light of one ray goes: the outer reflection first, then what leaves after 0, 1 ... inner reflections.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Escapes {
    list: [Escape; MAX_ESCAPES],
    count: usize,
    lost: f32,
}

impl Escapes {
    const NONE: Self = Self {
        list: [Escape {
            point: Vec3::ZERO,
            dir: Vec3::ZERO,
            weight: 0.0,
        }; MAX_ESCAPES],
        count: 0,
        lost: 0.0,
    };

    fn push(&mut self, point: Vec3, dir: Vec3, weight: f32) {
        if let Some(place) = self.list.get_mut(self.count) {
            *place = Escape { point, dir, weight };
            self.count += 1;
        }
    }

    /// The directions, at least one unless the ray had none.
    #[must_use]
    pub fn as_slice(&self) -> &[Escape] {
        self.list.get(..self.count).unwrap_or_default()
    }

    /// The part of the light that was still inside after the last inner reflection.
    #[must_use]
    pub fn lost(&self) -> f32 {
        self.lost
    }
}

/// A ray at a surface.
struct Bend {
    reflected: Vec3,
    /// `None` where all light is reflected.
    refracted: Option<Vec3>,
    reflectance: f32,
}

/// Bends `dir`, unit; `eta` is the index on its side over the index on the other.
fn bend(dir: Vec3, hit: &Hit, eta: f32) -> Bend {
    // Both normals against the ray.
    let face = against(hit.face_normal, dir);
    let smooth = if hit.normal.dot(face) < 0.0 {
        -hit.normal
    } else {
        hit.normal
    };
    let by = |normal: Vec3| {
        let [incident, normal] = [dir, normal].map(|v| math::Vec3::from(v.to_array()));
        // Unit to a rounding, so that many inner reflections do not add theirs up.
        let out = |v: math::Vec3<f32>| Vec3::from(v.normalized().to_array());
        let reflectance =
            Formula::Fresnel.reflectance(&meet(incident, normal, eta), &Shape::default());
        Bend {
            reflected: out(optics::reflect(incident, normal)),
            refracted: refract(incident, normal, eta).map(out),
            reflectance,
        }
    };
    let bent = by(smooth);
    let goes_through = bent.refracted.is_none_or(|dir| dir.dot(face) < 0.0);
    if smooth.dot(dir) < 0.0 && bent.reflected.dot(face) > 0.0 && goes_through {
        return bent;
    }
    by(face)
}

fn against(normal: Vec3, dir: Vec3) -> Vec3 {
    if normal.dot(dir) > 0.0 {
        -normal
    } else {
        normal
    }
}

/// The ray on from the surface at `hit`, begun a step away from the triangle so as not to meet it again.
///
/// The point is rounded to f32 and the next crossing is found to a few roundings of the size of the mesh: both are far
/// below 16 units of f32 at the mesh's reach, which is the margin of the boxes too. The step leads along the ray, which
/// stays where it is; but a ray within a degree (1/64) of the surface would go too far in that, and is lifted along the
/// normal instead.
fn onwards(target: &Target, hit: &Hit, dir: Vec3) -> Ray {
    let height = 16.0 * f32::EPSILON * target.reach();
    let side = -against(hit.face_normal, dir);
    let cos = side.dot(dir);
    let step = if cos > 1.0 / 64.0 {
        dir * (height / cos)
    } else {
        side * height
    };
    Ray {
        origin: hit.point + step,
        dir,
    }
}

/// Follows `ray`, coming from outside, through the object.
///
/// - `eta` is the refractive index outside over that of the object. It is clamped to a thousandth and a thousand, far beyond
///   any matter, so that squares stay finite; numbers that are not positive and finite count as 1.
/// - `bounces` inner reflections are followed, at most [`MAX_BOUNCES`]; what is inside after the last is lost.
/// - A ray that misses goes on: one direction with weight 1. A ray without direction has none.
/// - What leaves the object is not followed any further, also where it would meet the object again.
///
/// The weights and the lost part sum to 1 within 2.5e-7.
#[must_use]
pub fn trace(target: &Target, ray: Ray, eta: f32, bounces: u32) -> Escapes {
    let eta = if eta.is_finite() && eta > 0.0 {
        eta.clamp(1e-3, 1e3)
    } else {
        1.0
    };
    let mut escapes = Escapes::NONE;
    let Some(mut dir) = ray.dir.try_normalize() else {
        return escapes;
    };
    let Some(mut hit) = target.cast(Ray { dir, ..ray }) else {
        escapes.push(ray.origin, dir, 1.0);
        return escapes;
    };
    // Which way the winding of this mesh points where a ray enters.
    let enters = hit.face_normal.dot(dir) < 0.0;
    let entry = bend(dir, &hit, eta);
    escapes.push(hit.point, entry.reflected, entry.reflectance);
    let Some(inside) = entry.refracted else {
        return escapes;
    };
    let mut left = 1.0 - entry.reflectance;
    dir = inside;
    for _ in 0..=bounces.min(MAX_BOUNCES) {
        let Some(next) = way_out(target, hit, dir, enters) else {
            escapes.push(hit.point, dir, left);
            return escapes;
        };
        hit = next;
        let exit = bend(dir, &hit, 1.0 / eta);
        escapes.push(
            hit.point,
            exit.refracted.unwrap_or(exit.reflected),
            left * (1.0 - exit.reflectance),
        );
        left *= exit.reflectance;
        dir = exit.reflected;
    }
    escapes.lost = left;
    escapes
}

/// Where a ray that starts inside at `hit` leaves the last of the parts it is in.
fn way_out(target: &Target, mut hit: Hit, dir: Vec3, enters: bool) -> Option<Hit> {
    let mut parts = 1;
    for _ in 0..MAX_CROSSINGS {
        hit = target.cast(onwards(target, &hit, dir))?;
        let entering = (hit.face_normal.dot(dir) < 0.0) == enters;
        parts += if entering { 1 } else { -1 };
        if parts == 0 {
            return Some(hit);
        }
    }
    None
}

/// A traced picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// As many as directions a pixel: 2 + the inner reflections.
    pub layers: u32,
    /// Layer by layer, in a layer row by row from the top: unit direction and weight. Layer 0 is the outer reflection,
    /// layer 1 + m what leaves after m inner reflections. Where the ray misses, layer 0 is the ray itself with weight 1.
    /// Unused places are zero.
    pub dirs: Vec<[f32; 4]>,
}

/// Traces every pixel of a view on all cores. `eta` and `bounces` as for [`trace`].
///
/// `stop` is asked after each row, from several threads, with the part that is done in [0, 1]; true cancels. `None` when
/// cancelled or when the picture does not fit in memory.
#[must_use]
pub fn trace_view(
    target: &Target,
    camera: &Camera,
    size_px: [u32; 2],
    eta: f32,
    bounces: u32,
    stop: &(dyn Fn(f32) -> bool + Sync),
) -> Option<Traced> {
    let [width, height] = size_px;
    let layers = 2 + bounces.min(MAX_BOUNCES);
    let pixels = (width as usize).checked_mul(height as usize)?;
    let places = pixels.checked_mul(layers as usize)?;
    let mut dirs = Vec::new();
    dirs.try_reserve_exact(places).ok()?;
    dirs.resize(places, [0.0; 4]);

    let frame = camera.ray_frame(width as f32 / height as f32);
    let planes = dirs.chunks_mut(pixels.max(1));
    let is_whole = fill_rows(planes, size_px, stop, |y, row| {
        let v = (y as f32 + 0.5) / height as f32;
        for x in 0..width as usize {
            let u = (x as f32 + 0.5) / width as f32;
            let escapes = trace(target, frame.ray((u, v)), eta, bounces);
            for (part, escape) in row.iter_mut().zip(escapes.as_slice()) {
                if let Some(place) = part.get_mut(x) {
                    *place = escape.dir.extend(escape.weight).to_array();
                }
            }
        }
    });
    is_whole.then_some(Traced {
        size: size_px,
        layers,
        dirs,
    })
}

#[cfg(test)]
mod tests;
