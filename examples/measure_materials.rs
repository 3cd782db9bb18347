//! What a material costs: `cargo run --release --example measure_materials [WIDTHxHEIGHT]`.
//!
//! Each frame draws the viewport anew, orbiting, on the adapter, and waits for it. The ratio to the mirror is of medians of one run,
//! in which the materials take turns.

use std::time::Instant;

use sixfold::gpu::{
    Body, EnvironmentSource, Frame, Gpu, ObjectFrame, Overlays, Renderer, Shared, ToneCurve,
    ViewportFrame,
};
use sixfold::imaging::{Environment, Progress};
use sixfold::mapping::{MappingId, ShaderForm};
use sixfold::optics::Material;
use sixfold::optics::material::{Dispersion, Surface, Surfaces};
use sixfold::scene::{Camera, Object, Target};

/// Rounds in which every material draws a frame.
const ROUNDS: usize = 40;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = std::env::args().nth(1).unwrap_or("800x600".to_owned());
    let (width, height) = text.split_once('x').ok_or("the size is WIDTHxHEIGHT")?;
    let size_px = [width.parse()?, height.parse()?];
    let gpu = Gpu::headless()?;
    eprintln!(
        "{} at {text}, sphere, medians of {ROUNDS} frames",
        gpu.name()
    );
    let image = Environment::default().image(&Progress::new())?.image;
    let source = EnvironmentSource {
        width: image.width(),
        height: image.height(),
        pixels: image.pixels(),
    };
    let body = Body {
        target: Shared::new(Target::new(Object::Sphere.mesh())),
        is_ball: true,
    };
    let of = |surface| Material {
        surface,
        ..Material::default()
    };
    let glass = |wavelengths| Material {
        wavelengths,
        ..of(Surface::Glass)
    };
    let through = |material| Material {
        surfaces: Surfaces::Both,
        ..material
    };
    let offsets = Material {
        dispersion: Dispersion::Offsets,
        ..of(Surface::Glass)
    };
    let materials = [
        ("mirror", of(Surface::Mirror)),
        ("metal", of(Surface::Metal)),
        ("glass, no dispersion", of(Surface::Dielectric)),
        ("glass, three offsets", offsets),
        ("glass, 3 wavelengths", glass(3)),
        ("glass, 16 wavelengths", glass(16)),
        (
            "both surfaces, no dispersion",
            through(of(Surface::Dielectric)),
        ),
        ("both surfaces, 16 wavelengths", through(glass(16))),
    ];
    // One renderer each: pipelines are not dropped between the turns.
    let mut renderers = Vec::new();
    for _ in &materials {
        let mut renderer = Renderer::new(gpu.clone());
        renderer.set_environment(source)?;
        renderers.push(renderer);
    }
    let mut times = vec![Vec::new(); materials.len()];
    for round in 0..=ROUNDS {
        for (i, (_, material)) in materials.iter().enumerate() {
            let frame = Frame {
                texel_budget: 6 * 512 * 512,
                tone: ToneCurve::default(),
                viewport: Some(ViewportFrame {
                    size_px,
                    camera: Camera {
                        yaw_rad: 0.02 * round as f32,
                        ..Camera::default()
                    },
                    body: body.clone(),
                    object: ObjectFrame {
                        material: material.clone(),
                        ..ObjectFrame::default()
                    },
                    right_object: None,
                    left: MappingId::Ccm,
                    right: None,
                    divider: 0.5,
                    overlays: Overlays::default(),
                    probe: [0.0, 0.0, 1.0],
                    show_probe: false,
                    form: ShaderForm::Precise,
                    form_difference: None,
                }),
                complete: true,
                ..Frame::default()
            };
            let start = Instant::now();
            renderers[i].draw(&frame)?;
            gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
            // The first round fills the map and compiles.
            if round > 0 {
                times[i].push(start.elapsed().as_secs_f64() * 1e3);
            }
        }
    }
    let mut mirror = None;
    for (times, ((name, _), renderer)) in times.iter_mut().zip(materials.iter().zip(&renderers)) {
        times.sort_by(f64::total_cmp);
        let median = times[times.len() / 2];
        let base = *mirror.get_or_insert(median);
        let work = renderer
            .report()
            .object
            .first()
            .copied()
            .unwrap_or_default();
        eprintln!(
            "{name:30} {median:7.2} ms  {:5.2} x mirror  {work}",
            median / base
        );
    }
    Ok(())
}
