//! The ranking of all mappings in the window: it opens at once and fills in, is sorted, weighed and compared.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod window_kit;

use std::path::PathBuf;
use std::sync::Arc;

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use sixfold::app::action::{Action, apply};
use sixfold::app::arrangement::Pane;
use sixfold::app::command::Command;
use sixfold::app::laboratory::Measured;
use sixfold::app::model::Surroundings;
use sixfold::app::picture::{self, Destination, Picture, PictureRequest, What};
use sixfold::app::state::{
    AppState, Claim, MOST_COMPARED, RankingColumn, RankingPlot, RankingState, SCHEMA,
};
use sixfold::gpu::Gpu;
use sixfold::imaging::Progress;
use sixfold::lab::ranking::Criterion;
use sixfold::mapping::{Family, MappingId};
use window_kit::{
    TILED_SIZES, Ui, WINDOW_SIZES, assert_within, click_at, measured_with, middle_end, open,
    open_sized, rests, run, settle, small, texts, tile, tiled,
};

/// The pane alone, with all the width there is.
fn alone(ranking: RankingState) -> AppState {
    let mut state = AppState {
        maximised: Some(Pane::Ranking),
        ranking: RankingState {
            open: true,
            ..ranking
        },
        controls_open: false,
        ..small()
    };
    state.inspector.open = false;
    state
}

fn with_plot(plot: RankingPlot) -> AppState {
    alone(RankingState {
        plot,
        ..RankingState::default()
    })
}

fn state(ui: &Ui) -> &AppState {
    ui.state().explorer().state()
}

fn known(ui: &Ui) -> usize {
    let lab = &ui.state().explorer().labs().ranking;
    let all = MappingId::ALL.iter();
    all.filter(|map| lab.of(**map).is_some()).count()
}

/// Number of the job that measures, while it runs.
fn job(ui: &Ui) -> Option<u64> {
    let jobs = ui.state().explorer().jobs();
    let job = jobs.iter().find(|job| job.title.contains("distorts"));
    job.map(|job| job.id)
}

/// Shows the pane; the next step draws its first frame.
fn show(ui: &mut Ui) {
    let ctx = ui.ctx.clone();
    let mut shown = alone(RankingState::default());
    shown.ranking.sort = RankingColumn::Mapping;
    let load = Command::Do(Action::Load(Box::new(shown)));
    ui.state_mut().explorer_mut().run(&ctx, load);
}

/// What a cell of the table says, where it is seen.
fn cell(ui: &Ui, map: MappingId, column: &str) -> Option<String> {
    let start = format!("{map}, {column}: ");
    let texts = texts(ui).into_iter();
    let mut cells = texts.filter_map(|text| text.strip_prefix(&start).map(str::to_owned));
    cells.next()
}

/// The mappings as their lines stand in the table, from above.
fn lines(ui: &Ui) -> Vec<MappingId> {
    let top = |map: &MappingId| {
        let label = format!("Open {}", map.info().name);
        let top = ui.query_by_label(&label)?.rect().top();
        Some((top, *map))
    };
    let mut lines: Vec<(f32, MappingId)> = MappingId::ALL.iter().filter_map(top).collect();
    lines.sort_by(|a, b| a.0.total_cmp(&b.0));
    lines.into_iter().map(|(_, map)| map).collect()
}

fn click(ui: &mut Ui, label: &str) {
    ui.get_by_label(label).click();
    settle(ui);
}

fn change(ui: &mut Ui, with: impl FnOnce(&mut RankingState)) {
    let mut ranking = state(ui).ranking.clone();
    with(&mut ranking);
    run(ui, Action::SetRanking(Box::new(ranking)));
}

fn points(ui: &Ui) -> usize {
    ui.query_all_by_label_contains("Point: ").count()
}

/// The coarser the faster.
fn measured(maps: &[MappingId]) -> Measured {
    measured_with(maps, |row| row.ns = 4.0 - row.max_error_texels.log10())
}

#[test]
fn the_list_opens_at_once_and_fills_in_and_a_hidden_pane_measures_nothing() {
    let mut ui = open(small());
    assert_eq!(known(&ui), 0, "nobody looks");
    show(&mut ui);
    ui.step();
    // The first frame has every name, and not one number.
    assert_eq!(lines(&ui).len(), MappingId::ALL.len());
    let arvo = |ui: &Ui| cell(ui, MappingId::Angular, "a/b max");
    assert_eq!(arvo(&ui).as_deref(), Some("…"));
    settle(&mut ui);
    assert_eq!(known(&ui), MappingId::ALL.len());
    assert_eq!(arvo(&ui).as_deref(), Some("unbounded"));
    assert!(rests(&mut ui));
    // Hidden and shown again, nothing is measured anew.
    run(&mut ui, Action::SetPaneOpen(Pane::Ranking, false));
    show(&mut ui);
    for _ in 0..3 {
        ui.step();
        assert_eq!(job(&ui), None);
    }
    assert_eq!(arvo(&ui).as_deref(), Some("unbounded"));
}

#[test]
fn measuring_can_be_stopped_and_goes_on_with_what_is_missing() {
    let mut ui = open(small());
    let all = MappingId::ALL.len();
    show(&mut ui);
    let running = loop {
        ui.step();
        if let Some(job) = job(&ui).filter(|_| known(&ui) > 0) {
            break job;
        }
        assert!(known(&ui) < all, "too fast to be stopped");
    };
    run(&mut ui, Command::Cancel(running));
    let before = known(&ui);
    assert!(before > 0 && before < all, "{before}");
    // It stays so until it is asked to go on.
    settle(&mut ui);
    assert_eq!((known(&ui), job(&ui)), (before, None));
    ui.get_by_label(&format!("{before} of {all} mappings are measured"));
    click(&mut ui, "Measure the others");
    settle(&mut ui);
    assert_eq!(known(&ui), all);
    assert!(ui.query_by_label("Measure the others").is_none());
}

#[test]
fn a_head_sorts_both_ways_and_what_has_no_bound_stays_last() {
    let mut ui = open(alone(RankingState::default()));
    let areas = |ui: &Ui| -> Vec<f64> {
        let lab = &ui.state().explorer().labs().ranking;
        let area = |map: MappingId| lab.of(map).unwrap().area_ratio;
        lines(ui).into_iter().map(area).collect()
    };
    let bounded = |ui: &Ui| {
        let values = areas(ui);
        let count = values.iter().filter(|v| v.is_finite()).count();
        assert!(values[..count].iter().all(|v| v.is_finite()), "{values:?}");
        assert!(count < values.len(), "control: all have a bound");
        values[..count].to_vec()
    };
    click(&mut ui, "Sort by area max/min");
    // What is equal but for a search's last digits is in no order.
    let rising = bounded(&ui);
    assert!(
        rising.is_sorted_by(|a, b| *a <= *b * (1.0 + 2e-6)),
        "{rising:?}"
    );
    click(&mut ui, "Sort by area max/min");
    let falling = bounded(&ui);
    assert!(
        falling.is_sorted_by(|a, b| *a >= *b * (1.0 - 2e-6)),
        "{falling:?}"
    );
    click(&mut ui, "Sort by edges");
    assert!(!areas(&ui).is_sorted(), "control");
    run(&mut ui, Command::Undo);
    assert_eq!(state(&ui).ranking.sort, RankingColumn::By(Criterion::Area));
}

#[test]
fn the_order_flips_with_the_weight_and_ends_with_what_has_no_bound() {
    let mut ui = open(alone(RankingState::default()));
    change(&mut ui, |ranking| ranking.weight = 0.0);
    let by_area = lines(&ui);
    assert!(by_area[0].info().claims.equal_area, "{by_area:?}");
    let lab = &ui.state().explorer().labs().ranking;
    let last = lab.of(*by_area.last().unwrap()).unwrap();
    assert!(last.area_ratio.is_infinite());
    change(&mut ui, |ranking| ranking.weight = 1.0);
    let by_shape = lines(&ui);
    assert!(by_shape[0].info().claims.conformal, "{by_shape:?}");
    // Who is best from which weight on is told in words, and the chart has a name at each place.
    let told = texts(&ui);
    let told = told
        .iter()
        .find(|text| text.starts_with("Best for area: "))
        .unwrap();
    for map in [MappingId::Qsc, MappingId::Paraboloid] {
        assert!(told.contains(map.info().name), "{told}");
    }
    let label = format!("Place 1 by shape: {}", by_shape[0].info().name);
    assert!(ui.query_by_label(&label).is_some(), "{label}");
    // A click in the chart sets the weight, and one undo takes it back.
    let chart = ui.get_by_label("Places over the weight of shape").rect();
    click_at(
        &mut ui,
        chart.left_top() + egui::vec2(0.25, 0.5) * chart.size(),
    );
    let weight = state(&ui).ranking.weight;
    assert!((weight - 0.25).abs() < 0.02, "{weight}");
    run(&mut ui, Command::Undo);
    assert_eq!(state(&ui).ranking.weight, 1.0);
}

#[test]
fn a_click_on_a_name_or_a_point_opens_that_mapping_and_one_undo_takes_it_back() {
    let shut = MappingId::Healpix;
    for (plot, start) in [
        (RankingPlot::Weights, "Open "),
        (RankingPlot::Scatter, "Point: "),
    ] {
        let mut scene = with_plot(plot);
        scene.panel_mut(shut).unwrap().open = false;
        let mut ui = open(scene);
        assert_ne!(state(&ui).mapping, shut, "control");
        // On the first line, and the only point.
        change(&mut ui, |ranking| {
            ranking.family = Some(Family::EqualPixels);
        });
        let label = format!("{start}{}", shut.info().name);
        let at = ui.get_by_label(&label).rect().center();
        click_at(&mut ui, at);
        assert_eq!(state(&ui).mapping, shut, "{label}");
        assert!(state(&ui).is_open(Pane::Map(shut)));
        run(&mut ui, Command::Undo);
        assert_ne!(state(&ui).mapping, shut);
        assert!(!state(&ui).is_open(Pane::Map(shut)));
    }
}

#[test]
fn four_are_compared_at_most_and_the_fifth_is_refused_with_a_hint() {
    let mut ui = open(with_plot(RankingPlot::Compare));
    change(&mut ui, |ranking| {
        ranking.family = Some(Family::Octahedra);
        ranking.compared.truncate(MOST_COMPARED - 1);
    });
    let boxes = [MappingId::Octahedral, MappingId::OctahedralEqualArea];
    let labels = boxes.map(|map| format!("Compare {}", map.info().name));
    let is_off = |ui: &Ui, k: usize| {
        let node = ui.get_by_label(&labels[k]);
        node.accesskit_node().is_disabled()
    };
    assert!(!is_off(&ui, 0) && !is_off(&ui, 1));
    click(&mut ui, &labels[0]);
    assert_eq!(state(&ui).ranking.compared.len(), MOST_COMPARED);
    ui.get_by_label("4 chosen: untick one to choose another");
    assert!(is_off(&ui, 1) && !is_off(&ui, 0));
    let at = ui.get_by_label(&labels[1]).rect().center();
    click_at(&mut ui, at);
    assert!(!state(&ui).ranking.compared.contains(&boxes[1]));
    // All of them are told by each criterion, whatever kind the table shows.
    let told = texts(&ui);
    for criterion in Criterion::ALL {
        let start = format!("Compared by {}: ", criterion.name());
        let mut found = told.iter().filter_map(|text| text.strip_prefix(&start));
        let line = found.next().unwrap();
        assert_eq!(line.split("; ").count(), MOST_COMPARED, "{line}");
    }
    click(&mut ui, &labels[0]);
    assert!(!is_off(&ui, 1));
}

#[test]
fn no_cost_stands_without_its_error_and_none_is_made_up() {
    let mut scene = with_plot(RankingPlot::Scatter);
    scene.ranking.axes = [Criterion::Cost, Criterion::ShapeMax];
    scene.ranking.sort = RankingColumn::By(Criterion::Cost);
    let mut ui = open(scene);
    // The column stands at the right of the window, the first lines above.
    let cost = |ui: &Ui, map| cell(ui, map, "ns a lookup");
    assert_eq!(cost(&ui, MappingId::Latlong).as_deref(), Some("–"));
    ui.get_by_label_contains("Not measured on this machine: open Run time and error");
    assert_eq!(points(&ui), 0);
    let maps = [MappingId::Cube, MappingId::Ccm];
    let labs = ui.state_mut().explorer_mut().labs_mut();
    labs.bench.show(measured(&maps));
    ui.step();
    settle(&mut ui);
    for map in maps {
        let cost = cost(&ui, map).unwrap();
        assert!(cost.contains(" ns, ") && cost.ends_with(" texel"), "{cost}");
    }
    // Those two stand first and are the points of the plot; the others have none.
    assert!(lines(&ui)[..2].iter().all(|map| maps.contains(map)));
    assert_eq!(points(&ui), maps.len());
    // A narrower budget asks for another way to compute it.
    let before = cost(&ui, MappingId::Ccm);
    let mut narrow = state(&ui).laboratory.clone();
    narrow.budget_texels = 0.001;
    run(&mut ui, Action::SetLaboratory(Box::new(narrow)));
    assert_ne!(cost(&ui, MappingId::Ccm), before);
}

#[test]
fn any_two_criteria_are_axes_and_every_mapping_that_is_ranked_is_a_point() {
    let mut ui = open(with_plot(RankingPlot::Scatter));
    assert_eq!(points(&ui), MappingId::ALL.len());
    let label = format!("Point: {}", MappingId::Cube.info().name);
    let place = |ui: &Ui| ui.get_by_label(&label).rect().center();
    let before = place(&ui);
    change(&mut ui, |ranking| {
        ranking.axes = [Criterion::Linear, Criterion::OmegaMean];
    });
    assert_eq!(points(&ui), MappingId::ALL.len());
    assert_ne!(place(&ui), before);
    change(&mut ui, |ranking| ranking.claim = Some(Claim::EqualArea));
    let even = MappingId::ALL.iter();
    let even = even.filter(|map| map.info().claims.equal_area).count();
    assert_eq!((points(&ui), lines(&ui).len()), (even, even));
    // A kind without such a mapping says so.
    change(&mut ui, |ranking| {
        ranking.family = Some(Family::Octahedra);
        ranking.claim = Some(Claim::Conformal);
    });
    assert!(lines(&ui).is_empty());
    ui.get_by_label("No mapping is of this kind and keeps that promise.");
}

#[test]
fn a_scene_keeps_the_question_and_an_older_one_opens() {
    let mut scene = AppState::default();
    let asked = RankingState {
        open: true,
        sort: RankingColumn::By(Criterion::Diagonals),
        family: Some(Family::Cubes),
        claim: Some(Claim::Continuous),
        compared: MappingId::ALL.to_vec(),
        weight: 3.0,
        ..RankingState::default()
    };
    apply(&mut scene, Action::SetRanking(Box::new(asked)));
    assert_eq!(scene.ranking.compared.len(), MOST_COMPARED);
    assert_eq!(scene.ranking.weight, 1.0);
    let read = AppState::from_json(&scene.to_json().unwrap()).unwrap();
    assert_eq!(read, scene);
    assert_ne!(read.ranking, RankingState::default(), "control");
    for schema in 1..=SCHEMA {
        let old = AppState::from_json(&format!(r#"{{"schema": {schema}}}"#)).unwrap();
        assert_eq!(old.ranking, RankingState::default());
    }
}

#[test]
fn a_picture_of_it_holds_the_numbers() {
    let gpu = Gpu::headless().unwrap();
    let draw = |scene: &AppState| -> Picture {
        let loaded = scene.environment.image(&Progress::new()).unwrap();
        let around = Surroundings {
            environment: scene.environment.clone(),
            loaded: Arc::new(loaded),
        };
        let request = PictureRequest {
            what: What::Ranking,
            size: [900, 700],
            overlays: true,
            to: Destination::File {
                path: PathBuf::from("unused.png"),
                force: false,
            },
        };
        picture::draw(&gpu, scene, around, &request, &Progress::new()).unwrap()
    };
    let light = |picture: &Picture| {
        let pixels = picture.rgba.chunks(4);
        pixels.filter(|p| p[..3].iter().all(|c| *c > 150)).count()
    };
    let whole = light(&draw(&alone(RankingState::default())));
    let few = light(&draw(&alone(RankingState {
        family: Some(Family::EqualPixels),
        ..RankingState::default()
    })));
    // Control: where one mapping is ranked, most of the numbers are missing.
    assert!(whole > 2 * few && few > 100, "{whole} {few}");
}

#[test]
fn nothing_leaves_the_tile_but_the_tables_columns() {
    let mut scene = tiled(Pane::Ranking);
    let mut ids = MappingId::ALL.to_vec();
    ids.sort_by_key(|map| std::cmp::Reverse(map.info().id.len()));
    scene.ranking.compared = ids[..MOST_COMPARED].to_vec();
    let mut ui = open(scene);
    // The table scrolls sideways by itself.
    let is_cell = |text: &str| {
        let of_map = |map: &MappingId| {
            let rest = text.strip_prefix(map.info().id);
            rest.is_some_and(|rest| rest.starts_with(", "))
        };
        text.starts_with("Sort by ") || MappingId::ALL.iter().any(of_map)
    };
    for (width, height) in TILED_SIZES {
        ui.set_size(egui::vec2(width, height));
        for plot in RankingPlot::ALL {
            change(&mut ui, |ranking| ranking.plot = plot);
            let kinds = [Role::Slider, Role::ComboBox, Role::SpinButton, Role::Button];
            assert_within(&ui, Pane::Ranking, &kinds, is_cell);
        }
        // Each number of the comparison is a thing of its own, and none covers another.
        change(&mut ui, |ranking| ranking.plot = RankingPlot::Compare);
        let tile = tile(&ui, Pane::Ranking);
        let whats = Criterion::ALL.map(Criterion::name).into_iter();
        let mut places: Vec<egui::Rect> = Vec::new();
        for what in whats.chain(["its error"]) {
            for map in &ids[..MOST_COMPARED] {
                let start = format!("{} by {what}: ", map.info().id);
                let rect = ui.get_by_label_contains(&start).rect();
                assert!(
                    rect.left() > tile.left() && rect.right() < tile.right(),
                    "{start}{rect:?} in {tile:?}"
                );
                let covered = places
                    .iter()
                    .find(|other| other.intersects(rect.shrink(1.0)));
                assert_eq!(covered, None, "{start}{rect:?}");
                places.push(rect);
            }
        }
    }
}

#[test]
fn nothing_is_clipped_or_fails_when_tiny() {
    let mut scene = alone(RankingState::default());
    (scene.controls_open, scene.inspector.open) = (true, true);
    let mut ui = open_sized(scene, 1280.0, 800.0);
    for (width, height) in WINDOW_SIZES {
        ui.set_size(egui::vec2(width, height));
        for plot in RankingPlot::ALL {
            change(&mut ui, |ranking| ranking.plot = plot);
            for pane in [None, Some(Pane::Ranking)] {
                run(&mut ui, Action::SetMaximised(pane));
                // What is seen of it as a tile has a test of its own.
                if width < 800.0 || pane.is_none() {
                    continue;
                }
                // What does not scroll lies in the window, beside the inspector.
                let inspector = middle_end(&ui, width);
                let fixed = RankingPlot::ALL.map(RankingPlot::name).into_iter();
                for label in fixed.chain(["rank", "that are"]) {
                    let node = ui.query_all_by_label(label).next().unwrap();
                    let rect = node.rect();
                    let is_seen = rect.left() > 0.0 && rect.right() < inspector;
                    assert!(is_seen && rect.bottom() < height, "{label}: {rect:?}");
                }
                for point in ui.query_all_by_label_contains("Point: ") {
                    let rect = point.rect();
                    assert!(rect.right() < inspector, "{rect:?} in {width}");
                }
            }
        }
    }
    assert_eq!(ui.state().explorer().messages(), []);
}
