// Fills one level of one chart, gutter included, from the environment.
//
// Each texel asks the mapping's inverse where it looks. The inverses continue beyond the chart, so a texel of the gutter
// holds what really lies there, and filtering across a border meets the neighbour's light.

struct Bake {
    // Width and height of the chart in texels at this level, gutter in texels, index of the chart.
    chart: vec4f,
    // Texels of the environment in a radian, its last level.
    environment: vec4f,
    // Columns: from a direction of the world to the one in the environment's picture.
    environment_from_world: array<vec4f, 3>,
}

@group(0) @binding(0) var<uniform> bake: Bake;
@group(0) @binding(1) var environment: texture_2d<f32>;
@group(0) @binding(2) var environment_sampler: sampler;

const LARGEST_HALF = 65504.0;

fn dir_at(texels: vec2f) -> vec3f {
    let uv = texels / bake.chart.xy;
    return map_inverse(ChartPoint(u32(bake.chart.w), uv.x, uv.y));
}

// The environment is a latlong picture; its sampler repeats sideways, so the date line is no border.
fn environment_light(world: vec3f, level: f32) -> vec3f {
    let columns = bake.environment_from_world;
    let dir = (columns[0] * world.x + columns[1] * world.y + columns[2] * world.z).xyz;
    let u = 0.5 + angle_of(dir.x, dir.z) * (0.5 * FRAC_1_PI);
    let v = angle_of(hypotenuse(dir.x, dir.z), dir.y) * FRAC_1_PI;
    return textureSampleLevel(environment, environment_sampler, vec2f(u, v), level).rgb;
}

@fragment
fn bake_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    // Two by two samples, each for a quarter of the texel.
    let centre = at.xy - bake.chart.z;
    let a = dir_at(centre + vec2f(-0.25, -0.25));
    let b = dir_at(centre + vec2f(0.25, -0.25));
    let c = dir_at(centre + vec2f(-0.25, 0.25));
    let d = dir_at(centre + vec2f(0.25, 0.25));
    // Half of the sums: the sides of one sample's quarter.
    let side_rad = footprint_rad(0.5 * (b - a + d - c), 0.5 * (c - a + d - b));
    let wanted = log2(max(side_rad * bake.environment.x, 1.0));
    let level = min(wanted, bake.environment.y);
    let sum = environment_light(a, level) + environment_light(b, level)
        + environment_light(c, level) + environment_light(d, level);
    return vec4f(min(0.25 * sum, vec3f(LARGEST_HALF)), 1.0);
}
