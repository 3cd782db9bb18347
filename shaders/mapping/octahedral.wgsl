// Octahedral: twin of src/mapping/octahedral.rs.

fn octahedral_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let sum = abs(d.x) + abs(d.y) + abs(d.z);
    var plane = d.xz / sum;
    if d.y < 0.0 {
        plane = octahedron_fold(plane);
    }
    return chart_point(0u, (plane.x + 1.0) * 0.5, (plane.y + 1.0) * 0.5);
}

// Beyond an edge: back in at the mirrored place, since each edge is folded onto itself.
fn octahedral_inverse(p: ChartPoint) -> vec3f {
    var plane = octahedron_wrap(vec2f(2.0 * p.u - 1.0, 2.0 * p.v - 1.0));
    let y = 1.0 - abs(plane.x) - abs(plane.y);
    if y < 0.0 {
        plane = octahedron_fold(plane);
    }
    return unit(vec3f(plane.x, y, plane.y));
}
