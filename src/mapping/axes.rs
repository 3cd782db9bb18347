//! Axes exchanged and turned round: the 48 signed permutations, by which the frames of programs differ.

use serde::{Deserialize, Serialize};

use crate::math::{Real, Vec3};

/// A signed permutation of the axes: component i of the result is `sign[i]` times component `from[i]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Axes {
    from: [u8; 3],
    negative: [bool; 3],
}

impl Axes {
    /// Every axis where it is.
    pub const IDENTITY: Self = Self {
        from: [0, 1, 2],
        negative: [false; 3],
    };

    /// Left and right exchanged, as in a mirror before one.
    pub const MIRROR: Self = Self {
        from: [0, 1, 2],
        negative: [true, false, false],
    };

    /// The permutation that gives (a, b, c), each `+x`, `-y` and so on of the old components; `None` unless each axis
    /// comes once.
    pub fn parse(text: [&str; 3]) -> Option<Self> {
        let (mut from, mut negative) = ([0; 3], [false; 3]);
        for (i, word) in text.iter().enumerate() {
            let (sign, axis) = word.split_at_checked(1)?;
            negative[i] = match sign {
                "+" => false,
                "-" => true,
                _ => return None,
            };
            from[i] = match axis {
                "x" => 0,
                "y" => 1,
                "z" => 2,
                _ => return None,
            };
        }
        let is_permutation = (0..3).all(|axis| from.contains(&axis));
        is_permutation.then_some(Self { from, negative })
    }

    /// The permutation whose components are the old ones of these numbers, 1 to 3 for x to z, with their signs. Each must
    /// come once.
    pub(super) const fn from_signed(axes: [i8; 3]) -> Self {
        let mut result = Self::IDENTITY;
        let mut i = 0;
        while i < 3 {
            result.from[i] = axes[i].unsigned_abs() - 1;
            result.negative[i] = axes[i] < 0;
            i += 1;
        }
        result
    }

    /// All 48.
    pub fn all() -> impl Iterator<Item = Self> {
        const ORDERS: [[u8; 3]; 6] = [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ];
        ORDERS.into_iter().flat_map(|from| {
            (0..8_u8).map(move |bits| Self {
                from,
                negative: [bits & 1 != 0, bits & 2 != 0, bits & 4 != 0],
            })
        })
    }

    /// The vector with its components exchanged.
    pub fn apply<R: Real>(self, v: Vec3<R>) -> Vec3<R> {
        let components = [v.x, v.y, v.z];
        let pick = |i: usize| {
            let c = components[usize::from(self.from[i])];
            if self.negative[i] { -c } else { c }
        };
        Vec3::new(pick(0), pick(1), pick(2))
    }

    /// The permutation that undoes this one.
    pub const fn inverse(self) -> Self {
        let mut inverse = Self::IDENTITY;
        let mut i = 0;
        while i < 3 {
            let from = self.from[i] as usize;
            inverse.from[from] = i as u8;
            inverse.negative[from] = self.negative[i];
            i += 1;
        }
        inverse
    }

    /// First `self`, then `next`.
    pub fn then(self, next: Self) -> Self {
        let mut result = Self::IDENTITY;
        for i in 0..3 {
            let through = usize::from(next.from[i]);
            result.from[i] = self.from[through];
            result.negative[i] = self.negative[through] != next.negative[i];
        }
        result
    }

    /// Rows of the matrix.
    pub fn matrix(self) -> [[f64; 3]; 3] {
        let mut rows = [[0.0; 3]; 3];
        for (i, row) in rows.iter_mut().enumerate() {
            row[usize::from(self.from[i])] = if self.negative[i] { -1.0 } else { 1.0 };
        }
        rows
    }

    /// The components of `vector` in a shader's words: `d.x`, `-d.z` and so on.
    pub fn expressions(self, vector: &str) -> [String; 3] {
        [0, 1, 2].map(|i| {
            let sign = if self.negative[i] { "-" } else { "" };
            let name = ["x", "y", "z"][usize::from(self.from[i])];
            format!("{sign}{vector}.{name}")
        })
    }

    /// Whether left and right are exchanged: a determinant of -1.
    pub fn is_mirroring(self) -> bool {
        let [[a, b, c], [d, e, f], [g, h, i]] = self.matrix();
        a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0
    }
}

impl Default for Axes {
    fn default() -> Self {
        Self::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_48_differ_and_come_back() {
        let all: Vec<Axes> = Axes::all().collect();
        assert_eq!(all.len(), 48);
        assert_eq!(all.iter().filter(|axes| axes.is_mirroring()).count(), 24);
        let v = Vec3::new(1.0, 2.0, 3.0);
        for (i, axes) in all.iter().enumerate() {
            assert_eq!(axes.inverse().apply(axes.apply(v)), v);
            for next in &all {
                assert_eq!(axes.then(*next).apply(v), next.apply(axes.apply(v)));
            }
            assert!(all[..i].iter().all(|other| other.apply(v) != axes.apply(v)));
        }
        let z_negated = Axes::parse(["+x", "+y", "-z"]).unwrap();
        assert!(z_negated.is_mirroring());
        assert_eq!(Axes::parse(["+x", "+x", "-z"]), None);
    }
}
