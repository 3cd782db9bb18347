//! Where the used evaluator errs, as a picture.

use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};

use crate::app::job::{Job, Outcome};
use crate::app::model::JobLine;
use crate::app::object::{Jobs, job_line};
use crate::app::theme::{self, PICTURE_BACKGROUND};
use crate::imaging::Progress;
use crate::lab::error_map::{ErrorMap, Pixel, error_map};
use crate::mapping::MappingId;

/// What a picture shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// The mapping, whose own picture is painted.
    pub map: MappingId,
    /// Its evaluator.
    pub evaluator: &'static str,
    /// Texels along a chart's height.
    pub rows: u32,
    /// Columns and rows of the picture.
    pub size: [usize; 2],
}

impl Wanted {
    fn make(&self, progress: &Progress) -> Option<ErrorMap> {
        let evaluator = self.map.processor(self.evaluator)?;
        error_map(
            self.map, evaluator, self.rows, self.map, self.size, progress,
        )
    }
}

/// What is on the screen.
pub struct ShownErrors {
    /// What was asked for.
    pub wanted: Wanted,
    /// The errors.
    pub errors: ErrorMap,
    /// Their picture.
    pub picture: TextureHandle,
}

/// The last picture, and the job that makes the next one.
#[derive(Default)]
pub struct ErrorPicture {
    shown: Option<ShownErrors>,
    job: Option<(Wanted, Job<Option<ErrorMap>>)>,
    given_up: Option<Wanted>,
}

impl ErrorPicture {
    /// Starts what is wanted and not there; stops what is not wanted any more. `None`: nobody looks.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(&mut self, wanted: Option<Wanted>, jobs: &mut Jobs<'_>) -> Result<(), String> {
        self.job.take_if(|(of, _)| Some(&*of) != wanted.as_ref());
        let Some(wanted) = wanted.filter(|wanted| self.is_missing(wanted)) else {
            return Ok(());
        };
        self.given_up = Some(wanted.clone());
        let of = wanted.clone();
        let job = jobs.start("where it errs".to_owned(), move |progress| {
            of.make(progress)
        })?;
        self.given_up = None;
        self.job = Some((wanted, job));
        Ok(())
    }

    /// Waits for what is wanted: for pictures.
    pub fn complete(&mut self, wanted: Option<Wanted>, ctx: &Context) {
        if let Some(wanted) = wanted.filter(|wanted| self.is_missing(wanted)) {
            match wanted.make(&Progress::new()) {
                Some(errors) => self.take_in(wanted, errors, ctx),
                None => self.given_up = Some(wanted),
            }
        }
    }

    fn take_in(&mut self, wanted: Wanted, errors: ErrorMap, ctx: &Context) {
        let picture = ctx.load_texture("errors", image(&errors), TextureOptions::NEAREST);
        self.shown = Some(ShownErrors {
            wanted,
            errors,
            picture,
        });
    }

    fn is_missing(&self, wanted: &Wanted) -> bool {
        let is_there = self.shown.as_ref().is_some_and(|s| s.wanted == *wanted);
        let is_coming = self.job.is_some();
        !is_there && !is_coming && self.given_up.as_ref() != Some(wanted)
    }

    /// Takes in what the job has brought.
    pub fn poll(&mut self, ctx: &Context) {
        let Some((wanted, job)) = self.job.take() else {
            return;
        };
        match job.poll() {
            Outcome::Running => self.job = Some((wanted, job)),
            Outcome::Done(Some(errors)) => self.take_in(wanted, errors, ctx),
            Outcome::Done(None) | Outcome::Failed => self.given_up = Some(wanted),
        }
    }

    /// The last picture.
    pub fn shown(&self) -> Option<&ShownErrors> {
        self.shown.as_ref()
    }

    /// The job under way.
    pub fn job(&self) -> Option<JobLine> {
        self.job.as_ref().map(|(_, job)| job_line(job))
    }

    /// Stops the job of that number.
    pub fn cancel(&mut self, id: u64) {
        if let Some((wanted, _)) = self.job.take_if(|(_, job)| job.id == id) {
            self.given_up = Some(wanted);
        }
    }
}

/// Errors in the scale's colours, from 0 to the largest.
fn image(errors: &ErrorMap) -> ColorImage {
    let [r, g, b] = PICTURE_BACKGROUND;
    let color = |pixel: &Pixel| match pixel {
        Pixel::Outside => Color32::from_rgb(r, g, b),
        Pixel::Hole => theme::HOLE,
        Pixel::Error(rad) => theme::scale((f64::from(*rad) / errors.max_rad) as f32),
    };
    ColorImage::new(errors.size, errors.pixels.iter().map(color).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_error_has_the_scales_end_and_a_hole_its_own_colour() {
        let errors = ErrorMap {
            size: [4, 1],
            pixels: vec![
                Pixel::Error(0.0),
                Pixel::Error(2e-5),
                Pixel::Hole,
                Pixel::Outside,
            ],
            max_rad: f64::from(2e-5_f32),
            max_texels: 0.1,
            worst: [0.0, 0.0, 1.0],
            holes: 1,
        };
        let [r, g, b] = PICTURE_BACKGROUND;
        let colours = [
            theme::scale(0.0),
            theme::scale(1.0),
            theme::HOLE,
            Color32::from_rgb(r, g, b),
        ];
        assert_eq!(image(&errors).pixels, colours);
        for (k, colour) in colours.iter().enumerate() {
            assert!(!colours[..k].contains(colour), "control: {colour:?}");
        }
    }
}
