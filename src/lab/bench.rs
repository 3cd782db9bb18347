//! Run time against error, of every evaluator of every mapping.

mod processor;
mod shader;

use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::accuracy::{Errors, ForwardTruth, InverseTruth};
use super::clock::Clock;
use super::devices::{Devices, Outcome};
use super::front::on_front;
use super::inputs::Inputs;
use crate::imaging::{Progress, Stage};
use crate::mapping::{
    Device, DirList, Dirs, Evaluator, EvaluatorError, EvaluatorInfo, MappingId, PointList, Points,
    Runs,
};

/// What is measured, and how carefully.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The mappings.
    pub maps: Vec<MappingId>,
    /// Where their evaluators run.
    pub devices: Devices,
    /// The inputs.
    pub inputs: Vec<Inputs>,
    /// Texels along a chart's height, for the error in texels.
    pub texels: u32,
    /// Directions at a time that stay in the first-level cache.
    pub few: usize,
    /// Directions at a time that come from memory.
    pub many: usize,
    /// Directions at a time on a graphics adapter.
    pub on_adapter: usize,
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
            devices: Devices::Both,
            inputs: Inputs::ALL.to_vec(),
            texels: 1024,
            few: 1 << 10,
            many: 1 << 22,
            on_adapter: 1 << 18,
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
            on_adapter: 1 << 15,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
    pub device: String,
    /// Instructions; [`SHADER`] on an adapter.
    pub isa: &'static str,
    /// Threads; 0 on an adapter, which counts its own.
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

/// What stands for the instructions of a shader.
pub const SHADER: &str = "wgsl";
/// What stands for the processor as a device.
pub const CPU: &str = "cpu";

/// Mapping, direction, inputs, device, threads and directions at a time.
type Circumstances<'a> = (&'static str, Way, Inputs, &'a str, usize, usize);

impl Row {
    /// Everything but the evaluator and its instructions: what is alike here can be compared.
    pub fn circumstances(&self) -> Circumstances<'_> {
        (
            self.mapping,
            self.direction,
            self.inputs,
            &self.device,
            self.threads,
            self.n,
        )
    }

    /// Largest error in texels on charts of so many rows: the error on the sphere is the same, a texel is as much smaller.
    pub fn error_texels_at(&self, rows: u32) -> f64 {
        self.max_error_texels * f64::from(rows) / f64::from(self.texels.max(1))
    }

    /// Measured as evaluators are compared: with few directions at a time by one thread, or on an adapter.
    pub fn is_comparable(&self) -> bool {
        self.isa == SHADER || self.threads == 1 && self.ns_latency.is_some()
    }
}

/// Runs the plan; ends early, with what there is, when the progress is cancelled. Without an adapter shaders are left out.
pub fn bench(plan: &Plan, device: &dyn Device, progress: &Progress) -> Outcome<Row> {
    progress.enter(Stage::Measuring);
    let adapter = plan.devices.open(device);
    let adapter_name = adapter.as_ref().and_then(|a| Some(&*a.as_ref().ok()?.name));
    let takes_part = |evaluator: &&EvaluatorInfo| {
        plan.devices.include(evaluator) && (adapter_name.is_some() || evaluator.form().is_none())
    };
    let evaluators = |map: MappingId| map.evaluators().iter().filter(takes_part);
    let count = |map: &MappingId| evaluators(*map).count() * plan.inputs.len();
    let total: usize = plan.maps.iter().map(count).sum();
    let (mut rows, mut faults, mut done) = (Vec::new(), Vec::new(), 0);
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
            for evaluator in evaluators(*map) {
                if progress.is_cancelled() {
                    break;
                }
                match &evaluator.runs {
                    Runs::Processor(processor) => {
                        subject.measure(evaluator.id, processor, &mut rows);
                    }
                    Runs::Shader(form) => {
                        let name = adapter_name.unwrap_or_default();
                        let shader = device.shader(*map, *form);
                        let found = shader.and_then(|shader| {
                            subject.measure_shader(*form, &*shader, name, &mut rows)
                        });
                        if let Err(error) = found {
                            faults.push(format!("{map} by {}: {error}", evaluator.id));
                        }
                    }
                }
                done += 1;
                progress.step(done, total);
            }
        }
    }
    mark_front(&mut rows);
    Outcome {
        rows,
        adapter,
        faults,
    }
}

/// Marks the rows that are on the front of their circumstances.
pub fn mark_front(rows: &mut [Row]) {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        let is_of = |group: &&mut Vec<usize>| {
            let first = group.first().and_then(|first| rows.get(*first));
            first.is_some_and(|first| first.circumstances() == row.circumstances())
        };
        match groups.iter_mut().find(is_of) {
            Some(group) => group.push(k),
            None => groups.push(vec![k]),
        }
    }
    for members in groups {
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

impl Subject<'_> {
    /// Errors of an evaluator one way.
    fn errors(&self, evaluator: &dyn Evaluator, way: Way) -> Result<Errors, EvaluatorError> {
        let texels = self.plan.texels;
        match way {
            Way::Forward => {
                let dirs = self.forward.dirs();
                let mut points = PointList::zeros(dirs.len());
                evaluator.forward(dirs, points.view_mut())?;
                Ok(self.forward.errors(&points, texels))
            }
            Way::Inverse => {
                let points = self.backward.points();
                let mut dirs = DirList::zeros(points.len());
                evaluator.inverse(points, dirs.view_mut())?;
                Ok(self.backward.errors(&dirs, texels))
            }
        }
    }

    /// A row without its times and circumstances.
    fn row(&self, evaluator: &'static str, direction: Way, errors: Errors) -> Row {
        Row {
            mapping: self.map.info().id,
            evaluator,
            direction,
            inputs: self.inputs,
            device: CPU.to_owned(),
            isa: "",
            threads: 0,
            n: 0,
            ns: f64::NAN,
            ns_latency: None,
            spread: f64::NAN,
            copy_ratio: f64::NAN,
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

    /// The first `n` directions, again and again where there are fewer.
    fn dirs(&self, n: usize) -> DirList {
        repeated_dirs(self.forward.dirs(), n)
    }

    /// The first `n` points.
    fn points(&self, n: usize) -> PointList {
        repeated_points(self.backward.points(), n)
    }
}

fn repeated_dirs(dirs: Dirs<'_>, n: usize) -> DirList {
    let count = dirs.len().max(1);
    (0..n).map(|k| dirs.at(k % count).to_array()).collect()
}

fn repeated_points(points: Points<'_>, n: usize) -> PointList {
    let count = points.len().max(1);
    (0..n).map(|k| points.at(k % count)).collect()
}
