//! The renderer: the device, the shaders put together from the mappings, and what runs on them.

pub mod compute;
pub mod context;
mod dispatch;
pub mod environment;
pub mod frame;
pub mod kit;
pub mod map;
mod object;
pub mod optics;
pub mod overlay;
mod panel;
mod plan;
pub mod program;
pub mod readback;
pub mod renderer;
pub mod report;
pub mod shader;
pub mod shared;
pub mod tone;
pub mod uniforms;
mod viewport;
mod workshop;

pub use compute::GpuEvaluator;
pub use context::{Gpu, GpuError};
pub use environment::{EnvironmentSource, EnvironmentTexture};
pub use frame::{Body, Frame, ObjectFrame, PanelFrame, ViewportFrame};
pub use map::map_size;
pub use optics::GpuOptics;
pub use overlay::{GREAT_CIRCLE_COLORS, Overlays};
pub use plan::Node;
pub use program::Program;
pub use readback::{MapPixels, RgbaPixels, TexelRead};
pub use renderer::{RenderError, Renderer};
pub use report::{Report, Totals};
pub use shared::Shared;
pub use tone::ToneCurve;
