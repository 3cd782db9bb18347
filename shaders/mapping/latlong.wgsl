// Latlong: twin of src/mapping/latlong.rs.

fn latlong_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let u = 0.5 + angle_of(d.x, d.z) * (0.5 * FRAC_1_PI);
    let v = angle_of(hypotenuse(d.x, d.z), d.y) * FRAC_1_PI;
    return chart_point(0u, u, v);
}

// Continues beyond the chart: over the date line, and over a pole to the other side.
fn latlong_inverse(p: ChartPoint) -> vec3f {
    let longitude = sin_cos_turns(p.u - 0.5);
    let colatitude = sin_cos_turns(0.5 * p.v);
    return vec3f(colatitude.x * longitude.x, colatitude.y, colatitude.x * longitude.y);
}
