// Outerra's cube: twin of src/mapping/outerra.rs.

const OUTERRA_LIFT = 0.20710678118654752;

// (p, q) of a point of the gnomonic plane.
fn outerra_square(plane: vec2f) -> vec2f {
    let s = plane * plane;
    var k = 1.0 + OUTERRA_LIFT * (1.0 - s.x) * (1.0 - s.y);
    // Two leave 8e-11, the third what is rounded: 9e-8 instead of 1.3e-7. The twin's fourth is for derivatives in f64 and does nothing here.
    for (var i = 0; i < 3; i++) {
        let rest = vec2f(1.0) - s * k * k;
        let excess = 1.0 + OUTERRA_LIFT * rest.x * rest.y - k;
        k += excess / (1.0 + 2.0 * OUTERRA_LIFT * k * (s.x * rest.y + s.y * rest.x));
    }
    return plane * k;
}

// The point of the gnomonic plane of (p, q).
fn outerra_plane(place: vec2f) -> vec2f {
    let s = place * place;
    return place / (1.0 + OUTERRA_LIFT * (1.0 - s.x) * (1.0 - s.y));
}

fn outerra_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = outerra_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn outerra_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, outerra_plane(place.border), outerra_plane(place.inside));
}
