//! Reports as text: CSV, JSON, and tables for people.

use serde::Serialize;
use serde_json::Value;

use super::bench::Row;
use super::filter::is_widest;
use super::metrics::{Metrics, UNBOUNDED};
use super::stress;

/// One JSON array, a row a line.
///
/// # Errors
/// When a row cannot be written as JSON, which none of this program's can.
pub fn json<T: Serialize>(rows: &[T]) -> serde_json::Result<String> {
    let lines: Vec<String> = rows
        .iter()
        .map(serde_json::to_string)
        .collect::<Result<_, _>>()?;
    Ok(format!("[\n{}\n]\n", lines.join(",\n")))
}

/// The same with a line of names: lists become one cell of numbers parted by blanks, `null` an empty one.
///
/// # Errors
/// As [`json`].
pub fn csv<T: Serialize>(rows: &[T]) -> serde_json::Result<String> {
    let mut text = String::new();
    for (k, row) in rows.iter().enumerate() {
        let Value::Object(cells) = serde_json::to_value(row)? else {
            continue;
        };
        if k == 0 {
            let names: Vec<&str> = cells.keys().map(String::as_str).collect();
            text.push_str(&names.join(","));
            text.push('\n');
        }
        let cells: Vec<String> = cells.values().map(cell).collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    Ok(text)
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => quoted(text),
        Value::Array(items) => items.iter().map(cell).collect::<Vec<_>>().join(" "),
        Value::Object(_) => quoted(&value.to_string()),
        Value::Bool(_) | Value::Number(_) => value.to_string(),
    }
}

/// A cell of CSV (RFC 4180).
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// A table whose columns are as wide as their widest cell: the first words to the left, the numbers to the right.
pub fn table<const N: usize>(titles: [&str; N], words: usize, rows: &[[String; N]]) -> String {
    let width: [usize; N] = std::array::from_fn(|column| {
        let cells = rows.iter().map(|row| row[column].chars().count());
        cells.max().unwrap_or(0).max(titles[column].chars().count())
    });
    let mut text = String::new();
    let titles = titles.map(str::to_owned);
    for row in std::iter::once(&titles).chain(rows) {
        let cells = row
            .iter()
            .zip(width)
            .enumerate()
            .map(|(column, (cell, width))| {
                if column < words {
                    format!("{cell:width$}")
                } else {
                    format!("{cell:>width$}")
                }
            });
        let line = cells.collect::<Vec<_>>().join("  ");
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

/// What the terminal shows of a bench: one core, the widest instructions, few at a time, random inputs, and the adapter; the
/// fastest first, a star where nothing else of the same device is as fast and as near. The files hold the rest.
pub fn bench_table(rows: &[Row]) -> String {
    const TITLES: [&str; 12] = [
        "MAP",
        "WAY",
        "EVALUATOR",
        "ISA",
        "FRONT",
        "NS",
        "LATENCY",
        "SPREAD",
        "COPIES",
        "MAX RAD",
        "ULP",
        "TEXELS",
    ];
    let is_few = |row: &&Row| row.is_comparable() && row.inputs == super::inputs::Inputs::Random;
    let few: Vec<&Row> = rows.iter().filter(is_few).collect();
    let widest = few.iter().copied().filter(|row| is_widest(row, &few));
    let mut shown: Vec<&Row> = widest.collect();
    // The mappings stay in their order: the sort is stable within each.
    let place = |row: &Row| rows.iter().position(|other| other.mapping == row.mapping);
    shown.sort_by(|a, b| {
        let key = |row: &Row| {
            let is_inverse = row.direction == super::bench::Way::Inverse;
            (place(row), is_inverse, row.isa == super::bench::SHADER)
        };
        key(a).cmp(&key(b)).then(a.ns.total_cmp(&b.ns))
    });
    let cells = |row: &&Row| {
        let error = |number: f64, digits: usize| match row.holes {
            0 => format!("{number:.digits$e}"),
            holes => format!("{holes} holes"),
        };
        [
            row.mapping.to_owned(),
            row.direction.id().to_owned(),
            row.evaluator.to_owned(),
            row.isa.to_owned(),
            if row.on_front { "*" } else { "" }.to_owned(),
            format!("{:.2}", row.ns),
            row.ns_latency
                .map_or_else(String::new, |ns| format!("{ns:.1}")),
            format!("{:.0} %", 100.0 * row.spread),
            format!("{:.1}", row.copy_ratio),
            error(row.max_error_rad, 1),
            format!("{:.3}", row.max_error_ulp),
            format!("{:.1e}", row.max_error_texels),
        ]
    };
    let cells: Vec<[String; 12]> = shown.iter().map(cells).collect();
    table(TITLES, 5, &cells)
}

/// What the terminal shows of a stress test: each evaluator's worst over all families, or every family; observed beside
/// allowed, a mark where something is broken (`!`) or known to be (`x`).
pub fn stress_table(rows: &[stress::Row], all: bool) -> String {
    const TITLES: [&str; 12] = [
        "MAP",
        "EVALUATOR",
        "FAMILY",
        "STATE",
        "HOLES",
        "CHART",
        "RANGE",
        "NAN",
        "FORWARD / ALLOWED",
        "THERE AND BACK / ALLOWED",
        "SEAM / ALLOWED",
        "FALL",
    ];
    let mut cells = Vec::new();
    for group in rows.chunk_by(|a, b| a.mapping == b.mapping) {
        let mut evaluators: Vec<&str> = group.iter().map(|row| row.evaluator).collect();
        evaluators.sort_unstable();
        evaluators.dedup();
        let first = |id: &str| group.iter().position(|row| row.evaluator == id);
        evaluators.sort_by_key(|id| first(id));
        for id in evaluators {
            let own = group.iter().filter(|row| row.evaluator == id);
            if all {
                cells.extend(own.map(|row| stress_cells(row, row.family.id(), &[row])));
            } else if let Some(row) = own.clone().next() {
                cells.push(stress_cells(row, "all", &own.collect::<Vec<_>>()));
            }
        }
    }
    table(TITLES, 4, &cells)
}

/// The worst of some rows of one evaluator.
fn stress_cells(row: &stress::Row, family: &str, rows: &[&stress::Row]) -> [String; 12] {
    let worst: [f64; 8] = std::array::from_fn(|k| {
        let numbers = rows.iter().map(|row| row.observed.numbers()[k]);
        numbers.fold(0.0, f64::max)
    });
    let allowed = row.allowed.numbers();
    let state = if rows.iter().any(|row| row.broken) {
        "!"
    } else if worst
        .iter()
        .zip(allowed)
        .any(|(seen, allowed)| *seen > allowed)
    {
        "x"
    } else {
        ""
    };
    let beside = |k: usize| format!("{:.1e} / {:.1e}", worst[k], allowed[k]);
    [
        row.mapping.to_owned(),
        row.evaluator.to_owned(),
        family.to_owned(),
        state.to_owned(),
        worst[0].to_string(),
        worst[1].to_string(),
        worst[2].to_string(),
        worst[3].to_string(),
        beside(5),
        beside(4),
        beside(6),
        format!("{:.1}", worst[7]),
    ]
}

/// What the terminal shows of the metrics.
pub fn metrics_table(rows: &[Metrics]) -> String {
    const TITLES: [&str; 13] = [
        "MAP",
        "CLAIMS",
        "CHARTS",
        "AREA MAX/MIN",
        "AREA RMS",
        "A/B MEAN",
        "A/B MAX",
        "OMEGA MEAN",
        "OMEGA MAX",
        "LINEAR",
        "BUDGET",
        "EDGES",
        "DIAGONALS",
    ];
    let number = |value: f64, places: usize| {
        if value.is_finite() {
            format!("{value:.places$}")
        } else {
            UNBOUNDED.to_owned()
        }
    };
    let cells = |row: &Metrics| {
        let claims = match (row.equal_area, row.conformal) {
            (true, _) => "equal-area",
            (_, true) => "conformal",
            _ => "-",
        };
        [
            row.mapping.to_string(),
            claims.to_owned(),
            row.charts.to_string(),
            number(row.area_ratio, 4),
            number(row.area_rms, 4),
            number(row.anisotropy_mean, 4),
            number(row.anisotropy_max, 4),
            format!("{:.2}°", row.omega_mean_deg),
            format!("{:.2}°", row.omega_max_deg),
            number(row.worst_linear, 4),
            number(row.texel_budget, 4),
            number(row.edge_ratio, 4),
            number(row.diagonal_ratio, 4),
        ]
    };
    let cells: Vec<[String; 13]> = rows.iter().map(cells).collect();
    table(TITLES, 2, &cells)
}
