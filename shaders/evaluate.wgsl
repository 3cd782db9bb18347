// Computes one mapping on arrays, for src/gpu/compute.rs. Storage buffers, no sampler: nothing between the formula and us.
//
// Every element is four words. A direction is (x, y, z, -), a chart point (chart, u, v, -). The last word of an output is
// its own index, so that an element that nobody wrote, or the wrong one, shows. `words_found` stands in front: the chart point
// of a direction, or the bent direction that is left to a sampler.

@group(0) @binding(0) var<storage, read> given: array<vec4u>;
@group(0) @binding(1) var<storage, read_write> found: array<vec4u>;

@compute @workgroup_size(64)
fn forward_all(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&given) {
        return;
    }
    found[id.x] = vec4u(words_found(bitcast<vec3f>(given[id.x].xyz)), id.x);
}

@compute @workgroup_size(64)
fn inverse_all(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&given) {
        return;
    }
    let words = given[id.x];
    let dir = map_inverse(ChartPoint(words.x, bitcast<f32>(words.y), bitcast<f32>(words.z)));
    found[id.x] = vec4u(bitcast<vec3u>(dir), id.x);
}

// What the others read and write, without what they compute: the floor of their times.
@compute @workgroup_size(64)
fn copy_all(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&given) {
        return;
    }
    found[id.x] = vec4u(given[id.x].xyz, id.x);
}
