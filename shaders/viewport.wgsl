// The mirror object before its environment, both looked up in one mapping's map.

struct View {
    // From a point relative to the eye, in world axes: the eye's own place is subtracted before any matrix.
    clip_from_relative: mat4x4f,
    // The eye; w is the exposure as a factor.
    eye: vec4f,
    // The ray frame: unit direction ahead, and from the middle to the right and upper border of the screen. In w: the
    // tone curve, the width and the height of the target in pixels.
    forward: vec4f,
    right: vec4f,
    up: vec4f,
    // The probe's unit direction.
    probe: vec4f,
}

@group(0) @binding(0) var<uniform> view: View;

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

// `right` and `down`: the change of the unit direction over one pixel.
fn seen(dir: vec3f, right: vec3f, down: vec3f) -> vec4f {
    let p = map_forward(dir);
    if p.chart == NO_CHART {
        return vec4f(0.0, 0.0, 0.0, 1.0);
    }
    let size = chart_size();
    var tangents: Tangents;
    if NEEDS_LEVEL || SHOW_GRID {
        tangents = chart_tangents(p, dir, size);
    }
    var level = 0.0;
    if NEEDS_LEVEL {
        level = map_level(footprint_rad(right, down), tangents);
    }
    let light = map_light(p, size, level);
    var color = display_from_light(light, view.eye.w, u32(view.forward.w));
    if SHOW_FACE_TINT {
        color = paint_face_tint(color, dir);
    }
    if SHOW_GRID {
        let change = mat2x2f(
            coordinates_in(tangents.right, tangents.down, right),
            coordinates_in(tangents.right, tangents.down, down),
        );
        let u_change = length(vec2f(change[0].x, change[1].x)) / size.x;
        let v_change = length(vec2f(change[0].y, change[1].y)) / size.y;
        color = paint_grid(color, p.u, p.v, vec2f(u_change, v_change));
    }
    if SHOW_GREAT_CIRCLES {
        color = paint_great_circles(color, dir, right, down);
    }
    if SHOW_PROBE {
        color = paint_probe(color, view.probe.xyz, dir, right, down);
    }
    return vec4f(color, 1.0);
}

@fragment
fn sky_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let target_size = vec2f(view.right.w, view.up.w);
    let ndc = vec2f(2.0, -2.0) * at.xy / target_size + vec2f(-1.0, 1.0);
    let ray = view.forward.xyz + ndc.x * view.right.xyz + ndc.y * view.up.xyz;
    let scale = 1.0 / length_of(ray);
    let dir = ray * scale;
    // The derivative of ray/|ray| in closed form.
    let right = view.right.xyz * (2.0 / target_size.x);
    let down = view.up.xyz * (-2.0 / target_size.y);
    return seen(
        dir,
        (right - dir * dot(dir, right)) * scale,
        (down - dir * dot(dir, down)) * scale,
    );
}

@fragment
fn object_fragment(point: ObjectPoint) -> @location(0) vec4f {
    let incident = unit(point.relative);
    let normal = unit(point.normal);
    // At the silhouette the interpolated normal may turn away; it then mirrors what lies straight behind.
    let facing = min(dot(incident, normal), 0.0);
    let dir = incident - 2.0 * facing * normal;
    return seen(dir, dpdx(dir), dpdy(dir));
}
