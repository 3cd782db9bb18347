//! The loss laboratory in the window: what is measured, where the worst texel is, and what is left undone.

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
use sixfold::app::loss::Shown;
use sixfold::app::panel_view::PanelWindow;
use sixfold::app::state::{AppState, LOSS_ROWS, LossState};
use sixfold::imaging::resample::Filter;
use sixfold::imaging::{Environment, Samples};
use sixfold::mapping::{ChartPoint, MappingId};
use sixfold::math::{Rotation, Vec3, angle_rad};
use window_kit::{Ui, WINDOW_SIZES, click_at, open, probe, run, settle, small};

/// Small maps with the laboratory shown; lines and letters lose something.
fn laboratory(loss: LossState) -> AppState {
    AppState {
        environment: Environment::LabelledFaces,
        loss: LossState { open: true, ..loss },
        ..small()
    }
}

fn quick() -> LossState {
    LossState {
        from_rows: 64,
        via_rows: 32,
        ..LossState::default()
    }
}

fn shown(ui: &Ui) -> &Shown {
    ui.state().explorer().labs().loss.shown().unwrap()
}

fn jobs(ui: &Ui) -> Vec<String> {
    let jobs = ui.state().explorer().jobs();
    jobs.into_iter().map(|job| job.title).collect()
}

/// Where a direction lies on the residual.
fn place(ui: &Ui, dir: Vec3<f64>) -> egui::Pos2 {
    let mapping = shown(ui).wanted.settings.from;
    let info = mapping.info();
    let view = ui.state().explorer().state().panel(mapping);
    let rect = ui.get_by_label("Residual").rect();
    let window = PanelWindow::new(rect, &view, info.layout.picture_aspect(info.aspect) as f32);
    let point = mapping.forward(dir).unwrap();
    window.screen_from_picture(info.layout.picture_from_chart(point).unwrap())
}

/// Angle between the probe and a direction, in texels of the map that is measured at its equator.
fn texels_off(ui: &Ui, dir: [f64; 3]) -> f64 {
    let rows = f64::from(shown(ui).wanted.settings.from_rows);
    angle_rad(probe(ui).to_f64(), dir) / (std::f64::consts::PI / rows)
}

#[test]
fn the_numbers_stand_together_and_the_worst_texel_takes_the_probe() {
    let mut ui = open(laboratory(quick()));
    // Speed and error are one text.
    ui.get_by_label_contains("ms (bicubic), back in");
    ui.get_by_label_contains("RMS");
    ui.get_by_label("A: Latlong 128×64; B: Cube map 6 × 32×32");
    let factor = shown(&ui).factor;
    assert!(factor.is_power_of_two());
    ui.get_by_label(&format!("differences × {factor}"));
    // Nine tenths of what differs is below white, and would not be at twice the magnification.
    let clipped = |factor: u32| {
        let Samples::F32(light) =
            shown(&ui).measured.loss.difference.residual.rasters()[0].samples()
        else {
            panic!("no floats");
        };
        let texels = light.as_chunks::<3>().0.iter();
        let largest = texels.map(|[r, g, b]| r.max(*g).max(*b));
        let differ: Vec<f32> = largest.filter(|light| *light > 0.0).collect();
        let white = differ.iter().filter(|light| **light * factor as f32 > 1.0);
        white.count() as f64 / differ.len() as f64
    };
    assert!(clipped(factor) <= 0.1 && clipped(2 * factor) > 0.1);
    let worst = shown(&ui).measured.loss.difference.worst;
    assert!(worst.difference > 0.01);
    assert!(
        texels_off(&ui, worst.dir) > 1.0,
        "control: it is there already"
    );
    ui.get_by_label_contains("worst texel:").click();
    settle(&mut ui);
    assert!(texels_off(&ui, worst.dir) < 1e-3);
    assert!(!ui.state().explorer().state().probe_follows);
}

#[test]
fn a_click_on_the_residual_moves_the_probe_there_and_near_the_ring_onto_the_worst_texel() {
    let mut ui = open(laboratory(LossState {
        from: MappingId::Ccm,
        ..quick()
    }));
    let worst = shown(&ui).measured.loss.difference.worst;
    let at = place(&ui, Vec3::from_f64(worst.dir));
    click_at(&mut ui, at + egui::vec2(3.0, 2.0));
    assert!(texels_off(&ui, worst.dir) < 1e-3);
    // Elsewhere: the middle of a face, which is not the worst texel's.
    let elsewhere = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]
        .into_iter()
        .find(|dir| angle_rad(*dir, worst.dir) > 0.9)
        .unwrap();
    let at = place(&ui, Vec3::from_f64(elsewhere));
    let before = ui.render().unwrap();
    click_at(&mut ui, at);
    assert!(texels_off(&ui, elsewhere) < 1.0);
    assert!(texels_off(&ui, worst.dir) > 5.0, "control");
    // The ring of the probe's mark lies around the place on the residual, and did not before.
    let after = ui.render().unwrap();
    let at = place(&ui, probe(&ui));
    let white = |picture: &image::RgbaImage| {
        let is_white = |radius: f32, turn: f32| {
            let on = at + radius * egui::vec2(turn.cos(), turn.sin());
            let [r, g, b, _] = picture.get_pixel(on.x as u32, on.y as u32).0;
            r > 100 && r.abs_diff(g) < 10 && g.abs_diff(b) < 10
        };
        let around = (0..48).map(|i| i as f32 / 48.0 * std::f32::consts::TAU);
        let on = around.filter(|turn| [5.5, 6.0, 6.5].iter().any(|r| is_white(*r, *turn)));
        on.count()
    };
    assert!(white(&after) >= 24, "{}", white(&after));
    assert!(
        white(&before) < white(&after),
        "control: {}",
        white(&before)
    );
}

#[test]
fn nothing_is_lost_by_the_nearest_texel_of_the_same_map() {
    let same = LossState {
        via: MappingId::Latlong,
        via_rows: 64,
        filter: Some(Filter::Nearest),
        ..quick()
    };
    let mut ui = open(laboratory(same));
    ui.get_by_label_contains("nothing is lost: every texel came back exactly; there in");
    ui.get_by_label("differences: black everywhere");
    assert!(ui.query_by_label_contains("worst texel").is_none());
    let difference = &shown(&ui).measured.loss.difference;
    assert_eq!((difference.rms, difference.worst.difference), (0.0, 0.0));
    // Control: half the rows lose something.
    let coarser = LossState {
        open: true,
        via_rows: 32,
        ..same
    };
    run(&mut ui, Action::SetLoss(coarser));
    assert!(ui.query_by_label_contains("nothing is lost").is_none());
    assert!(shown(&ui).measured.loss.difference.rms > 1e-3);
}

#[test]
fn a_hidden_laboratory_computes_nothing() {
    const JOB: &str = "measuring the loss";
    let slow = LossState {
        from_rows: 256,
        via_rows: 256,
        filter: Some(Filter::Lanczos),
        ..quick()
    };
    let mut ui = open(laboratory(slow));
    // Other surroundings and a turn are measured anew; what is shown only is not.
    let measured = |ui: &Ui| std::sync::Arc::as_ptr(&shown(ui).measured);
    let before = measured(&ui);
    run(
        &mut ui,
        Action::SetLoss(LossState {
            open: true,
            magnification: Some(4),
            ..slow
        }),
    );
    assert_eq!((measured(&ui), shown(&ui).factor), (before, 4));
    let tell = |ui: &mut Ui, command: Command| {
        let ctx = ui.ctx.clone();
        ui.state_mut().explorer_mut().run(&ctx, command);
        ui.step();
    };
    let is_measuring = |ui: &Ui| jobs(ui).iter().any(|title| title.starts_with(JOB));
    let turn = |yaw| Action::SetRotation(Rotation::from_degrees([yaw, 0.0, 0.0])).into();
    for hide in [
        Action::SetLoss(slow),
        Action::SetMaximised(Some(Pane::Viewport)),
    ] {
        let yaw = ui.state().explorer().state().rotation.degrees()[0];
        tell(&mut ui, turn(yaw + 10.0));
        assert!(is_measuring(&ui), "control: {:?}", jobs(&ui));
        tell(&mut ui, hide.into());
        assert!(!is_measuring(&ui), "{:?}", jobs(&ui));
        tell(&mut ui, turn(yaw + 20.0));
        settle(&mut ui);
        assert_eq!(measured(&ui), before, "measured while hidden");
        // Seen again, it is measured.
        let loss = LossState { open: true, ..slow };
        tell(&mut ui, Action::SetMaximised(None).into());
        tell(&mut ui, Action::SetLoss(loss).into());
        ui.step();
        assert!(is_measuring(&ui), "{:?}", jobs(&ui));
        // Stopped by the user it stays stopped until it is asked for.
        let job = ui.state().explorer().jobs().into_iter();
        let job = job.into_iter().find(|job| job.title.starts_with(JOB));
        tell(&mut ui, Command::Cancel(job.unwrap().id));
        settle(&mut ui);
        assert_eq!(measured(&ui), before);
        ui.get_by_label("measuring was cancelled");
    }
    ui.get_by_role_and_label(egui::Role::Button, "Measure again")
        .click();
    settle(&mut ui);
    assert_ne!(measured(&ui), before);
    assert!(window_kit::rests(&mut ui));
    // Of surroundings that are gone, a hidden laboratory keeps nothing.
    run(&mut ui, Action::SetLoss(slow));
    assert!(
        ui.state().explorer().labs().loss.shown().is_some(),
        "control"
    );
    let other = Environment::DirectionColor;
    run(&mut ui, Command::LoadEnvironment(other));
    assert!(ui.state().explorer().labs().loss.shown().is_none());
}

#[test]
fn settings_are_kept_undone_and_brought_into_range() {
    let mut state = AppState::default();
    let wild = LossState {
        open: true,
        from: MappingId::Octahedral,
        from_rows: 0,
        via: MappingId::Sphere,
        via_rows: u32::MAX,
        filter: Some(Filter::Area),
        magnification: Some(100),
    };
    apply(&mut state, Action::SetLoss(wild));
    let loss = state.loss;
    assert_eq!((loss.from_rows, loss.via_rows), LOSS_ROWS);
    assert_eq!(loss.magnification, Some(64));
    let json = state.to_json().unwrap();
    assert!(json.contains(r#""filter": "area""#), "{json}");
    assert_eq!(AppState::from_json(&json).unwrap(), state);
    assert_ne!(AppState::from_json(&json).unwrap(), AppState::default());
    let none = AppState::from_json(r#"{"schema": 4, "loss": {"magnification": 0}}"#).unwrap();
    assert_eq!(none.loss.magnification, Some(1));
    // A scene from before has none.
    let old = AppState::from_json(r#"{"schema": 2, "curves_open": true}"#).unwrap();
    assert_eq!(old.loss, LossState::default());

    let mut ui = open(laboratory(quick()));
    let before = ui.state().explorer().state().loss;
    ui.get_by_role_and_label(egui::Role::ComboBox, "filter")
        .click();
    settle(&mut ui);
    ui.get_by_label("bilinear").click();
    settle(&mut ui);
    let after = ui.state().explorer().state().loss;
    assert_eq!(after.filter, Some(Filter::Bilinear));
    ui.get_by_label_contains("ms (bilinear), back in");
    run(&mut ui, Command::Undo);
    assert_eq!(ui.state().explorer().state().loss, before);
    ui.get_by_label_contains("ms (bicubic), back in");
    // Another mapping is as fine as the one before.
    ui.get_by_role_and_label(egui::Role::ComboBox, "A").click();
    settle(&mut ui);
    // Below the fold of a long list.
    ui.get_by_role_and_label(egui::Role::Button, "Angular map")
        .scroll_to_me();
    settle(&mut ui);
    ui.get_by_role_and_label(egui::Role::Button, "Angular map")
        .click();
    settle(&mut ui);
    let loss = ui.state().explorer().state().loss;
    assert_eq!((loss.from, loss.from_rows), (MappingId::Angular, 128));
}

#[test]
fn the_residual_lies_as_the_maps_panel_does() {
    let mut ui = open(laboratory(quick()));
    for from in [MappingId::Cube, MappingId::Paraboloid] {
        let loss = LossState {
            from,
            open: true,
            ..quick()
        };
        run(&mut ui, Action::SetLoss(loss));
        let difference = &shown(&ui).measured.loss.difference;
        let residual = &difference.residual;
        let info = from.info();
        let [columns, rows] = info.layout.grid();
        let size = residual.shape().size;
        let picture = [columns * size[0], rows * size[1]];
        assert_eq!(residual.rasters()[0].size(), picture, "{from}");
        assert_eq!(shown(&ui).picture.size(), picture.map(|n| n as usize));
        let worst = difference.worst;
        let [u, v] = [0, 1].map(|k| (f64::from(worst.texel[k]) + 0.5) / f64::from(size[k]));
        let dir = from.inverse::<f64>(ChartPoint::new(worst.chart, u, v));
        assert!(angle_rad(dir.unwrap().to_f64(), worst.dir) < 1e-9, "{from}");
    }
}

#[test]
fn nothing_is_clipped_or_fails_when_tiny() {
    let mut ui = open(laboratory(quick()));
    for (width, height) in WINDOW_SIZES {
        ui.set_size(egui::vec2(width, height));
        for pane in [None, Some(Pane::Loss)] {
            run(&mut ui, Action::SetMaximised(pane));
            if width >= 800.0 {
                let residual = ui.get_by_label("Residual").rect();
                let least = if pane.is_some() { 120.0 } else { 60.0 };
                assert!(residual.width() > least, "{residual:?} in {width}");
            }
        }
    }
    assert_eq!(ui.state().explorer().messages(), []);
}
