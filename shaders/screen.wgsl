// One triangle that covers the whole target, and no more.

@vertex
fn screen_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32((index & 1u) << 2u), f32((index & 2u) << 1u)) - 1.0;
    return vec4f(corner, 1.0, 1.0);
}
