//! The window on a software adapter, for the tests that look at it by role and label.

#![allow(dead_code)] // each test file uses some
#![expect(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::{Harness, HarnessBuilder};
use sixfold::app::action::{Action, apply};
use sixfold::app::arrangement::Pane;
use sixfold::app::command::Command;
use sixfold::app::laboratory::Measured;
use sixfold::app::state::AppState;
use sixfold::app::{Lost, Window};
use sixfold::gpu::context;
use sixfold::imaging::{Environment, Progress};
use sixfold::lab::bench::{Plan, Row, bench, mark_front};
use sixfold::lab::clock::Clock;
use sixfold::lab::devices::Devices;
use sixfold::lab::inputs::Inputs;
use sixfold::lab::machine::Machine;
use sixfold::mapping::{MappingId, NoDevice};
use sixfold::math::Vec3;

pub type Ui = Harness<'static, Window>;

/// Widths and heights of windows in which nothing may fail, and in the large ones nothing be clipped; it comes back from the smallest.
pub const WINDOW_SIZES: [(f32, f32); 5] = [
    (1280.0, 800.0),
    (800.0, 600.0),
    (300.0, 200.0),
    (1.0, 1.0),
    (800.0, 600.0),
];

/// Widths and heights of windows in which each tile is readable.
pub const TILED_SIZES: [(f32, f32); 2] = [(1280.0, 800.0), (800.0, 600.0)];

/// A window of 1280 x 800 on a software adapter; no adapter is a failure.
pub fn open(state: AppState) -> Ui {
    open_sized(state, 1280.0, 800.0)
}

pub fn open_sized(state: AppState, width: f32, height: f32) -> Ui {
    let mut ui = open_unsettled(state, width, height, Lost::default());
    settle(&mut ui);
    ui
}

pub fn open_unsettled(state: AppState, width: f32, height: f32, lost: Lost) -> Ui {
    let mut setup = egui_kittest::wgpu::default_wgpu_setup();
    if let egui_wgpu::WgpuSetup::CreateNew(new) = &mut setup {
        new.device_descriptor = std::sync::Arc::new(context::device_descriptor);
    }
    HarnessBuilder::default()
        .with_size([width, height])
        .wgpu_setup(setup)
        .build_eframe(|creation| Window::new(creation, state, lost).unwrap())
}

/// Small maps: what is tested here does not depend on their size.
pub fn small() -> AppState {
    AppState {
        texel_budget: 6 * 64 * 64,
        environment: Environment::DirectionColor,
        ..AppState::default()
    }
}

/// Steps until no job runs and no map is missing.
pub fn settle(ui: &mut Ui) {
    let start = Instant::now();
    ui.step();
    while ui.state().explorer().is_busy() {
        assert!(
            start.elapsed() < Duration::from_secs(120),
            "the window does not come to rest"
        );
        std::thread::sleep(Duration::from_millis(5));
        ui.step();
    }
    ui.run_steps(4);
}

/// True when the window comes to ask for no more frames. A job wakes it when it ends, which may be after its result was taken
/// in, and on a busy machine an animation ends late: it has half a second to be still eight times on end. A window that does not
/// rest asks again and again.
pub fn rests(ui: &mut Ui) -> bool {
    let mut still = 0;
    for _ in 0..100 {
        std::thread::sleep(Duration::from_millis(5));
        ui.run_steps(5);
        still = if ui.ctx.has_requested_repaint() {
            0
        } else {
            still + 1
        };
        if still == 8 {
            return true;
        }
    }
    false
}

pub fn run(ui: &mut Ui, command: impl Into<Command>) {
    let ctx = ui.ctx.clone();
    ui.state_mut().explorer_mut().run(&ctx, command.into());
    settle(ui);
}

pub fn probe(ui: &Ui) -> Vec3<f64> {
    ui.state().explorer().state().probe_f64()
}

/// Measurements with errors that hold and times that `time` makes up, so that they are the same on every machine.
pub fn measured_with(maps: &[MappingId], time: impl FnMut(&mut Row)) -> Measured {
    let plan = Plan {
        maps: maps.to_vec(),
        inputs: Inputs::ALL.to_vec(),
        few: 64,
        many: 128,
        judged: 512,
        clock: Clock {
            samples: 1,
            shortest: Duration::ZERO,
        },
        devices: Devices::Cpu,
        ..Plan::full()
    };
    let mut rows = bench(&plan, &NoDevice("not asked"), &Progress::new()).rows;
    rows.iter_mut().for_each(time);
    mark_front(&mut rows);
    Measured {
        rows,
        machine: Machine::this(None),
    }
}

/// A click with the pointer, after which the window comes to rest.
pub fn click_at(ui: &mut Ui, at: egui::Pos2) {
    ui.hover_at(at);
    ui.step();
    ui.drag_at(at);
    ui.step();
    ui.drop_at(at);
    settle(ui);
}

/// Every text in the window.
pub fn texts(ui: &Ui) -> Vec<String> {
    let all = ui.query_all_by(|node| node.label().is_some() || node.value().is_some());
    let text = |node: egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        node.label().or(node.value()).unwrap_or_default()
    };
    all.map(text).collect()
}

/// Where the inspector at the right begins, or the window ends: what is in the middle lies left of it.
pub fn middle_end(ui: &Ui, width: f32) -> f32 {
    let inspector = ui.query_by_label("follows the pointer");
    inspector.map_or(width, |node| node.rect().left())
}

/// The mappings with the longest names, and the one that is selected at first.
pub fn long_names() -> Vec<MappingId> {
    let mut maps = MappingId::ALL.to_vec();
    maps.sort_by_key(|map| std::cmp::Reverse(map.info().name.chars().count()));
    maps.truncate(3);
    maps.push(AppState::default().mapping);
    maps
}

/// A tile of a pane that is read, beside the others: it has the right column, and the inspector is shut.
pub fn tiled(pane: Pane) -> AppState {
    let mut state = small();
    apply(&mut state, Action::SetPaneOpen(pane, true));
    state.inspector.open = false;
    state
}

/// The rectangle on the screen that the tile of such a pane has below its tab.
pub fn tile(ui: &Ui, pane: Pane) -> egui::Rect {
    /// Height of the status bar.
    const STATUS: f32 = 24.0;
    let button = |pane: Pane| {
        let label = format!("Maximise {}", pane.name());
        ui.get_by_label(&label).rect()
    };
    let own = button(pane);
    let bottom = ui.ctx.content_rect().bottom() - STATUS;
    egui::Rect::from_min_max(
        egui::pos2(button(Pane::Viewport).right(), own.bottom()),
        egui::pos2(own.right(), bottom),
    )
}

/// What can be read or used in that tile: what it is, its text, its rectangle. What `scrolls` sideways by itself is left out.
fn things(
    ui: &Ui,
    tile: egui::Rect,
    scrolls: impl Fn(&str) -> bool,
) -> Vec<(Role, String, egui::Rect)> {
    const KINDS: [Role; 7] = [
        Role::Button,
        Role::CheckBox,
        Role::ComboBox,
        Role::Image,
        Role::Label,
        Role::Slider,
        Role::SpinButton,
    ];
    let all = ui.query_all_by(|node| KINDS.contains(&node.role()));
    let of = |node: egui_kittest::Node<'_>| {
        let rect = node.rect();
        let node = node.accesskit_node();
        let text = node.label().or(node.value()).unwrap_or_default();
        (node.role(), text, rect)
    };
    // What was pushed out of the window at the right still begins right of the tile's left side.
    let is_own = |rect: &egui::Rect| {
        rect.left() > tile.left() && tile.y_range().contains(rect.top()) && rect.is_positive()
    };
    all.map(of)
        .filter(|(_, text, rect)| is_own(rect) && !scrolls(text))
        .collect()
}

/// Asserts that the tile of a pane shows things of these kinds and that none of its things leaves it at the right.
pub fn assert_within(ui: &Ui, pane: Pane, kinds: &[Role], scrolls: impl Fn(&str) -> bool) {
    let tile = tile(ui, pane);
    let things = things(ui, tile, scrolls);
    for kind in kinds {
        assert!(
            things.iter().any(|thing| thing.0 == *kind),
            "no {kind:?} in {pane:?}"
        );
    }
    let spilled = |right: f32| -> Vec<_> {
        let beyond = |thing: &&(Role, String, egui::Rect)| thing.2.right() > right + 0.5;
        things.iter().filter(beyond).collect()
    };
    assert!(
        spilled(tile.right()).is_empty(),
        "{pane:?} in {tile:?}: {:?}",
        spilled(tile.right())
    );
    // Control: in a tile of half the width something would be cut.
    assert!(!spilled(tile.center().x).is_empty(), "{things:?}");
}

/// The rectangle on the screen of a panel's picture.
pub fn panel_rect(ui: &Ui, mapping: MappingId) -> egui::Rect {
    ui.get_by_label(&format!("Panel: {}", mapping.info().name))
        .rect()
}

/// Where a direction lies on the screen in a mapping's panel.
pub fn place(ui: &Ui, mapping: MappingId, dir: Vec3<f64>) -> egui::Pos2 {
    let info = mapping.info();
    let view = ui.state().explorer().state().panel(mapping);
    let aspect = info.layout.picture_aspect(info.aspect) as f32;
    let window = sixfold::app::panel_view::PanelWindow::new(panel_rect(ui, mapping), &view, aspect);
    window.screen_from_picture(
        info.layout
            .picture_from_chart(mapping.forward(dir).unwrap())
            .unwrap(),
    )
}
