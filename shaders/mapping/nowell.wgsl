// Nowell's cube: twin of src/mapping/nowell.rs.

// p from the component c of the ball's point: the root of s^2 - sum s + 6 c^2 = 0, in the form that does not cancel.
fn nowell_place(c: f32, sum: f32) -> f32 {
    return c * sqrt(12.0 / (sum + sqrt(max(sum * sum - 24.0 * c * c, 0.0))));
}

// (p, q) of a point of the gnomonic plane.
fn nowell_square(plane: vec2f) -> vec2f {
    let n = sqrt(1.0 + dot(plane, plane));
    let ball = plane / n;
    let twice = 2.0 * (ball.x * ball.x - ball.y * ball.y);
    return vec2f(nowell_place(ball.x, 3.0 + twice), nowell_place(ball.y, 3.0 - twice));
}

// The point of the gnomonic plane of (p, q).
fn nowell_plane(place: vec2f) -> vec2f {
    let square = place * place;
    let across = sqrt(vec2f(0.5) - square.yx * (1.0 / 6.0));
    let up = (1.0 - 0.5 * square.x) * (1.0 - 0.5 * square.y) + square.x * square.y * (1.0 / 12.0);
    return place * across / sqrt(up);
}

fn nowell_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = nowell_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn nowell_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, nowell_plane(place.border), nowell_plane(place.inside));
}
