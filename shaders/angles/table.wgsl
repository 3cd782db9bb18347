// Angles from a table in a texture: rows of the arctangent of t, and of sine and cosine of t/2 quarter turns, in equal steps
// of t from 0 to 1.
//
// Entries are loaded, and what lies between them is computed here. The filtering unit would do both in one step, but it
// weighs with 8 bits (Vulkan asks for 4 at least): 256 values between two entries, which with 256 steps is off by 7.6e-6 rad,
// six times the error of the lines themselves. Besides, not every adapter filters full floats.

@group(2) @binding(0) var angle_table: texture_2d<f32>;

fn look_up_angle(row: u32, t: f32) -> f32 {
    let place = abs(t) * TABLE_STEPS;
    let before = min(floor(place), TABLE_STEPS - 1.0);
    let at = vec2u(u32(before), row);
    let a = textureLoad(angle_table, at, 0).x;
    let b = textureLoad(angle_table, at + vec2u(1u, 0u), 0).x;
    return a + (b - a) * (place - before);
}

// Arctangent of t in radians, |t| <= 1.
fn atan_unit(t: f32) -> f32 {
    return sign_or_one(t) * look_up_angle(0u, t);
}

// (sin, cos) of f quarter turns, |f| <= 1/2.
fn sin_cos_quarter(f: f32) -> vec2f {
    let t = 2.0 * f;
    return vec2f(sign_or_one(f) * look_up_angle(1u, t), look_up_angle(2u, t));
}
