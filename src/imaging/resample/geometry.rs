//! Which place of the source a place of the target looks at.

use super::conversion::Conversion;
use super::grid::Grid;
use crate::imaging::{MapShape, Siting};
use crate::mapping::{ChartPoint, MappingId};
use crate::math::{Dual, Real, Vec3};

/// The way from the target's chart to the source's: inverse, axes, rotation, axes, forward.
#[derive(Clone, Debug)]
pub(super) struct Geometry {
    pub target: Grid,
    pub source: Grid,
    /// Rows of the matrix from the target's own directions to the source's own.
    pub turn: [[f64; 3]; 3],
}

/// A place in the source: its part (see [`Grid::part`]), and texels to the right and down from the middle of texel (0, 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub part: u32,
    pub at: [f64; 2],
}

fn product(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|k| (0..3).map(|j| a[i][j] * b[j][k]).sum()))
}

impl Geometry {
    pub fn new(source: &MapShape, target: &MapShape, conversion: &Conversion) -> Self {
        let turn = product(
            source.world_from_map.inverse().matrix(),
            product(conversion.rotation, target.world_from_map.matrix()),
        );
        Self {
            target: Grid::of(target),
            source: Grid::of(source),
            turn,
        }
    }

    /// Takes charts as wholes: to the nearest texel no seam and no bend matters.
    pub const fn do_not_divide(&mut self) {
        self.source.facets = 1;
        self.target.facets = 1;
    }

    /// Whether source and target are one mapping and nothing is turned: places are in proportion, with no mapping between.
    pub fn is_proportional(&self) -> bool {
        self.source.mapping == self.target.mapping && self.turn == Conversion::UNTURNED
    }

    /// Whether each texel is its own source.
    pub fn is_identity(&self) -> bool {
        self.is_proportional() && self.source == self.target
    }

    /// The source's own direction, of any length, of a place of the target.
    pub fn source_dir(&self, chart: u32, at: [f64; 2]) -> Option<Vec3<f64>> {
        let point = self.target_point(chart, at);
        Some(self.turned(self.target.mapping.inverse(point)?))
    }

    /// The source's chart point of a point of the target; `None` where the target has no direction.
    pub fn look<R: Real>(&self, point: ChartPoint<R>) -> Option<ChartPoint<R>> {
        self.source
            .mapping
            .forward(self.turned(self.target.mapping.inverse(point)?))
    }

    fn turned<R: Real>(&self, dir: Vec3<R>) -> Vec3<R> {
        let row = |[x, y, z]: [f64; 3]| {
            R::from_f64(x) * dir.x + R::from_f64(y) * dir.y + R::from_f64(z) * dir.z
        };
        Vec3::new(row(self.turn[0]), row(self.turn[1]), row(self.turn[2]))
    }

    /// The chart point of a place of the target. Edge samples and parts of texels may lie beyond the chart: on its border
    /// then.
    pub fn target_point(&self, chart: u32, [x, y]: [f64; 2]) -> ChartPoint<f64> {
        let point = ChartPoint::new(
            chart,
            self.target.coordinate(0, x),
            self.target.coordinate(1, y),
        );
        match self.target.siting {
            Siting::Centre => point,
            Siting::Edge => point.clamped(),
        }
    }

    fn source_place(&self, point: ChartPoint<f64>) -> Place {
        self.source.found(point)
    }

    /// Where the source is looked up for a place of the target.
    pub fn place(&self, chart: u32, at: [f64; 2]) -> Option<Place> {
        let point = self.target_point(chart, at);
        if self.is_identity() {
            let on = self.target.mapping.info().domain.contains(point.u, point.v);
            return on.then(|| Place {
                part: self.source.part(point),
                at,
            });
        }
        if self.is_proportional() {
            let on = self.target.mapping.info().domain.contains(point.u, point.v);
            return on.then(|| self.source_place(point));
        }
        // In f64: beside a pole f32 leaves a tenth of a texel of longitude at 4096 texels.
        self.look(point).map(|found| self.source_place(found))
    }

    /// How far the place in the source moves, in source texels, for one texel of the target to the right and one down; and
    /// the solid angle of the target's texel, up to a factor. Not finite at singular points.
    pub fn footprint(&self, chart: u32, at: [f64; 2]) -> Option<Footprint> {
        let point = self.target_point(chart, at);
        let per_texel = [0, 1].map(|side| 1.0 / self.target.density(side).max(1.0));
        if self.is_proportional() {
            let along = |side: usize| per_texel[side] * self.source.density(side);
            return Some(Footprint {
                steps: [[along(0), 0.0], [0.0, along(1)]],
            });
        }
        let dual = ChartPoint::new(
            chart,
            Dual::<f64, 2>::variable(point.u, 0),
            Dual::variable(point.v, 1),
        );
        let found = self.look(dual)?;
        let steps = [0, 1].map(|side| {
            [
                found.u.derivative[side] * per_texel[side] * self.source.density(0),
                found.v.derivative[side] * per_texel[side] * self.source.density(1),
            ]
        });
        Some(Footprint { steps })
    }

    /// Solid angle per unit of the target's chart area, the weight of a place in a mean; 0 where it cannot be told.
    pub fn weight(&self, chart: u32, at: [f64; 2]) -> f64 {
        let found = self.target.mapping.jacobian(self.target_point(chart, at));
        let area = found.map_or(0.0, |(_, jacobian)| jacobian.area_scale());
        if area.is_finite() { area } else { 0.0 }
    }
}

/// What one texel of the target covers in the source: where it goes for a step right and a step down, in source texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Footprint {
    pub steps: [[f64; 2]; 2],
}

impl Footprint {
    /// Length of each step; at singular points infinite or no number.
    pub fn lengths(&self) -> [f64; 2] {
        self.steps.map(|[x, y]| x.hypot(y))
    }

    /// Source texels that the texel covers.
    pub fn area(&self) -> f64 {
        let [[a, b], [c, d]] = self.steps;
        (a * d - b * c).abs()
    }
}

/// Whether a mapping's texels all weigh the same.
pub(super) fn is_equal_area(mapping: MappingId) -> bool {
    mapping.info().claims.equal_area
}
