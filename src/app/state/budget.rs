//! What the pane of equal texel budgets compares.

use serde::{Deserialize, Serialize};

use super::AppState;
use crate::mapping::MappingId;

/// Texels of each of the two maps: cubes with faces of 16 x 16 to 512 x 512.
pub const COMPARED_TEXELS: (u32, u32) = (6 * 16 * 16, 6 * 512 * 512);
/// How much the magnifier enlarges.
pub const MAGNIFIERS: [u32; 4] = [2, 4, 8, 16];

/// Two mappings with as many texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct BudgetState {
    /// The pane is shown.
    pub open: bool,
    /// The mappings A and B; `None`: those of the viewport, see [`AppState::compared_maps`].
    pub maps: [Option<MappingId>; 2],
    /// Texels of each map, in [`COMPARED_TEXELS`].
    pub texels: u32,
    /// One of [`MAGNIFIERS`].
    pub magnifier: u32,
    /// The surroundings themselves are shown beside the maps.
    pub shows_surroundings: bool,
}

impl Default for BudgetState {
    /// Few enough texels that their differences are seen.
    fn default() -> Self {
        Self {
            open: false,
            maps: [None; 2],
            texels: 6 * 48 * 48,
            magnifier: 4,
            shows_surroundings: true,
        }
    }
}

impl BudgetState {
    /// The nearest that makes sense.
    #[must_use]
    pub fn sanitized(mut self) -> Self {
        self.texels = self.texels.clamp(COMPARED_TEXELS.0, COMPARED_TEXELS.1);
        let nearest = MAGNIFIERS
            .into_iter()
            .min_by_key(|factor| factor.abs_diff(self.magnifier));
        self.magnifier = nearest.unwrap_or(MAGNIFIERS[0]);
        self
    }
}

impl AppState {
    /// The mappings A and B of the equal texel budget. Where none is chosen: A is what the viewport looks up, B what it compares
    /// that with, else the cube map, or the continuous one where A is the cube map.
    pub fn compared_maps(&self) -> [MappingId; 2] {
        let [a, b] = self.budget.maps;
        let a = a.unwrap_or(self.mapping);
        let usual = [MappingId::Cube, MappingId::Ccm];
        let offered = self.compare.into_iter().chain(usual);
        let other = || offered.into_iter().find(|map| *map != a);
        [a, b.or_else(other).unwrap_or(MappingId::Cube)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_viewports_mappings_are_compared_until_others_are_chosen() {
        use MappingId::{Ccm, Cube, Eac, Latlong};
        let maps = |mapping, compare, maps| {
            AppState {
                mapping,
                compare,
                budget: BudgetState {
                    maps,
                    ..BudgetState::default()
                },
                ..AppState::default()
            }
            .compared_maps()
        };
        assert_eq!(maps(Ccm, None, [None; 2]), [Ccm, Cube]);
        assert_eq!(maps(Cube, None, [None; 2]), [Cube, Ccm]);
        assert_eq!(maps(Ccm, Some(Eac), [None; 2]), [Ccm, Eac]);
        assert_eq!(maps(Ccm, Some(Eac), [Some(Eac), None]), [Eac, Cube]);
        assert_eq!(maps(Ccm, None, [None, Some(Latlong)]), [Ccm, Latlong]);
        // A mapping beside itself is a fair question.
        assert_eq!(maps(Ccm, None, [None, Some(Ccm)]), [Ccm, Ccm]);
    }
}
