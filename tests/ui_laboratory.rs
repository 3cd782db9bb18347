//! Run time against error in the window: measured when it is asked for, chosen by a click or by the budget.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

mod window_kit;

use egui_kittest::kittest::{NodeT, Queryable};
use sixfold::app::action::{Action, apply};
use sixfold::app::arrangement::Pane;
use sixfold::app::command::Command;
use sixfold::app::laboratory::Measured;
use sixfold::app::picture::{Destination, PictureRequest, What};
use sixfold::app::state::{AppState, LaboratoryState, SCHEMA};
use sixfold::lab::bench::{Row, Way};
use sixfold::lab::inputs::Inputs;
use sixfold::lab::machine::Machine;
use sixfold::mapping::MappingId;
use sixfold::math::{Vec3, angle_rad};
use window_kit::{
    Ui, WINDOW_SIZES, measured_with, middle_end, open, open_sized, probe, rests, run, settle,
    small, texts,
};

const JOB: &str = "run time and error";

/// The pane alone over one mapping.
fn laboratory(mapping: MappingId) -> AppState {
    AppState {
        mapping,
        maximised: Some(Pane::Laboratory),
        laboratory: LaboratoryState {
            open: true,
            beside: Vec::new(),
            ..LaboratoryState::default()
        },
        ..small()
    }
}

/// Measurements with errors that hold and times that are made up, so that they are the same on every machine: the coarser
/// the faster, and the reference slow.
fn measured(maps: &[MappingId]) -> Measured {
    measured_with(maps, |row| {
        let all = row.inputs as usize as f64 + row.isa.len() as f64;
        row.ns = 4.0 - row.max_error_texels.log10() + 0.01 * all;
        row.copy_ratio = 2.0 * row.ns;
        if row.evaluator == "reference" {
            row.ns = 90.0;
        }
    })
}

/// A window with such measurements.
fn filled(state: AppState, maps: &[MappingId]) -> Ui {
    filled_sized(state, maps, 1280.0, 800.0)
}

fn filled_sized(state: AppState, maps: &[MappingId], width: f32, height: f32) -> Ui {
    let mut ui = open_sized(state, width, height);
    let labs = ui.state_mut().explorer_mut().labs_mut();
    labs.bench.show(measured(maps));
    ui.step();
    settle(&mut ui);
    ui
}

fn state(ui: &Ui) -> &AppState {
    ui.state().explorer().state()
}

fn rows(ui: &Ui) -> &[Row] {
    ui.state().explorer().labs().bench.rows()
}

/// The points of the plot, as they are called.
fn points(ui: &Ui) -> Vec<String> {
    let texts = texts(ui).into_iter();
    texts.filter(|text| text.starts_with("Point: ")).collect()
}

fn click(ui: &mut Ui, label: &str) {
    ui.get_by_label(label).click();
    settle(ui);
}

fn choose(ui: &mut Ui, list: &str, option: &str) {
    ui.get_by_role_and_label(egui::Role::ComboBox, list).click();
    settle(ui);
    {
        let options = ui.query_all_by_label(option);
        let is_option =
            |node: &egui_kittest::Node<'_>| node.accesskit_node().role() != egui::Role::ComboBox;
        let options: Vec<_> = options.filter(is_option).collect();
        options.last().unwrap().click();
    }
    settle(ui);
}

/// Whether a number stands before ` unit` somewhere.
fn has_number_of(text: &str, unit: &str) -> bool {
    let unit = format!(" {unit}");
    text.match_indices(&unit).any(|(at, _)| {
        let is_whole = !text[at + unit.len()..].starts_with(char::is_alphanumeric);
        is_whole && text[..at].ends_with(|c: char| c.is_ascii_digit())
    })
}

fn has_speed(text: &str) -> bool {
    has_number_of(text, "ns")
}

fn has_error(text: &str) -> bool {
    has_number_of(text, "rad") || (has_number_of(text, "texel") && !text.starts_with("0.01"))
}

#[test]
fn nothing_is_measured_unasked_and_the_button_measures() {
    let mut ui = open(laboratory(MappingId::Cube));
    ui.get_by_label_contains("not measured yet on this machine: nothing is measured until");
    assert!(rows(&ui).is_empty() && points(&ui).is_empty());
    assert!(texts(&ui).iter().all(|text| !has_speed(text)));
    assert!(rests(&mut ui));
    assert!(rows(&ui).is_empty());
    // Cancelled, there is nothing still.
    ui.get_by_label("Measure").click();
    ui.step();
    ui.step();
    let jobs = ui.state().explorer().jobs();
    let job = jobs.iter().find(|job| job.title.starts_with(JOB)).unwrap();
    ui.get_by_label("measuring …");
    run(&mut ui, Command::Cancel(job.id));
    ui.get_by_label("measuring was cancelled");
    assert!(rows(&ui).is_empty());
    click(&mut ui, "Measure");
    let machine = Machine::this(None);
    ui.get_by_label_contains(&format!("on {}, {} cores", machine.cpu, machine.cores));
    assert!(
        Inputs::ALL
            .iter()
            .all(|i| rows(&ui).iter().any(|row| row.inputs == *i))
    );
    assert!(rows(&ui).iter().all(|row| row.mapping == "cube"));
    // Every evaluator is a point, and all that is told of it is told together.
    let ids: Vec<&str> = MappingId::Cube.evaluators().iter().map(|e| e.id).collect();
    let points = points(&ui);
    assert_eq!(points.len(), ids.len());
    for id in ids {
        let point = points
            .iter()
            .find(|p| p.contains(&format!("cube {id} (")))
            .unwrap();
        for part in ["times a copy", "RMS", "worst towards"] {
            assert!(point.contains(part), "{point}");
        }
        assert!(has_speed(point) && has_error(point), "{point}");
    }
    assert!(rests(&mut ui));
}

#[test]
fn no_number_stands_without_its_partner() {
    let maps = [MappingId::Ccm, MappingId::Cube];
    let mut wide = laboratory(MappingId::Ccm);
    wide.laboratory.beside = vec![MappingId::Cube, MappingId::Latlong];
    wide.laboratory.budget_on = true;
    let mut seen = 0;
    for (inputs, budget_on) in [(Inputs::Random, true), (Inputs::Adversarial, false)] {
        let mut state = wide.clone();
        (state.laboratory.inputs, state.laboratory.budget_on) = (inputs, budget_on);
        // The formulas' steps hold angles that are no errors.
        state.inspector.open = false;
        let mut ui = filled(state, &maps);
        run(
            &mut ui,
            Action::UseEvaluator(MappingId::Ccm, "atan-7".to_owned()),
        );
        for text in texts(&ui) {
            let is_told = text.contains("without a result") || text.contains("holes");
            let error = has_error(&text) || is_told;
            assert_eq!(has_speed(&text), error, "{text}");
            seen += usize::from(error);
        }
        // A mapping without measurements says so, and tells no number.
        ui.get_by_label("Latlong (not measured yet)");
        run(&mut ui, Action::SetMapping(MappingId::Latlong));
        assert!(ui.query_all_by_label_contains("not measured yet").count() > 1);
    }
    assert!(seen > 60, "control: {seen}");
    assert!(has_speed("in 2.1 ns") && !has_speed("ns a direction") && !has_speed("2 nsx"));
    assert!(has_error("1.2e-5 rad,") && !has_error("largest error, rad"));
}

#[test]
fn a_click_on_a_point_or_a_line_uses_its_evaluator_and_undo_takes_it_back() {
    let maps = [MappingId::Ccm, MappingId::Cube];
    let mut scene = laboratory(MappingId::Cube);
    scene.laboratory.beside = vec![MappingId::Ccm];
    let mut ui = filled(scene, &maps);
    let chosen = |ui: &Ui, map| state(ui).laboratory.chosen(map).unwrap().id;
    assert_eq!(chosen(&ui, MappingId::Ccm), "f32");
    // The coarsest is alone at its place.
    let point = ui.get_by_label_contains("Point: ccm atan-5 (");
    let at = point.rect().center();
    ui.hover_at(at);
    ui.run_steps(3);
    assert!(
        ui.query_all_by_label_contains("ccm atan-5 (").count() > 1,
        "no hint"
    );
    ui.drag_at(at);
    ui.step();
    ui.drop_at(at);
    settle(&mut ui);
    assert_eq!(
        (chosen(&ui, MappingId::Ccm), state(&ui).mapping),
        ("atan-5", MappingId::Ccm)
    );
    // The inspector tells what it computes, and by how much that is off.
    ui.get_by_label("atan-5");
    let texts_now = texts(&ui);
    let off = texts_now
        .iter()
        .find(|text| text.contains(" texel, ") && text.ends_with(" ns"))
        .unwrap();
    assert!(has_speed(off) && has_error(off), "{off}");
    let dir = probe(&ui);
    let evaluator = MappingId::Ccm.processor("atan-5").unwrap();
    let point = evaluator.forward_one(Vec3::from_f64(dir.to_f64())).unwrap();
    ui.get_by_label(&format!("{}, {:.7}, {:.7}", point.chart, point.u, point.v));
    run(&mut ui, Command::Undo);
    assert_eq!(
        (chosen(&ui, MappingId::Ccm), state(&ui).mapping),
        ("f32", MappingId::Cube)
    );
    // A line of the table does the same.
    let line = texts(&ui);
    let line = line
        .iter()
        .find(|text| text.starts_with("ccm ") && text.contains(" atan-7 "));
    let line = line.unwrap().clone();
    click(&mut ui, &line);
    assert_eq!(
        (chosen(&ui, MappingId::Ccm), state(&ui).mapping),
        ("atan-7", MappingId::Ccm)
    );
}

#[test]
fn the_picture_shows_where_it_errs_and_a_click_moves_the_probe_there() {
    let mut ui = filled(laboratory(MappingId::Ccm), &[MappingId::Ccm]);
    let shown = |ui: &Ui| {
        let (wanted, shown) = ui.state().explorer().labs().bench.errors.shown().unwrap();
        (wanted.evaluator, shown.errors.max_rad, shown.errors.worst)
    };
    let (evaluator, fine, _) = shown(&ui);
    assert_eq!(evaluator, "f32");
    run(
        &mut ui,
        Action::UseEvaluator(MappingId::Ccm, "atan-5".to_owned()),
    );
    let (evaluator, coarse, worst) = shown(&ui);
    assert_eq!(evaluator, "atan-5");
    assert!(coarse > 100.0 * fine, "control: {coarse} and {fine}");
    assert!(angle_rad(probe(&ui).to_f64(), worst) > 0.01, "control");
    // The middle of the picture is the middle of a face.
    let rect = ui.get_by_label("Errors").rect();
    let center = rect.center();
    ui.hover_at(center);
    ui.step();
    ui.drag_at(center);
    ui.step();
    ui.drop_at(center);
    settle(&mut ui);
    let info = MappingId::Ccm.info();
    let middle = info.layout.chart_from_picture([0.5, 0.5]).unwrap();
    let middle = MappingId::Ccm.inverse::<f64>(middle).unwrap().to_f64();
    let off = angle_rad(probe(&ui).to_f64(), middle);
    let is_worst = angle_rad(worst, middle) < 0.2;
    assert!(off < 0.02 || is_worst, "{off}");
    assert!(!state(&ui).probe_follows);
    // Hidden, it is not computed.
    run(&mut ui, Action::SetPaneOpen(Pane::Laboratory, false));
    run(
        &mut ui,
        Action::UseEvaluator(MappingId::Ccm, "atan-9".to_owned()),
    );
    assert_eq!(shown(&ui).0, "atan-5");
    assert!(rests(&mut ui));
}

#[test]
fn filters_show_what_they_say() {
    let maps = [MappingId::Ccm, MappingId::Cube];
    let mut scene = laboratory(MappingId::Ccm);
    scene.laboratory.beside = vec![MappingId::Cube];
    let mut ui = filled(scene, &maps);
    let count = |ui: &Ui, map: &str| {
        let points = points(ui);
        let start = format!("Point: {map} ");
        points.iter().filter(|p| p.starts_with(&start)).count()
    };
    let all = |way: Way| {
        let evaluators = MappingId::Ccm.evaluators().iter();
        let own = evaluators.filter(|e| e.processor().is_some());
        own.filter(|e| way == Way::Forward || e.has_inverse())
            .count()
    };
    let sound = |ui: &Ui| {
        let filter = &state(ui).laboratory;
        let maps = [MappingId::Ccm];
        filter
            .filter(&maps)
            .of(rows(ui))
            .iter()
            .filter(|row| row.holes == 0)
            .count()
    };
    assert!(count(&ui, "cube") > 3 && count(&ui, "ccm") == sound(&ui));
    assert!(count(&ui, "ccm") >= all(Way::Forward) - 2);
    choose(&mut ui, "way", "inverse");
    assert_eq!(state(&ui).laboratory.direction, Way::Inverse);
    assert_eq!(count(&ui, "ccm"), all(Way::Inverse));
    assert!(all(Way::Inverse) < all(Way::Forward), "control");
    choose(&mut ui, "inputs", "adversarial");
    assert_eq!(state(&ui).laboratory.inputs, Inputs::Adversarial);
    assert_eq!(count(&ui, "ccm"), all(Way::Inverse));
    choose(&mut ui, "device", "cpu baseline");
    assert!(
        points(&ui)
            .iter()
            .all(|point| point.contains("(cpu baseline)"))
    );
    choose(&mut ui, "threads", "all cores");
    // From memory only random inputs were measured.
    assert!(points(&ui).is_empty());
    ui.get_by_label_contains("nothing that is shown was measured");
    // Each choice is taken back by itself.
    run(&mut ui, Command::Undo);
    assert_eq!(state(&ui).laboratory.direction, Way::Inverse);
    run(&mut ui, Command::Undo);
    run(&mut ui, Command::Undo);
    run(&mut ui, Command::Undo);
    assert_eq!(state(&ui).laboratory.direction, Way::Forward);
    assert!(count(&ui, "cube") > 3);
}

#[test]
fn the_budget_picks_the_cheapest_that_is_near_enough_and_can_be_switched_off() {
    let mut scene = laboratory(MappingId::Ccm);
    scene.maximised = None;
    let mut ui = filled(scene, &[MappingId::Ccm]);
    let set = |ui: &mut Ui, on: bool, texels: f64| {
        let laboratory = LaboratoryState {
            budget_on: on,
            budget_texels: texels,
            ..state(ui).laboratory.clone()
        };
        run(ui, Action::SetLaboratory(Box::new(laboratory)));
    };
    let used = |ui: &Ui| {
        let texts = texts(ui);
        let used = texts.iter().find(|text| text.contains("(budget): "));
        used.map(|text| text["ccm by ".len()..text.find(" (").unwrap()].to_owned())
    };
    assert_eq!(used(&ui), None);
    let mut before = f64::INFINITY;
    for texels in [1.0, 0.01, 0.001] {
        set(&mut ui, true, texels);
        let id = used(&ui).unwrap();
        let height = sixfold::gpu::map_size(MappingId::Ccm, state(&ui).texel_budget)[1];
        let own = rows(&ui).iter().filter(|row| row.evaluator == id);
        let own = own.filter(|row| row.direction == Way::Forward);
        let error = own
            .map(|row| row.error_texels_at(height))
            .fold(0.0, f64::max);
        assert!(
            error <= texels && error <= before,
            "{id}: {error} for {texels}"
        );
        before = error;
        // The pane says what that costs, beside the reference.
        let said = format!(": {id}, ");
        let reference = "the reference would cost ";
        let texts = crate::texts(&ui);
        let is_said = |text: &String| text.contains(&said) && text.contains(reference);
        assert!(texts.iter().any(is_said), "{texts:?}");
        // The inspector says who chose it.
        ui.get_by_label(&format!("{id}, by the budget"));
    }
    // Zoomed in, a finer one is needed.
    set(&mut ui, true, 0.05);
    let whole = used(&ui).unwrap();
    let zoomed = sixfold::app::state::PanelState {
        zoom: 4096.0,
        ..state(&ui).panel(MappingId::Ccm)
    };
    run(&mut ui, Action::SetPanelView(zoomed));
    ui.get_by_label_contains("(a texel takes ");
    assert_ne!(used(&ui), Some(whole));
    set(&mut ui, false, 0.05);
    assert_eq!(used(&ui), None);
    run(&mut ui, Command::Undo);
    assert!(state(&ui).laboratory.budget_on);
}

#[test]
fn measurements_are_written_as_the_command_writes_them() {
    let mut ui = filled(laboratory(MappingId::Cube), &[MappingId::Cube]);
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("bench");
    let save = |force| Command::SaveBench {
        folder: to.clone(),
        force,
    };
    run(&mut ui, save(false));
    let text = std::fs::read_to_string(to.join("bench.json")).unwrap();
    assert_eq!(text, sixfold::lab::report::json(rows(&ui)).unwrap());
    for name in sixfold::lab::files::BENCH {
        assert!(to.join(name).metadata().unwrap().len() > 100, "{name}");
    }
    let failed = |ui: &Ui| {
        let messages = ui.state().explorer().messages();
        messages.iter().filter(|message| message.is_error).count()
    };
    assert_eq!(failed(&ui), 0);
    run(&mut ui, save(false));
    assert_eq!(failed(&ui), 1);
    run(&mut ui, save(true));
    assert_eq!(failed(&ui), 1);
    // A picture of the window holds them, though a scene does not.
    let picture = |ui: &mut Ui, name: &str| {
        let path = folder.path().join(name);
        let to = Destination::File {
            path: path.clone(),
            force: false,
        };
        let request = PictureRequest {
            what: What::Window,
            size: [640, 400],
            overlays: true,
            to,
        };
        run(ui, Command::MakePicture(request));
        image::open(path).unwrap().to_rgba8()
    };
    let with = picture(&mut ui, "with.png");
    let mut bare = open(laboratory(MappingId::Cube));
    let without = picture(&mut bare, "without.png");
    let differ = with.pixels().zip(without.pixels()).filter(|(a, b)| a != b);
    assert!(
        differ.count() > 5000,
        "the measurements are not in the picture"
    );
    // The button asks where to.
    click(&mut ui, "Save …");
    ui.get_by_label("Save the measurements");
}

#[test]
fn a_scene_keeps_what_is_chosen_and_an_older_one_opens() {
    let mut scene = AppState::default();
    for (map, id) in [(MappingId::Cube, "no such"), (MappingId::Ccm, "atan-9")] {
        apply(&mut scene, Action::UseEvaluator(map, id.to_owned()));
    }
    let laboratory = LaboratoryState {
        open: true,
        direction: Way::Inverse,
        budget_on: true,
        budget_texels: 7.0,
        ..scene.laboratory.clone()
    };
    apply(&mut scene, Action::SetLaboratory(Box::new(laboratory)));
    assert_eq!(scene.laboratory.budget_texels, 1.0);
    let json = scene.to_json().unwrap();
    assert!(
        json.contains(r#""ccm": "atan-9""#) && !json.contains("no such"),
        "{json}"
    );
    let read = AppState::from_json(&json).unwrap();
    assert_eq!(read, scene);
    assert_ne!(read, AppState::default(), "control");
    for schema in 1..SCHEMA {
        let old = AppState::from_json(&format!(r#"{{"schema": {schema}, "divider": 0.25}}"#));
        let old = old.unwrap();
        assert_eq!(
            (old.laboratory, old.divider),
            (LaboratoryState::default(), 0.25)
        );
    }
    let ui = open(AppState {
        environment: small().environment,
        texel_budget: small().texel_budget,
        ..read
    });
    ui.get_by_label_contains("nothing is measured until you ask");
    ui.get_by_label("atan-9");
}

#[test]
fn nothing_is_clipped_or_fails_when_tiny() {
    let maps = [MappingId::Ccm, MappingId::Latlong, MappingId::Cube];
    let mut scene = laboratory(MappingId::Ccm);
    scene.laboratory.beside = maps[1..].to_vec();
    scene.laboratory.budget_on = true;
    let mut ui = filled(scene, &maps);
    for (width, height) in WINDOW_SIZES {
        ui.set_size(egui::vec2(width, height));
        for pane in [None, Some(Pane::Laboratory)] {
            run(&mut ui, Action::SetMaximised(pane));
            if width < 800.0 || pane.is_none() {
                continue;
            }
            // What does not scroll lies in the window, beside the inspector.
            let inspector = middle_end(&ui, width);
            for label in [
                "Measure",
                "carefully",
                "Save …",
                "Mappings …",
                "error budget",
            ] {
                let rect = ui.query_all_by_label(label).next().unwrap().rect();
                assert!(
                    rect.left() > 0.0 && rect.right() < inspector,
                    "{label} in {width}: {rect:?}"
                );
            }
            let errors = ui.get_by_label("Errors").rect();
            assert!(
                errors.width() > 100.0 && errors.height() > 55.0,
                "{errors:?} in {width}"
            );
            let points = ui.query_all_by_label_contains("Point: ");
            for point in points {
                assert!(
                    point.rect().right() < inspector,
                    "{:?} in {width}",
                    point.rect()
                );
            }
        }
    }
    assert_eq!(ui.state().explorer().messages(), []);
}
