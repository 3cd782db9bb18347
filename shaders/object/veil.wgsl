// A mirror before the sky: what is drawn later covers, so the sky comes first and the reflection is laid over it.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    return mixed(reflected_dir(incident, normal), incident, opacity(incident, normal));
}
