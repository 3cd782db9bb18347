// Equi-angular cube: twin of src/mapping/eac.rs.

fn eac_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let scale = 2.0 * FRAC_1_PI;
    return chart_point(g.face, 0.5 + atan_unit(g.a) * scale, 0.5 + atan_unit(g.b) * scale);
}

// Beyond the face: on along its own plane.
fn eac_inverse(p: ChartPoint) -> vec3f {
    return from_gnomonic(p.chart, tan_turns((p.u - 0.5) * 0.25), tan_turns((p.v - 0.5) * 0.25));
}
