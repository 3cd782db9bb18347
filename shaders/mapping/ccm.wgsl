// Continuous cube map: twin of src/mapping/ccm.rs.

fn ccm_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let g = gnomonic(dir, sign_table(dir));
    if g.face < 2u {
        return chart_point(g.face, ccm_across_edge(g.a, g.b), ccm_along_edge(g.b));
    }
    return chart_point(g.face, ccm_along_edge(g.a), ccm_across_edge(g.b, g.a));
}

fn ccm_along_edge(t: f32) -> f32 {
    return 0.5 + atan_unit(t * FRAC_1_SQRT_2) * (0.5 / CCM_HALF_EDGE_RAD);
}

fn ccm_across_edge(t: f32, s: f32) -> f32 {
    let q = 1.0 / sqrt(1.0 + s * s);
    return 0.5 + 0.5 * atan_unit(t * q) / atan_unit(min(q, 1.0));
}

// Beyond the face: meridians and latitudes continue.
fn ccm_inverse(p: ChartPoint) -> vec3f {
    if p.chart < 2u {
        let e = ccm_from_edge(p.v, p.u);
        return from_frame(p.chart, e.y, e.x, e.z);
    }
    let e = ccm_from_edge(p.u, p.v);
    return from_frame(p.chart, e.x, e.y, e.z);
}

fn ccm_from_edge(l: f32, m: f32) -> vec3f {
    let a = tan_turns((l - 0.5) * (CCM_HALF_EDGE_RAD * FRAC_1_PI)) * SQRT_2;
    let q = 1.0 / sqrt(1.0 + a * a);
    let latitude = sin_cos_turns((m - 0.5) * atan_unit(min(q, 1.0)) * FRAC_1_PI);
    return vec3f(latitude.y * q * a, latitude.x, latitude.y * q);
}
