// One formula's reflectance less the other's, magnified.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let m = meet(incident, normal, material.interface_.x);
    let shape = material_shape();
    let difference = reflectance(FORMULA, m, shape) - reflectance(OTHER_FORMULA, m, shape);
    return difference_color(difference * material.interface_.w);
}
