//! Metals by their complex index of refraction.

use serde::{Deserialize, Serialize};

/// A polished metal in air.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Metal {
    /// Ag.
    Silver,
    /// Au.
    #[default]
    Gold,
    /// Cu.
    Copper,
    /// Al.
    Aluminium,
    /// Fe.
    Iron,
}

impl Metal {
    /// Every metal.
    pub const ALL: [Self; 5] = [
        Self::Silver,
        Self::Gold,
        Self::Copper,
        Self::Aluminium,
        Self::Iron,
    ];

    /// Its name in lists.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Silver => "silver",
            Self::Gold => "gold",
            Self::Copper => "copper",
            Self::Aluminium => "aluminium",
            Self::Iron => "iron",
        }
    }

    /// [n, k] for red, green and blue light.
    #[must_use]
    pub const fn index_rgb(self) -> [[f64; 2]; 3] {
        match self {
            Self::Silver => [[0.05, 4.48], [0.06, 3.59], [0.04, 2.66]],
            Self::Gold => [[0.14, 3.70], [0.43, 2.46], [1.38, 1.91]],
            Self::Copper => [[0.22, 3.75], [1.02, 2.58], [1.17, 2.36]],
            Self::Aluminium => [[1.56, 7.71], [0.96, 6.69], [0.63, 5.45]],
            Self::Iron => [[2.87, 3.36], [2.95, 2.93], [2.65, 2.81]],
        }
    }
}
