// The map's light in a direction: at its chart point.
fn light_of(dir: vec3f, p: ChartPoint, level: f32) -> vec3f {
    return map_light(p, chart_size(), level);
}
