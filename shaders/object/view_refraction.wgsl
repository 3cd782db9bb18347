// The refracted light alone; where all light is reflected there is none, and that is marked.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let m = meet(incident, normal, material.interface_.x);
    let dir = refracted_dir(incident, normal, m);
    let color = seen(dir, dpdx(dir), dpdy(dir));
    return select(color, marked(color, TOTAL_REFLECTION_COLOR, at), m.k < 0.0);
}
