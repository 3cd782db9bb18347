//! Sixfold: environment mappings, side by side.
//!
//! A mapping stores everything around a point in flat pictures and looks it up again from a direction. The layers,
//! lowest first (each uses only those above it in this list; `tests/architecture.rs` holds the source to that):
//!
//! - [`math`]: numbers, stable angles, units in the last place, Jacobians, input points;
//! - [`mapping`]: direction to (chart, u, v) and back, one file a mapping, and the registry;
//! - [`optics`]: what happens to a ray before it looks up the map;
//! - [`scene`]: camera, objects and what the pointer hits;
//! - [`imaging`]: environments as pictures: reading, checking, computing, writing;
//! - [`lab`]: run time against error, and where each way to compute a mapping breaks;
//! - [`meshes`]: user models: OBJ and glTF files as meshes;
//! - `gpu` (feature `explorer`): the renderer;
//! - `app` (feature `explorer`): the window;
//! - [`cli`]: the command line.

#[cfg(feature = "explorer")]
pub mod app;
pub mod cli;
#[cfg(feature = "explorer")]
pub mod gpu;
pub mod imaging;
pub mod lab;
pub mod mapping;
pub mod math;
pub mod meshes;
pub mod optics;
pub mod scene;
