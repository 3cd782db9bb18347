//! Units in the last place of f32.

/// Distance between two floats in steps of the f32 grid; `u32::MAX` when either is NaN. +0 and -0 coincide.
pub fn ulp_distance(a: f32, b: f32) -> u32 {
    if a.is_nan() || b.is_nan() {
        return u32::MAX;
    }
    grid_index(a)
        .abs_diff(grid_index(b))
        .try_into()
        .unwrap_or(u32::MAX)
}

/// The float `steps` grid steps above (or below) `x`; stops at the infinities. NaN stays NaN.
pub fn step_ulps(x: f32, steps: i32) -> f32 {
    if x.is_nan() {
        return x;
    }
    let limit = grid_index(f32::INFINITY);
    let index = (grid_index(x) + i64::from(steps)).clamp(-limit, limit);
    let magnitude = f32::from_bits(u32::try_from(index.unsigned_abs()).unwrap_or(0));
    if index < 0 { -magnitude } else { magnitude }
}

/// Size of one ULP at `x`: the gap between |x| and the next larger float.
pub fn ulp_f32(x: f32) -> f32 {
    x.abs().next_up() - x.abs()
}

/// Position of a float on the grid of all floats; 0 for both zeros.
fn grid_index(x: f32) -> i64 {
    let magnitude = i64::from(x.abs().to_bits());
    if x.is_sign_negative() {
        -magnitude
    } else {
        magnitude
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_step_apart() {
        for x in [0.0, -0.0, 1.0, -1.0, f32::MIN_POSITIVE, 1e-45, 3.5e37] {
            assert_eq!(ulp_distance(x, x.next_up()), 1);
            assert_eq!(step_ulps(x, 1), x.next_up());
            assert_eq!(step_ulps(step_ulps(x, 7), -7), x);
            assert_ne!(ulp_distance(x, step_ulps(x, 2)), 1);
        }
        assert_eq!(ulp_distance(0.0, -0.0), 0);
        assert_eq!(ulp_distance(-1e-45, 1e-45), 2);
        assert_eq!(ulp_distance(f32::NAN, 1.0), u32::MAX);
        assert_eq!(ulp_f32(1.0), f32::EPSILON);
        assert_eq!(step_ulps(f32::MAX, 9), f32::INFINITY);
    }
}
