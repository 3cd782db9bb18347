// The map's light in a direction: from the cube whose layers hold the charts without gutters, where the bent direction points.
// The sampler filters and crosses seams.

@group(2) @binding(0) var map_cube: texture_cube<f32>;

fn light_of(dir: vec3f, p: ChartPoint, level: f32) -> vec3f {
    return textureSampleLevel(map_cube, map_sampler, map_bent(dir), level).rgb;
}
