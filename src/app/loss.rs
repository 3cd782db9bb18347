//! The loss laboratory: the environment on a mapping goes to another one and comes back. What is measured, the job that does
//! it, and the residual as a picture.

use std::sync::Arc;

use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};

use super::job::{Job, Outcome};
use super::labs::Lab;
use super::model::JobLine;
use super::object::{Jobs, job_line};
use super::state::{AppState, LossState, MOST_MAGNIFIED};
use super::theme::PICTURE_BACKGROUND;
use crate::gpu::Shared;
use crate::imaging::compare::{Loss, loss};
use crate::imaging::resample::{Conversion, chart_size, resample};
use crate::imaging::{EnvironmentMap, Loaded, Progress, Samples, srgb};
use crate::math::Rotation;

/// What a measurement depends on, and how its residual is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    loaded: Shared<Loaded>,
    rotation: Rotation,
    /// The maps and the filter.
    pub settings: LossState,
}

impl Wanted {
    /// What the state asks for of these surroundings.
    pub fn new(state: &AppState, loaded: &Arc<Loaded>) -> Self {
        Self {
            loaded: Arc::clone(loaded).into(),
            rotation: state.rotation,
            settings: state.loss,
        }
    }

    /// Whether the first map is the same.
    fn has_map_of(&self, other: &Self) -> bool {
        let map = |wanted: &Self| (wanted.settings.from, wanted.settings.from_rows);
        self.loaded == other.loaded && self.rotation == other.rotation && map(self) == map(other)
    }

    /// Whether the same is measured, however it is shown.
    fn measures_as(&self, other: &Self) -> bool {
        let via = |wanted: &Self| {
            let settings = &wanted.settings;
            (settings.via, settings.via_rows, settings.filter)
        };
        self.has_map_of(other) && via(self) == via(other)
    }
}

/// What has been measured.
pub struct Measured {
    map: Arc<EnvironmentMap>,
    /// The numbers, and the residual.
    pub loss: Loss,
}

impl Measured {
    /// Measures; of an earlier measurement (`old`) what is the same is kept.
    fn of(
        wanted: &Wanted,
        old: Option<&(Wanted, Arc<Self>)>,
        progress: &Progress,
    ) -> Result<Arc<Self>, String> {
        let said = |error: &dyn std::fmt::Display| error.to_string();
        let settings = &wanted.settings;
        let map = match old {
            Some((of, measured)) if of.measures_as(wanted) => return Ok(Arc::clone(measured)),
            Some((of, measured)) if of.has_map_of(wanted) => Arc::clone(&measured.map),
            _ => {
                let source =
                    EnvironmentMap::of_latlong(&wanted.loaded.image).map_err(|e| said(&e))?;
                let size = chart_size(settings.from, settings.from_rows);
                let conversion = Conversion {
                    rotation: wanted.rotation.source_from_world(),
                    ..Conversion::new(settings.from, size, source.shape())
                };
                let made = resample(&source, &conversion, progress);
                Arc::new(made.map_err(|e| said(&e))?.0)
            }
        };
        let size = chart_size(settings.via, settings.via_rows);
        let via = Conversion {
            filter: settings.filter,
            ..Conversion::new(settings.via, size, map.shape())
        };
        let loss = loss(&map, &via, settings.filter, progress).map_err(|e| said(&e))?;
        Ok(Arc::new(Self { map, loss }))
    }

    /// Whether every texel came back as it was.
    pub fn is_lossless(&self) -> bool {
        self.loss.difference.worst.difference == 0.0
    }

    /// By what the residual is multiplied where nothing else is asked for: the largest power of two that leaves nine tenths
    /// of the texels that differ below white. The few brightest, which rule the RMS, would leave the others dark.
    fn usual_magnification(&self) -> u32 {
        let rasters = self.loss.difference.residual.rasters().iter();
        let texels = rasters.flat_map(|raster| match raster.samples() {
            Samples::F32(samples) => samples.as_chunks::<3>().0,
            _ => &[],
        });
        let mut largest: Vec<f32> = texels
            .map(|[r, g, b]| r.max(*g).max(*b))
            .filter(|difference| *difference > 0.0)
            .collect();
        if largest.is_empty() {
            return 1;
        }
        let at = (largest.len() - 1) * 9 / 10;
        let (_, tenth, _) = largest.select_nth_unstable_by(at, f32::total_cmp);
        // `as` saturates.
        1 << ((1.0 / *tenth) as u32).clamp(1, MOST_MAGNIFIED).ilog2()
    }

    /// The residual times `factor` as light, unfolded as the panel of its mapping is; the background where it has no texel.
    fn picture(&self, factor: u32) -> Option<ColorImage> {
        let residual = &self.loss.difference.residual;
        let raster = residual.rasters().first()?;
        let Samples::F32(samples) = raster.samples() else {
            return None;
        };
        let mapping = residual.shape().mapping;
        let size = raster.size().map(|n| n as usize);
        let [r, g, b] = PICTURE_BACKGROUND;
        let background = Color32::from_rgb(r, g, b);
        let is_texel = |index: usize| {
            let place = [index % size[0], index / size[0]];
            let place = [0, 1].map(|k| (place[k] as f64 + 0.5) / size[k] as f64);
            let point = mapping.info().layout.chart_from_picture(place);
            point.is_some_and(|point| mapping.inverse::<f64>(point).is_some())
        };
        let pixels = samples.as_chunks().0.iter().enumerate();
        let pixels = pixels.map(|(index, light): (usize, &[f32; 3])| {
            if *light == [0.0; 3] && !is_texel(index) {
                return background;
            }
            let [r, g, b] = srgb::srgb8_from_linear(light.map(|c| c * factor as f32));
            Color32::from_rgb(r, g, b)
        });
        Some(ColorImage::new(size, pixels.collect()))
    }
}

/// A measurement with its picture.
struct Made {
    measured: Arc<Measured>,
    picture: ColorImage,
    factor: u32,
}

impl Made {
    fn of(
        wanted: &Wanted,
        old: Option<&(Wanted, Arc<Measured>)>,
        progress: &Progress,
    ) -> Result<Self, String> {
        let measured = Measured::of(wanted, old, progress)?;
        let usual = || measured.usual_magnification();
        let factor = wanted.settings.magnification.unwrap_or_else(usual);
        let picture = measured.picture(factor).ok_or("there is no residual")?;
        Ok(Self {
            measured,
            picture,
            factor,
        })
    }
}

/// What is on the screen.
pub struct Shown {
    /// What was asked for.
    pub wanted: Wanted,
    /// What came out.
    pub measured: Arc<Measured>,
    /// The residual.
    pub picture: TextureHandle,
    /// By what it is magnified.
    pub factor: u32,
}

/// The last measurement, and the job that makes the next one.
#[derive(Default)]
pub struct LossLab {
    shown: Option<Shown>,
    job: Option<(Wanted, Job<Result<Made, String>>)>,
    /// Not tried again by itself, and why.
    given_up: Option<(Wanted, String)>,
}

impl LossLab {
    /// Starts what is wanted and not there; stops what is not wanted any more. `None`: nobody looks.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(&mut self, wanted: Option<Wanted>, jobs: &mut Jobs<'_>) -> Result<(), String> {
        self.job
            .take_if(|(running, _)| Some(&*running) != wanted.as_ref());
        let Some(wanted) = wanted.filter(|wanted| self.is_missing(wanted)) else {
            return Ok(());
        };
        self.given_up = None;
        let (made, old) = (wanted.clone(), self.old());
        let job = jobs.start("measuring the loss".to_owned(), move |progress| {
            Made::of(&made, old.as_ref(), progress)
        });
        match job {
            Ok(job) => self.job = Some((wanted, job)),
            Err(why) => {
                self.given_up = Some((wanted, why.clone()));
                return Err(why);
            }
        }
        Ok(())
    }

    /// Forgets what was measured of other surroundings, which would be kept in memory for nobody.
    pub fn forget_others(&mut self, loaded: &Arc<Loaded>) {
        let loaded = Shared::from(Arc::clone(loaded));
        self.shown.take_if(|shown| shown.wanted.loaded != loaded);
        self.given_up.take_if(|(of, _)| of.loaded != loaded);
    }

    /// Waits for what is wanted: for pictures.
    pub fn complete(&mut self, wanted: Option<Wanted>, ctx: &Context) {
        if let Some(wanted) = wanted.filter(|wanted| self.is_missing(wanted)) {
            let made = Made::of(&wanted, self.old().as_ref(), &Progress::new());
            self.take_in(wanted, made, ctx);
        }
    }

    fn is_missing(&self, wanted: &Wanted) -> bool {
        let is_there = self.shown.as_ref().is_some_and(|s| s.wanted == *wanted);
        let is_coming = self.job.as_ref().is_some_and(|(of, _)| of == wanted);
        let is_given_up = self.given_up.as_ref().is_some_and(|(of, _)| of == wanted);
        !is_there && !is_coming && !is_given_up
    }

    fn old(&self) -> Option<(Wanted, Arc<Measured>)> {
        let shown = self.shown.as_ref()?;
        Some((shown.wanted.clone(), Arc::clone(&shown.measured)))
    }

    fn take_in(&mut self, wanted: Wanted, made: Result<Made, String>, ctx: &Context) {
        let most = ctx.input(|i| i.max_texture_side);
        match made {
            Ok(Made { picture, .. }) if picture.size.iter().any(|side| *side > most) => {
                let why =
                    format!("a picture here has at most {most} texels a side; choose fewer rows");
                self.given_up = Some((wanted, why));
            }
            Ok(Made {
                measured,
                picture,
                factor,
            }) => {
                // Texels are seen as they are; where many fall on a pixel, each counts.
                let options = TextureOptions {
                    minification: egui::TextureFilter::Linear,
                    ..TextureOptions::NEAREST
                };
                let picture = ctx.load_texture("residual", picture, options);
                self.shown = Some(Shown {
                    wanted,
                    measured,
                    picture,
                    factor,
                });
            }
            Err(why) => self.given_up = Some((wanted, why)),
        }
    }

    /// The last measurement.
    pub fn shown(&self) -> Option<&Shown> {
        self.shown.as_ref()
    }

    /// Why nothing was measured.
    pub fn fault(&self) -> Option<&str> {
        self.given_up.as_ref().map(|(_, why)| why.as_str())
    }

    /// True while a job runs.
    pub fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    /// What was given up is measured after all.
    pub fn try_again(&mut self) {
        self.given_up = None;
    }
}

impl Lab for LossLab {
    fn poll(&mut self, ctx: &Context) {
        if let Some((wanted, job)) = self.job.take() {
            match job.poll() {
                Outcome::Running => self.job = Some((wanted, job)),
                Outcome::Done(made) => self.take_in(wanted, made, ctx),
                Outcome::Failed => {
                    let why = "measuring ended without a result: there may be too little memory";
                    self.given_up = Some((wanted, why.to_owned()));
                }
            }
        }
    }

    fn jobs(&self) -> Vec<JobLine> {
        self.job.iter().map(|(_, job)| job_line(job)).collect()
    }

    fn cancel(&mut self, id: u64) {
        if let Some((wanted, _)) = self.job.take_if(|(_, job)| job.id == id) {
            self.given_up = Some((wanted, "measuring was cancelled".to_owned()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Image;
    use crate::imaging::resample::Filter;
    use crate::mapping::MappingId;

    /// What is measured of a picture with one bright texel.
    fn measured(settings: LossState) -> Arc<Measured> {
        let mut texels = vec![[0.25; 3]; 64 * 32];
        texels[16 * 64 + 32] = [1.0, 0.5, 0.25];
        let image = Image::new(64, 32, texels).unwrap();
        let wanted = Wanted {
            loaded: Shared::new(Loaded::from_image(image, &Progress::new())),
            rotation: Rotation::NONE,
            settings,
        };
        Measured::of(&wanted, None, &Progress::new()).unwrap()
    }

    #[test]
    fn the_picture_is_the_residual_magnified_on_its_charts_and_background_elsewhere() {
        let measured = measured(LossState {
            from: MappingId::Cube,
            from_rows: 8,
            via: MappingId::Latlong,
            via_rows: 16,
            filter: Some(Filter::Bilinear),
            ..LossState::default()
        });
        let [r, g, b] = PICTURE_BACKGROUND;
        let background = Color32::from_rgb(r, g, b);
        let picture = measured.picture(1).unwrap();
        assert_eq!(picture.size, [32, 24]);
        let at = |picture: &ColorImage, x: usize, y: usize| picture.pixels[y * 32 + x];
        // Beside the cross, and on a face where nothing is lost.
        assert_eq!(at(&picture, 1, 1), background);
        assert_eq!(at(&picture, 28, 12), Color32::BLACK);
        let worst = measured.loss.difference.worst;
        // The cross has +z in its second column and row.
        assert_eq!(worst.chart, 4);
        let [x, y] = worst.texel.map(|n| n as usize + 8);
        let light = |factor: u32| at(&measured.picture(factor).unwrap(), x, y);
        let expected = |factor: f32| {
            let raster = &measured.loss.difference.residual.rasters()[0];
            let [r, g, b, _] = raster.light(x as u32, y as u32);
            let [r, g, b] = srgb::srgb8_from_linear([r, g, b].map(|c| c * factor));
            Color32::from_rgb(r, g, b)
        };
        assert_eq!((light(1), light(2)), (expected(1.0), expected(2.0)));
        assert_ne!(light(1), light(2));
    }

    #[test]
    fn what_is_the_same_is_not_measured_again() {
        let settings = LossState {
            from_rows: 8,
            via_rows: 4,
            ..LossState::default()
        };
        let first = measured(settings);
        let image = Image::new(2, 1, vec![[0.5; 3]; 2]).unwrap();
        let wanted = |settings| Wanted {
            loaded: Shared::new(Loaded::from_image(image.clone(), &Progress::new())),
            rotation: Rotation::NONE,
            settings,
        };
        let of = wanted(settings);
        let old = Some((of.clone(), Arc::clone(&first)));
        let next = |change: &dyn Fn(&mut Wanted)| {
            let mut wanted = of.clone();
            change(&mut wanted);
            Measured::of(&wanted, old.as_ref(), &Progress::new()).unwrap()
        };
        let magnified = next(&|w| w.settings.magnification = Some(8));
        assert!(Arc::ptr_eq(&magnified, &first));
        let filtered = next(&|w| w.settings.filter = Some(Filter::Nearest));
        assert!(!Arc::ptr_eq(&filtered, &first) && Arc::ptr_eq(&filtered.map, &first.map));
        let turned = next(&|w| w.rotation.yaw_deg = 90.0);
        assert!(!Arc::ptr_eq(&turned.map, &first.map));
    }
}
