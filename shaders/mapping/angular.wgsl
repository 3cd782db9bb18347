// Angular map: twin of src/mapping/angular.rs.

fn angular_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let across = hypotenuse(d.x, d.y);
    let rho = angle_of(across, d.z) * (0.5 * FRAC_1_PI);
    let side = unit_in_plane(d.xy);
    return chart_point(0u, 0.5 + rho * side.x, 0.5 - rho * side.y);
}

// Beyond the rim: past -z and up the other side.
fn angular_inverse(p: ChartPoint) -> vec3f {
    let offset = vec2f(p.u - 0.5, 0.5 - p.v);
    let rho = hypotenuse(offset.x, offset.y);
    if rho <= 0.0 {
        return vec3f(0.0, 0.0, 1.0);
    }
    let angle = sin_cos_turns(rho);
    return vec3f(angle.x * (offset / rho), angle.y);
}
