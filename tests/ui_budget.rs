//! The equal texel budget in the window: two maps with as many texels on the same object, the same place in both, and numbers
//! that say which is finer.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod window_kit;

use egui_kittest::kittest::Queryable;
use sixfold::app::action::{Action, apply};
use sixfold::app::arrangement::Pane;
use sixfold::app::budget::{MOST_PIXELS, Shown, Wanted};
use sixfold::app::picture::What;
use sixfold::app::state::{AppState, BudgetState, COMPARED_TEXELS};
use sixfold::imaging::{Environment, Progress};
use sixfold::lab::equal_budget::MapSize;
use sixfold::mapping::MappingId;
use sixfold::math::angle_rad;
use sixfold::scene::Object;
use window_kit::{Ui, WINDOW_SIZES, open, probe, run, settle, small};

/// The pane alone; the ball before labelled faces.
fn pane(budget: BudgetState) -> AppState {
    AppState {
        environment: Environment::LabelledFaces,
        object: Object::Sphere,
        maximised: Some(Pane::Budget),
        budget: BudgetState {
            open: true,
            ..budget
        },
        ..small()
    }
}

fn of(a: MappingId, b: MappingId, texels: u32) -> BudgetState {
    BudgetState {
        maps: [Some(a), Some(b)],
        texels,
        ..BudgetState::default()
    }
}

fn shown(ui: &Ui) -> (&Wanted, &Shown) {
    ui.state().explorer().labs().budget.shown().unwrap()
}

fn rms(ui: &Ui) -> [f64; 2] {
    shown(ui).1.rms.map(Option::unwrap)
}

fn picture(ui: &Ui, name: &str) -> egui::Rect {
    ui.get_by_label(&format!("Picture: {name}")).rect()
}

fn says(ui: &Ui, text: &str) -> bool {
    ui.query_all_by_label_contains(text).next().is_some()
}

#[test]
fn both_maps_have_as_many_texels_and_the_finer_one_is_named() {
    let mut ui = open(pane(of(
        MappingId::Latlong,
        MappingId::Octahedral,
        6 * 48 * 48,
    )));
    let (wanted, made) = shown(&ui);
    let [a, b] = wanted.maps;
    assert_eq!(
        (a.mapping, b.mapping),
        (MappingId::Latlong, MappingId::Octahedral)
    );
    assert_eq!((a.texels(), b.texels()), (13_778, 13_924));
    // Two pictures beside each other, and three lights: of the maps and of the surroundings.
    let pixels = (wanted.size[0] * wanted.size[1]) as usize;
    assert!(made.light().iter().all(|light| light.len() == pixels));
    assert_ne!(made.light()[0], made.light()[1]);
    assert!(
        rms(&ui).iter().all(|rms| (1e-3..0.5).contains(rms)),
        "{:?}",
        rms(&ui)
    );
    assert!(says(&ui, "166×83 = 13778") && says(&ui, "118×118 = 13924"));
    assert!(says(&ui, "comes nearer to the environment"));
    // Four times as many texels come nearer.
    let few = rms(&ui);
    run(
        &mut ui,
        Action::SetBudget(BudgetState {
            open: true,
            ..of(MappingId::Latlong, MappingId::Octahedral, 4 * 6 * 48 * 48)
        }),
    );
    let many = rms(&ui);
    assert!((0..2).all(|k| many[k] < 0.8 * few[k]), "{few:?} {many:?}");
    // The same mapping twice is the same picture.
    run(
        &mut ui,
        Action::SetBudget(BudgetState {
            open: true,
            ..of(MappingId::Cube, MappingId::Cube, 6 * 48 * 48)
        }),
    );
    let light = shown(&ui).1.light();
    assert_eq!(light[0], light[1]);
    assert!(says(&ui, "both are as fine") && says(&ui, "both come as near"));
    // A disc's corners count.
    run(
        &mut ui,
        Action::SetBudget(BudgetState {
            open: true,
            ..of(MappingId::Sphere, MappingId::Cube, 6 * 48 * 48)
        }),
    );
    assert!(says(&ui, "beside a disc") && says(&ui, "21 %"));
    assert_eq!(ui.state().explorer().messages(), []);
    assert!(window_kit::rests(&mut ui));
}

#[test]
fn the_place_under_the_pointer_is_told_and_a_click_keeps_it() {
    let mut ui = open(pane(of(MappingId::Latlong, MappingId::Cube, 6 * 48 * 48)));
    assert!(says(&ui, "at the probe: "));
    let before = probe(&ui);
    let rect = picture(&ui, "B");
    // The sky above the object.
    let at = rect.center_top() + egui::vec2(0.0, 4.0);
    ui.hover_at(at);
    ui.step();
    ui.hover_at(at + egui::vec2(0.0, 1.0));
    settle(&mut ui);
    assert!(says(&ui, "under the pointer: "));
    let place = (at + egui::vec2(0.0, 1.0) - rect.min) / rect.size();
    let camera = ui.state().explorer().state().camera;
    let ray = camera.ray((place.x, place.y), rect.width() / rect.height());
    let seen = ray.dir.as_dvec3().to_array();
    // The probe follows the pointer as over the other views.
    assert!(angle_rad(probe(&ui).to_f64(), seen) < 1e-5);
    assert!(angle_rad(before.to_f64(), seen) > 0.1, "control");
    ui.drag_at(at + egui::vec2(0.0, 1.0));
    ui.step();
    ui.drop_at(at + egui::vec2(0.0, 1.0));
    settle(&mut ui);
    assert!(!ui.state().explorer().state().probe_follows);
    let kept = probe(&ui);
    // Over the other picture's middle stands the numbers' place alone; the probe stays.
    let middle = picture(&ui, "A").center();
    ui.hover_at(middle);
    settle(&mut ui);
    assert!(says(&ui, "under the pointer: "));
    assert_eq!(probe(&ui), kept);
    ui.hover_at(egui::pos2(2.0, 2.0));
    settle(&mut ui);
    assert!(says(&ui, "at the probe: "));
    // A drag turns the camera, and the pictures follow.
    let (size, light) = (shown(&ui).0.size, shown(&ui).1.light()[0].to_vec());
    ui.drag_at(middle);
    ui.step();
    ui.hover_at(middle + egui::vec2(60.0, 0.0));
    ui.step();
    ui.drop_at(middle + egui::vec2(60.0, 0.0));
    settle(&mut ui);
    assert_ne!(ui.state().explorer().state().camera, camera);
    assert_eq!(shown(&ui).0.size, size);
    assert_ne!(shown(&ui).1.light()[0], light);
}

#[test]
fn a_hidden_pane_makes_nothing() {
    let mut ui = open(pane(of(MappingId::Eac, MappingId::Cube, 6 * 32 * 32)));
    let maps = |ui: &Ui| shown(ui).0.maps;
    let before = maps(&ui);
    run(&mut ui, Action::SetMaximised(Some(Pane::Viewport)));
    run(
        &mut ui,
        Action::SetBudget(BudgetState {
            open: true,
            ..of(MappingId::Ccm, MappingId::Cube, 6 * 32 * 32)
        }),
    );
    assert_eq!(maps(&ui), before, "made while hidden");
    run(&mut ui, Action::SetMaximised(Some(Pane::Budget)));
    assert_eq!(
        maps(&ui)[0],
        MapSize::of_budget(MappingId::Ccm, 6 * 32 * 32)
    );
    assert_ne!(maps(&ui), before, "control");
    // Other surroundings are other pictures.
    let light = shown(&ui).1.light()[0].to_vec();
    run(
        &mut ui,
        Action::SetRotation(sixfold::math::Rotation::from_degrees([90.0, 0.0, 0.0])),
    );
    assert_ne!(shown(&ui).1.light()[0], light);
}

#[test]
fn the_state_is_kept_and_brought_into_range() {
    let mut state = AppState::default();
    let wild = BudgetState {
        open: true,
        maps: [None, Some(MappingId::Sphere)],
        texels: u32::MAX,
        magnifier: 7,
        shows_surroundings: true,
    };
    apply(&mut state, Action::SetBudget(wild));
    assert_eq!(state.budget.texels, COMPARED_TEXELS.1);
    assert_eq!(state.budget.magnifier, 8);
    assert_eq!(state.budget.sanitized(), state.budget);
    assert!(state.is_open(Pane::Budget));
    assert_eq!(
        AppState::from_json(&state.to_json().unwrap()).unwrap(),
        state
    );
    apply(&mut state, Action::SetPaneOpen(Pane::Budget, false));
    assert!(!state.budget.open && state.budget.shows_surroundings);
    let old = AppState::from_json(r#"{"schema": 5}"#).unwrap();
    assert_eq!(old.budget, BudgetState::default());
    assert!(!old.budget.open);
}

#[test]
fn nothing_is_clipped_or_fails_when_tiny() {
    let mut ui = open(pane(BudgetState {
        shows_surroundings: true,
        ..BudgetState::default()
    }));
    for (width, height) in WINDOW_SIZES {
        ui.set_size(egui::vec2(width, height));
        for alone in [None, Some(Pane::Budget)] {
            run(&mut ui, Action::SetMaximised(alone));
            let size = shown(&ui).0.size;
            assert!(size[0] * size[1] <= MOST_PIXELS + 2048, "{size:?}");
            if width >= 800.0 {
                for text in ["per square degree", "at the probe: ", "over the object "] {
                    let found: Vec<_> = ui.query_all_by_label_contains(text).collect();
                    assert!(!found.is_empty(), "{text} in {width}");
                    for rect in found.iter().map(|node| node.rect()) {
                        assert!(rect.right() <= width, "{text}: {rect:?} in {width}");
                        assert!(
                            rect.bottom() <= height || alone.is_none(),
                            "{text}: {rect:?}"
                        );
                    }
                }
            }
            if width >= 800.0 && alone.is_some() {
                for name in ["A", "B", "environment"] {
                    let rect = picture(&ui, name);
                    assert!(
                        rect.height() > 100.0 && rect.right() < width,
                        "{rect:?} in {width}"
                    );
                }
            }
        }
    }
    assert_eq!(ui.state().explorer().messages(), []);
}

#[test]
fn its_pictures_are_drawn_without_a_window() {
    use sixfold::app::model::Surroundings;
    use sixfold::app::picture::{Destination, PictureRequest, draw};
    use std::sync::Arc;
    let gpu = sixfold::gpu::Gpu::headless().unwrap();
    let environment = Environment::LabelledFaces;
    let surroundings = Surroundings {
        loaded: Arc::new(environment.image(&Progress::new()).unwrap()),
        environment,
    };
    let request = PictureRequest {
        what: What::Budget,
        size: [400, 200],
        overlays: false,
        to: Destination::Clipboard,
    };
    let halves = |budget: BudgetState| {
        let state = pane(BudgetState {
            shows_surroundings: false,
            ..budget
        });
        let surroundings = surroundings.clone();
        let drawn = draw(&gpu, &state, surroundings, &request, &Progress::new()).unwrap();
        let row = |y: usize, x: usize| drawn.rgba[4 * (400 * y + x)..][..4 * 190].to_vec();
        let half = |x: usize| (0..190).flat_map(|y| row(y, x)).collect::<Vec<u8>>();
        // Without the surroundings a picture is 198 wide, and the other one begins after the gap.
        [half(0), half(202)]
    };
    let [a, b] = halves(of(MappingId::Cube, MappingId::Cube, 6 * 32 * 32));
    assert!(a == b, "the same map is the same picture");
    assert!(a.iter().collect::<std::collections::HashSet<_>>().len() > 20);
    let [a, b] = halves(of(MappingId::Cube, MappingId::Sphere, 6 * 32 * 32));
    assert!(a != b, "control");
}
