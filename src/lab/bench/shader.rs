//! A shader's run time and errors.

use super::super::clock::Timing;
use super::{Row, SHADER, Subject, Way};
use crate::mapping::{EvaluatorError, Shader, ShaderForm, Work};

impl Subject<'_> {
    /// Both ways, on the adapter of this name.
    pub(super) fn measure_shader(
        &self,
        form: ShaderForm,
        shader: &dyn Shader,
        adapter: &str,
        rows: &mut Vec<Row>,
    ) -> Result<(), EvaluatorError> {
        for way in [Way::Forward, Way::Inverse] {
            if way == Way::Inverse && !form.has_inverse() {
                continue;
            }
            let n = self.plan.on_adapter;
            let (dirs, points) = (self.dirs(n), self.points(n));
            let work = match way {
                Way::Forward => Work::Forward(dirs.view()),
                Way::Inverse => Work::Inverse(points.view()),
            };
            let clock = self.plan.clock;
            let times = shader.time(work, clock.samples, clock.shortest)?;
            let timing = Timing::of(times.iter().map(|time| time.work_ns).collect());
            let ratios = times.iter().map(|time| time.work_ns / time.copy_ns);
            rows.push(Row {
                device: adapter.to_owned(),
                isa: SHADER,
                n,
                ns: timing.median_ns / n as f64,
                spread: timing.spread,
                copy_ratio: Timing::of(ratios.collect()).median_ns,
                ..self.row(form.id(), way, self.errors(shader, way)?)
            });
        }
        Ok(())
    }
}
