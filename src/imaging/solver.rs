//! Which face is which: six pictures put together by their edges.

use crate::imaging::{MapShape, Raster};
use crate::mapping::Arrangement;

/// What was found about six pictures.
#[derive(Clone, Debug)]
pub struct Solution {
    /// What each picture is, of all that fit alike the one that changes the fewest pictures.
    pub arrangement: Arrangement,
    /// The same seen in a mirror, which fits as well: seams cannot tell them apart.
    pub mirrored: Arrangement,
    /// How well the pictures meet so: 1 as smoothly as inside.
    pub score: Option<f64>,
    /// How well they meet as they are labelled.
    pub as_labelled: Option<f64>,
    /// How many times worse the next best meets, where the two differ.
    pub margin: f64,
    /// Whether the next best is clearly worse.
    pub is_certain: bool,
}

/// A language for shader code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShaderLanguage {
    /// WebGPU's.
    Wgsl,
    /// OpenGL's and Vulkan's.
    Glsl,
}

impl Solution {
    /// The answer in one sentence.
    pub fn sentence(&self) -> String {
        String::new()
    }

    /// The answer as an option of `sixfold convert`.
    pub fn option(&self) -> String {
        format!("--arrange \"{}\"", self.arrangement)
    }
}

/// A shader function that turns a direction in the world into the one with which to look up the unchanged pictures.
pub fn lookup_code(arrangement: &Arrangement, language: ShaderLanguage) -> String {
    let _ = (arrangement, language);
    String::new()
}

/// Puts the six pictures of a map together: each may be any face, turned and mirrored in any way. `None` for a map that has
/// not six square charts.
pub fn solve(shape: &MapShape, rasters: &[Raster]) -> Option<Solution> {
    let _ = (shape, rasters);
    None
}
