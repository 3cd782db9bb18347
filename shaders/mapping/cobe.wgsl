// COBE cube: twin of src/mapping/cobe.rs.

// The published polynomial from the plane to the square, for the first coordinate.
fn cobe_fit(a: f32, b: f32) -> f32 {
    let aa = a * a;
    let bb = b * b;
    let inner = (-0.212853382041 + 0.0941259684877 * bb + 0.0693532685333 * aa) * aa
        + (-0.117847692949 + 0.0107989197181 * bb) * bb;
    return a * (1.0 + (1.0 - aa) * (inner + 0.37738198385));
}

fn cobe_onto(p: f32, q: f32) -> f32 {
    let pp = p * p;
    let qq = q * q;
    let inner = (-0.0941180085824 + 0.0409125981187 * qq - 0.0623272690881 * pp) * pp
        + (0.0275922480902 + 0.0342217026979 * qq) * qq;
    return p * (1.0 + (1.0 - pp) * (inner - 0.276048765048));
}

// (p, q) of a point of the gnomonic plane.
fn cobe_square(plane: vec2f) -> vec2f {
    let wanted = vec2f(cobe_fit(plane.x, plane.y), cobe_fit(plane.y, plane.x));
    var found = wanted;
    for (var i = 0; i < 4; i++) {
        let back = cobe_plane(found);
        found += wanted - vec2f(cobe_fit(back.x, back.y), cobe_fit(back.y, back.x));
    }
    return found;
}

// The point of the gnomonic plane of (p, q).
fn cobe_plane(place: vec2f) -> vec2f {
    return vec2f(cobe_onto(place.x, place.y), cobe_onto(place.y, place.x));
}

fn cobe_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = cobe_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn cobe_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, cobe_plane(place.border), cobe_plane(place.inside));
}
