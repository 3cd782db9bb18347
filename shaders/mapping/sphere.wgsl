// Sphere map: twin of src/mapping/sphere.rs.

fn sphere_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let offset = sphere_disc_offset(d);
    return chart_point(0u, 0.5 + offset.x, 0.5 - offset.y);
}

// (x, y)/m. Ahead, n - z would cancel: it is rho slope. Near the rim every rounding counts, so m comes straight from x and
// y, at a scale at which their squares are normal numbers.
fn sphere_disc_offset(d: vec3f) -> vec2f {
    let n = length_of(d);
    if d.z <= 0.0 {
        return d.xy / (2.0 * sqrt(d.x * d.x + d.y * d.y + (n - d.z) * (n - d.z)));
    }
    let rim = vec3f(d.xy, 0.0);
    if !is_direction(rim) {
        return vec2f(0.5, 0.0);
    }
    let across = scaled_direction(rim).xy;
    let slope = hypotenuse(d.x, d.y) / (n + d.z);
    let square = across.x * across.x + across.y * across.y;
    return across / (2.0 * sqrt(square + square * (slope * slope)));
}

// Beyond the rim: the rim's own direction.
fn sphere_inverse(p: ChartPoint) -> vec3f {
    let normal = vec2f(2.0 * p.u - 1.0, 1.0 - 2.0 * p.v);
    let w = sqrt(max(height_squared(p.u, p.v), 0.0));
    return vec3f(2.0 * w * normal, 1.0 - 2.0 * w * w);
}
