//! `sixfold bench`: run time against error, as a table and as files.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use super::CliError;
use super::bar::Bar;
use super::devices::{DeviceKind, explain, wanted};
use crate::imaging::Progress;
use crate::lab::bench::{Plan, bench};
use crate::lab::machine::Machine;
use crate::lab::{files, report};
use crate::mapping::{Device, MappingId};

/// Options of `sixfold bench`.
#[derive(Debug, clap::Args)]
pub(super) struct BenchOptions {
    /// Mappings to measure; all of them when none is named
    pub(super) maps: Vec<MappingId>,
    /// Folder for bench.json, bench.csv, bench.svg, bench.png and bench_machine.json; made if it is not there
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Random inputs only, shorter times: some seconds
    #[arg(long)]
    pub(super) quick: bool,
    /// Texels along a chart's height, for the error in texels
    #[arg(long, value_name = "N", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub(super) texels: u32,
    /// Evaluators of this device only; without it those of both
    #[arg(long, value_enum)]
    pub(super) device: Option<DeviceKind>,
    /// Replace existing files
    #[arg(long)]
    pub(super) force: bool,
}

/// Measures, writes the files and prints the table.
pub(super) fn run(
    options: &BenchOptions,
    device: &dyn Device,
    out: &mut impl Write,
    complaints: impl Write,
) -> Result<u8, CliError> {
    let mut plan = if options.quick {
        Plan::quick()
    } else {
        Plan::full()
    };
    plan.texels = options.texels;
    plan.devices = wanted(options.device);
    if !options.maps.is_empty() {
        plan.maps.clone_from(&options.maps);
    }
    if let Some(folder) = &options.out {
        files::prepare(folder, &files::BENCH, options.force)?;
    }
    let progress = Arc::new(Progress::new());
    let bar = Bar::watch(&progress);
    let outcome = bench(&plan, device, &progress);
    drop(bar);
    let status = explain(&outcome, options.device, complaints);
    let rows = &outcome.rows;
    if let Some(folder) = &options.out {
        let adapter = outcome.adapter.as_ref().and_then(|a| a.as_ref().ok());
        files::write_bench(folder, options.force, rows, &Machine::this(adapter))?;
    }
    out.write_all(report::bench_table(rows).as_bytes())
        .map_err(CliError::Write)?;
    Ok(status)
}
