// What object and sky share: the view, and one lookup in the mapping's map with what is painted over it.

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
    // The probe's unit direction; w: by what differences of forms, in texels, are multiplied.
    probe: vec4f,
}

@group(0) @binding(0) var<uniform> view: View;

// What a direction found in the map.
struct Found {
    point: ChartPoint,
    tangents: Tangents,
    level: f32,
    // Linear.
    light: vec3f,
}

// `right` and `down`: the change of the unit direction over one pixel.
fn look_up(dir: vec3f, right: vec3f, down: vec3f) -> Found {
    var found = located(dir, right, down);
    if found.point.chart != NO_CHART {
        found.light = light_of(dir, found.point, found.level);
    }
    return found;
}

// The place of a lookup and its level, without the light.
fn located(dir: vec3f, right: vec3f, down: vec3f) -> Found {
    var found: Found;
    found.point = map_forward(dir);
    if found.point.chart == NO_CHART {
        return found;
    }
    if NEEDS_LEVEL || SHOW_GRID {
        found.tangents = chart_tangents(found.point, dir, chart_size());
    }
    if NEEDS_LEVEL {
        found.level = map_level(footprint_rad(right, down), found.tangents);
    }
    return found;
}

// A lookup beside another one, which has worked out the level for both.
fn look_up_beside(dir: vec3f, level: f32) -> vec3f {
    let p = map_forward(dir);
    if p.chart == NO_CHART {
        return vec3f(0.0);
    }
    return light_of(dir, p, level);
}

fn display(light: vec3f) -> vec3f {
    return display_from_light(light, view.eye.w, u32(view.forward.w));
}

// The overlays of a direction over a display value.
fn painted(under: vec3f, found: Found, dir: vec3f, right: vec3f, down: vec3f) -> vec3f {
    var color = under;
    if found.point.chart == NO_CHART {
        return color;
    }
    if SHOW_FACE_TINT {
        color = paint_face_tint(color, dir);
    }
    if SHOW_GRID {
        let size = chart_size();
        let change = mat2x2f(
            coordinates_in(found.tangents.right, found.tangents.down, right),
            coordinates_in(found.tangents.right, found.tangents.down, down),
        );
        let u_change = length(vec2f(change[0].x, change[1].x)) / size.x;
        let v_change = length(vec2f(change[0].y, change[1].y)) / size.y;
        color = paint_grid(color, found.point.u, found.point.v, vec2f(u_change, v_change));
    }
    if SHOW_GREAT_CIRCLES {
        color = paint_great_circles(color, dir, right, down);
    }
    if SHOW_PROBE {
        color = paint_probe(color, view.probe.xyz, dir, right, down);
    }
    return color;
}

// The display value of one direction, overlays included.
fn seen(dir: vec3f, right: vec3f, down: vec3f) -> vec3f {
    let found = look_up(dir, right, down);
    if found.point.chart == NO_CHART {
        return vec3f(0.0);
    }
    let shown = form_shown(display(found.light), dir, found.point);
    return painted(shown, found, dir, right, down);
}
