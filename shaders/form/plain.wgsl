// What is seen of a direction: its light.
fn form_shown(color: vec3f, dir: vec3f, p: ChartPoint) -> vec3f {
    return color;
}
