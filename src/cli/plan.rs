//! What `sixfold eval` is asked to compute, checked before the first line is read.

use super::CliError;
use super::csv::Precision;
use crate::mapping::evaluator::{REFERENCE, SINGLE};
use crate::mapping::{
    ChartPoint, Convention, Device, DirList, Evaluator, EvaluatorError, MappingId, MappingInfo,
    PointList,
};
use crate::math::Vec3;

/// Options of `sixfold eval`.
#[derive(Debug, clap::Args)]
pub(super) struct EvalOptions {
    /// Id of the mapping (`sixfold maps` lists them)
    pub(super) map: MappingId,
    /// Read chart,u,v and write unit directions
    #[arg(long)]
    pub(super) inverse: bool,
    /// Return a publication's own numbers for the same map
    #[arg(long, value_name = "NAME")]
    pub(super) convention: Option<String>,
    /// Compute it another way (`sixfold maps` lists them)
    #[arg(long, value_name = "NAME")]
    pub(super) evaluator: Option<String>,
    /// Number type of input and output
    #[arg(long, value_enum, default_value = "f32")]
    pub(super) precision: Precision,
}

/// Why a command line cannot be obeyed. Each message says what can be asked for.
#[derive(Debug, thiserror::Error)]
pub(super) enum PlanError {
    #[error("`{map}` has no convention `{name}`; it has: {known}")]
    UnknownConvention {
        map: MappingId,
        name: String,
        known: String,
    },
    #[error("`{map}` has no evaluator `{name}`; it has: {known}")]
    UnknownEvaluator {
        map: MappingId,
        name: String,
        known: String,
    },
    #[error("the convention `{0}` has no inverse; leave --inverse out")]
    ConventionWithoutInverse(&'static str),
    #[error("the evaluator `{0}` has no inverse; leave --inverse out")]
    EvaluatorWithoutInverse(&'static str),
    #[error("the evaluator `{0}` computes the app's own coordinates; leave --convention out")]
    EvaluatorWithoutConvention(&'static str),
    #[error("the evaluator `{0}` computes in f32; leave --precision f64 out, or take `reference`")]
    SingleOnly(&'static str),
}

/// The formula that is asked for.
enum Formula {
    Mapping(MappingId),
    Convention(&'static Convention),
    Own(Box<dyn Evaluator>),
}

/// Lines that a shader computes at once. On the processor nothing is gained by waiting for more than one.
const LINES_OF_SHADER: usize = 1 << 12;

/// What is computed, and in which number type.
pub(super) struct Plan {
    /// The mapping.
    pub(super) info: &'static MappingInfo,
    formula: Formula,
    /// Compute in f32; else in f64, rounding at the end to what the file holds.
    single: bool,
    /// Lines that are worth being computed at once.
    pub(super) lines: usize,
}

impl Plan {
    pub(super) fn new(options: &EvalOptions, device: &dyn Device) -> Result<Self, CliError> {
        let mut lines = 1;
        let map = options.map;
        let info = map.info();
        let mut formula = Formula::Mapping(map);
        if let Some(name) = &options.convention {
            let found = info.convention(name);
            let convention = found.ok_or_else(|| PlanError::UnknownConvention {
                map,
                name: name.clone(),
                known: list(info.conventions.iter().map(|c| c.id)),
            })?;
            if options.inverse && convention.inverse.is_none() {
                return Err(PlanError::ConventionWithoutInverse(convention.id).into());
            }
            formula = Formula::Convention(convention);
        }
        let double = options.precision == Precision::F64;
        let single = match options.evaluator.as_deref() {
            None => !double,
            Some(REFERENCE) => false,
            Some(SINGLE) if double => return Err(PlanError::SingleOnly(SINGLE).into()),
            Some(SINGLE) => true,
            Some(name) => {
                let own = map
                    .evaluator(name)
                    .ok_or_else(|| PlanError::UnknownEvaluator {
                        map,
                        name: name.to_owned(),
                        known: list(map.evaluators().iter().map(|own| own.id)),
                    })?;
                if options.inverse && !own.has_inverse() {
                    return Err(PlanError::EvaluatorWithoutInverse(own.id).into());
                }
                if options.convention.is_some() {
                    return Err(PlanError::EvaluatorWithoutConvention(own.id).into());
                }
                if double {
                    return Err(PlanError::SingleOnly(own.id).into());
                }
                if own.form().is_some() {
                    lines = LINES_OF_SHADER;
                }
                formula = Formula::Own(own.start(map, device)?);
                true
            }
        };
        Ok(Self {
            info,
            formula,
            single,
            lines,
        })
    }

    /// Names of the three numbers of a chart point.
    pub(super) fn columns(&self) -> [&'static str; 3] {
        match &self.formula {
            Formula::Convention(convention) => convention.columns,
            _ => ["chart", "u", "v"],
        }
    }

    /// The chart points of directions; `None` where the formula finds none.
    pub(super) fn forward(
        &self,
        dirs: &[[f64; 3]],
    ) -> Result<Vec<Option<ChartPoint<f64>>>, EvaluatorError> {
        let Formula::Own(evaluator) = &self.formula else {
            return Ok(dirs.iter().map(|dir| self.forward_one(*dir)).collect());
        };
        let single = dirs.iter().map(|dir| dir.map(|c| c as f32));
        let (dirs, mut points) = (DirList::from_iter(single), PointList::zeros(dirs.len()));
        evaluator.forward(dirs.view(), points.view_mut())?;
        let points = points.view();
        let found = (0..points.len()).map(|k| points.get(k).map(ChartPoint::to_f64));
        Ok(found.collect())
    }

    fn forward_one(&self, dir: [f64; 3]) -> Option<ChartPoint<f64>> {
        let (single, double) = (Vec3::<f32>::from_f64(dir), Vec3::<f64>::from_f64(dir));
        let point = match (&self.formula, self.single) {
            (Formula::Mapping(map), false) => return map.forward(double),
            (Formula::Convention(convention), false) => return convention.forward.1(double),
            (Formula::Mapping(map), true) => map.forward(single),
            (Formula::Convention(convention), true) => convention.forward.0(single),
            (Formula::Own(_), _) => None,
        };
        point.map(ChartPoint::to_f64)
    }

    /// The directions of chart points; `None` off the chart.
    pub(super) fn inverse(
        &self,
        points: &[ChartPoint<f64>],
    ) -> Result<Vec<Option<[f64; 3]>>, EvaluatorError> {
        let Formula::Own(evaluator) = &self.formula else {
            return Ok(points
                .iter()
                .map(|point| self.inverse_one(*point))
                .collect());
        };
        let list = PointList::from_iter(points.iter().map(|point| in_single(*point)));
        let mut dirs = DirList::zeros(points.len());
        evaluator.inverse(list.view(), dirs.view_mut())?;
        let dirs = dirs.view();
        let found = (0..dirs.len()).map(|k| dirs.get(k).map(Vec3::to_f64));
        Ok(found.collect())
    }

    fn inverse_one(&self, point: ChartPoint<f64>) -> Option<[f64; 3]> {
        if self.single {
            let point = in_single(point);
            return match &self.formula {
                Formula::Mapping(map) => map.inverse(point),
                Formula::Convention(convention) => (convention.inverse?.0)(point),
                Formula::Own(_) => None,
            }
            .map(Vec3::to_f64);
        }
        let point = self.on_disc(point);
        match &self.formula {
            Formula::Mapping(map) => map.inverse(point),
            Formula::Convention(convention) => (convention.inverse?.1)(point),
            Formula::Own(_) => None,
        }
        .map(Vec3::to_f64)
    }

    /// A rim point that was rounded to f32 may lie outside of the disc by more than f64 allows: it stands for the nearest
    /// point of the rim.
    fn on_disc(&self, point: ChartPoint<f64>) -> ChartPoint<f64> {
        let domain = self.info.domain;
        let in_f32 = domain.contains(point.u as f32, point.v as f32);
        if domain.contains(point.u, point.v) || !in_f32 {
            return point;
        }
        let (p, q) = (point.u - 0.5, point.v - 0.5);
        let diameter = 2.0 * p.hypot(q);
        ChartPoint::new(point.chart, 0.5 + p / diameter, 0.5 + q / diameter)
    }
}

fn in_single(point: ChartPoint<f64>) -> ChartPoint<f32> {
    ChartPoint::new(point.chart, point.u as f32, point.v as f32)
}

fn list(ids: impl Iterator<Item = &'static str>) -> String {
    let ids: Vec<&str> = ids.collect();
    if ids.is_empty() {
        "none".to_owned()
    } else {
        ids.join(", ")
    }
}
