//! Frames a second while the camera orbits: `cargo run --release --example measure_orbit [WIDTHxHEIGHT]`.
//!
//! Each frame is a whole window: layout, the viewport drawn anew by the adapter, the window painted; then the device is waited
//! for. Maps and panels are not drawn again, as in the window. Last it tells how long single frames keep the window's thread.

use std::sync::Arc;
use std::time::Instant;

use sixfold::app::action::Action;
use sixfold::app::command::Command;
use sixfold::app::model::Surroundings;
use sixfold::app::offscreen::Offscreen;
use sixfold::app::picture::What;
use sixfold::app::state::AppState;
use sixfold::gpu::Gpu;
use sixfold::imaging::Progress;
use sixfold::mapping::MappingId;

/// Frames that are timed for each mapping.
const FRAMES: u32 = 60;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = std::env::args().nth(1).unwrap_or("1280x800".to_owned());
    let (width, height) = text.split_once('x').ok_or("the size is WIDTHxHEIGHT")?;
    let size = [width.parse()?, height.parse()?];
    let gpu = Gpu::headless()?;
    eprintln!("{} at {text}, {FRAMES} frames each", gpu.name());
    let state = AppState::default();
    let environment = state.environment.clone();
    let loaded = Arc::new(environment.image(&Progress::new())?);
    let mut screen = Offscreen::new(&gpu, state, What::Window, size)?;
    screen.show(Surroundings {
        environment,
        loaded,
    })?;
    let wait = || gpu.device.poll(wgpu::PollType::wait_indefinitely());
    for &mapping in MappingId::ALL {
        let ctx = screen.ctx().clone();
        screen
            .explorer
            .run(&ctx, Command::Do(Action::SetMapping(mapping)));
        for _ in 0..20 {
            screen.frame();
        }
        wait()?;
        for (what, dx_rad) in [("orbit", 0.02), ("the window alone", 0.0)] {
            let mut times = Vec::new();
            for _ in 0..FRAMES {
                let start = Instant::now();
                let turn = Action::Orbit {
                    dx_rad,
                    dy_rad: 0.0,
                };
                screen.explorer.run(&ctx, Command::Do(turn));
                screen.frame();
                wait()?;
                times.push(start.elapsed().as_secs_f64());
            }
            times.sort_by(f64::total_cmp);
            let median = times[times.len() / 2];
            eprintln!(
                "{:24} {what:17} {:5.1} frames/s (median {:.1} ms, slowest {:.1} ms)",
                mapping.info().id,
                1.0 / median,
                median * 1e3,
                times[times.len() - 1] * 1e3
            );
        }
    }
    // What the window's thread itself spends on a frame: usual, and the first after a switch that needs another shader.
    let ctx = screen.ctx().clone();
    let mut overlays = screen.explorer.state().overlays;
    for what in [
        "a usual frame",
        "an overlay's first",
        "a usual frame",
        "an overlay's last",
    ] {
        if what.starts_with("an") {
            overlays.great_circles = !overlays.great_circles;
            screen
                .explorer
                .run(&ctx, Command::Do(Action::SetOverlays(overlays)));
        }
        let start = Instant::now();
        screen.frame();
        eprintln!(
            "{what:24} keeps the thread for {:.1} ms",
            start.elapsed().as_secs_f64() * 1e3
        );
        wait()?;
    }
    Ok(())
}
