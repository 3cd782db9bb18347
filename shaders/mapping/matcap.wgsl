// Matcap: twin of src/mapping/matcap.rs.

fn matcap_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let n = length_of(d);
    return chart_point(0u, (d.x / n + 1.0) * 0.5, (1.0 - d.y / n) * 0.5);
}

// Beyond the rim: the rim's own direction.
fn matcap_inverse(p: ChartPoint) -> vec3f {
    let x = 2.0 * p.u - 1.0;
    let y = 1.0 - 2.0 * p.v;
    let z = -sqrt(max(height_squared(p.u, p.v), 0.0));
    return unit(vec3f(x, y, z));
}
