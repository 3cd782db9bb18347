//! The command line.
//!
//! Standard output carries data only; messages go to standard error, one line each. Exit status: 0 done, 1 the work
//! failed, 2 wrong usage, 130 stopped by Ctrl-C. What needs the window or the GPU is not done here but handed back as a [`Request`].

mod bar;
mod bench;
mod convert;
mod csv;
mod devices;
mod eval;
mod figure;
mod maps;
mod metrics;
mod plan;
mod render;
mod stress;

pub use figure::FigureOptions;
pub use render::{Picture, RenderOptions};

use std::ffi::OsString;
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;

use clap::error::ErrorKind;
use clap::{Parser, Subcommand};

use crate::mapping::{Device, EvaluatorError};

/// Everything went well.
pub const DONE: u8 = 0;
/// The work failed.
pub const FAILED: u8 = 1;
/// The command line was wrong.
pub const USAGE: u8 = 2;
/// The user has stopped it: 128 and the number of the signal that Ctrl-C sends, as shells say it.
pub const INTERRUPTED: u8 = 130;

/// What is left to do after the command line has been read.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Nothing: the command has run, the process ends with this status.
    Done(u8),
    /// Open the explorer, on a saved scene or on the default.
    Explore {
        /// An existing scene file.
        scene: Option<PathBuf>,
    },
    /// Draw one picture into a file.
    Render(Box<RenderOptions>),
    /// Draw figures into files.
    Figure(FigureOptions),
}

/// Explore environment mappings: one direction, followed through every map at once
///
/// Without a command it opens the explorer.
#[derive(Debug, Parser)]
#[command(name = "sixfold", version, args_conflicts_with_subcommands = true)]
struct Cli {
    /// What to open in the explorer: a saved scene, a picture that it exported, a model (OBJ, glTF, GLB) or a latlong picture
    scene: Option<PathBuf>,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// List the mappings
    Maps(maps::MapsOptions),
    /// Directions from standard input to chart coordinates, or back
    Eval(plan::EvalOptions),
    /// One environment map into another mapping, layout, size, format
    Convert(Box<convert::ConvertOptions>),
    /// Run time against error of every evaluator of every mapping
    Bench(bench::BenchOptions),
    /// Numerical stress test of the same
    Stress(stress::StressOptions),
    /// How every mapping distorts areas and angles
    Metrics(metrics::MetricsOptions),
    /// Draw one picture without opening a window
    Render(Box<RenderOptions>),
    /// Draw the figures of the source articles anew
    Figure(FigureOptions),
}

/// Why a command ended early. Each message is one line.
#[derive(Debug, thiserror::Error)]
enum CliError {
    #[error(transparent)]
    Usage(#[from] plan::PlanError),
    #[error(transparent)]
    Convert(#[from] convert::ConvertError),
    #[error(transparent)]
    Lab(#[from] crate::lab::files::LabError),
    #[error(transparent)]
    Device(#[from] EvaluatorError),
    #[error("standard input cannot be read: {0}")]
    Read(io::Error),
    #[error("standard output cannot be written: {0}")]
    Write(io::Error),
}

/// Reads the command line (`args` begins with the program's name) and runs the command that it names, unless that needs
/// more than this layer may use.
/// `device` runs shaders; nothing is asked of it unless the command needs one.
pub fn run(args: impl IntoIterator<Item = OsString>, device: &dyn Device) -> Request {
    match Cli::try_parse_from(args) {
        Ok(cli) => obey(cli, device),
        Err(error) => Request::Done(explain(&error)),
    }
}

/// Prints `sixfold: message` to standard error.
pub fn complain(message: impl std::fmt::Display) {
    // Where standard error is closed too, the exit status has to say it all.
    let _ = writeln!(io::stderr(), "sixfold: {message}");
}

/// Prints data to standard output; a reader that has gone away has what it wanted.
///
/// # Errors
/// When standard output cannot be written.
pub fn print(text: &str) -> io::Result<()> {
    match io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

fn obey(cli: Cli, device: &dyn Device) -> Request {
    match cli.command {
        Some(Command::Maps(options)) => finish(|out| maps::run(&options, out)),
        Some(Command::Eval(options)) => {
            let (input, complaints) = (io::stdin().lock(), io::stderr().lock());
            finish(|out| eval::run(&options, device, input, out, complaints))
        }
        Some(Command::Convert(options)) => Request::Done(status_of(
            convert::run(&options)
                .map(|()| DONE)
                .map_err(CliError::from),
        )),
        Some(Command::Bench(options)) => {
            finish(|out| bench::run(&options, device, out, io::stderr().lock()))
        }
        Some(Command::Stress(options)) => {
            finish(|out| stress::run(&options, device, out, io::stderr().lock()))
        }
        Some(Command::Metrics(options)) => finish(|out| metrics::run(&options, out)),
        Some(Command::Render(options)) => Request::Render(options),
        Some(Command::Figure(options)) => Request::Figure(options),
        None => match cli.scene {
            Some(path) if !path.is_file() => {
                complain(format_args!(
                    "neither a command nor a scene file; `sixfold --help` lists the commands: {}",
                    path.display()
                ));
                Request::Done(FAILED)
            }
            scene => Request::Explore { scene },
        },
    }
}

/// Runs a command on the buffered standard output; its `Ok` holds the exit status.
fn finish(command: impl FnOnce(&mut BufWriter<io::StdoutLock>) -> Result<u8, CliError>) -> Request {
    let mut out = BufWriter::with_capacity(1 << 16, io::stdout().lock());
    let result = command(&mut out).and_then(|status| {
        out.flush().map_err(CliError::Write)?;
        Ok(status)
    });
    // What could not be written must not be tried again when the buffer is dropped.
    let _ = out.into_parts();
    Request::Done(status_of(result))
}

/// The exit status of a command that has run; says in one line what went wrong.
fn status_of(result: Result<u8, CliError>) -> u8 {
    let error =
        match result {
            Ok(status) => return status,
            // The reader has what it wanted (`| head`).
            Err(
                CliError::Write(error) | CliError::Convert(convert::ConvertError::Write(error)),
            ) if error.kind() == io::ErrorKind::BrokenPipe => return DONE,
            Err(error) => error,
        };
    complain(&error);
    match error {
        CliError::Usage(_) | CliError::Convert(convert::ConvertError::Usage(_)) => USAGE,
        CliError::Convert(convert::ConvertError::Interrupted) => INTERRUPTED,
        _ => FAILED,
    }
}

/// Prints what clap has to say: help and version to standard output, the rest to standard error.
fn explain(error: &clap::Error) -> u8 {
    if error.kind() == ErrorKind::ValueValidation {
        // The value's own error says what to do; the usage that clap adds only hides it.
        let text = error.render().to_string();
        let line = text.lines().next().unwrap_or_default();
        complain(line.strip_prefix("error: ").unwrap_or(line));
    } else {
        let _ = error.print();
    }
    if error.use_stderr() { USAGE } else { DONE }
}
