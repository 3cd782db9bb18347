// Both surfaces of the unit ball in closed form, at each wavelength: what is reflected outside, then what leaves after 0, 1, ...
// inner reflections.

fn light_through(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let count = u32(material.counts.x);
    let bounces = u32(material.counts.y);
    let reflected = reflected_dir(incident, normal);
    let found = look_up(reflected, dpdx(reflected), dpdy(reflected));
    var middle = ball_enter(incident, normal, material.wavelengths[count / 2u].w);
    // Neighbouring wavelengths leave with nearly the same footprint.
    var levels: array<f32, MOST_BOUNCES + 1>;
    for (var j = 0u; j <= min(bounces, MOST_BOUNCES); j++) {
        let dir = ball_exit_dir(middle);
        levels[j] = located(dir, dpdx(dir), dpdy(dir)).level;
        middle = ball_bounce(middle);
    }
    var light = vec3f(0.0);
    for (var i = 0u; i < count; i++) {
        let wavelength = material.wavelengths[i];
        var ray = ball_enter(incident, normal, wavelength.w);
        let outside = 0.5 * (ray.reflectance.x + ray.reflectance.y);
        light += found.light * wavelength.rgb * outside;
        for (var j = 0u; j <= min(bounces, MOST_BOUNCES); j++) {
            let leaving = look_up_beside(ball_exit_dir(ray), levels[j]);
            light += leaving * wavelength.rgb * ball_exit_weight(ray);
            ray = ball_bounce(ray);
        }
    }
    return max(light, vec3f(0.0));
}
