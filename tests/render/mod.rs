//! Environments, frames and comparisons for the renderer's tests.

#![allow(dead_code)] // each test file uses some

use sixfold::gpu::{
    Body, EnvironmentSource, Frame, Gpu, ObjectFrame, Overlays, PanelFrame, Renderer, RgbaPixels,
    Shared, ToneCurve, ViewportFrame,
};
use sixfold::mapping::{ChartPoint, MappingId, ShaderForm};
use sixfold::math::{Rotation, Vec3};
use sixfold::scene::{Camera, Object, Target};

pub const BUDGET: u32 = 96 * 1024;

pub type Light = [f32; 3];

/// A latlong picture of a function of the direction.
pub fn picture([width, height]: [u32; 2], light: impl Fn([f64; 3]) -> Light) -> Vec<Light> {
    let mut pixels = Vec::new();
    for j in 0..height {
        for i in 0..width {
            let [u, v] = [
                (f64::from(i) + 0.5) / f64::from(width),
                (f64::from(j) + 0.5) / f64::from(height),
            ];
            let dir = MappingId::Latlong
                .inverse(ChartPoint::new(0, u, v))
                .unwrap();
            pixels.push(light(dir.to_f64()));
        }
    }
    pixels
}

pub fn direction_light(dir: [f64; 3]) -> Light {
    dir.map(|x| (0.5 * x + 0.5) as f32)
}

pub fn renderer(size: [u32; 2], light: impl Fn([f64; 3]) -> Light) -> Renderer {
    let mut renderer = Renderer::new(Gpu::headless().unwrap());
    set(&mut renderer, size, light);
    renderer
}

pub fn set(renderer: &mut Renderer, size: [u32; 2], light: impl Fn([f64; 3]) -> Light) {
    let pixels = picture(size, light);
    let [width, height] = size;
    renderer
        .set_environment(EnvironmentSource {
            width,
            height,
            pixels: &pixels,
        })
        .unwrap();
}

/// The unit ball's mesh.
pub fn sphere() -> Body {
    body(Object::Sphere)
}

pub fn body(object: Object) -> Body {
    Body {
        target: Shared::new(Target::new(object.mesh())),
        is_ball: object == Object::Sphere,
    }
}

pub fn viewport(left: MappingId) -> ViewportFrame {
    ViewportFrame {
        size_px: [96, 80],
        camera: Camera::default(),
        body: sphere(),
        object: ObjectFrame::default(),
        right_object: None,
        left,
        right: None,
        divider: 0.5,
        overlays: Overlays::default(),
        probe: [0.0, 0.0, 1.0],
        show_probe: false,
        form: ShaderForm::Precise,
        form_difference: None,
    }
}

pub fn panel(mapping: MappingId) -> PanelFrame {
    PanelFrame {
        mapping,
        size_px: [120, 90],
        window: [0.0, 0.0, 1.0, 1.0],
        overlays: Overlays::default(),
        background: [10, 20, 30],
    }
}

pub fn frame(viewport: Option<ViewportFrame>, panels: &[PanelFrame]) -> Frame {
    Frame {
        texel_budget: BUDGET,
        rotation: Rotation::NONE,
        exposure_ev: 0.0,
        tone: ToneCurve::Linear,
        viewport,
        panels: panels.to_vec(),
        complete: true,
        compile_aside: false,
    }
}

pub fn shot(renderer: &mut Renderer, frame: &Frame) -> RgbaPixels {
    renderer.draw(frame).unwrap();
    renderer
        .read_texture(renderer.viewport_texture().unwrap())
        .unwrap()
}

pub fn bytes(light: Light) -> [f64; 3] {
    ToneCurve::Linear
        .display(light, 0.0)
        .map(|x| f64::from(x) * 255.0)
}

pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

pub fn rgb(pixel: [u8; 4]) -> [f64; 3] {
    [pixel[0], pixel[1], pixel[2]].map(f64::from)
}

/// Longest side in radians of a texel around a chart point; infinite off the chart.
pub fn texel_rad(id: MappingId, point: ChartPoint<f64>, size: [u32; 2]) -> f64 {
    id.jacobian(point).map_or(f64::INFINITY, |(_, j)| {
        let [w, h] = size.map(f64::from);
        (j.du.length() / w).max(j.dv.length() / h)
    })
}

/// The direction whose light the texel of `dir` holds: itself, but for mappings with a cut.
pub fn stored(id: MappingId, dir: Vec3<f64>) -> Vec3<f64> {
    if id.info().coverage.has_cut() {
        id.inverse(id.forward(dir).unwrap()).unwrap()
    } else {
        dir
    }
}

pub fn ray(camera: &Camera, [x, y]: [u32; 2], [width, height]: [u32; 2]) -> Vec3<f64> {
    let [u, v] = [
        (x as f32 + 0.5) / width as f32,
        (y as f32 + 0.5) / height as f32,
    ];
    let dir = camera.ray((u, v), width as f32 / height as f32).dir;
    Vec3::from_f64(dir.to_array().map(f64::from))
}
