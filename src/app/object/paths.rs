//! Which paths through the body a view needs, and what tracing them takes.

use crate::gpu::Shared;
use crate::imaging::Progress;
use crate::scene::trace::{Traced, trace_view};
use crate::scene::{Camera, Target};

/// Which paths.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PathsKey {
    pub target: Shared<Target>,
    pub camera: Camera,
    pub size_px: [u32; 2],
    pub eta: f32,
    pub bounces: u32,
}

/// Most bytes for the paths of a view, both sides of the divider together: 3840 x 2160 pixels with two inner reflections.
const MOST_PATHS_BYTES: u64 = 512 << 20;

impl PathsKey {
    /// Bytes that the paths take: four floats for each direction of each pixel.
    fn bytes(&self) -> u64 {
        let [width, height] = self.size_px.map(u64::from);
        width * height * u64::from(self.bounces + 2) * 16
    }

    /// Why the paths of these keys cannot be had together.
    pub fn refused(keys: &[Self]) -> Option<String> {
        let bytes: u64 = keys.iter().map(Self::bytes).sum();
        let [width, height] = keys.first()?.size_px;
        (bytes > MOST_PATHS_BYTES).then(|| {
            format!(
                "tracing {width} x {height} pixels through both surfaces takes {} MB, the limit is {}; make the picture smaller or follow fewer inner reflections",
                bytes >> 20,
                MOST_PATHS_BYTES >> 20
            )
        })
    }

    /// `None` when it is cancelled, or there is no memory.
    pub fn trace(&self, progress: &Progress) -> Option<Traced> {
        trace_view(
            &self.target,
            &self.camera,
            self.size_px,
            self.eta,
            self.bounces,
            &|fraction| {
                progress.step((fraction * 1000.0) as usize, 1000);
                progress.is_cancelled()
            },
        )
    }
}
