//! How far results are from the reference in double precision.

use crate::mapping::{ChartPoint, DirList, Dirs, Domain, MappingId, NOWHERE, PointList, Points};
use crate::math::{Vec3, angle_rad};

/// Unit in the last place of an f32 in [1/2, 1).
const ULP: f64 = 0.5 * f32::EPSILON as f64;

/// Errors over many inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Largest angle between what was asked and what was meant, in radians.
    pub max_rad: f64,
    /// Root of the mean square of that angle.
    pub rms_rad: f64,
    /// Largest difference of a coordinate in units in the last place that f32 has just below 1: u and v are computed from 0
    /// and from 1 alike, and so are the components of a unit vector.
    pub max_ulp: f64,
    /// Largest distance in texels, at the given number of texels along a chart's height.
    pub max_texels: f64,
    /// The input with the largest angle, or the first without a result: a direction, or (chart, u, v).
    pub worst: [f64; 3],
    /// Inputs without a result, or with one that is not a number.
    pub holes: usize,
}

impl Errors {
    const NONE: Self = Self {
        max_rad: 0.0,
        rms_rad: 0.0,
        max_ulp: 0.0,
        max_texels: 0.0,
        worst: [0.0; 3],
        holes: 0,
    };

    /// Takes one result in: its angle, the rest, and the input.
    fn see(&mut self, rad: f64, ulp: f64, texels: f64, input: [f64; 3]) {
        if rad > self.max_rad && self.holes == 0 {
            self.worst = input;
        }
        self.max_rad = self.max_rad.max(rad);
        self.max_ulp = self.max_ulp.max(ulp);
        self.max_texels = self.max_texels.max(texels);
        self.rms_rad += rad * rad;
    }

    fn miss(&mut self, input: [f64; 3]) {
        if self.holes == 0 {
            self.worst = input;
        }
        self.holes += 1;
    }

    fn over(mut self, count: usize) -> Self {
        let seen = count.saturating_sub(self.holes).max(1);
        self.rms_rad = (self.rms_rad / seen as f64).sqrt();
        self
    }
}

/// How far one chart point is off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Off {
    /// Angle between the direction and the one that the point stands for, in radians.
    pub rad: f64,
    /// Largest difference of a coordinate, in units as [`Errors::max_ulp`].
    pub ulp: f64,
    /// Distance in texels.
    pub texels: f64,
}

impl Off {
    /// Of a `point` that should be `exact`, the reference's for `dir`, at `texels` texels along a chart's height; `None`
    /// where the point is none.
    pub fn of(
        map: MappingId,
        dir: [f64; 3],
        exact: ChartPoint<f64>,
        point: ChartPoint<f32>,
        texels: u32,
    ) -> Option<Self> {
        let rad = angle_rad(direction_of(map, point.to_f64())?, dir);
        let step = [f64::from(point.u) - exact.u, f64::from(point.v) - exact.v];
        let is_near = point.chart == exact.chart && step.iter().all(|c| c.abs() < 0.25);
        // On the other side of a seam coordinates cannot be compared: the angle stands for them.
        let (ulp, texels) = if is_near {
            let [across, down] = [map.info().aspect, 1.0].map(|c| c * f64::from(texels));
            (
                step[0].abs().max(step[1].abs()) / ULP,
                (step[0] * across).hypot(step[1] * down),
            )
        } else {
            (0.0, rad / texel_rad(map, texels))
        };
        Some(Self { rad, ulp, texels })
    }
}

/// What the directions' chart points should be, computed once for all evaluators.
pub struct ForwardTruth {
    map: MappingId,
    dirs: DirList,
    exact: Vec<Option<ChartPoint<f64>>>,
}

impl ForwardTruth {
    /// Asks the reference.
    pub fn new(map: MappingId, dirs: DirList) -> Self {
        let view = dirs.view();
        let exact = |k: usize| map.forward(Vec3::<f64>::from_f64(view.at(k).to_f64()));
        let exact = (0..view.len()).map(exact).collect();
        Self { map, dirs, exact }
    }

    /// The directions.
    pub fn dirs(&self) -> Dirs<'_> {
        self.dirs.view()
    }

    /// Errors of an evaluator's points.
    pub fn errors(&self, points: &PointList, texels: u32) -> Errors {
        let (dirs, points) = (self.dirs.view(), points.view());
        let mut errors = Errors::NONE;
        for (k, exact) in self.exact.iter().enumerate() {
            let dir = dirs.at(k).to_f64();
            let off = exact.and_then(|exact| Off::of(self.map, dir, exact, points.at(k), texels));
            match off {
                Some(Off { rad, ulp, texels }) => errors.see(rad, ulp, texels, dir),
                None => errors.miss(dir),
            }
        }
        errors.over(self.exact.len())
    }
}

/// What the points' directions should be.
pub struct InverseTruth {
    map: MappingId,
    points: PointList,
    exact: Vec<Option<[f64; 3]>>,
}

impl InverseTruth {
    /// Asks the reference.
    pub fn new(map: MappingId, points: PointList) -> Self {
        let view = points.view();
        let exact = (0..view.len())
            .map(|k| direction_of(map, view.at(k).to_f64()))
            .collect();
        Self { map, points, exact }
    }

    /// The points.
    pub fn points(&self) -> Points<'_> {
        self.points.view()
    }

    /// Errors of an evaluator's directions.
    pub fn errors(&self, dirs: &DirList, texels: u32) -> Errors {
        let (points, dirs) = (self.points.view(), dirs.view());
        let mut errors = Errors::NONE;
        for (k, exact) in self.exact.iter().enumerate() {
            let ChartPoint { chart, u, v } = points.at(k).to_f64();
            let (input, dir) = ([f64::from(chart), u, v], dirs.at(k).to_f64());
            let is_dir = dir.iter().all(|c| c.is_finite()) && dir != [0.0; 3];
            let Some(exact) = exact.filter(|_| is_dir) else {
                errors.miss(input);
                continue;
            };
            let rad = angle_rad(dir, exact);
            let component = |i: usize| (dir[i] - exact[i]).abs() / ULP;
            let ulp = component(0).max(component(1)).max(component(2));
            errors.see(rad, ulp, rad / texel_rad(self.map, texels), input);
        }
        errors.over(self.exact.len())
    }
}

/// The exact direction of a point that f32 arithmetic may have put just outside the chart; `None` where it is none at all.
pub fn direction_of(map: MappingId, point: ChartPoint<f64>) -> Option<[f64; 3]> {
    let info = map.info();
    if point.chart == NOWHERE || !(point.u.is_finite() && point.v.is_finite()) {
        return None;
    }
    let point = point.clamped();
    let point = match info.domain {
        Domain::Disc if !Domain::Disc.contains(point.u, point.v) => {
            let (p, q) = (point.u - 0.5, point.v - 0.5);
            let diameter = 2.0 * p.hypot(q);
            ChartPoint::new(point.chart, 0.5 + p / diameter, 0.5 + q / diameter)
        }
        _ => point,
    };
    map.inverse(point).map(Vec3::to_f64)
}

/// Side of the square that has a texel's mean solid angle, in radians.
pub fn texel_rad(map: MappingId, texels: u32) -> f64 {
    let info = map.info();
    let used = match info.domain {
        Domain::Square => 1.0,
        Domain::Disc => std::f64::consts::FRAC_PI_4,
    };
    let count = f64::from(info.chart_count()) * used * info.aspect * f64::from(texels).powi(2);
    (info.coverage.solid_angle_sr() / count).sqrt()
}
