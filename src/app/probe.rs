//! The probe's marks: where one direction, its face and its texel lie on every map. Pure geometry, no drawing.

use crate::mapping::cube_face::{from_gnomonic, sign_table};
use crate::mapping::{ChartPoint, MappingId};
use crate::math::Vec3;

/// The texel (column, row) of a chart point on a chart of `size` = [width, height] texels.
pub fn texel_of(point: ChartPoint<f64>, size: [u32; 2]) -> [u32; 2] {
    let index = |c: f64, n: u32| ((c * f64::from(n)) as u32).min(n.saturating_sub(1));
    [index(point.u, size[0]), index(point.v, size[1])]
}

/// The direction some texels away on a chart of `size` texels. Beyond the chart's border the walk goes on along the tangent
/// and lands on the chart that is next on the sphere. `None` when `dir` is no direction.
pub fn stepped(
    mapping: MappingId,
    size: [u32; 2],
    dir: Vec3<f64>,
    columns: i32,
    rows: i32,
) -> Option<Vec3<f64>> {
    let point = mapping.forward(dir)?;
    let du = f64::from(columns) / f64::from(size[0]);
    let dv = f64::from(rows) / f64::from(size[1]);
    let target = ChartPoint::new(point.chart, point.u + du, point.v + dv);
    mapping.inverse(target).or_else(|| {
        // A little inside the chart, where the Jacobian exists also at a disc's rim.
        let inside = |c: f64| 0.5 + (c - 0.5) * (1.0 - 1e-6);
        let near = ChartPoint::new(point.chart, inside(point.u), inside(point.v));
        let (at, jacobian) = mapping.jacobian(near)?;
        let next = at + jacobian.du * du + jacobian.dv * dv;
        next.scaled_direction().map(Vec3::normalized)
    })
}

/// A closed line on the sphere, as unit directions.
pub type Outline = Vec<Vec3<f64>>;

/// Points on each side of the outlines: enough for a smooth line in the largest panel.
const SIDE_POINTS: usize = 48;

/// The border of the face that the sign table picks for `dir`, a hair inside it, so that no point of it is a tie.
pub fn face_outline(dir: Vec3<f64>) -> Outline {
    const INSIDE: f64 = 1.0 - 1e-4;
    let face = sign_table(dir);
    square(|x, y| Some(from_gnomonic(face, x * INSIDE, y * INSIDE)))
}

/// The border of the texel of `mapping` that holds `dir`, on charts of `size` texels; empty when it has none.
pub fn texel_outline(mapping: MappingId, size: [u32; 2], dir: Vec3<f64>) -> Outline {
    let Some(point) = mapping.forward(dir) else {
        return Outline::new();
    };
    let texel = texel_of(point, size).map(f64::from);
    let place = |t: f64, c: f64, n: u32| (t + 0.5 + 0.5 * c) / f64::from(n);
    square(|x, y| {
        let (u, v) = (place(texel[0], x, size[0]), place(texel[1], y, size[1]));
        mapping.inverse(ChartPoint::new(point.chart, u, v))
    })
}

/// The image of the border of [-1, 1]^2, closed; points without an image are left out.
fn square(image: impl Fn(f64, f64) -> Option<Vec3<f64>>) -> Outline {
    let corners = [
        [-1.0, -1.0],
        [1.0, -1.0],
        [1.0, 1.0],
        [-1.0, 1.0],
        [-1.0, -1.0],
    ];
    let mut outline = Outline::new();
    for side in corners.windows(2) {
        for i in 0..SIDE_POINTS {
            let t = i as f64 / SIDE_POINTS as f64;
            let at = |k: usize| side[0][k] + (side[1][k] - side[0][k]) * t;
            outline.extend(image(at(0), at(1)));
        }
    }
    outline.extend(image(corners[0][0], corners[0][1]));
    outline
}

/// An outline as lines in a mapping's unfolded picture, cut where the map is cut: picture coordinates in [0, 1]^2.
pub fn picture_lines(mapping: MappingId, outline: &[Vec3<f64>]) -> Vec<Vec<[f64; 2]>> {
    let info = mapping.info();
    let mut lines: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
    let mut previous: Option<(Vec3<f64>, [f64; 2])> = None;
    for &dir in outline {
        let place = mapping
            .forward(dir)
            .and_then(|p| info.layout.picture_from_chart(p));
        let Some(place) = place else {
            lines.push(Vec::new());
            previous = None;
            continue;
        };
        if let Some((before, at)) = previous
            && is_cut(mapping, before, at, dir, place)
        {
            lines.push(Vec::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push(place);
        }
        previous = Some((dir, place));
    }
    lines.retain(|line| line.len() > 1);
    lines
}

/// True when the picture is cut between two neighbouring points: the middle of the arc between them does not lie near the
/// middle of the line between their places.
fn is_cut(mapping: MappingId, a: Vec3<f64>, at_a: [f64; 2], b: Vec3<f64>, at_b: [f64; 2]) -> bool {
    let length = (at_b[0] - at_a[0]).hypot(at_b[1] - at_a[1]);
    // Neighbouring points of an outline lie close together unless a seam parts them.
    if length < 1e-3 {
        return false;
    }
    let Some(middle) = mapping.forward(a + b) else {
        return true;
    };
    let Some(place) = mapping.info().layout.picture_from_chart(middle) else {
        return true;
    };
    let off = (place[0] - 0.5 * (at_a[0] + at_b[0])).hypot(place[1] - 0.5 * (at_a[1] + at_b[1]));
    off > 0.25 * length
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::inputs::Random;

    fn random_dir(random: &mut Random) -> Vec3<f64> {
        Vec3::from_f64(random.direction().map(f64::from))
    }

    #[test]
    fn the_face_outline_stays_on_its_face() {
        let mut random = Random::new(5);
        for _ in 0..100 {
            let dir = random_dir(&mut random);
            let outline = face_outline(dir);
            assert!(outline.iter().all(|d| sign_table(*d) == sign_table(dir)));
            assert!(outline.iter().any(|d| sign_table(*d) != sign_table(-dir)));
        }
    }

    #[test]
    fn the_texel_outline_surrounds_the_probe() {
        let mut random = Random::new(6);
        for &mapping in MappingId::ALL {
            let size = [64, 64];
            let mut seen = 0;
            for _ in 0..200 {
                let dir = random_dir(&mut random);
                if !mapping.info().coverage.contains(dir.to_f64()) {
                    continue;
                }
                let outline = texel_outline(mapping, size, dir);
                let Some(point) = mapping.forward(dir) else {
                    continue;
                };
                let texel = texel_of(point, size).map(f64::from);
                for d in outline {
                    let p = mapping.forward(d).unwrap();
                    if p.chart != point.chart {
                        continue; // on a seam the border belongs to the neighbour too
                    }
                    let (x, y) = (p.u * 64.0 - texel[0], p.v * 64.0 - texel[1]);
                    let near = |c: f64| (-1e-6..=1.0 + 1e-6).contains(&c);
                    seen += usize::from(near(x) && near(y));
                }
            }
            assert!(
                seen > 10_000,
                "{mapping}: {seen} border points near their texel"
            );
        }
    }

    #[test]
    fn outlines_are_cut_at_seams_and_nowhere_else() {
        let mut random = Random::new(7);
        for &mapping in MappingId::ALL {
            for _ in 0..50 {
                let outline = face_outline(random_dir(&mut random));
                for line in picture_lines(mapping, &outline) {
                    let longest = line
                        .windows(2)
                        .map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]))
                        .fold(0.0, f64::max);
                    assert!(
                        longest < 0.2,
                        "{mapping}: a stroke of {longest} across the picture"
                    );
                }
            }
        }
        // On its own cube a face is one closed line.
        let outline = face_outline(Vec3::new(0.1, 0.2, 0.9));
        assert_eq!(picture_lines(MappingId::Cube, &outline).len(), 1);
        // Around the back a latlong picture is cut.
        let back = face_outline(Vec3::new(0.1, 0.2, -0.9));
        assert!(picture_lines(MappingId::Latlong, &back).len() > 1);
    }

    #[test]
    fn a_walk_across_a_border_lands_next_door() {
        let size = [256, 256];
        for &mapping in MappingId::ALL {
            let mut random = Random::new(8);
            for _ in 0..300 {
                let dir = random_dir(&mut random);
                // The last column of a chart, then one more to the right.
                let Some(point) = mapping.forward(dir) else {
                    continue;
                };
                let border = ChartPoint::new(point.chart, 1.0 - 1e-3, point.v);
                let Some(start) = mapping.inverse(border) else {
                    continue;
                };
                let Some(next) = stepped(mapping, size, start, 1, 0) else {
                    panic!("{mapping}: no step from {start:?}")
                };
                let moved = crate::math::angle_rad(start.to_f64(), next.to_f64());
                // A column is as wide as the map is stretched there: without bound towards the sphere map's rim.
                let Some((_, jacobian)) = mapping.jacobian(border) else {
                    continue;
                };
                let column = jacobian.singular_values().0 / f64::from(size[0]);
                assert!(
                    moved < 2.0 * column,
                    "{mapping}: {moved} rad for a column of {column}"
                );
            }
        }
    }
}
