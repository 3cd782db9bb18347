//! `sixfold bench`: run time against error, as a table and as files.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::CliError;
use super::bar::Bar;
use super::devices::{DeviceKind, explain, wanted};
use crate::imaging::png_out::{PngError, encode_png};
use crate::imaging::{Progress, atomic};
use crate::lab::bench::{Plan, bench};
use crate::lab::machine::Machine;
use crate::lab::report;
use crate::lab::scatter::scatter;
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

/// Why a report was not written.
#[derive(Debug, thiserror::Error)]
pub(super) enum LabError {
    #[error("the folder cannot be made ({cause}): {}", path.display())]
    Folder {
        cause: std::io::Error,
        path: PathBuf,
    },
    #[error(transparent)]
    Write(#[from] atomic::WriteError),
    #[error(transparent)]
    Picture(#[from] PngError),
    #[error("the report cannot be put into words: {0}")]
    Words(#[from] serde_json::Error),
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
    let files = [
        "bench.json",
        "bench.csv",
        "bench_machine.json",
        "bench.svg",
        "bench.png",
    ];
    if let Some(folder) = &options.out {
        prepare(folder, &files, options.force)?;
    }
    let progress = Arc::new(Progress::new());
    let bar = Bar::watch(&progress);
    let outcome = bench(&plan, device, &progress);
    drop(bar);
    let status = explain(&outcome, options.device, complaints);
    let rows = &outcome.rows;
    if let Some(folder) = &options.out {
        let adapter = outcome.adapter.as_ref().and_then(|a| a.as_ref().ok());
        let machine =
            serde_json::to_string_pretty(&Machine::this(adapter)).map_err(LabError::Words)?;
        let picture = scatter(rows);
        let [width, height] = picture.size();
        let png = encode_png(width, height, &picture.rgba(), None).map_err(LabError::Picture)?;
        let contents = [
            report::json(rows).map_err(LabError::Words)?.into_bytes(),
            report::csv(rows).map_err(LabError::Words)?.into_bytes(),
            (machine + "\n").into_bytes(),
            picture.svg().into_bytes(),
            png,
        ];
        for (name, bytes) in files.iter().zip(contents) {
            write(&folder.join(name), options.force, &bytes)?;
        }
    }
    out.write_all(report::bench_table(rows).as_bytes())
        .map_err(CliError::Write)?;
    Ok(status)
}

/// Makes the folder; what could not be written is refused before the long work.
pub(super) fn prepare(folder: &Path, files: &[&str], force: bool) -> Result<(), LabError> {
    std::fs::create_dir_all(folder).map_err(|cause| LabError::Folder {
        cause,
        path: folder.to_owned(),
    })?;
    for name in files {
        atomic::check_name(&folder.join(name), force)?;
    }
    Ok(())
}

pub(super) fn write(path: &Path, force: bool, bytes: &[u8]) -> Result<(), LabError> {
    Ok(atomic::write_atomically(path, force, bytes)?)
}
