// What a direction finds: its chart point.
fn words_found(dir: vec3f) -> vec3u {
    let point = map_forward(dir);
    return vec3u(point.chart, bitcast<u32>(point.u), bitcast<u32>(point.v));
}
