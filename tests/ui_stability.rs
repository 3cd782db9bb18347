//! The stability pane in the window: the table is measured when it is asked for, a cell leads to its worst input, and the
//! microscope shows the literature's faults.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod window_kit;

use egui_kittest::kittest::Queryable;
use sixfold::app::action::{Action, apply};
use sixfold::app::arrangement::Pane;
use sixfold::app::command::Command;
use sixfold::app::picture::What;
use sixfold::app::state::{AppState, LENGTHS, StabilityState};
use sixfold::imaging::Progress;
use sixfold::lab::stress::microscope::{Lengths, Picture, SPAN_DEG, Verdict};
use sixfold::lab::stress::places::PLACES;
use sixfold::lab::stress::{Family, Measure, Standing};
use sixfold::mapping::MappingId;
use sixfold::math::{Vec3, angle_rad};
use window_kit::{Ui, WINDOW_SIZES, click_at, open, probe, run, settle, small};

/// The pane alone, on a mapping with few evaluators.
fn pane(stability: StabilityState) -> AppState {
    AppState {
        mapping: MappingId::Sphere,
        maximised: Some(Pane::Stability),
        stability: StabilityState {
            open: true,
            ..stability
        },
        ..small()
    }
}

fn picture(ui: &Ui) -> &Picture {
    &ui.state()
        .explorer()
        .labs()
        .stability
        .shown()
        .unwrap()
        .picture
}

fn state(ui: &Ui) -> &StabilityState {
    &ui.state().explorer().state().stability
}

fn microscope(ui: &Ui) -> egui::Rect {
    ui.get_by_label("Microscope").rect()
}

#[test]
fn nothing_is_measured_unasked_and_a_cell_leads_to_its_worst_input() {
    let mut ui = open(pane(StabilityState {
        measure: Measure::NotFinite,
        ..StabilityState::default()
    }));
    ui.get_by_label("not measured yet");
    assert!(
        ui.state()
            .explorer()
            .labs()
            .stability
            .table(MappingId::Sphere)
            .is_none()
    );
    ui.get_by_role_and_label(egui::Role::Button, "Measure")
        .click();
    settle(&mut ui);
    ui.get_by_label("every promise is kept");
    let table = ui
        .state()
        .explorer()
        .labs()
        .stability
        .table(MappingId::Sphere)
        .unwrap();
    let evaluators = MappingId::Sphere.evaluators().len();
    assert_eq!(table.rows.len(), evaluators * Family::ALL.len());
    let row = table
        .rows
        .iter()
        .find(|row| row.evaluator == "short-m" && row.family == Family::Borders)
        .unwrap();
    assert_eq!(row.standing(Measure::NotFinite), Standing::Known);
    let worst = row.worst_of[Measure::NotFinite as usize].unwrap();
    let count = row.observed.not_finite;
    // The known fault has a sign beside its colour.
    let cell = format!("short-m on borders: ×{count}");
    let before = probe(&ui).to_f64();
    assert!(angle_rad(before, worst.map(f64::from)) > 1e-3, "control");
    ui.get_by_label(&cell).click();
    settle(&mut ui);
    assert!(angle_rad(probe(&ui).to_f64(), worst.map(f64::from)) < 1e-6);
    assert!(!ui.state().explorer().state().probe_follows);
    let looked = state(&ui).clone();
    assert_eq!(looked.evaluator, "short-m");
    assert!(angle_rad(looked.center, worst.map(f64::from)) < 1e-12);
    // In the middle is the fault.
    let view = picture(&ui).view;
    let middle = picture(&ui)
        .at([view.size[0] / 2, view.size[1] / 2])
        .unwrap();
    assert_eq!(middle.verdict, Verdict::NotFinite, "{middle:?} {view:?}");
    // Of another mapping nothing has been measured.
    run(&mut ui, Action::SetMapping(MappingId::Cube));
    ui.get_by_label("not measured yet");
    assert_eq!(picture(&ui).view.map, MappingId::Cube);
    assert_eq!(picture(&ui).view.evaluator, "f32");
    assert!(window_kit::rests(&mut ui));
}

#[test]
fn one_click_goes_to_each_finding() {
    let mut ui = open(pane(StabilityState::default()));
    for place in [&PLACES[0], &PLACES[6], &PLACES[8]] {
        ui.get_by_label_contains("Go to a finding").click();
        settle(&mut ui);
        ui.get_by_label(place.title).click();
        settle(&mut ui);
        assert_eq!(ui.state().explorer().state().mapping, place.map);
        let seen = picture(&ui);
        assert_eq!(seen.view.evaluator, place.evaluator);
        assert!(seen.count(place.verdict) > 0, "{}", place.title);
        let dir = Vec3::<f64>::from_f64(place.center).normalized();
        assert!(angle_rad(probe(&ui).to_f64(), dir.to_f64()) < 1e-6);
    }
    // The black disc is told in words.
    ui.get_by_label_contains("Go to a finding").click();
    settle(&mut ui);
    ui.get_by_label(PLACES[0].title).click();
    settle(&mut ui);
    ui.get_by_label_contains("hole: no chart: ");
    ui.get_by_label("computed one by one");
    assert_eq!(ui.state().explorer().messages(), []);
}

#[test]
fn the_wheel_zooms_at_the_pointer_and_a_drag_pans() {
    let mut ui = open(pane(StabilityState::default()));
    let rect = microscope(&ui);
    let at = rect.center() + egui::vec2(40.0, -30.0);
    let under = |ui: &Ui| {
        let view = picture(ui).view;
        let scale = view.size[0] as f32 / rect.width();
        let place = [(at.x - rect.left()) * scale, (at.y - rect.top()) * scale];
        view.directions()(place.map(f64::from))
    };
    let (before, span) = (under(&ui), state(&ui).span_deg);
    let first = state(&ui).clone();
    ui.hover_at(at);
    ui.step();
    ui.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: egui::vec2(0.0, 200.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: egui::Modifiers::NONE,
    });
    ui.run_steps(40);
    settle(&mut ui);
    let nearer = state(&ui).span_deg;
    assert!(nearer < 0.6 * span, "{nearer}");
    let pitch = picture(&ui).view.pitch();
    let moved = angle_rad(under(&ui), before);
    assert!(moved < 0.5 * pitch, "{moved:e} of {pitch:e}");
    // A drag moves what is under the pointer along.
    let center = state(&ui).center;
    ui.drag_at(at);
    ui.step();
    for k in 1..=5 {
        ui.hover_at(at + egui::vec2(12.0 * k as f32, 0.0));
        ui.step();
    }
    ui.drop_at(at + egui::vec2(60.0, 0.0));
    settle(&mut ui);
    let moved = angle_rad(state(&ui).center, center);
    let points = f64::from(rect.width()) / picture(&ui).view.size[0] as f64;
    let expected = 60.0 / points * pitch;
    assert!(
        (moved / expected - 1.0).abs() < 0.1,
        "{moved:e} of {expected:e}"
    );
    assert_eq!(state(&ui).span_deg, nearer);
    // A click puts the probe there.
    let place = rect.center() + egui::vec2(-50.0, 20.0);
    click_at(&mut ui, place);
    let found = angle_rad(probe(&ui).to_f64(), state(&ui).center);
    let away = 2900f64.sqrt() / points * pitch;
    // The probe is f32.
    assert!(
        (found - away).abs() < 1e-7 + 0.02 * away,
        "{found:e} {away:e}"
    );
    run(&mut ui, Command::Undo);
    // One undo takes back all that was done until the button was released.
    assert_eq!(*state(&ui), first);
}

#[test]
fn the_state_is_kept_and_brought_into_range() {
    let mut state = AppState::default();
    let wild = StabilityState {
        open: true,
        measure: Measure::SeamJump,
        evaluator: "no such".to_owned(),
        center: [f64::NAN, 0.0, 0.0],
        span_deg: f64::INFINITY,
        lengths: Lengths::Sphere(-1.0),
    };
    apply(&mut state, Action::SetStability(Box::new(wild)));
    let kept = state.stability.clone();
    assert_eq!(kept.span_deg, SPAN_DEG[1]);
    assert_eq!(kept.lengths, Lengths::Sphere(LENGTHS.0));
    assert_eq!(kept.clone().sanitized(), kept);
    assert_eq!(kept.evaluator_of(MappingId::Ccm).unwrap().id, "f32");
    let json = state.to_json().unwrap();
    assert!(json.contains(r#""measure": "seam-jump""#), "{json}");
    assert_eq!(AppState::from_json(&json).unwrap(), state);
    // Tiny and huge directions keep their way; a scene from before shows the first finding.
    for size in [1e-300, 1.0, 1e300] {
        let stability = StabilityState {
            center: [0.0, 3.0 * size, -4.0 * size],
            ..StabilityState::default()
        };
        let center = stability.sanitized().center;
        assert!((center[1] - 0.6).abs() < 1e-15 && (center[2] + 0.8).abs() < 1e-15);
    }
    let old = AppState::from_json(r#"{"schema": 2}"#).unwrap();
    assert_eq!(old.stability, StabilityState::default());
    assert!(!old.stability.open);
}

#[test]
fn a_hidden_microscope_does_not_look() {
    let mut ui = open(pane(StabilityState::default()));
    let before = picture(&ui).clone();
    let further = StabilityState {
        open: true,
        span_deg: 1.0,
        ..state(&ui).clone()
    };
    run(&mut ui, Action::SetMaximised(Some(Pane::Viewport)));
    run(&mut ui, Action::SetStability(Box::new(further)));
    assert!(*picture(&ui) == before, "looked while hidden");
    run(&mut ui, Action::SetMaximised(Some(Pane::Stability)));
    assert!(*picture(&ui) != before, "control");
    assert_eq!(picture(&ui).view.span_deg, 1.0);
    // The viewport goes there too.
    ui.get_by_role_and_label(egui::Role::Button, "Turn the viewport there")
        .click();
    settle(&mut ui);
    let explorer = ui.state().explorer();
    let eye = explorer.state().camera.eye().to_array().map(f64::from);
    assert!(angle_rad(eye, explorer.state().stability.center) < 1e-3);
}

#[test]
fn nothing_is_clipped_or_fails_when_tiny() {
    let mut ui = open(pane(StabilityState::default()));
    ui.get_by_role_and_label(egui::Role::Button, "Measure")
        .click();
    settle(&mut ui);
    for (width, height) in WINDOW_SIZES {
        ui.set_size(egui::vec2(width, height));
        for pane in [None, Some(Pane::Stability)] {
            run(&mut ui, Action::SetMaximised(pane));
            if width >= 800.0 {
                let rect = microscope(&ui);
                let least = if pane.is_some() { 150.0 } else { 60.0 };
                assert!(
                    rect.width() > least && rect.height() > 60.0,
                    "{rect:?} in {width}"
                );
            }
        }
    }
    assert_eq!(ui.state().explorer().messages(), []);
}

#[test]
fn its_picture_is_drawn_without_a_window() {
    use sixfold::app::model::Surroundings;
    use sixfold::app::picture::{Destination, PictureRequest, draw};
    use std::sync::Arc;
    let gpu = sixfold::gpu::Gpu::headless().unwrap();
    let state = AppState {
        mapping: MappingId::Ccm,
        ..pane(StabilityState::default())
    };
    let environment = state.environment.clone();
    let surroundings = Surroundings {
        loaded: Arc::new(environment.image(&Progress::new()).unwrap()),
        environment,
    };
    let request = PictureRequest {
        what: What::Microscope,
        size: [640, 500],
        overlays: false,
        to: Destination::Clipboard,
    };
    let drawn = draw(&gpu, &state, surroundings, &request, &Progress::new()).unwrap();
    let at = |x: usize, y: usize| drawn.rgba[4 * (640 * y + x)..][..3].to_vec();
    // Four of five pixels in the middle of the disc are black, and none far outside.
    let black = |x: usize, y: usize| {
        (0..100)
            .filter(|k| at(x + k % 10, y + k / 10) == [0; 3])
            .count()
    };
    assert!(black(315, 214) > 50, "{}", black(315, 214));
    assert_eq!(black(60, 200), 0);
}
