// What is seen of a direction: how far this form's chart point is from the precise form's, in texels of the map, magnified; white from
// 1 on. `precise_map_forward` and `precise_map_inverse` stand in front.
fn form_shown(color: vec3f, dir: vec3f, p: ChartPoint) -> vec3f {
    return vec3f(clamp(texels_apart(dir, p) * view.probe.w, 0.0, 1.0));
}

fn texels_apart(dir: vec3f, p: ChartPoint) -> f32 {
    let near = precise_map_forward(dir);
    let size = chart_size();
    let apart = vec2f(p.u - near.u, p.v - near.v);
    if p.chart == near.chart && max(abs(apart.x), abs(apart.y)) < 0.25 {
        return length(apart * size);
    }
    // On the other side of a seam coordinates cannot be compared: the angle stands for them.
    let tangents = chart_tangents(near, dir, size);
    let texel_rad = footprint_rad(tangents.right, tangents.down);
    return length(precise_map_inverse(p) - dir) / max(texel_rad, 1e-9);
}
