// Computes the optics at one interface on arrays, for src/gpu/optics.rs. Storage buffers, no sampler.
//
// An element is four vectors of four words given and three found:
//   given  incident (x, y, z), eta; normal (x, y, z), metal n; shape; formula, metal k, -, -
//   found  reflected (x, y, z), k; refracted (x, y, z), reflectance; metal reflectance, cosine, -, index
// The last word is the element's own index, so that an element that nobody wrote, or the wrong one, shows.

@group(0) @binding(0) var<storage, read> given: array<array<vec4u, 4>>;
@group(0) @binding(1) var<storage, read_write> found: array<array<vec4u, 3>>;

@compute @workgroup_size(64)
fn meet_all(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&given) {
        return;
    }
    let ray = bitcast<vec4f>(given[id.x][0]);
    let surface = bitcast<vec4f>(given[id.x][1]);
    let numbers = bitcast<vec4f>(given[id.x][2]);
    let choice = given[id.x][3];

    let incident = ray.xyz;
    let normal = surface.xyz;
    let m = meet(incident, normal, ray.w);
    let shape = Shape(numbers.x, numbers.y, numbers.z, numbers.w);
    let of_metal = metal_reflectance(m.cos_incident, surface.w, bitcast<f32>(choice.y));
    found[id.x][0] = bitcast<vec4u>(vec4f(reflected_dir(incident, normal), m.k));
    found[id.x][1] = bitcast<vec4u>(vec4f(refracted_dir(incident, normal, m), reflectance(choice.x, m, shape)));
    found[id.x][2] = vec4u(bitcast<u32>(of_metal), bitcast<u32>(m.cos_incident), 0u, id.x);
}
