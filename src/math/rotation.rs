//! How surroundings are turned: yaw, pitch and roll in degrees, for the window, the command line and scenes alike.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::{Real, Vec3};

/// A turn of the viewer among surroundings that stay: first the yaw, then the pitch, then the roll, each about the viewer's
/// own axes.
///
/// - `yaw_deg` > 0 turns the viewer to the right: ahead (+z) is then what was at the right (+x), and the surroundings go to
///   the left;
/// - `pitch_deg` > 0 turns the viewer upwards: ahead is then what was up (+y), and the surroundings go down;
/// - `roll_deg` > 0 turns the viewer clockwise: up is then what was at the right, and the surroundings turn
///   counter-clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Rotation {
    /// About +y, to the right.
    pub yaw_deg: f64,
    /// About +x, upwards.
    pub pitch_deg: f64,
    /// About +z, clockwise.
    pub roll_deg: f64,
}

/// A text that is no turn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no rotation; give YAW,PITCH,ROLL in degrees, like 90,0,-15")]
pub struct BadRotation(String);

impl FromStr for Rotation {
    type Err = BadRotation;

    fn from_str(text: &str) -> Result<Self, BadRotation> {
        let angle = |word: &str| word.trim().parse().ok().filter(|x: &f64| x.is_finite());
        let angles: Option<Vec<f64>> = text.split(',').map(angle).collect();
        let angles = angles.and_then(|angles| <[f64; 3]>::try_from(angles).ok());
        angles
            .map(Self::from_degrees)
            .ok_or_else(|| BadRotation(text.to_owned()))
    }
}

impl Display for Rotation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{},{},{}", self.yaw_deg, self.pitch_deg, self.roll_deg)
    }
}

/// A 3x3 matrix by rows.
pub type Rows = [[f64; 3]; 3];

impl Rotation {
    /// Nothing turned.
    pub const NONE: Self = Self {
        yaw_deg: 0.0,
        pitch_deg: 0.0,
        roll_deg: 0.0,
    };

    /// From `[yaw, pitch, roll]` in degrees.
    pub const fn from_degrees([yaw_deg, pitch_deg, roll_deg]: [f64; 3]) -> Self {
        Self {
            yaw_deg,
            pitch_deg,
            roll_deg,
        }
    }

    /// `[yaw, pitch, roll]` in degrees.
    pub const fn degrees(self) -> [f64; 3] {
        [self.yaw_deg, self.pitch_deg, self.roll_deg]
    }

    /// The same turn with each angle in (-180, 180]; an angle that is no number becomes 0.
    #[must_use]
    pub fn sanitized(self) -> Self {
        Self::from_degrees(self.degrees().map(wrapped_deg))
    }

    /// Whether it leaves everything where it is.
    pub fn is_none(self) -> bool {
        self.sanitized() == Self::NONE
    }

    /// Where the light of a direction of the world lies in the surroundings: yaw x pitch x roll. Quarter turns are exact.
    /// [`Conversion::rotation`](crate::imaging::resample::Conversion::rotation) is this matrix.
    pub fn source_from_world(self) -> Rows {
        let [yaw, pitch, roll] = self.degrees().map(sin_cos_deg);
        let about_z = [
            [roll.1, roll.0, 0.0],
            [-roll.0, roll.1, 0.0],
            [0.0, 0.0, 1.0],
        ];
        let about_x = [
            [1.0, 0.0, 0.0],
            [0.0, pitch.1, pitch.0],
            [0.0, -pitch.0, pitch.1],
        ];
        let about_y = [[yaw.1, 0.0, yaw.0], [0.0, 1.0, 0.0], [-yaw.0, 0.0, yaw.1]];
        product(about_y, product(about_x, about_z))
    }

    /// Where a direction of the surroundings is seen: the transpose of [`Self::source_from_world`].
    pub fn world_from_source(self) -> Rows {
        transposed(self.source_from_world())
    }
}

/// The vector turned by a matrix.
pub fn turned<R: Real>(rows: Rows, v: Vec3<R>) -> Vec3<R> {
    let [x, y, z] = rows.map(|row| Vec3::<R>::from_f64(row).dot(v));
    Vec3::new(x, y, z)
}

fn product(a: Rows, b: Rows) -> Rows {
    let entry = |i: usize, j: usize| (0..3).map(|k| a[i][k] * b[k][j]).sum();
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

fn transposed(rows: Rows) -> Rows {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| rows[j][i]))
}

/// The angle in (-180, 180]; 0 for what is no number.
fn wrapped_deg(angle: f64) -> f64 {
    if !angle.is_finite() {
        return 0.0;
    }
    let turned = angle.rem_euclid(360.0);
    // 0 added: no negative zero is left, which would be written to scenes.
    (if turned > 180.0 {
        turned - 360.0
    } else {
        turned
    }) + 0.0
}

/// Sine and cosine of an angle in degrees, exact at quarter turns.
fn sin_cos_deg(angle: f64) -> (f64, f64) {
    let angle = wrapped_deg(angle);
    let quarter = (angle / 90.0).round();
    let (sin, cos) = (angle - 90.0 * quarter).to_radians().sin_cos();
    match quarter as i32 {
        0 => (sin, cos),
        1 => (cos, -sin),
        -1 => (-cos, sin),
        _ => (-sin, -cos),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AHEAD: [f64; 3] = [0.0, 0.0, 1.0];
    const UP: [f64; 3] = [0.0, 1.0, 0.0];
    const RIGHT: [f64; 3] = [1.0, 0.0, 0.0];

    /// What the turned viewer sees in a direction of his.
    fn seen(angles: [f64; 3], dir: [f64; 3]) -> [f64; 3] {
        let rows = Rotation::from_degrees(angles).source_from_world();
        turned(rows, Vec3::<f64>::from_f64(dir)).to_array()
    }

    #[test]
    fn positive_angles_turn_as_they_say() {
        assert_eq!(seen([90.0, 0.0, 0.0], AHEAD), RIGHT);
        assert_eq!(seen([0.0, 90.0, 0.0], AHEAD), UP);
        assert_eq!(seen([0.0, 0.0, 90.0], UP), RIGHT);
        assert_ne!(seen([-90.0, 0.0, 0.0], AHEAD), RIGHT, "control");
        assert_eq!(seen([0.0, 0.0, 90.0], AHEAD), AHEAD);
        // To the right, then up, then clockwise: the right of who looks to the right is what was behind.
        assert_eq!(seen([90.0, 90.0, 90.0], UP), [0.0, 0.0, -1.0]);
        assert_eq!(seen([90.0, 45.0, 0.0], RIGHT), [0.0, 0.0, -1.0]);
        assert_eq!(seen([180.0, 0.0, 0.0], AHEAD), [0.0, 0.0, -1.0]);
    }

    #[test]
    fn a_turn_is_undone_and_keeps_lengths_and_hands() {
        let turn = Rotation::from_degrees([33.0, -71.0, 158.0]);
        let v = Vec3::new(0.3, -0.5, 0.8);
        let back = turned(
            turn.source_from_world(),
            turned(turn.world_from_source(), v),
        );
        let off = back + v * -1.0;
        assert!(off.max_abs() < 1e-15);
        let [x, y, z] = turn.world_from_source().map(Vec3::<f64>::from_f64);
        assert!((x.cross(y).dot(z) - 1.0).abs() < 1e-14, "no mirror image");
        let once = turned(turn.world_from_source(), v);
        assert!((once.x - v.x).abs() > 0.1, "control");
    }

    #[test]
    fn a_text_comes_back() {
        let turn = Rotation::from_degrees([-90.0, 0.0, 12.5]);
        assert_eq!(turn.to_string(), "-90,0,12.5");
        assert_eq!(" -90, 0,12.5".parse(), Ok(turn));
        for bad in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,inf", "nan,0,0"] {
            assert!(bad.parse::<Rotation>().is_err(), "{bad}");
        }
    }

    #[test]
    fn angles_are_brought_into_a_turn() {
        let wild = Rotation::from_degrees([540.0, f64::NAN, -180.0]).sanitized();
        assert_eq!(wild.degrees(), [180.0, 0.0, 180.0]);
        assert!(Rotation::from_degrees([360.0, -720.0, 0.0]).is_none());
        assert!(!Rotation::from_degrees([1.0, 0.0, 0.0]).is_none());
        assert!(
            Rotation::from_degrees([-360.0, 0.0, 0.0])
                .sanitized()
                .yaw_deg
                .is_sign_positive()
        );
    }
}
