//! Forms of the mappings' shaders: the same WGSL with other functions for its angles, or with another lookup behind it.
//!
//! The mappings' own files in `shaders/mapping` are the same in every form. What they call for arctangents, sines and cosines
//! is another text, put in front of them by `gpu::shader`.

use serde::{Deserialize, Serialize};

use crate::math::approximation::{LEVELS, Level};

/// A form of a mapping's shader.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
pub enum ShaderForm {
    /// As near as f32: what maps are filled with, and what others are held against.
    #[serde(rename = "wgsl")]
    #[default]
    Precise,
    /// Own arctangent of degree 11.
    #[serde(rename = "wgsl-own-11")]
    Own11,
    /// Own arctangent of degree 7.
    #[serde(rename = "wgsl-own-7")]
    Own7,
    /// The language's `atan`, `atan2`, `sin`, `cos` and `tan`.
    #[serde(rename = "wgsl-built-in")]
    BuiltIn,
    /// A table in a texture.
    #[serde(rename = "wgsl-table-256")]
    Table,
    /// The texel is left to a cube sampler: of the cube map as it is, of the continuous cube map by a bent direction.
    #[serde(rename = "cube-unit")]
    CubeUnit,
}

impl ShaderForm {
    /// All of them, the nearest first.
    pub const ALL: [Self; 6] = [
        Self::Precise,
        Self::Own11,
        Self::Own7,
        Self::BuiltIn,
        Self::Table,
        Self::CubeUnit,
    ];

    /// Those that differ in their angles alone: every mapping with an arctangent has them.
    pub const OF_ANGLES: [Self; 4] = [Self::Own11, Self::Own7, Self::BuiltIn, Self::Table];

    /// Name of the evaluator on the command line.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Precise => "wgsl",
            Self::Own11 => "wgsl-own-11",
            Self::Own7 => "wgsl-own-7",
            Self::BuiltIn => "wgsl-built-in",
            Self::Table => "wgsl-table-256",
            Self::CubeUnit => "cube-unit",
        }
    }

    /// What it is.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Precise => {
                "shader, stable form, own arctangent of degree 17; the viewport's default"
            }
            Self::Own11 => "shader, own arctangent of degree 11: 1.8e-6 rad",
            Self::Own7 => "shader, own arctangent of degree 7: 8e-5 rad",
            Self::BuiltIn => {
                "shader, the language's atan, atan2, sin, cos and tan, whose errors it leaves to the adapter"
            }
            Self::Table => "shader, table of 256 steps in a texture, lines between its entries",
            Self::CubeUnit => {
                "shader that leaves the texel to the cube sampler, for which the direction is bent: hardware filtering and seams"
            }
        }
    }

    /// Where it comes from.
    pub const fn source(self) -> &'static str {
        match self {
            Self::BuiltIn => "W3C, WebGPU Shading Language, sections 15.7.4 and 17.5",
            _ => "own",
        }
    }

    /// The form of this name.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|form| form.id() == id)
    }

    /// False for the one that leaves the chart to the sampler: back from a chart point nothing is to be bent.
    pub const fn has_inverse(self) -> bool {
        !matches!(self, Self::CubeUnit)
    }

    /// About the largest error in radians that is seen on Mesa's software Vulkan, over all mappings: a scale for pictures of it.
    pub const fn usual_error_rad(self) -> f64 {
        match self {
            Self::Precise => 7e-7,
            Self::Own11 => 4e-6,
            Self::Own7 => 2e-4,
            Self::BuiltIn => 5e-6,
            Self::Table => 2e-6,
            Self::CubeUnit => 3e-7,
        }
    }

    /// The polynomials, where they are not those of [`Self::Precise`].
    pub fn level(self) -> Option<&'static Level> {
        let id = match self {
            Self::Own7 => "atan-7",
            Self::Own11 => "atan-11",
            _ => return None,
        };
        LEVELS.iter().find(|level| level.id == id)
    }
}

impl std::fmt::Display for ShaderForm {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.id())
    }
}
