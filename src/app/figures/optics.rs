//! The figures of optics as scenes.
//!
//! R: Ramires, *Cube Mapping and GLSL*; its figures 9, 10, 12, 13, 14 and 15 are renderings, drawn anew here. Beside them stand
//! the faults of its lines, made to be seen, and what none of the articles shows.

use crate::app::arrangement::Pane;
use crate::app::state::{AppState, DENSITY_RANGE};
use crate::mapping::MappingId;
use crate::optics::material::{Dispersion, Material, Shading, Surface, Surfaces, View};
use crate::optics::reflectance::Shape;
use crate::optics::{Formula, glass::Glass};
use crate::scene::{Camera, Object};

/// A scene with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Optics {
    /// A sphere that mirrors.
    Reflection,
    /// Constant opacity, and opacity by 1 - cos.
    Transparency,
    /// Reflection and refraction, each alone.
    ReflectionRefraction,
    /// k as an intensity.
    Discriminant,
    /// Both, mixed by Schlick's approximation.
    Mixed,
    /// Chromatic dispersion by three offsets.
    Dispersion,
    /// The printed mix beside the right one (R2).
    PrintedMix,
    /// The printed sign beside the right one (R1).
    PrintedSign,
    /// Blue bent least, as printed, beside blue bent most (R5).
    PrintedDispersion,
    /// The incident vector's sign (P6).
    PrintedReflection,
    /// Schlick less Fresnel.
    SchlickError,
    /// One surface beside both.
    BothSurfaces,
    /// Diamond: total reflection within.
    Diamond,
    /// Coordinates and face at each vertex beside each pixel.
    PerVertex,
    /// An outline by the normal, beside toon.
    Outline,
}

impl Optics {
    /// Every figure, in the order of the menu.
    pub const ALL: [Self; 15] = [
        Self::Reflection,
        Self::Transparency,
        Self::ReflectionRefraction,
        Self::Discriminant,
        Self::Mixed,
        Self::Dispersion,
        Self::PrintedMix,
        Self::PrintedSign,
        Self::PrintedDispersion,
        Self::PrintedReflection,
        Self::SchlickError,
        Self::BothSurfaces,
        Self::Diamond,
        Self::PerVertex,
        Self::Outline,
    ];

    /// The name on the command line.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Reflection => "notes-9",
            Self::Transparency => "notes-10",
            Self::ReflectionRefraction => "notes-12",
            Self::Discriminant => "notes-13",
            Self::Mixed => "notes-14",
            Self::Dispersion => "notes-15",
            Self::PrintedMix => "fault-r2",
            Self::PrintedSign => "fault-r1",
            Self::PrintedDispersion => "fault-r5",
            Self::PrintedReflection => "fault-p6",
            Self::SchlickError => "schlick-error",
            Self::BothSurfaces => "both-surfaces",
            Self::Diamond => "diamond",
            Self::PerVertex => "per-vertex",
            Self::Outline => "outline",
        }
    }

    /// What the menu says.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Reflection => "Notes, Figure 9: reflection",
            Self::Transparency => "Notes, Figure 10: opacity, constant | by angle",
            Self::ReflectionRefraction => "Notes, Figure 12: reflection | refraction",
            Self::Discriminant => "Notes, Figure 13: k",
            Self::Mixed => "Notes, Figure 14: reflection and refraction",
            Self::Dispersion => "Notes, Figure 15: chromatic dispersion | its refraction",
            Self::PrintedMix => "Fault R2: the constant mix | by Schlick",
            Self::PrintedSign => "Fault R1: 1 + cos | 1 − cos",
            Self::PrintedDispersion => "Fault R5: blue bent least | bent most",
            Self::PrintedReflection => "Fault P6: the sign of the incident vector",
            Self::SchlickError => "Schlick less Fresnel, 10×",
            Self::BothSurfaces => "Glass ball: one surface | both",
            Self::Diamond => "Diamond ball: both surfaces, 16 wavelengths",
            Self::PerVertex => "u, v and face per vertex | per pixel",
            Self::Outline => "Sphere-map style: outline",
        }
    }

    /// Turns a state into the figure; environment, light and panels stay as they are, and the mapping too, but for the figure of the
    /// faces at each vertex, which needs faces.
    pub fn show(self, state: &mut AppState) {
        let dielectric = Material {
            surface: Surface::Dielectric,
            // The notes' shaders: power 2 where Eq. 5 says 5.
            formula: Formula::Schlick,
            shape: Shape {
                exponent: 2.0,
                ..Shape::default()
            },
            ..Material::default()
        };
        let glass = Material {
            surface: Surface::Glass,
            dispersion: Dispersion::Offsets,
            formula: Formula::Cg,
            ..dielectric.clone()
        };
        let looked_at = |view| Material {
            view,
            ..dielectric.clone()
        };
        let mirror = Material::default();
        let veil = |opacity_by_angle| Material {
            surface: Surface::Veil,
            opacity_by_angle,
            ..Material::default()
        };
        let (object, material, right) = match self {
            Self::Reflection => (Object::Sphere, mirror, None),
            Self::Transparency => (Object::Teapot, veil(false), Some(veil(true))),
            Self::ReflectionRefraction => (
                Object::Teapot,
                looked_at(View::Reflection),
                Some(looked_at(View::Refraction)),
            ),
            Self::Discriminant => (Object::Teapot, looked_at(View::Discriminant), None),
            Self::Mixed => (Object::Teapot, dielectric, None),
            Self::Dispersion => {
                // Most of the light is reflected: the fringes are seen in the refracted light alone.
                let refracted = Material {
                    view: View::Refraction,
                    ..glass.clone()
                };
                (Object::Teapot, glass, Some(refracted))
            }
            Self::PrintedMix => {
                let printed = Material {
                    formula: Formula::PrintedMix,
                    ..dielectric.clone()
                };
                (Object::Teapot, printed, Some(dielectric))
            }
            Self::PrintedSign => {
                let printed = Material {
                    formula: Formula::PrintedSign,
                    ..looked_at(View::Reflectance)
                };
                (Object::Sphere, printed, Some(looked_at(View::Reflectance)))
            }
            Self::PrintedDispersion => {
                let glass = Material {
                    view: View::Refraction,
                    ..glass
                };
                let printed = Material {
                    dispersion: Dispersion::PrintedOffsets,
                    ..glass.clone()
                };
                (Object::Sphere, printed, Some(glass))
            }
            Self::PrintedReflection => {
                let printed = Material {
                    printed_reflection: true,
                    ..mirror.clone()
                };
                (Object::Sphere, printed, Some(mirror))
            }
            Self::SchlickError => {
                let difference = Material {
                    view: View::Difference,
                    formula: Formula::Schlick,
                    other_formula: Formula::Fresnel,
                    magnification: 10.0,
                    surface: Surface::Dielectric,
                    ..Material::default()
                };
                (Object::Sphere, difference, None)
            }
            Self::BothSurfaces => {
                let one = Material {
                    surface: Surface::Dielectric,
                    ..Material::default()
                };
                let both = Material {
                    surfaces: Surfaces::Both,
                    ..one.clone()
                };
                (Object::Sphere, one, Some(both))
            }
            Self::Diamond => {
                let diamond = Material {
                    surface: Surface::Glass,
                    glass: Glass::Diamond,
                    surfaces: Surfaces::Both,
                    bounces: 3,
                    ..Material::default()
                };
                (Object::Sphere, diamond, None)
            }
            Self::PerVertex => {
                let per_vertex = Material {
                    shading: Shading::CoordinatesPerVertex,
                    ..mirror.clone()
                };
                (Object::Sphere, per_vertex, Some(mirror))
            }
            Self::Outline => {
                let ball = Material {
                    surface: Surface::Ball,
                    ..Material::default()
                };
                (Object::Teapot, ball, None)
            }
        };
        state.object = object;
        state.model = None;
        state.density = DENSITY_RANGE.1;
        if self == Self::PerVertex {
            state.density = 5;
            state.mapping = MappingId::Ccm;
        }
        state.camera = Camera {
            // Towards the bright yard behind dark ground: edges on which colours part.
            yaw_rad: 0.0,
            pitch_rad: 0.12,
            // The teapot is flatter than the ball that holds it.
            distance: if object == Object::Teapot { 2.3 } else { 3.2 },
            ..Camera::default()
        };
        state.material = material;
        state.compare = None;
        state.compare_material = right;
        state.divider = 0.5;
        state.eye_ray = None;
        // The viewport is what there is to see.
        state.maximised = state.maximised.filter(|pane| *pane == Pane::Viewport);
    }
}
