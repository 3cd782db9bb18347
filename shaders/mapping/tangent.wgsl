// Adjusted tangent cube: twin of src/mapping/tangent.rs.

const TANGENT_STRETCH = 1.18228668555;
const TANGENT_REACH_RAD = 0.8687348292773586;

// (p, q) of a point of the gnomonic plane.
fn tangent_square(plane: vec2f) -> vec2f {
    // One arctangent of at most 1 and its complement: the stretch passes 1.
    return vec2f(angle_of(TANGENT_STRETCH * plane.x, 1.0), angle_of(TANGENT_STRETCH * plane.y, 1.0)) * (1.0 / TANGENT_REACH_RAD);
}

// The point of the gnomonic plane of (p, q).
fn tangent_plane(place: vec2f) -> vec2f {
    let scale = TANGENT_REACH_RAD * 0.5 * FRAC_1_PI;
    return vec2f(tan_turns(place.x * scale), tan_turns(place.y * scale)) * (1.0 / TANGENT_STRETCH);
}

fn tangent_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = tangent_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn tangent_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, tangent_plane(place.border), tangent_plane(place.inside));
}
