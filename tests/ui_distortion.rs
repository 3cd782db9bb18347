//! Heat maps and Tissot's ellipses over the panels: made where they are shown, and in the same colours everywhere.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "tests say what they expect by unwrapping, and what they saw by printing"
)]

mod window_kit;

use std::path::PathBuf;
use std::sync::Arc;

use egui_kittest::kittest::Queryable;
use sixfold::app::action::{Action, apply};
use sixfold::app::arrangement::Pane;
use sixfold::app::distortion::Seen;
use sixfold::app::model::Surroundings;
use sixfold::app::picture::{self, Destination, Picture, PictureRequest, What};
use sixfold::app::state::{AppState, Overlays};
use sixfold::app::theme;
use sixfold::gpu::Gpu;
use sixfold::imaging::Progress;
use sixfold::lab::metrics::{Quantity, Yardstick};
use sixfold::mapping::{ChartPoint, MappingId};
use window_kit::{Ui, WINDOW_SIZES, open, open_sized, rests, run, settle, small};

fn with_overlays(overlays: Overlays) -> AppState {
    AppState {
        overlays,
        ..small()
    }
}

fn heat(quantity: Quantity) -> Overlays {
    Overlays {
        heat: Some(quantity),
        ..Overlays::default()
    }
}

fn has_heat(ui: &Ui, map: MappingId, quantity: Quantity) -> bool {
    let labs = ui.state().explorer().labs();
    labs.heat.picture(map, Seen::Panel, quantity).is_some()
}

fn draw(state: &AppState, what: What, size: [u32; 2]) -> Picture {
    let progress = Progress::new();
    let loaded = state.environment.image(&progress).unwrap();
    let around = Surroundings {
        environment: state.environment.clone(),
        loaded: Arc::new(loaded),
    };
    let request = PictureRequest {
        what,
        size,
        overlays: true,
        to: Destination::File {
            path: PathBuf::from("unused.png"),
            force: false,
        },
    };
    let gpu = Gpu::headless().unwrap();
    picture::draw(&gpu, state, around, &request, &progress).unwrap()
}

#[test]
fn a_heat_map_is_made_for_what_is_seen_and_for_nothing_else() {
    let mut ui = open(small());
    assert!(!has_heat(&ui, MappingId::Cube, Quantity::Shape), "control");
    run(&mut ui, Action::SetOverlays(heat(Quantity::Shape)));
    settle(&mut ui);
    let seen = |ui: &Ui, quantity| {
        let has = |map: &&MappingId| has_heat(ui, **map, quantity);
        MappingId::ALL.iter().filter(has).count()
    };
    // The six panels that are open.
    assert_eq!(seen(&ui, Quantity::Shape), 6);
    assert_eq!(seen(&ui, Quantity::Area), 0);
    run(&mut ui, Action::SetOverlays(heat(Quantity::Area)));
    run(
        &mut ui,
        Action::SetPaneOpen(Pane::Map(MappingId::Cube), false),
    );
    settle(&mut ui);
    assert_eq!(seen(&ui, Quantity::Area), 5);
    assert!(rests(&mut ui));
    run(&mut ui, Action::SetOverlays(Overlays::default()));
    assert_eq!(seen(&ui, Quantity::Area), 0, "nobody looks");
}

#[test]
fn the_controls_switch_both_on() {
    let mut ui = open(small());
    let overlays = |ui: &Ui| ui.state().explorer().state().overlays;
    ui.get_by_label("Tissot's ellipses").scroll_to_me();
    settle(&mut ui);
    ui.get_by_label("Tissot's ellipses").click();
    settle(&mut ui);
    assert!(overlays(&ui).ellipses);
    ui.get_by_label("panels show").click();
    settle(&mut ui);
    ui.get_by_label("shape: a/b").click();
    settle(&mut ui);
    assert_eq!(overlays(&ui).heat, Some(Quantity::Shape));
    assert!(ui.query_all_by_label("a circle every").count() > 1);
}

#[test]
fn a_pixel_has_the_colour_of_its_distortion_in_every_panel() {
    const SIZE: u32 = 400;
    for (map, quantity) in [
        (MappingId::Cube, Quantity::Shape),
        (MappingId::Ccm, Quantity::Area),
        (MappingId::Octahedral, Quantity::Linear),
        (MappingId::Paraboloid, Quantity::Density),
    ] {
        let overlays = Overlays {
            heat: Some(quantity),
            ..Overlays::NONE
        };
        let state = with_overlays(overlays);
        let picture = draw(&state, What::Panel(map), [SIZE, SIZE]);
        let info = map.info();
        let view = state.panel(map);
        let rect = sixfold::app::panel_view::rect_of_size(SIZE as f32, SIZE as f32);
        let aspect = info.layout.picture_aspect(info.aspect) as f32;
        let window = sixfold::app::panel_view::PanelWindow::new(rect, &view, aspect);
        let off = |point: ChartPoint<f64>, of: ChartPoint<f64>| {
            let yardstick = Yardstick::new(map);
            let value = quantity.of(&yardstick.at(of).unwrap(), &yardstick, 1.0);
            let expected = theme::scale(quantity.place(value, 1.0) as f32);
            let place = info.layout.picture_from_chart(point).unwrap();
            let at = window.screen_from_picture(place);
            let index = (at.y as usize * SIZE as usize + at.x as usize) * 4;
            let found = &picture.rgba[index..index + 3];
            let apart = found.iter().zip(expected.to_array());
            apart.map(|(a, b)| a.abs_diff(b)).max().unwrap()
        };
        // Far from the legend at the lower left.
        for (u, v) in [(0.5, 0.5), (0.3, 0.25), (0.8, 0.4)] {
            let point = ChartPoint::new(info.chart_count() - 1, u, v);
            // Observed: at most 2 of 255; a pixel is not its middle.
            println!("{map} {u} {v}: {}", off(point, point));
            assert!(
                off(point, point) <= 4,
                "{map} {u} {v}: {}",
                off(point, point)
            );
        }
        let corner = ChartPoint::new(0, 0.22, 0.28);
        let middle = ChartPoint::new(0, 0.5, 0.5);
        assert!(
            off(middle, corner) > 12,
            "control, {map}: {}",
            off(middle, corner)
        );
    }
}

#[test]
fn ellipses_are_drawn_as_dense_as_asked_for() {
    let lit = |overlays: Overlays| {
        let state = with_overlays(overlays);
        let picture = draw(&state, What::Panel(MappingId::Ccm), [400, 300]);
        let white = picture
            .rgba
            .chunks(4)
            .filter(|p| p[..3].iter().all(|c| *c > 200));
        white.count()
    };
    let with = |ellipses: bool, spacing: f32| Overlays {
        ellipses,
        ellipses_deg: spacing,
        heat: Some(Quantity::Linear),
        ..Overlays::NONE
    };
    let (none, few, many) = (
        lit(with(false, 20.0)),
        lit(with(true, 40.0)),
        lit(with(true, 15.0)),
    );
    assert!(few > none + 200 && many > few + 400, "{none} {few} {many}");
}

#[test]
fn nothing_fails_in_small_windows_or_with_any_number() {
    let overlays = Overlays {
        heat: Some(Quantity::Density),
        ellipses: true,
        ellipses_deg: f32::NAN,
        ..Overlays::default()
    };
    let mut state = small();
    apply(&mut state, Action::SetOverlays(overlays));
    assert_eq!(
        state.overlays.ellipses_deg,
        Overlays::default().ellipses_deg
    );
    assert_eq!(with_overlays(overlays).sanitized().overlays, state.overlays);
    let mut ui = open_sized(state, 640.0, 480.0);
    for (width, height) in WINDOW_SIZES {
        ui.set_size(egui::vec2(width, height));
        settle(&mut ui);
    }
    assert!(has_heat(&ui, MappingId::Cube, Quantity::Density));
}
