// The light that has passed both surfaces, wherever its directions come from; beside it what one surface does.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let both = light_through(incident, normal, at);
    if !SHOW_DIFFERENCE {
        return display(both);
    }
    let m = meet(incident, normal, material.interface_.x);
    let reflected = reflected_dir(incident, normal);
    let refracted = refracted_dir(incident, normal, m);
    let a = look_up(reflected, dpdx(reflected), dpdy(reflected)).light;
    let b = look_up(refracted, dpdx(refracted), dpdy(refracted)).light;
    let one = mix(b, a, clamp(reflectance(FORMULA, m, material_shape()), 0.0, 1.0));
    return clamp(abs(display(both) - display(one)) * material.interface_.w, vec3f(0.0), vec3f(1.0));
}
