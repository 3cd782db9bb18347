//! Run time against error, of every evaluator of every mapping.

use std::hint::black_box;
use std::time::Duration;

use serde::Serialize;

use super::accuracy::{Errors, ForwardTruth, InverseTruth};
use super::clock::{Clock, Timing};
use super::front::on_front;
use super::inputs::Inputs;
use super::run::{self, Threads};
use crate::imaging::{Progress, Stage};
use crate::mapping::evaluator::EvaluatorInfo;
use crate::mapping::{DirList, Dirs, MappingId, PointList, Points};
use crate::math::Isa;

/// What is measured, and how carefully.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The mappings.
    pub maps: Vec<MappingId>,
    /// The inputs.
    pub inputs: Vec<Inputs>,
    /// Texels along a chart's height, for the error in texels.
    pub texels: u32,
    /// Directions at a time that stay in the first-level cache.
    pub few: usize,
    /// Directions at a time that come from memory.
    pub many: usize,
    /// Directions by which errors are found.
    pub judged: usize,
    /// How times are taken.
    pub clock: Clock,
}

impl Plan {
    /// A minute or two on two cores.
    pub fn full() -> Self {
        Self {
            maps: MappingId::ALL.to_vec(),
            inputs: Inputs::ALL.to_vec(),
            texels: 1024,
            few: 1 << 10,
            many: 1 << 22,
            judged: 1 << 16,
            clock: Clock {
                samples: 9,
                shortest: Duration::from_micros(500),
            },
        }
    }

    /// Some seconds on two cores: random inputs, shorter times.
    pub fn quick() -> Self {
        Self {
            inputs: vec![Inputs::Random],
            many: 1 << 19,
            judged: 1 << 14,
            clock: Clock {
                samples: 5,
                shortest: Duration::from_micros(60),
            },
            ..Self::full()
        }
    }
}

/// Which way an evaluator is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// Direction to chart point.
    Forward,
    /// Chart point to direction.
    Inverse,
}

impl Way {
    /// The word in reports.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Forward => "forward",
            Self::Inverse => "inverse",
        }
    }
}

/// One measurement: what it costs and how far it errs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Id of the mapping.
    pub mapping: &'static str,
    /// Id of the evaluator.
    pub evaluator: &'static str,
    /// Which way.
    pub direction: Way,
    /// On what.
    pub inputs: Inputs,
    /// `cpu`, or the adapter's name.
    pub device: &'static str,
    /// Instructions.
    pub isa: &'static str,
    /// Threads.
    pub threads: usize,
    /// Directions at a time.
    pub n: usize,
    /// Nanoseconds per direction, one after the other without waiting: the median.
    pub ns: f64,
    /// Nanoseconds per direction where each waits for the one before; `null` where it was not taken.
    pub ns_latency: Option<f64>,
    /// Half the distance between the quartiles of `ns`, over `ns`.
    pub spread: f64,
    /// `ns` over the time of a plain copy of the bytes read, at the same `n` and threads.
    pub copy_ratio: f64,
    /// Largest error in radians.
    pub max_error_rad: f64,
    /// Root of the mean square error in radians.
    pub rms_error_rad: f64,
    /// Largest error of a coordinate in ULP of f32.
    pub max_error_ulp: f64,
    /// Largest error in texels.
    pub max_error_texels: f64,
    /// Texels along a chart's height.
    pub texels: u32,
    /// The input with the largest error: a direction, or (chart, u, v).
    pub worst: [f64; 3],
    /// Inputs that got no result.
    pub holes: usize,
    /// Whether no evaluator is both as fast and as near, under the same circumstances.
    pub on_front: bool,
}

/// Nanoseconds a direction above which no memory is the limit: it brings 12 bytes and takes as many in about 1 ns.
const HELD_UP_NS: f64 = 4.0;

/// Bytes read for a direction or a chart point: three numbers. As many are written.
const BYTES: usize = 12;

/// Runs the plan; ends early, with what there is, when the progress is cancelled.
pub fn bench(plan: &Plan, progress: &Progress) -> Vec<Row> {
    progress.enter(Stage::Measuring);
    let mut rows = Vec::new();
    let total = plan.maps.len() * plan.inputs.len();
    let mut done = 0;
    for map in &plan.maps {
        for inputs in &plan.inputs {
            let dirs = inputs.directions(*map, plan.judged.max(plan.few));
            let subject = Subject {
                map: *map,
                inputs: *inputs,
                plan,
                backward: InverseTruth::new(*map, Inputs::points(*map, &dirs)),
                forward: ForwardTruth::new(*map, dirs),
            };
            let evaluators = map.evaluators();
            for (k, evaluator) in evaluators.iter().enumerate() {
                if progress.is_cancelled() {
                    break;
                }
                subject.measure(evaluator, &mut rows);
                progress.step(done * evaluators.len() + k + 1, total * evaluators.len());
            }
            done += 1;
        }
    }
    mark_front(&mut rows);
    rows
}

/// Marks the rows that are on the front of their circumstances.
pub fn mark_front(rows: &mut [Row]) {
    type Circumstances = (&'static str, Way, Inputs, &'static str, usize, usize);
    let key = |row: &Row| -> Circumstances {
        (
            row.mapping,
            row.direction,
            row.inputs,
            row.device,
            row.threads,
            row.n,
        )
    };
    let mut keys: Vec<Circumstances> = rows.iter().map(key).collect();
    keys.dedup();
    for (at, circumstances) in keys.iter().enumerate() {
        if keys[..at].contains(circumstances) {
            continue;
        }
        let members: Vec<usize> = (0..rows.len())
            .filter(|k| key(&rows[*k]) == *circumstances)
            .collect();
        // A form with holes is no answer, however fast.
        let cost = |k: &usize| match &rows[*k] {
            row if row.holes > 0 => (f64::NAN, f64::NAN),
            row => (row.ns, row.max_error_rad),
        };
        let costs: Vec<(f64, f64)> = members.iter().map(cost).collect();
        for (k, is_on) in members.iter().zip(on_front(&costs)) {
            rows[*k].on_front = is_on;
        }
    }
}

/// A mapping and inputs, with the truth about them.
struct Subject<'a> {
    map: MappingId,
    inputs: Inputs,
    plan: &'a Plan,
    forward: ForwardTruth,
    backward: InverseTruth,
}

/// How an evaluator is run.
#[derive(Clone, Copy)]
struct Setting {
    way: Way,
    isa: Isa,
    threads: Threads,
    is_many: bool,
}

impl Subject<'_> {
    fn measure(&self, evaluator: &EvaluatorInfo, rows: &mut Vec<Row>) {
        let best = Isa::best();
        let sets: Vec<Isa> = match evaluator.is_vector {
            true => Isa::ALL.into_iter().filter(|isa| *isa <= best).collect(),
            false => vec![Isa::Baseline],
        };
        for way in [Way::Forward, Way::Inverse] {
            if way == Way::Inverse && evaluator.inverse.is_none() {
                continue;
            }
            let mut errors = None;
            for isa in &sets {
                let setting = Setting {
                    way,
                    isa: *isa,
                    threads: Threads::One,
                    is_many: false,
                };
                let found = self.errors(evaluator, setting);
                rows.push(self.row(evaluator, setting, found));
                errors = Some((setting, found));
            }
            let (Some((setting, found)), Some(last)) = (errors, rows.last()) else {
                continue;
            };
            // From memory, and by all threads: where the memory can hold a form up at all, and where the order of the inputs
            // cannot matter.
            let is_held_up = last.ns < HELD_UP_NS;
            if evaluator.is_vector && is_held_up && self.inputs == Inputs::Random {
                for threads in [Threads::One, Threads::All] {
                    let setting = Setting {
                        threads,
                        is_many: true,
                        ..setting
                    };
                    rows.push(self.row(evaluator, setting, found));
                }
            }
        }
    }

    fn errors(&self, evaluator: &EvaluatorInfo, Setting { way, isa, .. }: Setting) -> Errors {
        match (way, &evaluator.inverse) {
            (Way::Inverse, Some(inverse)) => {
                let points = self.backward.points();
                let mut dirs = DirList::zeros(points.len());
                inverse(isa, points, dirs.view_mut());
                self.backward.errors(&dirs, self.plan.texels)
            }
            _ => {
                let dirs = self.forward.dirs();
                let mut points = PointList::zeros(dirs.len());
                (evaluator.forward)(isa, dirs, points.view_mut());
                self.forward.errors(&points, self.plan.texels)
            }
        }
    }

    fn row(&self, evaluator: &EvaluatorInfo, setting: Setting, errors: Errors) -> Row {
        let Setting {
            way,
            isa,
            threads,
            is_many,
        } = setting;
        let n = if is_many {
            self.plan.many
        } else {
            self.plan.few
        };
        let (timing, copy_ratio) = self.throughput(evaluator, setting, n);
        Row {
            mapping: self.map.info().id,
            evaluator: evaluator.id,
            direction: way,
            inputs: self.inputs,
            device: "cpu",
            isa: isa.id(),
            threads: threads.count(),
            n,
            ns: timing.median_ns / n as f64,
            ns_latency: (!is_many).then(|| self.latency(evaluator, setting)),
            spread: timing.spread,
            copy_ratio,
            max_error_rad: errors.max_rad,
            rms_error_rad: errors.rms_rad,
            max_error_ulp: errors.max_ulp,
            max_error_texels: errors.max_texels,
            texels: self.plan.texels,
            worst: errors.worst,
            holes: errors.holes,
            on_front: false,
        }
    }

    /// Time of `n` directions at once, and its ratio to a plain copy.
    fn throughput(&self, evaluator: &EvaluatorInfo, setting: Setting, n: usize) -> (Timing, f64) {
        let Setting { isa, threads, .. } = setting;
        let (clock, bytes) = (self.plan.clock, n * BYTES);
        let on_all = threads == Threads::All;
        match (setting.way, &evaluator.inverse) {
            (Way::Inverse, Some(inverse)) => {
                let points = repeated_points(self.backward.points(), n);
                let mut dirs = DirList::zeros(points.len());
                clock.time_beside_copy(
                    || {
                        run::inverse(
                            inverse,
                            isa,
                            threads,
                            black_box(points.view()),
                            dirs.view_mut(),
                        );
                        black_box(&mut dirs);
                    },
                    bytes,
                    on_all,
                )
            }
            _ => {
                let dirs = repeated_dirs(self.forward.dirs(), n);
                let mut points = PointList::zeros(n);
                let forward = &evaluator.forward;
                clock.time_beside_copy(
                    || {
                        run::forward(
                            forward,
                            isa,
                            threads,
                            black_box(dirs.view()),
                            points.view_mut(),
                        );
                        black_box(&mut points);
                    },
                    bytes,
                    on_all,
                )
            }
        }
    }

    /// Nanoseconds of a direction that waits for the one before: what it adds to the next input is zero, but nobody knows.
    fn latency(&self, evaluator: &EvaluatorInfo, setting: Setting) -> f64 {
        const CHAIN: usize = 64;
        let mut dirs = repeated_dirs(self.forward.dirs(), CHAIN);
        let mut points = repeated_points(self.backward.points(), CHAIN);
        let (mut dir, mut point) = (DirList::zeros(1), PointList::zeros(1));
        let nothing = black_box(0.0_f32);
        let timing = self.plan.clock.time(|| {
            for k in 0..CHAIN {
                match (setting.way, &evaluator.inverse) {
                    (Way::Inverse, Some(inverse)) => {
                        points.u[k] += dir.x[0] * nothing;
                        let part = points.view().part(k..k + 1);
                        inverse(setting.isa, part, dir.view_mut());
                    }
                    _ => {
                        dirs.x[k] += point.u[0] * nothing;
                        let part = dirs.view().part(k..k + 1);
                        (evaluator.forward)(setting.isa, part, point.view_mut());
                    }
                }
            }
        });
        timing.median_ns / CHAIN as f64
    }
}

/// The first `n` directions, again and again where there are fewer.
fn repeated_dirs(dirs: Dirs<'_>, n: usize) -> DirList {
    let count = dirs.len().max(1);
    (0..n).map(|k| dirs.at(k % count).to_array()).collect()
}

/// The first `n` points, again and again where there are fewer.
fn repeated_points(points: Points<'_>, n: usize) -> PointList {
    let count = points.len().max(1);
    (0..n).map(|k| points.at(k % count)).collect()
}
