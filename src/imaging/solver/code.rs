//! The answer as shader code.

use std::fmt::Write as _;

use crate::mapping::cube_face::{from_frame, largest_component, to_frame};
use crate::mapping::{Arrangement, Axes};
use crate::math::Vec3;

/// A language for shader code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShaderLanguage {
    /// WebGPU's.
    Wgsl,
    /// OpenGL's and Vulkan's.
    Glsl,
}

impl ShaderLanguage {
    const fn vector(self) -> &'static str {
        match self {
            Self::Wgsl => "vec3f",
            Self::Glsl => "vec3",
        }
    }

    fn function(self, body: &str) -> String {
        let (vector, name) = (self.vector(), "lookup_direction");
        match self {
            Self::Wgsl => format!("fn {name}(d: {vector}) -> {vector} {{\n{body}}}\n"),
            Self::Glsl => format!("{vector} {name}({vector} d) {{\n{body}}}\n"),
        }
    }

    fn absolute(self) -> &'static str {
        match self {
            Self::Wgsl => "    let a = abs(d);\n",
            Self::Glsl => "    vec3 a = abs(d);\n",
        }
    }

    fn permuted(self, axes: Axes) -> String {
        format!("{}({})", self.vector(), axes.expressions("d").join(", "))
    }
}

/// A shader function that turns a direction in the world into the one with which to look up the unchanged pictures.
pub fn lookup_code(arrangement: &Arrangement, language: ShaderLanguage) -> String {
    let mut body = String::new();
    if let Some(world_from_map) = arrangement.axes() {
        let permuted = language.permuted(world_from_map.inverse());
        let _ = writeln!(body, "    return {permuted};");
        return language.function(&body);
    }
    body.push_str(language.absolute());
    // On ties z wins over y over x, as in the graphics interfaces.
    for (condition, axis, charts) in [
        ("if (a.z >= a.x && a.z >= a.y)", "z", [4, 5]),
        ("if (a.y >= a.x)", "y", [2, 3]),
        ("", "x", [0, 1]),
    ] {
        let indent = if condition.is_empty() {
            "    "
        } else {
            "        "
        };
        if !condition.is_empty() {
            let _ = writeln!(body, "    {condition} {{");
        }
        let [positive, negative] =
            charts.map(|chart| language.permuted(lookup_axes(arrangement, chart)));
        if positive == negative {
            let _ = writeln!(body, "{indent}return {positive};");
        } else {
            let _ = writeln!(
                body,
                "{indent}if (d.{axis} >= 0.0) {{ return {positive}; }}"
            );
            let _ = writeln!(body, "{indent}return {negative};");
        }
        if !condition.is_empty() {
            body.push_str("    }\n");
        }
    }
    language.function(&body)
}

/// The signed permutation that leads from a direction on a face to where the face's picture is looked up.
fn lookup_axes(arrangement: &Arrangement, chart: u32) -> Axes {
    // No two components alike, so that one permutation alone fits.
    let probe: Vec3<f64> = from_frame(chart, 0.25, 0.5, 1.0);
    let looked_up = lookup_direction(arrangement, probe);
    Axes::all()
        .find(|axes| axes.apply(probe) == looked_up)
        .unwrap_or_default()
}

/// The direction with which the unchanged pictures must be looked up, by the usual face table, to see what lies in
/// direction `dir` of the world.
pub fn lookup_direction(arrangement: &Arrangement, dir: Vec3<f64>) -> Vec3<f64> {
    let chart = largest_component(dir);
    let (sc, tc, ma) = to_frame(chart, dir);
    let label = arrangement.label_of(chart).unwrap_or(chart as usize);
    let turn = arrangement.held()[label].turn;
    // The face's square reaches from -ma to ma; as a place in [0, 1]^2 it can be turned.
    let [u, v] = turn.cell_place([sc, tc].map(|c| (c / ma + 1.0) / 2.0));
    let [sc, tc] = [u, v].map(|c| (2.0 * c - 1.0) * ma);
    from_frame(label as u32, sc, tc, ma)
}
