//! The Jacobian of a mapping's inverse: how a chart is stretched onto the sphere.

use super::{ChartPoint, MappingId};
use crate::math::{Dual, Real, Vec3};

/// d(direction)/d(u, v), a 3 x 2 matrix: radians on the sphere per unit of chart coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jacobian<R> {
    /// d(direction)/du.
    pub du: Vec3<R>,
    /// d(direction)/dv.
    pub dv: Vec3<R>,
}

impl<R: Real> Jacobian<R> {
    /// Solid angle per unit of chart area in sr, sqrt(det J^T J), exact for unit directions.
    pub fn area_scale(&self) -> R {
        self.du.cross(self.dv).length()
    }

    /// The axes of Tissot's indicatrix, larger first: the singular values of the matrix.
    pub fn singular_values(&self) -> (R, R) {
        // Of a 2 x 2 Gram matrix: their sum and difference come from |du|^2 + |dv|^2 +- 2 area, without cancellation in
        // the larger one; the smaller follows from the area.
        let trace = self.du.dot(self.du) + self.dv.dot(self.dv);
        let area = self.area_scale();
        let sum = (trace + R::two() * area).sqrt();
        let difference = (trace - R::two() * area).max(R::zero()).sqrt();
        let large = R::half() * (sum + difference);
        (
            large,
            if large > R::zero() {
                area / large
            } else {
                R::zero()
            },
        )
    }

    /// Ratio of the axes, at least 1; infinite where the chart collapses.
    pub fn anisotropy(&self) -> R {
        let (large, small) = self.singular_values();
        large / small
    }
}

impl MappingId {
    /// Unit direction and Jacobian at a chart point; `None` off the chart.
    pub fn jacobian<R: Real>(self, point: ChartPoint<R>) -> Option<(Vec3<R>, Jacobian<R>)> {
        let dual_point = ChartPoint::new(
            point.chart,
            Dual::<R, 2>::variable(point.u, 0),
            Dual::variable(point.v, 1),
        );
        let dir = self.inverse(dual_point)?;
        let column = |i: usize| {
            Vec3::new(
                dir.x.derivative[i],
                dir.y.derivative[i],
                dir.z.derivative[i],
            )
        };
        let value = Vec3::new(dir.x.value, dir.y.value, dir.z.value);
        Some((
            value,
            Jacobian {
                du: column(0),
                dv: column(1),
            },
        ))
    }

    /// Solid angle in sr of the texel (column, row) of a chart of `size` = [width, height] texels, by Gauss's rule with
    /// 3 x 3 nodes, exact to the sixth order of the texel's size where the map is smooth: a texel across whose diagonal the
    /// octahedral map is folded is off by a thousandth at 64 x 64. Parts outside the domain count nothing.
    pub fn texel_solid_angle_sr(self, chart: u32, texel: [u32; 2], size: [u32; 2]) -> f64 {
        // Nodes and weights of Gauss-Legendre quadrature with three points on [0, 1].
        let offset = 0.5 * 0.6_f64.sqrt();
        let rule = [
            (0.5 - offset, 5.0 / 18.0),
            (0.5, 8.0 / 18.0),
            (0.5 + offset, 5.0 / 18.0),
        ];
        let cell = [1.0 / f64::from(size[0]), 1.0 / f64::from(size[1])];
        let mut sum = 0.0;
        for (x, weight_x) in rule {
            for (y, weight_y) in rule {
                let u = (f64::from(texel[0]) + x) * cell[0];
                let v = (f64::from(texel[1]) + y) * cell[1];
                if let Some((_, jacobian)) = self.jacobian(ChartPoint::new(chart, u, v)) {
                    sum += weight_x * weight_y * jacobian.area_scale();
                }
            }
        }
        sum * cell[0] * cell[1]
    }
}
