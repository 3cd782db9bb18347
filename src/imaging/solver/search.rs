//! Every way to put six pictures on a cube, the best first.
//!
//! There are 6! placements and 8^6 turns; the cube's own 48 symmetries leave every seam as it is, so one picture may stay
//! where it is: 3.9 million ways. They are walked face by face; a branch ends when its seams so far, with the least that
//! the others can add, are worse than the worst way that is kept.

use super::borders::{Borders, PictureSide, side_in_picture};
use crate::mapping::cube_face::{Neighbour, Side, across};
use crate::mapping::{Arrangement, Held, Turn};

/// Ways that are kept: enough that the rival that differs in the fewest seams is among them.
const KEPT: usize = 24;

/// The twelve edges of the cube.
const EDGES: f64 = 12.0;

/// The order in which faces are filled: each meets as many of those before as can be.
const ORDER: [u32; 6] = [0, 4, 2, 3, 5, 1];

/// What meets what, looked up instead of worked out in each of millions of ways.
pub(super) struct Cube {
    across: [[Neighbour; 4]; 6],
    /// By the turn's number.
    in_picture: Vec<[(Side, bool); 4]>,
    /// For each step of the order, the sides of its face that meet faces filled before.
    closing: [Vec<Side>; 6],
}

impl Cube {
    pub fn new() -> Self {
        let across = [0, 1, 2, 3, 4, 5].map(|face| Side::ALL.map(|side| across(face, side)));
        let in_picture = Turn::all().map(|turn| Side::ALL.map(|side| side_in_picture(turn, side)));
        let closing = [0, 1, 2, 3, 4, 5].map(|step: usize| {
            let others = across[ORDER[step] as usize];
            let closes = |side: &Side| ORDER[..step].contains(&others[*side as usize].face);
            Side::ALL.into_iter().filter(closes).collect()
        });
        Self {
            across,
            in_picture: in_picture.collect(),
            closing,
        }
    }

    /// The sides of pictures that meet at a face's side.
    fn met(&self, placed: &[Placed; 6], face: u32, side: Side) -> Met {
        let other = self.across[face as usize][side as usize];
        let in_picture = |face: u32, side: Side| {
            let (picture, turn) = placed[face as usize];
            let number = usize::from(turn.quarters()) + if turn.is_mirrored() { 4 } else { 0 };
            let (side, is_reversed) = self.in_picture[number][side as usize];
            (PictureSide { picture, side }, is_reversed)
        };
        let (a, a_reversed) = in_picture(face, side);
        let (b, b_reversed) = in_picture(other.face, other.side);
        let is_reversed = other.is_reversed ^ a_reversed ^ b_reversed;
        if a <= b {
            (a, b, is_reversed)
        } else {
            (b, a, is_reversed)
        }
    }

    /// Sum of the differences at the sides of a step's face that meet faces filled before.
    fn closed(&self, borders: &Borders, placed: &[Placed; 6], step: usize) -> f64 {
        let sides = self.closing[step].iter();
        sides
            .map(|side| of_pair(borders, self.met(placed, ORDER[step], *side)))
            .sum()
    }
}

/// A picture and its turn.
type Placed = (usize, Turn);

/// One way, and the sum of its twelve mean differences.
#[derive(Clone, Copy)]
pub(super) struct Way {
    /// By face.
    placed: [Placed; 6],
    /// Sum over the edges.
    pub apart: f64,
}

/// Two sides of pictures that meet, in a fixed order, and whether they run against each other.
type Met = (PictureSide, PictureSide, bool);

impl Way {
    /// The way that an arrangement puts its pictures.
    pub fn of(arrangement: &Arrangement, borders: &Borders, cube: &Cube) -> Self {
        let mut placed = [(0, Turn::UPRIGHT); 6];
        for (picture, held) in arrangement.held().iter().enumerate() {
            placed[held.chart as usize] = (picture, held.turn);
        }
        let mut way = Self { placed, apart: 0.0 };
        way.apart = way.met(cube).iter().map(|met| of_pair(borders, *met)).sum();
        way
    }

    /// What each picture is.
    pub fn arrangement(&self) -> Option<Arrangement> {
        let mut held = *Arrangement::IDENTITY.held();
        for (face, (picture, turn)) in self.placed.into_iter().enumerate() {
            held[picture] = Held {
                chart: face as u32,
                turn,
            };
        }
        Arrangement::new(held)
    }

    /// The twelve pairs of sides that meet.
    fn met(&self, cube: &Cube) -> Vec<Met> {
        let mut pairs = Vec::with_capacity(12);
        for face in 0..6 {
            for side in Side::ALL {
                if cube.across[face as usize][side as usize].face > face {
                    pairs.push(cube.met(&self.placed, face, side));
                }
            }
        }
        pairs.sort_unstable();
        pairs
    }

    /// The sums over those seams alone that the other way has not too: (this one's, the other's, how many).
    pub fn where_different(
        &self,
        other: &Self,
        borders: &Borders,
        cube: &Cube,
    ) -> (f64, f64, usize) {
        let (ours, theirs) = (self.met(cube), other.met(cube));
        let only = |these: &[Met], those: &[Met]| -> (f64, usize) {
            let only: Vec<Met> = these
                .iter()
                .copied()
                .filter(|met| !those.contains(met))
                .collect();
            (
                only.iter().map(|met| of_pair(borders, *met)).sum(),
                only.len(),
            )
        };
        let (here, count) = only(&ours, &theirs);
        (here, only(&theirs, &ours).0, count)
    }
}

fn of_pair(borders: &Borders, (a, b, is_reversed): Met) -> f64 {
    borders.apart(a, b, is_reversed)
}

/// The best ways, the best first; no two the same up to a symmetry of the cube.
pub(super) fn best_ways(borders: &Borders, cube: &Cube) -> Vec<Way> {
    let mut walk = Walk {
        borders,
        cube,
        best: Vec::with_capacity(KEPT + 1),
    };
    let mut placed = [(0, Turn::UPRIGHT); 6];
    walk.fill(1, 1, &mut placed, 0.0, 0);
    walk.best
}

struct Walk<'a> {
    borders: &'a Borders,
    cube: &'a Cube,
    best: Vec<Way>,
}

impl Walk<'_> {
    /// Fills the faces from a step on; `used` has a bit for each picture that lies, `edges` have been counted.
    fn fill(&mut self, step: usize, used: u8, placed: &mut [Placed; 6], apart: f64, edges: usize) {
        let Some(face) = ORDER.get(step).copied() else {
            let way = Way {
                placed: *placed,
                apart,
            };
            let at = self.best.partition_point(|other| other.apart <= apart);
            self.best.insert(at, way);
            self.best.truncate(KEPT);
            return;
        };
        for picture in (0..6).filter(|picture| used & (1 << picture) == 0) {
            for turn in Turn::all() {
                placed[face as usize] = (picture, turn);
                let seams = self.cube.closed(self.borders, placed, step);
                let (apart, edges) = (apart + seams, edges + self.cube.closing[step].len());
                let at_least = apart + (EDGES - edges as f64) * self.borders.least;
                if self.best.len() < KEPT
                    || self.best.last().is_some_and(|worst| at_least < worst.apart)
                {
                    self.fill(step + 1, used | 1 << picture, placed, apart, edges);
                }
            }
        }
    }
}

/// The least sum over the edges when each picture lies on this face, in any turn that does not mirror.
pub(super) fn best_turned(faces: [u32; 6], borders: &Borders, cube: &Cube) -> f64 {
    let mut placed = [(0, Turn::UPRIGHT); 6];
    for (picture, face) in faces.into_iter().enumerate() {
        placed[face as usize].0 = picture;
    }
    let mut least = f64::INFINITY;
    turn_from(0, cube, &mut placed, 0.0, borders, &mut least);
    least
}

fn turn_from(
    step: usize,
    cube: &Cube,
    placed: &mut [Placed; 6],
    apart: f64,
    borders: &Borders,
    least: &mut f64,
) {
    let Some(face) = ORDER.get(step).copied() else {
        *least = least.min(apart);
        return;
    };
    for turn in Turn::all().filter(|turn| !turn.is_mirrored()) {
        placed[face as usize].1 = turn;
        let seams = cube.closed(borders, placed, step);
        if apart + seams < *least {
            turn_from(step + 1, cube, placed, apart + seams, borders, least);
        }
    }
}
