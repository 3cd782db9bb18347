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

    /// The same where the chart is a square of as many texels as a chart `aspect` times as wide as high: areas stay, and square
    /// texels have sides of equal length.
    pub fn of_square_texels(&self, aspect: R) -> Self {
        let root = aspect.sqrt();
        Self {
            du: self.du * (R::one() / root),
            dv: self.dv * root,
        }
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
}
