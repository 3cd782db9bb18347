//! The window: state, actions, panels, jobs, and pictures without a window.
//!
//! [`state::AppState`] is plain data. Panels see it through [`model::Model`] and push [`command::Command`]s; only
//! [`action::apply`] changes it. [`explorer::Explorer`] holds the renderer and the jobs; [`run`] puts it behind a window,
//! [`picture`] behind a texture.

pub mod action;
pub mod arrangement;
mod bars;
pub mod budget;
mod budget_numbers;
mod budget_panel;
pub mod command;
mod controls;
mod curves;
pub mod dialogs;
pub mod distortion;
pub mod ellipses;
pub mod explorer;
pub mod export;
mod export_dialog;
pub mod figures;
pub mod files;
pub mod fold;
mod follower;
mod frame;
pub mod history;
mod inspector;
mod job;
mod kept;
mod keys;
pub mod laboratory;
pub mod labs;
pub mod line_art;
mod lists;
pub mod loss;
mod loss_panel;
mod map_lines;
mod map_panel;
mod marks;
mod material_panel;
mod microscope;
pub mod model;
mod narrow;
mod numbers;
mod object;
mod objects;
pub mod offscreen;
mod pace;
pub mod panel_view;
pub mod panels;
pub mod panes;
pub mod picture;
mod plots;
pub mod probe;
pub mod ranking;
mod reading;
mod reading_dialog;
pub mod sampling;
mod sides;
pub mod stability;
mod stability_panel;
mod stability_table;
pub mod state;
mod story;
mod texel_color;
pub mod theme;
mod turning;
mod viewport;
pub mod views;
mod wheel;
mod window;

pub use window::{Lost, RunError, Window, run};
