//! Tables of the arctangent, sine and cosine, and what lies between their entries.

use std::f64::consts::FRAC_PI_2;
use std::sync::LazyLock;

use super::super::floor_and_rest;
use super::{Arctangent, SineCosine, multiply_add};

/// Most steps of a table.
const MOST: usize = 4096;
/// One entry below 0 and two above 1, which a cubic asks for at the ends.
const ENTRIES: usize = MOST + 4;

type Entries = [f32; ENTRIES];

/// How a value between entries is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableKind {
    /// On the line through two entries.
    Linear,
    /// On Lagrange's cubic through four.
    Cubic,
}

/// Tables of equal steps over [0, 1]: the arctangent of t in quarter turns, sine and cosine of t/2 quarter turns.
#[derive(Clone, Copy, Debug)]
pub struct Table<const CUBIC: bool> {
    steps: f32,
    atan: &'static Entries,
    sin: &'static Entries,
    cos: &'static Entries,
}

impl<const CUBIC: bool> Table<CUBIC> {
    /// The table of 2^6, 2^8, 2^10 or 2^12 steps, by its place in this list; the largest for any other.
    pub fn of_size(place: usize) -> Self {
        static TABLES: LazyLock<[[Entries; 3]; 4]> =
            LazyLock::new(|| [0, 1, 2, 3].map(|place| entries(Table::<false>::SIZES[place])));
        let place = place.min(3);
        let [atan, sin, cos] = &TABLES[place];
        Self {
            steps: Self::SIZES[place] as f32,
            atan,
            sin,
            cos,
        }
    }

    /// Steps of each table.
    pub const SIZES: [usize; 4] = [64, 256, 1024, MOST];

    /// The function at |t| <= 1.
    #[inline(always)]
    fn look_up<const FUSED: bool>(self, entries: &Entries, t: f32) -> f32 {
        let (whole, rest) = floor_and_rest::<FUSED>(t.abs() * self.steps);
        // Never more than a table's last step; the bound lets the compiler leave its own checks out.
        let at = (whole as u32 as usize).min(MOST);
        if !CUBIC {
            return between::<FUSED>(entries[at + 1], entries[at + 2], rest);
        }
        // Neville's scheme through entries at -1, 0, 1 and 2.
        let (p, q, r, s) = (
            entries[at],
            entries[at + 1],
            entries[at + 2],
            entries[at + 3],
        );
        let pq = between::<FUSED>(q, p, -rest);
        let qr = between::<FUSED>(q, r, rest);
        let rs = between::<FUSED>(r, s, rest - 1.0);
        let pqr = between::<FUSED>(qr, pq, 0.5 * (1.0 - rest));
        let qrs = between::<FUSED>(qr, rs, 0.5 * rest);
        between::<FUSED>(pqr, qrs, (rest + 1.0) * (1.0 / 3.0))
    }
}

/// The value at `share` of the way from `a` to `b`.
#[inline(always)]
fn between<const FUSED: bool>(a: f32, b: f32, share: f32) -> f32 {
    multiply_add::<FUSED>(b - a, share, a)
}

/// The arctangent in quarter turns, sine and cosine of (i - 1)/steps, the sine and cosine of half as many quarter turns.
fn entries(steps: usize) -> [Entries; 3] {
    let place = |i: usize| (i as f64 - 1.0) / steps as f64;
    let angle = |i| 0.5 * FRAC_PI_2 * place(i);
    [
        std::array::from_fn(|i| (place(i).atan() / FRAC_PI_2) as f32),
        std::array::from_fn(|i| angle(i).sin() as f32),
        std::array::from_fn(|i| angle(i).cos() as f32),
    ]
}

impl<const CUBIC: bool> Arctangent for Table<CUBIC> {
    const LOOKS_UP: bool = true;

    #[inline(always)]
    fn quarters<const FUSED: bool>(self, t: f32) -> f32 {
        self.look_up::<FUSED>(self.atan, t).copysign(t)
    }
}

impl<const CUBIC: bool> SineCosine for Table<CUBIC> {
    #[inline(always)]
    fn sin_cos_quarter<const FUSED: bool>(self, f: f32) -> (f32, f32) {
        let t = 2.0 * f;
        let sin = self.look_up::<FUSED>(self.sin, t).copysign(f);
        (sin, self.look_up::<FUSED>(self.cos, t))
    }
}
