//! One ray from the eye to its lookups, through what the material does with it.

use glam::Vec3;

use super::steps::{
    Arrow, Dir, Mark, StoryStep, dir_of, incidence_rad, number_text, row, vector_text, vectors,
};
use crate::app::state::AppState;
use crate::app::theme;
use crate::mapping::MappingId;
use crate::optics::material::Surface;
use crate::optics::metal::Metal;
use crate::optics::reflectance::metal_reflectance;
use crate::optics::reflection::reflect_as_printed;
use crate::optics::{self, Meeting};
use crate::scene::{Hit, Ray, Target};

/// The steps of the state's eye ray; none where it is missing or meets nothing.
pub fn steps(state: &AppState, target: &Target) -> Vec<StoryStep> {
    let Some(ray) = state.eye_ray.map(|eye| eye.ray()) else {
        return Vec::new();
    };
    let Some(hit) = target.cast(ray) else {
        return Vec::new();
    };
    let mut told = Told {
        state,
        target,
        ray,
        hit,
        incident: dir_of(ray.dir).normalized(),
        normal: dir_of(hit.normal).normalized(),
        incidence_rad: incidence_rad(ray, &hit),
        arrows: Vec::new(),
        steps: Vec::new(),
    };
    let [incident, normal, reflected] = vectors(ray, &hit);
    told.arrows.push(incident);
    told.eye_ray(dir_of(ray.origin));
    told.hit();
    told.arrows.push(normal);
    told.normal();
    if state.pointed_material().surface == Surface::Ball {
        told.ball_picture();
        return told.steps;
    }
    told.reflected(reflected);
    let material = state.pointed_material();
    match material.surface {
        Surface::Mirror | Surface::Ball => {}
        Surface::Metal => told.metal(material.metal),
        Surface::Veil => told.veil(),
        Surface::Dielectric | Surface::Glass => told.refracted(),
    }
    told.steps
}

/// What has been told so far.
pub(super) struct Told<'a> {
    pub state: &'a AppState,
    pub target: &'a Target,
    pub ray: Ray,
    pub hit: Hit,
    /// Towards the surface.
    pub incident: Dir,
    /// As the object has it: outwards.
    pub normal: Dir,
    pub incidence_rad: f64,
    /// They stay while the story goes on.
    pub arrows: Vec<Arrow>,
    pub steps: Vec<StoryStep>,
}

impl Told<'_> {
    pub fn push(
        &mut self,
        title: impl Into<String>,
        text: impl Into<String>,
        numbers: Vec<(String, String)>,
    ) {
        self.steps.push(StoryStep {
            title: title.into(),
            text: text.into(),
            numbers,
            arrows: self.arrows.clone(),
            ..StoryStep::default()
        });
    }

    /// As `push`, and looks up directions: the first one is the step's lookup.
    pub fn push_lookup(
        &mut self,
        title: impl Into<String>,
        text: impl Into<String>,
        numbers: Vec<(String, String)>,
        marks: Vec<Mark>,
    ) {
        self.push(title, text, numbers);
        if let Some(step) = self.steps.last_mut() {
            step.lookup = marks.first().map(|mark| mark.dir);
            step.marks = marks;
        }
    }

    pub fn cos_incident(&self) -> f64 {
        self.incident.dot(self.normal).abs().min(1.0)
    }

    /// A meeting with a surface of this eta.
    pub fn meeting(&self, eta: f64) -> Meeting<f64> {
        Meeting::at_cosine(self.cos_incident(), eta)
    }

    fn eye_ray(&mut self, origin: Dir) {
        self.push(
            "The eye ray",
            "For each pixel a ray leaves the eye. A click keeps it: then turn the camera to look at it from the side.",
            vec![
                row("eye", vector_text(origin)),
                row("direction d", vector_text(self.incident)),
            ],
        );
    }

    fn hit(&mut self) {
        let object = match self.state.model {
            Some(_) => "model",
            None => self.state.object.name(),
        };
        self.push(
            "The hit",
            format!("It meets the {object} first here. Whatever it would meet behind is hidden."),
            vec![
                row("point", vector_text(dir_of(self.hit.point))),
                row("distance", number_text(f64::from(self.hit.distance))),
            ],
        );
    }

    fn normal(&mut self) {
        let along = self.incident.dot(self.normal);
        let text = if along > 0.0 {
            "The normal, interpolated from the vertices, points a little away from the eye here, near the outline."
        } else {
            "The normal stands upright on the surface. The angle between it and the ray, turned back, is the angle of \
             incidence θ."
        };
        self.push(
            "The normal",
            text,
            vec![
                row("n", vector_text(self.normal)),
                row("cos θ = −d · n", number_text(-along)),
                row("θ", degrees_text(self.incidence_rad)),
            ],
        );
    }

    fn reflected(&mut self, mut arrow: Arrow) {
        let is_printed = self.state.pointed_material().is_printed();
        let along = self.incident.dot(self.normal);
        let dir = if is_printed {
            reflect_as_printed(self.incident, self.normal)
        } else {
            optics::reflect(self.incident, self.normal)
        };
        if is_printed {
            let tip = self.hit.point - (arrow.to - self.hit.point);
            arrow.to = tip;
        }
        let color = arrow.color;
        self.arrows.push(arrow);
        let (formula, text) = if is_printed {
            (
                "r = 2(d · n) n − d",
                "The formula as printed is for a vector that runs from the surface. With the ray's it points into it.",
            )
        } else {
            (
                "r = d − 2(d · n) n",
                "What runs along the normal is turned round, the rest goes on: the angle of reflection is that of incidence.",
            )
        };
        self.push(
            "The reflected ray",
            text,
            vec![
                row("d · n", number_text(along)),
                row(formula, vector_text(dir)),
            ],
        );
        let name = self.state.mapping.info().name;
        let numbers = lookup_rows(self.state.mapping, dir);
        self.push_lookup(
            "Its lookup",
            format!("The {name} is asked in the direction of r; every panel marks where it finds the answer."),
            numbers,
            vec![Mark { dir, color }],
        );
    }

    /// The picture of a lit ball, by the normal.
    fn ball_picture(&mut self) {
        // Right and up as seen along this very ray, as the renderer has it.
        let across = |axis: Vec3, other: Dir| {
            let axis = dir_of(axis);
            let left = axis - self.incident * axis.dot(self.incident) - other * axis.dot(other);
            left.normalized()
        };
        let frame = self.state.camera.ray_frame(1.0);
        let right = across(frame.right, Dir::new(0.0, 0.0, 0.0));
        let up = across(frame.up, right);
        let [x, y, z] = [right, up, self.incident].map(|axis| axis.dot(self.normal));
        let seen = Dir::new(x, y, z);
        let mut numbers = vec![row("n: right, up, away", vector_text(seen))];
        if let Some(place) = MappingId::Matcap.forward(seen) {
            numbers.push(row(
                "u, v",
                format!("{}, {}", number_text(place.u), number_text(place.v)),
            ));
        }
        self.push(
            "The picture of the ball",
            "A sphere-map style asks no surroundings: x and y of the normal, as the eye sees it, are the place in the picture \
             of a lit ball.",
            numbers,
        );
    }

    fn metal(&mut self, metal: Metal) {
        let cos = self.cos_incident();
        let names = ["red", "green", "blue"];
        let mut numbers = vec![row("θ", degrees_text(self.incidence_rad))];
        for (name, [n, k]) in names.into_iter().zip(metal.index_rgb()) {
            let part = metal_reflectance(cos, n, k);
            numbers.push(row(format!("{name}: {n} + {k} i"), number_text(part)));
        }
        self.push(
            "The metal's tint",
            format!(
                "In {} light fades within a fraction of its wavelength: nothing is refracted that could be seen. What is \
                 looked up is multiplied by the reflectance of each colour.",
                metal.name()
            ),
            numbers,
        );
    }

    fn veil(&mut self) {
        let material = self.state.pointed_material();
        let cos = self.cos_incident();
        let (opacity, formula) = if material.opacity_by_angle {
            (1.0 - cos, "opacity = 1 − cos θ")
        } else {
            (f64::from(material.opacity), "opacity")
        };
        let sky = Mark {
            dir: self.incident,
            color: theme::REFRACTED,
        };
        let numbers = lookup_rows(self.state.mapping, self.incident);
        self.push_lookup(
            "The sky behind",
            "The rest of the ray goes straight on, unbent, and looks up the sky.",
            numbers,
            vec![sky],
        );
        self.push(
            "The blend",
            "The reflected light lies over the sky as opaque as this.",
            vec![
                row(formula, number_text(opacity)),
                row("seen", mix_text(opacity, "reflected", "sky")),
            ],
        );
    }
}

/// Chart, u and v of a direction in a map.
pub(super) fn lookup_rows(mapping: MappingId, dir: Dir) -> Vec<(String, String)> {
    let Some(point) = mapping.forward(dir) else {
        return Vec::new();
    };
    let charts = mapping.info().charts;
    let chart = charts.get(point.chart as usize).copied().unwrap_or("");
    vec![row(
        "chart, u, v",
        format!(
            "{chart}, {}, {}",
            number_text(point.u),
            number_text(point.v)
        ),
    )]
}

/// "0.04 reflected + 0.96 refracted".
pub(super) fn mix_text(part: f64, first: &str, second: &str) -> String {
    format!(
        "{} {first} + {} {second}",
        number_text(part),
        number_text(1.0 - part)
    )
}

pub(super) fn degrees_text(angle_rad: f64) -> String {
    format!("{:.3}°", angle_rad.to_degrees())
}
