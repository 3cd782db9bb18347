//! How long light takes through glass: `cargo run --release --no-default-features --example measure_trace [WIDTHxHEIGHT]`.
//!
//! For each object the whole view with two inner reflections on all cores; on one core the same beside what each pixel hits
//! first; and how many pixels see light that finds no way out of the mesh.

use std::time::Instant;

use sixfold::scene::{Camera, Object, Target, trace, trace_view};

/// Runs of which the median counts.
const RUNS: usize = 5;
/// Inner reflections.
const BOUNCES: u32 = 2;
/// Air over crown glass.
const ETA: f32 = 1.0 / 1.5168;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = std::env::args().nth(1).unwrap_or("640x480".to_owned());
    let (width, height) = text.split_once('x').ok_or("the size is WIDTHxHEIGHT")?;
    let [width, height]: [u32; 2] = [width.parse()?, height.parse()?];
    let threads = std::thread::available_parallelism()?.get();
    eprintln!("{width}x{height}, {BOUNCES} inner reflections, {threads} threads, median of {RUNS}");
    let camera = Camera {
        yaw_rad: 0.5,
        pitch_rad: 0.3,
        ..Camera::default()
    };
    let frame = camera.ray_frame(width as f32 / height as f32);
    for object in Object::ALL {
        let target = Target::new(object.mesh());
        let rays = || {
            let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            pixels.map(|(x, y)| {
                let u = (x as f32 + 0.5) / width as f32;
                frame.ray((u, (y as f32 + 0.5) / height as f32))
            })
        };
        let first = median_ms(|| rays().filter_map(|ray| target.cast(ray)).count());
        let paths = || rays().map(|ray| trace(&target, ray, ETA, BOUNCES).as_slice().len());
        let each = median_ms(|| paths().sum::<usize>());
        let view = || trace_view(&target, &camera, [width, height], ETA, BOUNCES, &|_| false);
        let whole = median_ms(view);
        let traced = view().ok_or("the picture does not fit in memory")?;
        let pixels = (width * height) as usize;
        let hit = |i: &usize| traced.dirs[*i][3] < 1.0;
        let hits = (0..pixels).filter(hit).count();
        let zero = |i: &usize| {
            (1..traced.layers as usize).any(|l| traced.dirs[l * pixels + i][..3] == [0.0; 3])
        };
        let astray = (0..pixels).filter(hit).filter(zero).count();
        eprintln!(
            "{:13} view {whole:6.1} ms; on one thread {each:6.1} ms, {:.2} times the first hits alone ({first:6.1} ms); {:.0} % of \
             pixels hit, {:.2} % of them see through an open part",
            object.name(),
            each / first,
            100.0 * hits as f64 / pixels as f64,
            100.0 * astray as f64 / hits.max(1) as f64
        );
    }
    Ok(())
}

/// Median time of [`RUNS`] runs, in milliseconds.
fn median_ms<T>(run: impl Fn() -> T) -> f64 {
    let mut times: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            std::hint::black_box(run());
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}
