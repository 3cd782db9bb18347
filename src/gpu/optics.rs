//! What the shaders know of optics, written from Rust, and their optics on arrays, so that it can be held against Rust's.

use std::fmt::Write;

use super::dispatch::{BATCH, Dispatch};
use super::{Gpu, GpuError, shader};
use crate::math::Vec3;
use crate::optics::Formula;
use crate::optics::reflectance::Shape;

/// The optics at one interface: twin of `optics`.
pub const OPTICS: &str = include_str!("../../shaders/optics.wgsl");

/// The formulas' numbers as constants of `shaders/optics.wgsl`.
#[must_use]
pub fn wgsl_constants() -> String {
    let mut text = String::new();
    for formula in Formula::ALL {
        let (name, place) = (formula_name(formula), formula_place(formula));
        // Writing to a string does not fail.
        let _ = writeln!(text, "const {name}: u32 = {place}u;");
    }
    text
}

/// The number that stands for a formula in the shaders: its place in [`Formula::ALL`].
#[must_use]
pub fn formula_place(formula: Formula) -> u32 {
    let place = Formula::ALL.iter().position(|each| *each == formula);
    // Every formula is in the list; the first is the exact one.
    place.map_or(0, |place| place as u32)
}

/// A formula's constant in the shaders.
#[must_use]
pub const fn formula_name(formula: Formula) -> &'static str {
    match formula {
        Formula::Fresnel => "FORMULA_FRESNEL",
        Formula::FresnelS => "FORMULA_FRESNEL_S",
        Formula::FresnelP => "FORMULA_FRESNEL_P",
        Formula::Schlick => "FORMULA_SCHLICK",
        Formula::Cg => "FORMULA_CG",
        Formula::Simple => "FORMULA_SIMPLE",
        Formula::PrintedSign => "FORMULA_PRINTED_SIGN",
        Formula::PrintedMix => "FORMULA_PRINTED_MIX",
    }
}

/// The pass that computes arrays.
const EVALUATE: &str = include_str!("../../shaders/evaluate_optics.wgsl");
/// Words of what is given: see the pass.
const GIVEN_WORDS: usize = 16;
/// Words of what is found.
const FOUND_WORDS: usize = 12;

/// A ray at an interface, and what is asked of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GpuMeeting {
    /// Towards the surface; unit.
    pub incident: Vec3<f32>,
    /// Unit; on either side.
    pub normal: Vec3<f32>,
    /// n1/n2.
    pub eta: f32,
    /// How the reflectance of the dielectric is computed.
    pub formula: Formula,
    /// The numbers of the formula.
    pub shape: Shape<f32>,
    /// n and k of a metal that the same ray meets.
    pub metal: [f32; 2],
}

/// What the shader makes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GpuOutcome {
    /// The mirrored ray.
    pub reflected: Vec3<f32>,
    /// The refracted ray; the mirrored one where k < 0.
    pub refracted: Vec3<f32>,
    /// Ramires' k (Eq. 8).
    pub k: f32,
    /// Cosine of the angle of incidence.
    pub cos_incident: f32,
    /// By the formula.
    pub reflectance: f32,
    /// Of the metal.
    pub metal_reflectance: f32,
}

/// `shaders/optics.wgsl` on a device.
#[derive(Debug)]
pub struct GpuOptics {
    dispatch: Dispatch,
    pipeline: wgpu::ComputePipeline,
}

impl GpuOptics {
    /// Compiles the pass.
    pub fn new(gpu: &Gpu) -> Result<Self, GpuError> {
        Self::from_source(gpu, &Self::source())
    }

    /// The text of the pass.
    #[must_use]
    pub fn source() -> String {
        shader::plain(&(wgsl_constants() + OPTICS + EVALUATE))
    }

    /// Compiles another text in its place, so that a test can show that it notices a changed one.
    pub fn from_source(gpu: &Gpu, source: &str) -> Result<Self, GpuError> {
        let dispatch = Dispatch::new(gpu, source, [GIVEN_WORDS, FOUND_WORDS], None)?;
        let pipeline = dispatch.pipeline("meet_all")?;
        Ok(Self { dispatch, pipeline })
    }

    /// One outcome for each meeting, in order.
    pub fn meet(&self, meetings: &[GpuMeeting]) -> Result<Vec<GpuOutcome>, GpuError> {
        let mut outcomes = Vec::with_capacity(meetings.len());
        for meetings in meetings.chunks(BATCH) {
            let given: Vec<u32> = meetings.iter().flat_map(words).collect();
            let found = self.dispatch.run(&self.pipeline, &given)?;
            let found: Vec<[u32; FOUND_WORDS]> = bytemuck::pod_collect_to_vec(&found);
            outcomes.extend(found.into_iter().map(outcome));
        }
        Ok(outcomes)
    }
}

fn words(meeting: &GpuMeeting) -> [u32; GIVEN_WORDS] {
    let [ix, iy, iz] = meeting.incident.to_array().map(f32::to_bits);
    let [nx, ny, nz] = meeting.normal.to_array().map(f32::to_bits);
    let [metal_n, metal_k] = meeting.metal.map(f32::to_bits);
    let Shape {
        exponent,
        bias,
        scale,
        power,
    } = meeting.shape;
    let [e, b, s, p] = [exponent, bias, scale, power].map(f32::to_bits);
    let eta = meeting.eta.to_bits();
    let formula = formula_place(meeting.formula);
    [
        ix, iy, iz, eta, nx, ny, nz, metal_n, e, b, s, p, formula, metal_k, 0, 0,
    ]
}

fn outcome(words: [u32; FOUND_WORDS]) -> GpuOutcome {
    let [
        rx,
        ry,
        rz,
        k,
        tx,
        ty,
        tz,
        reflectance,
        metal_reflectance,
        cos_incident,
        _,
        _,
    ] = words.map(f32::from_bits);
    GpuOutcome {
        reflected: Vec3::new(rx, ry, rz),
        refracted: Vec3::new(tx, ty, tz),
        k,
        cos_incident,
        reflectance,
        metal_reflectance,
    }
}
