// Cylindrical equal-area: twin of src/mapping/cylindrical_equal_area.rs.

fn cylindrical_equal_area_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let u = 0.5 + angle_of(d.x, d.z) * (0.5 * FRAC_1_PI);
    let n = length_of(d);
    let across = hypotenuse(d.x, d.z);
    var v = 0.5 * (across / n) * (across / (n + abs(d.y)));
    if d.y <= 0.0 {
        v = 1.0 - v;
    }
    return chart_point(0u, u, v);
}

// Beyond the chart: over the date line; beyond a pole down the other side, as v runs back.
fn cylindrical_equal_area_inverse(p: ChartPoint) -> vec3f {
    let v = abs(p.v - 2.0 * max(p.v - 1.0, 0.0));
    let side = select(1.0, -1.0, p.v < 0.0 || p.v > 1.0);
    let longitude = sin_cos_turns(p.u - 0.5);
    let across = 2.0 * side * sqrt(max(v * (1.0 - v), 0.0));
    return vec3f(across * longitude.x, 1.0 - 2.0 * v, across * longitude.y);
}
