//! The formulas' names in WGSL.

use crate::optics::Formula;

/// The name of a formula's constant.
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

/// A constant for each formula: its place in [`Formula::ALL`].
#[must_use]
pub fn wgsl_constants() -> String {
    let line = |(place, formula): (usize, &Formula)| {
        format!("const {}: u32 = {place}u;\n", formula_name(*formula))
    };
    Formula::ALL.iter().enumerate().map(line).collect()
}
