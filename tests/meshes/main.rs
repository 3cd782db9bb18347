//! User models: every form in which one can come, what is mended, and files that mean harm.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod document;
mod fixtures;
mod forms;
mod hostile;
mod mended;
mod mutated;
mod outside;
