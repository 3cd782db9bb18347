// A mirror.

fn object_color(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    var dir = reflected_dir(incident, normal);
    if PRINTED_REFLECTION {
        // 2 (N . I) N - I for an incident vector that runs towards the surface: the other way round (erratum P6).
        dir = -dir;
    }
    return seen(dir, dpdx(dir), dpdy(dir));
}
