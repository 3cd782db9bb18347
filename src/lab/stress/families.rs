//! Inputs as nasty as they come, one family after the other.

use serde::Serialize;

use crate::math::inputs::{Random, SIGN_PATTERNS};
use crate::math::ulp::step_ulps;

/// A family of inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// Even over the sphere.
    Uniform,
    /// Within 64 ULP, and within powers of two, of every face's border, edge, corner, pole, rim and date line.
    Borders,
    /// Within the paper's black discs, around the middles of the cube's edges.
    EdgeMiddles,
    /// Exact ties: the 26 patterns of signs at 60 exponents.
    Ties,
    /// Lengths from the smallest subnormal to the largest float.
    Lengths,
    /// Patterns with -0 for each 0.
    NegativeZeros,
    /// NaN, infinities and zeros: no directions.
    NoDirections,
    /// Seeded random bits, whatever number they are.
    Bits,
    /// Along every edge of the cube, and across it by one ULP, in steps of f16, of single floats, and of f64 rounded to f32.
    Walks,
}

impl Family {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Uniform,
        Self::Borders,
        Self::EdgeMiddles,
        Self::Ties,
        Self::Lengths,
        Self::NegativeZeros,
        Self::NoDirections,
        Self::Bits,
        Self::Walks,
    ];

    /// The word in reports.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Borders => "borders",
            Self::EdgeMiddles => "edge-middles",
            Self::Ties => "ties",
            Self::Lengths => "lengths",
            Self::NegativeZeros => "negative-zeros",
            Self::NoDirections => "no-directions",
            Self::Bits => "bits",
            Self::Walks => "walks",
        }
    }

    /// The inputs, about `effort` of them where they can be counted, the same on every run.
    pub fn inputs(self, effort: usize) -> Vec<[f32; 3]> {
        let mut random = Random::new(0x57E5 + self as u64);
        let patterns = || SIGN_PATTERNS.iter().map(|signs| signs.map(f32::from));
        match self {
            Self::Uniform => (0..effort).map(|_| random.direction()).collect(),
            Self::Borders => (0..effort).map(|_| border(&mut random)).collect(),
            Self::EdgeMiddles => (0..effort).map(|_| edge_middle(&mut random)).collect(),
            Self::Ties => (0..60)
                .flat_map(|step| patterns().map(move |p| p.map(|c| c * 2f32.powi(-126 + 4 * step))))
                .collect(),
            Self::Lengths => (0..effort).map(|_| any_length(&mut random)).collect(),
            Self::NegativeZeros => patterns()
                .flat_map(|p| {
                    (1..8).map(move |mask: u32| {
                        let mut dir = p;
                        for (k, c) in dir.iter_mut().enumerate() {
                            if *c == 0.0 && mask & (1 << k) != 0 {
                                *c = -0.0;
                            }
                        }
                        dir
                    })
                })
                .collect(),
            Self::NoDirections => no_directions(),
            Self::Bits => (0..effort)
                .map(|_| [(); 3].map(|()| f32::from_bits((random.bits() >> 32) as u32)))
                .collect(),
            Self::Walks => walks(effort),
        }
    }
}

/// A pattern of signs at some length, each component moved by up to 64 ULP or by a power of two.
fn border(random: &mut Random) -> [f32; 3] {
    if random.below(2) == 0 {
        return random.adversarial();
    }
    let pattern = SIGN_PATTERNS[random.below(26) as usize];
    let length = if random.below(2) == 0 {
        1.0
    } else {
        0.5 + random.unit() as f32
    };
    // Two components alike and the third anything: along an edge, or along a meridian through a seam.
    let free = (random.below(2) == 0).then(|| random.below(3) as usize);
    let mut dir =
        pattern.map(|sign| step_ulps(f32::from(sign) * length, random.below(129) as i32 - 64));
    if let Some(free) = free {
        dir[free] = length * (2.0 * random.unit() as f32 - 1.0);
    }
    dir
}

/// Within 1e-3 rad of the middle of an edge, at length 1.
fn edge_middle(random: &mut Random) -> [f32; 3] {
    let zero = random.below(3) as usize;
    let mut dir = [(); 3].map(|()| {
        let side = if random.below(2) == 0 { -1.0 } else { 1.0 };
        side * std::f64::consts::FRAC_1_SQRT_2
    });
    dir[zero] = 0.0;
    let reach = 1e-3 * 2f64.powi(-(random.below(8) as i32));
    let dir = dir.map(|c| c + reach * (2.0 * random.unit() - 1.0));
    let length = dir.iter().map(|c| c * c).sum::<f64>().sqrt();
    dir.map(|c| (c / length) as f32)
}

/// A direction at a length anywhere among the floats.
fn any_length(random: &mut Random) -> [f32; 3] {
    loop {
        let exponent = random.below(277) as i32 - 149;
        let scale = 2f64.powi(exponent);
        let dir = random.direction().map(|c| (f64::from(c) * scale) as f32);
        if dir != [0.0; 3] && dir.iter().all(|c| c.is_finite()) {
            return dir;
        }
    }
}

fn no_directions() -> Vec<[f32; 3]> {
    let mut list = Vec::new();
    for bits in 0..8 {
        list.push([0, 1, 2].map(|k| if bits & (1 << k) != 0 { -0.0 } else { 0.0 }));
    }
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for other in [0.0, 1.0, -1e30, bad] {
            for slot in 0..3 {
                let mut dir = [other; 3];
                dir[slot] = bad;
                list.push(dir);
            }
        }
    }
    list
}

/// Most steps of a walk.
const STEPS: usize = 256;
/// Walks: twelve edges of the cube in three ways of stepping, and the twelve halves of the planes between the axes.
const WALKS: usize = 12 * 3 + 12;

/// Steps of each walk: an even number, so that its middle is met.
fn steps(effort: usize) -> usize {
    (effort / (3 * WALKS)).clamp(16, STEPS) & !1
}

/// The inputs of one walk, in order: for each step below, on and above the seam.
pub fn walk_length(effort: usize) -> usize {
    3 * (steps(effort) + 1)
}

/// The axis that is walked along, and the two others.
const AXES: [[usize; 3]; 3] = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];
const SIGNS: [[f32; 2]; 4] = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];

fn walks(effort: usize) -> Vec<[f32; 3]> {
    let steps = steps(effort);
    let share = |step: usize| 2.0 * step as f64 / steps as f64 - 1.0;
    let mut list = Vec::new();
    let mut push = |[free, a, b]: [usize; 3], along: f32, at_a: f32, at_b: [f32; 3]| {
        for at_b in at_b {
            let mut dir = [0.0; 3];
            (dir[free], dir[a], dir[b]) = (along, at_a, at_b);
            list.push(dir);
        }
    };
    for axes in AXES {
        for [sign_a, sign_b] in SIGNS {
            for kind in 0..3 {
                for share in (0..=steps).map(share) {
                    // f16 has 11 bits; f64 on the unit sphere is rounded to f32.
                    let (along, size) = match kind {
                        0 => ((share * 2048.0).round() / 2048.0, 1.0),
                        // One float after the other, from 0.7 on: nothing may step back.
                        1 => (
                            f64::from(step_ulps(0.7, (share * steps as f64) as i32)),
                            1.0,
                        ),
                        _ => {
                            let length = (2.0 + share * share).sqrt();
                            (share / length, 1.0 / length)
                        }
                    };
                    let size = size as f32;
                    let across = [size.next_down(), size, size.next_up()];
                    push(
                        axes,
                        along as f32,
                        sign_a * size,
                        across.map(|c| sign_b * c),
                    );
                }
            }
        }
        // Across a plane between the axes, far below the last digit of the other components.
        for [sign, other] in SIGNS {
            let [free, a, b] = axes;
            let axes = if other > 0.0 { axes } else { [free, b, a] };
            const NEAR: f32 = 1.0 / (1_u128 << 80) as f32;
            for share in (0..=steps).map(share) {
                push(axes, 1.5 * share as f32, sign, [-NEAR, 0.0, NEAR]);
            }
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn families_hold_what_they_promise() {
        for family in Family::ALL {
            let inputs = family.inputs(2000);
            assert!(inputs.len() >= 32, "{family:?}: {}", inputs.len());
            // By bits: NaN is equal to nothing.
            let bits = |list: &[[f32; 3]]| -> Vec<[u32; 3]> {
                list.iter().map(|dir| dir.map(f32::to_bits)).collect()
            };
            assert_eq!(
                bits(&inputs),
                bits(&family.inputs(2000)),
                "{family:?} is the same on every run"
            );
            let is_dir = |dir: &[f32; 3]| dir.iter().all(|c| c.is_finite()) && *dir != [0.0; 3];
            let directions = inputs.iter().filter(|dir| is_dir(dir)).count();
            match family {
                Family::NoDirections => assert_eq!(directions, 0),
                Family::Bits => assert!(directions > 1900),
                _ => assert_eq!(directions, inputs.len(), "{family:?}"),
            }
        }
        let lengths = Family::Lengths.inputs(20_000);
        let largest = |dir: &[f32; 3]| dir.iter().fold(0f32, |m, c| m.max(c.abs()));
        assert!(lengths.iter().any(|dir| largest(dir) < 1e-44));
        assert!(lengths.iter().any(|dir| largest(dir) > 1e38));
        assert_eq!(Family::Walks.inputs(2000).len(), WALKS * walk_length(2000));
    }
}
