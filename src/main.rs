//! The one binary: with no arguments the explorer, else the command line.

use std::path::PathBuf;
use std::process::ExitCode;

use sixfold::cli::{self, FigureOptions, RenderOptions, Request};

fn main() -> ExitCode {
    let status = match cli::run(std::env::args_os(), &shaders()) {
        Request::Done(status) => status,
        Request::Explore { scene } => explore(scene),
        Request::Render(options) => render(&options),
        Request::Figure(options) => figure(&options),
    };
    ExitCode::from(status)
}

/// What runs shaders for the command line; opened when a command asks for it.
#[cfg(feature = "explorer")]
fn shaders() -> impl sixfold::mapping::Device {
    sixfold::gpu::ShaderDevice::new()
}

#[cfg(not(feature = "explorer"))]
fn shaders() -> impl sixfold::mapping::Device {
    sixfold::mapping::NoDevice(WITHOUT_EXPLORER)
}

/// 0, or one line on standard error and the status that comes with it.
#[cfg(feature = "explorer")]
fn status_of(outcome: Result<(), (u8, impl std::fmt::Display)>) -> u8 {
    match outcome {
        Ok(()) => cli::DONE,
        Err((status, error)) => {
            cli::complain(error);
            status
        }
    }
}

#[cfg(feature = "explorer")]
fn explore(scene: Option<PathBuf>) -> u8 {
    status_of(sixfold::app::run(scene.as_deref()).map_err(|error| (cli::FAILED, error)))
}

#[cfg(feature = "explorer")]
fn render(options: &RenderOptions) -> u8 {
    status_of(draw(options))
}

/// The picture that the options ask for: the scene, changed where an option says so. What can be refused is refused
/// before anything is drawn.
#[cfg(feature = "explorer")]
fn draw(options: &RenderOptions) -> Result<(), (u8, String)> {
    use sixfold::app::action::{Action, apply};
    use sixfold::app::picture::{self, Destination, PictureRequest, What};
    use sixfold::app::{files, state::AppState};
    use sixfold::cli::Picture;
    use sixfold::imaging::{Environment, atomic};

    let failed = |error: String| (cli::FAILED, error);
    atomic::check_name(&options.out, options.force).map_err(|error| failed(error.to_string()))?;
    let mut state = match &options.scene {
        Some(path) => files::open_scene(path).map_err(failed)?,
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
        options.rotate.map(Action::SetRotation),
        options
            .material
            .clone()
            .map(|material| Action::SetMaterial(Box::new(material))),
    ];
    for action in changes.into_iter().flatten() {
        apply(&mut state, action);
    }
    if let Some(compare) = options.compare
        && state.compare != options.compare
    {
        let line =
            format!("`{compare}` is the mapping left of the divider; compare it with another");
        return Err((cli::USAGE, line));
    }
    let request = PictureRequest {
        what: match options.what {
            Picture::Window => What::Window,
            Picture::Viewport => What::Viewport,
            Picture::Panel(mapping) => What::Panel(mapping),
            Picture::Panels => What::Panels,
            Picture::Fold => What::Fold,
            Picture::Sampling => What::Sampling,
        },
        size: options.size,
        overlays: options.overlays,
        to: Destination::File {
            path: options.out.clone(),
            force: options.force,
        },
    };
    picture::render(&state, &request).map_err(failed)
}

#[cfg(feature = "explorer")]
fn figure(options: &FigureOptions) -> u8 {
    status_of(draw_figures(options))
}

/// The figures that the options name, each into a file of its name, and its lines into another one where it is line art.
#[cfg(feature = "explorer")]
fn draw_figures(options: &FigureOptions) -> Result<(), (u8, String)> {
    use sixfold::app::figures::Figure;
    use sixfold::app::line_art::SVG;
    use sixfold::app::picture::{self, Destination, PictureRequest};
    use sixfold::imaging::{Environment, atomic};

    if options.name == "list" {
        return list_figures();
    }
    let figures = match Figure::from_id(&options.name) {
        Some(figure) => vec![figure],
        None if options.name == "all" => Figure::all().collect(),
        None => {
            let names: Vec<&str> = Figure::all().map(Figure::id).collect();
            let names = names.join(", ");
            let line = format!("no figure `{}`; there are: all, {names}", options.name);
            return Err((cli::USAGE, line));
        }
    };
    let failed = |error: String| (cli::FAILED, error);
    let path = |figure: &Figure, end: &str| options.out.join(figure.id()).with_extension(end);
    // The view, and its lines where it is line art.
    let ends = |figure: &Figure| {
        let lines = figure.what().is_line_art().then_some(SVG);
        std::iter::once("png").chain(lines)
    };
    std::fs::create_dir_all(&options.out).map_err(|error| {
        let folder = options.out.display();
        failed(format!("the folder cannot be made ({error}): {folder}"))
    })?;
    // Nothing is drawn before all names are found to be free.
    for figure in &figures {
        for end in ends(figure) {
            atomic::check_name(&path(figure, end), options.force)
                .map_err(|error| failed(error.to_string()))?;
        }
    }
    for figure in &figures {
        let mut state = figure.bare();
        if let Some(id) = &options.environment {
            state.environment = Environment::from_id(id);
        }
        for end in ends(figure) {
            let request = PictureRequest {
                what: figure.what(),
                size: options.size,
                overlays: true,
                to: Destination::File {
                    path: path(figure, end),
                    force: options.force,
                },
            };
            picture::render(&state, &request).map_err(failed)?;
        }
    }
    Ok(())
}

/// Prints each figure's name and title.
#[cfg(feature = "explorer")]
fn list_figures() -> Result<(), (u8, String)> {
    use sixfold::app::figures::Figure;
    let line = |figure: Figure| format!("{}\t{}\n", figure.id(), figure.title());
    let text: String = Figure::all().map(line).collect();
    cli::print(&text).map_err(|error| (cli::FAILED, error.to_string()))
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
fn figure(_options: &FigureOptions) -> u8 {
    without_explorer()
}

#[cfg(not(feature = "explorer"))]
const WITHOUT_EXPLORER: &str = "built without the explorer; build it with `cargo build --release`";

#[cfg(not(feature = "explorer"))]
fn without_explorer() -> u8 {
    cli::complain(WITHOUT_EXPLORER);
    cli::FAILED
}
