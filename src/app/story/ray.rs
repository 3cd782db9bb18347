//! One ray from the eye to its lookups, through what the material does with it.

use egui::Color32;
use glam::Vec3;

use super::steps::{
    Arrow, Dir, Mark, StoryStep, dir_of, incidence_rad, number_text, point_of, row, vector_text,
    vectors,
};
use crate::app::state::AppState;
use crate::mapping::MappingId;
use crate::optics::ball::{
    ball_bounce, ball_enter, ball_exit_dir, ball_exit_weight, ball_left_weight,
};
use crate::optics::curve::widened;
use crate::optics::material::{Material, Surface, Surfaces};
use crate::optics::metal::Metal;
use crate::optics::reflectance::{Shape, head_on, metal_reflectance};
use crate::optics::reflection::reflect_as_printed;
use crate::optics::spectrum::line_color;
use crate::optics::wavelengths::{Wavelength, wavelengths};
use crate::optics::{self, Formula, Meeting};
use crate::scene::{Hit, Object, Target};

/// A refracted ray that has no colour of its own, and the sky behind a veil: Okabe and Ito's reddish purple.
const REFRACTED: Color32 = Color32::from_rgb(204, 121, 167);
/// Arrows of what happens outside: incident, normal, reflected.
const AT_THE_SURFACE: usize = 3;
/// Most refracted rays that are shown: more would hide one another.
pub const MOST_RAYS: usize = 8;

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
    if state.material.surface == Surface::Ball {
        told.ball_picture();
        return told.steps;
    }
    told.reflected(reflected);
    let material = &state.material;
    match material.surface {
        Surface::Mirror | Surface::Ball => {}
        Surface::Metal => told.metal(material.metal),
        Surface::Veil => told.veil(),
        Surface::Dielectric | Surface::Glass => told.refracted(),
    }
    told.steps
}

/// What has been told so far.
struct Told<'a> {
    state: &'a AppState,
    hit: Hit,
    /// Towards the surface.
    incident: Dir,
    /// As the object has it: outwards.
    normal: Dir,
    incidence_rad: f64,
    /// They stay while the story goes on.
    arrows: Vec<Arrow>,
    steps: Vec<StoryStep>,
}

/// One of the rays that are refracted.
struct Refracted {
    /// Empty where there is but one.
    name: String,
    color: Color32,
    meeting: Meeting<f64>,
    /// `None` at total internal reflection.
    dir: Option<Dir>,
}

impl Told<'_> {
    fn push(
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
    fn push_lookup(
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

    fn cos_incident(&self) -> f64 {
        self.incident.dot(self.normal).abs().min(1.0)
    }

    /// A meeting with a surface of this eta.
    fn meeting(&self, eta: f64) -> Meeting<f64> {
        Meeting::at_cosine(self.cos_incident(), eta)
    }

    fn eye_ray(&mut self, origin: Dir) {
        self.push(
            "The eye ray",
            "For each pixel a ray leaves the eye. This one is kept: turn the camera to look at it from the side.",
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
        let is_printed = self.state.material.printed_reflection;
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
        let material = &self.state.material;
        let cos = self.cos_incident();
        let (opacity, formula) = if material.opacity_by_angle {
            (1.0 - cos, "opacity = 1 − cos θ")
        } else {
            (f64::from(material.opacity), "opacity")
        };
        let sky = Mark {
            dir: self.incident,
            color: REFRACTED,
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

    /// Everything about refraction, of a dielectric or a glass.
    fn refracted(&mut self) {
        let material = &self.state.material;
        let rays = self.refracted_rays(material);
        let cos = self.cos_incident();
        let k_rows = rays.iter().map(|ray| {
            let eta = ray.meeting.eta;
            let label = format!("k{}", in_brackets(&ray.name));
            let value = format!(
                "1 − {}²(1 − {}²) = {}",
                number_text(eta),
                number_text(cos),
                number_text(ray.meeting.k)
            );
            row(label, value)
        });
        let mut numbers = vec![row("k", "1 − η²(1 − cos²θ), η = n₁/n₂")];
        numbers.extend(k_rows);
        let lost = rays.iter().filter(|ray| ray.dir.is_none()).count();
        let text = match lost {
            0 => {
                "k is the squared cosine of the refracted ray. It is positive: light gets through."
            }
            n if n == rays.len() => {
                "k is below 0: no angle of refraction has that sine, and no light gets through."
            }
            _ => {
                "k is the squared cosine of the refracted ray. Where it is below 0, no light of that wavelength gets through."
            }
        };
        self.push("Does light get through?", text, numbers);
        if lost == rays.len() {
            self.total_reflection(&rays);
        } else {
            self.bent(&rays);
            if material.surfaces == Surfaces::Both {
                self.inside(&rays);
                return;
            }
        }
        self.reflectance(&rays);
    }

    fn refracted_rays(&self, material: &Material) -> Vec<Refracted> {
        let all = wavelengths(material);
        let last = all.len().saturating_sub(1);
        let shown = all.len().min(MOST_RAYS);
        // Evenly chosen, the first and the last among them.
        let chosen = (0..shown).filter_map(|i| all.get(i * last / (shown - 1).max(1)));
        chosen.map(|w| self.wave(w)).collect()
    }

    fn wave(&self, wavelength: &Wavelength) -> Refracted {
        let eta = f64::from(wavelength.eta);
        let is_one = self.state.material.surface != Surface::Glass;
        Refracted {
            name: if is_one {
                String::new()
            } else {
                format!("{:.0} nm", wavelength.wavelength_um * 1000.0)
            },
            color: if is_one {
                REFRACTED
            } else {
                hue(wavelength.wavelength_um)
            },
            meeting: self.meeting(eta),
            dir: optics::refract(self.incident, self.normal, eta),
        }
    }

    /// The wavelength in the middle, at which the reflectance is computed for all.
    fn middle(&self) -> Option<Refracted> {
        let all = wavelengths(&self.state.material);
        all.get(all.len() / 2).map(|w| self.wave(w))
    }

    fn total_reflection(&mut self, rays: &[Refracted]) {
        let critical = rays
            .first()
            .and_then(|ray| optics::critical_angle_rad(ray.meeting.eta));
        let mut numbers = vec![row("θ", degrees_text(self.incidence_rad))];
        numbers.extend(critical.map(|angle| row("critical angle", degrees_text(angle))));
        self.push(
            "Total internal reflection",
            "The ray is steeper than the critical angle: all light is reflected. Nothing is refracted, so nothing more is looked \
             up.",
            numbers,
        );
    }

    fn bent(&mut self, rays: &[Refracted]) {
        let last = rays.len().saturating_sub(1);
        let mut numbers = Vec::new();
        for (i, ray) in rays.iter().enumerate() {
            let Some(dir) = ray.dir else {
                numbers.push(row(ray.label("t"), "totally reflected"));
                continue;
            };
            let angle = ray.meeting.cos_refracted.clamp(0.0, 1.0).acos();
            if rays.len() == 1 {
                numbers.push(row(ray.label("t"), vector_text(dir)));
                numbers.push(row("angle of refraction", degrees_text(angle)));
            } else {
                // The directions hardly differ: their angles do.
                let eta = number_text(ray.meeting.eta);
                let turned = format!("η {eta}, {} off n", degrees_text(angle));
                numbers.push(row(ray.label("t"), turned));
            }
            // In a fan only the outermost are named: the names would cover one another.
            let name = match (ray.name.is_empty(), i == 0 || i == last) {
                (true, _) => "refracted",
                (false, true) => ray.name.as_str(),
                (false, false) => "",
            };
            let arrow = Arrow::from_point(self.hit.point, point_of(dir), name, ray.color);
            self.arrows.push(arrow);
        }
        let (title, text) = if rays.len() == 1 {
            (
                "The refracted ray",
                "Snell's law: η times the sine of the angle of incidence is the sine of the angle of refraction.".to_owned(),
            )
        } else {
            (
                "The refracted rays",
                format!(
                    "Each wavelength has its own index, and its own angle: {} of them are shown.",
                    rays.len()
                ),
            )
        };
        self.push(title, text, numbers);
        let seen: Vec<&Refracted> = rays.iter().filter(|ray| ray.dir.is_some()).collect();
        let numbers = seen.iter().flat_map(|ray| {
            let rows = ray
                .dir
                .map_or(Vec::new(), |dir| lookup_rows(self.state.mapping, dir));
            let named = !ray.name.is_empty();
            rows.into_iter().map(move |(label, value)| {
                if named {
                    row(format!("{label}{}", in_brackets(&ray.name)), value)
                } else {
                    row(label, value)
                }
            })
        });
        let numbers = numbers.collect();
        let marks = seen.iter().filter_map(|ray| {
            Some(Mark {
                dir: ray.dir?,
                color: ray.color,
            })
        });
        let marks = marks.collect();
        let text = match self.state.material.surfaces {
            Surfaces::One if seen.len() == 1 => {
                "The map is asked in the direction that the ray has inside the body, as if there were no second surface."
            }
            Surfaces::One => {
                "The map is asked once for each wavelength, in the direction that its ray has inside the body."
            }
            Surfaces::Both => "With one surface only, the map would be asked in these directions.",
        };
        self.push_lookup("Its lookup", text, numbers, marks);
    }

    /// With two surfaces the ray goes on: through the ball exactly, else in words.
    fn inside(&mut self, rays: &[Refracted]) {
        let bounces = self.state.material.bounces;
        let is_ball = self.state.model.is_none() && self.state.object == Object::Sphere;
        let Some(middle) = self.middle().filter(|_| is_ball) else {
            self.push(
                "Inside the body",
                "The ray goes on inside until it meets the surface again: there a part of it leaves and looks up the map, and \
                 the rest is reflected inwards.",
                vec![row("inner reflections followed", bounces.to_string())],
            );
            return;
        };
        let path = |eta: f64| {
            let enter = ball_enter(self.incident, self.normal, eta);
            let path = std::iter::successors(Some(enter), |ray| Some(ball_bounce(*ray)));
            path.take(1 + bounces as usize).collect::<Vec<_>>()
        };
        let chords = path(middle.meeting.eta);
        let all: Vec<_> = rays
            .iter()
            .map(|ray| (ray, path(ray.meeting.eta)))
            .collect();

        // One chord after the other, instead of the short arrows of the first surface.
        self.arrows.truncate(AT_THE_SURFACE);
        let mut from = self.hit.point;
        for ray in &chords {
            let to = point_of(ray.normal);
            self.arrows.push(Arrow {
                from,
                to,
                name: String::new(),
                color: middle.color,
                arrives: true,
            });
            from = to;
        }
        let angle = chords
            .first()
            .map(|ray| ray.cos_refracted.clamp(0.0, 1.0).acos());
        let mut numbers: Vec<_> = angle
            .map(|angle| row("angle inside", degrees_text(angle)))
            .into_iter()
            .collect();
        numbers.extend(
            chords
                .iter()
                .enumerate()
                .map(|(i, ray)| row(format!("point {}", i + 1), vector_text(ray.normal))),
        );
        self.push(
            "Inside the ball",
            "The ray goes on and meets the ball again, always at the same angle: there a part of it leaves, and the rest is \
             reflected inwards.",
            numbers,
        );

        let mut marks = Vec::new();
        let last = rays.len().saturating_sub(1);
        for (i, (ray, path)) in all
            .iter()
            .enumerate()
            .filter(|(_, (ray, _))| ray.dir.is_some())
        {
            for (inner, at) in path.iter().enumerate() {
                let dir = ball_exit_dir(*at);
                let name = if inner == 0 && (i == 0 || i == last) {
                    ray.label("out")
                } else {
                    String::new()
                };
                let point = point_of(at.normal);
                let arrow = Arrow::from_point(point, point_of(dir), name, ray.color);
                self.arrows.push(arrow);
                let color = ray.color;
                marks.push(Mark { dir, color });
            }
        }
        let mut numbers = vec![row(
            "reflected outside",
            number_text(outside_weight(&middle)),
        )];
        numbers.extend(chords.iter().enumerate().map(|(inner, at)| {
            row(
                format!("out after {inner} inner reflections"),
                number_text(ball_exit_weight(*at)),
            )
        }));
        if let Some(end) = chords.last() {
            numbers.push(row(
                "followed no further",
                number_text(ball_left_weight(*end)),
            ));
        }
        self.push_lookup(
            "The ways out",
            "Whatever leaves looks up the map in its own direction. What is seen is the sum of these parts; together they are 1.",
            numbers,
            marks,
        );
    }

    fn reflectance(&mut self, rays: &[Refracted]) {
        let Some(ray) = self.middle() else {
            return;
        };
        let material = &self.state.material;
        let shape = widened(material.shape);
        let meeting = &ray.meeting;
        let formula = material.formula;
        let part = if meeting.is_total() {
            1.0
        } else {
            formula.reflectance(meeting, &shape)
        };
        let mut numbers = Vec::new();
        if !ray.name.is_empty() {
            numbers.push(row("at", ray.name.clone()));
        }
        numbers.extend(formula_rows(formula, meeting, material.shape));
        let exact = Formula::Fresnel.reflectance(meeting, &shape);
        if formula != Formula::Fresnel {
            numbers.push(row(Formula::Fresnel.name(), number_text(exact)));
        }
        numbers.push(row("seen", mix_text(part, "reflected", "refracted")));
        let text = if meeting.is_total() {
            "All of it is reflected, whatever the formula says."
        } else {
            "How much is reflected says the formula of the material; the rest is refracted. The two colours are mixed like that."
        };
        let marks = [self
            .steps
            .iter()
            .find_map(|step| step.marks.first().copied())];
        let mut marks: Vec<Mark> = marks.into_iter().flatten().collect();
        marks.extend(rays.iter().filter_map(|ray| {
            Some(Mark {
                dir: ray.dir?,
                color: ray.color,
            })
        }));
        self.push("The mix", text, numbers);
        if let Some(step) = self.steps.last_mut() {
            step.marks = marks;
        }
    }
}

impl Refracted {
    /// The wavelength, or what a ray without one is called.
    fn label(&self, or: &str) -> String {
        if self.name.is_empty() {
            or.to_owned()
        } else {
            self.name.clone()
        }
    }
}

/// Part of the unpolarised light that the first surface reflects.
fn outside_weight(ray: &Refracted) -> f64 {
    Formula::Fresnel.reflectance(&ray.meeting, &Shape::default())
}

fn in_brackets(name: &str) -> String {
    if name.is_empty() {
        String::new()
    } else {
        format!(" ({name})")
    }
}

/// Chart, u and v of a direction in a map.
fn lookup_rows(mapping: MappingId, dir: Dir) -> Vec<(String, String)> {
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

/// The formula with the numbers put in.
fn formula_rows(
    formula: Formula,
    meeting: &Meeting<f64>,
    shape: Shape<f32>,
) -> Vec<(String, String)> {
    let reflectance = |formula: Formula| formula.reflectance(meeting, &widened(shape));
    let value = number_text(reflectance(formula));
    let f = number_text(head_on(meeting.eta));
    let cos = number_text(meeting.cos_incident);
    let Shape {
        exponent,
        bias,
        scale,
        power,
    } = shape;
    let with_numbers = match formula {
        Formula::Fresnel => {
            let of = |f: Formula| row(f.name(), number_text(reflectance(f)));
            return vec![
                of(Formula::FresnelS),
                of(Formula::FresnelP),
                row(formula.name(), format!("(s + p)/2 = {value}")),
            ];
        }
        Formula::FresnelS | Formula::FresnelP => value,
        Formula::Schlick => format!("{f} + (1 − {f})(1 − {cos})^{exponent} = {value}"),
        Formula::Cg => format!("{bias} + {scale}(1 − {cos})^{power}, at most 1 = {value}"),
        Formula::Simple => format!("1 − {cos}^{power} = {value}"),
        Formula::PrintedSign => format!("{f} + (1 − {f})(1 + {cos})^{power} = {value}"),
        Formula::PrintedMix => format!("f = {f}"),
    };
    vec![row(formula.name(), with_numbers)]
}

/// "0.04 reflected + 0.96 refracted".
fn mix_text(part: f64, first: &str, second: &str) -> String {
    format!(
        "{} {first} + {} {second}",
        number_text(part),
        number_text(1.0 - part)
    )
}

fn degrees_text(angle_rad: f64) -> String {
    format!("{:.3}°", angle_rad.to_degrees())
}

/// The colour that stands for a wavelength.
fn hue(wavelength_um: f32) -> Color32 {
    let [r, g, b] = line_color(wavelength_um.into()).map(|c| c as f32);
    egui::Rgba::from_rgb(r, g, b).into()
}
