//! Evaluators: the ways to compute one mapping, each with its own speed and error.

use std::sync::LazyLock;

use super::lane_forms::{self, LaneForm};
use super::slices::{DirList, Dirs, DirsMut, PointList, Points, PointsMut};
use super::{ChartPoint, Device, ForwardFn, InverseFn, Mapping, MappingId, ShaderForm};
use crate::math::approximation::{
    Arctangent, Hastings9, Hastings17, LEVELS, Lagarde, Own, Pbrt, Published, Rajan2, Rajan3,
    Rational, SineCosine, Table,
};
use crate::math::{Isa, Library, Real, Vec3};

/// Computes a mapping on slices: one dynamic call a batch, never one a direction.
pub trait Evaluator {
    /// Chart points of directions, [`NOWHERE`](super::NOWHERE) where a vector is no direction; stops at the shorter of the two.
    fn forward(&self, dirs: Dirs<'_>, points: PointsMut<'_>) -> Result<(), EvaluatorError>;

    /// Unit directions of chart points, the zero vector off the chart.
    fn inverse(&self, points: Points<'_>, dirs: DirsMut<'_>) -> Result<(), EvaluatorError>;
}

/// Why an evaluator could not run.
#[derive(Clone, Debug, thiserror::Error)]
pub enum EvaluatorError {
    /// Nothing here runs shaders.
    #[error("no shader runs here: {0}")]
    NoDevice(String),
    /// The device behind it failed.
    #[error("the device failed: {0}")]
    Device(String),
    /// The form has none.
    #[error("this evaluator has no inverse")]
    WithoutInverse,
}

/// Computes chart points of directions; stops at the shorter of the two. Takes the instructions that it may use.
pub type Forward = Box<dyn Fn(Isa, Dirs<'_>, PointsMut<'_>) + Send + Sync>;
/// Computes unit directions of chart points; the zero vector off the chart.
pub type Inverse = Box<dyn Fn(Isa, Points<'_>, DirsMut<'_>) + Send + Sync>;

/// One way to compute a mapping.
pub struct EvaluatorInfo {
    /// Name on the command line.
    pub id: &'static str,
    /// What it is.
    pub about: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// What computes it.
    pub runs: Runs,
}

/// What computes an evaluator.
pub enum Runs {
    /// The processor.
    Processor(Processor),
    /// A graphics adapter; see [`Device`].
    Shader(ShaderForm),
}

/// An evaluator's functions on the processor.
pub struct Processor {
    /// Whether it is compiled for each set of instructions: else it computes one direction after the other.
    pub is_vector: bool,
    /// Forward in f32.
    pub forward: Forward,
    /// Inverse in f32, where the form has one.
    pub inverse: Option<Inverse>,
}

impl EvaluatorInfo {
    /// Its functions, where the processor computes it.
    pub const fn processor(&self) -> Option<&Processor> {
        match &self.runs {
            Runs::Processor(processor) => Some(processor),
            Runs::Shader(_) => None,
        }
    }

    /// Its form, where a shader computes it.
    pub const fn form(&self) -> Option<ShaderForm> {
        match &self.runs {
            Runs::Processor(_) => None,
            Runs::Shader(form) => Some(*form),
        }
    }

    /// Whether it goes back from chart points.
    pub const fn has_inverse(&self) -> bool {
        match &self.runs {
            Runs::Processor(processor) => processor.inverse.is_some(),
            Runs::Shader(form) => form.has_inverse(),
        }
    }

    /// Makes it ready to compute a mapping: a shader is compiled.
    ///
    /// # Errors
    /// When it is a shader, and the device cannot run it.
    pub fn start<'a>(
        &'a self,
        map: MappingId,
        device: &dyn Device,
    ) -> Result<Box<dyn Evaluator + 'a>, EvaluatorError> {
        match &self.runs {
            Runs::Processor(processor) => Ok(Box::new(processor.on(Isa::best()))),
            Runs::Shader(form) => Ok(device.shader(map, *form)?),
        }
    }
}

/// A processor's functions with the instructions that they use.
#[derive(Clone, Copy)]
pub struct OnProcessor<'a> {
    processor: &'a Processor,
    isa: Isa,
}

impl Evaluator for OnProcessor<'_> {
    fn forward(&self, dirs: Dirs<'_>, points: PointsMut<'_>) -> Result<(), EvaluatorError> {
        (self.processor.forward)(self.isa, dirs, points);
        Ok(())
    }

    fn inverse(&self, points: Points<'_>, dirs: DirsMut<'_>) -> Result<(), EvaluatorError> {
        let inverse = self.processor.inverse.as_ref();
        inverse.ok_or(EvaluatorError::WithoutInverse)?(self.isa, points, dirs);
        Ok(())
    }
}

impl Processor {
    /// As an evaluator, with these instructions.
    pub const fn on(&self, isa: Isa) -> OnProcessor<'_> {
        OnProcessor {
            processor: self,
            isa,
        }
    }

    /// The chart point of one direction.
    pub fn forward_one(&self, dir: Vec3<f32>) -> Option<ChartPoint<f32>> {
        let (dirs, mut points) = (DirList::from_iter([dir.to_array()]), PointList::zeros(1));
        (self.forward)(Isa::best(), dirs.view(), points.view_mut());
        points.view().get(0)
    }

    /// The direction of one chart point; `None` also where the form has no inverse.
    pub fn inverse_one(&self, point: ChartPoint<f32>) -> Option<Vec3<f32>> {
        let (points, mut dirs) = (PointList::from_iter([point]), DirList::zeros(1));
        (self.inverse.as_ref()?)(Isa::best(), points.view(), dirs.view_mut());
        dirs.view().get(0)
    }
}

impl std::fmt::Debug for EvaluatorInfo {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.id)
    }
}

/// A formula as the literature prints it, in f32.
pub(super) struct SeedForm {
    pub id: &'static str,
    pub about: &'static str,
    pub source: &'static str,
    /// `None` also where the form itself finds no chart.
    pub forward: ForwardFn<f32>,
    pub inverse: Option<InverseFn<f32>>,
}

/// Name of the evaluator that is used when none is asked for.
pub const SINGLE: &str = "f32";
/// Name of the evaluator that all others are measured against.
pub const REFERENCE: &str = "reference";

impl MappingId {
    /// Every way to compute this mapping, on the processor and by shaders: the only list of them. The shared ones come first.
    pub fn evaluators(self) -> &'static [EvaluatorInfo] {
        static LISTS: LazyLock<Vec<Vec<EvaluatorInfo>>> = LazyLock::new(|| {
            let list = |map: &MappingId| {
                let mut list = shared(*map);
                list.extend((map.info().evaluators)());
                list
            };
            MappingId::ALL.iter().map(list).collect()
        });
        LISTS.get(self as usize).map_or(&[], Vec::as_slice)
    }

    /// The evaluator of this name.
    pub fn evaluator(self, id: &str) -> Option<&'static EvaluatorInfo> {
        self.evaluators()
            .iter()
            .find(|evaluator| evaluator.id == id)
    }

    /// This form of the mapping's shader, or the precise one where the mapping does not have it.
    pub fn form_or_precise(self, form: ShaderForm) -> ShaderForm {
        self.evaluator(form.id())
            .and_then(EvaluatorInfo::form)
            .unwrap_or_default()
    }

    /// The forms of the mapping's shader, the nearest first.
    pub fn forms(self) -> impl Iterator<Item = ShaderForm> {
        let has = move |form: &ShaderForm| self.form_or_precise(*form) == *form;
        ShaderForm::ALL.into_iter().filter(has)
    }

    /// The functions of the evaluator of this name, where the processor computes it.
    pub fn processor(self, id: &str) -> Option<&'static Processor> {
        self.evaluator(id)?.processor()
    }
}

/// Those that every mapping has.
fn shared(map: MappingId) -> Vec<EvaluatorInfo> {
    fn of<R: Real>(map: MappingId, [id, about, source]: [&'static str; 3]) -> EvaluatorInfo {
        EvaluatorInfo {
            id,
            about,
            source,
            runs: Runs::Processor(Processor {
                is_vector: false,
                forward: Box::new(move |_, dirs, points| map.forward_in::<R>(dirs, points)),
                inverse: Some(Box::new(move |_, points, dirs| {
                    map.inverse_in::<R>(points, dirs)
                })),
            }),
        }
    }
    vec![
        of::<f32>(
            map,
            [
                SINGLE,
                "single precision, stable form, own arctangent; the default",
                "own",
            ],
        ),
        of::<f64>(
            map,
            [
                REFERENCE,
                "double precision, stable form, rounded once at the end",
                "own",
            ],
        ),
        of::<Library>(
            map,
            [
                "library",
                "single precision, stable form, the standard library's functions",
                "Rust's std, which calls the platform's C library",
            ],
        ),
        of_form(ShaderForm::Precise),
    ]
}

/// A form of the mapping's shader.
pub(super) fn of_form(form: ShaderForm) -> EvaluatorInfo {
    EvaluatorInfo {
        id: form.id(),
        about: form.about(),
        source: form.source(),
        runs: Runs::Shader(form),
    }
}

/// The shaders of a mapping with an arctangent, beyond the one that every mapping has.
pub(super) fn shaders_with_arctangents() -> Vec<EvaluatorInfo> {
    ShaderForm::OF_ANGLES.map(of_form).into()
}

/// The evaluators of a mapping without an arctangent: its form on vectors, and formulas as printed.
pub(super) fn plain_and<M: LaneForm>(seeds: &'static [SeedForm]) -> Vec<EvaluatorInfo> {
    let words = [
        "lanes",
        "single precision without a branch, many directions at once",
        "own",
    ];
    let mut list = vec![of_angles::<M, _>(words, Own::<{ LEVELS.len() - 1 }>)];
    list.extend(seeds.iter().map(of_seed));
    list
}

/// The evaluators of a mapping with an arctangent: its form on vectors with every approximation, and formulas as printed.
pub(super) fn with_arctangents_and<M: LaneForm>(seeds: &'static [SeedForm]) -> Vec<EvaluatorInfo> {
    let own = |level: usize| [LEVELS[level].id, LEVELS[level].about, "own"];
    let mut list = vec![
        of_angles::<M, _>(own(0), Own::<0>),
        of_angles::<M, _>(own(1), Own::<1>),
        of_angles::<M, _>(own(2), Own::<2>),
        of_angles::<M, _>(own(3), Own::<3>),
        of_angles::<M, _>(own(4), Own::<4>),
        of_angles::<M, _>(own(5), Own::<5>),
        of_angles::<M, _>(own(6), Own::<6>),
        of_angles::<M, _>(words_of(Hastings9), Hastings9),
        of_angles::<M, _>(words_of(Hastings17), Hastings17),
        of_arctangent::<M, _>(Rational),
        of_arctangent::<M, _>(Rajan2),
        of_arctangent::<M, _>(Rajan3),
        of_arctangent::<M, _>(Lagarde),
        of_arctangent::<M, _>(Pbrt),
    ];
    for (place, [linear, cubic]) in TABLES.into_iter().enumerate() {
        list.push(of_angles::<M, _>(linear, Table::<false>::of_size(place)));
        list.push(of_angles::<M, _>(cubic, Table::<true>::of_size(place)));
    }
    list.extend(shaders_with_arctangents());
    list.extend(seeds.iter().map(of_seed));
    list
}

/// Names of the tables of each size: id, about and source.
const TABLES: [[[&str; 3]; 2]; 4] = {
    const LINES: &str = "table over [0, 1], lines between its entries";
    const CUBICS: &str = "table over [0, 1], cubics through four of its entries";
    [
        [
            ["table-64", LINES, "own"],
            ["table-64-cubic", CUBICS, "own"],
        ],
        [
            ["table-256", LINES, "own"],
            ["table-256-cubic", CUBICS, "own"],
        ],
        [
            ["table-1024", LINES, "own"],
            ["table-1024-cubic", CUBICS, "own"],
        ],
        [
            ["table-4096", LINES, "own"],
            ["table-4096-cubic", CUBICS, "own"],
        ],
    ]
};

fn words_of<P: Published>(_: P) -> [&'static str; 3] {
    [P::ID, P::ABOUT, P::SOURCE]
}

fn of_angles<M: LaneForm, A: Arctangent + SineCosine>(
    words: [&'static str; 3],
    angles: A,
) -> EvaluatorInfo {
    on_lanes::<M, A>(
        words,
        angles,
        Some(Box::new(move |isa, points, dirs| {
            lane_forms::inverse::<M, A>(isa, angles, points, dirs);
        })),
    )
}

fn of_arctangent<M: LaneForm, A: Arctangent + Published>(arctangent: A) -> EvaluatorInfo {
    on_lanes::<M, A>(words_of(arctangent), arctangent, None)
}

fn on_lanes<M: LaneForm, A: Arctangent>(
    [id, about, source]: [&'static str; 3],
    arctangent: A,
    inverse: Option<Inverse>,
) -> EvaluatorInfo {
    EvaluatorInfo {
        id,
        about,
        source,
        runs: Runs::Processor(Processor {
            is_vector: true,
            forward: Box::new(move |isa, dirs, points| {
                lane_forms::forward::<M, A>(isa, arctangent, dirs, points);
            }),
            inverse,
        }),
    }
}

fn of_seed(seed: &'static SeedForm) -> EvaluatorInfo {
    let forward = seed.forward;
    EvaluatorInfo {
        id: seed.id,
        about: seed.about,
        source: seed.source,
        runs: Runs::Processor(Processor {
            is_vector: false,
            forward: Box::new(move |_, dirs, mut points| {
                for k in 0..dirs.len().min(points.len()) {
                    points.set(k, forward(dirs.at(k)));
                }
            }),
            inverse: seed.inverse.map(|inverse| -> Inverse {
                Box::new(move |_, points, mut dirs| {
                    for k in 0..points.len().min(dirs.len()) {
                        dirs.set(k, inverse(points.at(k)).map(Vec3::to_array));
                    }
                })
            }),
        }),
    }
}

/// See `MappingId::forward_in`.
pub(super) fn forward_in<R: Real, M: Mapping>(dirs: Dirs<'_>, mut points: PointsMut<'_>) {
    for k in 0..dirs.len().min(points.len()) {
        let Vec3 { x, y, z } = dirs.at(k);
        let point = M::forward(Vec3::new(wide::<R>(x), wide(y), wide(z)));
        points.set(
            k,
            point.map(|p| ChartPoint::new(p.chart, p.u.to_f64() as f32, p.v.to_f64() as f32)),
        );
    }
}

/// See `MappingId::inverse_in`.
pub(super) fn inverse_in<R: Real, M: Mapping>(points: Points<'_>, mut dirs: DirsMut<'_>) {
    for k in 0..points.len().min(dirs.len()) {
        let ChartPoint { chart, u, v } = points.at(k);
        // Whether an f32 point lies on a disc is decided in f32: a rounded rim point may lie just outside.
        let is_on = points.at(k).is_on(M::INFO.chart_count()) && M::INFO.domain.contains(u, v);
        let dir = is_on.then(|| M::continued(ChartPoint::new(chart, wide::<R>(u), wide(v))));
        dirs.set(k, dir.map(|d| d.to_f64().map(|c| c as f32)));
    }
}

fn wide<R: Real>(x: f32) -> R {
    R::from_f64(f64::from(x))
}
