// What is painted over the environment: functions of the direction, so the mirror shows them too.
//
// Lines keep their width in pixels: a distance is divided by its change over one pixel.

// Paint of the opacity `alpha` over `under`; both display values.
fn paint(under: vec3f, paint_color: vec3f, alpha: f32) -> vec3f {
    return mix(under, paint_color, clamp(alpha, 0.0, 1.0));
}

// Coverage of a line at `distance_px` from its middle.
fn line_cover(distance_px: f32, half_width_px: f32) -> f32 {
    return clamp(half_width_px + 0.5 - distance_px, 0.0, 1.0);
}

fn paint_face_tint(under: vec3f, dir: vec3f) -> vec3f {
    return paint(under, face_color(sign_table(dir)), 0.38);
}

// `right` and `down` are the change of the unit direction over one pixel. The six calls stand in src/gpu/overlay.rs, which
// knows normals and colours.
fn paint_great_circle(
    under: vec3f,
    paint_color: vec3f,
    normal: vec3f,
    dir: vec3f,
    right: vec3f,
    down: vec3f,
) -> vec3f {
    let change = length(vec2f(dot(normal, right), dot(normal, down)));
    let distance_px = abs(dot(normal, dir)) / max(change, 1e-9);
    // Where a pixel sees a large part of the circle, a line would be a blot.
    let fade = clamp(2.0 - 8.0 * change, 0.0, 1.0);
    let dark = paint(under, vec3f(0.05), 0.5 * fade * line_cover(distance_px, 2.0));
    return paint(dark, paint_color, fade * line_cover(distance_px, 1.0));
}

// Lines of equal u and v at every eighth; `change` is the length of the change of u and of v over one pixel.
fn paint_grid(under: vec3f, u: f32, v: f32, change: vec2f) -> vec3f {
    let eighths = vec2f(u, v) * 8.0;
    let distance = abs(eighths - round(eighths)) / 8.0;
    let distance_px = distance / max(change, vec2f(1e-9));
    // Lines closer than some pixels fade before they merge.
    let fade = clamp(vec2f(1.5) - change * 64.0, vec2f(0.0), vec2f(1.0));
    let cover = max(
        line_cover(distance_px.x, 0.25) * fade.x,
        line_cover(distance_px.y, 0.25) * fade.y,
    );
    let dark = dot(under, vec3f(0.2126, 0.7152, 0.0722)) < 0.55;
    return paint(under, select(vec3f(0.0), vec3f(1.0), dark), 0.6 * cover);
}

// A ring of 7 pixels around the probe, white between dark lines.
fn paint_probe(under: vec3f, probe: vec3f, dir: vec3f, right: vec3f, down: vec3f) -> vec3f {
    let offset = probe - dir;
    if dot(offset, offset) > 0.25 || footprint_rad(right, down) > 0.05 {
        return under;
    }
    let pixels = coordinates_in(right, down, offset);
    // Parallel tangents give no place in pixels.
    if all(pixels == vec2f(0.0)) && dot(offset, offset) > 0.0 {
        return under;
    }
    let radius_px = length(pixels);
    let dark = paint(under, vec3f(0.05), 0.8 * line_cover(abs(radius_px - 7.0), 2.0));
    let ring = paint(dark, vec3f(1.0), line_cover(abs(radius_px - 7.0), 1.0));
    return paint(ring, vec3f(1.0), line_cover(radius_px, 0.8));
}
