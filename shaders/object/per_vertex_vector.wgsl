// A mirror whose reflected vector is computed at each vertex and interpolated.

struct ObjectPoint {
    @builtin(position) position: vec4f,
    @location(0) dir: vec3f,
}

@vertex
fn object_vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> ObjectPoint {
    let relative = position - view.eye.xyz;
    let dir = reflected_dir(unit(relative), normal);
    return ObjectPoint(view.clip_from_relative * vec4f(relative, 1.0), dir);
}

@fragment
fn object_fragment(point: ObjectPoint) -> @location(0) vec4f {
    let dir = unit(point.dir);
    return vec4f(seen(dir, dpdx(dir), dpdy(dir)), 1.0);
}
