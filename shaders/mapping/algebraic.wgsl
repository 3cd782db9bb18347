// Algebraic cube: twin of src/mapping/algebraic.rs.

const ALGEBRAIC_SQUARE = 0.87 * 0.87;

// (p, q) of a point of the gnomonic plane.
fn algebraic_square(plane: vec2f) -> vec2f {
    return plane * sqrt((1.0 + ALGEBRAIC_SQUARE) / (vec2f(1.0) + ALGEBRAIC_SQUARE * plane * plane));
}

// The point of the gnomonic plane of (p, q).
fn algebraic_plane(place: vec2f) -> vec2f {
    return place / sqrt(vec2f(1.0 + ALGEBRAIC_SQUARE) - ALGEBRAIC_SQUARE * place * place);
}

fn algebraic_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = algebraic_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn algebraic_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, algebraic_plane(place.border), algebraic_plane(place.inside));
}
