// Everitt's cube: twin of src/mapping/everitt.rs.

const EVERITT_SLOPE = 1.4511;

// (p, q) of a point of the gnomonic plane.
fn everitt_square(plane: vec2f) -> vec2f {
    return plane * (vec2f(EVERITT_SLOPE) - (EVERITT_SLOPE - 1.0) * abs(plane));
}

// The point of the gnomonic plane of (p, q).
fn everitt_plane(place: vec2f) -> vec2f {
    // The root of the parabola, in the form that does not cancel.
    let square = vec2f(EVERITT_SLOPE * EVERITT_SLOPE) - 4.0 * (EVERITT_SLOPE - 1.0) * abs(place);
    return 2.0 * place / (vec2f(EVERITT_SLOPE) + sqrt(square));
}

fn everitt_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = everitt_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn everitt_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, everitt_plane(place.border), everitt_plane(place.inside));
}
