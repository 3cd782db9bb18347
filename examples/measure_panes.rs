//! How long a frame keeps the window's thread, pane by pane: `cargo run --release --example measure_panes [WIDTHxHEIGHT [pieces|fold|ranking|panels]]`.
//!
//! Medians of the processor's time to lay a whole window out, what the panes paint and what the frame plan decides with it, and to
//! cut that into triangles; drawing is the adapter's. What only a change costs is timed with a change before every frame.

use std::sync::Arc;
use std::time::{Duration, Instant};

use eframe::egui_wgpu;
use egui::mutex::RwLock;
use egui::{Context, RawInput, Rect, vec2};
use sixfold::app::action::Action;
use sixfold::app::arrangement::Pane;
use sixfold::app::command::Command;
use sixfold::app::explorer::Explorer;
use sixfold::app::fold::{SheetWanted, Surface, project};
use sixfold::app::state::{AppState, FoldState, Overlays, RankingPlot, RankingState};
use sixfold::app::theme;
use sixfold::gpu::Gpu;
use sixfold::imaging::{Environment, Progress};
use sixfold::lab::metrics::Quantity;
use sixfold::mapping::MappingId;

/// Frames that are timed for each line.
const FRAMES: usize = 41;
/// One of each kind: charts that are folded to a cube, rolled up, many, bent along diagonals; discs.
const MAPPINGS: [MappingId; 6] = [
    MappingId::Ccm,
    MappingId::Latlong,
    MappingId::Healpix,
    MappingId::Qsc,
    MappingId::Stereographic,
    MappingId::Matcap,
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = std::env::args().nth(1).unwrap_or("1280x800".to_owned());
    let (width, height) = text.split_once('x').ok_or("the size is WIDTHxHEIGHT")?;
    let size = vec2(width.parse()?, height.parse()?);
    let gpu = Gpu::headless()?;
    eprintln!("{} at {text}, medians of {FRAMES} frames, ms", gpu.name());
    let part = std::env::args().nth(2);
    let is_asked = |name: &str| part.as_deref().is_none_or(|part| part == name);
    if is_asked("pieces") {
        MAPPINGS.into_iter().for_each(pieces);
    }
    if is_asked("fold") {
        for mapping in MAPPINGS {
            fold(&gpu, mapping, size);
        }
    }
    if is_asked("ranking") {
        ranking(&gpu, size);
    }
    if is_asked("panels") {
        panels(&gpu, size);
    }
    Ok(())
}

fn base() -> AppState {
    AppState {
        texel_budget: 6 * 64 * 64,
        environment: Environment::DirectionColor,
        ..AppState::default()
    }
}

/// Everything that can lie over a map.
fn all() -> Overlays {
    Overlays {
        great_circles: true,
        grid: true,
        ellipses: true,
        heat: Some(Quantity::Shape),
        ..Overlays::default()
    }
}

fn fold(gpu: &Gpu, mapping: MappingId, size: egui::Vec2) {
    let id = mapping.info().id;
    for (what, overlays) in [("bare", Overlays::NONE), ("all overlays", all())] {
        let mut state = AppState {
            mapping,
            maximised: Some(Pane::Fold),
            overlays,
            ..base()
        };
        state.fold.open = true;
        let mut window = Window::open(gpu, state, size);
        window.time(&format!("fold, {id}, {what}, still"), |_| None);
        window.time(&format!("fold, {id}, {what}, turned"), |state| {
            let mut fold = state.fold;
            fold.camera.orbit(0.02, 0.0);
            Some(Action::SetFoldCamera(fold.camera))
        });
        window.time(&format!("fold, {id}, {what}, folded"), |state| {
            let share = (state.fold.share + 0.01) % 1.0;
            let fold = FoldState {
                share,
                ..state.fold
            };
            Some(Action::SetFold(fold))
        });
    }
}

fn ranking(gpu: &Gpu, size: egui::Vec2) {
    for plot in RankingPlot::ALL {
        let mut state = AppState {
            maximised: Some(Pane::Ranking),
            ..base()
        };
        state.ranking.open = true;
        state.ranking.plot = plot;
        let mut window = Window::open(gpu, state, size);
        let name = format!("ranking, {}", plot.name());
        window.time(&format!("{name}, still"), |_| None);
        window.time(&format!("{name}, weighed anew"), |state| {
            let weight = (state.ranking.weight + 0.013) % 1.0;
            Some(Action::SetRanking(Box::new(RankingState {
                weight,
                ..state.ranking.clone()
            })))
        });
    }
}

fn panels(gpu: &Gpu, size: egui::Vec2) {
    for (what, heat, ellipses) in [
        ("", None, false),
        (", heat maps", Some(Quantity::Shape), false),
        (", ellipses", None, true),
        (", both", Some(Quantity::Shape), true),
    ] {
        let mut state = base();
        for panel in &mut state.panels {
            panel.open = true;
        }
        let mut window = Window::open(gpu, state, size);
        let overlays = Overlays {
            heat,
            ellipses,
            ..window.explorer.state().overlays
        };
        window.act(Action::SetOverlays(overlays));
        let start = Instant::now();
        window.settle();
        let name = format!("{} panels{what}", MappingId::ALL.len());
        let time = start.elapsed().as_secs_f64();
        eprintln!("{name:44} at rest after {time:.2} s");
        window.time(&name, |_| None);
        window.time(&format!("{name}, probe moved"), moved_probe);
    }
    // The viewport draws its probe itself; panels do not.
    for (name, pane) in [
        ("viewport", Pane::Viewport),
        ("one panel", Pane::Map(MappingId::Ccm)),
    ] {
        let state = AppState {
            maximised: Some(pane),
            ..base()
        };
        let mut window = Window::open(gpu, state, size);
        window.time(name, |_| None);
        window.time(&format!("{name}, probe moved"), moved_probe);
    }
}

fn moved_probe(state: &AppState) -> Option<Action> {
    let [x, y, z] = state.probe_f64().to_f64();
    let (sin, cos) = 0.02_f64.sin_cos();
    let dir = [cos * x - sin * z, y, sin * x + cos * z];
    Some(Action::SetProbe {
        dir: dir.map(|c| c as f32),
        eye_ray: None,
    })
}

/// What the fold pane is made of: traced in a job, then found anew for every fold and eye.
fn pieces(map: MappingId) {
    for deg in [20.0, 8.0] {
        let overlays = Overlays {
            ellipses_deg: deg,
            ..all()
        };
        let wanted = SheetWanted::new(map, overlays);
        let make = || wanted.make(&Progress::new());
        let Some(sheet) = make() else { return };
        let traced = ms(make);
        for share in [0.25, 0.75] {
            let surface = Surface::new(map, share, FoldState::default().camera, 1.6);
            let quads = || surface.quads_between(&sheet.corners);
            let lines = || project(&surface, &sheet.lines);
            let points: usize = lines().iter().map(|line| line.at.len()).sum();
            eprintln!(
                "{:14} {deg:2} deg, share {share}: traced in {traced:5.2}, {} quads {:.2}, {points} points of lines {:.2}",
                map.info().id,
                quads().len(),
                ms(quads),
                ms(lines)
            );
        }
    }
}

fn ms<T>(mut make: impl FnMut() -> T) -> f64 {
    let time = |_| {
        let start = Instant::now();
        std::hint::black_box(make());
        start.elapsed()
    };
    median((0..FRAMES).map(time).collect())
}

fn median(mut times: Vec<Duration>) -> f64 {
    times.sort();
    times[times.len() / 2].as_secs_f64() * 1e3
}

/// A window without a screen.
struct Window {
    explorer: Explorer,
    ctx: Context,
    size: egui::Vec2,
}

impl Window {
    fn open(gpu: &Gpu, state: AppState, size: egui::Vec2) -> Self {
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let painter = egui_wgpu::Renderer::new(&gpu.device, format, Default::default());
        let painter = Arc::new(RwLock::new(painter));
        let ctx = Context::default();
        theme::install(&ctx);
        let mut window = Self {
            explorer: Explorer::new(gpu.clone(), painter, state),
            ctx,
            size,
        };
        window.settle();
        window
    }

    /// A frame: the time of the layout, and of the triangles.
    fn frame(&mut self) -> [Duration; 2] {
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(egui::Pos2::ZERO, self.size)),
            ..RawInput::default()
        };
        let start = Instant::now();
        let explorer = &mut self.explorer;
        let mut output = self.ctx.run_ui(input, |ui| {
            explorer.logic(ui.ctx());
            explorer.ui(ui);
        });
        let laid_out = start.elapsed();
        output.textures_delta.clear();
        let start = Instant::now();
        std::hint::black_box(self.ctx.tessellate(output.shapes, 1.0));
        [laid_out, start.elapsed()]
    }

    fn settle(&mut self) {
        self.frame();
        while self.explorer.is_busy() {
            std::thread::sleep(Duration::from_millis(2));
            self.frame();
        }
        for _ in 0..8 {
            self.frame();
        }
    }

    fn act(&mut self, action: Action) {
        self.explorer.run(&self.ctx, Command::Do(action));
    }

    /// Prints the medians of frames, before each of which something is changed.
    fn time(&mut self, what: &str, change: impl Fn(&AppState) -> Option<Action>) {
        let mut times = [Vec::new(), Vec::new()];
        for _ in 0..FRAMES {
            if let Some(action) = change(self.explorer.state()) {
                self.act(action);
            }
            for (times, time) in times.iter_mut().zip(self.frame()) {
                times.push(time);
            }
        }
        let [laid_out, triangles] = times.map(median);
        eprintln!("{what:44} layout {laid_out:6.2}, triangles {triangles:6.2}");
    }
}
