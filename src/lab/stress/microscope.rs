//! What an evaluator does around a direction, at any magnification: a picture with a verdict for every pixel.
//!
//! A pixel's direction is computed in f64, from the middle of the picture and the pixel's place on the plane that touches the
//! sphere there, so that no camera's arithmetic is seen. It is then rounded to f32 **once**, component by component, since that
//! is what an evaluator takes; the verdict is about the rounded direction, which f64 holds exactly. Near length 1 the roundings
//! lie 6e-8 rad (3.4e-6 degrees) apart: a picture of 0.001 degrees is 290 of them across, and below some 1e-4 degrees each is seen
//! as a small square.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::budgets::allowed;
use super::verdict::{Exact, Found};
use crate::imaging::{Progress, Stage};
use crate::mapping::{Device, DirList, EvaluatorInfo, MappingId, PointList};
use crate::math::inputs::Random;
use crate::math::{Isa, Vec3};

/// The angles across a picture that make sense, in degrees: from six of f32's steps to a wide camera.
pub const SPAN_DEG: [f64; 2] = [2e-5, 90.0];

/// How long the vectors are that an evaluator gets: rounding falls differently at each length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lengths {
    /// As they come from a camera: to a plane at distance 1, so that the length grows from 1 as 1/cos.
    #[default]
    Plane,
    /// All of this length, before they are rounded.
    Sphere(f64),
}

/// What is looked at, and through what.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The mapping.
    pub map: MappingId,
    /// The id of one of its evaluators.
    pub evaluator: &'static str,
    /// The direction in the middle, of any length but 0.
    pub center: [f64; 3],
    /// Angle across the picture's smaller side, in degrees, in [`SPAN_DEG`].
    pub span_deg: f64,
    /// Length of the vectors.
    pub lengths: Lengths,
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Each pixel is looked at in a random place of its own, the same in every picture, instead of in its middle. Where a pixel
    /// is wider than f32's steps, both grids together would make stripes that neither has.
    pub is_scattered: bool,
}

impl View {
    /// Distance between pixels on the plane at distance 1; near the middle, radians.
    pub fn pitch(&self) -> f64 {
        let [low, high] = SPAN_DEG;
        let span = self.span_deg.clamp(low, high).to_radians();
        let side = self.size[0].min(self.size[1]).max(1);
        2.0 * (0.5 * span).tan() / side as f64
    }

    /// Unit vectors: to the right, up and ahead. Up is +y, around the poles +z.
    fn frame(&self) -> [Vec3<f64>; 3] {
        /// Within 2.5 degrees of a pole, y says little of what is up.
        const STEEP: f64 = 0.999;
        let ahead = Vec3::<f64>::from_f64(self.center).scaled_direction();
        let ahead = ahead.map_or(Vec3::new(0.0, 0.0, 1.0), Vec3::normalized);
        let up = if ahead.y.abs() > STEEP {
            Vec3::new(0.0, 0.0, 1.0)
        } else {
            Vec3::new(0.0, 1.0, 0.0)
        };
        let right = up.cross(ahead).normalized();
        [right, ahead.cross(right), ahead]
    }

    /// From places of the picture in pixels, x to the right and y down from its upper left corner, to directions in f64: on
    /// the plane or on the sphere.
    pub fn directions(&self) -> impl Fn([f64; 2]) -> [f64; 3] + Sync + use<> {
        let ([right, up, ahead], pitch) = (self.frame(), self.pitch());
        let (half, lengths) = (self.size.map(|n| 0.5 * n as f64), self.lengths);
        move |place| {
            let off = |k: usize| (place[k] - half[k]) * pitch;
            let dir = ahead + right * off(0) - up * off(1);
            match lengths {
                Lengths::Plane => dir.to_f64(),
                Lengths::Sphere(length) => (dir.normalized() * length).to_f64(),
            }
        }
    }

    /// With the picture moved by pixels, as a drag moves it.
    #[must_use]
    pub fn panned(self, [right, down]: [f64; 2]) -> Self {
        let middle = self.size.map(|n| 0.5 * n as f64);
        Self {
            center: self.directions()([middle[0] - right, middle[1] - down]),
            ..self
        }
    }

    /// Magnified by a factor, within [`SPAN_DEG`]; what lies at a place in pixels stays there.
    #[must_use]
    pub fn zoomed(self, factor: f64, place: [f64; 2]) -> Self {
        let [low, high] = SPAN_DEG;
        let half = (0.5 * self.span_deg.clamp(low, high)).to_radians().tan();
        let span_deg = 2.0 * (half / factor).atan().to_degrees();
        let nearer = Self {
            span_deg: span_deg.clamp(low, high),
            ..self
        };
        let share = 1.0 - nearer.pitch() / self.pitch();
        let middle = self.size.map(|n| 0.5 * n as f64);
        let center = [0, 1].map(|k: usize| middle[k] + (place[k] - middle[k]) * share);
        Self {
            center: self.directions()(center),
            ..nearer
        }
    }

    /// The place of a direction in the picture, which may lie outside of it; `None` for what lies behind.
    pub fn place(&self, dir: [f64; 3]) -> Option<[f64; 2]> {
        let [right, up, ahead] = self.frame();
        let dir = Vec3::<f64>::from_f64(dir).scaled_direction()?.normalized();
        let depth = dir.dot(ahead);
        // Differences from the middle keep their digits where products with it would lose them.
        let off = dir - ahead;
        let pitch = self.pitch() * depth;
        let half = self.size.map(|n| 0.5 * n as f64);
        (depth > 1e-3).then(|| {
            [
                half[0] + off.dot(right) / pitch,
                half[1] - off.dot(up) / pitch,
            ]
        })
    }
}

/// What is said of a pixel; where several things are, the first of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The direction got no chart.
    Hole,
    /// A coordinate is not a finite number.
    NotFinite,
    /// Another chart than in exact arithmetic; where charts meet exactly, each is right.
    WrongChart,
    /// A coordinate lies outside of [0, 1].
    OutOfRange,
    /// The error is larger than what is allowed to the evaluator.
    TooFar,
    /// Nothing to complain of.
    Right,
    /// The mapping promises no error for the direction: the other half, or the one direction that is the whole rim.
    Uncovered,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Hole,
        Self::NotFinite,
        Self::WrongChart,
        Self::OutOfRange,
        Self::TooFar,
        Self::Right,
        Self::Uncovered,
    ];

    /// In words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hole => "hole: no chart",
            Self::NotFinite => "not a number",
            Self::WrongChart => "wrong chart",
            Self::OutOfRange => "outside of [0, 1]",
            Self::TooFar => "error over what is allowed",
            Self::Right => "right",
            Self::Uncovered => "not covered",
        }
    }
}

/// What was found at a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// In a word.
    pub verdict: Verdict,
    /// The direction as the evaluator got it.
    pub dir: [f32; 3],
    /// Angle between the direction and that of its chart point in radians; 0 where there is no such point.
    pub error_rad: f64,
}

/// What was seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Of what.
    pub view: View,
    /// Row by row from the top.
    pub pixels: Vec<Pixel>,
    /// What is allowed to the evaluator, in radians.
    pub allowed_rad: f64,
    /// The largest error, in radians.
    pub largest_error_rad: f64,
    /// How many pixels have each verdict.
    counts: [usize; Verdict::ALL.len()],
}

impl Picture {
    fn new(view: View, pixels: Vec<Pixel>, allowed_rad: f64) -> Self {
        let mut counts = [0; Verdict::ALL.len()];
        for pixel in &pixels {
            counts[pixel.verdict as usize] += 1;
        }
        Self {
            view,
            allowed_rad,
            largest_error_rad: pixels.iter().fold(0.0, |m, p| p.error_rad.max(m)),
            counts,
            pixels,
        }
    }

    /// How many pixels have a verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.counts[verdict as usize]
    }

    /// The pixel in a column and row.
    pub fn at(&self, [column, row]: [usize; 2]) -> Option<&Pixel> {
        let [columns, _] = self.view.size;
        let index = row.checked_mul(columns)?.checked_add(column)?;
        (column < columns).then(|| self.pixels.get(index)).flatten()
    }
}

/// The directions of a row of pixels, each rounded to f32 once.
fn row_dirs(view: &View, row: usize) -> DirList {
    let direction = view.directions();
    let mut random = Random::new(row as u64);
    let mut off = || {
        if view.is_scattered {
            random.unit()
        } else {
            0.5
        }
    };
    (0..view.size[0])
        .map(|column| [column as f64 + off(), row as f64 + off()])
        .map(|place| direction(place).map(|c| c as f32))
        .collect()
}

/// Chart points of all rows, where a shader computes them: `device` takes one row after the other.
fn points_of_shader(
    view: &View,
    evaluator: &EvaluatorInfo,
    device: &dyn Device,
    progress: &Progress,
) -> Option<Vec<PointList>> {
    let shader = evaluator.start(view.map, device).ok()?;
    let row = |row: usize| {
        let mut points = PointList::zeros(view.size[0]);
        let run = shader.forward(row_dirs(view, row).view(), points.view_mut());
        run.ok()
            .filter(|()| !progress.is_cancelled())
            .map(|()| points)
    };
    (0..view.size[1]).map(row).collect()
}

/// Looks, on all cores; `None` when the progress is cancelled, the mapping has no such evaluator, or the device cannot run it.
pub fn look(view: &View, device: &dyn Device, progress: &Progress) -> Option<Picture> {
    progress.enter(Stage::Measuring);
    let evaluator = view.map.evaluator(view.evaluator)?;
    let [columns, rows] = view.size;
    let of_shader = match evaluator.form() {
        Some(_) => Some(points_of_shader(view, evaluator, device, progress)?),
        None => None,
    };
    let allowed_rad = allowed(view.map, view.evaluator).max_forward_rad;
    let coverage = view.map.info().coverage;
    // Beyond its cut a mapping promises nothing at all.
    let has_cut = coverage.has_cut();
    let done = AtomicUsize::new(0);
    let row = |row: usize| -> Option<Vec<Pixel>> {
        if progress.is_cancelled() {
            return None;
        }
        let dirs = row_dirs(view, row);
        let mut own = PointList::zeros(columns);
        let points = match (&of_shader, evaluator.processor()) {
            (Some(all), _) => all.get(row)?.view(),
            (None, processor) => {
                (processor?.forward)(Isa::best(), dirs.view(), own.view_mut());
                own.view()
            }
        };
        let pixel = |k: usize| {
            let dir = dirs.view().at(k);
            let exact = Exact::of(view.map, dir.to_f64());
            let found = Found::of(view.map, dir.to_f64(), exact, points.at(k));
            let error_rad = found.forward_rad.unwrap_or(0.0);
            let is_covered = coverage.contains(dir.to_f64());
            let verdict = match found {
                _ if has_cut && !is_covered => Verdict::Uncovered,
                Found { is_hole: true, .. } => Verdict::Hole,
                Found {
                    is_not_finite: true,
                    ..
                } => Verdict::NotFinite,
                Found {
                    is_wrong_chart: true,
                    ..
                } => Verdict::WrongChart,
                Found {
                    is_out_of_range: true,
                    ..
                } => Verdict::OutOfRange,
                // The rim's direction: any point of the rim will do.
                _ if !is_covered => Verdict::Uncovered,
                _ if error_rad > allowed_rad => Verdict::TooFar,
                _ => Verdict::Right,
            };
            Pixel {
                verdict,
                dir: dir.to_array(),
                error_rad,
            }
        };
        let pixels = (0..columns).map(pixel).collect();
        let before = done.fetch_add(1, Ordering::Relaxed);
        progress.step(before + 1, rows);
        Some(pixels)
    };
    let pixels: Option<Vec<Vec<Pixel>>> = (0..rows).into_par_iter().map(row).collect();
    Some(Picture::new(*view, pixels?.concat(), allowed_rad))
}
