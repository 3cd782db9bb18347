//! Which way round maps are: frames of programs, seams, the face solver, and telling what a picture is.

#![allow(clippy::unwrap_used, reason = "tests")]

mod detecting;
mod opening;
mod scenes;
mod seams;
mod shader_code;
mod solving;
mod there_and_back;
#[path = "../wgsl/mod.rs"]
mod wgsl;
