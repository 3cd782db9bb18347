//! `sixfold metrics`: how every mapping distorts, as a table or as JSON.

use std::io::Write;
use std::sync::Arc;

use super::bar::Bar;
use super::{CliError, DONE};
use crate::imaging::{Progress, Stage};
use crate::lab::files::LabError;
use crate::lab::metrics::{Metrics, measure};
use crate::lab::report;
use crate::mapping::MappingId;

/// Options of `sixfold metrics`.
#[derive(Debug, clap::Args)]
pub(super) struct MetricsOptions {
    /// Mappings to measure; all of them when none is named
    maps: Vec<MappingId>,
    /// Print one JSON array instead of a table
    #[arg(long)]
    json: bool,
}

/// Measures and prints.
pub(super) fn run(options: &MetricsOptions, out: &mut impl Write) -> Result<u8, CliError> {
    let maps = match options.maps.as_slice() {
        [] => MappingId::ALL,
        named => named,
    };
    let progress = Arc::new(Progress::new());
    let bar = Bar::watch(&progress);
    progress.enter(Stage::Measuring);
    let mut measured: Vec<Metrics> = Vec::new();
    for (done, &map) in maps.iter().enumerate() {
        progress.step(done, maps.len());
        measured.extend(measure(map, &progress));
    }
    drop(bar);
    let text = if options.json {
        report::json(&measured).map_err(LabError::Words)?
    } else {
        report::metrics_table(&measured)
    };
    out.write_all(text.as_bytes()).map_err(CliError::Write)?;
    Ok(DONE)
}
