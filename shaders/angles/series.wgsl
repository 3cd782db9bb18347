// (sin, cos) of f quarter turns, |f| <= 1/2.
fn sin_cos_quarter(f: f32) -> vec2f {
    let s = f * f;
    return vec2f(f + f * sin_quarter_series(s), 1.0 + s * cos_quarter_series(s));
}
