//! A map as a surface in space, on its way from the flat picture to the sphere.
//!
//! Places are in the frame of an eye that looks at the middle of the unfolded picture: +x to the right along u, +y up, +z away. On
//! the sphere it is the world's frame, turned so that the chart in the middle is in front.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::{Borders, ChartPoint, Layout, MappingId};
use crate::math::Vec3;

/// Half an edge of the cube whose corners lie on the unit sphere: 1/sqrt 3.
const HALF_EDGE: f64 = 0.577_350_269_189_625_8;

/// What lies between the flat picture and the sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solid {
    /// The net's faces turn about the edges on which they hang together.
    Cube,
    /// Eight triangles.
    Octahedron,
    /// The picture is rolled up.
    Cylinder,
}

impl Solid {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cube => "cube",
            Self::Octahedron => "octahedron",
            Self::Cylinder => "cylinder",
        }
    }
}

/// The way of one mapping.
#[derive(Clone, Copy, Debug)]
pub struct Unfolding {
    map: MappingId,
    solid: Option<Solid>,
    /// The axes of the eye's frame, in the world.
    axes: [Vec3<f64>; 3],
}

impl Unfolding {
    /// That of a mapping.
    pub fn new(map: MappingId) -> Self {
        let info = map.info();
        let solid = if info.borders == Borders::CubeEdges {
            Some(Solid::Cube)
        } else if info.borders == Borders::FoldedSides {
            Some(Solid::Octahedron)
        } else {
            info.borders.is_around().then_some(Solid::Cylinder)
        };
        // The chart in the middle: the cube's +z, and one on the equator.
        let chart = match info.layout {
            Layout::Cross => 4,
            Layout::Staircase => 6,
            _ => 0,
        };
        let at = |u: f64, v: f64| map.continued(ChartPoint::new(chart, u, v));
        let right = (at(0.75, 0.5) - at(0.25, 0.5)).normalized();
        let up = at(0.5, 0.25) - at(0.5, 0.75);
        let up = (up - right * up.dot(right)).normalized();
        // The frame is left-handed, as the world's is.
        let ahead = right.cross(up);
        Self {
            map,
            solid,
            axes: [right, up, ahead],
        }
    }

    /// What lies halfway; `None` where the picture goes straight to the sphere.
    pub fn solid(&self) -> Option<Solid> {
        self.solid
    }

    /// Where a point of a chart is, `share` of the way from the flat picture (0) by the solid (1/2) to the unit sphere (1).
    pub fn place(&self, point: ChartPoint<f64>, share: f64) -> Vec3<f64> {
        self.folded(share).place(&self.way(point))
    }

    /// What of a point's way is the same wherever it is stopped.
    pub fn way(&self, point: ChartPoint<f64>) -> Way {
        Way {
            point,
            start: match self.solid {
                Some(Solid::Cube | Solid::Cylinder) => Vec3::new(0.0, 0.0, 0.0),
                Some(Solid::Octahedron) => self.octahedron(point),
                None => self.flat(point),
            },
            sphere: self.from_world(self.map.continued(point)),
        }
    }

    /// The map stopped at a share of its way; see [`Unfolding::place`].
    pub fn folded(&self, share: f64) -> Folded {
        let share = share.clamp(0.0, 1.0);
        let first = (2.0 * share).min(1.0);
        let angle = first * FRAC_PI_2;
        Folded {
            solid: self.solid,
            aspect: self.map.info().aspect,
            share,
            first,
            second: (2.0 * share - 1.0).max(0.0),
            hinges: [angle, 2.0 * angle].map(f64::sin_cos),
        }
    }

    /// A direction of the world in the eye's frame.
    pub fn from_world(&self, dir: Vec3<f64>) -> Vec3<f64> {
        let [right, up, ahead] = self.axes;
        Vec3::new(dir.dot(right), dir.dot(up), dir.dot(ahead))
    }

    /// The flat picture, as large as the sphere's surface.
    fn flat(&self, point: ChartPoint<f64>) -> Vec3<f64> {
        let info = self.map.info();
        let aspect = info.layout.picture_aspect(info.aspect);
        let height = (4.0 * PI / aspect).sqrt();
        let place = info.layout.picture_from_chart(point).unwrap_or([0.5; 2]);
        Vec3::new(
            (place[0] - 0.5) * height * aspect,
            (0.5 - place[1]) * height,
            0.0,
        )
    }

    /// The place on the octahedron that has the same coordinates, whatever the mapping makes of them.
    fn octahedron(&self, point: ChartPoint<f64>) -> Vec3<f64> {
        let dir = MappingId::Octahedral.continued(point);
        let sum = dir.x.abs() + dir.y.abs() + dir.z.abs();
        self.from_world(dir * (1.0 / sum))
    }

    /// Middle and radius of a ball that holds all of it.
    pub fn ball(&self, share: f64) -> (Vec3<f64>, f64) {
        /// Steps along a side: the farthest points lie on borders and corners.
        const STEPS: u32 = 8;
        let mut places = Vec::new();
        for chart in 0..self.map.info().chart_count() {
            for (i, j) in (0..=STEPS).flat_map(|i| (0..=STEPS).map(move |j| (i, j))) {
                let [u, v] = [i, j].map(|k| f64::from(k) / f64::from(STEPS));
                if self.map.info().domain.contains(u, v) {
                    places.push(self.place(ChartPoint::new(chart, u, v), share));
                }
            }
        }
        let middle = [0, 1, 2].map(|k: usize| {
            let along = places.iter().map(|place| place.to_f64()[k]);
            let low = along.clone().fold(f64::INFINITY, f64::min);
            0.5 * (low + along.fold(f64::NEG_INFINITY, f64::max))
        });
        let middle = Vec3::from_f64(middle);
        let far = places.iter().map(|place| (*place - middle).length());
        (middle, far.fold(0.0, f64::max))
    }
}

/// A point of a chart, and what of its way is the same wherever it is stopped.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// The point.
    pub point: ChartPoint<f64>,
    /// Its place on the octahedron, or on the flat picture that goes straight to the sphere.
    start: Vec3<f64>,
    /// Its place on the sphere.
    sphere: Vec3<f64>,
}

/// A map that is stopped on its way.
#[derive(Clone, Copy, Debug)]
pub struct Folded {
    solid: Option<Solid>,
    aspect: f64,
    /// Of the whole way, of that to the solid, and of that from there on.
    share: f64,
    first: f64,
    second: f64,
    /// Sine and cosine of the angle by which a cube's hinges are bent, and of twice that.
    hinges: [(f64, f64); 2],
}

impl Folded {
    /// Where a point is.
    pub fn place(&self, way: &Way) -> Vec3<f64> {
        let Way {
            point,
            start,
            sphere,
        } = *way;
        let on_solid = match self.solid {
            None => return mix(start, sphere, self.share),
            Some(Solid::Cube) => net_to_cube(point, self.hinges),
            Some(Solid::Octahedron) if self.second == 0.0 => {
                let flat = Vec3::new(2.0 * point.u - 1.0, 1.0 - 2.0 * point.v, 0.0);
                mix(flat, start, self.first)
            }
            Some(Solid::Octahedron) => start,
            Some(Solid::Cylinder) => rolled(point, self.aspect, self.first),
        };
        mix(on_solid, sphere, self.second)
    }
}

fn mix(from: Vec3<f64>, to: Vec3<f64>, share: f64) -> Vec3<f64> {
    from + (to - from) * share
}

/// A point of a face of the cross, whose hinges are all bent by an angle from 0, flat, to a right angle, the cube. The far face
/// hangs on its neighbour. `hinges`: sine and cosine of the angle, and of twice that.
fn net_to_cube(point: ChartPoint<f64>, hinges: [(f64, f64); 2]) -> Vec3<f64> {
    const H: f64 = HALF_EDGE;
    let [a, b] = [point.u, point.v].map(|c| 2.0 * c - 1.0);
    let [(sin, cos), far] = hinges;
    // `d` along the face from its hinge.
    let bent = |d: f64| (H + d * cos, H - d * sin);
    match point.chart {
        0 => {
            let (x, z) = bent((a + 1.0) * H);
            Vec3::new(x, -b * H, z)
        }
        1 => {
            let (x, z) = bent((1.0 - a) * H);
            Vec3::new(-x, -b * H, z)
        }
        2 => {
            let (y, z) = bent((1.0 - b) * H);
            Vec3::new(a * H, y, z)
        }
        3 => {
            let (y, z) = bent((b + 1.0) * H);
            Vec3::new(a * H, -y, z)
        }
        4 => Vec3::new(a * H, -b * H, H),
        _ => {
            let (x, z) = bent(2.0 * H);
            let (sin, cos) = far;
            let d = (a + 1.0) * H;
            Vec3::new(x + d * cos, -b * H, z - d * sin)
        }
    }
}

/// A point of a picture of meridians and parallels that is rolled up: curvature 0 is flat, 1 the unit cylinder. The middle stays.
fn rolled(point: ChartPoint<f64>, aspect: f64, curvature: f64) -> Vec3<f64> {
    let along = (point.u - 0.5) * TAU;
    let y = (0.5 - point.v) * TAU / aspect;
    let half = 0.5 * curvature * along;
    // sin(c l)/c and (cos(c l) - 1)/c, without a division by a small c.
    let (sin, cos) = half.sin_cos();
    let ratio = if half == 0.0 { 1.0 } else { sin / half };
    Vec3::new(along * ratio * cos, y, 1.0 - along * ratio * sin)
}

#[cfg(test)]
mod tests {
    use super::super::cube_face::from_frame;
    use super::*;

    fn points(map: MappingId) -> impl Iterator<Item = ChartPoint<f64>> {
        let places = [0.02, 0.3, 0.5, 0.77, 0.98];
        (0..map.info().chart_count()).flat_map(move |chart| {
            places
                .into_iter()
                .flat_map(move |u| places.map(|v| ChartPoint::new(chart, u, v)))
                .filter(move |p| map.info().domain.contains(p.u, p.v))
        })
    }

    #[test]
    fn it_ends_on_the_sphere_where_the_directions_are() {
        for &map in MappingId::ALL {
            let unfolding = Unfolding::new(map);
            for point in points(map) {
                let place = unfolding.place(point, 1.0);
                let dir = unfolding.from_world(map.inverse(point).unwrap());
                assert!((place - dir).length() < 1e-14, "{map} {point:?}");
                // Nothing jumps on the way.
                for step in 0..50 {
                    let share = f64::from(step) / 50.0;
                    let moved =
                        unfolding.place(point, share + 0.02) - unfolding.place(point, share);
                    assert!(moved.length() < 0.35, "{map} {point:?} {share}");
                }
            }
            // The eye's frame is the world's, turned: the frame of a mirror image would be no turn.
            let [a, b, c] = unfolding.axes;
            assert!((a.cross(b).dot(c) - 1.0).abs() < 1e-14, "{map}");
        }
    }

    #[test]
    fn faces_keep_their_shape_until_the_cube_and_meet_there() {
        let unfolding = Unfolding::new(MappingId::Eac);
        let at = |chart, u, v, share| unfolding.place(ChartPoint::new(chart, u, v), share);
        for chart in 0..6 {
            for share in [0.0, 0.1, 0.25, 0.4, 0.5] {
                let [width, height, diagonal] = [[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
                    .map(|[u, v]| (at(chart, u, v, share) - at(chart, 0.0, 0.0, share)).length());
                let edge = 2.0 * HALF_EDGE;
                assert!((width - edge).abs() < 1e-14 && (height - edge).abs() < 1e-14);
                assert!((diagonal - edge * 2f64.sqrt()).abs() < 1e-14);
            }
            // Beyond the cube it does not.
            let bent = (at(chart, 1.0, 0.5, 0.8) - at(chart, 0.5, 0.5, 0.8)).length();
            assert!((bent - HALF_EDGE).abs() > 0.02, "control: {bent}");
            // The cube's faces are where their directions are.
            let [sc, tc] = [0.3, -0.6];
            let on_cube = at(chart, 0.5 + 0.5 * sc, 0.5 + 0.5 * tc, 0.5);
            let expected = from_frame(chart, sc, tc, 1.0) * HALF_EDGE;
            assert!(
                (on_cube - unfolding.from_world(expected)).length() < 1e-14,
                "{chart}"
            );
        }
        // Corners of the cube lie on the sphere, so that it only grows.
        assert!((at(3, 1.0, 1.0, 0.5).length() - 1.0).abs() < 1e-14);
        // The hinge between +x and -z holds all the way.
        for share in [0.0, 0.2, 0.5, 0.7, 1.0] {
            let gap = at(0, 1.0, 0.3, share) - at(5, 0.0, 0.3, share);
            assert!(gap.length() < 1e-14, "{share}");
            let open = at(1, 0.0, 0.3, share) - at(5, 1.0, 0.3, share);
            assert_eq!(open.length() < 1e-14, share >= 0.5, "control: {share}");
        }
    }

    #[test]
    fn a_latlong_is_rolled_without_being_stretched() {
        let unfolding = Unfolding::new(MappingId::Latlong);
        for share in [0.0, 1e-9, 0.2, 0.5] {
            let at = |u: f64| unfolding.place(ChartPoint::new(0, u, 0.4), share);
            let steps = (0..1000).map(|k| f64::from(k) / 1000.0);
            let length: f64 = steps.map(|u| (at(u + 1e-3) - at(u)).length()).sum();
            // A chord of a thousandth of a turn is shorter than its arc by (2 pi/1000)^2/24.
            assert!((length - TAU).abs() < 2e-5, "{share}: {length}");
        }
        let radius = |u: f64| unfolding.place(ChartPoint::new(0, u, 0.5), 0.5).length();
        assert!((radius(0.1) - 1.0).abs() < 1e-14 && (radius(0.9) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_ball_holds_the_sphere_and_the_net() {
        for &map in MappingId::ALL {
            let unfolding = Unfolding::new(map);
            for share in [0.0, 0.3, 0.5, 1.0] {
                let (middle, radius) = unfolding.ball(share);
                let far = points(map).map(|p| (unfolding.place(p, share) - middle).length());
                let far = far.fold(0.0, f64::max);
                // Observed: at most a hundredth more, between the points that are asked.
                assert!(
                    far < 1.02 * radius && far > 0.8 * radius,
                    "{map} {share}: {far} {radius}"
                );
            }
        }
    }
}
