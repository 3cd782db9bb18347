// The cube map by the cube sampler: a direction is where it is to look. The zero vector for what is no direction.
fn cube_bent(dir: vec3f) -> vec3f {
    if !is_direction(dir) {
        return vec3f(0.0);
    }
    return dir;
}
