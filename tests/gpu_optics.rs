//! The optics of `shaders/optics.wgsl` against double precision, on every adapter of this machine, from storage buffers.

#![cfg(feature = "explorer")]
#![allow(
    clippy::unwrap_used,
    reason = "a test's helpers say what they expect too"
)]

#[path = "optics/reference.rs"]
mod reference;

use std::sync::OnceLock;

use reference::{Case, Errors, Found, cases, compare};
use sixfold::gpu::optics::GpuMeeting;
use sixfold::gpu::{Gpu, GpuOptics};

/// Rays on each adapter.
const RAYS: usize = 1_000_000;
/// Rays with which a changed shader is noticed.
const FEW_RAYS: usize = 20_000;

/// About one and a half times what software Vulkan shows; it decides every ray
/// rightly, though |k| is below 1e-10 for thousands.
const BUDGET: Errors = Errors {
    reflected_rad: 3.5e-7,
    refracted_rad: 9e-7,
    reflectance: 4.2e-6,
    metal: 7e-7,
    decided_wrongly: 1e-13,
};

/// The devices, opened once.
fn gpus() -> &'static [Gpu] {
    static GPUS: OnceLock<Vec<Gpu>> = OnceLock::new();
    GPUS.get_or_init(|| Gpu::on_every_adapter().unwrap())
}

fn errors(optics: &GpuOptics, cases: &[Case]) -> Errors {
    let meetings: Vec<GpuMeeting> = cases
        .iter()
        .map(|case| GpuMeeting {
            incident: case.incident,
            normal: case.normal,
            eta: case.eta,
            formula: case.formula,
            shape: case.shape,
            metal: case.metal,
        })
        .collect();
    let found = optics.meet(&meetings).unwrap();
    assert_eq!(found.len(), cases.len());
    let found = found.iter().map(|outcome| Found {
        reflected: outcome.reflected.to_f64(),
        refracted: Some(outcome.refracted.to_f64()),
        k: f64::from(outcome.k),
        reflectance: f64::from(outcome.reflectance),
        metal_reflectance: f64::from(outcome.metal_reflectance),
    });
    compare(cases, found)
}

fn over_budget(observed: Errors) -> Vec<String> {
    observed
        .beside(BUDGET)
        .iter()
        .filter(|(_, observed, budget)| observed > budget)
        .map(|(what, observed, budget)| format!("{what}: {observed:.2e} is over {budget:.1e}"))
        .collect()
}

#[test]
fn every_ray_keeps_its_budget_on_every_adapter() {
    let cases = cases(RAYS);
    let mut broken = Vec::new();
    for gpu in gpus() {
        let observed = errors(&GpuOptics::new(gpu).unwrap(), &cases);
        let info = &gpu.adapter_info;
        // Budgets are set by this one; another adapter may be better.
        let sets_budgets =
            info.backend == wgpu::Backend::Vulkan && info.device_type == wgpu::DeviceType::Cpu;
        println!("{}: {} rays", gpu.name(), cases.len());
        for (what, seen, budget) in observed.beside(BUDGET) {
            println!("  {what}: {seen:.2e} of {budget:.1e}");
            if sets_budgets && budget > 3.0 * seen && seen > 0.0 {
                broken.push(format!("{what}: {budget:.1e} is far above {seen:.2e}"));
            }
        }
        broken.extend(over_budget(observed));
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn no_budget_is_above_the_law() {
    assert!(BUDGET.reflected_rad.max(BUDGET.refracted_rad) <= reference::LAW_RAD);
    assert!(BUDGET.reflectance.max(BUDGET.metal) <= reference::LAW_REFLECTANCE);
}

/// What is over its budget once `from` is replaced in the shader.
fn faults_of(cases: &[Case], from: &str, to: &str) -> Vec<String> {
    let source = GpuOptics::source();
    if !source.contains(from) {
        return vec!["is not in the shader".to_owned()];
    }
    let optics = GpuOptics::from_source(&gpus()[0], &source.replace(from, to)).unwrap();
    over_budget(errors(&optics, cases))
}

#[test]
fn a_changed_shader_is_noticed() {
    let cases = cases(FEW_RAYS);
    assert_eq!(
        faults_of(&cases, "struct Meeting", "struct Meeting"),
        [""; 0]
    );
    let mut unnoticed = Vec::new();
    for (what, from, to) in [
        // The mirrored ray: the sign, the paper's sign (P6), the factor.
        ("reflected", "incident - 2.0 * dot", "incident + 2.0 * dot"),
        (
            "reflected",
            "return incident - 2.0 * dot(incident, normal) * normal;",
            "return 2.0 * dot(incident, normal) * normal - incident;",
        ),
        ("reflected", "- 2.0 * dot", "- 1.99999 * dot"),
        // The refracted ray: eta upside down, the wrong side, the wrong branch at total reflection, back faces left alone.
        (
            "refracted",
            "unit(incident * m.eta",
            "unit(incident / m.eta",
        ),
        (
            "refracted",
            "m.eta * m.cos_incident - m.cos_refracted",
            "m.eta * m.cos_incident + m.cos_refracted",
        ),
        (
            "refracted",
            "select(1.0, -1.0, signed_cosine",
            "select(1.0, 1.0, signed_cosine",
        ),
        (
            "refracted",
            "return reflected_dir(incident, normal);",
            "return incident;",
        ),
        // The digits: without the exact path, without the lengths, without the last pieces, with a plain sign at grazing.
        ("refracted", "k > K_CERTAINLY_TOTAL && k < K_EASY", "false"),
        ("decided", "excess * (1.5 * excess - 1.0)", "0.0"),
        ("decided", "+ on_grids(2.0 * (g0 + g1) * g2)", ""),
        ("decided", "on_grids(2.0 * g0 * g1) + ", ""),
        ("refracted", "abs(cos) > NEARLY_GRAZING", "true"),
        // How much: s for p, eta upside down, the signs of R1, the mean, total reflection unknown.
        (
            "reflectance",
            "m.eta * m.cos_incident, m.cos_refracted, m",
            "m.cos_incident, m.eta * m.cos_refracted, m",
        ),
        (
            "reflectance",
            "(1.0 - eta) / (1.0 + eta)",
            "(1.0 - eta) / (1.0 + 1.0001 * eta)",
        ),
        (
            "reflectance",
            "schlick(m.eta, 1.0 - cos, shape.exponent)",
            "schlick(m.eta, 1.0 + cos, shape.exponent)",
        ),
        (
            "reflectance",
            "schlick(m.eta, 1.0 + cos, shape.power)",
            "schlick(m.eta, 1.0 - cos, shape.power)",
        ),
        (
            "reflectance",
            "schlick(m.eta, 1.0 - cos, shape.exponent)",
            "schlick(m.eta, 1.0 - cos, shape.power)",
        ),
        (
            "reflectance",
            "shape.bias + shape.scale",
            "shape.bias - shape.scale",
        ),
        (
            "reflectance",
            "return 0.5 * (fresnel_s(m)",
            "return 0.5001 * (fresnel_s(m)",
        ),
        (
            "reflectance",
            "        return 1.0;\n",
            "        return 0.999;\n",
        ),
        (
            "reflectance",
            "return clamp(1.0 - power_of(cos",
            "return clamp(power_of(cos",
        ),
        (
            "reflectance",
            "FORMULA_PRINTED_MIX: u32 = 7u",
            "FORMULA_PRINTED_MIX: u32 = 8u",
        ),
        // Metals: n and k swapped, the roots swapped, p the wrong way round.
        ("metal", "n * n - k * k - sin2", "k * k - n * n - sin2"),
        ("metal", "select(large, small, d < 0.0)", "large"),
        (
            "metal",
            "squares(a * cos - sin2, b * cos) /",
            "squares(a * cos - sin2, b) /",
        ),
    ] {
        let faults = faults_of(&cases, from, to);
        if !faults.iter().any(|fault| fault.contains(what)) {
            unnoticed.push(format!("{to} instead of {from}: {faults:?}"));
        }
    }
    assert!(unnoticed.is_empty(), "{}", unnoticed.join("\n"));
}
