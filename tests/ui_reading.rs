//! The dialog in which the user says how a file is read: when it is shown, what it shows, what comes of it.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

#[path = "orientation/scenes.rs"]
#[allow(
    dead_code,
    reason = "the scenes of other tests, of which these use some"
)]
mod scenes;
mod window_kit;

use std::path::{Path, PathBuf};

use egui::Role;
use egui_kittest::kittest::Queryable;
use scenes::{Laid, photograph};
use sixfold::app::command::Command;
use sixfold::app::state::{AppState, SCHEMA};
use sixfold::imaging::load::Format;
use sixfold::imaging::save::{Content, SaveOptions, save};
use sixfold::imaging::{Environment, MapFile, Progress};
use sixfold::mapping::{Arrangement, Layout, MappingId};
use sixfold::math::Vec3;
use window_kit::{Ui, open, open_sized, run, settle};

const FACE: u32 = 48;

/// Small maps and no panels: what is tested here is beside them.
fn small() -> AppState {
    let mut state = window_kit::small();
    state.panels.iter_mut().for_each(|panel| panel.open = false);
    state
}

/// A cross of a cube whose pictures are these faces, in a file.
fn cross(folder: &Path, name: &str, arrangement: &str) -> PathBuf {
    let laid = Laid::new(MappingId::Cube, Layout::Cross, FACE);
    let arrangement: Arrangement = arrangement.parse().unwrap();
    let (_, pictures) = laid.arranged(photograph, &arrangement);
    write(folder, name, &pictures[0])
}

/// A square picture, which may be many things.
fn square(folder: &Path, name: &str) -> PathBuf {
    let laid = Laid::new(MappingId::Octahedral, Layout::Single, 2 * FACE);
    write(folder, name, &laid.map(photograph).rasters()[0])
}

fn write(folder: &Path, name: &str, picture: &sixfold::imaging::Raster) -> PathBuf {
    let path = folder.join(name);
    save(
        &path,
        true,
        Content::Raster(picture),
        Format::Exr,
        &SaveOptions::default(),
        &Progress::new(),
    )
    .unwrap();
    path
}

fn state(ui: &Ui) -> &AppState {
    ui.state().explorer().state()
}

/// The file that is shown, as it is read.
fn file(ui: &Ui) -> &MapFile {
    match &state(ui).environment {
        Environment::File(file) => file,
        other => panic!("{other:?}"),
    }
}

/// Largest difference between what is shown and what `expected` has, in the directions of faces, edges and corners.
fn worst(ui: &Ui, expected: fn(Vec3<f64>) -> Vec3<f64>) -> f32 {
    let shown = ui.state().explorer().surroundings().unwrap();
    let mut worst = 0.0f32;
    for dir in sixfold::math::inputs::SIGN_PATTERNS {
        let dir = Vec3::from_f64(dir.map(f64::from)).normalized();
        let point = MappingId::Latlong.forward(dir).unwrap();
        let found = shown.loaded.image.nearest(point.u, point.v);
        let wanted = photograph(expected(dir));
        for i in 0..3 {
            worst = worst.max((found[i] - wanted[i]).abs());
        }
    }
    worst
}

/// What interpolation between texels of a coarse face leaves, and much less than what another face shows.
const CLOSE: f32 = 0.03;

/// As a user does it: what lies below the fold of a list is scrolled to.
fn click(ui: &mut Ui, role: Role, label: &str) {
    ui.get_by_role_and_label(role, label).scroll_to_me();
    clicked(ui);
    ui.get_by_role_and_label(role, label).click();
    clicked(ui);
}

/// After a click: it is a press and a release, and what it starts may begin a frame later.
fn clicked(ui: &mut Ui) {
    ui.run_steps(3);
    settle(ui);
}

fn is_asked(ui: &Ui, name: &str) -> bool {
    ui.query_by_label(&format!("How to read {name}")).is_some()
}

#[test]
fn exchanged_faces_are_put_right_by_the_arrangement_that_is_proposed() {
    let folder = tempfile::tempdir().unwrap();
    let truth = "+z,-x,+y,-y,+x,-z";
    let path = cross(folder.path(), "exchanged.exr", truth);
    let mut ui = open(small());
    run(&mut ui, Command::Open(path));
    // Nothing is taken for granted, and nothing has happened yet.
    assert!(is_asked(&ui, "exchanged.exr"));
    assert_eq!(state(&ui).environment, Environment::DirectionColor);
    assert_eq!(ui.state().explorer().messages(), []);
    ui.get_by_label_contains("faces +x and +z exchanged, nothing flipped");
    ui.get_by_label_contains("Lower is better");
    // As labelled, the right face shows what is ahead.
    click(&mut ui, Role::Button, "Open");
    let wrong = worst(&ui, |dir| dir);
    assert!(wrong > 3.0 * CLOSE, "{wrong}");

    click(&mut ui, Role::Button, "How it is read …");
    click(&mut ui, Role::Button, "Take this arrangement");
    ui.get_by_label_contains(&format!("--arrange {truth}"));
    assert!(ui.query_by_label("Take this arrangement").is_none());
    click(&mut ui, Role::Button, "Open");
    assert!(!is_asked(&ui, "exchanged.exr"));
    assert_eq!(file(&ui).hints.arrange, truth.parse().ok());
    let right = worst(&ui, |dir| dir);
    assert!((CLOSE / 10.0..CLOSE).contains(&right), "{right}");

    // It is taken back, made again and kept in the scene.
    let text = state(&ui).to_json().unwrap();
    assert_eq!(AppState::from_json(&text).unwrap(), *state(&ui));
    run(&mut ui, Command::Undo);
    assert_eq!(file(&ui).hints.arrange, None);
    assert_eq!(worst(&ui, |dir| dir), wrong);
    run(&mut ui, Command::Redo);
    assert_eq!(worst(&ui, |dir| dir), right);
    run(&mut ui, Command::Undo);
    run(&mut ui, Command::Undo);
    assert_eq!(state(&ui).environment, Environment::DirectionColor);
}

#[test]
fn a_file_that_leaves_no_doubt_opens_at_once_and_is_mirrored_when_the_user_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = cross(
        folder.path(),
        "right.exr",
        &Arrangement::IDENTITY.to_string(),
    );
    let mut ui = open(small());
    assert!(
        ui.query_by_label("How it is read …").is_none(),
        "nothing to say of what is built in"
    );
    run(&mut ui, Command::Open(path.clone()));
    assert!(!is_asked(&ui, "right.exr"));
    let told = &ui.state().explorer().messages().last().unwrap().text;
    assert!(
        told.contains("right.exr: read as `cube` as `cross`"),
        "{told}"
    );
    assert!(!told.contains("--"), "{told}");
    assert!(worst(&ui, |dir| dir) < CLOSE);

    click(&mut ui, Role::Button, "How it is read …");
    let mirrored = "a mirror image: exchange left and right";
    click(&mut ui, Role::CheckBox, mirrored);
    click(&mut ui, Role::Button, "Open");
    assert!(file(&ui).hints.mirrored);
    assert!(worst(&ui, |dir| Vec3::new(-dir.x, dir.y, dir.z)) < CLOSE);
    assert!(worst(&ui, |dir| dir) > 3.0 * CLOSE);

    // The menu leads there too; Cancel leaves everything as it was.
    let before = state(&ui).clone();
    click(&mut ui, Role::Button, "File");
    click(&mut ui, Role::Button, "How the environment is read …");
    assert!(is_asked(&ui, "right.exr"));
    click(&mut ui, Role::CheckBox, mirrored);
    click(&mut ui, Role::Button, "Cancel");
    assert!(!is_asked(&ui, "right.exr"));
    assert_eq!(*state(&ui), before);
}

#[test]
fn a_square_is_asked_about_and_decoded_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = square(folder.path(), "square.exr");
    let mut ui = open(small());
    run(&mut ui, Command::Open(path.clone()));
    assert!(is_asked(&ui, "square.exr"));
    assert_eq!(
        ui.state().explorer().messages(),
        [],
        "no refusal beside the question"
    );
    ui.get_by_label_contains("OpenEXR of floats: 96 × 96 texels; it does not say what it is");
    ui.get_by_label_contains("Seams cannot tell: a mirror image meets as well");
    ui.get_by_label_contains("--from octahedral --from-layout single");
    ui.get_by_role_and_label(Role::Image, "The labelled environment, the right way round");
    // The file goes; what is said of it changes all the same.
    std::fs::remove_file(&path).unwrap();
    let angular = ui.get_by(|node| {
        node.role() == Role::RadioButton
            && node
                .label()
                .is_some_and(|label| label.starts_with("Angular map"))
    });
    angular.click();
    clicked(&mut ui);
    ui.get_by_label_contains("--from angular");
    assert!(ui.query_by_label_contains("--from octahedral").is_none());
    // A frame that knows it is offered, and comes into the line.
    click(&mut ui, Role::ComboBox, "frame");
    assert!(
        ui.query_by_label("Unity").is_none(),
        "it has no angular maps"
    );
    ui.get_by_label("skylibs").click();
    clicked(&mut ui);
    ui.get_by_label_contains("--from angular --from-layout single --from-frame skylibs");
    // Another mapping forgets the frame that does not know it.
    click(&mut ui, Role::ComboBox, "mapping");
    click(&mut ui, Role::Button, "Octahedral");
    assert!(ui.query_by_label_contains("--from-frame").is_none());
    click(&mut ui, Role::Button, "Open");
    assert_eq!(file(&ui).hints.mapping, Some(MappingId::Octahedral));
    assert!(worst(&ui, |dir| dir) < CLOSE);
    // Without the pictures that the dialog kept the file would be missed.
    run(&mut ui, Command::Undo);
    run(&mut ui, Command::Redo);
    let told = ui.state().explorer().messages().last().unwrap();
    assert!(
        told.is_error && told.text.contains("cannot be read"),
        "{}",
        told.text
    );
}

#[test]
fn a_picture_of_no_known_shape_opens_when_the_user_says_what_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let laid = Laid {
        size: [3 * FACE, 2 * FACE - 1],
        ..Laid::new(MappingId::Octahedral, Layout::Single, 1)
    };
    let path = write(folder.path(), "odd.exr", &laid.map(photograph).rasters()[0]);
    let mut ui = open(small());
    run(&mut ui, Command::Open(path));
    // The refusal stands in the dialog, in its words and not in the command line's.
    ui.get_by_label_contains("has the shape of no known map; name its mapping and layout");
    assert!(ui.query_by_label_contains("--from").is_none());
    click(&mut ui, Role::Button, "Open");
    assert!(is_asked(&ui, "odd.exr"), "there is nothing to open yet");
    click(&mut ui, Role::ComboBox, "mapping");
    click(&mut ui, Role::Button, "Equi-angular cube");
    ui.get_by_label_contains("cannot be `eac`; name another mapping or layout");
    click(&mut ui, Role::ComboBox, "mapping");
    click(&mut ui, Role::Button, "Octahedral");
    assert!(ui.query_by_label_contains("name another mapping").is_none());
    click(&mut ui, Role::Button, "Open");
    assert_eq!(file(&ui).hints.layout, Some(Layout::Single));
    assert!(worst(&ui, |dir| dir) < CLOSE);
}

#[test]
fn faces_are_said_one_by_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = cross(folder.path(), "turned.exr", "+x,-x,+y:180,-y,+z,-z");
    let mut ui = open(small());
    run(&mut ui, Command::Open(path));
    assert!(is_asked(&ui, "turned.exr"));
    assert!(ui.query_by_label("picture +y shows").is_none());
    click(&mut ui, Role::CheckBox, "say what each face shows");
    let combo = |ui: &mut Ui, label: &str, choice: &str| {
        click(ui, Role::ComboBox, label);
        ui.get_by_role_and_label(Role::Button, choice).click();
        clicked(ui);
    };
    combo(&mut ui, "picture +x shows", "-z");
    ui.get_by_label_contains("--arrange -z,-x,+y,-y,+z,+x");
    combo(&mut ui, "picture +x shows", "+x");
    combo(&mut ui, "picture +y lies", "turned by 180°");
    ui.get_by_label_contains("--arrange +x,-x,+y:180,-y,+z,-z");
    click(&mut ui, Role::Button, "Open");
    assert!(worst(&ui, |dir| dir) < CLOSE);
}

#[test]
fn a_scene_whose_file_is_not_certain_asks_and_one_that_says_it_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let path = square(folder.path(), "square.exr");
    let old = format!(r#"{{"schema": 3, "environment": {{"file": {:?}}}}}"#, path);
    let old = AppState::from_json(&old).unwrap();
    assert_eq!(old.environment, Environment::File(path.clone().into()));
    assert_eq!(old.schema, SCHEMA);
    let with_budget = |state: AppState| AppState {
        texel_budget: small().texel_budget,
        panels: small().panels,
        ..state
    };
    let ui = open(with_budget(old.clone()));
    assert!(is_asked(&ui, "square.exr"));
    assert_eq!(state(&ui).environment, Environment::default());
    let mut said = MapFile::from(path);
    said.hints.mapping = Some(MappingId::Octahedral);
    let ui = open(with_budget(AppState {
        environment: Environment::File(said),
        ..old
    }));
    assert!(!is_asked(&ui, "square.exr"));
    assert!(worst(&ui, |dir| dir) < CLOSE);
}

#[test]
fn the_job_is_cancelled_with_its_dialog() {
    let folder = tempfile::tempdir().unwrap();
    let path = cross(
        folder.path(),
        "right.exr",
        &Arrangement::IDENTITY.to_string(),
    );
    let mut ui = open(small());
    run(&mut ui, Command::Open(path));
    let before = state(&ui).clone();
    ui.get_by_role_and_label(Role::Button, "How it is read …")
        .click();
    let ctx = ui.ctx.clone();
    let mut cancelled = false;
    for _ in 0..20 {
        ui.step();
        if let Some(job) = ui.state().explorer().jobs().first().cloned() {
            assert!(
                job.title.contains("reading the environment"),
                "{}",
                job.title
            );
            ui.state_mut()
                .explorer_mut()
                .run(&ctx, Command::Cancel(job.id));
            cancelled = true;
            break;
        }
    }
    assert!(cancelled);
    settle(&mut ui);
    assert!(!is_asked(&ui, "right.exr"));
    assert_eq!(*state(&ui), before);
}

#[test]
fn the_dialog_is_whole_in_every_window_and_rests() {
    let folder = tempfile::tempdir().unwrap();
    let path = cross(folder.path(), "exchanged.exr", "+z,-x,+y,-y,+x,-z");
    for (width, height) in [(1280.0, 800.0), (800.0, 600.0)] {
        let mut ui = open_sized(small(), width, height);
        run(&mut ui, Command::Open(path.clone()));
        for label in ["Open", "Cancel", "Copy the line"] {
            let rect = ui.get_by_role_and_label(Role::Button, label).rect();
            assert!(
                rect.max.y < height && rect.min.x > 0.0,
                "{label}: {rect:?} in {width} x {height}"
            );
        }
        let picture =
            ui.get_by_role_and_label(Role::Image, "The labelled environment, the right way round");
        let rect = picture.rect();
        assert!(
            rect.max.x < width && rect.max.y < height - 100.0,
            "{rect:?}"
        );
        assert!(rect.height() > 150.0, "{rect:?}");
        assert!(window_kit::rests(&mut ui));
        for (width, height) in [(300.0, 200.0), (1.0, 1.0)] {
            ui.set_size(egui::vec2(width, height));
            settle(&mut ui);
        }
    }
}
