// Arvo's cube: twin of src/mapping/arvo.rs.

// (p, q) of a point of the gnomonic plane.
fn arvo_square(plane: vec2f) -> vec2f {
    let s = plane * plane;
    return vec2f(strip_of_plane(plane.x), plane.y * sqrt((s.x + 2.0) / (s.x + s.y + 1.0)));
}

// The point of the gnomonic plane of (p, q).
fn arvo_plane(place: vec2f) -> vec2f {
    let a = plane_of_strip(place.x);
    return vec2f(a, place.y * sqrt((a * a + 1.0) / (a * a + (2.0 - place.y * place.y))));
}

fn arvo_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = arvo_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn arvo_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, arvo_plane(place.border), arvo_plane(place.inside));
}
