//! Runs an evaluator on slices, by one thread or by all.

use serde::{Deserialize, Serialize};

use crate::mapping::evaluator::{Forward, Inverse};
use crate::mapping::{Dirs, DirsMut, Points, PointsMut};
use crate::math::Isa;

/// Directions that one thread takes at least: 384 KiB with their results, so that handing them over does not count.
const PIECE: usize = 1 << 14;

/// Threads of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Threads {
    /// The caller's.
    One,
    /// As many as there are cores.
    All,
}

impl Threads {
    /// How many those are.
    pub fn count(self) -> usize {
        match self {
            Self::One => 1,
            Self::All => rayon::current_num_threads(),
        }
    }
}

/// Chart points of directions.
pub fn forward(with: &Forward, isa: Isa, threads: Threads, dirs: Dirs<'_>, points: PointsMut<'_>) {
    let count = dirs.len();
    if threads == Threads::One || count <= PIECE {
        return with(isa, dirs, points);
    }
    let half = count / 2;
    let (first, rest) = points.split_at(half);
    rayon::join(
        || forward(with, isa, threads, dirs.part(0..half), first),
        || forward(with, isa, threads, dirs.part(half..count), rest),
    );
}

/// Directions of chart points.
pub fn inverse(with: &Inverse, isa: Isa, threads: Threads, points: Points<'_>, dirs: DirsMut<'_>) {
    let count = points.len();
    if threads == Threads::One || count <= PIECE {
        return with(isa, points, dirs);
    }
    let half = count / 2;
    let (first, rest) = dirs.split_at(half);
    rayon::join(
        || inverse(with, isa, threads, points.part(0..half), first),
        || inverse(with, isa, threads, points.part(half..count), rest),
    );
}
