//! Where shader forms run, for those who must not know how.

use std::time::Duration;

use super::evaluator::{Evaluator, EvaluatorError};
use super::slices::{Dirs, Points};
use super::{MappingId, ShaderForm};

/// A graphics adapter by its names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Adapter {
    /// What it is called and which interface it is reached through.
    pub name: String,
    /// Its driver.
    pub driver: String,
}

/// What a shader is timed on.
#[derive(Clone, Copy, Debug)]
pub enum Work<'a> {
    /// Chart points of these directions.
    Forward(Dirs<'a>),
    /// Directions of these chart points.
    Inverse(Points<'a>),
}

/// Nanoseconds that a device took once for some work, and for a plain copy of the same words right after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceTime {
    /// The work.
    pub work_ns: f64,
    /// The copy.
    pub copy_ns: f64,
}

/// A compiled shader form of one mapping.
pub trait Shader: Evaluator {
    /// Times the work as often as `samples` says, each time repeated until it takes `shortest`. The words stay on the device:
    /// neither their way there nor that of the results counts.
    fn time(
        &self,
        work: Work<'_>,
        samples: usize,
        shortest: Duration,
    ) -> Result<Vec<DeviceTime>, EvaluatorError>;
}

/// Runs shaders. Nothing is opened before something is asked of it.
pub trait Device: Send + Sync {
    /// Who computes, or why nobody does.
    fn adapter(&self) -> Result<Adapter, EvaluatorError>;

    /// Compiles a form.
    fn shader(&self, map: MappingId, form: ShaderForm) -> Result<Box<dyn Shader>, EvaluatorError>;
}

/// No device, and why.
#[derive(Clone, Copy, Debug)]
pub struct NoDevice(pub &'static str);

impl NoDevice {
    fn error(self) -> EvaluatorError {
        EvaluatorError::NoDevice(self.0.to_owned())
    }
}

impl Device for NoDevice {
    fn adapter(&self) -> Result<Adapter, EvaluatorError> {
        Err(self.error())
    }

    fn shader(&self, _: MappingId, _: ShaderForm) -> Result<Box<dyn Shader>, EvaluatorError> {
        Err(self.error())
    }
}
