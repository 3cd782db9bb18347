//! Puts shaders together: constants written from Rust, the shared WGSL files, mappings, and the pass itself.
//!
//! What both languages know is written here from the Rust value, so that it cannot drift apart. A pass is text, not a
//! file: it may be changed before it is compiled, which is how the tests prove that they would notice a fault.

use std::f32::consts;
use std::fmt::Write;

use super::forms;
use crate::mapping::{Domain, MappingId, ShaderForm, ccm};
use crate::math::LN_2_PARTS;

/// The chart index that stands for "no direction, no chart".
pub const NO_CHART: u32 = u32::MAX;

/// The numbers: twin of `math`.
pub const MATH: &str = include_str!("../../shaders/math.wgsl");
/// The six faces: twin of `mapping::cube_face`.
pub const CUBE_FACE: &str = include_str!("../../shaders/cube_face.wgsl");
/// The path through a ball: twin of `optics::ball`. Stands behind `shaders/optics.wgsl`.
pub const BALL: &str = include_str!("../../shaders/ball.wgsl");

/// A pass without mappings: constants, shared files, `body`.
pub fn plain(body: &str) -> String {
    with_mappings(&[], body)
}

/// A pass that works with one mapping, known to `body` as `map`; see [`with_mappings`].
pub fn for_mapping(id: MappingId, body: &str) -> String {
    with_mappings(&[("map", id)], body)
}

/// The same in another form; with [`ShaderForm::CubeUnit`], `map_bent(dir: vec3f) -> vec3f` is where a cube sampler is to look.
pub fn for_form(id: MappingId, form: ShaderForm, body: &str) -> String {
    assembled(form, &[("map", id)], body)
}

/// A pass that works with several mappings, each under a role's name, a lower-case word such as `map` or `source`. For the
/// role `map` it can use:
///
/// - `map_forward(dir: vec3f) -> ChartPoint`, whose chart is `NO_CHART` for a vector that is no direction;
/// - `map_inverse(p: ChartPoint) -> vec3f`, a unit vector, which continues beyond a chart's border as the mapping's file says;
/// - `map_cell(chart: u32) -> vec2u`, the chart's cell in the picture's grid, and `map_chart(cell: vec2u) -> u32`, the chart
///   in a cell or `NO_CHART`;
/// - `MAP_ID: u32` (a `MAPPING_...` constant), `MAP_CHARTS: u32`, `MAP_IS_DISC: bool`, `MAP_GRID: vec2u` (columns, rows).
pub fn with_mappings(roles: &[(&str, MappingId)], body: &str) -> String {
    assembled(ShaderForm::Precise, roles, body)
}

fn assembled(form: ShaderForm, roles: &[(&str, MappingId)], body: &str) -> String {
    let mut text = constants();
    text.push_str(MATH);
    text.push_str(&forms::angles(form));
    text.push_str(CUBE_FACE);
    let mut ids: Vec<MappingId> = roles.iter().map(|(_, id)| *id).collect();
    if form == ShaderForm::CubeUnit {
        ids.push(MappingId::Cube);
    }
    ids.sort_unstable();
    ids.dedup();
    for id in ids {
        text.push_str(id.wgsl());
    }
    for (role, id) in roles {
        text.push_str(forms::bent(*id, form));
        text.push_str(&glue(role, *id, form));
    }
    text.push_str(body);
    text
}

/// The name of a mapping's id in every pass: `MAPPING_` and the prefix of its functions in capitals.
pub fn id_name(id: MappingId) -> String {
    format!("MAPPING_{}", id.prefix().to_uppercase())
}

/// What stands in front of every pass: numbers that Rust knows, and each mapping's id.
pub fn constants() -> String {
    let floats = [
        ("PI", consts::PI),
        ("FRAC_PI_2", consts::FRAC_PI_2),
        ("FRAC_1_PI", consts::FRAC_1_PI),
        ("SQRT_2", consts::SQRT_2),
        ("FRAC_1_SQRT_2", consts::FRAC_1_SQRT_2),
        ("LN_2_HIGH", LN_2_PARTS[0]),
        ("LN_2_LOW", LN_2_PARTS[1]),
        ("SMALLEST_NORMAL", f32::MIN_POSITIVE),
        ("LARGEST_FINITE", f32::MAX),
        ("CCM_HALF_EDGE_RAD", ccm::HALF_EDGE_RAD as f32),
    ];
    let mut text = format!("const NO_CHART: u32 = {NO_CHART}u;\n");
    for (name, value) in floats {
        line(&mut text, format_args!("const {name}: f32 = {value:?}f;"));
    }
    for (place, id) in MappingId::ALL.iter().enumerate() {
        line(
            &mut text,
            format_args!("const {}: u32 = {place}u;", id_name(*id)),
        );
    }
    text
}

/// Horner's scheme written out, lowest power first. A loop over an array would cost a memory access a term where the
/// driver does not unroll it.
pub(super) fn horner(coefficients: &[f32], x: &str) -> String {
    let mut terms = coefficients.iter().rev().map(|c| format!("({c:?}f)"));
    let highest = terms.next().unwrap_or_else(|| "0.0".to_owned());
    terms.fold(highest, |sum, c| format!("({sum} * {x} + {c})"))
}

/// What a pass calls a mapping by its role.
fn glue(role: &str, id: MappingId, form: ShaderForm) -> String {
    let info = id.info();
    let prefix = id.prefix();
    let capital = role.to_uppercase();
    let [columns, rows] = info.layout.grid();
    let (mut cells, mut charts) = (String::new(), String::new());
    for (chart, cell) in info.layout.cells().iter().enumerate() {
        let [column, row] = cell.at;
        line(
            &mut cells,
            format_args!("        case {chart}u: {{ return vec2u({column}u, {row}u); }}"),
        );
        line(
            &mut charts,
            format_args!(
                "        case {}u: {{ return {chart}u; }}",
                row * columns + column
            ),
        );
    }
    format!(
        "\
const {capital}_ID: u32 = {name};
const {capital}_CHARTS: u32 = {count}u;
const {capital}_IS_DISC: bool = {is_disc};
const {capital}_GRID: vec2u = vec2u({columns}u, {rows}u);
{forward}
fn {role}_inverse(p: ChartPoint) -> vec3f {{ return {prefix}_inverse(p); }}
fn {role}_cell(chart: u32) -> vec2u {{
    switch chart {{
{cells}        default: {{ return vec2u(0u, 0u); }}
    }}
}}
fn {role}_chart(cell: vec2u) -> u32 {{
    if cell.x >= {columns}u || cell.y >= {rows}u {{
        return NO_CHART;
    }}
    switch cell.y * {columns}u + cell.x {{
{charts}        default: {{ return NO_CHART; }}
    }}
}}
",
        forward = forms::forward(role, prefix, form),
        name = id_name(id),
        count = info.chart_count(),
        is_disc = info.domain == Domain::Disc,
    )
}

/// Appends a line.
pub(super) fn line(text: &mut String, line: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{line}");
}
