//! `sixfold stress`: where each way to compute a mapping breaks, as a table and as files.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use super::bar::Bar;
use super::devices::{DeviceKind, explain, wanted};
use super::{CliError, FAILED};
use crate::imaging::Progress;
use crate::lab::files::{LabError, prepare, write};
use crate::lab::report;
use crate::lab::stress::{Plan, stress};
use crate::mapping::{Device, MappingId};

/// Options of `sixfold stress`.
#[derive(Debug, clap::Args)]
pub(super) struct StressOptions {
    /// Mappings to ask; all of them when none is named
    pub(super) maps: Vec<MappingId>,
    /// Folder for stress.json and stress.csv; made if it is not there
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Fewer inputs: some seconds
    #[arg(long)]
    pub(super) quick: bool,
    /// Print every family of every evaluator, not the worst of each
    #[arg(long)]
    pub(super) all: bool,
    /// Evaluators of this device only; without it those of both
    #[arg(long, value_enum)]
    pub(super) device: Option<DeviceKind>,
    /// Replace existing files
    #[arg(long)]
    pub(super) force: bool,
}

/// Asks, writes the files, prints the table and says what is broken.
pub(super) fn run(
    options: &StressOptions,
    device: &dyn Device,
    out: &mut impl Write,
    mut complaints: impl Write,
) -> Result<u8, CliError> {
    let mut plan = if options.quick {
        Plan::quick()
    } else {
        Plan::full()
    };
    plan.devices = wanted(options.device);
    if !options.maps.is_empty() {
        plan.maps.clone_from(&options.maps);
    }
    let files = ["stress.json", "stress.csv"];
    if let Some(folder) = &options.out {
        prepare(folder, &files, options.force)?;
    }
    let progress = Arc::new(Progress::new());
    let bar = Bar::watch(&progress);
    let outcome = stress(&plan, device, &progress);
    drop(bar);
    let mut status = explain(&outcome, options.device, &mut complaints);
    let rows = &outcome.rows;
    if let Some(folder) = &options.out {
        let texts = [report::json(rows), report::csv(rows)];
        for (name, text) in files.iter().zip(texts) {
            let text = text.map_err(LabError::Words)?;
            write(folder, name, options.force, text.as_bytes())?;
        }
    }
    out.write_all(report::stress_table(rows, options.all).as_bytes())
        .map_err(CliError::Write)?;
    for row in rows.iter().filter(|row| row.broken) {
        status = FAILED;
        let (map, evaluator, family) = (row.mapping, row.evaluator, row.family.id());
        let fault = row.fault.as_deref().unwrap_or_default();
        let worst = row.worst.join(" ");
        let _ = writeln!(
            complaints,
            "sixfold: {map} by {evaluator} on {family}: {fault}; worst input {worst}"
        );
    }
    Ok(status)
}
