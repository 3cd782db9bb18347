// Mercator: twin of src/mapping/mercator.rs.

// asinh(tan latitude), at most pi either way: ln((n + |y|)/across), of which nothing cancels.
fn mercator_height(d: vec3f) -> f32 {
    let n = length_of(d);
    let size = abs(d.y);
    var height = PI;
    if size < 0.9962720762 * n {
        let across = hypotenuse(d.x, d.z);
        height = ln_1p((size + size * (size / (n + across))) / across);
    }
    return select(height, -height, d.y < 0.0);
}

fn mercator_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let u = 0.5 + angle_of(d.x, d.z) * (0.5 * FRAC_1_PI);
    return chart_point(0u, u, 0.5 - mercator_height(d) * (0.5 * FRAC_1_PI));
}

// Beyond the chart: over the date line, and on towards a pole.
fn mercator_inverse(p: ChartPoint) -> vec3f {
    let longitude = sin_cos_turns(p.u - 0.5);
    let height = (0.5 - p.v) * (2.0 * PI);
    let m = exp_m1(abs(height));
    let power = m + 1.0;
    let below = power * power + 1.0;
    let up = m * (m + 2.0) / below;
    let across = 2.0 * power / below;
    return vec3f(across * longitude.x, select(up, -up, height < 0.0), across * longitude.y);
}
