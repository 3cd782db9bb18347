//! Numbers: the number trait, stable angles, turns, units in the last place, dual numbers, approximations,
//! instruction sets, input points.

pub mod approximation;
mod arctan;
mod branchless;
mod double_word;
mod dual;
pub mod inputs;
mod isa;
mod library;
mod logarithm;
mod quadrature;
mod real;
mod rotation;
pub mod ulp;
mod vec3;

pub use arctan::{
    ATAN_COEFFICIENTS, COS_QUARTER_COEFFICIENTS, SIN_QUARTER_COEFFICIENTS, atan_unit, sin_cos_turns,
};
pub use branchless::{atan_turns, atan2_turns, floor_and_rest, nearest_whole, sin_cos_eighth};
pub use double_word::DoubleWord;
pub use dual::Dual;
pub use isa::Isa;
pub use library::Library;
pub use logarithm::LN_2_PARTS;
pub use quadrature::Rule;
pub use real::{Real, Textbook};
pub use rotation::{BadRotation, Rotation, Rows, turned};
pub use vec3::{Vec3, angle_rad, unit_in_plane};
