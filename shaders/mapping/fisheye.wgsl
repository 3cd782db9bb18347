// Fisheye discs: twin of src/mapping/fisheye.rs.

fn fisheye_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let back = is_below_zero(dir.z);
    let rho = angle_of(hypotenuse(d.x, d.y), abs(d.z)) * FRAC_1_PI;
    let across = unit_in_plane(d.xy);
    let x = select(across.x, -across.x, back);
    return chart_point(select(0u, 1u, back), 0.5 + rho * x, 0.5 - rho * across.y);
}

// Beyond the rim: on into the other half.
fn fisheye_inverse(p: ChartPoint) -> vec3f {
    let disc = over_rim(p);
    let side = select(-1.0, 1.0, disc.chart == 0u);
    let radius = hypotenuse(disc.place.x, disc.place.y);
    if radius <= 0.0 {
        return vec3f(0.0, 0.0, side);
    }
    let angle = sin_cos_turns(0.25 * radius);
    let across = angle.x * (disc.place / radius);
    return vec3f(side * across.x, across.y, side * angle.y);
}
