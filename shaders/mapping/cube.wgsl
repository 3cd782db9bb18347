// Cube map: twin of src/mapping/cube.rs.

fn cube_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    return chart_point(g.face, (g.a + 1.0) * 0.5, (g.b + 1.0) * 0.5);
}

// Beyond the face: on along its own plane.
fn cube_inverse(p: ChartPoint) -> vec3f {
    return from_gnomonic(p.chart, 2.0 * p.u - 1.0, 2.0 * p.v - 1.0);
}
