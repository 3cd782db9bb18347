// Directions and weights that were traced through the mesh for each pixel.

fn light_through(incident: vec3f, normal: vec3f, at: vec2f) -> vec3f {
    let count = u32(material.counts.z);
    var light = vec3f(0.0);
    for (var i = 0u; i < count; i++) {
        let path = textureLoad(traced, vec2u(at), i, 0);
        // A pixel's neighbours may have come another way: their difference says nothing then.
        let right = dpdx(path.xyz);
        let down = dpdy(path.xyz);
        let is_smooth = dot(right, right) + dot(down, down) < 0.1;
        let found = look_up(
            path.xyz,
            select(vec3f(0.0), right, is_smooth),
            select(vec3f(0.0), down, is_smooth),
        );
        light += found.light * path.w;
    }
    return light;
}
