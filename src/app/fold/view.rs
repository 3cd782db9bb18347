//! Where the points of a folded map are seen.

use std::f64::consts::TAU;

use crate::mapping::{ChartPoint, Coverage, Domain, Folded, MappingId, Unfolding, Way};
use crate::math::Vec3;
use crate::scene::{Camera, Projection};

/// A folded map before an eye, on a screen of some shape.
pub struct Surface {
    map: MappingId,
    unfolding: Unfolding,
    share: f64,
    folded: Folded,
    middle: Vec3<f64>,
    radius: f64,
    eye: glam::Vec3,
    projection: Projection,
}

/// The corners of the pieces of a mapping's surface, on its charts; the same however it is folded and wherever it is seen from.
pub struct Corners {
    /// Pieces along a side of a chart.
    steps: u32,
    /// Row by row, chart by chart.
    ways: Vec<Way>,
}

/// A point of a line on the map, and three beside it that tell from which side the surface is seen there.
#[derive(Clone, Copy, Debug)]
pub struct LinePoint {
    at: Way,
    beside: [Way; 3],
    /// They lie backwards along either u or v.
    is_turned: bool,
}

/// A piece of the surface.
#[derive(Clone, Copy, Debug)]
pub struct Quad {
    /// Its corners, around it.
    pub corners: [ChartPoint<f64>; 4],
    /// Where they are on the screen, in [0, 1]^2, v down.
    pub at: [[f32; 2]; 4],
    /// From the eye to its middle.
    pub depth: f32,
    /// It is seen from outside, where the picture is mirrored.
    pub is_outside: bool,
}

/// Pieces of the surface: enough that it looks round.
const PIECES: f64 = 4096.0;

impl Corners {
    /// Those of a mapping.
    pub fn new(map: MappingId) -> Self {
        let unfolding = Unfolding::new(map);
        let info = map.info();
        let steps = (PIECES / f64::from(info.chart_count())).sqrt().round() as u32;
        let point = |chart: u32, i: u32, j: u32| {
            let [s, t] = [i, j].map(|k| f64::from(k) / f64::from(steps));
            match info.domain {
                Domain::Square => ChartPoint::new(chart, s, t),
                Domain::Disc => {
                    // Outwards, then around: the same sense as u, then v.
                    let (sin, cos) = (TAU * t).sin_cos();
                    ChartPoint::new(chart, 0.5 + 0.5 * s * cos, 0.5 + 0.5 * s * sin)
                }
            }
        };
        let mut ways = Vec::new();
        for chart in 0..info.chart_count() {
            for j in 0..=steps {
                ways.extend((0..=steps).map(|i| unfolding.way(point(chart, i, j))));
            }
        }
        Self { steps, ways }
    }
}

impl LinePoint {
    /// That of a chart point.
    pub fn new(unfolding: &Unfolding, point: ChartPoint<f64>) -> Self {
        /// Steps towards the middle of the chart: at its border, where a pole may lie, a piece may have no sides.
        const STEP: f64 = 1e-3;
        let inward = |c: f64| if c > 0.5 { -STEP } else { STEP };
        let [du, dv] = [inward(point.u), inward(point.v)];
        let way = |u: f64, v: f64| unfolding.way(ChartPoint::new(point.chart, u, v));
        Self {
            at: way(point.u, point.v),
            beside: [[1.0, 1.0], [2.0, 1.0], [1.0, 2.0]]
                .map(|[i, j]| way(point.u + i * du, point.v + j * dv)),
            is_turned: du * dv < 0.0,
        }
    }

    /// The chart point.
    pub fn point(&self) -> ChartPoint<f64> {
        self.at.point
    }
}

impl Surface {
    /// A mapping folded so far.
    pub fn new(map: MappingId, share: f32, camera: Camera, aspect: f32) -> Self {
        let unfolding = Unfolding::new(map);
        let share = f64::from(share);
        let (middle, radius) = unfolding.ball(share);
        Self {
            map,
            folded: unfolding.folded(share),
            unfolding,
            share,
            middle,
            radius,
            eye: camera.eye(),
            projection: camera.projection(aspect),
        }
    }

    /// The mapping.
    pub fn map(&self) -> MappingId {
        self.map
    }

    fn place(&self, way: &Way) -> glam::Vec3 {
        let place = (self.folded.place(way) - self.middle) * (1.0 / self.radius);
        let [x, y, z] = place.to_f64().map(|c| c as f32);
        glam::Vec3::new(x, y, z)
    }

    fn on_screen(&self, way: &Way) -> Option<[f32; 2]> {
        self.projection
            .project(self.place(way))
            .map(|(x, y)| [x, y])
    }

    fn corner(&self, way: &Way) -> Option<([f32; 2], f32)> {
        let place = self.place(way);
        let (x, y) = self.projection.project(place)?;
        Some(([x, y], place.distance(self.eye)))
    }

    /// Where a chart point is on the screen, in [0, 1]^2, v down, and how far from the eye.
    pub fn seen(&self, point: ChartPoint<f64>) -> Option<([f32; 2], f32)> {
        self.corner(&self.unfolding.way(point))
    }

    /// The outline of the sphere, closed, once it is one and the mapping holds all of it: places on the screen as those of [`Self::seen`].
    pub fn outline(&self) -> Option<Vec<[f32; 2]>> {
        /// Points around it.
        const STEPS: u32 = 180;
        let is_sphere = self.share == 1.0 && self.map.info().coverage == Coverage::Sphere;
        if !is_sphere {
            return None;
        }
        // The tangents from the eye at distance d touch the unit sphere on the circle at 1/d from its middle.
        let towards = self.eye.normalize();
        let middle = towards / self.eye.length();
        let radius = (1.0 - middle.length_squared()).max(0.0).sqrt();
        let (right, up) = towards.any_orthonormal_pair();
        (0..=STEPS)
            .map(|k| {
                let (sin, cos) = (std::f32::consts::TAU * k as f32 / STEPS as f32).sin_cos();
                let place = middle + radius * (cos * right + sin * up);
                self.projection.project(place).map(|(x, y)| [x, y])
            })
            .collect()
    }

    /// Whether the surface is seen from outside there; on the flat picture, from behind.
    pub fn is_outside(&self, point: ChartPoint<f64>) -> bool {
        self.is_mirrored(&LinePoint::new(&self.unfolding, point))
    }

    fn is_mirrored(&self, point: &LinePoint) -> bool {
        let [Some(o), Some(a), Some(b)] = point.beside.each_ref().map(|way| self.on_screen(way))
        else {
            return false;
        };
        let turn = (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
        (turn < 0.0) != point.is_turned
    }

    /// Where a line's point is on the screen, and whether the surface is seen from outside there.
    pub fn side(&self, point: &LinePoint) -> Option<([f32; 2], bool)> {
        let at = self.on_screen(&point.at)?;
        Some((at, self.is_mirrored(point)))
    }

    /// The surface in pieces, the farthest first.
    pub fn quads(&self) -> Vec<Quad> {
        self.quads_between(&Corners::new(self.map))
    }

    /// The same between corners that are there already.
    pub fn quads_between(&self, corners: &Corners) -> Vec<Quad> {
        let side = corners.steps as usize + 1;
        let seen: Vec<Corner> = corners
            .ways
            .iter()
            .map(|way| (way.point, self.corner(way)))
            .collect();
        let mut quads = Vec::with_capacity(seen.len());
        for chart in seen.chunks_exact(side * side) {
            for (above, below) in chart
                .chunks_exact(side)
                .zip(chart.chunks_exact(side).skip(1))
            {
                for (above, below) in above.windows(2).zip(below.windows(2)) {
                    let mut corners = [above[0], above[1], below[1], below[0]];
                    // Cut into triangles along the diamond, on which an octahedron is folded.
                    let is_falling = (corners[0].0.u < 0.5) == (corners[0].0.v < 0.5);
                    corners.rotate_left(usize::from(is_falling));
                    quads.extend(quad(corners));
                }
            }
        }
        quads.sort_by(|a, b| b.depth.total_cmp(&a.depth));
        quads
    }

    /// The chart point under a place of the screen: of the nearest piece, or of the nearest that is seen from inside where what is seen from
    /// outside lets through.
    pub fn hit(
        &self,
        quads: &[Quad],
        place: [f32; 2],
        see_through: bool,
    ) -> Option<ChartPoint<f64>> {
        let found = |quad: &Quad| inside(quad, place);
        let nearest = || quads.iter().rev();
        let first = nearest()
            .filter(|quad| !see_through || !quad.is_outside)
            .find_map(found);
        first.or_else(|| nearest().find_map(found))
    }
}

/// True where one of the pieces that are seen from outside lies: they are drawn over all that is seen from inside.
pub fn is_covered(quads: &[Quad], place: [f32; 2]) -> bool {
    let outsides = quads.iter().filter(|quad| quad.is_outside);
    outsides.into_iter().any(|quad| {
        let is_near = [0, 1].into_iter().all(|i: usize| {
            let along = quad.at.map(|at| at[i]);
            let low = along.into_iter().fold(f32::INFINITY, f32::min);
            let high = along.into_iter().fold(f32::NEG_INFINITY, f32::max);
            (low..=high).contains(&place[i])
        });
        is_near && inside(quad, place).is_some()
    })
}

type Corner = (ChartPoint<f64>, Option<([f32; 2], f32)>);

fn quad(corners: [Corner; 4]) -> Option<Quad> {
    let seen = corners.map(|(_, seen)| seen);
    let [Some(a), Some(b), Some(c), Some(d)] = seen else {
        return None;
    };
    let at = [a, b, c, d].map(|(at, _)| at);
    let across = |i: usize, j: usize| [at[j][0] - at[i][0], at[j][1] - at[i][1]];
    let (ac, bd) = (across(0, 2), across(1, 3));
    Some(Quad {
        corners: corners.map(|(point, _)| point),
        at,
        depth: 0.25 * (a.1 + b.1 + c.1 + d.1),
        is_outside: ac[0] * bd[1] - ac[1] * bd[0] < 0.0,
    })
}

/// The chart point of a place in one of a piece's two triangles.
fn inside(quad: &Quad, place: [f32; 2]) -> Option<ChartPoint<f64>> {
    for [i, j, k] in [[0, 1, 2], [0, 2, 3]] {
        let [a, b, c] = [i, j, k].map(|k: usize| quad.at[k]);
        let cross = |p: [f32; 2], q: [f32; 2], r: [f32; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let whole = cross(a, b, c);
        let shares = [cross(place, b, c), cross(a, place, c), cross(a, b, place)]
            .map(|part| f64::from(part / whole));
        if shares.iter().all(|share| *share >= 0.0) {
            let mix = |of: fn(&ChartPoint<f64>) -> f64| {
                let corners = [i, j, k].map(|k: usize| of(&quad.corners[k]));
                corners.iter().zip(shares).map(|(c, share)| c * share).sum()
            };
            return Some(ChartPoint::new(
                quad.corners[0].chart,
                mix(|p| p.u),
                mix(|p| p.v),
            ));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(map: MappingId, share: f32) -> Surface {
        Surface::new(map, share, Camera::default(), 1.0)
    }

    #[test]
    fn the_flat_picture_is_seen_upright_and_from_inside() {
        for &map in MappingId::ALL {
            let flat = surface(map, 0.0);
            let quads = flat.quads();
            assert!(quads.len() > 3000, "{map}");
            assert!(quads.iter().all(|quad| !quad.is_outside), "{map}");
            assert!(quads.windows(2).all(|pair| pair[0].depth >= pair[1].depth));
            // All of it is on the screen.
            let on = |c: f32| (-0.01..=1.01).contains(&c);
            assert!(
                quads
                    .iter()
                    .flat_map(|q| q.at.into_iter().flatten())
                    .all(on),
                "{map}"
            );
            // From behind it is mirrored.
            let turned = Camera {
                yaw_rad: std::f32::consts::PI,
                ..Camera::default()
            };
            let behind = Surface::new(map, 0.0, turned, 1.0).quads();
            assert!(behind.iter().all(|quad| quad.is_outside), "control: {map}");
        }
    }

    #[test]
    fn half_of_the_sphere_is_seen_from_outside() {
        for &map in MappingId::ALL {
            let round = surface(map, 1.0);
            let quads = round.quads();
            let outside = quads.iter().filter(|quad| quad.is_outside).count();
            let share = outside as f64 / quads.len() as f64;
            assert!(share < 0.75, "{map}: {share}");
            for quad in quads.iter().step_by(37) {
                let [a, _, c, _] = quad.corners;
                let middle = ChartPoint::new(a.chart, 0.5 * (a.u + c.u), 0.5 * (a.v + c.v));
                // Where a texel is a line, at a pole or a rim, nothing can be told.
                if map
                    .jacobian(middle)
                    .is_some_and(|(_, j)| j.anisotropy() < 5.0)
                    && quad.depth < 2.9
                {
                    assert_eq!(
                        round.is_outside(middle),
                        quad.is_outside,
                        "{map} {middle:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn what_is_drawn_at_a_place_is_hit_there() {
        let round = surface(MappingId::Ccm, 1.0);
        let quads = round.quads();
        for point in [ChartPoint::new(4, 0.3, 0.6), ChartPoint::new(4, 0.52, 0.5)] {
            let (at, _) = round.seen(point).unwrap();
            let hit = round.hit(&quads, at, true).unwrap();
            assert_eq!(hit.chart, 4);
            assert!(
                (hit.u - point.u).abs() < 2e-3 && (hit.v - point.v).abs() < 2e-3,
                "{hit:?}"
            );
            // In front of +z, at the far side, lies -z.
            assert_eq!(round.hit(&quads, at, false).unwrap().chart, 5);
        }
        assert_eq!(round.hit(&quads, [0.01, 0.01], true), None);
    }
}
