//! Light to display values: exposure, tone curve, sRGB. Twin of `shaders/color.wgsl`.

use serde::{Deserialize, Serialize};

use crate::imaging::srgb::srgb_from_linear;

/// How light beyond what a screen can show is brought into its range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToneCurve {
    /// None: what is above 1 is clipped.
    Linear,
    /// x (1 + x/w^2)/(1 + x), w = 8: never clips below w. Reinhard et al., Photographic tone reproduction for digital
    /// images (2002), equation 4, for each channel.
    Reinhard,
    /// x^a/(b x^a + c) with a = 5/4: a power for contrast and a shoulder, after Lottes, Advanced techniques and optimization of HDR
    /// color pipelines (GDC 2016). b and c follow from two points: middle grey stays, 16 becomes 1.
    #[default]
    Filmic,
}

/// The light that [`ToneCurve::Reinhard`] shows as 1: three stops above a white sheet.
const REINHARD_WHITE: f32 = 8.0;
/// The light that [`ToneCurve::Filmic`] shows as 1: four stops above a white sheet.
const FILMIC_WHITE: f32 = 16.0;
/// The light that [`ToneCurve::Filmic`] leaves as it is.
const FILMIC_GREY: f32 = 0.18;

/// x^(5/4): film has exponents from 1.2 to 1.6, and this one takes two square roots.
fn filmic_power(x: f32) -> f32 {
    x * x.sqrt().sqrt()
}

/// b and c of [`ToneCurve::Filmic`]. With g = grey^a and w = white^a the two points say b g + c = g/grey and
/// b w + c = w; their difference gives b.
fn filmic_shoulder() -> (f32, f32) {
    let grey = filmic_power(FILMIC_GREY);
    let white = filmic_power(FILMIC_WHITE);
    let scale = (white - grey / FILMIC_GREY) / (white - grey);
    (scale, white * (1.0 - scale))
}

impl ToneCurve {
    /// Every curve, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Linear, Self::Reinhard, Self::Filmic];

    /// Name for people.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "Linear",
            Self::Reinhard => "Reinhard",
            Self::Filmic => "Filmic",
        }
    }

    /// The value for light `x`, both linear; what is above 1 will be clipped.
    #[must_use]
    pub fn apply(self, x: f32) -> f32 {
        let x = x.max(0.0);
        match self {
            Self::Linear => x,
            Self::Reinhard => x * (1.0 + x / (REINHARD_WHITE * REINHARD_WHITE)) / (1.0 + x),
            Self::Filmic => {
                let (scale, offset) = filmic_shoulder();
                let power = filmic_power(x.min(FILMIC_WHITE));
                power / (power * scale + offset)
            }
        }
    }

    /// sRGB values in [0, 1] of linear light under an exposure in stops.
    #[must_use]
    pub fn display(self, light: [f32; 3], exposure_ev: f32) -> [f32; 3] {
        light.map(|x| srgb_from_linear(self.apply(x * exposure_ev.exp2())))
    }

    /// The curve's number in shaders.
    pub(super) const fn index(self) -> u32 {
        match self {
            Self::Linear => 0,
            Self::Reinhard => 1,
            Self::Filmic => 2,
        }
    }
}

/// The constants in capitals of `shaders/color.wgsl`.
pub(super) fn wgsl_constants() -> String {
    let (scale, offset) = filmic_shoulder();
    format!(
        "const TONE_REINHARD: u32 = {}u;\nconst TONE_FILMIC: u32 = {}u;\n\
         const REINHARD_WHITE: f32 = {REINHARD_WHITE:?};\nconst FILMIC_WHITE: f32 = {FILMIC_WHITE:?};\nconst FILMIC_SCALE: f32 = {scale:?};\n\
         const FILMIC_OFFSET: f32 = {offset:?};\n",
        ToneCurve::Reinhard.index(),
        ToneCurve::Filmic.index(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_rise_and_keep_their_points() {
        for curve in ToneCurve::ALL {
            assert_eq!(curve.apply(-1.0), 0.0);
            let values: Vec<f32> = (0..400).map(|i| curve.apply(i as f32 * 0.04)).collect();
            assert!(values.is_sorted() && values[399] > values[0], "{curve:?}");
        }
        let near = |a: f32, b: f32| (a - b).abs() < 1e-5;
        assert!(near(ToneCurve::Filmic.apply(FILMIC_GREY), FILMIC_GREY));
        assert!(near(ToneCurve::Filmic.apply(FILMIC_WHITE), 1.0));
        assert!(near(ToneCurve::Reinhard.apply(REINHARD_WHITE), 1.0));
        assert!(!near(ToneCurve::Filmic.apply(0.5), 0.5), "control");
    }

    #[test]
    fn display_values_are_srgb() {
        let grey = ToneCurve::Linear.display([0.214_041_14, 0.0, 4.0], 0.0);
        assert!((grey[0] - 0.5).abs() < 1e-5 && grey[1] == 0.0 && grey[2] > 0.999_99);
        let doubled = ToneCurve::Linear.display([0.107_020_57; 3], 1.0);
        assert!((doubled[0] - 0.5).abs() < 1e-5, "one stop doubles light");
    }
}
