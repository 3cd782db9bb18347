// A metal's reflectance for red, green and blue.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let cos_incident = min(abs(dot(incident, normal)), 1.0);
    return vec3f(
        metal_reflectance(cos_incident, material.metal_n.r, material.metal_k.r),
        metal_reflectance(cos_incident, material.metal_n.g, material.metal_k.g),
        metal_reflectance(cos_incident, material.metal_n.b, material.metal_k.b),
    );
}
