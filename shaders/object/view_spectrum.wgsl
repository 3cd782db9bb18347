// The refracted light of every wavelength alone; where the middle one is all reflected it is marked.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let spectrum = refracted_spectrum(incident, normal);
    let color = painted(
        display(spectrum.light),
        spectrum.found,
        spectrum.dir,
        spectrum.right,
        spectrum.down,
    );
    let eta = material.wavelengths[u32(material.counts.x) / 2u].w;
    let is_total = meet(incident, normal, eta).k < 0.0;
    return select(color, marked(color, TOTAL_REFLECTION_COLOR, at), is_total);
}
