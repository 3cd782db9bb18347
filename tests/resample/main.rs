//! Conversions between environment maps: where texels go, what they hold, and that nothing shows at a seam.
//!
//! Each budget stands beside what is observed (`cargo test --test resample -- --nocapture` prints it), one that is ten times
//! too wide fails too, and each comparison is run once on something that is broken on purpose.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "tests say what they expect by unwrapping, and what they saw by printing"
)]

mod analytic;
mod constants;
mod fixtures;
mod opacity;
mod parts;
mod quality;
mod registration;
