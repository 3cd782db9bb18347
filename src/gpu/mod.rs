//! The renderer: the device, the shaders put together from the mappings, and what runs on them.

pub mod compute;
pub mod context;
pub mod shader;

pub use compute::GpuEvaluator;
pub use context::{Gpu, GpuError};
