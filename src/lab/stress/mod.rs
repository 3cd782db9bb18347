//! Where each way to compute a mapping breaks.

pub mod budgets;
pub mod families;
mod judge;
pub mod microscope;
pub mod palette;
pub mod places;
mod verdict;

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

pub use budgets::{Expectation, allowed, expectations};
pub use families::Family;

use super::bench::CPU;
use super::devices::{Devices, Outcome};
use crate::imaging::{Progress, Stage};
use crate::mapping::{Device, Evaluator, EvaluatorError, EvaluatorInfo, MappingId};
use crate::math::Isa;
use judge::{Asked, Subject};

/// What is asked of an evaluator on a family of inputs; in a row of a report beside what is allowed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Measures {
    /// Directions without a chart.
    pub holes: u64,
    /// Directions on another chart than in exact arithmetic, ties left out; of no directions those that got a chart.
    pub wrong_chart: u64,
    /// Coordinates outside of [0, 1].
    pub out_of_range: u64,
    /// Coordinates that are not finite numbers.
    pub not_finite: u64,
    /// Largest angle between a direction and what comes back, in radians.
    pub max_round_trip_rad: f64,
    /// Largest angle between a direction and that of its chart point, in radians.
    pub max_forward_rad: f64,
    /// Largest disagreement of the coordinate along a seam between its two sides, in texels of 1024 along a chart's height.
    pub max_seam_jump_texels: f64,
    /// Most ULP of f32 below 1 by which the coordinate along an edge of the cube steps back.
    pub max_fall_ulp: f64,
}

/// One of the [`Measures`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// See [`Measures::holes`].
    #[default]
    Holes,
    /// See [`Measures::wrong_chart`].
    WrongChart,
    /// See [`Measures::out_of_range`].
    OutOfRange,
    /// See [`Measures::not_finite`].
    NotFinite,
    /// See [`Measures::max_round_trip_rad`].
    RoundTrip,
    /// See [`Measures::max_forward_rad`].
    Forward,
    /// See [`Measures::max_seam_jump_texels`].
    SeamJump,
    /// See [`Measures::max_fall_ulp`].
    Fall,
}

impl Measure {
    /// All of them, in the order of [`MEASURES`].
    pub const ALL: [Self; 8] = [
        Self::Holes,
        Self::WrongChart,
        Self::OutOfRange,
        Self::NotFinite,
        Self::RoundTrip,
        Self::Forward,
        Self::SeamJump,
        Self::Fall,
    ];

    /// The word in reports.
    pub const fn id(self) -> &'static str {
        MEASURES[self as usize]
    }
}

/// The names of the measures, in order.
pub const MEASURES: [&str; 8] = [
    "holes",
    "wrong_chart",
    "out_of_range",
    "not_finite",
    "max_round_trip_rad",
    "max_forward_rad",
    "max_seam_jump_texels",
    "max_fall_ulp",
];

impl Measures {
    /// Of the numbers in the order of [`MEASURES`].
    fn from_numbers(numbers: [f64; 8]) -> Self {
        // Counts of inputs: f64 holds them exactly.
        let [holes, wrong_chart, out_of_range, not_finite] =
            [0, 1, 2, 3].map(|k: usize| numbers[k] as u64);
        Self {
            holes,
            wrong_chart,
            out_of_range,
            not_finite,
            max_round_trip_rad: numbers[4],
            max_forward_rad: numbers[5],
            max_seam_jump_texels: numbers[6],
            max_fall_ulp: numbers[7],
        }
    }

    /// The number of one measure.
    pub fn number(&self, measure: Measure) -> f64 {
        self.numbers()[measure as usize]
    }

    /// The numbers in the order of [`MEASURES`].
    pub fn numbers(&self) -> [f64; 8] {
        [
            self.holes as f64,
            self.wrong_chart as f64,
            self.out_of_range as f64,
            self.not_finite as f64,
            self.max_round_trip_rad,
            self.max_forward_rad,
            self.max_seam_jump_texels,
            self.max_fall_ulp,
        ]
    }
}

/// One evaluator on one family.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Id of the mapping.
    pub mapping: &'static str,
    /// Id of the evaluator.
    pub evaluator: &'static str,
    /// `cpu`, or the adapter's name.
    pub device: String,
    /// The inputs.
    pub family: Family,
    /// How many of them the mapping covers.
    pub n: usize,
    /// What was seen.
    #[serde(flatten)]
    pub observed: Measures,
    /// The input of the worst case as the bits of three f32: what broke first, else the largest forward error.
    pub worst: [String; 3],
    /// The input of each measure's worst case, in the order of [`Measure::ALL`]; `None` where nothing is wrong at all.
    #[serde(skip)]
    pub worst_of: [Option<[f32; 3]>; 8],
    /// What is allowed.
    pub allowed: Measures,
    /// The measures that are known to be worse than allowed, with the reason.
    pub expected_fault: Option<String>,
    /// Whether more is wrong than is allowed or expected, or something expected is not.
    pub broken: bool,
    /// What is wrong, in words.
    pub fault: Option<String>,
}

/// How a measure stands to what is promised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Within what is allowed.
    Kept,
    /// Over it, as it is known to be.
    Known,
    /// Over it.
    Broken,
    /// Within it, though it is known to be over it on these inputs.
    Gone,
}

impl Row {
    /// How one measure stands.
    pub fn standing(&self, measure: Measure) -> Standing {
        let [observed, allowed] = [self.observed, self.allowed].map(|m| m.number(measure));
        match (observed > allowed, self.known(measure)) {
            (true, Some(_)) => Standing::Known,
            (true, None) => Standing::Broken,
            (false, Some(known)) if known.families.contains(&self.family) => Standing::Gone,
            (false, _) => Standing::Kept,
        }
    }

    /// What is known to be wrong with the evaluator in a measure.
    pub fn known(&self, measure: Measure) -> Option<&'static Expectation> {
        budgets::known(self.mapping, self.evaluator, measure)
    }
}

/// How much is asked.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The mappings.
    pub maps: Vec<MappingId>,
    /// Where their evaluators run.
    pub devices: Devices,
    /// Inputs of each family, where they can be counted.
    pub effort: usize,
}

impl Plan {
    /// A few minutes on two cores.
    pub fn full() -> Self {
        Self {
            maps: MappingId::ALL.to_vec(),
            devices: Devices::Both,
            effort: 300_000,
        }
    }

    /// Some seconds on two cores.
    pub fn quick() -> Self {
        Self {
            effort: 10_000,
            ..Self::full()
        }
    }
}

/// Asks one evaluator of the processor, in the list or not, on one family.
///
/// # Errors
/// When it is a shader.
pub fn ask(
    map: MappingId,
    evaluator: &EvaluatorInfo,
    family: Family,
    effort: usize,
) -> Result<Row, EvaluatorError> {
    let Some(processor) = evaluator.processor() else {
        return Err(EvaluatorError::NoDevice(format!(
            "`{}` is one",
            evaluator.id
        )));
    };
    ask_of(
        map,
        evaluator,
        &processor.on(Isa::best()),
        CPU,
        family,
        effort,
    )
}

/// Asks what computes an evaluator on a device.
///
/// # Errors
/// When the device fails.
pub fn ask_of(
    map: MappingId,
    evaluator: &EvaluatorInfo,
    computed: &dyn Evaluator,
    device: &str,
    family: Family,
    effort: usize,
) -> Result<Row, EvaluatorError> {
    let asked = Asked {
        info: evaluator,
        computed,
        device,
    };
    Subject::new(map, family, &family.inputs(effort), effort).row(asked)
}

/// Runs the plan, the processor's evaluators on all cores; ends early, with what there is, when the progress is cancelled.
/// Without an adapter shaders are left out.
pub fn stress(plan: &Plan, device: &dyn Device, progress: &Progress) -> Outcome<Row> {
    progress.enter(Stage::Measuring);
    let families = Family::ALL;
    let inputs: Vec<_> = families.iter().map(|f| f.inputs(plan.effort)).collect();
    let adapter = plan.devices.open(device);
    let adapter_name = adapter.as_ref().and_then(|a| Some(&*a.as_ref().ok()?.name));
    let takes_part = |evaluator: &&EvaluatorInfo| {
        plan.devices.include(evaluator) && (adapter_name.is_some() || evaluator.form().is_none())
    };
    let evaluators = |map: &MappingId| map.evaluators().iter().filter(takes_part);
    let total = plan.maps.iter().map(|map| evaluators(map).count());
    let total = total.sum::<usize>() * families.len();
    let done = AtomicUsize::new(0);
    let step = || progress.step(done.fetch_add(1, Ordering::Relaxed) + 1, total);
    let (mut rows, mut faults) = (Vec::new(), Vec::new());
    for map in &plan.maps {
        let of_processor: Vec<_> = evaluators(map)
            .filter_map(|info| Some((info, info.processor()?)))
            .collect();
        let mut shaders = Vec::new();
        for info in evaluators(map).filter(|info| info.form().is_some()) {
            match info.start(*map, device) {
                Ok(shader) => shaders.push((info, shader)),
                Err(error) => faults.push(format!("{map} by {}: {error}", info.id)),
            }
        }
        for (family, inputs) in families.iter().zip(&inputs) {
            let subject = Subject::new(*map, *family, inputs, plan.effort);
            let found = of_processor.par_iter().map(|(info, processor)| {
                let asked = Asked {
                    info,
                    computed: &processor.on(Isa::best()),
                    device: CPU,
                };
                let row = (!progress.is_cancelled()).then(|| subject.row(asked));
                step();
                row
            });
            let mut found: Vec<_> = found.collect();
            // The adapter does one thing at a time.
            for (info, shader) in &shaders {
                let asked = Asked {
                    info,
                    computed: &**shader,
                    device: adapter_name.unwrap_or_default(),
                };
                found.push((!progress.is_cancelled()).then(|| subject.row(asked)));
                step();
            }
            for row in found.into_iter().flatten() {
                match row {
                    Ok(row) => rows.push(row),
                    Err(error) => faults.push(format!("{map} on {}: {error}", family.id())),
                }
            }
        }
    }
    Outcome {
        rows,
        adapter,
        faults,
    }
}
