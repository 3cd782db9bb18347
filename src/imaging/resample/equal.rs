//! The size at which a map resolves as much as another, and the rotation of a viewer.

use crate::imaging::MapShape;
use crate::mapping::MappingId;
use crate::math::{Rotation, Rows, Vec3};

/// Texels that a horizontal circle of directions crosses: once around, whatever part of it the mapping holds.
///
/// The circle is followed through the charts in small steps; the jumps over seams do not count.
fn texels_around(mapping: MappingId, size: [f64; 2]) -> f64 {
    /// Steps around: many enough that a step never covers a tenth of a chart, where a jump begins.
    const STEPS: u32 = 4096;
    const JUMP: f64 = 0.1;
    let point = |step: u32| {
        // Off the seams, which lie at round angles.
        let angle = (f64::from(step) + 0.3) / f64::from(STEPS) * std::f64::consts::TAU;
        mapping.own_point(Vec3::new(angle.sin(), 0.0, angle.cos()))
    };
    let (mut texels, mut steps) = (0.0, 0_u32);
    for step in 0..STEPS {
        let (Some(from), Some(to)) = (point(step), point(step + 1)) else {
            continue;
        };
        let (du, dv) = (to.u - from.u, to.v - from.v);
        if from.chart == to.chart && du.abs() < JUMP && dv.abs() < JUMP {
            texels += (du * size[0]).hypot(dv * size[1]);
            steps += 1;
        }
    }
    texels * f64::from(STEPS) / f64::from(steps.max(1))
}

/// Texels of a chart of `height` rows, [width, height]: as wide as makes its texels square where the mapping is least
/// distorted.
pub fn chart_size(mapping: MappingId, height: u32) -> [u32; 2] {
    let width = (f64::from(height) * mapping.info().aspect).round() as u32;
    [width.max(1), height]
}

/// Size of the charts, [width, height], with which a map has as nearly `texels` texels as whole rows allow; at least one row.
/// Of a disc all texels of its square count.
pub fn size_of_texels(mapping: MappingId, texels: u64) -> [u32; 2] {
    let per_row_squared = f64::from(mapping.info().chart_count()) * mapping.info().aspect;
    // `as` saturates, and a chart of more rows than this is refused anyway.
    let rows = ((texels as f64 / per_row_squared).sqrt() as u32).clamp(1, super::MOST_SIDE);
    // The width is rounded as well, so that the rows below may be nearer too.
    let around = rows.saturating_sub(1).max(1)..=rows + 1;
    let sizes = around.map(|rows| chart_size(mapping, rows));
    let off = |size: &[u32; 2]| texels_of(mapping, *size).abs_diff(texels);
    sizes
        .min_by_key(off)
        .unwrap_or_else(|| chart_size(mapping, rows))
}

/// Texels of all charts of `size` texels together.
pub fn texels_of(mapping: MappingId, [width, height]: [u32; 2]) -> u64 {
    u64::from(mapping.info().chart_count()) * u64::from(width) * u64::from(height)
}

/// The rows of a chart at which a map has as many texels around the horizon as `source`, at least 1.
///
/// A latlong of 4096 x 2048 has 4096 around; so have six faces of 1024.
pub fn equal_height(mapping: MappingId, source: &MapShape) -> u32 {
    equal_rows(mapping, source.mapping, source.size)
}

/// As [`equal_height`], for a map of `source` with charts of `size` texels.
pub fn equal_rows(mapping: MappingId, source: MappingId, size: [u32; 2]) -> u32 {
    let source = texels_around(source, size.map(f64::from));
    let of_one_row = texels_around(mapping, [mapping.info().aspect, 1.0]);
    // `as` saturates.
    ((source / of_one_row).round() as u32).max(1)
}

/// The rotation of a conversion ([`super::Conversion::rotation`]) that turns the viewer: `yaw` to the right, then `pitch` up,
/// then `roll` clockwise, in degrees, each about the axes that the turn before has left. The middle of the result shows what
/// was `yaw` to the right of the source's, so the picture moves to the left.
///
/// Multiples of 90 degrees are exact.
pub fn rotation_of_viewer(degrees: [f64; 3]) -> Rows {
    Rotation::from_degrees(degrees).source_from_world()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::resample::Conversion;
    use crate::imaging::{Channels, EnvironmentMap, Raster, Samples, Transfer};

    fn shape(mapping: MappingId, size: [u32; 2]) -> MapShape {
        let [columns, rows] = mapping.info().layout.grid();
        let picture = [size[0] * columns, size[1] * rows];
        let samples = Samples::U8(vec![0; (picture[0] * picture[1] * 3) as usize]);
        let raster = Raster::new(picture, Channels::Rgb, Transfer::Srgb, samples).unwrap();
        let map = EnvironmentMap::from_layout(mapping, mapping.info().layout, vec![raster]);
        map.unwrap().shape().clone()
    }

    #[test]
    fn maps_of_equal_height_have_as_many_texels_around() {
        let latlong = shape(MappingId::Latlong, [512, 256]);
        // Around the horizon: four faces; two discs; the diagonals of a square folded at the poles; a disc across.
        for (mapping, height) in [
            (MappingId::Latlong, 256),
            (MappingId::Cube, 128),
            (MappingId::Ccm, 128),
            (MappingId::Eac, 128),
            (MappingId::Paraboloid, 256),
            (MappingId::Angular, 512),
            (MappingId::Sphere, 512),
            (MappingId::Matcap, 256),
            (MappingId::CylindricalEqualArea, 163),
        ] {
            assert_eq!(equal_height(mapping, &latlong), height, "{mapping}");
        }
        for mapping in MappingId::ALL {
            let there = equal_height(*mapping, &latlong);
            let back = equal_height(
                MappingId::Latlong,
                &shape(*mapping, chart_size(*mapping, there)),
            );
            assert!(back.abs_diff(256) <= 1, "{mapping}: {there}, back {back}");
        }
    }

    #[test]
    fn maps_of_as_many_texels() {
        for (mapping, texels, size) in [
            (MappingId::Cube, 6 * 48 * 48, [48, 48]),
            (MappingId::Latlong, 2 * 83 * 83, [166, 83]),
            (MappingId::Paraboloid, 2 * 83 * 83, [83, 83]),
            (MappingId::Octahedral, 6 * 48 * 48, [118, 118]),
            (MappingId::Cube, 0, [1, 1]),
        ] {
            assert_eq!(size_of_texels(mapping, texels), size, "{mapping}");
        }
        for &mapping in MappingId::ALL {
            for texels in [1536, 13_824, 1_572_864] {
                let size = size_of_texels(mapping, texels);
                let off = |size| texels_of(mapping, size).abs_diff(texels);
                // A row more or less is farther off.
                for rows in [size[1] - 1, size[1] + 1] {
                    assert!(
                        off(size) <= off(chart_size(mapping, rows)),
                        "{mapping} {texels}"
                    );
                }
            }
            let most = size_of_texels(mapping, u64::MAX);
            assert!(
                most[1] <= crate::imaging::resample::MOST_SIDE + 1,
                "{mapping}"
            );
        }
    }

    #[test]
    fn the_viewer_turns_right_then_up_then_clockwise() {
        let apply = |angles: [f64; 3], v: [f64; 3]| {
            rotation_of_viewer(angles).map(|row| row.iter().zip(v).map(|(a, b)| a * b).sum::<f64>())
        };
        let (right, up, ahead) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(apply([90.0, 0.0, 0.0], ahead), right);
        assert_eq!(apply([0.0, 90.0, 0.0], ahead), up);
        assert_eq!(apply([0.0, 0.0, 90.0], up), right);
        // After a yaw the pitch goes up from there.
        let both = apply([90.0, 45.0, 0.0], ahead);
        assert!((both[0] - 0.5_f64.sqrt()).abs() < 1e-15 && (both[1] - both[0]).abs() < 1e-15);
        for whole in [0.0, 360.0, -720.0] {
            assert_eq!(
                rotation_of_viewer([whole, 0.0, -whole]),
                Conversion::UNTURNED
            );
        }
        assert_ne!(rotation_of_viewer([1e-9, 0.0, 0.0]), Conversion::UNTURNED);
    }
}
