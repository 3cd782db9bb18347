//! The laboratory: evaluators, what they cost and err, and where they break.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "tests say what they expect by unwrapping, and what they saw by printing"
)]

mod bench;
mod command;
mod evaluators;
mod metrics;
mod microscope;
mod stress;
