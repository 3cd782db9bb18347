//! The panes about optics by role and label: curves and ray story, and what they draw over viewport and panels.

#![cfg(feature = "explorer")]
#![expect(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod window_kit;

use egui_kittest::kittest::{NodeT as _, Queryable};
use sixfold::app::action::Action;
use sixfold::app::arrangement::Pane;
use sixfold::app::state::{AppState, EyeRay, StoryKind, StoryState};
use sixfold::app::theme;
use sixfold::mapping::MappingId;
use sixfold::math::Vec3;
use sixfold::optics::material::{Material, Surface};
use sixfold::optics::{Formula, critical_angle_rad};
use sixfold::scene::Object;
use window_kit::{Ui, open_sized, place, run, settle, small};

/// Both panes open on a glassy ball that is met in (0.6, 0, -0.8), seen from the side.
fn scene(kind: StoryKind, step: usize) -> AppState {
    let mut state = small();
    state.object = Object::Sphere;
    state.camera.yaw_rad = -0.9;
    state.material.surface = Surface::Dielectric;
    state.eye_ray = Some(EyeRay {
        origin: [0.6, 0.0, -3.2],
        dir: [0.0, 0.0, 1.0],
        is_right: false,
    });
    state.probe = [0.96, 0.0, -0.28];
    state.probe_follows = false;
    // Room for all of both panes.
    state.controls_open = false;
    state.inspector.open = false;
    state.curves_open = true;
    state.story = StoryState {
        open: true,
        kind,
        step,
    };
    state
}

fn open(state: AppState) -> Ui {
    open_sized(state, 1440.0, 1200.0)
}

fn state(ui: &Ui) -> &AppState {
    ui.state().explorer().state()
}

fn click(ui: &mut Ui, label: &str) {
    ui.get_by_label(label).click();
    settle(ui);
}

/// Pixels of about this colour in a part of the window.
fn count(ui: &mut Ui, rect: egui::Rect, color: egui::Color32) -> usize {
    let picture = ui.render().unwrap();
    let [r, g, b, _] = color.to_array();
    let is_near = |p: &image::Rgba<u8>| {
        let [pr, pg, pb, _] = p.0;
        pr.abs_diff(r) < 6 && pg.abs_diff(g) < 6 && pb.abs_diff(b) < 6
    };
    let inside = |x: u32, y: u32| rect.contains(egui::pos2(x as f32 + 0.5, y as f32 + 0.5));
    picture
        .enumerate_pixels()
        .filter(|(x, y, p)| inside(*x, *y) && is_near(p))
        .count()
}

fn around(at: egui::Pos2, radius: f32) -> egui::Rect {
    egui::Rect::from_center_size(at, egui::Vec2::splat(2.0 * radius))
}

#[test]
fn the_panes_open_from_the_menu_and_close_again() {
    // The controls have the same checkboxes.
    let mut ui = open(AppState {
        controls_open: false,
        ..small()
    });
    for (name, pane, content) in [
        ("Reflectance curves", Pane::Curves, "Brewster's angle"),
        ("Ray story", Pane::Story, "step 1 of 5"),
    ] {
        assert!(ui.query_by_label_contains(content).is_none(), "{name}");
        click(&mut ui, "View");
        click(&mut ui, name);
        ui.key_press(egui::Key::Escape);
        settle(&mut ui);
        assert!(state(&ui).is_open(pane));
        ui.get_by_label_contains(content);
    }
    run(&mut ui, Action::SetPaneOpen(Pane::Curves, false));
    assert!(ui.query_by_label_contains("Brewster's angle").is_none());
    assert_eq!(ui.state().explorer().messages(), []);
}

#[test]
fn stepping_changes_title_numbers_and_undo_leaves_by_one() {
    let mut ui = open(scene(StoryKind::Ray, 0));
    ui.get_by_label("The eye ray");
    ui.get_by_label("step 1 of 9");
    click(&mut ui, "Next");
    ui.get_by_label("step 2 of 9");
    ui.get_by_label("The hit");
    ui.get_by_label_contains("2.40");
    assert!(ui.query_by_label("The eye ray").is_none());
    for (key, title) in [
        (egui::Key::Period, "The normal"),
        (egui::Key::PageDown, "The reflected ray"),
        (egui::Key::Comma, "The normal"),
        (egui::Key::PageUp, "The hit"),
    ] {
        ui.key_press(key);
        settle(&mut ui);
        ui.get_by_label(title);
    }
    // Held down, the key stops at the end; one step back is one step back.
    for _ in 0..12 {
        ui.key_press(egui::Key::Period);
        ui.step();
    }
    settle(&mut ui);
    ui.get_by_label("The mix");
    assert!(ui.get_by_label("Next").accesskit_node().is_disabled());
    assert!(!ui.get_by_label("Previous").accesskit_node().is_disabled());
    ui.key_press(egui::Key::Comma);
    settle(&mut ui);
    ui.get_by_label("step 8 of 9");
    // One undo takes the whole walk back.
    ui.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    settle(&mut ui);
    ui.get_by_label("The eye ray");
    // With the pane closed the keys do nothing.
    let closed = StoryState {
        open: false,
        ..state(&ui).story
    };
    run(&mut ui, Action::SetStory(closed));
    ui.key_press(egui::Key::Period);
    settle(&mut ui);
    assert_eq!(state(&ui).story, closed);
}

#[test]
fn a_story_without_a_hit_says_what_to_do() {
    let mut ui = open(AppState {
        eye_ray: None,
        ..scene(StoryKind::Ray, 3)
    });
    ui.get_by_label_contains("Point at the object");
    assert!(ui.query_by_label("Next").is_none());
    // The other story needs no hit.
    click(&mut ui, "The sphere map");
    ui.get_by_label("step 1 of 8");
    ui.get_by_label("The viewer and the ball");
}

#[test]
fn every_panel_marks_what_the_step_looks_up() {
    let mut ui = open(scene(StoryKind::Ray, 3));
    let reflected = theme::VECTORS[2];
    let dir = Vec3::new(0.96, 0.0, -0.28);
    let marked = |ui: &mut Ui, mapping| {
        let at = place(ui, mapping, dir);
        count(ui, around(at, 6.0), reflected)
    };
    for &mapping in &MappingId::ALL[..6] {
        assert_eq!(marked(&mut ui, mapping), 0, "{mapping} before the lookup");
    }
    click(&mut ui, "Next");
    ui.get_by_label("Its lookup");
    for &mapping in &MappingId::ALL[..6] {
        // A dot of radius 3.5 has 38 pixels.
        let found = marked(&mut ui, mapping);
        assert!((20..60).contains(&found), "{mapping}: {found}");
    }
}

#[test]
fn the_viewport_shows_the_steps_arrows() {
    let mut ui = open(scene(StoryKind::Ray, 5));
    let view = ui.get_by_label("The viewport").rect();
    let purple = theme::REFRACTED;
    assert_eq!(count(&mut ui, view, purple), 0);
    click(&mut ui, "Next");
    ui.get_by_label("The refracted ray");
    let found = count(&mut ui, view, purple);
    assert!(found > 50, "{found} pixels of the refracted ray");
    // A bare picture has no arrows.
    let overlays = sixfold::app::state::Overlays::NONE;
    run(&mut ui, Action::SetOverlays(overlays));
    assert_eq!(count(&mut ui, view, purple), 0);
}

#[test]
fn the_singular_direction_becomes_the_whole_rim() {
    let mut ui = open(scene(StoryKind::SphereMap, 6));
    let value = |ui: &Ui| ui.query_all_by_label_contains("+ 1/2 = 0.").count();
    assert_eq!(value(&ui), 2, "s and t");
    click(&mut ui, "Go to the singular direction");
    assert_eq!(state(&ui).probe, [0.0, 0.0, 1.0]);
    assert_eq!(value(&ui), 0);
    let dots = |ui: &mut Ui| {
        (0..16)
            .filter(|i| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(*i) / 16.0).sin_cos();
                let dir = Vec3::new(0.01 * cos, 0.01 * sin, 1.0).normalized();
                let at = place(ui, MappingId::Sphere, dir);
                count(ui, around(at, 5.0), theme::TEXEL) > 15
            })
            .count()
    };
    // The probe's own texel lies on the rim, too.
    assert!(dots(&mut ui) < 8);
    click(&mut ui, "Next");
    ui.get_by_label("The singular direction");
    assert_eq!(dots(&mut ui), 16);
}

#[test]
fn the_curves_mark_the_critical_angle_and_follow_the_pointer() {
    let mut ui = open(scene(StoryKind::Ray, 0));
    ui.get_by_label_contains("no total reflection");
    ui.get_by_label("at 36.9°");
    click(&mut ui, "from inside");
    let eta = 1.0 / f64::from(Material::default().eta());
    let critical = critical_angle_rad(eta).unwrap().to_degrees();
    ui.get_by_label_contains(&format!("critical angle {critical:.2}°"));
    // The ray moves, and its angle with it.
    run(
        &mut ui,
        Action::SetProbe {
            dir: [0.0, 0.0, -1.0],
            eye_ray: Some(EyeRay {
                origin: [0.0, 0.0, -3.2],
                dir: [0.0, 0.0, 1.0],
                is_right: false,
            }),
        },
    );
    assert!(ui.query_by_label("at 36.9°").is_none());
    ui.get_by_label("at 0.0°");
}

#[test]
fn a_curve_is_computed_when_it_is_drawn_and_a_row_chooses_the_formula() {
    let mut state_at_first = scene(StoryKind::Ray, 0);
    state_at_first.story.open = false;
    let mut ui = open(state_at_first);
    // Largest errors: Schlick's alone is shown.
    let errors = |ui: &Ui| {
        let rows = ui.query_all_by_label_contains("°").count();
        let draw = ui.get_by_label("Draw Cg tutorial");
        // How many values are kept for the next frame, which only its text tells; the curves are among them.
        let kept = ui.ctx.memory(|memory| format!("{:?}", memory.caches));
        let mut count = kept.split_whitespace().filter_map(|word| word.parse().ok());
        let kept: usize = count.next_back().unwrap();
        (rows, kept, draw.accesskit_node().toggled())
    };
    let (before, kept_before, off) = errors(&ui);
    click(&mut ui, "Draw Cg tutorial");
    let (after, kept_after, on) = errors(&ui);
    assert_eq!(after, before + 1, "the angle of its largest error");
    assert_eq!(kept_after, kept_before + 1, "one curve more");
    assert_ne!(on, off);
    assert!(state(&ui).curves.shown.contains(&Formula::Cg));
    click(&mut ui, "Draw Cg tutorial");
    assert_eq!(errors(&ui), (before, kept_before, off));
    assert_eq!(state(&ui).material.formula, Formula::Fresnel);
    let row = ui
        .query_all_by_label("Cg tutorial")
        .find(|node| node.accesskit_node().role() == egui::accesskit::Role::Button)
        .unwrap();
    row.click();
    settle(&mut ui);
    assert_eq!(state(&ui).material.formula, Formula::Cg);
}

#[test]
fn a_metal_has_three_channels() {
    let mut state = scene(StoryKind::Ray, 5);
    state.material.surface = Surface::Metal;
    let ui = open(state);
    for channel in ["red", "green", "blue"] {
        ui.get_by_label(&format!("{channel}, exact"));
        ui.get_by_label(&format!("{channel}, Schlick"));
    }
    assert!(ui.query_by_label("Draw Schlick").is_none());
    ui.get_by_label("The metal's tint");
}

#[test]
fn the_panes_are_still_and_bear_any_size() {
    for kind in [StoryKind::Ray, StoryKind::SphereMap] {
        let mut ui = open(scene(kind, 4));
        let drawn = ui.state().explorer().report().totals.submissions;
        assert!(window_kit::rests(&mut ui), "a still pane asks for frames");
        assert_eq!(ui.state().explorer().report().totals.submissions, drawn);
        for (width, height) in [(300.0, 200.0), (40.0, 30.0), (1.0, 1.0), (1280.0, 800.0)] {
            ui.set_size(egui::vec2(width, height));
            settle(&mut ui);
        }
        assert_eq!(ui.state().explorer().messages(), []);
    }
    // Alone in a small window, as in a corner of a large one.
    for (pane, label) in [(Pane::Curves, "Draw Fresnel, s"), (Pane::Story, "Next")] {
        let mut state = scene(StoryKind::Ray, 4);
        state.maximised = Some(pane);
        state.controls_open = false;
        state.inspector.open = false;
        let mut ui = open_sized(state, 340.0, 300.0);
        let rect = ui.get_by_label(label).rect();
        let window = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(340.0, 300.0));
        assert!(window.contains_rect(rect), "{label} at {rect:?}");
        // The way back is not painted over: its letters are seen.
        let back = ui.get_by_label("Show all panels").rect();
        assert!(count(&mut ui, back, egui::Color32::from_gray(225)) > 20);
    }
}
