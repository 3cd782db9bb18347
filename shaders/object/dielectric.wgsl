// Reflection and refraction, alike for all colours. Where all light is reflected both directions are the same.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let m = meet(incident, normal, material.interface_.x);
    let part = reflectance(FORMULA, m, material_shape());
    return mixed(reflected_dir(incident, normal), refracted_dir(incident, normal, m), part);
}
