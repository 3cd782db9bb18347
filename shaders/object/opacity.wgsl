// How much of the sky a transparent mirror hides.

fn opacity(incident: vec3f, normal: vec3f) -> f32 {
    // Clamped: a normal that turns away would give up to 2 (erratum R7).
    let by_angle = clamp(1.0 + dot(incident, normal), 0.0, 1.0);
    return select(material.interface_.y, by_angle, material.interface_.z > 0.0);
}
