//! Directions to test with: even, random, and as nasty as they come. The borders are never avoided.

use super::ulp::step_ulps;

/// A small seeded generator (SplitMix64: Steele, Lea and Flood 2014), so that every run sees the same directions.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A generator whose sequence depends on `seed` alone.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Even in [0, 1).
    pub fn unit(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
        (self.bits() >> 11) as f64 * STEP
    }

    /// An integer in [0, below).
    pub fn below(&mut self, below: u32) -> u32 {
        (((self.bits() >> 32) * u64::from(below)) >> 32) as u32
    }

    /// A unit direction, even over the sphere, rounded to f32.
    pub fn direction(&mut self) -> [f32; 3] {
        let z = 2.0 * self.unit() - 1.0;
        let (sin, cos) = (std::f64::consts::TAU * self.unit()).sin_cos();
        let r = ((1.0 - z) * (1.0 + z)).sqrt();
        [(r * cos) as f32, (r * sin) as f32, z as f32]
    }

    /// A direction close to a border, corner, pole or tie of some mapping: a signed pattern of 0 and 1, at a random
    /// length, each component moved by up to 32 ULP or by a random power of two.
    pub fn adversarial(&mut self) -> [f32; 3] {
        loop {
            let pattern = SIGN_PATTERNS[self.below(SIGN_PATTERNS.len() as u32) as usize];
            let length = if self.below(2) == 0 {
                1.0
            } else {
                0.5 + self.unit() as f32
            };
            let far = self.below(2) == 0;
            let dir = pattern.map(|sign| {
                let base = f32::from(sign) * length;
                if far {
                    let offset = 2f32.powi(-1 - self.below(29) as i32);
                    base + offset * (2.0 * self.unit() as f32 - 1.0)
                } else {
                    step_ulps(base, self.below(65) as i32 - 32)
                }
            });
            if dir.iter().any(|c| c.abs() >= f32::MIN_POSITIVE) {
                return dir;
            }
        }
    }
}

/// The 26 directions of a cube's face centres, edge middles and corners: every exact tie of two or three components.
pub const SIGN_PATTERNS: [[i8; 3]; 26] = sign_patterns();

const fn sign_patterns() -> [[i8; 3]; 26] {
    let mut patterns = [[0; 3]; 26];
    let mut count = 0;
    let mut code = 0;
    while code < 27 {
        let pattern = [
            (code % 3) as i8 - 1,
            (code / 3 % 3) as i8 - 1,
            (code / 9) as i8 - 1,
        ];
        if code != 13 {
            patterns[count] = pattern;
            count += 1;
        }
        code += 1;
    }
    patterns
}

/// `count` unit directions spread evenly over the sphere along a Fibonacci spiral.
pub fn even_directions(count: usize) -> impl Iterator<Item = [f64; 3]> {
    let golden_turn = std::f64::consts::TAU * (0.5 * (5f64.sqrt() - 1.0));
    (0..count).map(move |i| {
        let y = 1.0 - (2 * i + 1) as f64 / count as f64;
        let r = ((1.0 - y) * (1.0 + y)).sqrt();
        let (sin, cos) = (golden_turn * i as f64).sin_cos();
        [r * cos, y, r * sin]
    })
}
