//! The map as a surface that folds from its flat picture onto the sphere: its light, its lines, where they are seen.

mod lines;
mod panel;
mod sheet;
mod view;

use std::sync::Arc;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

pub use lines::{Line, letters, project, seen};
pub use panel::{fold_ui, surface_ui};
pub use sheet::{Sheet, SheetWanted};
pub use view::{Quad, Surface, is_covered};

use super::follower::Follower;
use super::labs::Lab;
use super::model::JobLine;
use super::state::AppState;
use crate::gpu::Shared;
use crate::imaging::resample::{Conversion, Filter, equal_rows, resample};
use crate::imaging::{Channels, EnvironmentMap, Loaded, Progress, SampleKind, Samples, Transfer};
use crate::mapping::MappingId;
use crate::math::Rotation;

/// The light of a mapping's unfolded picture.
#[derive(Clone, Debug, PartialEq)]
pub struct LightWanted {
    loaded: Shared<Loaded>,
    rotation: Rotation,
    mapping: MappingId,
    exposure_ev: f32,
}

impl LightWanted {
    /// Of the selected mapping in these surroundings.
    pub fn new(state: &AppState, loaded: &Arc<Loaded>) -> Self {
        Self {
            loaded: Arc::clone(loaded).into(),
            rotation: state.rotation,
            mapping: state.mapping,
            exposure_ev: state.exposure_ev,
        }
    }

    /// Makes the picture; nothing when cancelled, and when there is no memory.
    pub fn make(&self, ctx: &Context, progress: &Progress) -> Option<TextureHandle> {
        /// As many texels as a cube with faces of 192.
        const FACE: u32 = 192;
        let source = EnvironmentMap::of_latlong(&self.loaded.image).ok()?;
        let rows = equal_rows(self.mapping, MappingId::Cube, [FACE; 2]);
        let size = crate::imaging::resample::chart_size(self.mapping, rows);
        let conversion = Conversion {
            rotation: self.rotation.source_from_world(),
            filter: Some(Filter::Bilinear),
            supersample: 2,
            exposure_ev: f64::from(self.exposure_ev),
            samples: SampleKind::U8,
            transfer: Transfer::Srgb,
            channels: Channels::Rgb,
            ..Conversion::new(self.mapping, size, source.shape())
        };
        let (map, _) = resample(&source, &conversion, progress).ok()?;
        let raster = map.rasters().first()?;
        let Samples::U8(codes) = raster.samples() else {
            return None;
        };
        let image = ColorImage::from_rgb(raster.size().map(|n| n as usize), codes);
        Some(ctx.load_texture("folded light", image, TextureOptions::LINEAR))
    }
}

/// The light and the lines that were made last.
#[derive(Default)]
pub struct FoldLab {
    /// Made while the pane is seen.
    pub light: Follower<LightWanted, TextureHandle>,
    /// The same of what is drawn over it, and on what.
    pub sheet: Follower<SheetWanted, Sheet>,
}

impl FoldLab {
    /// Lets go of the light of other surroundings, which would be kept in memory for nobody.
    pub fn forget_others(&mut self, loaded: &Arc<Loaded>) {
        let loaded = Shared::from(Arc::clone(loaded));
        self.light.forget(|wanted| wanted.loaded != loaded);
    }

    /// The light of a mapping's picture, when it is there.
    pub fn light_of(&self, mapping: MappingId) -> Option<egui::TextureId> {
        let (of, picture) = self.light.shown()?;
        (of.mapping == mapping).then(|| picture.id())
    }

    /// The pieces and the lines of a mapping, when they are there; while other lines are traced, the last ones stand in.
    pub fn sheet_of(&self, mapping: MappingId) -> Option<(&SheetWanted, &Sheet)> {
        self.sheet.shown().filter(|(of, _)| of.mapping == mapping)
    }
}

impl Lab for FoldLab {
    fn poll(&mut self, _: &Context) {
        self.light.poll();
        self.sheet.poll();
    }

    fn jobs(&self) -> Vec<JobLine> {
        self.light
            .job()
            .into_iter()
            .chain(self.sheet.job())
            .collect()
    }

    fn cancel(&mut self, id: u64) {
        self.light.cancel(id);
        self.sheet.cancel(id);
    }
}
