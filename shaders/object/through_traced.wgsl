// Directions and weights that were traced through the mesh for each pixel.

fn light_through(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let count = u32(material.counts.z);
    var light = vec3f(0.0);
    for (var i = 0u; i < count; i++) {
        let path = textureLoad(traced, vec2u(at), i, 0);
        let right = bounded_change(dpdx(path.xyz));
        let down = bounded_change(dpdy(path.xyz));
        light += look_up(path.xyz, right, down).light * path.w;
    }
    return light;
}

// A pixel's neighbour may have come another way: then it says that the light is mixed here, but not of how much. Taken as a
// tenth of a radian, such pixels neither sparkle nor go grey.
fn bounded_change(change: vec3f) -> vec3f {
    return change * min(1.0, 0.1 / max(length(change), 1e-9));
}
