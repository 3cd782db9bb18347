// Arctangent of t in radians, |t| <= 1, by fewer terms: its slope at 0 is fitted with the rest. The three *_series are
// written in front by src/gpu/forms.rs.
fn atan_unit(t: f32) -> f32 {
    return t * atan_series(t * t);
}
