//! What the pane that folds the map shows.

use serde::{Deserialize, Serialize};

use crate::scene::Camera;

/// The selected mapping as a surface between the flat picture and the sphere.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FoldState {
    /// The pane is shown.
    pub open: bool,
    /// How far it is folded: 0 flat, 1/2 the solid, 1 the sphere.
    pub share: f32,
    /// The eye; the surface is in the unit ball.
    pub camera: Camera,
    /// What is seen from outside, where pictures are mirrored, lets through what is behind it.
    pub see_through: bool,
    /// It moves by itself towards this share; a saved scene is still.
    #[serde(skip)]
    pub towards: Option<f32>,
}

impl Default for FoldState {
    fn default() -> Self {
        Self {
            open: false,
            share: 0.25,
            camera: Camera {
                yaw_rad: -0.5,
                pitch_rad: 0.35,
                ..Camera::default()
            },
            see_through: true,
            towards: None,
        }
    }
}

/// Seconds from the flat picture to the sphere.
const WAY_S: f32 = 6.0;

impl FoldState {
    /// The nearest that makes sense.
    #[must_use]
    pub fn sanitized(self) -> Self {
        let unit = |x: f32, or: f32| if x.is_finite() { x.clamp(0.0, 1.0) } else { or };
        Self {
            share: unit(self.share, Self::default().share),
            camera: self.camera.sanitized(),
            towards: self.towards.map(|to| unit(to, 1.0)),
            ..self
        }
    }

    /// Some seconds later, where it moves.
    #[must_use]
    pub fn after(self, seconds: f32) -> Self {
        let Some(to) = self.towards else { return self };
        let step = (seconds / WAY_S).clamp(0.0, 1.0);
        let left = to - self.share;
        if left.abs() <= step {
            Self {
                share: to,
                towards: None,
                ..self
            }
        } else {
            Self {
                share: self.share + step.copysign(left),
                ..self
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_moves_until_it_is_there_and_numbers_stay_in_range() {
        let mut fold = FoldState {
            share: 0.9,
            towards: Some(0.0),
            ..FoldState::default()
        };
        let mut steps = 0;
        while fold.towards.is_some() {
            let before = fold.share;
            fold = fold.after(0.5);
            assert!(fold.share < before);
            steps += 1;
        }
        assert_eq!((fold.share, steps), (0.0, 11));
        assert_eq!(fold.after(1.0), fold, "control: it is still");
        let wild = FoldState {
            share: f32::NAN,
            towards: Some(f32::INFINITY),
            ..fold
        };
        assert_eq!(wild.sanitized().sanitized(), wild.sanitized());
        assert_eq!(wild.sanitized().share, FoldState::default().share);
    }
}
