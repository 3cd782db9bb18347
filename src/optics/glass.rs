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

    /// The index of refraction at a wavelength in micrometres (in air), 0.38 to 0.78.
    #[must_use]
    pub fn index(self, wavelength_um: f64) -> f64 {
        let l2 = wavelength_um * wavelength_um;
        // Schott's data sheet of N-BK7; the others follow.
        let terms = [
            (1.039_612_12, 0.006_000_698_67),
            (0.231_792_344, 0.020_017_914_4),
            (1.010_469_45, 103.560_653),
        ];
        let sum: f64 = terms.iter().map(|(b, c)| b * l2 / (l2 - c)).sum();
        (1.0 + sum).sqrt()
    }
}
