//! The laboratory of run time against error: what was measured on this machine, and which evaluator is used.

mod choices;
mod panel;
mod picture;
mod plot;
mod table;
mod words;

use std::sync::Arc;

use egui::Context;

pub use panel::laboratory_ui;
pub use picture::{ErrorPicture, ShownErrors, Wanted};
pub use plot::{free_place, look, paint_marker};
pub use words::{budget_text, measured_text, readout, used_text};

use super::job::{Job, Outcome};
use super::labs::Lab;
use super::map_panel::window_of;
use super::model::JobLine;
use super::object::{Jobs, job_line};
use super::panel_view::rect_of_size;
use super::state::{AppState, FormState};
use super::views::ViewKey;
use crate::gpu::ShaderDevice;
use crate::imaging::Progress;
use crate::lab::bench::{CPU, Plan, Row, Way, bench};
use crate::lab::choice::{Choice, allowed_texels, cheapest, choices, fastest, pixels_per_texel};
use crate::lab::inputs::Inputs;
use crate::lab::machine::Machine;
use crate::mapping::evaluator::EvaluatorInfo;
use crate::mapping::{MappingId, ShaderForm};

/// What a run has measured.
#[derive(Debug)]
pub struct Measured {
    /// Every measurement.
    pub rows: Vec<Row>,
    /// On what, and when.
    pub machine: Machine,
}

impl Measured {
    /// Measures, shaders on a device of their own, which keeps the window's free; `None` when it is cancelled.
    fn of(plan: &Plan, progress: &Progress) -> Option<Self> {
        let outcome = bench(plan, &ShaderDevice::new(), progress);
        let adapter = outcome.adapter.as_ref().and_then(|a| a.as_ref().ok());
        let machine = Machine::this(adapter);
        (!progress.is_cancelled()).then_some(Self {
            rows: outcome.rows,
            machine,
        })
    }
}

/// What the pane measures: all inputs, because an evaluator that is used must be near enough on each.
fn plan(state: &AppState) -> Plan {
    let careful = if state.laboratory.full {
        Plan::full()
    } else {
        Plan::quick()
    };
    Plan {
        maps: state.laboratory.maps(state.mapping),
        inputs: Inputs::ALL.to_vec(),
        ..careful
    }
}

/// The last measurement, and the job that makes the next one.
#[derive(Default)]
pub struct BenchLab {
    measured: Option<Arc<Measured>>,
    job: Option<Job<Option<Measured>>>,
    fault: Option<String>,
    /// Where the used evaluator errs.
    pub errors: ErrorPicture,
}

impl BenchLab {
    /// Measures what the state asks for; a measurement that is under way is dropped.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn measure(&mut self, state: &AppState, jobs: &mut Jobs<'_>) -> Result<(), String> {
        let plan = plan(state);
        let title = "run time and error".to_owned();
        self.fault = None;
        self.job = Some(jobs.start(title, move |progress| Measured::of(&plan, progress))?);
        Ok(())
    }

    /// The last measurement.
    pub fn measured(&self) -> Option<&Arc<Measured>> {
        self.measured.as_ref()
    }

    /// Shows measurements that were made elsewhere.
    pub fn show(&mut self, measured: impl Into<Arc<Measured>>) {
        self.measured = Some(measured.into());
    }

    /// Every measurement.
    pub fn rows(&self) -> &[Row] {
        self.measured.as_ref().map_or(&[], |m| &m.rows)
    }

    /// True while it measures.
    pub fn is_measuring(&self) -> bool {
        self.job.is_some()
    }

    /// Why the last run brought nothing.
    pub fn fault(&self) -> Option<&str> {
        self.fault.as_deref()
    }
}

impl Lab for BenchLab {
    fn poll(&mut self, _: &Context) {
        self.errors.poll();
        let Some(job) = self.job.take() else {
            return;
        };
        match job.poll() {
            Outcome::Running => self.job = Some(job),
            Outcome::Done(Some(measured)) => self.show(measured),
            Outcome::Done(None) | Outcome::Failed => {
                self.fault = Some("measuring ended without a result".to_owned());
            }
        }
    }

    fn jobs(&self) -> Vec<JobLine> {
        let own = self.job.iter().map(job_line);
        own.chain(self.errors.job()).collect()
    }

    fn cancel(&mut self, id: u64) {
        if self.job.take_if(|job| job.id == id).is_some() {
            self.fault = Some("measuring was cancelled".to_owned());
        }
        self.errors.cancel(id);
    }
}

/// The evaluator that is used for a mapping.
#[derive(Clone, Copy, Debug)]
pub struct Used<'a> {
    /// Which it is.
    pub evaluator: &'static EvaluatorInfo,
    /// Its time and its error; `None` where they were not measured.
    pub measured: Option<Choice<'a>>,
    /// The budget chose it, not the user.
    pub by_budget: bool,
}

impl<'a> Used<'a> {
    /// The cheapest within the budget while that is switched on and something measured is within it, else the chosen one; where
    /// a texel takes so many pixels.
    pub fn of(state: &AppState, rows: &'a [Row], map: MappingId, pixels: f64) -> Option<Self> {
        let forward = lookups(rows, map, |device| device == CPU);
        if let Some(choice) = within_budget(state, &forward, map, pixels)
            && let Some(evaluator) = map.evaluator(choice.row.evaluator)
        {
            return Some(Self {
                evaluator,
                measured: Some(choice),
                by_budget: true,
            });
        }
        let evaluator = state.laboratory.chosen(map)?;
        let own = forward
            .into_iter()
            .filter(|row| row.evaluator == evaluator.id);
        let own: Vec<&Row> = own.collect();
        Some(Self {
            evaluator,
            measured: fastest(choices(&own, chart_rows(state, map))),
            by_budget: false,
        })
    }
}

/// A mapping's cheapest lookup on the processor within the error budget, whether or not that chooses what is used: costs of several mappings
/// are compared at the same error.
pub fn cheapest_lookup<'a>(
    state: &AppState,
    rows: &'a [Row],
    map: MappingId,
) -> Option<Choice<'a>> {
    let forward = lookups(rows, map, |device| device == CPU);
    let allowed = state.laboratory.budget_texels;
    cheapest(&forward, chart_rows(state, map), allowed)
}

/// The form in which the viewport runs the mapping's shader: the cheapest on the adapter within the budget while that is switched on
/// and something measured is within it, else the chosen one.
pub fn used_form(state: &AppState, rows: &[Row], pixels: f64) -> FormState {
    let map = state.mapping;
    let on_adapter = lookups(rows, map, |device| device != CPU);
    let within = within_budget(state, &on_adapter, map, pixels);
    let form = within.and_then(|choice| ShaderForm::from_id(choice.row.evaluator));
    FormState {
        form: form.unwrap_or_else(|| map.form_or_precise(state.form.form)),
        ..state.form
    }
}

/// The measurements of a mapping's lookups on some devices.
fn lookups(rows: &[Row], map: MappingId, is_wanted: impl Fn(&str) -> bool) -> Vec<&Row> {
    let id = map.info().id;
    let is_of =
        |row: &&Row| row.mapping == id && row.direction == Way::Forward && is_wanted(&row.device);
    rows.iter().filter(is_of).collect()
}

/// The cheapest of a mapping's lookups within the budget, while that is switched on.
fn within_budget<'a>(
    state: &AppState,
    lookups: &[&'a Row],
    map: MappingId,
    pixels: f64,
) -> Option<Choice<'a>> {
    let laboratory = &state.laboratory;
    let allowed = allowed_texels(laboratory.budget_texels, pixels);
    laboratory
        .budget_on
        .then(|| cheapest(lookups, chart_rows(state, map), allowed))?
}

/// Texels along the height of a mapping's charts.
fn chart_rows(state: &AppState, map: MappingId) -> u32 {
    crate::gpu::map_size(map, state.texel_budget)[1]
}

/// Screen pixels that a texel of `map` takes in the views that were laid out, where it takes most: in the sky of the viewport, or
/// in the mapping's own panel. 0 where it is not seen.
pub fn largest_pixels_per_texel(
    state: &AppState,
    laid_out: &[(ViewKey, [u32; 2])],
    map: MappingId,
) -> f64 {
    let rows = chart_rows(state, map);
    let pixels = |(key, [width, height]): &(ViewKey, [u32; 2])| match *key {
        ViewKey::Viewport => {
            let fov_y_rad = f64::from(state.camera.sanitized().fov_y_rad);
            pixels_per_texel(map, rows, fov_y_rad, f64::from(*height))
        }
        ViewKey::Panel(shown) if shown == map => {
            let rect = rect_of_size(*width as f32, *height as f32);
            let window = window_of(&state.panel(map), rect);
            let [top, bottom] = [0.0, 1.0].map(|y| window.screen_from_picture([0.0, y]).y);
            let charts = map.info().layout.grid()[1];
            f64::from(bottom - top) / f64::from(charts * rows)
        }
        ViewKey::Panel(_) => 0.0,
    };
    laid_out.iter().map(pixels).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::action::{Action, apply};
    use crate::app::state::PanelState;
    use crate::lab::clock::Clock;
    use crate::lab::devices::Devices;
    use crate::mapping::NoDevice;
    use crate::mapping::evaluator::{REFERENCE, SINGLE};

    /// Measurements whose times are not to be trusted, with errors that are.
    fn rows() -> Vec<Row> {
        let plan = Plan {
            maps: vec![MappingId::Ccm],
            inputs: Inputs::ALL.to_vec(),
            few: 64,
            many: 64,
            judged: 1024,
            clock: Clock {
                samples: 1,
                shortest: std::time::Duration::ZERO,
            },
            devices: Devices::Cpu,
            ..Plan::full()
        };
        let mut rows = bench(&plan, &NoDevice("not asked"), &Progress::new()).rows;
        // A time for each evaluator: the coarser, the faster.
        for row in &mut rows {
            row.ns = 1.0 - row.max_error_texels.log10();
        }
        rows
    }

    fn used(state: &AppState, rows: &[Row], pixels: f64) -> (&'static str, bool, bool) {
        let used = Used::of(state, rows, MappingId::Ccm, pixels).unwrap();
        (used.evaluator.id, used.measured.is_some(), used.by_budget)
    }

    #[test]
    fn the_budget_chooses_only_where_it_is_on_and_something_was_measured() {
        let rows = rows();
        let mut state = AppState::default();
        assert_eq!(used(&state, &[], 1.0), (SINGLE, false, false));
        assert_eq!(used(&state, &rows, 1.0), (SINGLE, true, false));
        let reference = (MappingId::Ccm, REFERENCE.to_owned());
        apply(&mut state, Action::UseEvaluator(reference.0, reference.1));
        assert_eq!(used(&state, &rows, 1.0), (REFERENCE, true, false));
        state.laboratory.budget_on = true;
        state.laboratory.budget_texels = 0.05;
        assert_eq!(used(&state, &[], 1.0), (REFERENCE, false, false));
        let (within, ..) = used(&state, &rows, 1.0);
        let error = |id: &str| {
            let own = rows
                .iter()
                .filter(|row| row.evaluator == id && row.direction == Way::Forward);
            let size = crate::gpu::map_size(MappingId::Ccm, state.texel_budget)[1];
            own.map(|row| row.error_texels_at(size)).fold(0.0, f64::max)
        };
        assert!(error(within) <= 0.05 && error(within) > 0.0005, "{within}");
        assert!(used(&state, &rows, 1.0).2);
        // A texel on a hundred pixels needs a hundred times as much.
        let (magnified, ..) = used(&state, &rows, 100.0);
        assert!(error(magnified) <= 0.0005, "{magnified}");
        assert_ne!(magnified, within);
        // Nothing is within this: the chosen one stays.
        assert_eq!(used(&state, &rows, 1e9), (REFERENCE, true, false));
    }

    #[test]
    fn the_budget_chooses_the_viewports_form_among_what_the_adapter_ran() {
        let own = rows();
        let on_adapter = |form: ShaderForm, ns: f64, max_error_texels: f64| Row {
            evaluator: form.id(),
            device: "an adapter".to_owned(),
            isa: crate::lab::bench::SHADER,
            ns,
            max_error_texels,
            holes: 0,
            ..own[0].clone()
        };
        let mut all = own.clone();
        all.push(on_adapter(ShaderForm::Own7, 1.0, 0.1));
        all.push(on_adapter(ShaderForm::Precise, 2.0, 1e-4));
        let mut state = AppState::default();
        state.form.form = ShaderForm::Table;
        let form = |state: &AppState, rows: &[Row]| used_form(state, rows, 1.0).form;
        assert_eq!(form(&state, &all), ShaderForm::Table);
        state.laboratory.budget_on = true;
        state.laboratory.budget_texels = 0.5;
        assert_eq!(form(&state, &all), ShaderForm::Own7);
        state.laboratory.budget_texels = 0.01;
        assert_eq!(form(&state, &all), ShaderForm::Precise);
        // The processor's times say nothing of a shader.
        assert_eq!(form(&state, &own), ShaderForm::Table);
    }

    #[test]
    fn a_texel_takes_the_pixels_that_it_is_seen_with() {
        let mut state = AppState::default();
        let map = MappingId::Cube;
        let views = [
            (ViewKey::Viewport, [800, 400]),
            (ViewKey::Panel(map), [400, 300]),
            (ViewKey::Panel(MappingId::Eac), [4000, 3000]),
        ];
        let pixels =
            |state: &AppState, count: usize| largest_pixels_per_texel(state, &views[..count], map);
        assert_eq!(pixels(&state, 0), 0.0);
        let sky = pixels(&state, 1);
        assert!(sky > 0.0 && (pixels(&state, 3) - sky).abs() < 1e-12);
        // A cross of three rows of 512 texels, which fits into 96 hundredths of 300 pixels, magnified.
        let view = PanelState {
            zoom: 100.0,
            ..state.panel(map)
        };
        apply(&mut state, Action::SetPanelView(view));
        let panel = 0.96 * 300.0 / (3.0 * 512.0) * 100.0;
        assert!((pixels(&state, 2) / panel - 1.0).abs() < 1e-4);
        assert!((pixels(&state, 1) - sky).abs() < 1e-12, "control");
        state.camera.fov_y_rad *= 0.5;
        assert!(pixels(&state, 1) > 1.9 * sky);
    }
}
