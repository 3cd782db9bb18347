//! What the ranking of all mappings asks and shows.

use serde::{Deserialize, Serialize};

use crate::lab::ranking::{Basis, Criterion};
use crate::mapping::{Claims, Family, MappingId};

/// How many mappings are compared at most: more lines nobody tells apart.
pub const MOST_COMPARED: usize = 4;

/// The ranking of all mappings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RankingState {
    /// The pane is shown.
    pub open: bool,
    /// The column that sorts the table.
    pub sort: RankingColumn,
    /// The largest first.
    pub descending: bool,
    /// Only mappings of this kind are ranked.
    pub family: Option<Family>,
    /// Only mappings that keep this promise are ranked.
    pub claim: Option<Claim>,
    /// The mappings that are compared, [`MOST_COMPARED`] at most, in the order in which they were chosen.
    pub compared: Vec<MappingId>,
    /// What is drawn below the table.
    pub plot: RankingPlot,
    /// The axes of the scatter plot, across and up.
    pub axes: [Criterion; 2],
    /// What of area and shape makes the score.
    pub basis: Basis,
    /// How much shape counts, from 0 (area alone) to 1 (shape alone).
    pub weight: f64,
}

impl Default for RankingState {
    /// Area and shape count alike; compared are a cube without a formula, its best known relatives, and one that keeps angles.
    fn default() -> Self {
        Self {
            open: false,
            sort: RankingColumn::Score,
            descending: false,
            family: None,
            claim: None,
            compared: vec![MappingId::Cube, MappingId::Ccm, MappingId::Paraboloid],
            plot: RankingPlot::Weights,
            axes: [Criterion::Area, Criterion::ShapeMax],
            basis: Basis::Worst,
            weight: 0.5,
        }
    }
}

impl RankingState {
    /// The nearest that makes sense.
    #[must_use]
    pub fn sanitized(mut self) -> Self {
        let mut seen = Vec::new();
        for map in self.compared {
            if !seen.contains(&map) && seen.len() < MOST_COMPARED {
                seen.push(map);
            }
        }
        self.compared = seen;
        self.weight = if self.weight.is_finite() {
            self.weight.clamp(0.0, 1.0)
        } else {
            Self::default().weight
        };
        self
    }

    /// The mappings that are ranked, in teaching order.
    pub fn maps(&self) -> Vec<MappingId> {
        let is_ranked = |map: &MappingId| {
            let info = map.info();
            self.family.is_none_or(|family| family == info.family)
                && self.claim.is_none_or(|claim| claim.is_kept(info.claims))
        };
        MappingId::ALL.iter().copied().filter(is_ranked).collect()
    }
}

/// A promise by which mappings are picked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Claim {
    /// [`Claims::equal_area`].
    EqualArea,
    /// [`Claims::conformal`].
    Conformal,
    /// [`Claims::continuous`].
    Continuous,
}

impl Claim {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::EqualArea, Self::Conformal, Self::Continuous];

    /// Its name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::EqualArea => "equal-area",
            Self::Conformal => "conformal",
            Self::Continuous => "continuous",
        }
    }

    /// Whether a mapping promises it.
    pub const fn is_kept(self, claims: Claims) -> bool {
        match self {
            Self::EqualArea => claims.equal_area,
            Self::Conformal => claims.conformal,
            Self::Continuous => claims.continuous,
        }
    }
}

/// A column of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RankingColumn {
    /// The mapping's name.
    Mapping,
    /// Area and shape, weighed.
    Score,
    /// One criterion.
    By(Criterion),
    /// What it promises.
    Claims,
}

/// What is drawn below the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RankingPlot {
    /// Places over the weight of shape.
    Weights,
    /// Two criteria.
    Scatter,
    /// The chosen mappings over all criteria.
    Compare,
}

impl RankingPlot {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Weights, Self::Scatter, Self::Compare];

    /// Its name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Weights => "area or shape",
            Self::Scatter => "two criteria",
            Self::Compare => "compare",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_exaggerates_is_brought_back() {
        let state = RankingState {
            compared: [&MappingId::ALL[..3], &MappingId::ALL[..9]].concat(),
            weight: 7.0,
            ..RankingState::default()
        };
        let state = state.sanitized();
        assert_eq!(state.compared, MappingId::ALL[..MOST_COMPARED]);
        assert_eq!(state.weight, 1.0);
        assert_eq!(state.clone().sanitized(), state);
        let none = RankingState {
            weight: f64::NAN,
            ..state.clone()
        };
        assert_eq!(none.sanitized().weight, 0.5);
        let default = RankingState::default();
        assert_eq!(default.clone().sanitized(), default);
    }

    #[test]
    fn kinds_and_promises_pick_what_they_say() {
        let of = |family, claim| {
            let state = RankingState {
                family,
                claim,
                ..RankingState::default()
            };
            state.maps()
        };
        assert_eq!(of(None, None), MappingId::ALL);
        let cubes = of(Some(Family::Cubes), Some(Claim::EqualArea));
        assert!(cubes.contains(&MappingId::Qsc) && cubes.contains(&MappingId::Arvo));
        assert!(!cubes.contains(&MappingId::Cube) && !cubes.contains(&MappingId::Sphere));
        assert!(
            of(None, Some(Claim::EqualArea)).contains(&MappingId::Sphere),
            "control"
        );
        assert!(of(None, Some(Claim::Conformal)).contains(&MappingId::Paraboloid));
        assert!(of(Some(Family::Octahedra), Some(Claim::Conformal)).is_empty());
    }
}
