//! `sixfold maps`: the registry as a table or as JSON.

use std::io::Write;

use serde::Serialize;

use super::{CliError, DONE};
use crate::mapping::{Claims, Domain, Family, Layout, MappingId, Runs, WeakSpot};

/// Options of `sixfold maps`.
#[derive(Debug, clap::Args)]
pub(super) struct MapsOptions {
    /// Print one JSON array, with every description, instead of a table
    #[arg(long)]
    json: bool,
}

/// One mapping as JSON has it.
#[derive(Serialize)]
struct Entry {
    id: &'static str,
    name: &'static str,
    about: &'static str,
    family: Family,
    charts: &'static [&'static str],
    coverage: &'static str,
    solid_angle_sr: f64,
    domain: Domain,
    aspect: f64,
    layout: Layout,
    claims: Claims,
    conventions: Vec<Convention>,
    evaluators: Vec<Evaluator>,
    weak_spots: &'static [WeakSpot],
    source: &'static str,
}

#[derive(Serialize)]
struct Convention {
    id: &'static str,
    about: &'static str,
    columns: [&'static str; 3],
    has_inverse: bool,
}

#[derive(Serialize)]
struct Evaluator {
    id: &'static str,
    about: &'static str,
    source: &'static str,
    device: &'static str,
    is_vector: bool,
    has_inverse: bool,
}

fn entry(map: MappingId) -> Entry {
    let info = map.info();
    let evaluators = map.evaluators().iter().map(|evaluator| Evaluator {
        id: evaluator.id,
        about: evaluator.about,
        source: evaluator.source,
        device: match evaluator.runs {
            Runs::Processor(_) => "cpu",
            Runs::Shader(_) => "gpu",
        },
        is_vector: evaluator.processor().is_some_and(|own| own.is_vector),
        has_inverse: evaluator.has_inverse(),
    });
    let conventions = info.conventions.iter().map(|convention| Convention {
        id: convention.id,
        about: convention.about,
        columns: convention.columns,
        has_inverse: convention.inverse.is_some(),
    });
    Entry {
        id: info.id,
        name: info.name,
        about: info.about,
        family: info.family,
        charts: info.charts,
        coverage: info.coverage.name(),
        solid_angle_sr: info.coverage.solid_angle_sr(),
        domain: info.domain,
        aspect: info.aspect,
        layout: info.layout,
        claims: info.claims,
        conventions: conventions.collect(),
        evaluators: evaluators.collect(),
        weak_spots: info.weak_spots,
        source: info.source,
    }
}

const TITLES: [&str; 7] = [
    "ID",
    "NAME",
    "CHARTS",
    "COVERS",
    "CONVENTIONS",
    "EVALUATORS",
    "SOURCE",
];

/// The cells of one row of the table.
fn row(entry: &Entry) -> [String; 7] {
    let list = |ids: Vec<&str>| match ids.len() {
        0 => "-".to_owned(),
        _ => ids.join(","),
    };
    [
        entry.id.to_owned(),
        entry.name.to_owned(),
        entry.charts.len().to_string(),
        entry.coverage.to_owned(),
        list(entry.conventions.iter().map(|c| c.id).collect()),
        list(entry.evaluators.iter().map(|e| e.id).collect()),
        entry.source.to_owned(),
    ]
}

/// Writes the list of mappings.
pub(super) fn run(options: &MapsOptions, out: &mut impl Write) -> Result<u8, CliError> {
    let entries: Vec<Entry> = MappingId::ALL.iter().copied().map(entry).collect();
    let text = if options.json {
        let json = serde_json::to_string_pretty(&entries);
        json.map_err(|error| CliError::Write(error.into()))? + "\n"
    } else {
        table(&entries)
    };
    out.write_all(text.as_bytes()).map_err(CliError::Write)?;
    Ok(DONE)
}

/// A table whose columns are as wide as their widest cell; the last is not padded.
fn table(entries: &[Entry]) -> String {
    let titles = TITLES.map(str::to_owned);
    let rows: Vec<[String; 7]> = std::iter::once(titles)
        .chain(entries.iter().map(row))
        .collect();
    let width: [usize; 7] = std::array::from_fn(|column| {
        let widths = rows.iter().map(|row| row[column].chars().count());
        widths.max().unwrap_or(0)
    });
    let mut text = String::new();
    for row in &rows {
        for (cell, width) in row.iter().zip(&width[..6]) {
            text.push_str(&format!("{cell:width$}  "));
        }
        text.push_str(&row[6]);
        text.push('\n');
    }
    text
}
