// One mapping's charts, unfolded into one picture.

struct Panel {
    // The part of the picture that is shown: left, top, right, bottom; may reach beyond 0..1.
    window: vec4f,
    // Display values beside the charts; w is the exposure as a factor.
    background: vec4f,
    // Width and height of the target in pixels, the tone curve.
    screen: vec4f,
    // Above 0 when drawn: great circles, tint of the face, lines of equal u and v. No constants as in the viewport: a panel
    // is drawn seldom, and a dozen of them would have to be compiled at once.
    overlays: vec4f,
}

@group(0) @binding(0) var<uniform> panel: Panel;

// From this magnification on, in pixels a texel, texels begin to show their edges; at twice as much they are crisp.
const CRISP_FROM = 4.0;

// Moves a coordinate in texels towards the centre of its texel, so that only one pixel between two texels is blended.
fn crisped(texels: f32, magnification: f32) -> f32 {
    let amount = clamp(magnification / CRISP_FROM - 1.0, 0.0, 1.0);
    let sharpness = mix(1.0, max(magnification, 1.0), amount);
    let base = floor(texels - 0.5) + 0.5;
    return base + clamp((texels - base - 0.5) * sharpness + 0.5, 0.0, 1.0);
}

@fragment
fn panel_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let background = vec4f(panel.background.rgb, 1.0);
    let span = panel.window.zw - panel.window.xy;
    let grid = vec2f(MAP_GRID);
    let place = (panel.window.xy + span * at.xy / panel.screen.xy) * grid;
    if any(place < vec2f(0.0)) || any(place >= grid) {
        return background;
    }
    let cell = vec2u(place);
    let chart = map_chart(cell);
    if chart == NO_CHART {
        return background;
    }
    let uv = place - vec2f(cell);
    // Change of (u, v) over one pixel.
    let pixel = span * grid / panel.screen.xy;
    var cover = 1.0;
    if MAP_IS_DISC {
        let from_centre = length(uv - 0.5);
        cover = clamp(0.5 + (0.5 - from_centre) / max(pixel.x, 1e-9), 0.0, 1.0);
        if cover <= 0.0 {
            return background;
        }
    }

    let size = chart_size();
    let texels_per_pixel = abs(pixel) * size;
    let level = clamp(
        log2(max(max(texels_per_pixel.x, texels_per_pixel.y), 1e-9)),
        0.0,
        f32(MAP_LEVELS - 1u),
    );
    let texels = uv * size;
    let crisp = vec2f(
        crisped(texels.x, 1.0 / texels_per_pixel.x),
        crisped(texels.y, 1.0 / texels_per_pixel.y),
    ) / size;
    let light = map_light(ChartPoint(chart, crisp.x, crisp.y), size, level);
    var color = display_from_light(light, panel.background.w, u32(panel.screen.z));

    let dir = map_inverse(ChartPoint(chart, uv.x, uv.y));
    if panel.overlays.y > 0.0 {
        color = paint_face_tint(color, dir);
    }
    if panel.overlays.z > 0.0 {
        color = paint_grid(color, uv.x, uv.y, abs(pixel));
    }
    if panel.overlays.x > 0.0 {
        let right = map_inverse(ChartPoint(chart, uv.x + pixel.x, uv.y)) - dir;
        let down = map_inverse(ChartPoint(chart, uv.x, uv.y + pixel.y)) - dir;
        color = paint_great_circles(color, dir, right, down);
    }
    return vec4f(mix(background.rgb, color, cover), 1.0);
}
