//! `sixfold figure`: which figures are asked for. Drawing them is the explorer's work.

use std::path::PathBuf;

use super::render::size_px;
use crate::imaging::png_out::MAX_SIDE;

/// Options of `sixfold figure`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct FigureOptions {
    /// The figure's name, or `all`; `sixfold figure list` lists them
    pub name: String,
    /// The folder for the pictures, NAME.png each, and NAME.svg of line art; made if it is not there
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub out: PathBuf,
    /// Width and height in pixels, 1 to [`MAX_SIDE`] each.
    #[arg(
        long,
        value_name = "WxH",
        default_value = "1280x960",
        value_parser = size_px,
        help = format!("Width and height in pixels, at most {MAX_SIDE} each"),
    )]
    pub size: [u32; 2],
    /// Name of a built-in environment, or a latlong picture file
    #[arg(long, value_name = "NAME|FILE")]
    pub environment: Option<String>,
    /// Replace existing files
    #[arg(long)]
    pub force: bool,
}
