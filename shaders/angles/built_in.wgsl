// Angles by the language's own functions. It allows atan and atan2 4096 ULP, sin and cos 2^-11 within half a turn, and
// leaves the rest to the adapter.

// Arctangent of t in radians, |t| <= 1.
fn atan_unit(t: f32) -> f32 {
    return atan(t);
}

// Angle of the point (x, y) in radians, in [-pi, pi]; 0 at the origin and below the normal numbers, where nothing is said of
// atan2.
fn angle_of(y: f32, x: f32) -> f32 {
    if max(abs(x), abs(y)) < SMALLEST_NORMAL {
        return 0.0;
    }
    return atan2(y, x);
}

// (sin, cos) of an angle in turns, |turns| <= 2.
fn sin_cos_turns(turns: f32) -> vec2f {
    let angle = turns * (2.0 * PI);
    return vec2f(sin(angle), cos(angle));
}

fn tan_turns(turns: f32) -> f32 {
    return tan(turns * (2.0 * PI));
}
