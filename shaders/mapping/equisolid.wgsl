// Equisolid discs: twin of src/mapping/equisolid.rs.

fn equisolid_forward(dir: vec3f) -> ChartPoint {
    if !is_direction(dir) {
        return no_chart();
    }
    let d = scaled_direction(dir);
    let back = is_below_zero(dir.z);
    let n = length_of(d);
    let twice = 2.0 * sqrt(n * (n + abs(d.z)));
    let x = select(d.x, -d.x, back);
    return chart_point(select(0u, 1u, back), 0.5 + x / twice, 0.5 - d.y / twice);
}

// Beyond the rim: into the other half, as far from the rim as the point is.
fn equisolid_inverse(p: ChartPoint) -> vec3f {
    let disc = over_rim(p);
    let square = dot(disc.place, disc.place);
    let scale = sqrt(max(2.0 - square, 0.0));
    let side = select(-1.0, 1.0, disc.chart == 0u);
    return vec3f(side * disc.place.x * scale, disc.place.y * scale, side * (1.0 - square));
}
