//! Which wavelengths a material's refraction looks up, and what each adds to the colour.

use super::Material;
use super::material::{Dispersion, Surface, View};
use super::spectrum::{lines, offset_etas};

/// One refracted ray of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wavelength {
    /// Weights on linear sRGB red, green and blue; they sum to 1 over all rays, so that white stays white.
    pub rgb: [f32; 3],
    /// n1/n2 for a ray that comes from outside.
    pub eta: f32,
    /// In micrometres; for the offsets, which belong to no wavelength, what a screen's red, green and blue look like.
    pub wavelength_um: f32,
}

/// Wavelengths that look like sRGB's red, green and blue: their dominant wavelengths to the nanometre (from the primaries of
/// IEC 61966-2-1).
const PRIMARIES_UM: [f32; 3] = [0.611, 0.549, 0.464];

/// The refracted rays of a material, at least one and at most 64, from short waves to long ones. One ray without colour where the
/// material does not part the colours.
#[must_use]
pub fn wavelengths(material: &Material) -> Vec<Wavelength> {
    // What the second surface adds is looked at without colours, which one surface would part alike.
    if material.surface != Surface::Glass || material.view == View::SurfaceDifference {
        return vec![Wavelength {
            rgb: [1.0; 3],
            eta: material.eta(),
            wavelength_um: PRIMARIES_UM[1],
        }];
    }
    if material.dispersion == Dispersion::Spectral {
        return lines(material.wavelengths)
            .into_iter()
            .map(|line| Wavelength {
                rgb: line.rgb.map(|weight| weight as f32),
                eta: (1.0 / material.glass.index(line.wavelength_um)) as f32,
                wavelength_um: line.wavelength_um as f32,
            })
            .collect();
    }
    let etas = offset_etas(material.eta(), material.dispersion);
    let mut rays: Vec<_> = std::iter::zip(etas, PRIMARIES_UM)
        .enumerate()
        .map(|(channel, (eta, wavelength_um))| Wavelength {
            rgb: std::array::from_fn(|c| if c == channel { 1.0 } else { 0.0 }),
            eta,
            wavelength_um,
        })
        .collect();
    rays.reverse();
    rays
}
