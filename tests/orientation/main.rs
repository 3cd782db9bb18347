//! Which way round maps are: frames of programs, seams, the face solver, and telling what a picture is.

mod scenes;
mod solving;
