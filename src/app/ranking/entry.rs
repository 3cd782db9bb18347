//! A mapping with what is known of it, and that in words.

use crate::app::laboratory::{cheapest_lookup, measured_text};
use crate::app::model::Model;
use crate::app::numbers::significant;
use crate::app::state::Claim;
use crate::lab::choice::Choice;
use crate::lab::metrics::{Metrics, UNBOUNDED};
use crate::lab::ranking::{Criterion, Placed, order};
use crate::mapping::{Borders, MappingId};

/// Where a number is still to come.
pub const TO_COME: &str = "…";
/// Where none is known.
pub const NONE: &str = "–";
/// How to get costs.
pub const NO_COST: &str = "Not measured on this machine: open Run time and error, choose the mapping there and press Measure. What is measured but not within the error budget there has no cost here either.";

/// The bound at a cube's corner with what is said of it.
pub struct Corner {
    /// The value that nothing smooth there is below.
    pub bound: f64,
    /// It in a word.
    pub name: String,
    /// Why there is one.
    pub reason: String,
}

/// That of a criterion, if it has one.
pub fn corner(criterion: Criterion) -> Option<Corner> {
    let bound = criterion.corner_bound()?;
    let number = value_text(criterion, bound);
    let (name, whole) = match criterion {
        Criterion::ShapeMax => ("√3".to_owned(), format!("√3 = {number}")),
        _ => (number.clone(), format!("{number}, where a/b is √3")),
    };
    let reason = format!(
        "No mapping that is smooth at a cube's corner is below {whole}: a right angle of the map is 120° there. The quadrilateralised cube is below because it is bent along the diagonals."
    );
    Some(Corner {
        bound,
        name,
        reason,
    })
}

/// A mapping with what is known of it.
#[derive(Clone, Copy, Debug)]
pub struct Entry<'a> {
    /// Which it is.
    pub map: MappingId,
    /// Its distortion, once it is measured.
    pub metrics: Option<&'a Metrics>,
    /// Its cheapest lookup within the laboratory's budget.
    pub cost: Option<Choice<'a>>,
    /// Its place by area and shape.
    pub placed: Option<Placed>,
}

/// These mappings, each with its place among them.
pub fn entries<'a>(model: &Model<'a>, maps: &[MappingId]) -> Vec<Entry<'a>> {
    let ranking = &model.state.ranking;
    let lab = &model.labs.ranking;
    let measured: Vec<&Metrics> = maps.iter().filter_map(|m| lab.of(*m)).collect();
    let places = order(&measured, ranking.basis, ranking.weight);
    let rows = model.labs.bench.rows();
    let entry = |&map: &MappingId| Entry {
        map,
        metrics: lab.of(map),
        cost: cheapest_lookup(model.state, rows, map),
        placed: places.iter().find(|placed| placed.map == map).copied(),
    };
    maps.iter().map(entry).collect()
}

impl Entry<'_> {
    /// Its value of a criterion, infinite without bound; `None` where it is not known.
    pub fn value(&self, criterion: Criterion) -> Option<f64> {
        match criterion {
            Criterion::Cost => self.cost.map(|choice| choice.row.ns),
            _ => criterion.of(self.metrics?, None),
        }
    }

    /// The value as a cell of the table; no speed without its error.
    pub fn text(&self, criterion: Criterion) -> String {
        match (criterion, self.cost, self.value(criterion)) {
            (Criterion::Cost, Some(choice), _) => measured_text(&choice),
            (Criterion::Cost, None, _) => NONE.to_owned(),
            (_, _, Some(value)) => value_text(criterion, value),
            (_, _, None) => TO_COME.to_owned(),
        }
    }

    /// "equal-area, continuous".
    pub fn claims(&self) -> String {
        let claims = self.map.info().claims;
        let kept = Claim::ALL.into_iter().filter(|claim| claim.is_kept(claims));
        let kept: Vec<&str> = kept.map(Claim::name).collect();
        kept.join(", ")
    }

    /// Everything, a line each.
    pub fn summary(&self) -> String {
        let mut lines = vec![self.map.info().name.to_owned()];
        let claims = self.claims();
        if !claims.is_empty() {
            lines.push(claims);
        }
        for criterion in Criterion::ALL {
            lines.push(format!("{}: {}", criterion.name(), self.text(criterion)));
        }
        if let Some(near) = self.corner_text() {
            lines.push(near.to_owned());
        }
        lines.join("\n")
    }

    /// What its largest a/b has to do with the bound at a cube's corner.
    pub fn corner_text(&self) -> Option<&'static str> {
        /// As near as the search for the largest ends.
        const NEAR: f64 = 1e-6;
        let above = self.value(Criterion::ShapeMax)? - Criterion::ShapeMax.corner_bound()?;
        if self.map.info().borders != Borders::CubeEdges || above > NEAR {
            return None;
        }
        Some(if above > -NEAR {
            "a/b max is √3: no mapping that is smooth at a cube's corner is below"
        } else {
            "a/b max is below √3, which is no contradiction: this cube is bent along the diagonals, so it is not smooth at the corner"
        })
    }
}

/// A value with its unit.
pub fn value_text(criterion: Criterion, value: f64) -> String {
    if !value.is_finite() {
        return UNBOUNDED.to_owned();
    }
    let unit = criterion.unit();
    match criterion {
        Criterion::AreaRms => format!("{value:.4}"),
        Criterion::OmegaMean | Criterion::OmegaMax => format!("{value:.2}{unit}"),
        Criterion::Cost => format!("{}{unit}", significant(value)),
        _ => format!("{value:.3}"),
    }
}
