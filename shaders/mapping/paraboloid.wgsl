// Dual paraboloid: twin of src/mapping/paraboloid.rs.

fn paraboloid_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let back = is_below_zero(dir.z);
    let twice = 2.0 * (length_of(d) + abs(d.z));
    let x = select(d.x, -d.x, back);
    return chart_point(select(0u, 1u, back), 0.5 + x / twice, 0.5 - d.y / twice);
}

// Beyond the rim: on into the other half.
fn paraboloid_inverse(p: ChartPoint) -> vec3f {
    let plane = vec2f(2.0 * p.u - 1.0, 1.0 - 2.0 * p.v);
    let square = plane.x * plane.x + plane.y * plane.y;
    let scale = 1.0 / (1.0 + square);
    let side = select(-1.0, 1.0, p.chart == 0u);
    return vec3f(side * 2.0 * plane.x * scale, 2.0 * plane.y * scale, side * (1.0 - square) * scale);
}
