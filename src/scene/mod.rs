//! Camera, objects, what the pointer hits, and light on its way through an object.
//!
//! One world frame for all: left-handed, +x right, +y up, +z forward. Every object fits in the unit ball around the
//! origin; the camera circles it. Nothing here knows of the GPU or of the window.

pub mod camera;
pub mod mesh;
pub mod mirror;
pub mod object;
pub mod pick;
mod rows;
mod teapot;
pub mod trace;

pub use camera::{Camera, Projection, Ray, RayFrame};
pub use mesh::Mesh;
pub use mirror::{Seen, mirror_view};
pub use object::Object;
pub use pick::{Hit, Target};
pub use trace::{Escape, Escapes, Traced, trace, trace_view};
