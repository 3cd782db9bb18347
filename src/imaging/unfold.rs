//! A map from files as the latlong picture that is shown.

use super::load::{LoadError, LoadProblem, Loaded, MOST_HEIGHT, MOST_WIDTH, light_of_raster};
use super::resample::{Conversion, Filter, ResampleError, chart_size, equal_height, resample};
use super::{
    Channels, EnvironmentMap, Image, MapShape, OpenedMap, Placement, Progress, Raster, SampleKind,
    Samples, Siting, Transfer,
};
use crate::mapping::{Axes, MappingId, Turn};

/// Rows of the latlong that a map of another mapping becomes: what most devices' textures hold.
const MOST_UNFOLDED: u32 = 4096;

impl OpenedMap {
    /// The map as a latlong picture with as many texels around the horizon, fit to show. A latlong that lies as ours does
    /// keeps its texels.
    ///
    /// # Errors
    /// When the job is cancelled or there is no memory.
    pub fn into_latlong(self, progress: &Progress) -> Result<Loaded, LoadError> {
        let failed = |problem| LoadError {
            problem,
            name: self.name.clone(),
        };
        let is_plain = is_plain(self.map.shape());
        let image = if is_plain {
            light(&self.map)
        } else {
            unfolded(&self.map, progress).map_err(|error| match error {
                ResampleError::Cancelled => LoadProblem::Cancelled,
                ResampleError::OutOfMemory { bytes } => LoadProblem::OutOfMemory { bytes },
                other => LoadProblem::Unclear(other.to_string()),
            })
        };
        let mut loaded = Loaded::from_image(image.map_err(failed)?, progress);
        loaded.bad += self.bad;
        if is_plain {
            loaded.originals = self.originals.before(loaded.originals);
        }
        Ok(loaded)
    }
}

/// Whether the map is a latlong whose texels lie where those of a latlong of ours do.
fn is_plain(shape: &MapShape) -> bool {
    let whole = Placement {
        raster: 0,
        origin: [0, 0],
        turn: Turn::UPRIGHT,
    };
    let [width, height] = shape.size;
    shape.mapping == MappingId::Latlong
        && shape.charts == [Some(whole)]
        && shape.world_from_map == Axes::IDENTITY
        && shape.siting == Siting::Centre
        && width <= MOST_WIDTH
        && height <= MOST_HEIGHT
        && width.abs_diff(2 * height) <= 2
}

/// The only picture of a map as light without opacity.
fn light(map: &EnvironmentMap) -> Result<Image, LoadProblem> {
    let [width, height] = map.shape().size;
    let pixels = map.rasters().first().map(light_of_raster).transpose()?;
    Image::new(width, height, pixels.unwrap_or_default())
        .map_err(|error| LoadProblem::Unclear(error.to_string()))
}

/// The light of a map as a latlong.
fn unfolded(map: &EnvironmentMap, progress: &Progress) -> Result<Image, ResampleError> {
    let rows = equal_height(MappingId::Latlong, map.shape()).min(MOST_UNFOLDED);
    let [width, height] = chart_size(MappingId::Latlong, rows);
    let conversion = Conversion {
        filter: Some(Filter::Bilinear), // the map is looked up through further filters
        samples: SampleKind::F32,
        transfer: Transfer::Linear,
        channels: Channels::Rgb,
        ..Conversion::new(MappingId::Latlong, [width, height], map.shape())
    };
    let (latlong, _) = resample(map, &conversion, progress)?;
    let pixels = match latlong.rasters().first().map(Raster::samples) {
        Some(Samples::F32(samples)) => samples.as_chunks().0.to_vec(),
        _ => Vec::new(),
    };
    Image::new(width, height, pixels).map_err(|error| ResampleError::BadNumber(error.to_string()))
}
