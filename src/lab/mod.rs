//! The laboratory: what each way to compute a mapping costs, how far it errs, and where it breaks.
//!
//! An experiment is data: a mapping, one of its evaluators, a direction, inputs, instructions and threads. Speed is never
//! told without error, nor error without speed.

pub mod accuracy;
pub mod bench;
pub mod choice;
pub mod clock;
pub mod devices;
pub mod drawing;
pub mod equal_budget;
pub mod error_map;
pub mod files;
pub mod filter;
pub mod front;
pub mod inputs;
pub mod machine;
pub mod metrics;
pub mod ranking;
pub mod report;
pub mod run;
pub mod sampling;
pub mod scatter;
pub mod stress;
pub mod texel_density;
