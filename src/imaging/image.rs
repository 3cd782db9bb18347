//! A picture in linear light.

use thiserror::Error;

/// RGB in linear light (the primaries of sRGB), row 0 at the top, rows one after another.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

/// The number of texels does not fit the size.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error(
    "a picture of {width} x {height} needs {width} x {height} texels and at least one, but got {texels}; give as many as the size says"
)]
pub struct ImageSizeError {
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Texels that were given.
    pub texels: usize,
}

impl Image {
    /// A picture from its texels.
    ///
    /// # Errors
    /// When `pixels` is empty or not `width * height` long.
    pub fn new(width: u32, height: u32, pixels: Vec<[f32; 3]>) -> Result<Self, ImageSizeError> {
        if pixels.is_empty() || pixels.len() as u64 != u64::from(width) * u64::from(height) {
            let texels = pixels.len();
            return Err(ImageSizeError {
                width,
                height,
                texels,
            });
        }
        Ok(Self {
            width,
            height,
            pixels,
        })
    }

    /// Texels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All texels, row after row from the top.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// All texels, without the picture.
    pub fn into_pixels(self) -> Vec<[f32; 3]> {
        self.pixels
    }

    /// All texels, to change in place.
    pub fn pixels_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.pixels
    }

    /// Position of texel (x, y) in [`Image::pixels`], or `None` outside of the picture.
    pub fn index(&self, x: u32, y: u32) -> Option<usize> {
        (x < self.width && y < self.height).then_some(y as usize * self.width as usize + x as usize)
    }

    /// Texel (x, y), or `None` outside of the picture.
    pub fn texel(&self, x: u32, y: u32) -> Option<[f32; 3]> {
        self.index(x, y).map(|index| self.pixels[index])
    }

    /// The texel (x, y) that contains (u, v), each in [0, 1]; values outside fall on the border.
    pub fn texel_at(&self, u: f64, v: f64) -> (u32, u32) {
        // `as` saturates and turns NaN into 0: every input names a texel.
        let x = (u * f64::from(self.width)) as u32;
        let y = (v * f64::from(self.height)) as u32;
        (x.min(self.width - 1), y.min(self.height - 1))
    }

    /// Colour of the texel that contains (u, v).
    pub fn nearest(&self, u: f64, v: f64) -> [f32; 3] {
        let (x, y) = self.texel_at(u, v);
        self.pixels[y as usize * self.width as usize + x as usize]
    }
}
