//! In which form the viewport runs the mappings' shaders.

use serde::{Deserialize, Serialize};

use super::loss::MOST_MAGNIFIED;
use crate::lab::accuracy::texel_rad;
use crate::mapping::{MappingId, ShaderForm};

/// The form of the shaders, and whether its error is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct FormState {
    /// The form; where a mapping does not have it, the precise one. Maps are always filled by the precise one.
    pub form: ShaderForm,
    /// Show how far its chart points are from the precise form's, in texels, instead of the light.
    pub difference: bool,
    /// By what the difference is multiplied to be seen, a power of two up to [`MOST_MAGNIFIED`]; `None`: by what suits it.
    pub magnification: Option<u32>,
}

impl FormState {
    /// The nearest that makes sense.
    #[must_use]
    pub fn sanitized(mut self) -> Self {
        let power = |factor: u32| 1 << factor.clamp(1, MOST_MAGNIFIED).ilog2();
        self.magnification = self.magnification.map(power);
        self
    }

    /// By what a difference in texels is multiplied, on a map with so many rows. What suits makes the form's usual error nearly white.
    #[must_use]
    pub fn factor(self, mapping: MappingId, rows: u32) -> u32 {
        let form = mapping.form_or_precise(self.form);
        let usual = || {
            let error_texels = form.usual_error_rad() / texel_rad(mapping, rows.max(1));
            let power = (1.0 / error_texels).log2().floor();
            1 << power.clamp(0.0, f64::from(MOST_MAGNIFIED.ilog2())) as u32
        };
        self.magnification.unwrap_or_else(usual)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_suits_makes_the_usual_error_nearly_white() {
        for mapping in [MappingId::Ccm, MappingId::Latlong] {
            for form in mapping.forms() {
                let state = FormState {
                    form,
                    ..FormState::default()
                };
                let error_texels = form.usual_error_rad() / texel_rad(mapping, 512);
                let shown = error_texels * f64::from(state.factor(mapping, 512));
                assert!((0.5..=1.0).contains(&shown), "{mapping} {form}: {shown}");
            }
        }
        // A mapping without the form shows its precise one.
        let state = FormState {
            form: ShaderForm::CubeUnit,
            ..FormState::default()
        };
        let precise = FormState::default();
        let eac = MappingId::Eac;
        assert_eq!(state.factor(eac, 64), precise.factor(eac, 64));
        assert_ne!(
            state.factor(MappingId::Ccm, 64),
            precise.factor(MappingId::Ccm, 64)
        );
        let wild = FormState {
            magnification: Some(7),
            ..state
        };
        assert_eq!(wild.sanitized().factor(eac, 64), 4);
    }
}
