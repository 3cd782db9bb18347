//! The stability laboratory: where each way to compute the selected mapping breaks, as a table that is measured when it is asked
//! for, and as the picture of a microscope that follows the state while it is seen.

use std::sync::Arc;

use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};

use super::follower::Follower;
use super::job::{Job, Outcome};
use super::labs::Lab;
use super::model::JobLine;
use super::object::{Jobs, job_line};
use crate::gpu::ShaderDevice;
use crate::imaging::Progress;
use crate::lab::stress::microscope::{Picture, View, look};
use crate::lab::stress::palette::colour;
use crate::lab::stress::{Plan, Row, stress};
use crate::mapping::{Device, MappingId};

/// What was measured of a mapping.
pub struct Table {
    /// The mapping.
    pub mapping: MappingId,
    /// Every evaluator on every family, as [`stress`] gives them.
    pub rows: Vec<Row>,
}

impl Table {
    fn of(mapping: MappingId, device: &dyn Device, progress: &Progress) -> Self {
        let plan = Plan {
            maps: vec![mapping],
            ..Plan::quick()
        };
        Self {
            mapping,
            rows: stress(&plan, device, progress).rows,
        }
    }
}

/// What the microscope shows.
pub struct Shown {
    /// What was seen.
    pub picture: Picture,
    /// It in colours.
    pub texture: TextureHandle,
}

impl Shown {
    fn of(view: &View, device: &dyn Device, ctx: &Context, progress: &Progress) -> Option<Self> {
        let picture = look(view, device, progress)?;
        let pixels = picture.pixels.iter().map(|pixel| {
            let [r, g, b] = colour(pixel.verdict, pixel.error_rad);
            Color32::from_rgb(r, g, b)
        });
        let image = ColorImage::new(picture.view.size, pixels.collect());
        // Pixels are seen as they are, also while a picture of another magnification stands in.
        let texture = ctx.load_texture("microscope", image, TextureOptions::NEAREST);
        Some(Self { picture, texture })
    }
}

/// The last table and the last picture, and the jobs that make the next ones. The table is measured when it is asked for, so that
/// it follows no wish.
#[derive(Default)]
pub struct StabilityLab {
    /// Runs the shaders among the evaluators, beside the window's own device.
    device: Arc<ShaderDevice>,
    table: Option<Table>,
    measuring: Option<Job<Table>>,
    microscope: Follower<View, Shown>,
}

impl StabilityLab {
    /// Starts to measure the table of a mapping; what was being measured is left.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn measure(&mut self, mapping: MappingId, jobs: &mut Jobs<'_>) -> Result<(), String> {
        let title = format!("asking {} where it breaks", mapping.info().name);
        let device = Arc::clone(&self.device);
        let job = jobs.start(title, move |progress| {
            Table::of(mapping, &*device, progress)
        })?;
        self.measuring = Some(job);
        Ok(())
    }

    /// Looks at what is wanted and not there. A picture that is under way is not given up for a little drag, or a drag would
    /// show none; `None`: nobody looks.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(&mut self, wanted: Option<View>, jobs: &mut Jobs<'_>) -> Result<(), String> {
        let of = |view: &View| (view.map, view.evaluator);
        let making = self.microscope.making();
        let wanted = wanted.map(|view| match making {
            Some(making) if of(making) == of(&view) => *making,
            _ => view,
        });
        let (device, ctx) = (Arc::clone(&self.device), jobs.ctx.clone());
        let make = move |view: &View, progress: &_| Shown::of(view, &*device, &ctx, progress);
        let title = "looking through the microscope";
        self.microscope.follow(wanted, title, jobs, make)
    }

    /// Looks at once: for pictures.
    pub fn look_now(&mut self, wanted: Option<View>, ctx: &Context) {
        let device = &*self.device;
        let make = |view: &View, progress: &_| Shown::of(view, device, ctx, progress);
        self.microscope.complete(wanted, make);
    }

    /// The table of a mapping, when it has been measured.
    pub fn table(&self, mapping: MappingId) -> Option<&Table> {
        self.table.as_ref().filter(|table| table.mapping == mapping)
    }

    /// True while a table is being measured.
    pub fn is_measuring(&self) -> bool {
        self.measuring.is_some()
    }

    /// The last picture.
    pub fn shown(&self) -> Option<&Shown> {
        self.microscope.shown().map(|(_, shown)| shown)
    }
}

impl Lab for StabilityLab {
    fn poll(&mut self, _: &Context) {
        if let Some(job) = self.measuring.take() {
            match job.poll() {
                Outcome::Running => self.measuring = Some(job),
                Outcome::Done(table) => self.table = Some(table),
                Outcome::Failed => {}
            }
        }
        self.microscope.poll();
    }

    fn jobs(&self) -> Vec<JobLine> {
        let measuring = self.measuring.iter().map(job_line);
        measuring.chain(self.microscope.job()).collect()
    }

    fn cancel(&mut self, id: u64) {
        self.measuring.take_if(|job| job.id == id);
        self.microscope.cancel(id);
    }
}
