//! `--device`, and what is said of an adapter that is not there.

use std::io::Write;

use super::{DONE, FAILED};
use crate::lab::devices::{Devices, Outcome};

/// A kind of device on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum DeviceKind {
    /// The processor; no graphics adapter is opened
    Cpu,
    /// Shaders on a graphics adapter
    Gpu,
}

/// The evaluators that take part.
pub(super) fn wanted(kind: Option<DeviceKind>) -> Devices {
    match kind {
        None => Devices::Both,
        Some(DeviceKind::Cpu) => Devices::Cpu,
        Some(DeviceKind::Gpu) => Devices::Gpu,
    }
}

/// Says which shaders were left out and why, a line each; the status that comes with it. That there is no adapter fails only
/// who has asked for one.
pub(super) fn explain<R>(
    outcome: &Outcome<R>,
    kind: Option<DeviceKind>,
    mut complaints: impl Write,
) -> u8 {
    let mut status = DONE;
    if let Some(Err(error)) = &outcome.adapter {
        let _ = writeln!(complaints, "sixfold: {error}");
        if kind == Some(DeviceKind::Gpu) {
            status = FAILED;
        }
    }
    for fault in &outcome.faults {
        let _ = writeln!(complaints, "sixfold: {fault}");
        status = FAILED;
    }
    status
}
