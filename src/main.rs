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

/// 0, or one line on standard error and 1.
#[cfg(feature = "explorer")]
fn status_of(outcome: Result<(), impl std::fmt::Display>) -> u8 {
    match outcome {
        Ok(()) => cli::DONE,
        Err(error) => {
            cli::complain(error);
            cli::FAILED
        }
    }
}

#[cfg(feature = "explorer")]
fn explore(scene: Option<PathBuf>) -> u8 {
    status_of(sixfold::app::run(scene.as_deref()))
}

#[cfg(feature = "explorer")]
fn render(options: &RenderOptions) -> u8 {
    status_of(draw(options))
}

/// The picture that the options ask for: the scene, changed where an option says so.
#[cfg(feature = "explorer")]
fn draw(options: &RenderOptions) -> Result<(), String> {
    use sixfold::app::action::{Action, apply};
    use sixfold::app::picture::{self, Destination, PictureRequest, What};
    use sixfold::app::{files, state::AppState};
    use sixfold::cli::Picture;
    use sixfold::imaging::Environment;

    let mut state = match &options.scene {
        Some(path) => files::open_scene(path)?,
        None => AppState::default(),
    };
    let environment = options.environment.as_deref().map(Environment::from_id);
    let changes = [
        options.map.map(Action::SetMapping),
        options
            .compare
            .map(|compare| Action::SetCompare(Some(compare))),
        options.object.map(Action::SetObject),
        environment.map(Action::SetEnvironment),
    ];
    for action in changes.into_iter().flatten() {
        apply(&mut state, action);
    }
    let request = PictureRequest {
        what: match options.what {
            Picture::Window => What::Window,
            Picture::Viewport => What::Viewport,
            Picture::Panel(mapping) => What::Panel(mapping),
        },
        size: options.size,
        overlays: options.overlays,
        to: Destination::File {
            path: options.out.clone(),
            force: options.force,
        },
    };
    picture::render(&state, &request)
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
