// The reflectance as an intensity; above 1, as a fault makes it, it is marked.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let part = reflectance(FORMULA, meet(incident, normal, material.interface_.x), material_shape());
    return select(vec3f(clamp(part, 0.0, 1.0)), marked(vec3f(1.0), FAULT_COLOR, at), part > 1.0);
}
