//! Which way round a latlong lies: by the names of the programs that have it so.
//!
//! Seams do not tell: a latlong turned about its axis, or seen in a mirror, meets as well. So every way that has a name is told, in
//! the directions of our world, and pixels are asked only whether the sky is up.

use crate::imaging::seams::Texels;
use crate::imaging::{MapShape, Raster};
use crate::mapping::cube_face::FACES;
use crate::mapping::{Axes, ChartPoint, Frame, MappingId};
use crate::math::Vec3;

/// A way in which latlongs lie, and the programs that have it.
#[derive(Clone, Debug, PartialEq)]
pub struct LatlongWay {
    /// Our world from the map's own directions.
    pub world_from_map: Axes,
    /// Whoever has it so; at least one.
    pub frames: Vec<&'static Frame>,
}

impl LatlongWay {
    /// Every way that has a name; ours comes first.
    pub fn all() -> Vec<Self> {
        let mut ways: Vec<Self> = Vec::new();
        for frame in Frame::ALL {
            let Some(world_from_map) = frame.world_from_map(MappingId::Latlong) else {
                continue;
            };
            match ways
                .iter_mut()
                .find(|way| way.world_from_map == world_from_map)
            {
                Some(way) => way.frames.push(frame),
                None => ways.push(Self {
                    world_from_map,
                    frames: vec![frame],
                }),
            }
        }
        ways.sort_by_key(|way| way.world_from_map != Axes::IDENTITY);
        ways
    }

    /// What the picture shows in our world: in its middle, a quarter of its width to the right of that, and at its top.
    pub fn shown(&self) -> [&'static str; 3] {
        [(0.5, 0.5), (0.75, 0.5), (0.5, 0.0)].map(|(u, v)| {
            let dir: Vec3<f64> = MappingId::Latlong.continued(ChartPoint::new(0, u, v));
            let face = MappingId::Cube.forward(self.world_from_map.apply(dir));
            face.map_or("", |point| FACES[point.chart as usize])
        })
    }

    /// The way in one sentence, with the option of `sixfold convert` that takes a picture so.
    pub fn sentence(&self) -> String {
        let [middle, right, top] = self.shown();
        let names: Vec<&str> = self.frames.iter().map(|frame| frame.id).collect();
        let mirrored = if self.world_from_map.is_mirroring() {
            ", mirrored"
        } else {
            ""
        };
        format!(
            "{middle} in the middle, {right} to its right, {top} at the top{mirrored}: --from-frame {}",
            names.join(" or ")
        )
    }
}

/// How bright the two halves of a latlong are. In most places the sky is brighter than the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyHint {
    /// Mean lightness of the upper half, weighted by solid angle.
    pub above: f64,
    /// The same of the lower half.
    pub below: f64,
}

impl SkyHint {
    /// Of a latlong; `None` of any other map.
    pub fn of(shape: &MapShape, rasters: &[Raster]) -> Option<Self> {
        /// Texels along each side are enough for a mean.
        const MOST: u32 = 64;
        if shape.mapping != MappingId::Latlong {
            return None;
        }
        let texels = Texels { shape, rasters };
        let [width, height] = shape.size;
        let steps = [width.min(2 * MOST), height.min(MOST)];
        let (mut sums, mut weights) = ([0.0; 2], [0.0; 2]);
        for j in 0..steps[1] {
            let v = (f64::from(j) + 0.5) / f64::from(steps[1]);
            let half = usize::from(v > 0.5);
            let area = (v * std::f64::consts::PI).sin();
            for i in 0..steps[0] {
                let u = (f64::from(i) + 0.5) / f64::from(steps[0]);
                let at = [u * f64::from(width), v * f64::from(height)].map(|place| place as u32);
                let lightness = texels.lightness((0, at))?;
                sums[half] += area * lightness.iter().map(|c| f64::from(*c)).sum::<f64>() / 3.0;
                weights[half] += area;
            }
        }
        Some(Self {
            above: sums[0] / weights[0],
            below: sums[1] / weights[1],
        })
    }

    /// What it hints at, in one sentence that claims no more.
    pub fn sentence(&self) -> String {
        /// What differs by less is even.
        const CLEARLY: f64 = 1.1;
        let (above, below) = (self.above, self.below);
        let ratio = above.max(below) / above.min(below).max(f64::MIN_POSITIVE);
        let only = "brightness is a hint only";
        if !ratio.is_finite() || ratio < CLEARLY {
            format!("nothing hints at which side is up: both halves are as bright ({only})")
        } else if above > below {
            format!("its upper half is {ratio:.1} times as light: the sky seems to be up ({only})")
        } else {
            format!(
                "its lower half is {ratio:.1} times as light: it may lie upside down; `--rotate 0,0,180` turns it ({only})"
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_its_way() {
        let ways = LatlongWay::all();
        let find = |id: &str| {
            let has = |way: &&LatlongWay| way.frames.iter().any(|frame| frame.id == id);
            ways.iter().find(has).unwrap()
        };
        // The research table's directions, told in our world: y up programs that are right-handed have their z at our -z, those with z up
        // their y at our z.
        for (id, shown) in [
            ("ffmpeg", ["+z", "+x", "+y"]),
            ("cmft", ["+z", "+x", "+y"]),
            ("skylibs", ["+z", "+x", "+y"]),
            ("openexr", ["-z", "-x", "+y"]),
            ("oiio", ["-z", "-x", "+y"]),
            ("mitsuba", ["-z", "-x", "+y"]),
            ("oiio-z-up", ["+x", "+z", "+y"]),
            ("threejs", ["+x", "-z", "+y"]),
            ("blender", ["+x", "-z", "+y"]),
        ] {
            assert_eq!(find(id).shown(), shown, "{id}");
        }
        assert_eq!(ways[0].world_from_map, Axes::IDENTITY);
        let named: usize = ways.iter().map(|way| way.frames.len()).sum();
        let knowing = Frame::ALL
            .iter()
            .filter(|frame| frame.knows(MappingId::Latlong));
        assert_eq!(named, knowing.count());
        assert!(find("oiio-z-up").sentence().contains("mirrored"));
        assert!(!find("blender").sentence().contains("mirrored"));
        assert_eq!(
            find("openexr").sentence(),
            "-z in the middle, -x to its right, +y at the top: --from-frame openexr or oiio or mitsuba or godot"
        );
    }

    #[test]
    fn brightness_hints_and_says_so() {
        let of = |above: f64, below: f64| SkyHint { above, below }.sentence();
        assert!(of(2.0, 1.0).contains("upper half is 2.0 times"));
        assert!(of(1.0, 3.0).contains("upside down"));
        assert!(of(1.0, 1.05).contains("nothing hints") && of(0.0, 0.0).contains("nothing hints"));
        assert!(
            [of(2.0, 1.0), of(1.0, 3.0), of(1.0, 1.0)]
                .iter()
                .all(|text| text.contains("hint only"))
        );
    }
}
