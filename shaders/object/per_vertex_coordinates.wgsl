// A mirror whose chart, u and v are computed at each vertex; u and v are interpolated, as the automatic generation of
// coordinates did. The chart is that of the triangle's first
// vertex (on GL of its last): where the others lie on another, the picture is wrong, and marked.

struct ObjectPoint {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
    @location(1) relative: vec3f,
    @location(2) normal: vec3f,
    @location(3) @interpolate(flat, either) chart: u32,
}

@vertex
fn object_vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> ObjectPoint {
    let relative = position - view.eye.xyz;
    let p = map_forward(reflected_dir(unit(relative), normal));
    return ObjectPoint(
        view.clip_from_relative * vec4f(relative, 1.0),
        vec2f(p.u, p.v),
        relative,
        normal,
        p.chart,
    );
}

// Errors of more than this, in radians, are marked: no smooth map bends so much within a triangle of the coarsest body,
// whose edges span a quarter turn, unless a border runs through it.
const MARKED_FROM_RAD = 0.35;

@fragment
fn object_fragment(point: ObjectPoint) -> @location(0) vec4f {
    let right = dpdx(point.uv);
    let down = dpdy(point.uv);
    let size = chart_size();
    let texels = max(length(right * size), length(down * size));
    let level = clamp(log2(max(texels, 1e-9)), 0.0, f32(MAP_LEVELS - 1u));
    var color = vec3f(0.0);
    if point.chart != NO_CHART {
        color = display(map_light(ChartPoint(point.chart, point.uv.x, point.uv.y), size, level));
    }
    let exact = reflected_dir(unit(point.relative), unit(point.normal));
    let here = map_forward(exact);
    let drawn = map_inverse(ChartPoint(point.chart, point.uv.x, point.uv.y));
    let is_far = length(drawn - exact) > MARKED_FROM_RAD;
    let is_wrong = MAP_COVERS_SPHERE && (is_far || here.chart != point.chart);
    return vec4f(select(color, marked(color, FAULT_COLOR, point.position.xy), is_wrong), 1.0);
}
