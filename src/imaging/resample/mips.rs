//! Smaller and smaller copies of a map.

use super::{Conversion, Filter, ResampleError, resample};
use crate::imaging::{EnvironmentMap, Progress};
use crate::mapping::Layout;

/// The levels below a map, each of half the size (rounded down, at least 1) of the one before, down to one texel a chart; none
/// for a map of one texel. Every chart is a picture of its own ([`Layout::Faces`]).
///
/// Each is the mean over its texels' areas of the level above, weighted by solid angle and across seams.
///
/// # Errors
/// When it is cancelled or there is no memory.
pub fn mip_chain(
    map: &EnvironmentMap,
    progress: &Progress,
) -> Result<Vec<EnvironmentMap>, ResampleError> {
    let mut levels: Vec<EnvironmentMap> = Vec::new();
    loop {
        let above = levels.last().unwrap_or(map);
        let shape = above.shape();
        if shape.size == [1, 1] {
            return Ok(levels);
        }
        let conversion = Conversion {
            layout: Layout::Faces,
            world_from_map: shape.world_from_map,
            siting: shape.siting,
            filter: Some(Filter::Area),
            ..Conversion::new(shape.mapping, shape.size.map(|n| (n / 2).max(1)), shape)
        };
        let (level, _) = resample(above, &conversion, progress)?;
        levels.push(level);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::{Channels, Raster, Samples, Transfer};
    use crate::mapping::MappingId;

    #[test]
    fn a_chain_ends_at_one_texel_and_keeps_a_constant() {
        let rasters = (0..6).map(|_| {
            let samples = Samples::U8([9, 90, 200].repeat(13 * 13));
            Raster::new([13, 13], Channels::Rgb, Transfer::Srgb, samples).unwrap()
        });
        let map =
            EnvironmentMap::from_layout(MappingId::Cube, Layout::Faces, rasters.collect()).unwrap();
        let levels = mip_chain(&map, &Progress::new()).unwrap();
        let sizes: Vec<u32> = levels.iter().map(|level| level.shape().size[0]).collect();
        assert_eq!(sizes, [6, 3, 1]);
        for level in &levels {
            for face in 0..6 {
                assert_eq!(level.light(face, [0, 0]), map.light(0, [0, 0]));
            }
        }
    }
}
