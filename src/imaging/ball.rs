//! Pictures of a lit ball, looked up by the normal as the viewer sees it: sphere-map styles.
//!
//! The ball fills the square: the texel at (u, v) shows the normal (2u - 1, 1 - 2v, z) with z towards the viewer (the simple
//! sphere map of the cubemap article). Values are display values, sRGB.

use std::path::Path;

use super::load::{self, LoadError};
use super::srgb::srgb8_from_linear;
use super::{Image, Progress};

/// Width and height of the computed pictures: a body of 512 pixels shows each texel once.
pub const SIZE: u32 = 512;

/// A computed style.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Soft light and a dark rim.
    Outline,
    /// Three flat tones and a dark rim.
    Toon,
    /// Soft boxes at both sides and above, mirrored in black lacquer.
    Studio,
}

/// A picture of display values, RGBA, row 0 at the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BallPixels {
    /// Width and height.
    pub size: [u32; 2],
    /// Four bytes a pixel.
    pub rgba: Vec<u8>,
}

impl Style {
    /// Computes the picture.
    #[must_use]
    pub fn pixels(self) -> BallPixels {
        let mut rgba = Vec::with_capacity((SIZE * SIZE * 4) as usize);
        for j in 0..SIZE {
            for i in 0..SIZE {
                let place = |k: u32| (2.0 * k as f32 + 1.0) / SIZE as f32 - 1.0;
                let (x, y) = (place(i), -place(j));
                // Beyond the rim the rim goes on, so that a filter at the rim meets nothing else.
                let radius = x.hypot(y).max(1.0);
                let (x, y) = (x / radius, y / radius);
                let z = (1.0 - x * x - y * y).max(0.0).sqrt();
                let [r, g, b] = self.shade([x, y, z]).map(byte);
                rgba.extend([r, g, b, 255]);
            }
        }
        BallPixels {
            size: [SIZE; 2],
            rgba,
        }
    }

    /// Display colour of a normal.
    fn shade(self, normal: [f32; 3]) -> [f32; 3] {
        // From above left, before the object.
        const LIGHT: [f32; 3] = [-0.48, 0.64, 0.6];
        let lit = dot(normal, LIGHT).max(0.0);
        let [x, y, z] = normal;
        match self {
            Self::Outline => {
                let tone = 0.55 + 0.42 * lit;
                [tone, tone, tone * 0.97].map(|c| c * rim(z, 0.30))
            }
            Self::Toon => {
                let step = |from: f32| smooth(lit, from - 0.01, from + 0.01);
                let tone = 0.42 + 0.28 * step(0.25) + 0.27 * step(0.75);
                [tone, 0.72 * tone, 0.35 * tone].map(|c| c * rim(z, 0.26))
            }
            Self::Studio => {
                // Where the mirrored ray goes; the viewer looks along -z.
                let mirrored = [2.0 * z * x, 2.0 * z * y, 2.0 * z * z - 1.0];
                let floor = 0.10 + 0.16 * smooth(-mirrored[1], -0.2, 1.0);
                let key = soft_box(mirrored, [-0.75, 0.45], [0.28, 0.42]);
                let fill = 0.55 * soft_box(mirrored, [0.85, 0.2], [0.12, 0.55]);
                let top = 0.8
                    * soft_box(
                        [mirrored[0], mirrored[2], mirrored[1]],
                        [0.0, -0.1],
                        [0.5, 0.2],
                    );
                let edge = 0.35 * (1.0 - z).powi(4);
                let tone = (floor + key + fill + top + edge).min(1.0);
                [tone, tone, (tone * 1.03).min(1.0)]
            }
        }
    }
}

/// Light of a box that stands in front of the ball, seen in the direction `dir`: its middle and half size on the plane
/// z = 1, with edges that fade.
fn soft_box(dir: [f32; 3], middle: [f32; 2], half: [f32; 2]) -> f32 {
    const FADE: f32 = 0.05;
    if dir[2] < 0.1 {
        return 0.0;
    }
    let edge = |i: usize| {
        let away = (dir[i] / dir[2].max(0.3) - middle[i]).abs();
        1.0 - smooth(away, half[i] - FADE, half[i] + FADE)
    };
    edge(0) * edge(1)
}

/// 1 inside the ball, 0 at its rim, where the height over the rim is below `from`.
fn rim(z: f32, from: f32) -> f32 {
    smooth(z, from - 0.04, from + 0.04)
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// 0 below `low`, 1 above `high`, smooth between.
fn smooth(x: f32, low: f32, high: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn byte(display: f32) -> u8 {
    (display.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// Opens a square picture of a ball: HDR, EXR, PNG or JPEG.
///
/// # Errors
/// As [`load::load`]; the picture must be square.
pub fn open(path: &Path, progress: &Progress) -> Result<BallPixels, LoadError> {
    let loaded = load::load_ball(path, progress)?;
    Ok(from_image(&loaded.image))
}

fn from_image(image: &Image) -> BallPixels {
    let texel = |light: &[f32; 3]| {
        let [r, g, b] = srgb8_from_linear(*light);
        [r, g, b, 255]
    };
    BallPixels {
        size: [image.width(), image.height()],
        rgba: image.pixels().iter().flat_map(texel).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(pixels: &BallPixels, x: f32, y: f32) -> [u8; 3] {
        let place = |c: f32| (((c + 1.0) * 0.5 * SIZE as f32) as u32).min(SIZE - 1);
        let index = ((place(-y) * SIZE + place(x)) * 4) as usize;
        [
            pixels.rgba[index],
            pixels.rgba[index + 1],
            pixels.rgba[index + 2],
        ]
    }

    #[test]
    fn an_outline_is_dark_at_the_rim_and_bright_within() {
        for style in [Style::Outline, Style::Toon] {
            let pixels = style.pixels();
            assert!(at(&pixels, 0.0, 0.0)[0] > 100, "{style:?}");
            for (x, y) in [(0.99, 0.0), (0.0, -0.99), (-0.7, 0.7)] {
                assert!(at(&pixels, x, y)[0] < 12, "{style:?} at {x}, {y}");
            }
        }
        // Control: the studio's rim is lit.
        assert!(at(&Style::Studio.pixels(), 0.99, 0.0)[0] > 60);
    }

    #[test]
    fn toon_has_three_tones() {
        let part_of_flat = |style: Style| {
            let pixels = style.pixels();
            let place = |i: i32| f32::from(i as i16) / 100.0;
            let places = (-80..80).flat_map(|i| (-40..40).map(move |j| (place(i), place(j))));
            let reds: Vec<u8> = places.map(|(x, y)| at(&pixels, x, y)[0]).collect();
            // 0.42, 0.70 and 0.97 of 255.
            let flat = |red: &&u8| [107_u8, 179, 247].iter().any(|t| t.abs_diff(**red) < 2);
            reds.iter().filter(flat).count() as f64 / reds.len() as f64
        };
        assert!(part_of_flat(Style::Toon) > 0.9);
        assert!(part_of_flat(Style::Outline) < 0.2, "control");
    }
}
