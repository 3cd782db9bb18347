//! Metals by their complex index of refraction.
//!
//! Silver, gold and copper: P. B. Johnson and R. W. Christy, "Optical constants of the noble metals", Phys. Rev. B 6,
//! 4370-4379 (1972). Iron: the same, "Optical constants of transition metals", Phys. Rev. B 9, 5056-5070 (1974). Aluminium:
//! A. D. Rakic, "Algorithm for the determination of intrinsic optical constants of metal films: application to aluminum",
//! Appl. Opt. 34, 4755-4767 (1995). Of each table the rows nearest to 650, 550 and 450 nm.

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

    /// [n, k] for red, green and blue light, at the [`wavelengths_um`](Self::wavelengths_um).
    #[must_use]
    pub const fn index_rgb(self) -> [[f64; 2]; 3] {
        match self {
            Self::Silver => [[0.05, 4.483], [0.06, 3.586], [0.04, 2.657]],
            Self::Gold => [[0.14, 3.697], [0.43, 2.455], [1.38, 1.914]],
            Self::Copper => [[0.22, 3.747], [1.02, 2.577], [1.24, 2.397]],
            Self::Aluminium => [[1.5724, 7.7354], [1.0728, 6.7839], [0.6079, 5.3676]],
            Self::Iron => [[2.92, 3.10], [2.95, 2.93], [2.59, 2.77]],
        }
    }

    /// The wavelengths of [`index_rgb`](Self::index_rgb), in micrometres, red first.
    #[must_use]
    pub const fn wavelengths_um(self) -> [f64; 3] {
        match self {
            Self::Silver | Self::Gold | Self::Copper => [0.6595, 0.5486, 0.4509],
            Self::Aluminium => [0.652_25, 0.563_57, 0.442_80],
            Self::Iron => [0.659, 0.549, 0.451],
        }
    }
}
