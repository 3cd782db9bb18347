//! What happens to a ray before it looks up the map: reflection, refraction, how much of each, and materials.
//!
//! Every function is generic over the number trait ([`Real`](crate::math::Real)); `shaders/optics.wgsl` is the twin of
//! `reflection`, `refraction` and `reflectance`, `shaders/ball.wgsl` that of `ball`. Directions are unit vectors in the world
//! frame; `incident` runs towards the surface, `reflected` and `refracted` away from it, `normal` may point to either side and
//! is turned to face the incident ray.
//! `eta` is n1/n2: the refractive index on the side that the ray comes from over the index on the other side.

pub mod ball;
pub mod glass;
pub mod material;
pub mod metal;
pub mod presets;
pub mod reflectance;
pub mod reflection;
pub mod refraction;
pub mod spectrum;
pub mod wavelengths;

pub use material::Material;
pub use reflectance::Formula;
pub use reflection::reflect;
pub use refraction::{Meeting, critical_angle_rad, meet, refract};
pub use wavelengths::{Wavelength, wavelengths};
