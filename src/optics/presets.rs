//! Materials by name.

use super::Material;
use super::glass::Glass;
use super::material::{BallPicture, Dispersion, Surface};
use super::metal::Metal;
use super::reflectance::{Formula, Shape};

/// A name and the material it stands for.
pub type Preset = (&'static str, fn() -> Material);

/// Every named material, in the order of menus.
#[must_use]
pub const fn presets() -> &'static [Preset] {
    const PRESETS: &[Preset] = &[
        ("polished mirror", Material::default),
        ("water", || dielectric(1.333)),
        ("ice", || dielectric(1.31)),
        ("crown glass", || glass(Glass::Bk7)),
        ("flint glass", || glass(Glass::Sf10)),
        ("diamond", || glass(Glass::Diamond)),
        ("Ramires' glass", ramires),
        ("silver", || metal(Metal::Silver)),
        ("gold", || metal(Metal::Gold)),
        ("copper", || metal(Metal::Copper)),
        ("aluminium", || metal(Metal::Aluminium)),
        ("iron", || metal(Metal::Iron)),
        ("thin veil", || surface(Surface::Veil)),
        ("outline", || ball(BallPicture::Outline)),
        ("toon", || ball(BallPicture::Toon)),
        ("studio", || ball(BallPicture::Studio)),
    ];
    PRESETS
}

fn surface(surface: Surface) -> Material {
    Material {
        surface,
        ..Material::default()
    }
}

/// A body of this index at the sodium line: water 1.333 at 20 degrees (Daimon and Masumura 2007, in air), ice 1.31 (Warren and
/// Brandt 2008).
fn dielectric(index: f32) -> Material {
    Material {
        index,
        ..surface(Surface::Dielectric)
    }
}

/// A glass by its own curve.
fn glass(glass: Glass) -> Material {
    Material {
        glass,
        ..surface(Surface::Glass)
    }
}

/// The glass of Ramires' shaders: eta 0.66, power 2 in Schlick's place, and the three offsets in the right order.
fn ramires() -> Material {
    Material {
        index: 1.0 / 0.66,
        formula: Formula::Schlick,
        other_formula: Formula::Fresnel,
        shape: Shape {
            exponent: 2.0,
            power: 2.0,
            ..Shape::default()
        },
        dispersion: Dispersion::Offsets,
        ..surface(Surface::Glass)
    }
}

fn metal(metal: Metal) -> Material {
    Material {
        metal,
        ..surface(Surface::Metal)
    }
}

fn ball(ball: BallPicture) -> Material {
    Material {
        ball,
        ..surface(Surface::Ball)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_has_its_own_name_and_stays_within_the_ranges() {
        for (i, (name, material)) in presets().iter().enumerate() {
            let material = material();
            assert_eq!(material.clone().sanitized(), material, "{name}");
            for (other_name, other) in &presets()[..i] {
                assert_ne!(name, other_name);
                assert_ne!(material, other(), "{name} is {other_name}");
            }
        }
    }
}
