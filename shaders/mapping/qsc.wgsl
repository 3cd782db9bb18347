// Quadrilateralised spherical cube: twin of src/mapping/qsc.rs.

// (p, q) of a point of the gnomonic plane.
fn qsc_square(plane: vec2f) -> vec2f {
    let is_upright = abs(plane.y) > abs(plane.x);
    let turned = select(plane, plane.yx, is_upright);
    // In the very middle there is no slope; any will do.
    var slope = 0.0;
    if abs(turned.x) >= SMALLEST_NORMAL {
        // A division may be off by 2.5 ULP and go beyond 1; the twin's is rounded right, so it needs no clamp.
        slope = clamp(turned.y / turned.x, -1.0, 1.0);
    }
    let square = slope * slope;
    let reach = sqrt(2.0 + square);
    let n = sqrt(1.0 + dot(plane, plane));
    let along = turned.x * sqrt(reach * (reach + 1.0) / (n * (n + 1.0)));
    let angle = atan_unit(slope * (1.0 + square) / ((reach + 1.0) * (reach + square)));
    let place = vec2f(along, along * angle * (12.0 * FRAC_1_PI));
    return select(place, place.yx, is_upright);
}

// The point of the gnomonic plane of (p, q).
fn qsc_plane(place: vec2f) -> vec2f {
    let is_upright = abs(place.y) > abs(place.x);
    let turned = select(place, place.yx, is_upright);
    var slope = 0.0;
    if abs(turned.x) >= SMALLEST_NORMAL {
        // As above.
        slope = clamp(turned.y / turned.x, -1.0, 1.0);
    }
    // By the half of the angle and sin(pi/8), so that nothing cancels.
    let angle = sin_cos_turns(slope * (1.0 / 48.0));
    let bound = 0.3826834323650898;
    let tangent = angle.x * angle.y / ((bound - angle.x) * (bound + angle.x));
    let reach = sqrt(2.0 + tangent * tangent);
    let both = reach * (reach + 1.0);
    let versine = turned.x * turned.x * (1.0 + tangent * tangent) / both;
    let along = turned.x * sqrt((2.0 - versine) / both) / (1.0 - versine);
    let plane = vec2f(along, along * tangent);
    return select(plane, plane.yx, is_upright);
}

fn qsc_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, largest_component(dir));
    let place = qsc_square(vec2f(g.a, g.b));
    return chart_point(g.face, 0.5 + 0.5 * place.x, 0.5 + 0.5 * place.y);
}

fn qsc_inverse(p: ChartPoint) -> vec3f {
    let place = mirrored_place(p);
    return from_mirrored_place(p.chart, qsc_plane(place.border), qsc_plane(place.inside));
}
