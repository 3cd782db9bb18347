// The opacity as an intensity.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    return vec3f(opacity(incident, normal));
}
