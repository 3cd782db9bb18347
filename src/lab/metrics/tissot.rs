//! Tissot's indicatrices: equal small circles of the sphere, and the ellipses that a mapping makes of them.

use crate::mapping::{ChartPoint, Domain, MappingId};
use crate::math::Vec3;

/// Distances of the circles' middles that can be chosen, in degrees.
pub const SPACING_DEG: (f32, f32) = (8.0, 45.0);

/// Points around an ellipse where it is drawn.
pub const OUTLINE: usize = 32;

/// Radius of a circle over the distance to the next one: they do not touch.
pub const RADIUS: f64 = 0.36;

/// An ellipse around a chart point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Its middle.
    pub middle: ChartPoint<f64>,
    /// Two conjugate radii, as steps of (u, v).
    radii: [[f64; 2]; 2],
    /// What of the chart holds directions.
    domain: Domain,
}

impl Ellipse {
    /// The image of the circle of `radius_rad` around a chart point, by the mapping's derivative there, as Tissot has it: for a circle
    /// that is not small it is the ellipse that touches. `None` off the chart and where the chart collapses.
    pub fn of(map: MappingId, middle: ChartPoint<f64>, radius_rad: f64) -> Option<Self> {
        let (_, jacobian) = map.jacobian(middle)?;
        // |J x| = radius: with J = Q R, R upper triangular, x = radius R^-1 (cos, sin).
        let along = jacobian.du.length();
        let slant = jacobian.du.dot(jacobian.dv) / along;
        let across = jacobian.area_scale() / along;
        let radii = [
            [radius_rad / along, 0.0],
            [-radius_rad * slant / (along * across), radius_rad / across],
        ];
        let is_finite = radii.iter().flatten().all(|c| c.is_finite());
        is_finite.then_some(Self {
            middle,
            radii,
            domain: map.info().domain,
        })
    }

    /// `count` points around it; they may lie beyond a square chart, but not beyond a disc's rim.
    pub fn outline(&self, count: usize) -> impl Iterator<Item = ChartPoint<f64>> {
        let Self {
            middle,
            radii,
            domain,
        } = *self;
        (0..count).map(move |k| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
            let step = [0, 1].map(|i: usize| cos * radii[0][i] + sin * radii[1][i]);
            let at = [middle.u + step[0] - 0.5, middle.v + step[1] - 0.5];
            let within = match domain {
                Domain::Square => 1.0,
                Domain::Disc => (0.5 / at[0].hypot(at[1])).min(1.0),
            };
            ChartPoint::new(middle.chart, 0.5 + within * at[0], 0.5 + within * at[1])
        })
    }

    /// How far it reaches from its middle along u and v.
    pub fn reach(&self) -> [f64; 2] {
        [0, 1].map(|i: usize| self.radii[0][i].hypot(self.radii[1][i]))
    }
}

/// Directions about `spacing_deg` apart: on parallels that lie so far from each other, as many as fit.
pub fn middles(spacing_deg: f64) -> Vec<Vec3<f64>> {
    let spacing = spacing_deg.to_radians();
    let rows = (std::f64::consts::PI / spacing).round().max(2.0);
    let mut dirs = Vec::new();
    for row in 0..=rows as u32 {
        let (cos, sin) = (std::f64::consts::PI * f64::from(row) / rows).sin_cos();
        let count = (std::f64::consts::TAU * cos / spacing).round().max(1.0);
        for k in 0..count as u32 {
            let (x, z) = (std::f64::consts::TAU * f64::from(k) / count).sin_cos();
            dirs.push(Vec3::new(cos * x, sin, cos * z));
        }
    }
    dirs
}

/// The ellipses of a mapping for equal circles about `spacing_deg` apart. Those that reach over more than a chart are left out: around a
/// pole of a latlong the derivative has no end.
pub fn indicatrices(map: MappingId, spacing_deg: f64) -> Vec<Ellipse> {
    let radius = RADIUS * spacing_deg.to_radians();
    middles(spacing_deg)
        .into_iter()
        .filter_map(|dir| Ellipse::of(map, map.own_point(dir)?, radius))
        .filter(|ellipse| ellipse.reach().into_iter().all(|reach| reach < 0.5))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::angle_rad;

    /// Smallest and largest angle from an ellipse's middle to its outline, over the radius.
    fn radii(map: MappingId, point: ChartPoint<f64>, radius: f64) -> [f64; 2] {
        let ellipse = Ellipse::of(map, point, radius).unwrap();
        let middle = map.inverse(point).unwrap();
        let angles = ellipse.outline(64).map(|on| {
            let dir = map.continued(on);
            angle_rad(middle.to_f64(), dir.to_f64()) / radius
        });
        angles.fold([f64::INFINITY, 0.0], |[least, most], angle| {
            [least.min(angle), most.max(angle)]
        })
    }

    #[test]
    fn a_small_ellipse_is_a_circle_on_the_sphere() {
        for &map in MappingId::ALL {
            let point = ChartPoint::new(0, 0.37, 0.44);
            let [least, most] = radii(map, point, 1e-5);
            // Observed: at most 7e-6, by the radius' own square.
            assert!(
                least > 1.0 - 5e-5 && most < 1.0 + 5e-5,
                "{map}: {least} {most}"
            );
        }
        // Control: a circle of the chart is none on the sphere.
        let map = MappingId::Latlong;
        let ellipse = Ellipse {
            middle: ChartPoint::new(0, 0.37, 0.2),
            radii: [[1e-5, 0.0], [0.0, 1e-5]],
            domain: Domain::Square,
        };
        let middle = map.inverse(ellipse.middle).unwrap().to_f64();
        let angles: Vec<f64> = ellipse
            .outline(16)
            .map(|on| angle_rad(middle, map.continued(on).to_f64()))
            .collect();
        let most = angles.iter().copied().fold(0.0, f64::max);
        assert!(angles.iter().any(|angle| *angle < 0.9 * most));
    }

    #[test]
    fn its_area_and_shape_are_those_of_the_jacobian() {
        // A latlong at 60 degrees: twice as wide as high in texels, which are half as wide in u.
        let map = MappingId::Latlong;
        let ellipse = Ellipse::of(map, ChartPoint::new(0, 0.5, 1.0 / 6.0), 0.01).unwrap();
        let [width, height] = ellipse.reach();
        assert!((width / height - 1.0).abs() < 1e-12, "{width} {height}");
        assert!((height - 0.01 / std::f64::consts::PI).abs() < 1e-15);
        assert!(Ellipse::of(map, ChartPoint::new(0, 0.5, 0.0), 0.01).is_none());
    }

    #[test]
    fn circles_are_spread_evenly_and_do_not_touch() {
        for spacing in [10.0, 20.0, 45.0] {
            let dirs = middles(spacing);
            let even = 41_253.0 / (spacing * spacing);
            let share = dirs.len() as f64 / even;
            assert!((0.85..1.3).contains(&share), "{spacing}: {share}");
            let radius = RADIUS * spacing.to_radians();
            for (k, a) in dirs.iter().enumerate() {
                for b in &dirs[..k] {
                    assert!(angle_rad(a.to_f64(), b.to_f64()) > 2.0 * radius);
                }
            }
        }
    }
}
