// The continuous cube map by the cube sampler. Its faces lie in the cube's layers as they are, since both have the frames of
// shaders/cube_face.wgsl. A direction is bent so that the place where the sampler looks, its two smaller components over the
// largest, is that of the texel: the sampler filters and crosses seams by itself. What it divides by need not be divided by before.

// A little less than 1: all roundings of a bent component together are 3.5 units of 2^-24, so that the sampler takes the face that
// the sign table has picked.
const CCM_BENT_INSIDE = 1.0 - 0x1p-22f;

// The zero vector for what is no direction.
fn ccm_bent(dir: vec3f) -> vec3f {
    if !is_direction(dir) {
        return vec3f(0.0);
    }
    let g = gnomonic(dir, sign_table(dir));
    if g.face < 2u {
        let e = ccm_bent_edge(g.b, g.a);
        return from_frame(g.face, e.y, e.x, e.z);
    }
    let e = ccm_bent_edge(g.a, g.b);
    return from_frame(g.face, e.x, e.y, e.z);
}

// Along the edge, across it, and what both are divided by.
fn ccm_bent_edge(t: f32, s: f32) -> vec3f {
    let q = 1.0 / sqrt(1.0 + t * t);
    let reach = atan_unit(min(q, 1.0));
    let along = atan_unit(t * FRAC_1_SQRT_2) * reach * (CCM_BENT_INSIDE / CCM_HALF_EDGE_RAD);
    return vec3f(along, atan_unit(s * q) * CCM_BENT_INSIDE, reach);
}
