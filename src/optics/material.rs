//! Materials as plain data: what the object is made of, and what of its optics is looked at.

use serde::{Deserialize, Serialize};

use super::ball::MAX_BOUNCES;
use super::glass::{Glass, SODIUM_UM};
use super::metal::Metal;
use super::reflectance::{Formula, Shape};
use super::reflection::{reflect, reflect_as_printed};
use super::refraction::refract;
use crate::math::{Real, Vec3};

/// What the surface does with light.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Surface {
    /// Reflects all: one lookup.
    #[default]
    Mirror,
    /// Reflects and refracts, alike for all colours: two lookups.
    Dielectric,
    /// Reflects, tinted by the metal's reflectance: one lookup.
    Metal,
    /// Reflects, and refracts each wavelength its own way: one lookup and one for each wavelength.
    Glass,
    /// Reflects, and lets the sky shine through unbent: two lookups.
    Veil,
    /// Shows a picture of a lit ball, by the normal: no lookup of the environment.
    Ball,
}

impl Surface {
    /// Every kind, in the order of menus.
    pub const ALL: [Self; 6] = [
        Self::Mirror,
        Self::Dielectric,
        Self::Metal,
        Self::Glass,
        Self::Veil,
        Self::Ball,
    ];

    /// Its name in lists.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mirror => "mirror",
            Self::Dielectric => "dielectric",
            Self::Metal => "metal",
            Self::Glass => "glass with dispersion",
            Self::Veil => "transparent mirror",
            Self::Ball => "sphere-map style",
        }
    }
}

/// What is looked at.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum View {
    /// The whole material.
    #[default]
    Whole,
    /// The reflected light alone.
    Reflection,
    /// The refracted light alone; total internal reflection is marked.
    Refraction,
    /// k as an intensity (Ramires, Figure 13); below zero it is marked.
    Discriminant,
    /// The reflectance by the material's formula.
    Reflectance,
    /// The material's formula less the other one, magnified.
    Difference,
    /// The opacity of the transparent mirror.
    Opacity,
    /// What both surfaces do less what one does, magnified.
    SurfaceDifference,
}

impl View {
    /// Every view, in the order of menus.
    pub const ALL: [Self; 8] = [
        Self::Whole,
        Self::Reflection,
        Self::Refraction,
        Self::Discriminant,
        Self::Reflectance,
        Self::Difference,
        Self::Opacity,
        Self::SurfaceDifference,
    ];

    /// Its name in lists.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whole => "the whole material",
            Self::Reflection => "reflection alone",
            Self::Refraction => "refraction alone",
            Self::Discriminant => "k as an intensity",
            Self::Reflectance => "reflectance",
            Self::Difference => "difference of two formulas",
            Self::Opacity => "opacity",
            Self::SurfaceDifference => "both surfaces less one",
        }
    }
}

/// How many surfaces the refracted ray passes.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Surfaces {
    /// The first only, as in Ramires' shaders: the ray inside the body looks up the map.
    #[default]
    One,
    /// In, inner reflections, and out again.
    Both,
}

/// How the index of refraction follows the wavelength.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Dispersion {
    /// The glass's own curve at [`Material::wavelengths`] wavelengths.
    #[default]
    Spectral,
    /// Ramires' three offsets on eta in the right order: red eta + 0.02, green eta + 0.01, blue eta.
    Offsets,
    /// As printed: red eta, green eta + 0.01, blue eta + 0.02; blue is bent least (erratum R5).
    PrintedOffsets,
}

impl Dispersion {
    /// Every form.
    pub const ALL: [Self; 3] = [Self::Spectral, Self::Offsets, Self::PrintedOffsets];

    /// Its name in lists.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spectral => "spectrum of the glass",
            Self::Offsets => "three offsets",
            Self::PrintedOffsets => "as printed: blue bent least (R5)",
        }
    }
}

/// Where the lookup of a mirror is computed.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Shading {
    /// Reflected and looked up at each pixel.
    #[default]
    PerPixel,
    /// The reflected vector at each vertex, interpolated; looked up at each pixel.
    VectorPerVertex,
    /// Chart, u and v at each vertex, interpolated, as the automatic generation of coordinates did; the chart of the
    /// triangle's first vertex.
    CoordinatesPerVertex,
}

impl Shading {
    /// Every way.
    pub const ALL: [Self; 3] = [
        Self::PerPixel,
        Self::VectorPerVertex,
        Self::CoordinatesPerVertex,
    ];

    /// Its name in lists.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::PerPixel => "per pixel",
            Self::VectorPerVertex => "vector per vertex",
            Self::CoordinatesPerVertex => "u, v and face per vertex",
        }
    }
}

/// A picture of a lit ball that is looked up by the normal.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BallPicture {
    /// Light with a dark rim: an outline.
    #[default]
    Outline,
    /// Three flat tones and an outline.
    Toon,
    /// The soft boxes of a studio.
    Studio,
    /// A picture from a file.
    File(std::path::PathBuf),
}

/// What the object is made of. Every parameter is kept when the kind changes, so that one can go back.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Material {
    /// What the surface does.
    pub surface: Surface,
    /// What is looked at.
    pub view: View,
    /// Index of refraction of the body over that of its surroundings, n2/n1, in [`INDEX_RANGE`]; used by
    /// [`Surface::Dielectric`] and by the offsets of [`Surface::Glass`].
    pub index: f32,
    /// How much is reflected.
    pub formula: Formula,
    /// The other formula of [`View::Difference`].
    pub other_formula: Formula,
    /// The numbers of the approximations.
    pub shape: Shape<f32>,
    /// Which metal.
    pub metal: Metal,
    /// Which glass.
    pub glass: Glass,
    /// How the colours part.
    pub dispersion: Dispersion,
    /// Number of wavelengths of [`Dispersion::Spectral`], in [`WAVELENGTHS_RANGE`].
    pub wavelengths: u32,
    /// One surface or both.
    pub surfaces: Surfaces,
    /// Inner reflections that are followed, 0 to [`MOST_BOUNCES`]; the rest of the light is lost.
    pub bounces: u32,
    /// Opacity of the transparent mirror, in [0, 1].
    pub opacity: f32,
    /// The opacity is 1 - cos instead.
    pub opacity_by_angle: bool,
    /// Where a mirror's lookup is computed.
    pub shading: Shading,
    /// The mirror uses Grimm and Niebruegge's formula with the incident vector of everybody else (erratum P6).
    pub printed_reflection: bool,
    /// The picture of [`Surface::Ball`].
    pub ball: BallPicture,
    /// Factor on differences before they are shown, in [`MAGNIFICATION_RANGE`].
    pub magnification: f32,
}

/// Indices of refraction, n2/n1: eta from 3 to 0.3.
pub const INDEX_RANGE: (f32, f32) = (0.334, 3.33);
/// Exponents and powers of the approximations. Below 1 a curve would be infinitely steep at its end, where f32 loses it.
pub const POWER_RANGE: (f32, f32) = (1.0, 16.0);
/// Numbers of wavelengths.
pub const WAVELENGTHS_RANGE: (u32, u32) = (1, 64);
/// Most inner reflections.
pub const MOST_BOUNCES: u32 = 6;
const _: () = assert!(MOST_BOUNCES <= MAX_BOUNCES, "more than are followed");
/// Factors on differences.
pub const MAGNIFICATION_RANGE: (f32, f32) = (1.0, 1000.0);

impl Default for Material {
    fn default() -> Self {
        Self {
            surface: Surface::Mirror,
            view: View::Whole,
            // Ramires' eta = 0.66.
            index: 1.0 / 0.66,
            formula: Formula::Fresnel,
            other_formula: Formula::Schlick,
            shape: Shape::default(),
            metal: Metal::Gold,
            glass: Glass::Bk7,
            dispersion: Dispersion::Spectral,
            wavelengths: 16,
            surfaces: Surfaces::One,
            bounces: 2,
            opacity: 0.5,
            opacity_by_angle: true,
            shading: Shading::PerPixel,
            printed_reflection: false,
            ball: BallPicture::Outline,
            magnification: 4.0,
        }
    }
}

impl Material {
    /// The nearest material that makes sense: a file may hold any number.
    #[must_use]
    pub fn sanitized(mut self) -> Self {
        let or = Self::default();
        let within = |x: f32, or: f32, (low, high): (f32, f32)| {
            if x.is_finite() {
                x.clamp(low, high)
            } else {
                or
            }
        };
        self.index = within(self.index, or.index, INDEX_RANGE);
        self.opacity = within(self.opacity, or.opacity, (0.0, 1.0));
        self.magnification = within(self.magnification, or.magnification, MAGNIFICATION_RANGE);
        self.shape.exponent = within(self.shape.exponent, 5.0, POWER_RANGE);
        self.shape.power = within(self.shape.power, 2.0, POWER_RANGE);
        self.shape.bias = within(self.shape.bias, 0.3, (0.0, 1.0));
        self.shape.scale = within(self.shape.scale, 2.0, (0.0, 4.0));
        let (low, high) = WAVELENGTHS_RANGE;
        self.wavelengths = self.wavelengths.clamp(low, high);
        self.bounces = self.bounces.min(MOST_BOUNCES);
        self
    }

    /// n1/n2 for a ray that comes from outside; of a glass with its own spectrum at the sodium line.
    #[must_use]
    pub fn eta(&self) -> f32 {
        if self.surface == Surface::Glass && self.dispersion == Dispersion::Spectral {
            (1.0 / self.glass.index(SODIUM_UM)) as f32
        } else {
            1.0 / self.index
        }
    }

    /// The direction in which the map is asked at a point of the surface, where the view asks in several the first one:
    /// refracted for the refracted light alone, else mirrored. All unit.
    #[must_use]
    pub fn looked_up<R: Real>(&self, incident: Vec3<R>, normal: Vec3<R>) -> Vec3<R> {
        if self.view == View::Refraction {
            let eta = R::from_f64(f64::from(self.eta()));
            if let Some(refracted) = refract(incident, normal, eta) {
                return refracted;
            }
        }
        if self.is_printed() {
            reflect_as_printed(incident, normal)
        } else {
            reflect(incident, normal)
        }
    }

    /// True when the paper's sign is what is seen.
    #[must_use]
    pub fn is_printed(&self) -> bool {
        self.printed_reflection
            && self.surface == Surface::Mirror
            && self.shading == Shading::PerPixel
            && matches!(self.view, View::Whole | View::Reflection)
    }

    /// True when light goes into the body.
    #[must_use]
    pub fn refracts(&self) -> bool {
        matches!(self.surface, Surface::Dielectric | Surface::Glass)
    }

    /// What it is in a few words, for a label beside a picture of it.
    #[must_use]
    pub fn title(&self) -> String {
        let formula = self.formula.name();
        let refracts = self.refracts();
        match self.view {
            View::Whole => match self.surface {
                Surface::Mirror if self.is_printed() => "mirror, the paper's sign".to_owned(),
                Surface::Mirror if self.shading != Shading::PerPixel => {
                    format!("mirror, {}", self.shading.name())
                }
                Surface::Metal => self.metal.name().to_owned(),
                Surface::Veil if self.opacity_by_angle => "opacity 1 − cos".to_owned(),
                Surface::Veil => format!("opacity {:.2}", self.opacity),
                _ if refracts && self.surfaces == Surfaces::Both => {
                    format!("{}, both surfaces", self.body_name())
                }
                _ if refracts => format!("{}, one surface, {formula}", self.body_name()),
                surface => surface.name().to_owned(),
            },
            View::Reflectance => format!("reflectance: {formula}"),
            View::SurfaceDifference => format!("{}, {}", self.body_name(), self.view.name()),
            View::Difference => format!("{formula} less {}", self.other_formula.name()),
            view => view.name().to_owned(),
        }
    }

    fn body_name(&self) -> String {
        match (self.surface, self.dispersion) {
            (Surface::Glass, Dispersion::Spectral) => self.glass.name().to_owned(),
            (Surface::Glass, dispersion) => dispersion.name().to_owned(),
            _ => format!("index {:.3}", self.index),
        }
    }

    /// True when light is followed through the body's second surface.
    #[must_use]
    pub fn is_through(&self) -> bool {
        self.view == View::SurfaceDifference
            || (self.view == View::Whole && self.refracts() && self.surfaces == Surfaces::Both)
    }
}
