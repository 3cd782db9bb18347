// Stereographic: twin of src/mapping/stereographic.rs.

// Distance from the middle over the disc's radius: tan(theta/2)/3. n + z cancels behind.
fn stereographic_radius(d: vec3f) -> f32 {
    let n = length_of(d);
    if d.z <= -0.8 * n {
        return 1.0;
    }
    let across = hypotenuse(d.x, d.y);
    var radius = across / (3.0 * (n + abs(d.z)));
    if d.z < 0.0 {
        radius = (n - d.z) / (3.0 * across);
    }
    return min(radius, 1.0);
}

fn stereographic_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let rho = 0.5 * stereographic_radius(d);
    let side = unit_in_plane(d.xy);
    return chart_point(0u, 0.5 + rho * side.x, 0.5 - rho * side.y);
}

// Beyond the rim: on, as on the disc.
fn stereographic_inverse(p: ChartPoint) -> vec3f {
    let plane = 3.0 * vec2f(2.0 * p.u - 1.0, 1.0 - 2.0 * p.v);
    let square = dot(plane, plane);
    let scale = 1.0 / (1.0 + square);
    return vec3f(plane * (2.0 * scale), (1.0 - square) * scale);
}
