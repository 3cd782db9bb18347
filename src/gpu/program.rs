//! What the object's shader computes: one program for each thing that can be seen, so that nothing is computed that is not.

use std::fmt;

use crate::optics::Formula;
use crate::optics::material::{Material, Shading, Surface, Surfaces, View};
use crate::optics::wavelengths::wavelengths;

/// A program of the object; part of a pipeline's key. What is a number in the material is not part of it, so that a slider
/// compiles nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Program {
    /// The reflected direction, or the printed formula's.
    Mirror {
        /// Erratum P6.
        printed: bool,
    },
    /// The reflected vector at each vertex.
    VectorPerVertex,
    /// Chart, u and v at each vertex.
    CoordinatesPerVertex,
    /// The reflection, tinted.
    Metal,
    /// The metal's reflectance.
    MetalReflectance,
    /// Reflection and refraction by a formula.
    Dielectric(Formula),
    /// Reflection, and refraction of each wavelength.
    Glass(Formula),
    /// Reflection over the sky.
    Veil,
    /// A picture by the normal.
    Ball,
    /// The refracted light alone.
    Refraction,
    /// The refracted light of each wavelength alone.
    Spectrum,
    /// k as an intensity.
    Discriminant,
    /// A formula's reflectance.
    Reflectance(Formula),
    /// One formula less another.
    Difference(Formula, Formula),
    /// The opacity.
    Opacity,
    /// Both surfaces of the unit ball, in closed form.
    ThroughBall,
    /// The same beside one surface.
    ThroughBallDifference(Formula),
    /// Both surfaces, traced through the mesh.
    Traced,
    /// The same beside one surface.
    TracedDifference(Formula),
    /// The paths are not there, and without them there is nothing to show.
    Untraced,
}

/// How the paths through the body can be had.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paths {
    /// The body is the unit ball: in closed form.
    Ball,
    /// Traced for this view.
    Traced,
    /// Not there: one surface is shown.
    None,
}

impl Program {
    /// What shows a material.
    #[must_use]
    pub fn new(material: &Material, paths: Paths) -> Self {
        let formula = material.formula;
        let refracts = material.refracts();
        let spectral = material.surface == Surface::Glass;
        let per_pixel = Self::Mirror {
            printed: material.is_printed(),
        };
        let mirror = match material.shading {
            _ if material.surface != Surface::Mirror => per_pixel,
            Shading::PerPixel => per_pixel,
            Shading::VectorPerVertex => Self::VectorPerVertex,
            Shading::CoordinatesPerVertex => Self::CoordinatesPerVertex,
        };
        match material.view {
            View::Whole if refracts && material.surfaces == Surfaces::Both => match paths {
                Paths::Ball => Self::ThroughBall,
                Paths::Traced => Self::Traced,
                Paths::None => Self::one_surface(spectral, formula),
            },
            View::Whole => match material.surface {
                Surface::Mirror => mirror,
                Surface::Metal => Self::Metal,
                Surface::Veil => Self::Veil,
                Surface::Ball => Self::Ball,
                Surface::Dielectric | Surface::Glass => Self::one_surface(spectral, formula),
            },
            View::SurfaceDifference => match paths {
                Paths::Ball => Self::ThroughBallDifference(formula),
                Paths::Traced => Self::TracedDifference(formula),
                Paths::None => Self::Untraced,
            },
            View::Reflection => mirror,
            View::Refraction if spectral => Self::Spectrum,
            View::Refraction => Self::Refraction,
            View::Discriminant => Self::Discriminant,
            View::Reflectance if material.surface == Surface::Metal => Self::MetalReflectance,
            View::Reflectance => Self::Reflectance(formula),
            View::Difference => Self::Difference(formula, material.other_formula),
            View::Opacity => Self::Opacity,
        }
    }

    fn one_surface(spectral: bool, formula: Formula) -> Self {
        if spectral {
            Self::Glass(formula)
        } else {
            Self::Dielectric(formula)
        }
    }

    /// Its text after what every viewport has: constants and files.
    #[must_use]
    pub fn source(self) -> String {
        macro_rules! files {
            ($($name:literal)+) => {
                concat!($(include_str!(concat!("../../shaders/object/", $name, ".wgsl"))),+)
            };
        }
        const TRACED: &str = files!("through_traced" "through");
        const THROUGH_BALL: &str = files!("through_ball" "through");
        let text = match self {
            Self::Mirror { .. } => files!("per_pixel" "mirror"),
            Self::VectorPerVertex => files!("per_vertex_vector"),
            Self::CoordinatesPerVertex => files!("per_vertex_coordinates"),
            Self::Metal => files!("per_pixel" "metal"),
            Self::MetalReflectance => files!("per_pixel" "view_metal"),
            Self::Dielectric(_) => files!("per_pixel" "dielectric"),
            Self::Glass(_) => files!("per_pixel" "spectrum" "glass"),
            Self::Veil => files!("per_pixel" "opacity" "veil"),
            Self::Ball => files!("per_pixel" "ball"),
            Self::Refraction => files!("per_pixel" "view_refraction"),
            Self::Spectrum => files!("per_pixel" "spectrum" "view_spectrum"),
            Self::Discriminant => files!("per_pixel" "view_discriminant"),
            Self::Reflectance(_) => files!("per_pixel" "view_reflectance"),
            Self::Difference(..) => files!("per_pixel" "view_difference"),
            Self::Opacity => files!("per_pixel" "opacity" "view_opacity"),
            Self::Untraced => files!("per_pixel" "view_untraced"),
            Self::ThroughBall | Self::ThroughBallDifference(_) => {
                return self.constants() + files!("per_pixel") + super::shader::BALL + THROUGH_BALL;
            }
            Self::Traced | Self::TracedDifference(_) => {
                return self.constants() + files!("per_pixel") + TRACED;
            }
        };
        self.constants() + text
    }

    fn constants(self) -> String {
        let printed = self == Self::Mirror { printed: true };
        let differs = matches!(
            self,
            Self::ThroughBallDifference(_) | Self::TracedDifference(_)
        );
        let (formula, other) = match self {
            Self::Dielectric(f)
            | Self::Glass(f)
            | Self::Reflectance(f)
            | Self::ThroughBallDifference(f)
            | Self::TracedDifference(f) => (f, Formula::Fresnel),
            Self::Difference(f, other) => (f, other),
            _ => (Formula::Fresnel, Formula::Fresnel),
        };
        let [formula, other] = [formula, other].map(super::optics::formula_name);
        format!(
            "const PRINTED_REFLECTION = {printed};\nconst SHOW_DIFFERENCE = {differs};\n\
             const FORMULA = {formula};\nconst OTHER_FORMULA = {other};\n"
        )
    }

    /// True when the program follows paths through both surfaces.
    #[must_use]
    pub fn is_through(self) -> bool {
        matches!(
            self,
            Self::ThroughBall
                | Self::ThroughBallDifference(_)
                | Self::Traced
                | Self::TracedDifference(_)
        )
    }
}

/// What a pixel of the object costs, and what it does without.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Lookups of the map.
    pub reflected: u32,
    /// Lookups for refracted light.
    pub refracted: u32,
    /// Wavelengths are told apart.
    pub parts_colors: bool,
    /// The second surface is followed.
    pub goes_through: bool,
}

impl Work {
    /// Of a program with a material.
    #[must_use]
    pub fn new(program: Program, material: &Material) -> Self {
        let spectral = wavelengths(material).len() as u32;
        let through = material.bounces + 1;
        let (reflected, refracted) = match program {
            Program::Mirror { .. }
            | Program::VectorPerVertex
            | Program::CoordinatesPerVertex
            | Program::Metal => (1, 0),
            Program::Dielectric(_) => (1, 1),
            Program::Glass(_) => (1, spectral),
            // The sky behind is the second.
            Program::Veil => (1, 1),
            Program::Refraction => (0, 1),
            Program::Spectrum => (0, spectral),
            Program::ThroughBall => (1, through * spectral),
            Program::ThroughBallDifference(_) => (2, through * spectral + 1),
            Program::Traced => (1, through),
            Program::TracedDifference(_) => (2, through + 1),
            Program::Ball
            | Program::Discriminant
            | Program::Reflectance(_)
            | Program::MetalReflectance
            | Program::Difference(..)
            | Program::Opacity
            | Program::Untraced => (0, 0),
        };
        Self {
            reflected,
            refracted,
            parts_colors: spectral > 1 && !matches!(program, Program::Traced),
            goes_through: program.is_through(),
        }
    }
}

impl fmt::Display for Work {
    /// Such as `1 + 16 lookups a pixel, 2nd surface skipped` or `1 lookup a pixel, refraction skipped`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let skips = match (self.reflected, self.refracted) {
            (0, 0) => return f.write_str("no lookup"),
            (1, 0) => "refraction",
            (0, _) => "reflection",
            _ if self.goes_through && self.parts_colors => "",
            _ if self.goes_through => "dispersion",
            _ if self.parts_colors => "2nd surface",
            _ => "dispersion, 2nd surface",
        };
        match (self.reflected, self.refracted) {
            (a, 0) | (0, a) if a == 1 => f.write_str("1 lookup a pixel")?,
            (0, n) | (n, 0) => write!(f, "{n} lookups a pixel")?,
            (a, b) => write!(f, "{a} + {b} lookups a pixel")?,
        }
        if skips.is_empty() {
            return Ok(());
        }
        write!(f, ", {skips} skipped")
    }
}
