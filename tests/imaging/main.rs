//! Pictures in and out: orientation, every format, bad values, hostile files, scenes in PNG text.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod computed;
mod containers;
mod files;
mod fixtures;
mod formats;
mod hostile;
mod independent;
mod saved;
