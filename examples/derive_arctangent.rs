//! Derives the coefficients in `src/math/arctan.rs` and `src/math/approximation/own.rs` and measures how many of them are
//! worth having.
//!
//! `cargo run --release --example derive_arctangent [STRIDE]` prints the tables, every set of coefficients, and the constants
//! as they stand in the source. It evaluates every float of the upper half of the interval, where the errors are largest,
//! and every STRIDE-th of the lower (default 64; 1 takes a quarter of an hour). `tests/arctangent.rs` includes this file and
//! holds the constants to it.
//!
//! Each polynomial has the smallest possible largest error of the whole function, relative or absolute, found by the Remez
//! exchange:
//! solve for equal errors of alternating sign at as many points as there are unknowns and one more, move the points to
//! where the error peaks, repeat. Coefficients are rounded to f32 one after another, lowest power first, and the
//! remaining ones are fitted anew after each rounding, so that they make up for it.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4};
use std::fmt::Write as _;
use std::io::Write as _;

/// A function of x in [0, `end`], odd or even, as a polynomial in s = x^2.
pub struct Fit {
    /// Name of the constant in the source.
    pub constant: &'static str,
    /// Largest x.
    pub end: f32,
    /// The function itself, in f64: the reference.
    pub reference: fn(f64) -> f64,
    /// What the polynomial in s stands for, at x > 0.
    target: fn(f64) -> f64,
    /// Change of the function per change of the polynomial, at x.
    gain: fn(f64) -> f64,
    /// The function in f32 from given coefficients: every product and sum rounded, then every possible pair fused.
    pub evaluate: [fn(&[f32], f32) -> f32; 2],
    /// Numbers of coefficients to measure.
    counts: std::ops::RangeInclusive<usize>,
    /// The number that the source uses.
    pub chosen: usize,
    /// Degree in x of a polynomial of one coefficient.
    first_degree: usize,
    /// Whether the absolute error is made small: where a coordinate is all that is wanted. Else the relative one.
    is_absolute: bool,
}

/// atan x = x + x s P(s).
pub const ATAN: Fit = Fit {
    constant: "ATAN_COEFFICIENTS",
    end: 1.0,
    reference: f64::atan,
    target: |x| (x.atan() / x - 1.0) / (x * x),
    gain: |x| x * x * x,
    evaluate: [atan::<false>, atan::<true>],
    counts: 2..=9,
    chosen: 8,
    first_degree: 3,
    is_absolute: false,
};

/// sin(x pi/2) = x + x P(s). Taking out x (exact) leaves a smaller rest, whose roundings count less: x (P(s) + 1) errs
/// by 1.57 ULP and 7.9e-8 instead. (2x - x P(s), with 1.14 ULP but 6.8e-8, is worse for a direction.)
pub const SIN: Fit = Fit {
    constant: "SIN_QUARTER_COEFFICIENTS",
    end: 0.5,
    reference: |x| (x * FRAC_PI_2).sin(),
    target: |x| (x * FRAC_PI_2).sin() / x - 1.0,
    gain: |x| x,
    evaluate: [sin::<false>, sin::<true>],
    counts: 2..=5,
    chosen: 4,
    first_degree: 1,
    is_absolute: false,
};

/// cos(x pi/2) = 1 + s P(s).
pub const COS: Fit = Fit {
    constant: "COS_QUARTER_COEFFICIENTS",
    end: 0.5,
    reference: |x| (x * FRAC_PI_2).cos(),
    target: |x| -2.0 * ((x * FRAC_PI_4).sin() / x).powi(2),
    gain: |x| x * x,
    evaluate: [cos::<false>, cos::<true>],
    counts: 2..=5,
    chosen: 4,
    first_degree: 2,
    is_absolute: false,
};

/// Half of an edge of the continuous cube map as seen from the centre, in radians: atan(1/sqrt 2).
const HALF_EDGE_RAD: f64 = 0.615_479_708_670_387_3;

/// The arctangent in quarter turns, x P(s). A product less than [`ATAN`] where a chart's coordinate is wanted: with the
/// half added in one go it is rounded twice only.
pub const QUARTERS: Fit = Fit {
    constant: "QUARTERS",
    end: 1.0,
    reference: |x| x.atan() / FRAC_PI_2,
    target: |x| x.atan() / FRAC_PI_2 / x,
    gain: |x| x,
    evaluate: [product::<false>, product::<true>],
    counts: 3..=9,
    chosen: 9,
    first_degree: 1,
    is_absolute: true,
};

/// The continuous cube map's place along an edge: atan(a/sqrt 2)/(2 alpha) = a P(s). Not the whole of [0, 1] is asked of
/// the arctangent, so fewer coefficients will do.
pub const ALONG: Fit = Fit {
    constant: "ALONG",
    end: 1.0,
    reference: |x| (x * FRAC_1_SQRT_2).atan() / (2.0 * HALF_EDGE_RAD),
    target: |x| (x * FRAC_1_SQRT_2).atan() / (2.0 * HALF_EDGE_RAD) / x,
    gain: |x| x,
    evaluate: [product::<false>, product::<true>],
    counts: 2..=8,
    chosen: 7,
    first_degree: 1,
    is_absolute: true,
};

/// What the continuous cube map multiplies a latitude in quarter turns by: 1/(2 quarters(1/sqrt(1 + s))) = 1 + s P(s).
pub const REACH: Fit = Fit {
    constant: "REACH",
    end: 1.0,
    reference: reach,
    target: |x| (reach(x) - 1.0) / (x * x),
    gain: |x| x * x,
    evaluate: [cos::<false>, cos::<true>],
    counts: 1..=8,
    chosen: 7,
    first_degree: 2,
    is_absolute: true,
};

fn reach(x: f64) -> f64 {
    FRAC_PI_4 / (1.0 + x * x).sqrt().recip().atan()
}

/// a b + c, rounded once (as a driver may) or twice.
fn multiply_add<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

fn horner<const FUSED: bool>(coefficients: &[f32], s: f32) -> f32 {
    coefficients
        .iter()
        .rev()
        .fold(0.0, |sum, &c| multiply_add::<FUSED>(sum, s, c))
}

fn atan<const FUSED: bool>(coefficients: &[f32], x: f32) -> f32 {
    let s = x * x;
    multiply_add::<FUSED>(x * s, horner::<FUSED>(coefficients, s), x)
}

fn sin<const FUSED: bool>(coefficients: &[f32], x: f32) -> f32 {
    multiply_add::<FUSED>(x, horner::<FUSED>(coefficients, x * x), x)
}

fn product<const FUSED: bool>(coefficients: &[f32], x: f32) -> f32 {
    x * horner::<FUSED>(coefficients, x * x)
}

fn cos<const FUSED: bool>(coefficients: &[f32], x: f32) -> f32 {
    let s = x * x;
    multiply_add::<FUSED>(s, horner::<FUSED>(coefficients, s), 1.0)
}

/// Distance of `value` from `reference` in units in the last place of the binade that `reference` lies in.
pub fn ulp_error(value: f32, reference: f64) -> f64 {
    const EXPONENT_BITS: u64 = 0x7FF << 52;
    let binade = f64::from_bits(reference.to_bits() & EXPONENT_BITS);
    (f64::from(value) - reference).abs() / (binade * f64::from(f32::EPSILON))
}

/// One point of the interval, as the exchange sees it.
struct Sample {
    s: f64,
    /// What is left to fit there.
    rest: f64,
    /// Relative error of the function per error of the polynomial.
    weight: f64,
}

impl Fit {
    /// The best `count` coefficients that are f32 numbers, lowest power first.
    pub fn derive(&self, count: usize) -> Vec<f32> {
        let mut samples = self.samples();
        let mut rounded = Vec::new();
        while rounded.len() < count {
            let (best, _) = remez(&samples, rounded.len(), count - rounded.len());
            let coefficient = best[0] as f32;
            for sample in &mut samples {
                sample.rest -= f64::from(coefficient) * sample.s.powi(rounded.len() as i32);
            }
            rounded.push(coefficient);
        }
        rounded
    }

    /// Largest error that exact arithmetic would leave with `count` unrounded coefficients.
    fn exact_error(&self, count: usize) -> f64 {
        remez(&self.samples(), 0, count).1
    }

    /// Points dense towards both ends, where the error of a best polynomial swings fastest.
    fn samples(&self) -> Vec<Sample> {
        const COUNT: u32 = 4000;
        let sample = |i: u32| {
            let fraction = (FRAC_PI_2 * f64::from(i) / f64::from(COUNT)).sin().powi(2);
            let s = f64::from(self.end).powi(2) * fraction;
            let x = s.sqrt();
            let weight = if self.is_absolute {
                (self.gain)(x)
            } else {
                (self.gain)(x) / (self.reference)(x)
            };
            Sample {
                s,
                rest: (self.target)(x),
                weight,
            }
        };
        (1..=COUNT).map(sample).collect()
    }

    /// Every `lower`-th float of [0, end/2] and every `upper`-th of [end/2, end].
    pub fn floats(&self, [lower, upper]: [usize; 2]) -> impl Iterator<Item = f32> + use<> {
        let (half, end) = ((self.end / 2.0).to_bits(), self.end.to_bits());
        let upper = (half..=end).rev().step_by(upper);
        upper
            .chain((0..=half).rev().step_by(lower))
            .map(f32::from_bits)
    }

    /// Largest errors over the `floats` with the given strides: for each set of coefficients, unfused and fused, the
    /// absolute error and the error in ULP.
    pub fn measure(&self, sets: &[Vec<f32>], strides: [usize; 2]) -> Vec<[(f64, f64); 2]> {
        let mut worst = vec![[(0f64, 0f64); 2]; sets.len()];
        for x in self.floats(strides) {
            let reference = (self.reference)(f64::from(x));
            for (set, worst) in sets.iter().zip(&mut worst) {
                for (evaluate, (absolute, ulp)) in self.evaluate.iter().zip(worst) {
                    let value = evaluate(set, x);
                    *absolute = absolute.max((f64::from(value) - reference).abs());
                    // A subnormal result may be off by half its only digit; that says nothing about coefficients.
                    if value >= f32::MIN_POSITIVE {
                        *ulp = ulp.max(ulp_error(value, reference));
                    }
                }
            }
        }
        worst
    }

    /// The constant as it stands in the source, apart from line breaks.
    pub fn source(&self) -> String {
        let values: Vec<String> = self
            .derive(self.chosen)
            .iter()
            .map(|c| format!("{c:?}"))
            .collect();
        let (name, count) = (self.constant, self.chosen);
        format!(
            "pub const {name}: [f32; {count}] = [{}];",
            values.join(", ")
        )
    }
}

/// Polynomial s^lowest (a0 + a1 s + ...) of `count` coefficients with the smallest largest weighted error over the
/// samples, and that error.
fn remez(samples: &[Sample], lowest: usize, count: usize) -> (Vec<f64>, f64) {
    // Exchanging a single point a round keeps the level rising, so the best set is reached: within 30 rounds here.
    // (Exchanging all at once is faster but can go round in circles once rounded coefficients leave many equal peaks.)
    const ROUNDS: usize = 1000;
    // Samples are even in angle, so these are the extrema of a Chebyshev polynomial.
    let mut points: Vec<usize> = (0..=count)
        .map(|i| (samples.len() - 1) * i / count)
        .collect();
    let mut best = (Vec::new(), f64::INFINITY);
    for _ in 0..ROUNDS {
        let row = |(i, &point): (usize, &usize)| {
            let sample = &samples[point];
            let power = |j: usize| sample.weight * sample.s.powi((lowest + j) as i32);
            let level = if i % 2 == 0 { 1.0 } else { -1.0 };
            let right = sample.weight * sample.rest;
            (0..count).map(power).chain([level, right]).collect()
        };
        let mut solution = solve(points.iter().enumerate().map(row).collect());
        solution.truncate(count);
        let error = |sample: &Sample| {
            let sum = solution.iter().rev().fold(0.0, |sum, a| sum * sample.s + a);
            sample.weight * (sample.rest - sum * sample.s.powi(lowest as i32))
        };
        let errors: Vec<f64> = samples.iter().map(error).collect();
        let size = |i: &usize| errors[*i].abs();
        let worst = (0..errors.len())
            .max_by(|a, b| size(a).total_cmp(&size(b)))
            .unwrap_or(0);
        if size(&worst) < best.1 {
            best = (solution, size(&worst));
        }
        if points.contains(&worst) {
            break;
        }
        exchange(&mut points, &errors, worst);
    }
    best
}

/// Takes `new` in among the increasing `points` for a neighbor, so that the errors still alternate in sign.
fn exchange(points: &mut Vec<usize>, errors: &[f64], new: usize) {
    let after = points.partition_point(|&point| point < new);
    let agrees = |i: usize| {
        points
            .get(i)
            .is_some_and(|&point| errors[point] * errors[new] > 0.0)
    };
    if agrees(after) {
        points[after] = new;
    } else if after > 0 && agrees(after - 1) {
        points[after - 1] = new;
    } else if after == 0 {
        points.pop();
        points.insert(0, new);
    } else {
        points.insert(after, new);
        points.remove(0);
    }
}

/// Solution of a system of linear equations; each row ends with its right side. Gaussian elimination with pivots.
fn solve(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for column in 0..n {
        let size = |row: &usize| rows[*row][column].abs();
        let pivot = (column..n)
            .max_by(|a, b| size(a).total_cmp(&size(b)))
            .unwrap_or(column);
        rows.swap(column, pivot);
        let (done, below) = rows.split_at_mut(column + 1);
        let pivot = &done[column];
        for row in below {
            let factor = row[column] / pivot[column];
            for k in column..=n {
                row[k] -= factor * pivot[k];
            }
        }
    }
    let mut solution = vec![0.0; n];
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|k| rows[i][k] * solution[k]).sum();
        solution[i] = (rows[i][n] - known) / rows[i][i];
    }
    solution
}

/// The tables and the constants.
pub fn report(stride: usize) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    for fit in [&ATAN, &SIN, &COS, &QUARTERS, &ALONG, &REACH] {
        let counts: Vec<usize> = fit.counts.clone().collect();
        let sets: Vec<Vec<f32>> = counts.iter().map(|&count| fit.derive(count)).collect();
        writeln!(
            text,
            "{}: [0, {}], stride {stride} in the lower half",
            fit.constant, fit.end
        )?;
        writeln!(
            text,
            "degree  exact err.  abs unfused  abs fused  ULP unfused  ULP fused  end"
        )?;
        for ((&count, set), worst) in counts
            .iter()
            .zip(&sets)
            .zip(fit.measure(&sets, [stride, 1]))
        {
            let degree = fit.first_degree + 2 * (count - 1);
            let exact = fit.exact_error(count);
            let [(absolute, ulp), (absolute_fused, ulp_fused)] = worst;
            let nearest = (fit.reference)(f64::from(fit.end)) as f32;
            let end = fit
                .evaluate
                .map(|evaluate| evaluate(set, fit.end) == nearest);
            let end = if end == [true; 2] { "nearest" } else { "off" };
            let mark = if count == fit.chosen {
                "  <- chosen"
            } else {
                ""
            };
            write!(
                text,
                "{degree:6}  {exact:10.2e}  {absolute:11.2e}  {absolute_fused:9.2e}"
            )?;
            writeln!(text, "  {ulp:11.3}  {ulp_fused:9.3}  {end}{mark}")?;
        }
        for set in &sets {
            writeln!(text, "{set:?}")?;
        }
        writeln!(text, "{}\n", fit.source())?;
    }
    Ok(text)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stride = std::env::args()
        .nth(1)
        .map_or(Ok(64), |text| text.parse::<usize>())?;
    std::io::stdout().write_all(report(stride.max(1))?.as_bytes())?;
    Ok(())
}
