// Light from a direction, out of the mapping's own map. What is in capitals is written in front by src/gpu/kit.rs.

@group(0) @binding(1) var map: texture_2d_array<f32>;
@group(0) @binding(2) var map_sampler: sampler;

// Width and height of a chart in texels.
fn chart_size() -> vec2f {
    return vec2f(textureDimensions(map, 0) - vec2u(2u * GUTTER));
}

// The texture's coordinates of a chart point: beyond the gutter.
fn texture_point(u: f32, v: f32, size: vec2f) -> vec2f {
    return (vec2f(u, v) * size + f32(GUTTER)) / (size + 2.0 * f32(GUTTER));
}

fn map_light(p: ChartPoint, size: vec2f, level: f32) -> vec3f {
    return textureSampleLevel(map, map_sampler, texture_point(p.u, p.v, size), p.chart, level).rgb;
}

// How a chart lies on the sphere around a point: what one texel to the right and one down change in the direction.
struct Tangents {
    right: vec3f,
    down: vec3f,
}

// Differences of the inverse, taken towards the middle, so that they never leave the chart. No coordinate is ever
// differentiated across a border: that is what draws lines along seams elsewhere. `dir` is the unit direction of p.
fn chart_tangents(p: ChartPoint, dir: vec3f, size: vec2f) -> Tangents {
    let inwards = vec2f(select(-1.0, 1.0, p.u < 0.5), select(-1.0, 1.0, p.v < 0.5));
    var here = dir;
    if !MAP_COVERS_SPHERE {
        // The inverse may return the other direction that shares the texel.
        here = map_inverse(p);
    }
    let right = map_inverse(ChartPoint(p.chart, p.u + inwards.x / size.x, p.v)) - here;
    let down = map_inverse(ChartPoint(p.chart, p.u, p.v + inwards.y / size.y)) - here;
    return Tangents(right * inwards.x, down * inwards.y);
}

// The level at which a texel covers as much as the pixel.
fn map_level(pixel_rad: f32, tangents: Tangents) -> f32 {
    let texel_rad = footprint_rad(tangents.right, tangents.down);
    return clamp(log2(max(pixel_rad, 1e-9) / max(texel_rad, 1e-9)), 0.0, f32(MAP_LEVELS - 1u));
}
