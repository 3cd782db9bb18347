//! The one binary: with no arguments the explorer, else the command line.

use std::path::PathBuf;
use std::process::ExitCode;

use sixfold::cli::{self, RenderOptions, Request};

fn main() -> ExitCode {
    let status = match cli::run(std::env::args_os()) {
        Request::Done(status) => status,
        Request::Explore { scene } => explore(scene),
        Request::Render(options) => render(&options),
    };
    ExitCode::from(status)
}

#[cfg(feature = "explorer")]
fn explore(_scene: Option<PathBuf>) -> u8 {
    cli::complain("the explorer is not built yet; `sixfold --help` lists what is");
    cli::FAILED
}

#[cfg(feature = "explorer")]
fn render(_options: &RenderOptions) -> u8 {
    cli::complain("drawing is not built yet; `sixfold --help` lists what is");
    cli::FAILED
}

#[cfg(not(feature = "explorer"))]
fn explore(_scene: Option<PathBuf>) -> u8 {
    without_explorer()
}

#[cfg(not(feature = "explorer"))]
fn render(_options: &RenderOptions) -> u8 {
    without_explorer()
}

#[cfg(not(feature = "explorer"))]
fn without_explorer() -> u8 {
    cli::complain("built without the explorer; build it with `cargo build --release`");
    cli::FAILED
}
