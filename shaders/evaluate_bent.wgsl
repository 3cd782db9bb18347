// What a direction finds: where the sampler is to look.
fn words_found(dir: vec3f) -> vec3u {
    return bitcast<vec3u>(map_bent(dir));
}
