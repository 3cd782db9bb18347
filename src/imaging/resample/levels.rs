//! A map's smaller levels.

use super::{Conversion, Filter, ResampleError, resample};
use crate::imaging::{EnvironmentMap, Progress};

/// The map and all its smaller levels, each half as large as the one before, rounded down, to a single texel. `conversion` is
/// the one that made the map.
///
/// Each texel is the mean over its footprint on the level before, weighted by solid angle and looked up across seams, so
/// that these do not show. The light of a lone texel is kept to about a quarter on faces of 8 x 8.
///
/// # Errors
/// As [`resample`].
pub fn levels(
    map: EnvironmentMap,
    conversion: &Conversion,
    progress: &Progress,
) -> Result<Vec<EnvironmentMap>, ResampleError> {
    let mut smaller = Conversion {
        rotation: Conversion::UNTURNED,
        filter: Some(Filter::Area),
        supersample: 1,
        exposure_ev: 0.0,
        ..conversion.clone()
    };
    let mut levels = vec![map];
    while smaller.size != [1, 1] {
        smaller.size = smaller.size.map(|side| (side / 2).max(1));
        // Never empty: it began with one.
        let Some(last) = levels.last() else { break };
        let (level, _) = resample(last, &smaller, progress)?;
        levels.push(level);
    }
    Ok(levels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::{Channels, Raster, Samples, Transfer};
    use crate::mapping::{Layout, MappingId};

    #[test]
    fn every_level_holds_the_same_mean_light() {
        // One bright texel in the corner of a face, where its solid angle is least.
        let faces = |bright: usize| {
            let raster = |face: usize| {
                let mut texels = vec![0.0; 8 * 8 * 3];
                if face == 2 {
                    texels[bright * 3] = 64.0;
                }
                Raster::new(
                    [8, 8],
                    Channels::Rgb,
                    Transfer::Linear,
                    Samples::F32(texels),
                )
                .unwrap()
            };
            let rasters = (0..6).map(raster).collect();
            EnvironmentMap::from_layout(MappingId::Cube, Layout::Faces, rasters).unwrap()
        };
        let last_mean = |bright: usize| {
            let map = faces(bright);
            let mut conversion = Conversion::new(MappingId::Cube, [8, 8], map.shape());
            conversion.layout = Layout::Faces;
            let levels = levels(map, &conversion, &Progress::new()).unwrap();
            let sizes: Vec<_> = levels.iter().map(|level| level.shape().size).collect();
            assert_eq!(sizes, [[8, 8], [4, 4], [2, 2], [1, 1]]);
            let last = &levels[3];
            (0..6)
                .map(|face| f64::from(last.light(face, [0, 0])[0]))
                .sum::<f64>()
                / 6.0
        };
        // Solid angles of the texels at the corner and at the middle of a face of 8 x 8, over that of all 4 pi.
        let share = |a: f64, b: f64| {
            let corner = |x: f64, y: f64| (x * y).atan2((x * x + y * y + 1.0).sqrt());
            (corner(b, b) - 2.0 * corner(a, b) + corner(a, a)) / (4.0 * std::f64::consts::PI)
        };
        // The filter asks between texels too, so a lone texel's light reaches its neighbours, which at a corner stand for
        // more of the sphere and at a middle for less: some is gained or lost, the most in the last levels. A mean over 2 x 2 texels would be 1/384 of it anywhere.
        for (bright, a, b, budget) in [(0, 0.75, 1.0, 0.3), (27, 0.0, 0.25, 0.18)] {
            let (mean, exact) = (last_mean(bright), 64.0 * share(a, b));
            let observed = (mean / exact - 1.0).abs();
            let control = (64.0 / 384.0 / exact - 1.0).abs();
            println!(
                "texel {bright}: off by {observed:.3}, budget {budget}, plain means {control:.3}"
            );
            assert!(observed < budget && control > 1.5 * budget);
        }
    }
}
