// Reflection, and refraction of each wavelength.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let spectrum = refracted_spectrum(incident, normal);
    let dir = reflected_dir(incident, normal);
    let right = dpdx(dir);
    let down = dpdy(dir);
    let found = look_up(dir, right, down);
    let eta = material.wavelengths[u32(material.counts.x) / 2u].w;
    let part = reflectance(FORMULA, meet(incident, normal, eta), material_shape());
    let color = display(spectrum.light + (found.light - spectrum.light) * part);
    let over_a = painted(color, found, dir, right, down);
    let over_b = painted(color, spectrum.found, spectrum.dir, spectrum.right, spectrum.down);
    return mix(over_b, over_a, clamp(part, 0.0, 1.0));
}
