// k as an intensity: cos^2 of the refracted ray. Below zero it is marked, and the darker the farther.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let k = meet(incident, normal, material.interface_.x).k;
    let below = marked(vec3f(0.0), TOTAL_REFLECTION_COLOR * clamp(1.0 + 0.5 * k, 0.3, 1.0), at);
    return select(vec3f(min(k, 1.0)), below, k < 0.0);
}
