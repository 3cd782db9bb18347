//! A vector of three numbers of any [`Real`] type (glam has no dual numbers).

use std::ops::{Add, Mul, Neg, Sub};

use super::Real;

/// A vector in the world frame: x right, y up, z forward (left-handed).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3<R> {
    /// Towards the right.
    pub x: R,
    /// Up.
    pub y: R,
    /// Forward, into the screen.
    pub z: R,
}

impl<R: Real> Vec3<R> {
    /// The vector (x, y, z).
    pub const fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }

    /// The vector whose components are nearest to the given ones.
    pub fn from_f64(v: [f64; 3]) -> Self {
        Self::new(R::from_f64(v[0]), R::from_f64(v[1]), R::from_f64(v[2]))
    }

    /// The components as f64.
    pub fn to_f64(self) -> [f64; 3] {
        [self.x.to_f64(), self.y.to_f64(), self.z.to_f64()]
    }

    /// The components in order.
    pub fn to_array(self) -> [R; 3] {
        [self.x, self.y, self.z]
    }

    /// Sum of the products of the components.
    pub fn dot(self, other: Self) -> R {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The vector perpendicular to both.
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Length; no overflow while the largest component is below the square root of the largest number.
    pub fn length(self) -> R {
        self.dot(self).sqrt()
    }

    /// Length 1 in the same direction; not a number for the zero vector.
    pub fn normalized(self) -> Self {
        let length = self.length();
        Self::new(self.x / length, self.y / length, self.z / length)
    }

    /// The largest of the components' absolute values.
    pub fn max_abs(self) -> R {
        self.x.abs().max(self.y.abs()).max(self.z.abs())
    }

    /// The same direction at a size at which squares neither overflow nor underflow, or `None` for a vector that is no
    /// direction: zero, NaN or infinite. Scaling is by a power of two, so every component keeps its digits and every
    /// comparison its answer.
    pub fn scaled_direction(self) -> Option<Self> {
        if !(self.x.is_finite() && self.y.is_finite() && self.z.is_finite()) {
            return None;
        }
        let largest = self.max_abs();
        // 2^60 squared times three stays inside f32; 2^-60 squared is still a normal number.
        const LARGE: f64 = (1_u64 << 60) as f64;
        let (large, small) = (R::from_f64(LARGE), R::from_f64(1.0 / LARGE));
        if largest <= large && largest >= small {
            return Some(self);
        }
        if largest <= R::zero() {
            return None;
        }
        let step = if largest > large { small } else { large };
        // f32 needs at most two steps of 2^60, f64 at most 17.
        (self * step).scaled_direction()
    }
}

impl<R> From<[R; 3]> for Vec3<R> {
    fn from([x, y, z]: [R; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<R: Real> Mul<R> for Vec3<R> {
    type Output = Self;
    fn mul(self, factor: R) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<R: Real> Add for Vec3<R> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<R: Real> Sub for Vec3<R> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<R: Real> Neg for Vec3<R> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

/// (x, y) at length 1, or (1, 0) for the origin. Below the normal numbers the length has no digits to divide by, so the
/// larger component is divided out first.
pub fn unit_in_plane<R: Real>(x: R, y: R) -> (R, R) {
    let large = x.abs().max(y.abs());
    if large <= R::zero() {
        return (R::one(), R::zero());
    }
    let (x, y) = (x / large, y / large);
    let length = (x * x + y * y).sqrt();
    (x / length, y / length)
}

/// Angle between two vectors in radians, in [0, pi], accurate at both ends (no arccosine of a rounded product).
pub fn angle_rad(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (a, b) = (Vec3::from_f64(a), Vec3::<f64>::from_f64(b));
    f64::atan2(a.cross(b).length(), a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_vector_of_any_size_gets_length_one() {
        for size in [1.0_f32, 3e38, f32::MIN_POSITIVE, 2.8e-45] {
            let (x, y) = unit_in_plane(size, -size);
            assert!((x.hypot(y) - 1.0).abs() < 2e-7, "{size}: {x}, {y}");
            assert!(x > 0.7 && y < -0.7);
        }
        let naive = 2.8e-45_f32 / 2.8e-45_f32.hypot(-2.8e-45);
        assert!((naive - 0.70710677).abs() > 0.02, "{naive}");
        assert_eq!(unit_in_plane(0.0, 0.0), (1.0, 0.0));
    }
}
