// Light to display: exposure, tone curve, sRGB. Twin of src/gpu/tone.rs, which writes the constants in capitals.

fn tone_map(light: vec3f, curve: u32) -> vec3f {
    let x = max(light, vec3f(0.0));
    switch curve {
        case TONE_REINHARD: {
            return x * (1.0 + x / (REINHARD_WHITE * REINHARD_WHITE)) / (1.0 + x);
        }
        case TONE_FILMIC: {
            // Beyond the white point the curve is 1. The fifth fourth power needs no `pow`, the dearest part of a pixel.
            let bounded = min(x, vec3f(FILMIC_WHITE));
            let power = bounded * sqrt(sqrt(bounded));
            return power / (power * FILMIC_SCALE + FILMIC_OFFSET);
        }
        default: { return x; }
    }
}

// IEC 61966-2-1, clipped to [0, 1].
fn srgb_from_linear(linear: vec3f) -> vec3f {
    let x = clamp(linear, vec3f(0.0), vec3f(1.0));
    return select(1.055 * pow(x, vec3f(1.0 / 2.4)) - 0.055, x * 12.92, x <= vec3f(0.0031308));
}

// `exposure` is a factor.
fn display_from_light(light: vec3f, exposure: f32, curve: u32) -> vec3f {
    return srgb_from_linear(tone_map(light * exposure, curve));
}
