// The refracted light of every wavelength, each looked up by its own direction; white stays white.

struct Spectrum {
    light: vec3f,
    // Of the wavelength in the middle: where overlays are painted.
    dir: vec3f,
    found: Found,
    right: vec3f,
    down: vec3f,
}

fn refracted_spectrum(incident: vec3f, normal: vec3f) -> Spectrum {
    let count = u32(material.counts.x);
    let middle = meet(incident, normal, material.wavelengths[count / 2u].w);
    var spectrum: Spectrum;
    spectrum.dir = refracted_dir(incident, normal, middle);
    spectrum.right = dpdx(spectrum.dir);
    spectrum.down = dpdy(spectrum.dir);
    spectrum.found = located(spectrum.dir, spectrum.right, spectrum.down);
    for (var i = 0u; i < count; i++) {
        let wavelength = material.wavelengths[i];
        let m = meet(incident, normal, wavelength.w);
        let dir = refracted_dir(incident, normal, m);
        // Neighbouring wavelengths cover as much of the map: one level serves all.
        spectrum.light += look_up_beside(dir, spectrum.found.level) * wavelength.rgb;
    }
    // A few pure colours can leave the screen's range by a little.
    spectrum.light = max(spectrum.light, vec3f(0.0));
    return spectrum;
}
