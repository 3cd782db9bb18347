//! Which face is which: six pictures put together by their edges.
//!
//! Seams tell a cube up to its 48 symmetries: it may be turned as a whole, and it may be seen in a mirror. Of all ways that
//! fit alike, the one is named that leaves most pictures as they are; its mirror image is named beside it. What a latlong's seam cannot
//! tell either, the names of programs do ([`LatlongWay`]).

mod answer;
mod borders;
mod code;
mod latlong;
mod search;

use self::borders::Borders;
use self::search::{Cube, Way, best_turned, best_ways};
use super::detect::MEETS;
use super::seams::ratio;
use super::{MapShape, Raster};
use crate::mapping::{Arrangement, Axes};

pub use code::{ShaderLanguage, lookup_code};
pub use latlong::{LatlongWay, SkyHint};

/// How many times worse a rival must meet, on the seams where it differs, to be ruled out.
const CLEARLY: f64 = 1.5;

/// A mean difference that is as good as none: what rounding to 8 bits leaves.
const ROUNDING: f64 = 0.25 / 255.0;

/// What was found about six pictures.
#[derive(Clone, Debug)]
pub struct Solution {
    /// What each picture is; of all that fit alike, the one that changes the fewest pictures.
    pub arrangement: Arrangement,
    /// The same seen in a mirror, which fits as well: seams cannot tell them apart.
    pub mirrored: Arrangement,
    /// How well the pictures meet so: 1 as smoothly as inside; `None` where all is even.
    pub score: Option<f64>,
    /// How well they meet as they are labelled.
    pub as_labelled: Option<f64>,
    /// How many times worse the next best meets, on the seams where the two differ.
    pub margin: f64,
    /// Whether the pictures meet, and every other way is clearly worse.
    pub is_certain: bool,
    /// The 48 ways to rename the faces by exchanging and turning round axes.
    pub relabelings: Vec<Relabeling>,
}

/// The pictures with the faces' names exchanged as a signed permutation of the axes does.
#[derive(Clone, Copy, Debug)]
pub struct Relabeling {
    /// The face of a label is where this sends the label's axis.
    pub axes: Axes,
    /// How well the pictures meet, each upright.
    pub upright: Option<f64>,
    /// How well they meet in the best turns, without mirroring any.
    pub turned: Option<f64>,
}

/// Puts the six pictures of a map together: each may be any face, turned and mirrored in any way. The shape says where each
/// picture lies, by its label. `None` for a map that has not six square charts.
pub fn solve(shape: &MapShape, rasters: &[Raster]) -> Option<Solution> {
    let borders = Borders::read(shape, rasters)?;
    let score = |apart: f64| ratio(apart / 12.0, borders.inside);
    let cube = Cube::new();
    let ways = best_ways(&borders, &cube);
    let best = ways.first()?;
    let found = best.arrangement()?;

    let mut margin = f64::INFINITY;
    for rival in &ways[1..] {
        let (here, there, count) = best.where_different(rival, &borders, &cube);
        let rounding = ROUNDING * count as f64;
        margin = margin.min((there + rounding) / (here + rounding));
    }
    let fitting = |is_mirrored| {
        let symmetries = Axes::all().filter(|axes| axes.is_mirroring() == is_mirrored);
        let all = symmetries.map(|axes| found.then(&Arrangement::from_axes(axes)));
        all.min_by_key(effort)
    };
    let (one, other) = (fitting(false)?, fitting(true)?);
    let (arrangement, mirrored) = if effort(&other) < effort(&one) {
        (other, one)
    } else {
        (one, other)
    };
    let score_found = score(best.apart);
    Some(Solution {
        arrangement,
        mirrored,
        score: score_found,
        as_labelled: score(Way::of(&Arrangement::IDENTITY, &borders, &cube).apart),
        margin,
        is_certain: margin >= CLEARLY && score_found.is_some_and(|score| score <= MEETS),
        relabelings: relabelings(&borders, &cube, score),
    })
}

/// What a way asks for: pictures that are changed at all, then those mirrored, then those turned or moved.
fn effort(arrangement: &Arrangement) -> (usize, usize, usize, usize) {
    let held = arrangement.held();
    let count = |is: &dyn Fn(usize) -> bool| (0..6).filter(|label| is(*label)).count();
    (
        arrangement.changed(),
        count(&|label| held[label].turn.is_mirrored()),
        count(&|label| held[label].turn.quarters() != 0),
        count(&|label| held[label].chart as usize != label),
    )
}

fn relabelings(
    borders: &Borders,
    cube: &Cube,
    score: impl Fn(f64) -> Option<f64>,
) -> Vec<Relabeling> {
    let relabeling = |axes: Axes| {
        let faces = Arrangement::from_axes(axes).held().map(|held| held.chart);
        let upright = Arrangement::upright(faces);
        Relabeling {
            axes,
            upright: score(Way::of(&upright, borders, cube).apart),
            turned: score(best_turned(faces, borders, cube)),
        }
    };
    Axes::all().map(relabeling).collect()
}
