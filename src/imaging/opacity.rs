//! Colours and their opacity on the way from a file to a file. OpenEXR alone stores colours multiplied by their opacity;
//! in every other format, and wherever texels are mixed, they stand by themselves.

use std::borrow::Cow;

use super::load::Format;
use super::resample::{Conversion, Plan};
use super::{Channels, EnvironmentMap, MapShape, Raster, Samples};

/// What is done to the colours before and after a conversion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OpacityWay {
    divides: bool,
    multiplies: bool,
}

impl OpacityWay {
    /// The way of a conversion of a map of shape `source`. Between two files of OpenEXR nothing is done where every texel
    /// stays where it is: each keeps its bits.
    pub fn new(
        (from, source): (Format, &MapShape),
        to: Format,
        conversion: &Conversion,
        plan: &Plan,
    ) -> Self {
        let unturned = Conversion::new(conversion.mapping, conversion.size, source).rotation;
        let stays = plan.target() == source && conversion.rotation == unturned;
        let keeps = from == to && stays;
        Self {
            divides: from == Format::Exr && !keeps,
            multiplies: to == Format::Exr && !keeps,
        }
    }

    /// The map with colours that stand by themselves: itself where they do already.
    pub fn straight<'a>(&self, map: &'a EnvironmentMap) -> Cow<'a, EnvironmentMap> {
        let is_affected = self.divides && map.rasters().iter().any(has_partial);
        if !is_affected {
            return Cow::Borrowed(map);
        }
        let mut straight = map.clone();
        for raster in straight.rasters_mut() {
            change(raster, |colour, opacity| colour / opacity);
        }
        Cow::Owned(straight)
    }

    /// Makes the colours of a result what its file stores.
    pub fn finish(&self, map: &mut EnvironmentMap) {
        if self.multiplies && map.rasters().iter().any(has_partial) {
            for raster in map.rasters_mut() {
                change(raster, |colour, opacity| colour * opacity);
            }
        }
    }
}

/// Where there is none, colour is light that hides nothing, which only the product can say: it stays as it is.
fn is_partial(opacity: f32) -> bool {
    opacity > 0.0 && opacity < 1.0
}

fn pixels(raster: &Raster) -> &[[f32; 4]] {
    match (raster.channels(), raster.samples()) {
        (Channels::Rgba, Samples::F32(samples)) => samples.as_chunks::<4>().0,
        _ => &[],
    }
}

fn has_partial(raster: &Raster) -> bool {
    pixels(raster).iter().any(|pixel| is_partial(pixel[3]))
}

fn change(raster: &mut Raster, with_opacity: impl Fn(f32, f32) -> f32) {
    let (Channels::Rgba, Samples::F32(samples)) = (raster.channels(), raster.samples_mut()) else {
        return;
    };
    for [colour @ .., opacity] in samples.as_chunks_mut::<4>().0 {
        if is_partial(*opacity) {
            for value in colour {
                *value = with_opacity(*value, *opacity);
            }
        }
    }
}
