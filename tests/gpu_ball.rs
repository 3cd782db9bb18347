//! The path through a ball of `shaders/ball.wgsl` against double precision, on every adapter of this machine.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "a test's helpers say what they expect too"
)]

use sixfold::gpu::optics::{GpuMeeting, OPTICS, wgsl_constants};
use sixfold::gpu::{Gpu, GpuOptics, shader};
use sixfold::math::{Vec3, angle_rad};
use sixfold::optics::Formula;
use sixfold::optics::ball::{
    ball_bounce, ball_enter, ball_exit_dir, ball_exit_weight, ball_inside_dir, ball_left_weight,
};
use sixfold::optics::reflectance::Shape;

/// Inner reflections before the ray leaves.
const BOUNCES: usize = 2;

/// A pass with the words of the optics' one: what leaves stands for the mirrored ray and k, what stays for the refracted
/// ray and the reflectance.
const PASS: &str = "
@group(0) @binding(0) var<storage, read> given: array<array<vec4u, 4>>;
@group(0) @binding(1) var<storage, read_write> found: array<array<vec4u, 3>>;

@compute @workgroup_size(64)
fn meet_all(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&given) {
        return;
    }
    let incident = bitcast<vec4f>(given[id.x][0]);
    let normal = bitcast<vec4f>(given[id.x][1]).xyz;
    var ray = ball_enter(incident.xyz, normal, incident.w);
    for (var i = 0; i < BOUNCES; i++) {
        ray = ball_bounce(ray);
    }
    found[id.x][0] = bitcast<vec4u>(vec4f(ball_exit_dir(ray), ball_exit_weight(ray)));
    found[id.x][1] = bitcast<vec4u>(vec4f(ball_inside_dir(ray), ball_left_weight(ray)));
    found[id.x][2] = vec4u(0u, 0u, 0u, id.x);
}
";

fn source() -> String {
    let count = format!("const BOUNCES = {BOUNCES};\n");
    shader::plain(&[&wgsl_constants(), OPTICS, shader::BALL, &count, PASS].concat())
}

/// Rays from head-on to grazing onto balls of every index from diamond's to nearly none, the plane of incidence turning.
fn meetings() -> Vec<GpuMeeting> {
    let mut all = Vec::new();
    for eta in [0.3, 1.0 / 2.42, 1.0 / 1.5, 0.75, 0.97_f32] {
        for k in 0..=2000 {
            let (sin, cos) = (f64::from(k) / 2000.0 * std::f64::consts::FRAC_PI_2).sin_cos();
            let (turn_sin, turn_cos) = (0.7 * f64::from(k)).sin_cos();
            let normal = Vec3::<f64>::new(0.48, 0.64, -0.6);
            let across =
                Vec3::new(0.8, -0.6, 0.0) * turn_sin + Vec3::new(0.36, 0.48, 0.8) * turn_cos;
            let incident = (across * sin - normal * cos).normalized();
            all.push(GpuMeeting {
                incident: Vec3::from_f64(incident.to_f64()),
                normal: Vec3::from_f64(normal.to_f64()),
                eta,
                formula: Formula::Fresnel,
                shape: Shape::default(),
                metal: [1.0, 0.0],
            });
        }
    }
    all
}

/// Largest error of any direction in radians and of any weight.
fn worst(gpu: &Gpu, source: &str) -> (f64, f64) {
    let meetings = meetings();
    let found = GpuOptics::from_source(gpu, source)
        .unwrap()
        .meet(&meetings)
        .unwrap();
    let (mut turned, mut weight) = (0.0_f64, 0.0_f64);
    for (meeting, found) in meetings.iter().zip(found) {
        let [incident, normal] =
            [meeting.incident, meeting.normal].map(|v| Vec3::<f64>::from_f64(v.to_f64()));
        let mut ray = ball_enter(incident, normal, f64::from(meeting.eta));
        for _ in 0..BOUNCES {
            ray = ball_bounce(ray);
        }
        for (dir, part, exact_dir, exact_part) in [
            (
                found.reflected,
                found.k,
                ball_exit_dir(ray),
                ball_exit_weight(ray),
            ),
            (
                found.refracted,
                found.reflectance,
                ball_inside_dir(ray),
                ball_left_weight(ray),
            ),
        ] {
            turned = turned.max(angle_rad(dir.to_f64(), exact_dir.to_f64()));
            weight = weight.max((f64::from(part) - exact_part).abs());
        }
    }
    (turned, weight)
}

#[test]
fn the_shader_follows_the_path_on_every_adapter() {
    for gpu in Gpu::on_every_adapter().unwrap() {
        let (turned, weight) = worst(&gpu, &source());
        println!("{}: {turned:e} rad, weight {weight:e}", gpu.name());
        // The house's figure for directions. Software Vulkan and GL show 8.9e-7 rad and 1.6e-7.
        assert!((1.5e-6 / 4.0..1.5e-6).contains(&turned), "{turned:e}");
        assert!((1.25e-7..5e-7).contains(&weight), "{weight:e}");
    }
}

#[test]
fn a_broken_path_is_noticed() {
    let gpu = Gpu::headless().unwrap();
    for (from, to) in [
        (
            "let turn_sin = 2.0 * s * c;",
            "let turn_sin = 2.00002 * s * c;",
        ),
        (
            "ray.inside * ray.reflectance;\n    return ball_advanced",
            "ray.inside;\n    return ball_advanced",
        ),
        (
            "vec2f(fresnel_s(m), fresnel_p(m))",
            "vec2f(fresnel_p(m), fresnel_p(m))",
        ),
        (
            "ray.tangent * ray.incident.y",
            "ray.tangent * ray.incident.x",
        ),
    ] {
        let changed = source().replace(from, to);
        assert_ne!(changed, source(), "{from}");
        let (turned, weight) = worst(&gpu, &changed);
        assert!(
            turned > 1.5e-6 || weight > 1e-6,
            "{to}: {turned:e} {weight:e}"
        );
    }
}
