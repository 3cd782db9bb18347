//! What can be asked of the explorer.

use super::Explorer;
use crate::app::labs::Labs;
use crate::app::model::{Message, Surroundings};
use crate::app::state::AppState;
use crate::gpu::Gpu;

impl Explorer {
    /// The state that is shown.
    pub fn state(&self) -> &AppState {
        &self.state
    }

    /// The surroundings that are shown; `None` until the first ones are there.
    pub fn surroundings(&self) -> Option<&Surroundings> {
        self.surroundings.as_ref()
    }

    /// Frames drawn so far.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// The device is gone: nothing can be drawn any more.
    pub fn is_lost(&self) -> bool {
        self.gpu.is_lost()
    }

    /// The messages that are shown.
    pub fn messages(&self) -> &[Message] {
        &self.messages
    }

    /// What the laboratories have measured.
    pub fn labs(&self) -> &Labs {
        &self.labs
    }

    /// The laboratories, to be given what was measured elsewhere.
    pub fn labs_mut(&mut self) -> &mut Labs {
        &mut self.labs
    }

    /// What the renderer did last.
    pub fn report(&self) -> &crate::gpu::Report {
        self.renderer.report()
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }
}
