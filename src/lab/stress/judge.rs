//! One evaluator on one family of inputs, against exact arithmetic.

use super::budgets;
use super::families::{Family, walk_length};
use super::verdict::{Exact, Found, at_usual_size};
use super::{Measure, Measures, Row, Standing};
use crate::lab::accuracy::{direction_of, texel_rad};
use crate::mapping::evaluator::SINGLE;
use crate::mapping::{
    Borders, ChartPoint, DirList, Domain, Evaluator, EvaluatorError, EvaluatorInfo, MappingId,
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
    /// `None` for what is no direction.
    exact: Vec<Option<Exact>>,
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
        let is_covered = |dir: &&[f32; 3]| {
            !coverage.has_cut()
                || family == Family::Walks
                || !is_direction(dir)
                || coverage.contains(dir.map(f64::from))
        };
        let dirs: DirList = inputs.iter().filter(is_covered).copied().collect();
        let view = dirs.view();
        let exact = (0..view.len())
            .map(|k| Exact::of(map, view.at(k).to_f64()))
            .collect();
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
                let is_covered = |k: usize| {
                    let coverage = self.map.info().coverage;
                    coverage.contains(dirs.at(start + k).to_f64())
                };
                seen.walk(self.map, start, &walk, is_covered);
            }
        }
        Ok(self.judged(asked, &seen))
    }

    /// Takes in one direction's chart point and what comes back from it.
    fn see(
        &self,
        k: usize,
        exact: Option<Exact>,
        point: ChartPoint<f32>,
        back: Vec3<f32>,
        seen: &mut Seen,
    ) {
        let dir = self.dirs.view().at(k).to_f64();
        let found = Found::of(self.map, dir, exact, point);
        for (is_so, measure) in [
            (found.is_hole, Measure::Holes),
            (found.is_wrong_chart, Measure::WrongChart),
            (found.is_out_of_range, Measure::OutOfRange),
            (found.is_not_finite, Measure::NotFinite),
        ] {
            if is_so {
                seen.count(measure, k);
            }
        }
        let Some(rad) = found.forward_rad else {
            return;
        };
        seen.largest(Measure::Forward, k, rad);
        // A point outside of the chart has no way back; it has been counted.
        if back.max_abs() > 0.0 {
            let rad = angle_rad(back.to_f64(), at_usual_size(dir));
            seen.largest(Measure::RoundTrip, k, rad);
        }
    }

    fn judged(&self, asked: Asked<'_>, seen: &Seen) -> Row {
        let evaluator = asked.info;
        let (map, family) = (self.map, self.family);
        let known: Vec<String> = budgets::expectations(map, evaluator.id)
            .map(|e| format!("{}: {}", e.measure, e.why))
            .collect();
        let input = |k: usize| self.dirs.view().at(k).to_array();
        let worst_of = seen.worst.map(|k| k.map(input));
        let worst = seen.broken.or(seen.worst[Measure::Forward as usize]);
        let bits = |c: f32| format!("0x{:08x}", c.to_bits());
        let worst = if self.dirs.is_empty() {
            [0.0; 3]
        } else {
            input(worst.unwrap_or(0))
        };
        let mut row = Row {
            mapping: map.info().id,
            evaluator: evaluator.id,
            device: asked.device.to_owned(),
            family,
            n: self.dirs.len(),
            observed: Measures::from_numbers(seen.numbers),
            worst: worst.map(bits),
            worst_of,
            allowed: budgets::allowed(map, evaluator.id),
            expected_fault: (!known.is_empty()).then(|| known.join("; ")),
            broken: false,
            fault: None,
        };
        let faults: Vec<String> = Measure::ALL
            .iter()
            .filter_map(|measure| fault(&row, *measure))
            .collect();
        row.broken = !faults.is_empty();
        row.fault = row.broken.then(|| faults.join("; "));
        row
    }
}

/// What is wrong with a measure beyond what is known, in words.
fn fault(row: &Row, measure: Measure) -> Option<String> {
    let (name, observed) = (measure.id(), row.observed.number(measure));
    match row.standing(measure) {
        Standing::Kept | Standing::Known => None,
        Standing::Broken => {
            let allowed = row.allowed.number(measure);
            Some(format!("{name} {observed:.3e} > {allowed:.1e}"))
        }
        Standing::Gone => {
            let why = row.known(measure).map_or("", |known| known.why);
            Some(format!("{name} {observed:.3e}: expected to fail, {why}"))
        }
    }
}

/// What has been seen so far.
#[derive(Default)]
struct Seen {
    /// In the order of [`Measure::ALL`].
    numbers: [f64; 8],
    /// The input of each measure's worst case; the first where inputs are counted.
    worst: [Option<usize>; 8],
    /// The first input that broke something.
    broken: Option<usize>,
}

impl Seen {
    /// Counts an input that breaks something.
    fn count(&mut self, measure: Measure, k: usize) {
        self.numbers[measure as usize] += 1.0;
        self.worst[measure as usize].get_or_insert(k);
        self.broken.get_or_insert(k);
    }

    /// Keeps the largest.
    fn largest(&mut self, measure: Measure, k: usize, x: f64) {
        if x > self.numbers[measure as usize] {
            self.numbers[measure as usize] = x;
            self.worst[measure as usize] = Some(k);
        }
    }

    /// Takes in a walk whose first input is the one of the given number: for each step the points below, on and above a seam.
    /// Between inputs that are not covered nothing is promised.
    fn walk(
        &mut self,
        map: MappingId,
        start: usize,
        walk: &[ChartPoint<f64>],
        is_covered: impl Fn(usize) -> bool,
    ) {
        let info = map.info();
        // A rim that is one direction, or that bounds the half that is covered, has no other side.
        let has_seams = info.chart_count() > 1 || info.domain == Domain::Square;
        let steps: Vec<_> = walk.chunks_exact(3).collect();
        // The input on the seam.
        let on_seam = |step: usize| start + 3 * step + 1;
        if has_seams {
            for (k, step) in steps.iter().enumerate() {
                if !(is_covered(3 * k) && is_covered(3 * k + 2)) {
                    continue;
                }
                let jump = seam_jump(map, step[0], step[2]) * TEXELS;
                self.largest(Measure::SeamJump, on_seam(k), jump);
            }
        }
        if info.borders == Borders::CubeEdges {
            let on: Vec<_> = steps.iter().map(|step| step[1]).collect();
            let (fall, step) = largest_fall(&on);
            self.largest(Measure::Fall, on_seam(step), fall);
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

/// Most ULP by which the coordinate that changes most over a run on one chart steps against its way, and the step before it.
fn largest_fall(walk: &[ChartPoint<f64>]) -> (f64, usize) {
    const ULP: f64 = 0.5 * f32::EPSILON as f64;
    let (mut fall, mut at, mut start) = (0.0_f64, 0, 0);
    for run in walk.chunk_by(|a, b| a.chart == b.chart) {
        let before = start;
        start += run.len();
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
        for (k, pair) in run.windows(2).enumerate() {
            let step = (place(&pair[0]) - place(&pair[1])) / ULP;
            if step > fall {
                (fall, at) = (step, before + k);
            }
        }
    }
    (fall, at)
}
