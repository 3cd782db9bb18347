// S2 quadratic cube: twin of src/mapping/s2_quadratic.rs.

// (p, q) of a point of the gnomonic plane.
fn s2_quadratic_square(plane: vec2f) -> vec2f {
    // sqrt(1 + 3 a) - 1, without the difference.
    return 3.0 * plane / (vec2f(1.0) + sqrt(vec2f(1.0) + 3.0 * abs(plane)));
}

// The point of the gnomonic plane of (p, q).
fn s2_quadratic_plane(place: vec2f) -> vec2f {
    return place * (vec2f(2.0) + abs(place)) * (1.0 / 3.0);
}

fn s2_quadratic_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = s2_quadratic_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn s2_quadratic_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, s2_quadratic_plane(place.border), s2_quadratic_plane(place.inside));
}
