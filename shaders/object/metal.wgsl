// A metal: a mirror tinted by its reflectance.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let dir = reflected_dir(incident, normal);
    let right = dpdx(dir);
    let down = dpdy(dir);
    let found = look_up(dir, right, down);
    let cos_incident = min(abs(dot(incident, normal)), 1.0);
    let tint = vec3f(
        metal_reflectance(cos_incident, material.metal_n.r, material.metal_k.r),
        metal_reflectance(cos_incident, material.metal_n.g, material.metal_k.g),
        metal_reflectance(cos_incident, material.metal_n.b, material.metal_k.b),
    );
    return painted(display(found.light * tint), found, dir, right, down);
}
