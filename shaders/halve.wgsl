// The next mip level: each texel is the mean of what it covers, also where a size is odd.

@group(0) @binding(0) var finer: texture_2d<f32>;

// First texel covered along one axis, and how many: at most three when the size is halved and rounded down.
fn covered(index: u32, fine: u32, coarse: u32) -> vec2u {
    let first = index * fine / coarse;
    let end = ((index + 1u) * fine + coarse - 1u) / coarse;
    return vec2u(first, end);
}

// Share of texel `at` that lies in the interval of coarse texel `index`.
fn share(at: u32, index: u32, fine: u32, coarse: u32) -> f32 {
    let ratio = f32(fine) / f32(coarse);
    let low = max(f32(at), f32(index) * ratio);
    let high = min(f32(at + 1u), f32(index + 1u) * ratio);
    return max(high - low, 0.0) / ratio;
}

@fragment
fn halve_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let texel = vec2u(at.xy);
    let fine = textureDimensions(finer);
    let coarse = max(fine / 2u, vec2u(1u));
    let columns = covered(texel.x, fine.x, coarse.x);
    let rows = covered(texel.y, fine.y, coarse.y);
    var sum = vec3f(0.0);
    for (var j = rows.x; j < rows.y; j++) {
        var row = vec3f(0.0);
        for (var i = columns.x; i < columns.y; i++) {
            row += share(i, texel.x, fine.x, coarse.x) * textureLoad(finer, vec2u(i, j), 0).rgb;
        }
        sum += share(j, texel.y, fine.y, coarse.y) * row;
    }
    return vec4f(sum, 1.0);
}
