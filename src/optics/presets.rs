//! Materials by name.

use super::Material;
use super::material::Surface;

/// Every preset: its name, and how it is made.
pub const PRESETS: &[(&str, fn() -> Material)] = &[
    ("mirror", Material::default),
    ("water", || Material {
        surface: Surface::Dielectric,
        index: 1.333,
        ..Material::default()
    }),
];
