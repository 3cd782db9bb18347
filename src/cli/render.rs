//! `sixfold render`: what picture is asked for. Drawing it is the explorer's work.

use std::path::PathBuf;
use std::str::FromStr;

use crate::imaging::png_out::MAX_SIDE;
use crate::mapping::{MappingId, UnknownMapping};
use crate::math::Rotation;
use crate::optics::Material;
use crate::optics::presets::presets;
use crate::scene::Object;

/// Options of `sixfold render`. What is `None` stays as the scene has it.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct RenderOptions {
    /// The picture to write; panels, the folded map and the sampling also as lines alone (no light, heat map or tint), in .svg
    #[arg(value_name = "OUT.png|OUT.svg", value_parser = picture_path)]
    pub out: PathBuf,
    /// A saved scene to draw; else the scene that the explorer opens with
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// What to draw: window, viewport, panel:MAP, panels (all that are open), fold or sampling
    #[arg(long, default_value = "window")]
    pub what: Picture,
    /// Width and height in pixels, 1 to [`MAX_SIDE`] each.
    #[arg(
        long,
        value_name = "WxH",
        default_value = "1280x800",
        value_parser = size_px,
        help = format!("Width and height in pixels, at most {MAX_SIDE} each"),
    )]
    pub size: [u32; 2],
    /// The mapping that object and sky look up (`sixfold maps` lists them)
    #[arg(long, value_name = "MAP")]
    pub map: Option<MappingId>,
    /// A second mapping, right of the divider
    #[arg(long, value_name = "MAP")]
    pub compare: Option<MappingId>,
    /// Name of a built-in environment, or a latlong picture file
    #[arg(long, value_name = "NAME|FILE")]
    pub environment: Option<String>,
    /// Turn the environment by these angles in degrees
    #[arg(long, value_name = "YAW,PITCH,ROLL", allow_hyphen_values = true)]
    pub rotate: Option<Rotation>,
    /// The object that mirrors it: sphere, torus, rounded-cube, teapot
    #[arg(long, value_name = "NAME", value_parser = object)]
    pub object: Option<Object>,
    /// What the object is made of, by a preset's name
    #[arg(long, value_name = "NAME", value_parser = material)]
    pub material: Option<Material>,
    /// Leave out what is drawn over the picture: axes, great circles, vectors, marks
    #[arg(long = "no-overlays", action = clap::ArgAction::SetFalse)]
    pub overlays: bool,
    /// Replace an existing file
    #[arg(long)]
    pub force: bool,
}

/// Which part of the explorer a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    /// The whole window.
    Window,
    /// The object before its environment.
    Viewport,
    /// One mapping's panel.
    Panel(MappingId),
    /// The open panels side by side.
    Panels,
    /// The map between its flat picture and the sphere.
    Fold,
    /// The cut through the horizon.
    Sampling,
}

/// No part of the explorer has this name.
#[derive(Debug, thiserror::Error)]
pub enum UnknownPicture {
    /// The part's own name.
    #[error("cannot draw `{0}`; it can be window, viewport, panel:MAP, panels, fold or sampling")]
    Part(String),
    /// The mapping after `panel:`.
    #[error(transparent)]
    Mapping(#[from] UnknownMapping),
}

impl FromStr for Picture {
    type Err = UnknownPicture;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match text.split_once(':') {
            None if text == "window" => Self::Window,
            None if text == "viewport" => Self::Viewport,
            None if text == "panels" => Self::Panels,
            None if text == "fold" => Self::Fold,
            None if text == "sampling" => Self::Sampling,
            Some(("panel", map)) => Self::Panel(map.parse()?),
            _ => return Err(UnknownPicture::Part(text.to_owned())),
        })
    }
}

fn picture_path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is = |end: &str| {
        path.extension()
            .is_some_and(|e| e.eq_ignore_ascii_case(end))
    };
    let fits = is("png") || is("svg");
    fits.then_some(path).ok_or_else(|| {
        "pictures are written as PNG, lines as SVG: the name must end in .png or .svg".to_owned()
    })
}

pub(super) fn size_px(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| {
        let side = text.parse().ok()?;
        (1..=MAX_SIDE).contains(&side).then_some(side)
    };
    let size = text.split_once(['x', 'X']);
    size.and_then(|(width, height)| Some([side(width)?, side(height)?]))
        .ok_or_else(|| format!("must be WIDTHxHEIGHT, like 1280x800, 1 to {MAX_SIDE} each"))
}

fn material(text: &str) -> Result<Material, String> {
    let id = |name: &str| name.to_lowercase().replace(' ', "-").replace('\'', "");
    let found = presets().iter().find(|(name, _)| id(name) == text);
    found.map(|(_, make)| make()).ok_or_else(|| {
        let names: Vec<String> = presets().iter().map(|(name, _)| id(name)).collect();
        format!("the materials are {}", names.join(", "))
    })
}

fn object(text: &str) -> Result<Object, String> {
    let id = |object: &Object| object.name().replace(' ', "-");
    let found = Object::ALL.into_iter().find(|object| id(object) == text);
    found.ok_or_else(|| {
        let names: Vec<String> = Object::ALL.iter().map(id).collect();
        format!("the objects are {}", names.join(", "))
    })
}
