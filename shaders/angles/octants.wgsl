// Every angle from those of an eighth of a turn: `atan_unit` and `sin_cos_quarter` stand in front.

// Angle of the point (x, y) in radians, in [-pi, pi]; 0 at the origin and below the normal numbers.
fn angle_of(y: f32, x: f32) -> f32 {
    let ay = abs(y);
    let ax = abs(x);
    let large = max(ax, ay);
    if large < SMALLEST_NORMAL {
        return 0.0;
    }
    var angle = atan_unit(min(min(ax, ay) / large, 1.0));
    if ay > ax {
        angle = FRAC_PI_2 - angle;
    }
    if x < 0.0 {
        angle = PI - angle;
    }
    return select(angle, -angle, y < 0.0);
}

// (sin, cos) of an angle in turns, |turns| <= 2.
fn sin_cos_turns(turns: f32) -> vec2f {
    let quarters = round(turns * 4.0);
    let angle = sin_cos_quarter(turns * 4.0 - quarters);
    switch i32(quarters) & 3 {
        case 1: { return vec2f(angle.y, -angle.x); }
        case 2: { return -angle; }
        case 3: { return vec2f(-angle.y, angle.x); }
        default: { return angle; }
    }
}

fn tan_turns(turns: f32) -> f32 {
    let angle = sin_cos_turns(turns);
    return angle.x / angle.y;
}
