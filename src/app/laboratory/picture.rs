//! Where the used evaluator errs, as a picture.

use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};

use crate::app::follower::Follower;
use crate::app::theme::{self, PICTURE_BACKGROUND};
use crate::imaging::Progress;
use crate::lab::error_map::{ErrorMap, Pixel, error_map};
use crate::mapping::MappingId;

/// What a picture shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// The mapping, whose own picture is painted.
    pub map: MappingId,
    /// Its evaluator.
    pub evaluator: &'static str,
    /// Texels along a chart's height.
    pub rows: u32,
    /// Columns and rows of the picture.
    pub size: [usize; 2],
}

impl Wanted {
    /// Finds the errors and paints them; nothing when cancelled.
    pub fn make(&self, ctx: &Context, progress: &Progress) -> Option<ShownErrors> {
        let evaluator = self.map.processor(self.evaluator)?;
        let errors = error_map(
            self.map, evaluator, self.rows, self.map, self.size, progress,
        )?;
        let picture = ctx.load_texture("errors", image(&errors), TextureOptions::NEAREST);
        Some(ShownErrors { errors, picture })
    }
}

/// The errors and their picture.
pub struct ShownErrors {
    /// The errors.
    pub errors: ErrorMap,
    /// Their picture.
    pub picture: TextureHandle,
}

/// The last picture, and the job that makes the next one.
pub type ErrorPicture = Follower<Wanted, ShownErrors>;

/// Errors in the scale's colours, from 0 to the largest.
fn image(errors: &ErrorMap) -> ColorImage {
    let [r, g, b] = PICTURE_BACKGROUND;
    let color = |pixel: &Pixel| match pixel {
        Pixel::Outside => Color32::from_rgb(r, g, b),
        Pixel::Hole => theme::HOLE,
        Pixel::Error(rad) => theme::scale((f64::from(*rad) / errors.max_rad) as f32),
    };
    ColorImage::new(errors.size, errors.pixels.iter().map(color).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_error_has_the_scales_end_and_a_hole_its_own_colour() {
        let errors = ErrorMap {
            size: [4, 1],
            pixels: vec![
                Pixel::Error(0.0),
                Pixel::Error(2e-5),
                Pixel::Hole,
                Pixel::Outside,
            ],
            max_rad: f64::from(2e-5_f32),
            max_texels: 0.1,
            worst: [0.0, 0.0, 1.0],
            holes: 1,
        };
        let [r, g, b] = PICTURE_BACKGROUND;
        let colours = [
            theme::scale(0.0),
            theme::scale(1.0),
            theme::HOLE,
            Color32::from_rgb(r, g, b),
        ];
        assert_eq!(image(&errors).pixels, colours);
        for (k, colour) in colours.iter().enumerate() {
            assert!(!colours[..k].contains(colour), "control: {colour:?}");
        }
    }
}
