//! The figures as small pictures beside the kept ones in `tests/figures`.
//!
//! After a change that is meant to be seen: `UPDATE_FIGURES=1 cargo test --test figures`, then look at every picture.

#![cfg(feature = "explorer")]
#![expect(
    clippy::unwrap_used,
    reason = "helpers of tests say what they expect by unwrapping"
)]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use image::RgbImage;
use sixfold::app::figures::{Figure, Optics};
use sixfold::app::model::Surroundings;
use sixfold::app::picture::{self, Destination, PictureRequest};
use sixfold::app::state::AppState;
use sixfold::gpu::Gpu;
use sixfold::imaging::{Environment, Progress};

const SIZE: [u32; 2] = [192, 144];

fn kept_path(figure: Figure, gpu: &Gpu) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/figures");
    // On GL a triangle takes what is not interpolated from its last vertex, elsewhere from its first.
    let is_gl = gpu.adapter_info.backend == wgpu::Backend::Gl;
    let end = if is_gl && figure == Figure::Optics(Optics::PerVertex) {
        "-gl"
    } else {
        ""
    };
    folder.join(format!("{}{end}.png", figure.id()))
}

/// The figures' environments, each loaded once.
#[derive(Default)]
struct Loads(Vec<Surroundings>);

impl Loads {
    fn of(&mut self, environment: &Environment) -> Surroundings {
        let there = self
            .0
            .iter()
            .find(|there| there.environment == *environment);
        if let Some(there) = there {
            return there.clone();
        }
        let new = Surroundings {
            loaded: Arc::new(environment.image(&Progress::new()).unwrap()),
            environment: environment.clone(),
        };
        self.0.push(new.clone());
        new
    }
}

fn drawn(gpu: &Gpu, loads: &mut Loads, figure: Figure) -> RgbImage {
    let state = AppState {
        texel_budget: 6 * 128 * 128,
        ..figure.bare()
    };
    let surroundings = loads.of(&state.environment);
    let request = PictureRequest {
        what: figure.what(),
        size: SIZE,
        overlays: true,
        to: Destination::Clipboard,
    };
    let progress = Progress::new();
    let picture = picture::draw(gpu, &state, surroundings, &request, &progress).unwrap();
    let rgb = picture
        .rgba
        .chunks_exact(4)
        .flat_map(|p| [p[0], p[1], p[2]]);
    RgbImage::from_raw(SIZE[0], SIZE[1], rgb.collect()).unwrap()
}

/// Mean difference of two pictures in bytes, and the part of pixels that differ by more than 24.
fn difference(a: &RgbImage, b: &RgbImage) -> (f64, f64) {
    assert_eq!(a.dimensions(), b.dimensions());
    let (mut sum, mut far) = (0.0, 0.0);
    for (a, b) in a.pixels().zip(b.pixels()) {
        let most = (0..3).map(|i| a.0[i].abs_diff(b.0[i])).max().unwrap_or(0);
        sum += f64::from(most);
        far += f64::from(u8::from(most > 24));
    }
    let count = f64::from(SIZE[0] * SIZE[1]);
    (sum / count, far / count)
}

#[test]
fn every_figure_looks_as_it_was_kept() {
    // 0 on the driver that drew the kept pictures, and at most 0.087 and 0.0014 on the other one, whose edges fall by a pixel
    // differently.
    const MEAN: f64 = 0.2;
    const FAR: f64 = 0.003;
    let gpu = Gpu::headless().unwrap();
    let mut loads = Loads::default();
    let figures: Vec<Figure> = Figure::all().collect();
    let pictures: Vec<RgbImage> = figures
        .iter()
        .map(|figure| drawn(&gpu, &mut loads, *figure))
        .collect();
    if std::env::var_os("UPDATE_FIGURES").is_some() {
        for (figure, picture) in figures.iter().copied().zip(&pictures) {
            picture.save(kept_path(figure, &gpu)).unwrap();
        }
    }
    for (figure, picture) in figures.iter().copied().zip(&pictures) {
        let kept = image::open(kept_path(figure, &gpu))
            .unwrap_or_else(|error| panic!("{figure:?} is not kept: {error}"))
            .into_rgb8();
        let (mean, far) = difference(picture, &kept);
        println!("{figure:?}: mean {mean:.3} of {MEAN}, far {far:.4} of {FAR}");
        assert!(
            mean <= MEAN && far <= FAR,
            "{figure:?}: mean {mean:.3}, far {far:.4}"
        );
        // Control: no other figure passes for this one.
        for (other, picture) in figures.iter().copied().zip(&pictures) {
            let (mean, far) = difference(picture, &kept);
            assert!(
                other == figure || mean > MEAN || far > FAR,
                "{other:?} passes for {figure:?}: mean {mean:.3}, far {far:.4}"
            );
        }
    }
}
