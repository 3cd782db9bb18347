//! Transparent bodies by their index of refraction at each wavelength.

use serde::{Deserialize, Serialize};

/// A transparent body in air.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Glass {
    /// Schott N-BK7, a crown glass.
    #[default]
    Bk7,
    /// Schott SF10, a flint glass.
    Sf10,
    /// Water at 20 degrees Celsius.
    Water,
    /// Diamond.
    Diamond,
}

impl Glass {
    /// Every glass.
    pub const ALL: [Self; 4] = [Self::Bk7, Self::Sf10, Self::Water, Self::Diamond];

    /// Its name in lists.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Bk7 => "crown glass BK7",
            Self::Sf10 => "flint glass SF10",
            Self::Water => "water",
            Self::Diamond => "diamond",
        }
    }

    /// The index of refraction over that of air at a wavelength in micrometres. Beyond the ends of the visible
    /// range, 0.38 and 0.78, it stays what it is there.
    #[must_use]
    pub fn index(self, wavelength_um: f64) -> f64 {
        let (shortest, longest) = VISIBLE_UM;
        // `max` and `min` take the other number for NaN, `clamp` does not.
        let wavelength_um = wavelength_um.max(shortest).min(longest);
        let l2 = wavelength_um * wavelength_um;
        let sum: f64 = self
            .sellmeier()
            .iter()
            .map(|(b, c)| b * l2 / (l2 - c))
            .sum();
        (1.0 + sum).sqrt() / self.measured_against()
    }

    /// Abbe's number: (n - 1) at the helium line d over the difference of n between the hydrogen lines F and C. Small where
    /// colours part widely.
    #[must_use]
    pub fn abbe_number(self) -> f64 {
        let spread = self.index(FRAUNHOFER_F_UM) - self.index(FRAUNHOFER_C_UM);
        (self.index(FRAUNHOFER_D_UM) - 1.0) / spread
    }

    /// The index of air over that of what the terms were measured against.
    const fn measured_against(self) -> f64 {
        match self {
            Self::Bk7 | Self::Sf10 | Self::Diamond => 1.0,
            // Vacuum; air at 20 degrees is 1.000272 in the middle of the visible range and 3e-6 about it (Ciddor, "Refractive
            // index of air", Appl. Opt. 35, 1566-1573 (1996)).
            Self::Water => 1.000_272,
        }
    }

    /// The terms (B, C) of Sellmeier's n^2 = 1 + sum of B l^2 / (l^2 - C), l and the root of C in micrometres.
    const fn sellmeier(self) -> &'static [(f64, f64)] {
        match self {
            // Schott's data sheet, optical glass catalogue of 2017.
            Self::Bk7 => &[
                (1.039_612_12, 0.006_000_698_67),
                (0.231_792_344, 0.020_017_914_4),
                (1.010_469_45, 103.560_653),
            ],
            // The same.
            Self::Sf10 => &[
                (1.616_259_77, 0.012_753_455_9),
                (0.259_229_334, 0.058_198_395_4),
                (1.077_623_17, 116.607_68),
            ],
            // M. Daimon and A. Masumura, "Measurement of the refractive index of distilled water from the near-infrared
            // region to the ultraviolet region", Appl. Opt. 46, 3811-3820 (2007).
            Self::Water => &[
                (0.568_402_756_5, 0.005_101_829_712),
                (0.172_617_739_1, 0.018_211_539_36),
                (0.020_861_895_78, 0.026_207_222_93),
                (0.113_074_868_8, 10.697_927_21),
            ],
            // F. Peter, "Über Brechungsindizes und Absorptionskonstanten des Diamanten zwischen 644 und 226 mμ", Z. Phys.
            // 15, 358-368 (1923); the two resonances lie at 0.175 and 0.106.
            Self::Diamond => &[(0.3306, 0.175 * 0.175), (4.3356, 0.106 * 0.106)],
        }
    }
}

/// The shortest and the longest wavelength of [`Glass::index`], in micrometres.
pub const VISIBLE_UM: (f64, f64) = (0.38, 0.78);
/// Wavelength of the sodium line D in micrometres, at which indices are quoted as n_D (the mean of its two lines).
pub const SODIUM_UM: f64 = 0.5893;
/// The yellow line of helium, in micrometres; indices with a "d" are taken here.
pub const FRAUNHOFER_D_UM: f64 = 0.587_561_8;
/// The blue line of hydrogen, in micrometres.
pub const FRAUNHOFER_F_UM: f64 = 0.486_132_7;
/// The red line of hydrogen, in micrometres.
pub const FRAUNHOFER_C_UM: f64 = 0.656_272_5;
