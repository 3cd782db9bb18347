//! What the shaders know of optics, written from Rust.

use std::fmt::Write;

use crate::optics::Formula;

/// The optics at one interface: twin of `optics`.
pub const OPTICS: &str = include_str!("../../shaders/optics.wgsl");

/// The numbers that stand for the formulas in `shaders/optics.wgsl`: their places in [`Formula::ALL`].
#[must_use]
pub fn wgsl_constants() -> String {
    let mut text = String::new();
    for (place, formula) in Formula::ALL.into_iter().enumerate() {
        // Writing to a string does not fail.
        let _ = writeln!(text, "const {}: u32 = {place}u;", formula_name(formula));
    }
    text
}

/// A formula's constant in the shaders.
#[must_use]
pub const fn formula_name(formula: Formula) -> &'static str {
    match formula {
        Formula::Fresnel => "FORMULA_FRESNEL",
        Formula::FresnelS => "FORMULA_FRESNEL_S",
        Formula::FresnelP => "FORMULA_FRESNEL_P",
        Formula::Schlick => "FORMULA_SCHLICK",
        Formula::Cg => "FORMULA_CG",
        Formula::Simple => "FORMULA_SIMPLE",
        Formula::PrintedSign => "FORMULA_PRINTED_SIGN",
        Formula::PrintedMix => "FORMULA_PRINTED_MIX",
    }
}
