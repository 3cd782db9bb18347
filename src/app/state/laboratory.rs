//! What the laboratory of run time against error shows, and which evaluators are used.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::lab::bench::Way;
use crate::lab::filter::{Filter, Load};
use crate::lab::inputs::Inputs;
use crate::mapping::evaluator::SINGLE;
use crate::mapping::{EvaluatorInfo, MappingId};

/// Texels that the error budget may be: from what f32 can tell apart on the finest map to what everybody sees.
pub const BUDGET_TEXELS: (f64, f64) = (1e-4, 1.0);

/// The laboratory of run time against error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct LaboratoryState {
    /// The pane is shown.
    pub open: bool,
    /// Mappings beside the one that is looked up, in the registry's order.
    pub beside: Vec<MappingId>,
    /// Which way.
    pub direction: Way,
    /// On what.
    pub inputs: Inputs,
    /// Threads.
    pub load: Load,
    /// One device with its instructions, as [`crate::lab::filter::devices`]; `None`: the widest of each.
    pub device: Option<String>,
    /// The column that sorts the table.
    pub sort: Column,
    /// The largest first.
    pub descending: bool,
    /// Measure everything, not the quick set.
    pub full: bool,
    /// Evaluators that were chosen; of a mapping that is not here it is the default one.
    pub evaluators: BTreeMap<MappingId, String>,
    /// Within the budget the cheapest evaluator is used in place of the chosen one.
    pub budget_on: bool,
    /// The error that is allowed, in texels; in [`BUDGET_TEXELS`].
    pub budget_texels: f64,
}

impl Default for LaboratoryState {
    /// Beside a mapping stand one with two arctangents and the plain cube, the floor of its family.
    fn default() -> Self {
        Self {
            open: false,
            beside: vec![MappingId::Latlong, MappingId::Cube],
            direction: Way::Forward,
            inputs: Inputs::Random,
            load: Load::One,
            device: None,
            sort: Column::Time,
            descending: false,
            full: false,
            evaluators: BTreeMap::new(),
            budget_on: false,
            budget_texels: 0.01,
        }
    }
}

impl LaboratoryState {
    /// The nearest that makes sense.
    #[must_use]
    pub fn sanitized(mut self) -> Self {
        self.beside.sort_unstable();
        self.beside.dedup();
        self.evaluators
            .retain(|map, id| id != SINGLE && map.processor(id).is_some());
        let (low, high) = BUDGET_TEXELS;
        self.budget_texels = if self.budget_texels.is_finite() {
            self.budget_texels.clamp(low, high)
        } else {
            Self::default().budget_texels
        };
        self
    }

    /// The evaluator that was chosen for a mapping.
    pub fn chosen(&self, map: MappingId) -> Option<&'static EvaluatorInfo> {
        let id = self.evaluators.get(&map).map_or(SINGLE, String::as_str);
        map.evaluator(id)
    }

    /// `map` and the mappings beside it, in the registry's order.
    pub fn maps(&self, map: MappingId) -> Vec<MappingId> {
        let is_shown = |m: &MappingId| *m == map || self.beside.contains(m);
        MappingId::ALL.iter().copied().filter(is_shown).collect()
    }

    /// What is looked at of these mappings.
    pub fn filter<'a>(&'a self, maps: &'a [MappingId]) -> Filter<'a> {
        Filter {
            maps,
            direction: self.direction,
            inputs: self.inputs,
            load: self.load,
            device: self.device.as_deref(),
        }
    }
}

/// A column of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Column {
    /// The mapping.
    Mapping,
    /// The evaluator.
    Evaluator,
    /// Device and instructions.
    Device,
    /// Nanoseconds a direction.
    Time,
    /// Times as long as a plain copy.
    Copies,
    /// Share of the reference's time.
    Reference,
    /// Largest error in radians.
    Largest,
    /// Root of the mean square error in radians.
    Rms,
    /// Largest error in texels.
    Texels,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_build_knows_is_dropped() {
        let evaluators = [
            (MappingId::Ccm, "atan-9"),
            (MappingId::Cube, "atan-9"),
            (MappingId::Eac, "abacus"),
            (MappingId::Latlong, SINGLE),
        ];
        let state = LaboratoryState {
            beside: vec![MappingId::Cube, MappingId::Latlong, MappingId::Cube],
            evaluators: evaluators.map(|(map, id)| (map, id.to_owned())).into(),
            budget_texels: f64::NAN,
            ..LaboratoryState::default()
        };
        let state = state.sanitized();
        assert_eq!(state.beside, [MappingId::Latlong, MappingId::Cube]);
        assert_eq!(state.evaluators.len(), 1);
        let chosen = |map: MappingId| state.chosen(map).map(|e| e.id);
        assert_eq!(chosen(MappingId::Ccm), Some("atan-9"));
        assert_eq!(chosen(MappingId::Eac), Some(SINGLE));
        assert_eq!(state.budget_texels, 0.01);
        assert_eq!(state.clone().sanitized(), state);
    }
}
