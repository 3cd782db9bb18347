// Arctangent of t in radians, |t| <= 1, as near as f32. No built-in inverse trigonometric function is called: the language
// allows them 4096 ULP. The three *_series are written in front by src/gpu/forms.rs.
fn atan_unit(t: f32) -> f32 {
    let s = t * t;
    return t + t * s * atan_series(s);
}
