//! The wavelengths that a material is computed with.

use super::Material;
use super::material::{Dispersion, Surface};
use super::spectrum::lines;

/// One refracted ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wavelength {
    /// Weights on linear sRGB red, green and blue.
    pub rgb: [f32; 3],
    /// n1/n2 of a ray from outside.
    pub eta: f32,
    /// In micrometres.
    pub wavelength_um: f32,
}

/// The wavelengths of a material, from the longest.
#[must_use]
pub fn wavelengths(material: &Material) -> Vec<Wavelength> {
    let one = |rgb, eta, wavelength_um| Wavelength {
        rgb,
        eta,
        wavelength_um,
    };
    if material.surface != Surface::Glass {
        return vec![one([1.0; 3], material.eta(), 0.589_3)];
    }
    let eta = material.eta();
    let offsets = match material.dispersion {
        Dispersion::Spectral => {
            let line = |line: super::spectrum::Line| {
                one(
                    line.rgb.map(|c| c as f32),
                    (1.0 / material.glass.index(line.wavelength_um)) as f32,
                    line.wavelength_um as f32,
                )
            };
            return lines(material.wavelengths).into_iter().map(line).collect();
        }
        Dispersion::Offsets => [0.02, 0.01, 0.0],
        Dispersion::PrintedOffsets => [0.0, 0.01, 0.02],
    };
    vec![
        one([1.0, 0.0, 0.0], eta + offsets[0], 0.65),
        one([0.0, 1.0, 0.0], eta + offsets[1], 0.55),
        one([0.0, 0.0, 1.0], eta + offsets[2], 0.45),
    ]
}
