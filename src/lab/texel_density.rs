//! How densely the texels of a map lie around a direction, and how far one reaches there: from the exact Jacobian.

use crate::mapping::{Jacobian, MappingId};
use crate::math::Vec3;

/// The texels of a map around a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelDensity {
    /// Texels per steradian; infinite where a whole side of the chart is one direction.
    pub per_sr: f64,
    /// The shortest and the longest extent of a texel in radians on the sphere: the axes of the ellipse that the circle within
    /// the texel becomes, as Tissot's indicatrix.
    pub extents_rad: [f64; 2],
}

impl TexelDensity {
    /// Of a map with charts of `size` = [width, height] texels. `None` for what is no direction, where the map has no texel of
    /// its own, and at singular points whose Jacobian is not finite.
    pub fn at(mapping: MappingId, size: [u32; 2], dir: Vec3<f64>) -> Option<Self> {
        let (_, per_chart) = mapping.jacobian(mapping.own_point(dir)?)?;
        let per_texel = Jacobian {
            du: per_chart.du * f64::from(size[0]).recip(),
            dv: per_chart.dv * f64::from(size[1]).recip(),
        };
        let (longest, shortest) = per_texel.singular_values();
        let per_sr = per_texel.area_scale().recip();
        (longest.is_finite() && shortest.is_finite()).then_some(Self {
            per_sr,
            extents_rad: [shortest, longest],
        })
    }

    /// Texels per square degree.
    pub fn per_square_degree(&self) -> f64 {
        self.per_sr * 1.0_f64.to_radians().powi(2)
    }

    /// Texels per degree, the least and the most of all ways across the direction.
    pub fn per_degree(&self) -> [f64; 2] {
        let [shortest, longest] = self.extents_rad;
        [longest, shortest].map(|side| 1.0_f64.to_radians() / side)
    }

    /// The shortest and the longest extent in minutes of arc.
    pub fn extents_arcmin(&self) -> [f64; 2] {
        self.extents_rad.map(|side| 60.0 * side.to_degrees())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::lab::metrics::{Quantity, Yardstick};
    use crate::mapping::{ChartPoint, Domain};

    fn at(mapping: MappingId, size: [u32; 2], dir: [f64; 3]) -> TexelDensity {
        TexelDensity::at(mapping, size, Vec3::from_f64(dir)).unwrap()
    }

    fn is_near(a: f64, b: f64) -> bool {
        (a / b - 1.0).abs() < 1e-12
    }

    #[test]
    fn a_latlong_has_twice_as_many_texels_at_sixty_degrees() {
        let size = [180, 90];
        let side = PI / 90.0;
        // Off the face's middle, for nothing depends on the longitude.
        let (sin, cos) = 0.3_f64.sin_cos();
        let equator = at(MappingId::Latlong, size, [sin, 0.0, cos]);
        assert!(is_near(equator.per_sr, side.powi(-2)), "{equator:?}");
        assert!(equator.extents_rad.iter().all(|s| is_near(*s, side)));
        assert!(equator.extents_arcmin().iter().all(|s| is_near(*s, 120.0)));
        assert!(equator.per_degree().iter().all(|n| is_near(*n, 0.5)));
        assert!(is_near(equator.per_square_degree(), 0.25));
        let high = 60.0_f64.to_radians();
        let dir = [sin * high.cos(), high.sin(), cos * high.cos()];
        let north = at(MappingId::Latlong, size, dir);
        assert!(is_near(north.per_sr, 2.0 * equator.per_sr), "{north:?}");
        assert!(is_near(north.extents_rad[0], 0.5 * side) && is_near(north.extents_rad[1], side));
        let pole = at(MappingId::Latlong, size, [0.0, 1.0, 0.0]);
        assert!(pole.per_sr > 1e12 * equator.per_sr, "{pole:?}");
        assert!(!is_near(north.per_sr, equator.per_sr), "control");
    }

    #[test]
    fn a_cube_has_three_root_three_times_as_many_in_its_corners() {
        let size = [48, 48];
        let middle = at(MappingId::Cube, size, [0.0, 0.0, 1.0]);
        let side: f64 = 2.0 / 48.0;
        assert!(is_near(middle.per_sr, side.powi(-2)), "{middle:?}");
        // Just within the corner, which is a tie.
        let hair = 1.0 - 1e-14;
        let corner = at(MappingId::Cube, size, [hair, hair, 1.0]);
        let ratio = corner.per_sr / middle.per_sr;
        assert!(is_near(ratio, 3.0 * 3.0_f64.sqrt()), "{ratio}");
        let [shortest, longest] = corner.extents_rad;
        assert!(is_near(longest / shortest, 3.0_f64.sqrt()));
        assert!(is_near(longest, side / 3.0_f64.sqrt()));
        // The equi-angular cube is more even.
        let even = at(MappingId::Eac, size, [hair, hair, 1.0]).per_sr
            / at(MappingId::Eac, size, [0.0, 0.0, 1.0]).per_sr;
        assert!(even < 1.5, "control: {even}");
    }

    #[test]
    fn a_sphere_map_is_even() {
        let size = [100, 100];
        // Of its square pi/4 is the disc, which holds 4 pi.
        let even = 100.0_f64.powi(2) / 16.0;
        for dir in [[0.0, 0.0, -1.0], [0.6, 0.0, 0.8], [-0.5, 0.7, -0.5]] {
            let found = at(MappingId::Sphere, size, dir);
            assert!(is_near(found.per_sr, even), "{found:?}");
        }
        // Towards its rim texels grow long without bound, and at it there is nothing to tell.
        let behind = at(MappingId::Sphere, size, [1e-3, 0.0, 1.0]);
        assert!(behind.extents_rad[1] > 1000.0 * behind.extents_rad[0]);
        let rim = TexelDensity::at(MappingId::Sphere, size, Vec3::new(0.0, 0.0, 1.0));
        assert!(rim.is_none_or(|rim| rim.extents_rad[1] > 1e6), "{rim:?}");
    }

    #[test]
    fn it_agrees_with_the_heat_maps_of_distortion() {
        let mut random = crate::math::inputs::Random::new(17);
        for &mapping in MappingId::ALL {
            let size = crate::imaging::resample::chart_size(mapping, 100);
            let texels = crate::imaging::resample::texels_of(mapping, size) as f64;
            let yardstick = Yardstick::new(mapping);
            let off = |texels: f64, dir: Vec3<f64>| {
                let local = yardstick.at(mapping.forward(dir)?)?;
                let other = Quantity::Density.of(&local, &yardstick, texels);
                let found = TexelDensity::at(mapping, size, dir)?.per_square_degree();
                Some((found / other - 1.0).abs())
            };
            let mut told = 0;
            for _ in 0..200 {
                let dir = Vec3::from_f64(random.direction().map(f64::from));
                if let Some(same) = off(texels, dir) {
                    told += 1;
                    assert!(same < 1e-12, "{mapping}: {same:e} at {dir:?}");
                    assert!(off(1.01 * texels, dir) > Some(9e-3), "control");
                }
            }
            assert!(told > 60, "{mapping}: {told}");
        }
    }

    #[test]
    fn what_texels_cover_is_the_sphere() {
        for &mapping in MappingId::ALL {
            let size = crate::imaging::resample::chart_size(mapping, 64);
            let solid_angle_sr = |wide: u32| -> f64 {
                let charts = 0..mapping.info().chart_count();
                let texels = charts.flat_map(|chart| {
                    (0..size[1]).flat_map(move |y| (0..size[0]).map(move |x| (chart, x, y)))
                });
                let dirs = texels.filter_map(|(chart, x, y)| {
                    let middle = |k: u32, n: u32| (f64::from(k) + 0.5) / f64::from(n);
                    mapping.inverse(ChartPoint::new(
                        chart,
                        middle(x, size[0]),
                        middle(y, size[1]),
                    ))
                });
                let wide = [wide * size[0], size[1]];
                dirs.filter_map(|dir| TexelDensity::at(mapping, wide, dir))
                    .map(|density| density.per_sr.recip())
                    .sum()
            };
            let covered = mapping.info().coverage.solid_angle_sr();
            let off = solid_angle_sr(1) / covered - 1.0;
            // The middle of a texel stands for all of it, and texels on a disc's rim, where some mappings are stretched without
            // bound, are in or out as a whole. Observed: 1.5e-4 (S2's), and 2.5e-2 (the matcap).
            let budget = match mapping.info().domain {
                Domain::Square => 2e-4,
                Domain::Disc => 3e-2,
            };
            assert!(off.abs() < budget, "{mapping}: {off:e}");
            let off = solid_angle_sr(2) / covered - 1.0;
            assert!(off < -0.4, "control, {mapping}: {off:e}");
        }
    }

    #[test]
    fn there_is_nothing_to_tell_of_no_direction_and_behind_a_hemisphere() {
        let zero = Vec3::new(0.0, 0.0, 0.0);
        assert_eq!(TexelDensity::at(MappingId::Cube, [8, 8], zero), None);
        let found = |z: f64| {
            let dir = Vec3::new(0.1, 0.1, z);
            TexelDensity::at(MappingId::Matcap, [8, 8], dir).is_some()
        };
        assert_ne!(found(1.0), found(-1.0));
    }
}
