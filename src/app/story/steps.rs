//! A story as plain data: what each step says, what it points at and where it looks.

use egui::Color32;
use glam::Vec3;

use super::{ray, sphere_map};
use crate::app::state::{AppState, StoryKind};
use crate::app::theme;
use crate::math;
use crate::optics::{self, Material};
use crate::scene::{Hit, Ray, Target};

/// A direction of the world in f64, unit length.
pub type Dir = math::Vec3<f64>;

/// One step of a story.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StoryStep {
    /// What happens.
    pub title: String,
    /// It in one or two sentences.
    pub text: String,
    /// Formulas and what comes out of them.
    pub numbers: Vec<(String, String)>,
    /// What the viewport shows, this step's and those of the steps before.
    pub arrows: Vec<Arrow>,
    /// The direction in which the map is asked at this step.
    pub lookup: Option<Dir>,
    /// Directions that every panel marks.
    pub marks: Vec<Mark>,
}

/// An arrow in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// Its beginning.
    pub from: Vec3,
    /// Its tip.
    pub to: Vec3,
    /// May be empty.
    pub name: String,
    /// Of line and name.
    pub color: Color32,
    /// Its tip touches the surface, so its free end is its beginning: the name stands there.
    pub arrives: bool,
}

/// A direction that is marked in the panels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Which.
    pub dir: Dir,
    /// Colour of its dot.
    pub color: Color32,
}

/// The steps of the story that the state tells; empty where there is no ray or it meets nothing.
#[must_use]
pub fn steps(state: &AppState, target: &Target) -> Vec<StoryStep> {
    match state.story.kind {
        StoryKind::Ray => ray::steps(state, target),
        StoryKind::SphereMap => sphere_map::steps(state.probe_f64()),
    }
}

/// Length of the arrows, in radii of the object.
const LENGTH: f32 = 0.6;

impl Arrow {
    /// From a point along a unit vector.
    pub fn from_point(point: Vec3, dir: Vec3, name: impl Into<String>, color: Color32) -> Self {
        Self {
            from: point,
            to: point + dir * LENGTH,
            name: name.into(),
            color,
            arrives: false,
        }
    }

    /// Along a unit vector onto a point.
    pub fn onto_point(point: Vec3, dir: Vec3, name: impl Into<String>, color: Color32) -> Self {
        Self {
            from: point - dir * LENGTH,
            to: point,
            name: name.into(),
            color,
            arrives: true,
        }
    }
}

/// The refracted vector where a ray meets the object, if the material lets light in there.
#[must_use]
pub fn refracted_vector(ray: Ray, hit: &Hit, material: &Material) -> Option<Arrow> {
    let eta = f64::from(material.eta());
    let dir = optics::refract(dir_of(ray.dir), dir_of(hit.normal), eta)?;
    let arrow = Arrow::from_point(hit.point, point_of(dir), "refracted", theme::REFRACTED);
    material.refracts().then_some(arrow)
}

/// The incident, normal and reflected vectors where a ray meets the object.
#[must_use]
pub fn vectors(ray: Ray, hit: &Hit) -> [Arrow; 3] {
    let reflected = optics::reflect(dir_of(ray.dir), dir_of(hit.normal));
    let [incident, normal, mirrored] = theme::VECTORS;
    [
        Arrow::onto_point(hit.point, ray.dir, "incident", incident),
        Arrow::from_point(hit.point, hit.normal, "normal", normal),
        Arrow::from_point(hit.point, point_of(reflected), "reflected", mirrored),
    ]
}

/// The angle between a ray and the normal that it meets, turned to face it, in radians; accurate also head-on.
#[must_use]
pub fn incidence_rad(ray: Ray, hit: &Hit) -> f64 {
    let (incident, normal) = (dir_of(ray.dir), dir_of(hit.normal));
    f64::atan2(incident.cross(normal).length(), incident.dot(normal).abs())
}

/// A vector of the scene in f64.
pub fn dir_of(vector: Vec3) -> Dir {
    Dir::from_f64(vector.to_array().map(f64::from))
}

/// A vector in the scene's numbers.
pub fn point_of(vector: Dir) -> Vec3 {
    vector.to_f64().map(|c| c as f32).into()
}

/// A vector as it is shown.
pub fn vector_text(vector: Dir) -> String {
    let [x, y, z] = vector.to_f64().map(number_text);
    format!("({x}, {y}, {z})")
}

/// A number as it is shown: four places, no minus before a zero.
pub fn number_text(x: f64) -> String {
    let text = format!("{x:.4}");
    if text == "-0.0000" {
        "0.0000".to_owned()
    } else {
        text
    }
}

/// A row of numbers.
pub fn row(label: impl Into<String>, value: impl Into<String>) -> (String, String) {
    (label.into(), value.into())
}
