//! The part of the story that only refracting materials have: k, the refracted rays, their way through the body, and the mix.

use egui::Color32;
use glam::Vec3;

use super::ray::{Told, degrees_text, lookup_rows, mix_text};
use super::steps::{Arrow, Dir, Mark, dir_of, number_text, point_of, row, vector_text};
use crate::app::theme;
use crate::optics::ball::{
    ball_bounce, ball_enter, ball_exit_dir, ball_exit_weight, ball_left_weight,
};
use crate::optics::curve::widened;
use crate::optics::material::{Material, Surface, Surfaces};
use crate::optics::reflectance::{Shape, head_on};
use crate::optics::spectrum::line_color;
use crate::optics::wavelengths::{Wavelength, wavelengths};
use crate::optics::{self, Formula, Meeting};
use crate::scene::Object;
use crate::scene::trace::trace;

/// Arrows of what happens outside: incident, normal, reflected.
const AT_THE_SURFACE: usize = 3;
/// Most refracted rays that are shown: more would hide one another.
pub const MOST_RAYS: usize = 8;

/// One of the rays that are refracted.
struct Refracted {
    /// Empty where there is but one.
    name: String,
    color: Color32,
    meeting: Meeting<f64>,
    /// `None` at total internal reflection.
    dir: Option<Dir>,
}

/// What becomes of light at one wavelength that meets both surfaces, as parts of what came.
struct Through {
    outside: f64,
    ways: Vec<Way>,
    /// Still inside at the end.
    lost: f64,
}

/// A way out.
struct Way {
    point: Vec3,
    dir: Dir,
    weight: f64,
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

impl Told<'_> {
    /// Everything about refraction, of a dielectric or a glass.
    pub fn refracted(&mut self) {
        let material = self.state.pointed_material();
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
        let is_one = self.state.pointed_material().surface != Surface::Glass;
        Refracted {
            name: if is_one {
                String::new()
            } else {
                format!("{:.0} nm", wavelength.wavelength_um * 1000.0)
            },
            color: if is_one {
                theme::REFRACTED
            } else {
                hue(wavelength.wavelength_um)
            },
            meeting: self.meeting(eta),
            dir: optics::refract(self.incident, self.normal, eta),
        }
    }

    /// The wavelength in the middle, at which the reflectance is computed for all.
    fn middle(&self) -> Option<Refracted> {
        let all = wavelengths(self.state.pointed_material());
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
            // A fan is named once: its names would cover one another.
            let name = match rays.first() {
                Some(first) if i == last && rays.len() > 1 => {
                    format!("{} to {}", first.name, ray.name)
                }
                _ if rays.len() > 1 => String::new(),
                _ => "refracted".to_owned(),
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
        let text = match self.state.pointed_material().surfaces {
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

    /// With two surfaces the ray goes on: in, inner reflections, and out.
    fn inside(&mut self, rays: &[Refracted]) {
        let Some(middle) = self.middle() else {
            return;
        };
        let through = self.through(middle.meeting.eta);
        // One chord after the other, instead of the short arrows of the first surface.
        self.arrows.truncate(AT_THE_SURFACE);
        let mut from = self.hit.point;
        for way in &through.ways {
            self.arrows.push(Arrow {
                from,
                to: way.point,
                name: String::new(),
                color: middle.color,
                arrives: true,
            });
            from = way.point;
        }
        let point_rows = through.ways.iter().enumerate().map(|(i, way)| {
            let label = format!("point {}", i + 1);
            row(label, vector_text(dir_of(way.point)))
        });
        let point_rows = point_rows.collect();
        self.push(
            "Inside",
            "The ray goes on and meets the surface again from inside: there a part of it leaves, and the rest is reflected \
             inwards.",
            point_rows,
        );

        let mut marks = Vec::new();
        for ray in rays.iter().filter(|ray| ray.dir.is_some()) {
            for way in self.through(ray.meeting.eta).ways {
                // Where all is reflected inwards nothing leaves.
                if way.weight <= 0.0 {
                    continue;
                }
                let (point, dir) = (way.point, point_of(way.dir));
                self.arrows
                    .push(Arrow::from_point(point, dir, "", ray.color));
                marks.push(Mark {
                    dir: way.dir,
                    color: ray.color,
                });
            }
        }
        let mut numbers = vec![row("reflected outside", number_text(through.outside))];
        if !middle.name.is_empty() {
            numbers.insert(0, row("at", middle.name));
        }
        numbers.extend(through.ways.iter().enumerate().map(|(inner, way)| {
            let label = match inner {
                0 => "out at once".to_owned(),
                1 => "out after 1 inner reflection".to_owned(),
                _ => format!("out after {inner} inner reflections"),
            };
            row(label, number_text(way.weight))
        }));
        numbers.push(row("followed no further", number_text(through.lost)));
        self.push_lookup(
            "The ways out",
            "Whatever leaves looks up the map in its own direction. What is seen is the sum of these parts; together with what is \
             followed no further they are 1.",
            numbers,
            marks,
        );
    }

    /// The light's ways through both surfaces: exact in the ball, else along the triangles.
    fn through(&self, eta: f64) -> Through {
        let bounces = self.state.pointed_material().bounces;
        let is_ball = self.state.model.is_none() && self.state.object == Object::Sphere;
        if is_ball {
            let enter = ball_enter(self.incident, self.normal, eta);
            let path = std::iter::successors(Some(enter), |ray| Some(ball_bounce(*ray)));
            let path: Vec<_> = path.take(1 + bounces as usize).collect();
            return Through {
                outside: 0.5 * (enter.reflectance_s + enter.reflectance_p),
                lost: path.last().map_or(0.0, |end| ball_left_weight(*end)),
                ways: path
                    .iter()
                    .map(|ray| Way {
                        point: point_of(ray.normal),
                        dir: ball_exit_dir(*ray),
                        weight: ball_exit_weight(*ray),
                    })
                    .collect(),
            };
        }
        let traced = trace(self.target, self.ray, eta as f32, bounces);
        let mut escapes = traced.as_slice().iter();
        Through {
            outside: escapes.next().map_or(0.0, |escape| escape.weight.into()),
            lost: traced.lost().into(),
            ways: escapes
                .map(|escape| Way {
                    point: escape.point,
                    dir: dir_of(escape.dir),
                    weight: escape.weight.into(),
                })
                .collect(),
        }
    }

    fn reflectance(&mut self, rays: &[Refracted]) {
        let Some(ray) = self.middle() else {
            return;
        };
        let material = self.state.pointed_material();
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

fn in_brackets(name: &str) -> String {
    if name.is_empty() {
        String::new()
    } else {
        format!(" ({name})")
    }
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

/// The colour that stands for a wavelength.
fn hue(wavelength_um: f32) -> Color32 {
    let [r, g, b] = line_color(wavelength_um.into()).map(|c| c as f32);
    egui::Rgba::from_rgb(r, g, b).into()
}
