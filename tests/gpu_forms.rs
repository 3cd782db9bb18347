//! Every form of every mapping's shader: held to the table of promises on every adapter of this machine, timed, and run by the
//! command line.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "a test's helpers say what they expect too"
)]

use std::collections::BTreeMap;
use std::io::{Seek, Write};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::time::Duration;

use sixfold::gpu::{Gpu, GpuEvaluator, ShaderDevice};
use sixfold::imaging::Progress;
use sixfold::lab::bench::{self, bench};
use sixfold::lab::clock::Clock;
use sixfold::lab::devices::Devices;
use sixfold::lab::inputs::Inputs;
use sixfold::lab::stress::{self, Family, MEASURES, ask_of, budgets, stress};
use sixfold::mapping::{DirList, Evaluator, MappingId, PointList, ShaderForm};

/// The devices, opened once.
fn gpus() -> &'static [Gpu] {
    static GPUS: OnceLock<Vec<Gpu>> = OnceLock::new();
    GPUS.get_or_init(|| Gpu::on_every_adapter().unwrap())
}

#[test]
fn every_form_keeps_its_promise_on_every_adapter() {
    let plan = stress::Plan {
        devices: Devices::Gpu,
        effort: 6_000,
        ..stress::Plan::quick()
    };
    for gpu in gpus() {
        let outcome = stress(&plan, &ShaderDevice::on(gpu.clone()), &Progress::new());
        assert!(outcome.faults.is_empty(), "{:?}", outcome.faults);
        let count: usize = MappingId::ALL.iter().map(|map| map.forms().count()).sum();
        assert_eq!(outcome.rows.len(), count * Family::ALL.len());
        // The worst of all mappings under one budget.
        let mut worst: BTreeMap<(&str, &str), (f64, f64)> = BTreeMap::new();
        let mut broken = Vec::new();
        for row in &outcome.rows {
            assert_eq!(row.device, gpu.name());
            if let Some(fault) = &row.fault {
                let (map, form, family) = (row.mapping, row.evaluator, row.family.id());
                broken.push(format!("{map} {form} {family}: {fault} {:?}", row.worst));
            }
            let numbers = row
                .observed
                .numbers()
                .into_iter()
                .zip(row.allowed.numbers());
            for ((seen, allowed), name) in numbers.zip(MEASURES) {
                if name.ends_with("_rad") && allowed != 1.5e-3 {
                    let entry = worst.entry((row.evaluator, name)).or_insert((0.0, allowed));
                    entry.0 = entry.0.max(seen);
                }
            }
        }
        let info = &gpu.adapter_info;
        // Budgets are set by this one; another adapter may be better.
        let sets_budgets =
            info.backend == wgpu::Backend::Vulkan && info.device_type == wgpu::DeviceType::Cpu;
        println!("{}: observed/budget", gpu.name());
        for ((form, name), (seen, allowed)) in worst {
            println!("  {form:<16} {name:<20} {seen:.2e}/{allowed:.1e}");
            let is_measured = sets_budgets && form != budgets::BUILT_IN;
            if is_measured && seen * 4.0 < allowed {
                broken.push(format!("{form} {name}: {allowed:e} is far above {seen:e}"));
            }
        }
        assert!(broken.is_empty(), "{}", broken.join("\n"));
    }
}

/// What is broken in a form of the continuous cube map with every `from` of its text replaced.
fn fault_of_changed(form: ShaderForm, from: &str, to: &str) -> Option<String> {
    let map = MappingId::Ccm;
    let source = GpuEvaluator::source(map, form);
    assert!(source.contains(from), "{form} does not contain {from}");
    let gpu = &gpus()[0];
    let shader = GpuEvaluator::from_source(gpu, map, form, &source.replace(from, to)).unwrap();
    let info = map.evaluator(form.id()).unwrap();
    let families = [Family::Uniform, Family::Walks, Family::NoDirections];
    let row = |family| ask_of(map, info, &shader, "changed", family, 6_000).unwrap();
    families.into_iter().find_map(|family| row(family).fault)
}

#[test]
fn a_changed_form_is_noticed() {
    use ShaderForm::{BuiltIn, CubeUnit, Own7, Own11, Precise, Table};
    for (form, from, to) in [
        // The slope at 0 by a thousandth, and a sine.
        (Own7, "(0.99921376f)", "(1.0002f)"),
        (Own7, "* s + (0.5701548f))", "* s + (0.573f))"),
        (Own11, "(0.99997723f)", "(1.00001f)"),
        (Precise, "(-0.33333153f)", "(-0.3333f)"),
        // Back by 0.01 radians, and there.
        (BuiltIn, "return atan(t);", "return atan(t) + 0.01 * t;"),
        (BuiltIn, "return tan(turns", "return tan(1.01 * turns"),
        (
            Table,
            "TABLE_STEPS: f32 = 256.0",
            "TABLE_STEPS: f32 = 255.9",
        ),
        (Table, "(b - a) * (place - before)", "(b - a) * 0.5"),
        (
            Table,
            "sign_or_one(t) * look_up_angle(0u, t)",
            "look_up_angle(0u, t)",
        ),
        // Bent onto the border, so that the sampler takes another face.
        (CubeUnit, "= 1.0 - 0x1p-22f", "= 1.0 + 0x1p-22f"),
        (
            CubeUnit,
            "ccm_bent_edge(g.b, g.a)",
            "ccm_bent_edge(g.a, g.b)",
        ),
        (
            CubeUnit,
            "if !is_direction(dir) {\n        return vec3f(0.0);",
            "if false {\n        return vec3f(0.0);",
        ),
    ] {
        let fault = fault_of_changed(form, from, to);
        assert!(fault.is_some(), "{form}: {to} was not noticed");
    }
    for form in MappingId::Ccm.forms() {
        assert_eq!(fault_of_changed(form, "fn ", "fn "), None, "{form}");
    }
}

#[test]
fn the_length_of_a_direction_makes_no_difference() {
    // Powers of two change no digit, so that all must agree to the last bit, beyond the 2^60 above which squares would not fit.
    let given = [
        [0.3, -1.0, 0.2],
        [-0.9, 0.5, -0.7],
        [0.25, 0.4, -0.99],
        [0.6, 0.6, 0.6],
    ];
    let exponents = (-60..=127)
        .step_by(11)
        .chain([60, 61, 62, 63, 64, 126, 127]);
    let exponents: Vec<i32> = exponents.collect();
    let scaled = |dir: [f32; 3]| {
        let powers = exponents.iter().map(|k| 2_f64.powi(*k));
        powers.map(move |power| dir.map(|c| (f64::from(c) * power) as f32))
    };
    let dirs: DirList = given.into_iter().flat_map(scaled).collect();
    for gpu in gpus() {
        for &map in MappingId::ALL {
            let shader = GpuEvaluator::new(gpu, map).unwrap();
            let mut points = PointList::zeros(dirs.len());
            shader.forward(dirs.view(), points.view_mut()).unwrap();
            for (k, start) in (0..dirs.len()).step_by(exponents.len()).enumerate() {
                let first = points.view().get(start);
                assert!(first.is_some(), "{map} {:?}", given[k]);
                for (i, e) in exponents.iter().enumerate() {
                    let point = points.view().get(start + i);
                    assert_eq!(first, point, "{}, {map} {:?} 2^{e}", gpu.name(), given[k]);
                }
            }
        }
    }
}

#[test]
fn forms_are_timed_beside_a_copy() {
    let plan = bench::Plan {
        maps: vec![MappingId::Ccm, MappingId::Cube],
        devices: Devices::Gpu,
        inputs: vec![Inputs::Random],
        on_adapter: 1 << 12,
        judged: 2000,
        clock: Clock {
            samples: 3,
            shortest: Duration::from_micros(1),
        },
        ..bench::Plan::full()
    };
    for gpu in gpus() {
        let outcome = bench(&plan, &ShaderDevice::on(gpu.clone()), &Progress::new());
        assert!(outcome.faults.is_empty(), "{:?}", outcome.faults);
        assert_eq!(outcome.adapter.unwrap().unwrap().name, gpu.name());
        for &map in &plan.maps {
            for form in map.forms() {
                let of =
                    |row: &&bench::Row| row.mapping == map.info().id && row.evaluator == form.id();
                let rows: Vec<_> = outcome.rows.iter().filter(of).collect();
                assert_eq!(
                    rows.len(),
                    1 + usize::from(form.has_inverse()),
                    "{map} {form}"
                );
                for row in rows {
                    let numbers = [row.ns, row.copy_ratio, row.max_error_rad, row.max_error_ulp];
                    let is_sound = |c: &f64| c.is_finite() && *c > 0.0;
                    assert!(numbers.iter().all(is_sound), "{row:?}");
                    assert!(row.isa == bench::SHADER && row.device == gpu.name());
                    assert!(row.n == 1 << 12 && row.holes == 0 && row.is_comparable());
                }
            }
        }
        // The front of a device is its own.
        assert!(outcome.rows.iter().any(|row| row.on_front));
    }
}

/// The program with some lines as its input. `adapters` false: with an interface that this system does not have.
fn sixfold(arguments: &[&str], input: &str, adapters: bool) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sixfold"));
    if !adapters {
        let elsewhere = if cfg!(target_os = "macos") {
            "dx12"
        } else {
            "metal"
        };
        command.env("WGPU_BACKEND", elsewhere);
    }
    let mut lines = tempfile::tempfile().unwrap();
    lines.write_all(input.as_bytes()).unwrap();
    lines.rewind().unwrap();
    command.args(arguments).stdin(lines).output().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

#[test]
fn eval_runs_any_form() {
    let input = "0.3,-1,0.2\n0,0,0\n1,0.5,-0.25\n";
    let usual = sixfold(&["eval", "ccm"], input, true);
    for form in MappingId::Ccm.forms() {
        let run = sixfold(&["eval", "ccm", "--evaluator", form.id()], input, true);
        // The zero vector is reported, and the run goes on.
        assert_eq!(run.status.code(), Some(1), "{}", text(&run.stderr));
        assert!(text(&run.stderr).contains("line 2: the zero vector"));
        let lines = text(&run.stdout).lines().zip(text(&usual.stdout).lines());
        assert_eq!(lines.clone().count(), 4);
        for (line, usual) in lines.skip(1).filter(|(line, _)| !line.ends_with(",,,")) {
            let numbers = |line: &str| -> Vec<f64> {
                line.split(',').map(|cell| cell.parse().unwrap()).collect()
            };
            for (found, meant) in numbers(line).iter().zip(numbers(usual)) {
                assert!((found - meant).abs() < 2e-3, "{form}: {line}, {usual}");
            }
        }
    }
    let back = sixfold(
        &["eval", "ccm", "--inverse", "--evaluator", "wgsl-own-7"],
        "3,0.25,0.5\n",
        true,
    );
    assert!(back.status.success(), "{}", text(&back.stderr));
    // More lines than are computed at once come back in order.
    let many: String = (1..=9000).map(|k| format!("{k},9000,1\n")).collect();
    let run = sixfold(&["eval", "cube", "--evaluator", "wgsl"], &many, true);
    assert_eq!(text(&run.stdout).lines().count(), 9001);
    for (k, line) in (1..).zip(text(&run.stdout).lines().skip(1)) {
        assert!(line.starts_with(&format!("{k},9000,1,2,")), "{line}");
    }
}

#[test]
fn without_an_adapter_the_processor_goes_on() {
    let lines = |run: &Output| text(&run.stderr).lines().count();
    let run = sixfold(&["eval", "ccm", "--evaluator", "wgsl"], "1,2,3\n", false);
    assert_eq!((run.status.code(), lines(&run)), (Some(1), 1));
    assert!(text(&run.stderr).contains("no graphics adapter"));
    for command in ["bench", "stress"] {
        let run = sixfold(&[command, "--quick", "cube"], "", false);
        assert_eq!((run.status.code(), lines(&run)), (Some(0), 1), "{command}");
        assert!(text(&run.stdout).contains("lanes") && !text(&run.stdout).contains("wgsl"));
        let named = sixfold(&[command, "--quick", "cube", "--device", "gpu"], "", false);
        assert_eq!(
            (named.status.code(), lines(&named)),
            (Some(1), 1),
            "{command}"
        );
        let cpu = sixfold(&[command, "--quick", "cube", "--device", "cpu"], "", false);
        assert_eq!((cpu.status.code(), lines(&cpu)), (Some(0), 0), "{command}");
    }
}
