//! What evaluators are measured on.

use serde::{Deserialize, Serialize};

use crate::mapping::{Coverage, DirList, MappingId, PointList};
use crate::math::inputs::Random;

/// Families of directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Inputs {
    /// Even over the sphere, in no order.
    Random,
    /// What the pixels of rendered frames look up, row after row: neighbours are alike.
    Coherent,
    /// Close to a border, corner, pole or tie, at any length.
    Adversarial,
}

impl Inputs {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Random, Self::Coherent, Self::Adversarial];

    /// The word in reports.
    pub const fn id(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Coherent => "coherent",
            Self::Adversarial => "adversarial",
        }
    }

    /// `count` directions that the mapping covers, the same on every run.
    pub fn directions(self, map: MappingId, count: usize) -> DirList {
        let mut random = Random::new(0x51F0);
        let coverage = map.info().coverage;
        let covered = |dir: &[f32; 3]| match coverage {
            Coverage::Sphere => true,
            _ => coverage.contains(dir.map(f64::from)),
        };
        match self {
            Self::Random => std::iter::repeat_with(|| random.direction())
                .filter(covered)
                .take(count)
                .collect(),
            Self::Coherent => frames().filter(covered).take(count).collect(),
            Self::Adversarial => std::iter::repeat_with(|| random.adversarial())
                .filter(covered)
                .take(count)
                .collect(),
        }
    }

    /// Chart points of the same directions, rounded to f32.
    pub fn points(map: MappingId, dirs: &DirList) -> PointList {
        let view = dirs.view();
        let points = (0..view.len()).filter_map(|k| {
            let [x, y, z] = view.at(k).to_f64();
            let point = map.forward(crate::math::Vec3::new(x, y, z))?;
            Some(crate::mapping::ChartPoint::new(
                point.chart,
                point.u as f32,
                point.v as f32,
            ))
        });
        points.collect()
    }
}

/// Side of a frame in pixels.
const FRAME: usize = 64;

/// Pixels of frames of 90 degrees whose camera turns by a golden angle from frame to frame, looking up and down; not unit.
fn frames() -> impl Iterator<Item = [f32; 3]> {
    (0_u32..).flat_map(|frame| {
        let yaw = f64::from(frame) * 2.399_963_229_728_653;
        let pitch = 1.2 * (f64::from(frame) * 0.7).sin();
        let ((sy, cy), (sp, cp)) = (yaw.sin_cos(), pitch.sin_cos());
        (0..FRAME * FRAME).map(move |pixel| {
            let at = |i: usize| (2 * i + 1) as f64 / FRAME as f64 - 1.0;
            let (right, up) = (at(pixel % FRAME), -at(pixel / FRAME));
            let (up, ahead) = (up * cp + sp, cp - up * sp);
            [right * cy + ahead * sy, up, ahead * cy - right * sy].map(|c| c as f32)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn families_differ_in_order_and_place() {
        let step = |inputs: Inputs| {
            let dirs = inputs.directions(MappingId::Ccm, 3 * FRAME * FRAME);
            assert_eq!(dirs.len(), 3 * FRAME * FRAME);
            let view = dirs.view();
            let close = (1..view.len()).filter(|k| {
                let [a, b] = [k - 1, *k].map(|k| view.at(k).to_f64());
                crate::math::angle_rad(a, b) < 0.04
            });
            close.count() as f64 / view.len() as f64
        };
        assert!(step(Inputs::Coherent) > 0.97);
        assert!(step(Inputs::Random) < 0.01);
        assert!(step(Inputs::Adversarial) < 0.05);
    }

    #[test]
    fn only_what_is_covered_is_asked() {
        for map in MappingId::ALL {
            for inputs in Inputs::ALL {
                let dirs = inputs.directions(*map, 500);
                assert_eq!(dirs.len(), 500);
                assert!(Inputs::points(*map, &dirs).len() == 500);
            }
        }
    }
}
