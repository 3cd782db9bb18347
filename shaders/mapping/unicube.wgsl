// Unicube: twin of src/mapping/unicube.rs.

// (p, q) of a point of the gnomonic plane.
fn unicube_square(plane: vec2f) -> vec2f {
    return vec2f(strip_of_plane(plane.x), strip_of_plane(plane.y));
}

// The point of the gnomonic plane of (p, q).
fn unicube_plane(place: vec2f) -> vec2f {
    return vec2f(plane_of_strip(place.x), plane_of_strip(place.y));
}

fn unicube_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = unicube_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn unicube_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, unicube_plane(place.border), unicube_plane(place.inside));
}
