//! The sRGB transfer function (IEC 61966-2-1).

use std::sync::LazyLock;

/// Linear light in [0, 1] from an sRGB value in [0, 1].
pub fn linear_from_srgb(c: f32) -> f32 {
    if c <= 0.04045 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    }
}

/// An sRGB value in [0, 1] from linear light; values outside of [0, 1] and NaN fall on the border.
pub fn srgb_from_linear(c: f32) -> f32 {
    let c = if c.is_nan() { 0.0 } else { c.clamp(0.0, 1.0) };
    if c <= 0.003_130_8 {
        c * 12.92
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    }
}

/// Linear light from an sRGB colour of three bytes.
pub fn linear_from_srgb8(rgb: [u8; 3]) -> [f32; 3] {
    rgb.map(|c| FROM_8[usize::from(c)])
}

/// Three bytes of sRGB from linear light, rounded to nearest, clipped.
pub fn srgb8_from_linear(rgb: [f32; 3]) -> [u8; 3] {
    rgb.map(|c| (srgb_from_linear(c) * 255.0 + 0.5) as u8)
}

/// Linear light for each 8-bit sRGB value.
pub(crate) static FROM_8: LazyLock<Vec<f32>> = LazyLock::new(|| table(255));

/// Linear light for each 16-bit sRGB value (256 KiB, made when the first such picture opens).
pub(crate) static FROM_16: LazyLock<Vec<f32>> = LazyLock::new(|| table(65535));

fn table(last: u32) -> Vec<f32> {
    (0..=last)
        .map(|c| linear_from_srgb(c as f32 / last as f32))
        .collect()
}
