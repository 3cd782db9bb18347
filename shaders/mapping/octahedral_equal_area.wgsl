// Equal-area octahedral: twin of src/mapping/octahedral_equal_area.rs.

fn octahedral_equal_area_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let n = length_of(d);
    let radius = min(hypotenuse(d.x, d.z) / sqrt(n * (n + abs(d.y))), 1.0);
    let share = angle_of(abs(d.z), abs(d.x)) * (2.0 * FRAC_1_PI);
    let along_z = radius * share;
    var plane = vec2f(radius - along_z, along_z);
    if d.y < 0.0 {
        plane = vec2f(1.0 - plane.y, 1.0 - plane.x);
    }
    plane = plane * vec2f(sign_or_one(d.x), sign_or_one(d.z));
    return chart_point(0u, (plane.x + 1.0) * 0.5, (plane.y + 1.0) * 0.5);
}

// Beyond an edge: back in at the mirrored place, since each edge is folded onto itself.
fn octahedral_equal_area_inverse(p: ChartPoint) -> vec3f {
    var plane = octahedron_wrap(vec2f(2.0 * p.u - 1.0, 2.0 * p.v - 1.0));
    let below = 1.0 - abs(plane.x) - abs(plane.y) < 0.0;
    if below {
        plane = octahedron_fold(plane);
    }
    let radius = abs(plane.x) + abs(plane.y);
    var share = 0.0;
    if radius > 0.0 {
        share = abs(plane.y) / radius;
    }
    let angle = sin_cos_turns(0.25 * share);
    let across = radius * sqrt(max(2.0 - radius * radius, 0.0));
    let up = (1.0 - radius) * (1.0 + radius);
    return vec3f(
        across * angle.y * sign_or_one(plane.x),
        select(up, -up, below),
        across * angle.x * sign_or_one(plane.y),
    );
}
