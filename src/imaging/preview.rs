//! Small pictures of a map, to see which way round it is.

use super::resample::{Conversion, Filter, ResampleError, equal_height, resample};
use super::{
    Channels, Environment, EnvironmentMap, LoadError, LoadProblem, Progress, Raster, SampleKind,
    Samples, Transfer,
};
use crate::mapping::{Layout, MappingId};

/// A map as one sees it: pictures of 8 bits in codes of sRGB.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    /// The six faces of the world around the viewer, seen from inside, as [`Layout::Cross`].
    pub cross: Raster,
    /// A mirroring ball before a viewer who looks ahead: the sphere map.
    pub ball: Raster,
}

/// Texels along a side of a face of the cross: names are read, and there is little to compute.
const FACE: u32 = 96;
/// Texels along a side of the ball's picture.
const BALL: u32 = 192;
/// Most places along a side of a texel: with the two texels that each is mixed from, a panorama of 3072 texels around is seen
/// whole, and of a larger one a part that is large enough.
const MOST_PLACES: u32 = 4;
/// Rows of the labelled environment: two of its texels along one of the cross.
const LABELLED_ROWS: u32 = 4 * FACE;

impl Preview {
    /// The pictures of a map. Floats are exposed so that their middle is a middle grey.
    ///
    /// # Errors
    /// When the job is cancelled or there is no memory.
    pub fn of(map: &EnvironmentMap, progress: &Progress) -> Result<Self, ResampleError> {
        Self::exposed(map, exposure(map.rasters()), progress)
    }

    fn exposed(
        map: &EnvironmentMap,
        exposure_ev: f64,
        progress: &Progress,
    ) -> Result<Self, ResampleError> {
        let texels = equal_height(MappingId::Cube, map.shape()).div_ceil(FACE);
        let supersample = texels.clamp(1, MOST_PLACES);
        let picture = |mapping, side, layout| {
            let conversion = Conversion {
                layout,
                filter: Some(Filter::Bilinear),
                supersample,
                exposure_ev,
                samples: SampleKind::U8,
                transfer: Transfer::Srgb,
                channels: Channels::Rgb,
                ..Conversion::new(mapping, [side; 2], map.shape())
            };
            let (_, rasters) = resample(map, &conversion, progress)?.0.into_parts();
            rasters.into_iter().next().ok_or(ResampleError::Cancelled)
        };
        Ok(Self {
            cross: picture(MappingId::Cube, FACE, Layout::Cross)?,
            ball: picture(MappingId::Sphere, BALL, Layout::Single)?,
        })
    }

    /// The pictures of the labelled environment, which is the right way round.
    ///
    /// # Errors
    /// As [`Preview::of`].
    pub fn labelled(progress: &Progress) -> Result<Self, LoadError> {
        let environment = Environment::LabelledFaces;
        let image = environment.image_at(LABELLED_ROWS, progress)?.image;
        let failed = |text: String| LoadError {
            problem: LoadProblem::Unclear(text),
            name: environment.id(),
        };
        let map = EnvironmentMap::from_latlong(image).map_err(|error| failed(error.to_string()))?;
        Self::exposed(&map, 0.0, progress).map_err(|error| failed(error.to_string()))
    }
}

/// Stops that bring the middle of the light to a middle grey. Codes are meant to be seen as they are.
fn exposure(rasters: &[Raster]) -> f64 {
    /// So many texels of each picture tell enough.
    const ASKED: u64 = 4096;
    const GREY: f64 = 0.18;
    let (mut sum, mut count) = (0.0, 0_u32);
    for raster in rasters {
        if !matches!(raster.samples(), Samples::F32(_)) {
            return 0.0;
        }
        let width = u64::from(raster.width());
        let texels = width * u64::from(raster.height());
        // Odd, so that it does not fall on the same columns in every row.
        let step = (texels / ASKED) | 1;
        for at in (0..texels).step_by(step as usize) {
            let [r, g, b, _] = raster.light((at % width) as u32, (at / width) as u32);
            let light = f64::from(0.2126 * r + 0.7152 * g + 0.0722 * b);
            if light > 0.0 {
                sum += light.log2();
                count += 1;
            }
        }
    }
    if count == 0 {
        return 0.0;
    }
    GREY.log2() - sum / f64::from(count)
}
