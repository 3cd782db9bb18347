//! Hoff's derivation of the sphere map, walked for the probe's direction.
//!
//! His eye space is right-handed with z towards the viewer; the world's z runs away from the viewer of the sphere map. The
//! two differ in the sign of z.

use std::f64::consts::TAU;

use glam::Vec3;

use super::steps::{Arrow, Dir, Mark, StoryStep, number_text, point_of, row, vector_text};
use crate::app::theme;
use crate::mapping::{ChartPoint, MappingId};
use crate::optics;

/// Where the viewer looks, in eye space.
const VIEW: [f64; 3] = [0.0, 0.0, -1.0];
/// The direction of the world that has no unique image: the world behind the ball.
pub const SINGULAR: [f32; 3] = [0.0, 0.0, 1.0];
/// Directions around the singular one that show what becomes of it, and their angle from it: small, but wide enough that
/// f32 tells them apart on the rim.
const RIM_DIRECTIONS: u32 = 48;
const RIM_ANGLE_RAD: f64 = 0.01;

/// Eye space to world and back.
fn flipped(v: Dir) -> Dir {
    Dir::new(v.x, v.y, -v.z)
}

/// The steps for a direction of the world.
pub fn steps(probe: Dir) -> Vec<StoryStep> {
    let view = Dir::from_f64(VIEW);
    let r = flipped(probe);
    let half = r - view;
    let length = half.length();
    // The one direction that has no half vector has no normal either.
    let normal = (length > 0.0).then(|| half.normalized());
    let told = |value: Option<String>| value.unwrap_or_else(|| "0/0: undefined".to_owned());

    let [view_color, normal_color, r_color] = theme::VECTORS;
    let ball = normal.map_or(Vec3::ZERO, |n| point_of(flipped(n)));
    let u_arrow = Arrow::onto_point(ball, point_of(flipped(view)), "u", view_color);
    let r_arrow = Arrow::from_point(ball, point_of(probe), "r", r_color);
    let half_dir = point_of(flipped(half));
    let half_arrow = Arrow::from_point(ball, half_dir, "r + (0, 0, 1)", theme::TEXEL);
    let n_arrow = Arrow {
        from: Vec3::ZERO,
        to: ball,
        name: "n".to_owned(),
        color: normal_color,
        arrives: false,
    };
    let step = |title: &str, text: &str, numbers: Vec<_>, arrows: &[&Arrow]| StoryStep {
        title: title.to_owned(),
        text: text.to_owned(),
        numbers,
        // Without a half vector there is nothing to draw of it.
        arrows: arrows
            .iter()
            .filter(|a| a.from != a.to)
            .map(|a| (*a).clone())
            .collect(),
        lookup: Some(probe),
        marks: vec![Mark {
            dir: probe,
            color: r_color,
        }],
    };

    vec![
        StoryStep {
            lookup: None,
            marks: Vec::new(),
            ..step(
                "The viewer and the ball",
                "A small mirror ball of radius 1 is seen from far away: every ray runs along u; choose the object \"sphere\" to see it. Hoff's axes: x right, y up, \
                 z towards the viewer.",
                vec![row("u", vector_text(view))],
                &[&u_arrow],
            )
        },
        step(
            "The reflected vector",
            "Which point of the ball shows the direction under study? There u is mirrored into r: the probe, with its z \
             turned towards the viewer.",
            vec![
                row("the probe in the world", vector_text(probe)),
                row("r", vector_text(r)),
            ],
            &[&u_arrow, &r_arrow],
        ),
        step(
            "The half vector",
            "r = u − 2(u · n) n says that r − u lies along the normal. As u = (0, 0, −1), it is r + (0, 0, 1).",
            vec![
                row("r + (0, 0, 1)", vector_text(half)),
                row("its length", number_text(length)),
            ],
            &[&u_arrow, &r_arrow, &half_arrow],
        ),
        step(
            "The normal",
            "Divided by its length the half vector is the normal. Mirrored there, u becomes r again.",
            vec![
                row("n", told(normal.map(vector_text))),
                row(
                    "u − 2(u · n) n",
                    told(normal.map(|n| vector_text(optics::reflect(view, n)))),
                ),
            ],
            &[&u_arrow, &r_arrow, &n_arrow],
        ),
        step(
            "The point on the ball",
            "On a ball of radius 1 around the origin the point is its normal. Seen from the front, x and y are all that is \
             left of it.",
            vec![
                row("x", told(normal.map(|n| number_text(n.x)))),
                row("y", told(normal.map(|n| number_text(n.y)))),
                row(
                    "from the centre",
                    normal.map_or("1: anywhere on the rim".to_owned(), |n| {
                        number_text(n.x.hypot(n.y))
                    }),
                ),
            ],
            &[&u_arrow, &r_arrow, &n_arrow],
        ),
        step(
            "m",
            "The picture counts from 0 to 1 where x and y run from −1 to 1, so both are halved: m is twice the length.",
            vec![
                row("m", "2√(rx² + ry² + (rz + 1)²)"),
                row(
                    "",
                    format!(
                        "2√({}² + {}² + {}²) = {}",
                        number_text(half.x),
                        number_text(half.y),
                        number_text(half.z),
                        number_text(2.0 * length)
                    ),
                ),
            ],
            &[&u_arrow, &r_arrow, &n_arrow],
        ),
        step(
            "s and t",
            "The place in the picture, t counted upwards. This program's u is s, and its v runs downwards: v = 1 − t.",
            place_rows(r, 2.0 * length, hoff(probe)),
            &[&u_arrow, &r_arrow, &n_arrow],
        ),
        singular_step(length <= 0.0),
    ]
}

/// The map's own point in Hoff's numbers.
fn hoff(probe: Dir) -> Option<ChartPoint<f64>> {
    let conventions = MappingId::Sphere.info().conventions;
    let hoff = conventions.iter().find(|c| c.id == "hoff")?;
    (hoff.forward.1)(probe)
}

/// s and t with their numbers; what comes out is the map's own value.
fn place_rows(r: Dir, m: f64, point: Option<ChartPoint<f64>>) -> Vec<(String, String)> {
    let Some(point) = point else {
        return Vec::new();
    };
    if m <= 0.0 {
        let place = format!("s = {}, t = {}", number_text(point.u), number_text(point.v));
        return vec![
            row("s = rx/m + 1/2", "0/0 + 1/2: undefined"),
            row("t = ry/m + 1/2", "0/0 + 1/2: undefined"),
            row("this program takes", place),
        ];
    }
    let line = |c: f64, value: f64| {
        let [c, m, value] = [c, m, value].map(number_text);
        format!("{c}/{m} + 1/2 = {value}")
    };
    vec![
        row("s = rx/m + 1/2", line(r.x, point.u)),
        row("t = ry/m + 1/2", line(r.y, point.v)),
    ]
}

/// What becomes of r = (0, 0, -1).
fn singular_step(is_there: bool) -> StoryStep {
    let here = if is_there {
        " The probe is there now."
    } else {
        ""
    };
    StoryStep {
        title: "The singular direction".to_owned(),
        text: format!(
            "For r = (0, 0, −1), straight on behind the ball, m is 0 and s, t are 0/0: this one direction is the whole rim. The \
             dots are {RIM_DIRECTIONS} directions {:.2}° away from it.{here}",
            RIM_ANGLE_RAD.to_degrees()
        ),
        numbers: vec![
            row("r", vector_text(Dir::from_f64(VIEW))),
            row("r + (0, 0, 1)", vector_text(Dir::new(0.0, 0.0, 0.0))),
            row("m", number_text(0.0)),
            row("s, t", "0/0: undefined"),
        ],
        arrows: Vec::new(),
        lookup: Some(Dir::from_f64(SINGULAR.map(f64::from))),
        marks: (0..RIM_DIRECTIONS)
            .map(|i| {
                let (sin, cos) = (TAU * f64::from(i) / f64::from(RIM_DIRECTIONS)).sin_cos();
                let (off, along) = RIM_ANGLE_RAD.sin_cos();
                Mark {
                    dir: Dir::new(off * cos, off * sin, along),
                    color: theme::TEXEL,
                }
            })
            .collect(),
    }
}
