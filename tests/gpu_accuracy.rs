//! Every mapping's shader against double precision, on every adapter of this machine, from storage buffers.
//!
//! Where f32 coordinates can tell directions apart, the angle is held. In a mapping's weak spots they cannot: there the
//! angle is held against the reach of a chart point, what the last digit of its coordinates is worth.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "a test's helpers say what they expect too"
)]

#[path = "gpu/compare.rs"]
mod compare;

use std::sync::OnceLock;

use compare::{Errors, compare, directions, forward_of, inverse_of, points, wrong_charts};
use sixfold::gpu::shader::{NO_CHART, for_mapping};
use sixfold::gpu::{Gpu, GpuEvaluator};
use sixfold::mapping::{ChartPoint, MappingId, ShaderForm};
use sixfold::math::Vec3;

/// The form that is changed.
const PRECISE: ShaderForm = ShaderForm::Precise;
/// Directions and chart points per mapping and adapter.
const DIRECTIONS: usize = 400_000;
const POINTS: usize = 200_000;
/// Directions whose charts are compared, a quarter of them exact ties.
const CHARTS: usize = 2_000_000;
/// What every mapping promises outside of its weak spots, in radians, unless the weak spot says otherwise.
const LAW_RAD: f64 = 1.5e-6;

/// Budgets in radians, radians and reaches: about one and a half times what software Vulkan shows, since a real GPU's
/// division may be off by 2.5 ULP. No weak spot: 0.
fn budget(id: MappingId) -> Errors {
    let (forward_rad, inverse_rad, weak_reaches) = match id {
        MappingId::Latlong => (8e-7, 3e-7, 0.0),
        MappingId::Sphere => (8e-5, 2e-5, 2.2),
        MappingId::Matcap => (1.4e-6, 5e-7, 2.2),
        MappingId::Paraboloid => (4e-7, 4e-7, 0.0),
        MappingId::Cube => (1.8e-7, 1.2e-7, 0.0),
        MappingId::Ccm => (3e-7, 3e-7, 0.0),
        MappingId::Eac => (3e-7, 2.5e-7, 0.0),
        MappingId::Octahedral => (7e-7, 3e-7, 0.0),
        MappingId::OctahedralEqualArea => (1e-6, 3e-7, 0.0),
        MappingId::Angular => (1e-6, 1.2e-6, 0.0),
        MappingId::Fisheye => (7e-7, 6e-7, 0.0),
        MappingId::Equisolid => (7e-7, 8e-7, 0.0),
        MappingId::Stereographic => (9e-7, 4e-7, 0.0),
        MappingId::Mercator => (8e-7, 3e-7, 0.0),
        MappingId::Healpix => (3.5e-7, 2.5e-7, 0.0),
        MappingId::CylindricalEqualArea => (1.5e-6, 3e-7, 1.2),
        // The wide cube family: a division and a root, or an arctangent.
        _ => (3.8e-7, 2.9e-7, 0.0),
    };
    Errors {
        forward_rad,
        inverse_rad,
        weak_reaches,
    }
}

/// The devices, opened once.
fn gpus() -> &'static [Gpu] {
    static GPUS: OnceLock<Vec<Gpu>> = OnceLock::new();
    GPUS.get_or_init(|| Gpu::on_every_adapter().unwrap())
}

/// The one on which shaders are changed.
fn first_gpu() -> &'static Gpu {
    &gpus()[0]
}

/// What is above its budget.
fn over_budget(id: MappingId, observed: Errors) -> Vec<String> {
    observed
        .beside(budget(id))
        .iter()
        .filter(|(_, observed, budget)| observed > budget)
        .map(|(what, observed, budget)| format!("{what} {observed:.3e} is over {budget:.1e}"))
        .collect()
}

#[test]
fn every_mapping_keeps_its_budget_on_every_adapter() {
    let dirs = directions(DIRECTIONS);
    let mut broken = Vec::new();
    for gpu in gpus() {
        let name = gpu.name();
        let info = &gpu.adapter_info;
        // Budgets are set by this one; another adapter may be better.
        let sets_budgets =
            info.backend == wgpu::Backend::Vulkan && info.device_type == wgpu::DeviceType::Cpu;
        println!("{name}: observed/budget");
        for &id in MappingId::ALL {
            let shader = GpuEvaluator::new(gpu, id).unwrap();
            let (faults, observed) = compare(id, &shader, &dirs, &points(id, POINTS));
            let table = observed.beside(budget(id));
            let cells = table.map(|(what, seen, budget)| format!("{what} {seen:.2e}/{budget:.1e}"));
            println!("  {:<24} {}", id.to_string(), cells.join("  "));
            let count = faults.len();
            broken.extend(
                faults
                    .into_iter()
                    .take(3)
                    .map(|f| format!("{name}, {id} ({count}): {f}")),
            );
            broken.extend(
                over_budget(id, observed)
                    .iter()
                    .map(|f| format!("{name}, {id}: {f}")),
            );
            if sets_budgets {
                for (what, seen, budget) in table {
                    if budget > 3.0 * seen {
                        broken.push(format!(
                            "{id}: the budget {budget:.1e} of {what} is far above {seen:.2e}"
                        ));
                    }
                }
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn no_budget_is_above_the_law() {
    for &id in MappingId::ALL {
        let weak = id.info().weak_spots.iter().map(|spot| spot.outside_rad);
        let law = weak.fold(LAW_RAD, f64::max);
        let budget = budget(id);
        assert!(budget.forward_rad.max(budget.inverse_rad) <= law, "{id}");
    }
}

#[test]
fn every_direction_gets_the_charts_of_the_cpu() {
    let dirs = directions(CHARTS);
    for gpu in gpus() {
        for &id in MappingId::ALL {
            let shader = GpuEvaluator::new(gpu, id).unwrap();
            let [missing, other] = wrong_charts(id, &shader, &dirs);
            assert_eq!(
                [missing, other],
                [0, 0],
                "{}, {id}: none, another",
                gpu.name()
            );
        }
    }
    println!(
        "{} directions, {} adapters: no hole",
        dirs.len(),
        gpus().len()
    );
    for (id, from, to) in [
        (MappingId::Cube, "size.z >= size.x", "size.z > size.x"),
        (MappingId::Ccm, "dir.y > -dir.z", "dir.y >= -dir.z"),
        (
            MappingId::Ccm,
            "select(1u, 0u, a && !b && e && !f)",
            "select(NO_CHART, 0u, e)",
        ),
        (
            MappingId::Paraboloid,
            "bitcast<u32>(x) > 0x80000000u",
            "x <= 0.0",
        ),
    ] {
        let shader = changed(id, from, to);
        let [missing, other] = wrong_charts(id, &shader, &dirs);
        assert!(missing + other > 0, "{id}: {to} was not noticed");
    }
}

#[test]
fn vectors_that_are_no_direction_and_points_off_the_chart_get_none() {
    const SMALL: f32 = 1e-40;
    let none = [0.0, -0.0, SMALL, f32::NAN, f32::INFINITY, f32::NEG_INFINITY]
        .map(|c| Vec3::new(c, 0.0, -c));
    let one_of_three = [f32::NAN, f32::INFINITY].map(|c| Vec3::new(0.5, c, 1.0));
    let some = [f32::MIN_POSITIVE, 1e-30, 1e30, f32::MAX]
        .into_iter()
        .flat_map(|c| {
            [
                Vec3::new(c, -c, c),
                Vec3::new(0.0, c, 0.0),
                Vec3::new(-c, 0.0, SMALL),
            ]
        });
    let dirs: Vec<Vec3<f32>> = none.into_iter().chain(one_of_three).chain(some).collect();
    let nowhere = none.len() + one_of_three.len();
    for gpu in gpus() {
        for &id in MappingId::ALL {
            let shader = GpuEvaluator::new(gpu, id).unwrap();
            let found = forward_of(&shader, &dirs).unwrap();
            assert!(
                found[..nowhere].iter().all(Option::is_none),
                "{id}: {found:?}"
            );
            for (dir, found) in dirs.iter().zip(&found).skip(nowhere) {
                let (there, on_cpu) = (found.unwrap(), id.forward(*dir).unwrap());
                let near = (there.u - on_cpu.u).abs() < 1e-6 && (there.v - on_cpu.v).abs() < 1e-6;
                assert!(
                    there.chart == on_cpu.chart && near,
                    "{id}, {dir:?}: {there:?}"
                );
            }

            let charts = id.info().chart_count();
            let off = [
                ChartPoint::new(charts, 0.5, 0.5),
                ChartPoint::new(NO_CHART, 0.5, 0.5),
                ChartPoint::new(0, -1e-7, 0.5),
                ChartPoint::new(0, 0.5, 1.000_000_1),
                ChartPoint::new(0, f32::NAN, 0.5),
                ChartPoint::new(0, 0.5, f32::INFINITY),
                ChartPoint::new(0, 0.0, 0.0),
                ChartPoint::new(0, 0.5, 0.5),
            ];
            let found = inverse_of(&shader, &off).unwrap();
            for (point, found) in off.iter().zip(&found) {
                let on_cpu = id.inverse(*point);
                assert_eq!(found.is_some(), on_cpu.is_some(), "{id}: {point:?}");
            }
            assert!(
                found[7].is_some() && found[..6].iter().all(Option::is_none),
                "{id}"
            );
        }
    }
}

#[test]
fn batches_of_any_length_come_back_whole() {
    let dirs = directions(600_000);
    let shader = GpuEvaluator::new(first_gpu(), MappingId::Cube).unwrap();
    for count in [0, 1, 63, 64, 65, 262_144, 262_145, 600_000] {
        let found = forward_of(&shader, &dirs[..count]).unwrap();
        assert!(
            found.len() == count && found.iter().all(Option::is_some),
            "{count}"
        );
        let last = found.last().map(|p| p.map(|p| p.chart));
        let on_cpu = dirs[..count]
            .last()
            .map(|d| Some(MappingId::Cube.forward(*d).unwrap().chart));
        assert_eq!(last, on_cpu);
    }
}

#[test]
fn a_shader_that_leaves_an_element_out_is_reported() {
    let shader = changed(MappingId::Cube, "id.x >= arrayLength(&given)", "id.x == 5u");
    let found = forward_of(&shader, &directions(64));
    assert!(found.unwrap_err().to_string().contains("element 5"));
    let broken =
        GpuEvaluator::from_source(first_gpu(), MappingId::Cube, PRECISE, "fn f() { g(); }");
    assert!(broken.is_err());
}

/// The mapping's shader on the first adapter with every `from` of its text replaced.
fn changed(id: MappingId, from: &str, to: &str) -> GpuEvaluator {
    let source = GpuEvaluator::source(id, PRECISE);
    assert!(source.contains(from), "{id} does not contain {from}");
    let source = source.replace(from, to);
    GpuEvaluator::from_source(first_gpu(), id, PRECISE, &source).unwrap()
}

#[test]
fn a_changed_shader_is_noticed() {
    let dirs = directions(40_000);
    let noticed = |id: MappingId, from: &str, to: &str| {
        let (faults, observed) = compare(id, &changed(id, from, to), &dirs, &points(id, 20_000));
        assert!(
            !faults.is_empty() || !over_budget(id, observed).is_empty(),
            "{id}: {to} was not noticed: {observed:?}"
        );
    };
    for &id in MappingId::ALL {
        let prefix = id.prefix();
        let forward = format!("return {prefix}_forward(dir);");
        let inverse = format!("return {prefix}_inverse(p);");
        let swap = "ChartPoint(p.chart, p.v, p.u)";
        noticed(
            id,
            &forward,
            &format!("let p = {prefix}_forward(dir); return {swap};"),
        );
        noticed(id, &inverse, &format!("return {prefix}_inverse({swap});"));
        for sign in ["-1.0, 1.0, 1.0", "1.0, -1.0, 1.0", "1.0, 1.0, -1.0"] {
            // A matcap does not see the sign of z: that half shares its texels.
            if id != MappingId::Matcap || !sign.ends_with("-1.0") {
                noticed(
                    id,
                    &forward,
                    &format!("return {prefix}_forward(dir * vec3f({sign}));"),
                );
            }
            noticed(
                id,
                &inverse,
                &format!("return vec3f({sign}) * {prefix}_inverse(p);"),
            );
        }
    }
    use MappingId::{Angular, Ccm, Cube, CylindricalEqualArea as Lambert, Eac, Latlong, Matcap};
    use MappingId::{Equisolid, Fisheye, Mercator, Stereographic};
    use MappingId::{Octahedral, OctahedralEqualArea as Clarberg, Paraboloid, Sphere};
    for (ids, from, to) in [
        (
            &[Latlong, Angular, Lambert][..],
            " PI: f32 = 3.1415927f",
            " PI: f32 = 3.14f",
        ),
        (
            &[Latlong, Angular, Lambert],
            " PI: f32 = 3.1415927f",
            " PI: f32 = 3.14159f",
        ),
        (
            &[Latlong, Clarberg],
            "FRAC_PI_2: f32 = 1.5707964f",
            "FRAC_PI_2: f32 = 1.57f",
        ),
        (
            &[Latlong, Eac, Clarberg, Angular, Lambert],
            "FRAC_1_PI: f32 = 0.31830987f",
            "FRAC_1_PI: f32 = 0.31831f",
        ),
        (
            &[Ccm],
            "CCM_HALF_EDGE_RAD: f32 = 0.6154797f",
            "CCM_HALF_EDGE_RAD: f32 = 0.61548f",
        ),
        (&[Ccm], "g.face < 2u", "g.face < 1u"),
        (&[Ccm], "p.chart < 2u", "p.chart < 3u"),
        (&[Ccm, Eac, Latlong, Clarberg], "0.19993767f", "0.1999f"),
        (
            &[Ccm, Eac, Latlong, Clarberg, Angular],
            "0.07967021f",
            "0.0798f",
        ),
        (
            &[Ccm, Eac, Latlong, Clarberg, Angular],
            "fn sin_cos_turns(turns: f32) -> vec2f {",
            "fn sin_cos_turns(turns: f32) -> vec2f { if true { return vec2f(sin(turns * 6.28), cos(turns * 6.28)); }",
        ),
        (
            &[Latlong, Lambert],
            "select(angle, -angle, y < 0.0)",
            "angle",
        ),
        (
            &[Cube, Eac, Ccm],
            "case 3u: { return vec3f(dir.x, -dir.z, -dir.y); }",
            "case 3u: { return vec3f(dir.x, dir.z, -dir.y); }",
        ),
        (
            &[Cube, Eac, Ccm],
            "case 1u: { return vec3f(-ma, -tc, sc); }",
            "case 1u: { return vec3f(-ma, tc, sc); }",
        ),
        (&[Octahedral], "abs(plane.yx)", "abs(plane.xy)"),
        (
            &[Equisolid],
            "sqrt(n * (n + abs(d.z)))",
            "sqrt(n * (n + d.z))",
        ),
        (&[Fisheye], "select(across.x, -across.x, back)", "across.x"),
        (
            &[Stereographic],
            "(n - d.z) / (3.0 * across)",
            "across / (n - d.z)",
        ),
        (
            &[Mercator],
            "LN_2_LOW: f32 = -0.00021219444f",
            "LN_2_LOW: f32 = -0.00021f",
        ),
        (&[Mercator], "1.0 / 120.0", "1.0 / 130.0"),
        (&[Mercator], "1.0 / 5.0", "1.0 / 6.0"),
        (
            &[Clarberg],
            "max(2.0 - radius * radius, 0.0)",
            "max(2.0 - radius, 0.0)",
        ),
        (&[Paraboloid], "select(d.x, -d.x, back)", "d.x"),
        (&[Matcap], "let z = -sqrt", "let z = sqrt"),
        (&[Sphere], "(n - d.z) * (n - d.z)", "(n + d.z) * (n + d.z)"),
        (&[Sphere], "square * (slope * slope)", "square * slope"),
        (
            &[Sphere, Matcap],
            "(max(a, b) - 1.0) + min(a, b)",
            "max(a, b) - 1.0",
        ),
        (
            &[Angular],
            "if large < SMALLEST_NORMAL {\n        return vec2f(1.0, 0.0)",
            "if large < 1e-3 {\n        return vec2f(1.0, 0.0)",
        ),
    ] {
        for &id in ids {
            noticed(id, from, to);
        }
    }
}

#[test]
fn the_layout_tables_are_rusts() {
    const BODY: &str = "
        @group(0) @binding(0) var<storage, read> given: array<vec4u>;
        @group(0) @binding(1) var<storage, read_write> found: array<vec4u>;
        @compute @workgroup_size(64)
        fn forward_all(@builtin(global_invocation_id) id: vec3u) {
            if id.x >= arrayLength(&given) { return; }
            let cell = vec2u(id.x % 8u, id.x / 8u);
            found[id.x] = vec4u(map_chart(cell), map_cell(id.x), id.x);
        }
        @compute @workgroup_size(64)
        fn inverse_all(@builtin(global_invocation_id) id: vec3u) {
            if id.x >= arrayLength(&given) { return; }
            found[id.x] = vec4u(MAP_GRID, 0u, id.x);
        }";
    for &id in MappingId::ALL {
        let layout = id.info().layout;
        let source = for_mapping(id, BODY);
        let shader = GpuEvaluator::from_source(first_gpu(), id, PRECISE, &source).unwrap();
        let found = forward_of(&shader, &[Vec3::new(1.0, 0.0, 0.0); 64]).unwrap();
        for (i, found) in (0_u32..).zip(&found) {
            let cell = [i % 8, i / 8];
            let chart = layout.cells().iter().position(|c| c.at == cell);
            assert_eq!(
                found.map(|p| p.chart as usize),
                chart,
                "{id}, cell {cell:?}"
            );
            if let (Some(found), Some(cell)) = (found, layout.cells().get(i as usize)) {
                assert_eq!(
                    [found.u.to_bits(), found.v.to_bits()],
                    cell.at,
                    "{id}, chart {i}"
                );
            }
        }
        let grid = inverse_of(&shader, &[ChartPoint::new(0, 0.5, 0.5)]).unwrap();
        assert_eq!(
            grid[0].map(|d| [d.x.to_bits(), d.y.to_bits()]),
            Some(layout.grid()),
            "{id}"
        );
    }
}
