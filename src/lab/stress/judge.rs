//! One evaluator on one family of inputs, against exact arithmetic.

use super::budgets::{self, Expectation};
use super::families::{Family, walk_length};
use super::{MEASURES, Measures, Row};
use crate::lab::accuracy::{direction_of, texel_rad};
use crate::mapping::evaluator::SINGLE;
use crate::mapping::{
    ChartPoint, Coverage, DirList, Domain, Evaluator, EvaluatorError, EvaluatorInfo, MappingId,
    NOWHERE, PointList,
};
use crate::math::{Isa, Vec3, angle_rad};

/// Texels along a chart's height, for jumps across seams.
const TEXELS: f64 = 1024.0;

/// A mapping, a family and what exact arithmetic says of its inputs.
pub(super) struct Subject {
    map: MappingId,
    family: Family,
    effort: usize,
    dirs: DirList,
    /// The exact chart, and whether it is a tie; `None` for what is no direction.
    exact: Vec<Option<(u32, bool)>>,
}

/// Who is asked.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    /// The evaluator.
    pub info: &'a EvaluatorInfo,
    /// What computes it.
    pub computed: &'a dyn Evaluator,
    /// On which device.
    pub device: &'a str,
}

impl Subject {
    pub fn new(map: MappingId, family: Family, inputs: &[[f32; 3]], effort: usize) -> Self {
        let coverage = map.info().coverage;
        let is_direction = |dir: &[f32; 3]| dir.iter().all(|c| c.is_finite()) && *dir != [0.0; 3];
        // A direction without an image of its own is asked for nothing; a walk stays whole, so that its steps can be counted.
        let is_covered = |dir: &&[f32; 3]| match coverage {
            Coverage::Hemisphere(_) => {
                family == Family::Walks
                    || !is_direction(dir)
                    || coverage.contains(dir.map(f64::from))
            }
            _ => true,
        };
        let dirs: DirList = inputs.iter().filter(is_covered).copied().collect();
        let view = dirs.view();
        let exact = (0..view.len()).map(|k| {
            let dir = view.at(k).to_f64();
            // Comparisons are exact, and f64 holds every f32 and what scaling makes of it.
            let point = map.forward(Vec3::<f64>::from_f64(dir))?;
            Some((point.chart, is_tie(map, dir)))
        });
        let exact = exact.collect();
        Self {
            map,
            family,
            effort,
            dirs,
            exact,
        }
    }

    /// Runs the evaluator and judges what comes out.
    pub fn row(&self, asked: Asked<'_>) -> Result<Row, EvaluatorError> {
        let dirs = self.dirs.view();
        let mut points = PointList::zeros(dirs.len());
        asked.computed.forward(dirs, points.view_mut())?;
        let mut back = DirList::zeros(dirs.len());
        if asked.info.has_inverse() {
            asked.computed.inverse(points.view(), back.view_mut())?;
        } else if let Some(usual) = self.map.processor(SINGLE) {
            // A form without an inverse is read by the one that is used when none is asked for.
            usual
                .on(Isa::best())
                .inverse(points.view(), back.view_mut())?;
        }
        // A shader may take what is below the normal numbers for zero, and then says so everywhere.
        let is_none =
            |k: usize| asked.info.form().is_some() && dirs.at(k).max_abs() < f32::MIN_POSITIVE;
        let mut seen = Seen::default();
        for (k, exact) in self.exact.iter().enumerate() {
            let exact = exact.filter(|_| !is_none(k));
            self.see(k, exact, points.view().at(k), back.view().at(k), &mut seen);
        }
        if self.family == Family::Walks {
            for start in (0..dirs.len()).step_by(walk_length(self.effort)) {
                let range = start..(start + walk_length(self.effort)).min(dirs.len());
                let walk: Vec<_> = range.map(|k| points.view().at(k).to_f64()).collect();
                seen.walk(self.map, &walk);
            }
        }
        Ok(self.judged(asked, &seen))
    }

    /// Takes in one direction's chart point and what comes back from it.
    fn see(
        &self,
        k: usize,
        exact: Option<(u32, bool)>,
        point: ChartPoint<f32>,
        back: Vec3<f32>,
        seen: &mut Seen,
    ) {
        let (measures, is_nowhere) = (&mut seen.measures, point.chart == NOWHERE);
        let Some((chart, is_tie)) = exact else {
            measures.wrong_chart += u64::from(!is_nowhere);
            seen.breaks(k, !is_nowhere);
            return;
        };
        if is_nowhere {
            measures.holes += 1;
            return seen.breaks(k, true);
        }
        let coordinates = [point.u, point.v];
        if !coordinates.iter().all(|c| c.is_finite()) {
            measures.not_finite += 1;
            return seen.breaks(k, true);
        }
        let is_wrong = point.chart != chart && !is_tie;
        let is_out = !coordinates.iter().all(|c| (0.0..=1.0).contains(c));
        measures.wrong_chart += u64::from(is_wrong);
        measures.out_of_range += u64::from(is_out);
        let dir = self.dirs.view().at(k).to_f64();
        if !self.map.info().coverage.contains(dir) {
            return seen.breaks(k, is_wrong || is_out);
        }
        // At a size at which squares neither overflow nor vanish.
        let dir = Vec3::<f64>::from_f64(dir)
            .scaled_direction()
            .map_or(dir, Vec3::to_f64);
        if let Some(meant) = direction_of(self.map, point.to_f64()) {
            let rad = angle_rad(meant, dir);
            if rad > measures.max_forward_rad {
                measures.max_forward_rad = rad;
                seen.farthest = Some(k);
            }
        }
        // A point outside of the chart has no way back; it has been counted.
        if back.max_abs() > 0.0 {
            let rad = angle_rad(back.to_f64(), dir);
            measures.max_round_trip_rad = measures.max_round_trip_rad.max(rad);
        }
        seen.breaks(k, is_wrong || is_out);
    }

    fn judged(&self, asked: Asked<'_>, seen: &Seen) -> Row {
        let evaluator = asked.info;
        let (map, family) = (self.map, self.family);
        let allowed = budgets::allowed(map, evaluator.id);
        let expected: Vec<&Expectation> = budgets::expectations(map, evaluator.id).collect();
        let mut faults = Vec::new();
        let numbers = seen.measures.numbers().into_iter().zip(allowed.numbers());
        for ((observed, allowed), name) in numbers.zip(MEASURES) {
            let known = expected.iter().find(|e| e.measure == name);
            let is_over = observed > allowed;
            match known {
                None if is_over => faults.push(format!("{name} {observed:.3e} > {allowed:.1e}")),
                Some(known) if known.families.contains(&family) && !is_over => {
                    faults.push(format!(
                        "{name} {observed:.3e}: expected to fail, {}",
                        known.why
                    ));
                }
                _ => {}
            }
        }
        let known = expected.iter().map(|e| format!("{}: {}", e.measure, e.why));
        let known = known.collect::<Vec<_>>().join("; ");
        let worst = seen.broken.or(seen.farthest).unwrap_or(0);
        let bits = |c: f32| format!("0x{:08x}", c.to_bits());
        let worst = if worst < self.dirs.len() {
            self.dirs.view().at(worst).to_array().map(bits)
        } else {
            [0.0; 3].map(bits)
        };
        Row {
            mapping: map.info().id,
            evaluator: evaluator.id,
            device: asked.device.to_owned(),
            family,
            n: self.dirs.len(),
            observed: seen.measures,
            worst,
            allowed,
            expected_fault: (!known.is_empty()).then_some(known),
            broken: !faults.is_empty(),
            fault: (!faults.is_empty()).then(|| faults.join("; ")),
        }
    }
}

/// Whether charts meet at a direction exactly.
fn is_tie(map: MappingId, [x, y, z]: [f64; 3]) -> bool {
    let [x, y, z] = [x.abs(), y.abs(), z.abs()];
    match map.info().charts.len() {
        6 => {
            let largest = x.max(y).max(z);
            [x, y, z].iter().filter(|c| **c == largest).count() > 1
        }
        2 => z == 0.0,
        _ => false,
    }
}

/// What has been seen so far.
#[derive(Default)]
struct Seen {
    measures: Measures,
    /// The first input that broke something.
    broken: Option<usize>,
    /// The input of the largest forward error.
    farthest: Option<usize>,
}

impl Seen {
    fn breaks(&mut self, k: usize, is_broken: bool) {
        if is_broken {
            self.broken.get_or_insert(k);
        }
    }

    /// Takes in a walk: for each step the points below, on and above a seam.
    fn walk(&mut self, map: MappingId, walk: &[ChartPoint<f64>]) {
        let info = map.info();
        // A rim that is one direction, or that bounds the half that is covered, has no other side.
        let has_seams = info.chart_count() > 1 || info.domain == Domain::Square;
        let steps: Vec<_> = walk.chunks_exact(3).collect();
        if has_seams {
            for step in &steps {
                let jump = seam_jump(map, step[0], step[2]) * TEXELS;
                self.measures.max_seam_jump_texels = self.measures.max_seam_jump_texels.max(jump);
            }
        }
        if info.chart_count() == 6 {
            let on: Vec<_> = steps.iter().map(|step| step[1]).collect();
            self.measures.max_fall_ulp = self.measures.max_fall_ulp.max(largest_fall(&on));
        }
    }
}

/// Disagreement along the seam between two points on its sides; 0 where there is no seam between them.
fn seam_jump(map: MappingId, p: ChartPoint<f64>, q: ChartPoint<f64>) -> f64 {
    /// So near on the same chart, there is no seam.
    const NEAR: f64 = 1e-3;
    let is_usable = |p: &ChartPoint<f64>| p.chart != NOWHERE && p.u.is_finite() && p.v.is_finite();
    if !(is_usable(&p) && is_usable(&q)) {
        return 0.0;
    }
    let (du, dv) = ((p.u - q.u).abs(), (p.v - q.v).abs());
    if p.chart == q.chart && du.max(dv) < NEAR {
        return 0.0;
    }
    // On one chart both lie on the same border, which at a corner only the other of the two tells.
    let (across, down) = (
        |p: ChartPoint<f64>| p.u.min(1.0 - p.u),
        |p: ChartPoint<f64>| p.v.min(1.0 - p.v),
    );
    let on_side = |p: ChartPoint<f64>, q: ChartPoint<f64>| {
        let (u, v) = if p.chart == q.chart {
            (across(p).max(across(q)), down(p).max(down(q)))
        } else {
            (across(p), down(p))
        };
        map.info().domain == Domain::Disc || u < v
    };
    let along = |p: ChartPoint<f64>, q| if on_side(p, q) { p.v } else { p.u };
    let (s, t) = (along(p, q), along(q, p));
    // The sides may be counted from opposite ends.
    let t = if (s - t).abs() < (s + t - 1.0).abs() {
        t
    } else {
        1.0 - t
    };
    // Near a pole places far apart on the chart are neighbours on the sphere: that counts, too.
    let moved = if on_side(p, q) {
        ChartPoint { v: t, ..p }
    } else {
        ChartPoint { u: t, ..p }
    };
    let ends = direction_of(map, p).zip(direction_of(map, moved));
    let on_sphere = ends.map_or(f64::INFINITY, |(a, b)| angle_rad(a, b) / texel_rad(map, 1));
    (s - t).abs().min(on_sphere)
}

/// Most ULP by which the coordinate that changes most over a run on one chart steps against its way.
fn largest_fall(walk: &[ChartPoint<f64>]) -> f64 {
    const ULP: f64 = 0.5 * f32::EPSILON as f64;
    let mut fall = 0.0_f64;
    for run in walk.chunk_by(|a, b| a.chart == b.chart) {
        let [first, .., last] = run else {
            continue;
        };
        let (du, dv) = (last.u - first.u, last.v - first.v);
        let place = |p: &ChartPoint<f64>| {
            if du.abs() > dv.abs() {
                p.u * du.signum()
            } else {
                p.v * dv.signum()
            }
        };
        for pair in run.windows(2) {
            fall = fall.max((place(&pair[0]) - place(&pair[1])) / ULP);
        }
    }
    fall
}
