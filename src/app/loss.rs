//! The loss laboratory: the environment on a mapping goes to another one and comes back. What is measured, the job that does
//! it, and the residual as a picture.

use std::sync::Arc;

use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};

use super::follower::{Follower, GivenUp};
use super::labs::Lab;
use super::model::JobLine;
use super::object::Jobs;
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
        old: Option<(&Wanted, &Arc<Self>)>,
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

impl Shown {
    /// Measures, and makes the picture; of what was shown (`old`) what is the same is kept.
    fn of(
        wanted: &Wanted,
        old: Option<&Self>,
        ctx: &Context,
        progress: &Progress,
    ) -> Result<Arc<Self>, String> {
        let old = old.map(|shown| (&shown.wanted, &shown.measured));
        let measured = Measured::of(wanted, old, progress)?;
        let usual = || measured.usual_magnification();
        let factor = wanted.settings.magnification.unwrap_or_else(usual);
        let picture = measured.picture(factor).ok_or("there is no residual")?;
        let most = ctx.input(|i| i.max_texture_side);
        if picture.size.iter().any(|side| *side > most) {
            return Err(format!(
                "a picture here has at most {most} texels a side; choose fewer rows"
            ));
        }
        // Texels are seen as they are; where many fall on a pixel, each counts.
        let options = TextureOptions {
            minification: egui::TextureFilter::Linear,
            ..TextureOptions::NEAREST
        };
        Ok(Arc::new(Self {
            wanted: wanted.clone(),
            measured,
            picture: ctx.load_texture("residual", picture, options),
            factor,
        }))
    }
}

/// The last measurement, and the job that makes the next one.
#[derive(Default)]
pub struct LossLab {
    /// What came of the last wish, or why nothing did.
    latest: Follower<Wanted, Result<Arc<Shown>, String>>,
    /// The last that came out: it stays while the next is made, and when that fails.
    shown: Option<Arc<Shown>>,
}

impl LossLab {
    /// Starts what is wanted and not there; stops what is not wanted any more. `None`: nobody looks.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(&mut self, wanted: Option<Wanted>, jobs: &mut Jobs<'_>) -> Result<(), String> {
        let (old, ctx) = (self.shown.clone(), jobs.ctx.clone());
        let make = move |wanted: &Wanted, progress: &Progress| {
            Some(Shown::of(wanted, old.as_deref(), &ctx, progress))
        };
        self.latest.follow(wanted, "measuring the loss", jobs, make)
    }

    /// Forgets what was measured of other surroundings, which would be kept in memory for nobody.
    pub fn forget_others(&mut self, loaded: &Arc<Loaded>) {
        let loaded = Shared::from(Arc::clone(loaded));
        self.latest.forget(|wanted| wanted.loaded != loaded);
        self.shown.take_if(|shown| shown.wanted.loaded != loaded);
    }

    /// Waits for what is wanted: for pictures.
    pub fn complete(&mut self, wanted: Option<Wanted>, ctx: &Context) {
        let old = self.shown.clone();
        self.latest.complete(wanted, |wanted, progress| {
            Some(Shown::of(wanted, old.as_deref(), ctx, progress))
        });
        self.take_in();
    }

    fn take_in(&mut self) {
        if let Some((_, Ok(shown))) = self.latest.shown() {
            self.shown = Some(Arc::clone(shown));
        }
    }

    /// The last measurement.
    pub fn shown(&self) -> Option<&Shown> {
        self.shown.as_deref()
    }

    /// Why nothing was measured.
    pub fn fault(&self) -> Option<&str> {
        if self.latest.making().is_some() {
            return None;
        }
        match self.latest.given_up() {
            Some(GivenUp::Cancelled) => Some("measuring was cancelled"),
            Some(GivenUp::Failed) => {
                Some("measuring ended without a result: there may be too little memory")
            }
            None => self.latest.shown()?.1.as_ref().err().map(String::as_str),
        }
    }

    /// What was given up is measured after all.
    pub fn try_again(&mut self) {
        self.latest.forget(|_| true);
    }
}

impl Lab for LossLab {
    fn poll(&mut self, _: &Context) {
        self.latest.poll();
        self.take_in();
    }

    fn jobs(&self) -> Vec<JobLine> {
        self.latest.job().into_iter().collect()
    }

    fn cancel(&mut self, id: u64) {
        self.latest.cancel(id);
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
        let old = Some((&of, &first));
        let next = |change: &dyn Fn(&mut Wanted)| {
            let mut wanted = of.clone();
            change(&mut wanted);
            Measured::of(&wanted, old, &Progress::new()).unwrap()
        };
        let magnified = next(&|w| w.settings.magnification = Some(8));
        assert!(Arc::ptr_eq(&magnified, &first));
        let filtered = next(&|w| w.settings.filter = Some(Filter::Nearest));
        assert!(!Arc::ptr_eq(&filtered, &first) && Arc::ptr_eq(&filtered.map, &first.map));
        let turned = next(&|w| w.rotation.yaw_deg = 90.0);
        assert!(!Arc::ptr_eq(&turned.map, &first.map));
    }
}
