//! Run time and errors of an evaluator on the processor.

use std::hint::black_box;

use super::super::clock::Timing;
use super::super::inputs::Inputs;
use super::super::run::{self, Threads};
use super::{Row, Subject, Way};
use crate::mapping::{DirList, PointList, Processor};
use crate::math::Isa;

/// Nanoseconds a direction above which no memory is the limit: it brings 12 bytes and takes as many in about 1 ns.
const HELD_UP_NS: f64 = 4.0;

/// Bytes read for a direction or a chart point: three numbers. As many are written.
const BYTES: usize = 12;

/// How an evaluator is run.
#[derive(Clone, Copy)]
struct Setting {
    way: Way,
    isa: Isa,
    threads: Threads,
    is_many: bool,
}

impl Subject<'_> {
    /// Every set of instructions, both ways.
    pub(super) fn measure(&self, id: &'static str, evaluator: &Processor, rows: &mut Vec<Row>) {
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
                // The processor computes whatever the form has.
                let Ok(found) = self.errors(&evaluator.on(*isa), way) else {
                    continue;
                };
                rows.push(self.timed(evaluator, setting, self.row(id, way, found)));
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
                    rows.push(self.timed(evaluator, setting, self.row(id, way, found)));
                }
            }
        }
    }

    /// The row with times and circumstances.
    fn timed(&self, evaluator: &Processor, setting: Setting, row: Row) -> Row {
        let n = if setting.is_many {
            self.plan.many
        } else {
            self.plan.few
        };
        let (timing, copy_ratio) = self.throughput(evaluator, setting, n);
        Row {
            isa: setting.isa.id(),
            threads: setting.threads.count(),
            n,
            ns: timing.median_ns / n as f64,
            ns_latency: (!setting.is_many).then(|| self.latency(evaluator, setting)),
            spread: timing.spread,
            copy_ratio,
            ..row
        }
    }

    /// Time of `n` directions at once, and its ratio to a plain copy.
    fn throughput(&self, evaluator: &Processor, setting: Setting, n: usize) -> (Timing, f64) {
        let Setting { isa, threads, .. } = setting;
        let (clock, bytes) = (self.plan.clock, n * BYTES);
        let on_all = threads == Threads::All;
        match (setting.way, &evaluator.inverse) {
            (Way::Inverse, Some(inverse)) => {
                let points = self.points(n);
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
                let dirs = self.dirs(n);
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
    fn latency(&self, evaluator: &Processor, setting: Setting) -> f64 {
        const CHAIN: usize = 64;
        let mut dirs = self.dirs(CHAIN);
        let mut points = self.points(CHAIN);
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
