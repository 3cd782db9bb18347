//! Materials, figures and models in the window, by role and label.

#![cfg(feature = "explorer")]

mod window_kit;

use std::path::Path;

use egui_kittest::kittest::Queryable;
use sixfold::app::action::Action;
use sixfold::app::command::Command;
use sixfold::app::figures::{Figure, Optics};
use sixfold::app::state::AppState;
use sixfold::optics::Material;
use sixfold::optics::material::{BallPicture, Surface, Surfaces, View};
use sixfold::scene::Object;
use window_kit::{Ui, open, run, settle, small};

fn state(ui: &Ui) -> &AppState {
    ui.state().explorer().state()
}

/// As a user does it: what lies below the fold is scrolled to.
fn click(ui: &mut Ui, label: &str) {
    ui.get_by_label(label).scroll_to_me();
    settle(ui);
    ui.get_by_label(label).click();
    settle(ui);
}

/// Lookups that the object's pixels make, left of the divider.
fn lookups(ui: &Ui) -> (u32, u32) {
    let work = ui.state().explorer().report().object[0];
    (work.reflected, work.refracted)
}

fn set(ui: &mut Ui, material: Material) {
    run(ui, Action::SetMaterial(Box::new(material)));
}

/// The newest message.
fn told(ui: &Ui) -> String {
    let messages = ui.state().explorer().messages();
    messages.last().map_or(String::new(), |m| m.text.clone())
}

#[test]
fn a_kind_is_chosen_by_its_label_and_the_status_says_what_it_costs() {
    let mut ui = open(small());
    assert_eq!(lookups(&ui), (1, 0));
    ui.get_by_label_contains("refraction skipped");
    click(&mut ui, "kind");
    click(&mut ui, "glass with dispersion");
    assert_eq!(state(&ui).material.surface, Surface::Glass);
    assert_eq!(lookups(&ui), (1, 16));
    ui.get_by_label_contains("1 + 16 lookups a pixel");
    assert!(ui.query_by_label_contains("refraction skipped").is_none());
    // Only what the kind has is shown.
    ui.get_by_role_and_label(egui::Role::Slider, "wavelengths");
    assert!(ui.query_by_label("metal").is_none());
    let discriminant = Material {
        view: View::Discriminant,
        ..state(&ui).material.clone()
    };
    set(&mut ui, discriminant);
    assert_eq!(lookups(&ui), (0, 0));
    ui.get_by_label_contains("no lookup");
}

#[test]
fn a_preset_is_one_choice_and_undo_takes_it_back() {
    let mut ui = open(small());
    click(&mut ui, "preset");
    click(&mut ui, "gold");
    assert_eq!(state(&ui).material.surface, Surface::Metal);
    run(&mut ui, Command::Undo);
    assert_eq!(state(&ui).material, Material::default());
}

#[test]
fn every_figure_is_two_clicks_away() {
    for figure in [
        Optics::Reflection,
        Optics::Discriminant,
        Optics::Transparency,
    ]
    .map(Figure::Optics)
    {
        let mut ui = open(small());
        let mut expected = state(&ui).clone();
        figure.show(&mut expected);
        assert_ne!(expected, *state(&ui), "{figure:?}");
        click(&mut ui, "Figures");
        for each in Figure::all() {
            ui.get_by_label(each.title());
        }
        click(&mut ui, figure.title());
        assert_eq!(state(&ui).material, expected.material, "{figure:?}");
        assert_eq!(state(&ui).compare_material, expected.compare_material);
    }
}

#[test]
fn a_body_is_traced_in_a_job_and_shown_when_it_is_there() {
    let mut ui = open(small());
    let glass = |surfaces| Material {
        surface: Surface::Dielectric,
        surfaces,
        ..Material::default()
    };
    set(&mut ui, glass(Surfaces::One));
    assert_eq!(lookups(&ui), (1, 1));
    let one = ui.render().unwrap();
    set(&mut ui, glass(Surfaces::Both));
    assert_eq!(lookups(&ui), (1, 3));
    let both = ui.render().unwrap();
    let viewport = ui.get_by_label("The viewport").rect();
    let changed = |x: u32, y: u32| {
        let inside = viewport.contains(egui::pos2(x as f32, y as f32));
        let differs = (0..3).any(|i| one[(x, y)].0[i].abs_diff(both[(x, y)].0[i]) > 12);
        inside && differs
    };
    let count = both
        .enumerate_pixels()
        .filter(|(x, y, _)| changed(*x, *y))
        .count();
    assert!(count > 1000, "{count}");
    // Another view is traced anew; a ball needs no tracing.
    run(&mut ui, Action::Zoom(1.1));
    assert_eq!(lookups(&ui), (1, 3));
    run(&mut ui, Action::SetObject(Object::Sphere));
    assert!(!ui.state().explorer().is_busy());
    assert_eq!(lookups(&ui), (1, 3));
}

#[test]
fn two_materials_are_kept_beside_each_other() {
    let mut ui = open(small());
    click(&mut ui, "keep this material at the right");
    assert_eq!(state(&ui).compare_material, Some(Material::default()));
    ui.get_by_label("Divider between the mappings");
    set(
        &mut ui,
        Material {
            view: View::Discriminant,
            surface: Surface::Dielectric,
            ..Material::default()
        },
    );
    assert_eq!(ui.state().explorer().report().object.len(), 2);
    click(&mut ui, "keep this material at the right");
    assert_eq!(state(&ui).compare_material, None);
    assert_eq!(ui.state().explorer().report().object.len(), 1);
}

#[test]
fn a_model_is_opened_and_a_bad_one_leaves_the_scene() {
    const TETRAHEDRON: &str = "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\n\
                               f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let good = write("tetrahedron.obj", TETRAHEDRON);
    let bad = write("bad.obj", "v 0 0 0\nf 1 2 3\n");
    let mut ui = open(small());
    run(&mut ui, Command::Open(bad.clone()));
    assert_eq!(state(&ui).model, None, "{}", told(&ui));
    assert!(
        told(&ui).contains("bad.obj") && told(&ui).lines().count() == 1,
        "{}",
        told(&ui)
    );
    run(&mut ui, Command::Open(good.clone()));
    assert_eq!(
        state(&ui).model.as_deref(),
        Some(good.as_path()),
        "{}",
        told(&ui)
    );
    let shown = ui
        .get_by_role_and_label(egui::Role::ComboBox, "object")
        .value();
    assert_eq!(shown.as_deref(), Some("tetrahedron.obj"));
    // A bad one after a good one: the good one stays, and so it does after a load that is taken back.
    run(&mut ui, Command::Open(bad));
    assert_eq!(state(&ui).model.as_deref(), Some(good.as_path()));
    run(&mut ui, Action::SetObject(Object::Torus));
    assert_eq!(state(&ui).model, None);
    run(&mut ui, Command::Undo);
    assert_eq!(state(&ui).model.as_deref(), Some(good.as_path()));
    // A model that is gone when its scene is opened again.
    std::fs::remove_file(&good).unwrap();
    let mut later = open(state(&ui).clone());
    settle(&mut later);
    assert_eq!(state(&later).model, None);
    assert!(told(&later).contains("tetrahedron.obj"), "{}", told(&later));
}

#[test]
fn a_balls_picture_is_opened_and_a_bad_one_told() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("ball.png");
    image::RgbImage::from_pixel(8, 8, image::Rgb([250, 20, 30]))
        .save(&picture)
        .unwrap();
    let flat = folder.path().join("flat.png");
    image::RgbImage::new(8, 4).save(&flat).unwrap();
    let ball = |path: &Path| Material {
        surface: Surface::Ball,
        ball: BallPicture::File(path.to_owned()),
        ..Material::default()
    };
    let mut ui = open(small());
    set(&mut ui, ball(&picture));
    let middle = ui.get_by_label("The viewport").rect().center();
    let shown = ui.render().unwrap()[(middle.x as u32, middle.y as u32)].0;
    assert!(shown[0] > 240 && shown[1] < 40, "{shown:?}");
    set(&mut ui, ball(&flat));
    assert!(told(&ui).contains("8 x 4"), "{}", told(&ui));
    assert_eq!(state(&ui).material.ball, BallPicture::Outline);
}

#[test]
fn a_view_that_is_too_large_to_trace_is_told_once_and_the_window_rests() {
    let mut scene = small();
    scene.material = Material {
        surface: Surface::Dielectric,
        surfaces: Surfaces::Both,
        bounces: 6,
        ..Material::default()
    };
    // Two sides that differ: what is refused is their sum.
    scene.compare_material = Some(Material {
        index: 2.0,
        ..scene.material.clone()
    });
    let mut ui = window_kit::open_sized(scene, 3200.0, 2000.0);
    assert!(told(&ui).contains("the limit is 512"), "{}", told(&ui));
    let before = ui.state().explorer().messages().len();
    settle(&mut ui);
    assert!(!ui.state().explorer().is_busy());
    assert_eq!(ui.state().explorer().messages().len(), before);
    // Control: with fewer inner reflections the same view is traced.
    run(&mut ui, Action::SetCompareMaterial(None));
    let fewer = Material {
        bounces: 0,
        ..state(&ui).material.clone()
    };
    set(&mut ui, fewer);
    assert_eq!(lookups(&ui), (1, 1));
    ui.get_by_label_contains("dispersion skipped");
}
