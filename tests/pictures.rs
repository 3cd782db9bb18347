//! Pictures without a window: every panel the right way round, the same bytes from window and command line, scenes inside.

#![cfg(feature = "explorer")]
#![expect(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use sixfold::app::model::Surroundings;
use sixfold::app::panel_view::{PanelWindow, rect_of_size};
use sixfold::app::picture::{self, Destination, MAX_SIDE, Picture, PictureRequest, What};
use sixfold::app::{files, state::AppState};
use sixfold::gpu::{Gpu, ToneCurve};
use sixfold::imaging::srgb::srgb8_from_linear;
use sixfold::imaging::{Environment, Progress};
use sixfold::mapping::MappingId;
use sixfold::math::{Vec3, inputs::even_directions};

fn state() -> AppState {
    AppState {
        environment: Environment::DirectionColor,
        texel_budget: 6 * 128 * 128,
        tone: ToneCurve::Linear,
        ..AppState::default()
    }
}

fn surroundings(environment: Environment) -> Surroundings {
    let loaded = environment.image(&Progress::new()).unwrap();
    Surroundings {
        environment,
        loaded: Arc::new(loaded),
    }
}

fn request(what: What, size: [u32; 2], path: &Path) -> PictureRequest {
    let to = Destination::File {
        path: path.to_owned(),
        force: false,
    };
    PictureRequest {
        what,
        size,
        overlays: false,
        to,
    }
}

fn draw(gpu: &Gpu, state: &AppState, request: &PictureRequest) -> Result<Picture, String> {
    picture::draw(
        gpu,
        state,
        surroundings(state.environment.clone()),
        request,
        &Progress::new(),
    )
}

/// Largest difference in 8-bit steps between a panel's pixels and the colour of the direction that belongs there.
fn worst_step(picture: &Picture, mapping: MappingId, turned: fn(Vec3<f64>) -> Vec3<f64>) -> u8 {
    let info = mapping.info();
    let [width, height] = picture.size;
    let view = AppState::default().panel(mapping);
    let rect = rect_of_size(width as f32, height as f32);
    let window = PanelWindow::new(rect, &view, info.layout.picture_aspect(info.aspect) as f32);
    let mut worst = 0;
    for dir in even_directions(500) {
        let dir = Vec3::<f64>::from_f64(dir);
        let Some(point) = mapping
            .forward(dir)
            .filter(|_| info.coverage.contains(dir.to_f64()))
        else {
            continue;
        };
        // Well inside the chart, away from the edges that the panel smooths.
        let edge = match info.domain {
            sixfold::mapping::Domain::Square => {
                (0.5 - (point.u - 0.5).abs()).min(0.5 - (point.v - 0.5).abs())
            }
            sixfold::mapping::Domain::Disc => 0.5 - (point.u - 0.5).hypot(point.v - 0.5),
        };
        if edge < 0.03 {
            continue;
        }
        let place = window.screen_from_picture(info.layout.picture_from_chart(point).unwrap());
        let at = 4 * (place.y as usize * width as usize + place.x as usize);
        let wanted = turned(dir).to_f64().map(|c| (0.5 + 0.5 * c) as f32);
        for (got, wanted) in picture.rgba[at..at + 3]
            .iter()
            .zip(srgb8_from_linear(wanted))
        {
            worst = worst.max(got.abs_diff(wanted));
        }
    }
    worst
}

#[test]
fn every_panel_shows_every_direction_in_its_place() {
    let gpu = Gpu::headless().unwrap();
    let state = state();
    let mut observed = 0;
    for &mapping in MappingId::ALL {
        let request = request(What::Panel(mapping), [800, 600], Path::new("unused.png"));
        let picture = draw(&gpu, &state, &request).unwrap();
        let worst = worst_step(&picture, mapping, |d| d);
        let mirrored = worst_step(&picture, mapping, |d| Vec3::new(-d.x, d.y, d.z));
        println!("{mapping}: off by at most {worst} steps of 255, mirrored by {mirrored}");
        assert!(mirrored > 40, "{mapping}: the comparison cannot fail");
        observed = observed.max(worst);
    }
    // Half a pixel and one rounding each of the map and of the picture.
    const BUDGET: u8 = 2;
    assert!(observed <= BUDGET, "observed {observed}, budget {BUDGET}");
}

#[test]
fn the_same_scene_gives_the_same_bytes_from_the_window_and_from_the_command_line() {
    let folder = tempfile::tempdir().unwrap();
    let state = AppState {
        compare: Some(MappingId::Sphere),
        ..state()
    };
    let scene = folder.path().join("scene.json");
    std::fs::write(&scene, state.to_json().unwrap()).unwrap();
    let gpu = Gpu::headless().unwrap();
    for (name, what) in [
        ("window", What::Window),
        ("viewport", What::Viewport),
        ("panel:ccm", What::Panel(MappingId::Ccm)),
    ] {
        let path = folder.path().join("explorer.png");
        let mut wanted = request(what, [640, 400], &path);
        wanted.overlays = true;
        let around = surroundings(state.environment.clone());
        let made = picture::make(&gpu, &state, around, &wanted, &Progress::new()).unwrap();
        let other = folder.path().join("command.png");
        let status = Command::new(env!("CARGO_BIN_EXE_sixfold"))
            .args(["render", "--what", name, "--size", "640x400", "--scene"])
            .args([&scene, &other])
            .status()
            .unwrap();
        assert!(status.success());
        let (a, b) = (
            image::open(&path).unwrap().to_rgba8(),
            image::open(&other).unwrap().to_rgba8(),
        );
        assert_eq!(a.as_raw(), &made.rgba);
        assert!(a == b, "{name}: window and command line differ");
        assert_eq!(
            files::open_scene(&other).unwrap(),
            state,
            "{name}: the scene in the picture"
        );
        // Another scene is another picture.
        let turned = AppState {
            mapping: MappingId::Cube,
            compare: None,
            exposure_ev: 1.0,
            ..state.clone()
        };
        assert_ne!(draw(&gpu, &turned, &wanted).unwrap(), made);
        std::fs::remove_file(path).unwrap();
        std::fs::remove_file(other).unwrap();
    }
}

#[test]
fn overlays_can_be_left_out() {
    let gpu = Gpu::headless().unwrap();
    let mut wanted = request(What::Viewport, [320, 240], Path::new("unused.png"));
    let without = draw(&gpu, &state(), &wanted).unwrap();
    wanted.overlays = true;
    assert_ne!(draw(&gpu, &state(), &wanted).unwrap(), without);
    let mut bare = state();
    bare.overlays = sixfold::app::state::Overlays::NONE;
    assert_eq!(draw(&gpu, &bare, &wanted).unwrap(), without);
}

#[test]
fn sizes_run_from_one_pixel_to_the_limit_and_beyond_it_nothing_is_written() {
    let gpu = Gpu::headless().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.png");
    for size in [[1, 1], [MAX_SIDE, 3], [3, MAX_SIDE], [2048, 2048]] {
        let picture = draw(&gpu, &state(), &request(What::Viewport, size, &path)).unwrap();
        assert_eq!(picture.rgba.len(), 4 * (size[0] * size[1]) as usize);
    }
    for size in [[0, 1], [MAX_SIDE + 1, 1], [u32::MAX, u32::MAX]] {
        let why = draw(&gpu, &state(), &request(What::Viewport, size, &path)).unwrap_err();
        assert!(why.contains("8192") && !why.contains('\n'), "{why}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_cancelled_picture_and_a_taken_name_leave_the_folder_as_it_was() {
    let gpu = Gpu::headless().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("taken.png");
    std::fs::write(&path, b"precious").unwrap();
    let make = |progress: &Progress, wanted: &PictureRequest| {
        picture::make(
            &gpu,
            &state(),
            surroundings(Environment::DirectionColor),
            wanted,
            progress,
        )
    };
    let wanted = request(What::Viewport, [64, 64], &path);
    assert!(
        make(&Progress::new(), &wanted)
            .unwrap_err()
            .contains("taken.png")
    );
    let cancelled = Progress::new();
    cancelled.cancel();
    let other = request(What::Viewport, [64, 64], &folder.path().join("new.png"));
    assert!(make(&cancelled, &other).unwrap_err().contains("cancelled"));
    assert_eq!(std::fs::read(&path).unwrap(), b"precious");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let forced = PictureRequest {
        to: Destination::File {
            path: path.clone(),
            force: true,
        },
        ..wanted
    };
    make(&Progress::new(), &forced).unwrap();
    assert!(image::open(&path).is_ok());
}
