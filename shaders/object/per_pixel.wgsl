// An object whose optics is computed at each pixel: a file beside this one says how, as `object_color`.

struct ObjectPoint {
    @builtin(position) position: vec4f,
    @location(0) relative: vec3f,
    @location(1) normal: vec3f,
}

@vertex
fn object_vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> ObjectPoint {
    let relative = position - view.eye.xyz;
    return ObjectPoint(view.clip_from_relative * vec4f(relative, 1.0), relative, normal);
}

@fragment
fn object_fragment(point: ObjectPoint) -> @location(0) vec4f {
    let incident = unit(point.relative);
    let normal = facing(incident, unit(point.normal));
    return vec4f(object_color(incident, normal, point.position.xy), 1.0);
}

// The unit normal. At the silhouette the interpolated one may turn away: there it is brought back across the ray, so that
// what lies straight behind is mirrored.
fn facing(incident: vec3f, normal: vec3f) -> vec3f {
    return unit(normal - incident * max(dot(incident, normal), 0.0));
}
