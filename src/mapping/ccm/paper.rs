//! The paper's own numbers (Appendix A): texture index, S and T of the direction rotated into the +y face.

use super::{HALF_EDGE_RAD, across_edge, along_edge, from_edge};
use crate::mapping::cube_face::{FACES, sign_table};
use crate::mapping::{ChartPoint, Step};
use crate::math::{Real, Textbook, Vec3};

/// The paper's texture index of each chart (+x -x +y -y +z -z); its own inverse list is [`CHART_OF_INDEX`].
const INDEX_OF_CHART: [u32; 6] = [5, 4, 0, 1, 2, 3];
/// The chart of each of the paper's texture indices.
const CHART_OF_INDEX: [u32; 6] = [2, 3, 4, 5, 1, 0];

/// How the app's u and v follow from S and T on each chart.
pub(super) const CHART_TEXT: [(&str, &str); 6] = [
    ("u = 1 − T", "v = 1 − S"),
    ("u = T", "v = S"),
    ("u = 1 − S", "v = T"),
    ("u = 1 − S", "v = T"),
    ("u = 1 − S", "v = T"),
    ("u = S", "v = 1 − T"),
];

/// How each chart's direction is turned into the +y face.
const ROTATION_TEXT: [&str; 6] = [
    "(x', y', z') = (−y, x, z)",
    "(x', y', z') = (y, −x, z)",
    "(x', y', z') = (x, y, z)",
    "(x', y', z') = (x, −y, −z)",
    "(x', y', z') = (x, z, −y)",
    "(x', y', z') = (x, −z, y)",
];

/// The direction rotated into the +y face.
fn rotate<R: Real>(chart: u32, Vec3 { x, y, z }: Vec3<R>) -> Vec3<R> {
    match chart {
        0 => Vec3::new(-y, x, z),
        1 => Vec3::new(y, -x, z),
        2 => Vec3::new(x, y, z),
        3 => Vec3::new(x, -y, -z),
        4 => Vec3::new(x, z, -y),
        _ => Vec3::new(x, -z, y),
    }
}

/// The inverse of [`rotate`].
fn rotate_back<R: Real>(chart: u32, Vec3 { x, y, z }: Vec3<R>) -> Vec3<R> {
    match chart {
        0 => Vec3::new(y, -x, z),
        1 => Vec3::new(-y, x, z),
        2 => Vec3::new(x, y, z),
        3 => Vec3::new(x, -y, -z),
        4 => Vec3::new(x, -z, y),
        _ => Vec3::new(x, z, -y),
    }
}

/// (texture index, S, T) by the stable form: S = 1 - L(x'/y'), T = M(z'/y', x'/y').
pub(super) fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
    let scaled = dir.scaled_direction()?;
    let chart = sign_table(dir);
    let rotated = rotate(chart, scaled);
    let (a, b) = (rotated.x / rotated.y, rotated.z / rotated.y);
    Some(
        ChartPoint::new(
            INDEX_OF_CHART[chart as usize],
            along_edge(-a),
            across_edge(b, a),
        )
        .clamped(),
    )
}

/// The direction of (texture index, S, T).
pub(super) fn inverse<R: Real>(point: ChartPoint<R>) -> Option<Vec3<R>> {
    if !point.is_on(6) {
        return None;
    }
    let chart = CHART_OF_INDEX[point.chart as usize];
    let (minus_x, z, y) = from_edge(point.u, point.v);
    Some(rotate_back(chart, Vec3::new(-minus_x, y, z)))
}

/// (texture index, S, T) with Eq. 6 as it is printed: T = (1 + asin(z'/sqrt(2 + (x'/y')^2))/asin(1/sqrt 3))/2 for the unit z'.
pub(super) fn printed_eq6<R: Textbook>(dir: Vec3<R>) -> Option<ChartPoint<R>> {
    let right = forward(dir)?;
    let rotated = rotate(
        CHART_OF_INDEX[right.chart as usize],
        dir.scaled_direction()?,
    );
    let a = rotated.x / rotated.y;
    let z = rotated.z / rotated.length();
    let angle = (z / (R::two() + a * a).sqrt()).asin();
    let t = R::half() * (R::one() + angle * R::from_f64(1.0 / HALF_EDGE_RAD));
    Some(ChartPoint { v: t, ..right })
}

/// The listing of Appendix A word for word in f32, as the app's chart point. `None` where no row of its table matches
/// (texture index 6, black): `bool(ceil(d))` is true for d = -1, so the middles of six edges have no face.
pub(in crate::mapping) fn shader(dir: Vec3<f32>) -> Option<ChartPoint<f32>> {
    let r = dir.scaled_direction()?.normalized();
    let l = 2f32.sqrt() / 2.0;
    let check = |x: f32, y: f32, z: f32| (x * r.x + y * r.y + z * r.z).ceil() != 0.0;
    let chart = matching_row([
        check(l, l, 0.0),
        check(-l, l, 0.0),
        check(0.0, l, l),
        check(0.0, l, -l),
        check(l, 0.0, l),
        check(-l, 0.0, l),
    ])?;
    Some(from_s_t(chart, r))
}

/// The listing with the checks put right (`> 0`), but each product fused into its sum as a compiler may choose: here the
/// second where y takes part, else the first. Three roundings can then order x, y and z in a circle, and no row matches.
pub(in crate::mapping) fn fused_shader(dir: Vec3<f32>) -> Option<ChartPoint<f32>> {
    let r = dir.scaled_direction()?.normalized();
    let l = 2f32.sqrt() / 2.0;
    let chart = matching_row([
        l.mul_add(r.y, l * r.x) > 0.0,
        l.mul_add(r.y, -l * r.x) > 0.0,
        l.mul_add(r.z, l * r.y) > 0.0,
        (-l).mul_add(r.z, l * r.y) > 0.0,
        l.mul_add(r.x, l * r.z) > 0.0,
        (-l).mul_add(r.x, l * r.z) > 0.0,
    ])?;
    Some(from_s_t(chart, r))
}

/// Eq. 5 and Eq. 6 as they are printed, as the app's chart point.
pub(in crate::mapping) fn printed(dir: Vec3<f32>) -> Option<ChartPoint<f32>> {
    let ChartPoint { chart, u: s, v: t } = printed_eq6(dir)?;
    Some(chart_point(CHART_OF_INDEX[chart as usize], s, t))
}

/// The chart whose row of the paper's table the six checks match.
fn matching_row([c1, c2, c3, c4, c5, c6]: [bool; 6]) -> Option<u32> {
    if c1 && c2 && c3 && c4 {
        Some(2)
    } else if !c1 && !c2 && !c3 && !c4 {
        Some(3)
    } else if c5 && c6 && c3 && !c4 {
        Some(4)
    } else if !c5 && !c6 && !c3 && c4 {
        Some(5)
    } else if !c5 && c6 && !c1 && c2 {
        Some(1)
    } else if c5 && !c6 && c1 && !c2 {
        Some(0)
    } else {
        None
    }
}

/// The chart point of a unit direction on a chart by the shader's formulas: Eq. 5, and Eq. 6 put right.
pub(in crate::mapping) fn from_s_t(chart: u32, unit: Vec3<f32>) -> ChartPoint<f32> {
    let Vec3 { x, y, z } = rotate(chart, unit);
    let s = 0.5 - (x / y).library_atan2(2f32.sqrt()) / (2.0 * (1.0 / 3f32.sqrt()).asin());
    let t = (1.0 + z.asin() / (1.0 / (2.0 + (x / y) * (x / y)).sqrt()).asin()) / 2.0;
    chart_point(chart, s, t)
}

/// S and T of a chart point, and how its direction in the +y face is turned back.
pub(in crate::mapping) fn to_s_t(
    ChartPoint { chart, u, v }: ChartPoint<f32>,
) -> (f32, f32, impl Fn(Vec3<f32>) -> Vec3<f32>) {
    let (s, t) = match chart {
        0 => (1.0 - v, 1.0 - u),
        1 => (v, u),
        5 => (u, 1.0 - v),
        _ => (1.0 - u, v),
    };
    (s, t, move |dir| rotate_back(chart, dir))
}

/// The app's chart point of S and T on a chart.
fn chart_point<R: Real>(chart: u32, s: R, t: R) -> ChartPoint<R> {
    let one = R::one();
    let (u, v) = match chart {
        0 => (one - t, one - s),
        1 => (t, s),
        5 => (s, one - t),
        _ => (one - s, t),
    };
    ChartPoint::new(chart, u, v)
}

/// The paper's steps 1 to 4 with numbers, up to S and T.
pub(super) fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step> {
    let (Some(d), Some(paper)) = (dir.scaled_direction(), forward(dir)) else {
        return Vec::new();
    };
    let chart = CHART_OF_INDEX[paper.chart as usize];
    let Vec3 { x, y, z } = rotate(chart, d);
    let (a, b) = (x / y, z / y);
    let q = R::one() / (R::one() + a * a).sqrt();
    let longitude = (a * R::from_f64(std::f64::consts::FRAC_1_SQRT_2)).atan_unit();
    let (latitude, largest) = ((b * q).atan_unit(), q.atan_unit());
    vec![
        Step::new(
            "face",
            "the row of the sign table that matches",
            FACES[chart as usize].to_owned(),
        ),
        Step::new(
            "rotation into +y",
            ROTATION_TEXT[chart as usize],
            format!("({x}, {y}, {z})"),
        ),
        Step::new("a", "a = x'/y'", format!("{x}/{y} = {a}")),
        Step::new("b", "b = z'/y'", format!("{z}/{y} = {b}")),
        Step::new(
            "longitude",
            "θ = atan(a/√2)",
            format!("atan({a}/√2) = {longitude} rad"),
        ),
        Step::new("q", "q = 1/√(1 + a²)", format!("1/√(1 + {a}²) = {q}")),
        Step::new(
            "latitude",
            "φ = atan(b q)",
            format!("atan({b} · {q}) = {latitude} rad"),
        ),
        Step::new(
            "largest latitude",
            "Φ = atan(q)",
            format!("atan {q} = {largest} rad"),
        ),
        Step::new(
            "S",
            "S = 1/2 − θ/(2α), α = atan(1/√2)",
            format!("1/2 − {longitude}/(2α) = {}", paper.u),
        ),
        Step::new(
            "T",
            "T = 1/2 + φ/(2Φ)",
            format!("1/2 + {latitude}/(2 · {largest}) = {}", paper.v),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mapping::{Mapping, ccm::Ccm};
    use crate::math::inputs::Random;

    #[test]
    fn the_apps_chart_is_the_papers_turned() {
        let mut random = Random::new(1);
        for _ in 0..20_000 {
            let dir = Vec3::from_f64(random.adversarial().map(f64::from));
            let [p, app]: [ChartPoint<f64>; 2] =
                [forward(dir).unwrap(), Ccm::forward(dir).unwrap()];
            let turned = chart_point(CHART_OF_INDEX[p.chart as usize], p.u, p.v);
            assert_eq!(turned.chart, app.chart);
            assert!((turned.u - app.u).abs() < 1e-15 && (turned.v - app.v).abs() < 1e-15);
            let back = inverse::<f64>(p).unwrap();
            assert!(crate::math::angle_rad(back.to_f64(), dir.to_f64()) < 1e-14);
        }
    }

    #[test]
    fn the_printed_shader_is_right_away_from_its_holes() {
        let mut random = Random::new(2);
        let mut worst = 0f32;
        for _ in 0..20_000 {
            let dir = random.direction();
            let dir = Vec3::new(dir[0], dir[1], dir[2]);
            let (Some(shader), Some(own)) = (shader(dir), Ccm::forward(dir)) else {
                continue;
            };
            assert_eq!(shader.chart, own.chart);
            worst = worst
                .max((shader.u - own.u).abs())
                .max((shader.v - own.v).abs());
        }
        assert!((1e-8..1e-6).contains(&worst), "observed {worst}");
    }

    /// The farthest black direction from an edge's middle within `radius` rad, in rad; 0 when none is black.
    fn farthest_black(middle: [i8; 3], radius: f64) -> f64 {
        let axis = Vec3::<f64>::from_f64(middle.map(f64::from)).normalized();
        let mut random = Random::new(4);
        let mut farthest = 0.0_f64;
        for _ in 0..200_000 {
            let offset =
                Vec3::<f64>::from_f64([(); 3].map(|()| radius * (2.0 * random.unit() - 1.0)));
            let dir = Vec3::<f32>::from_f64((axis + offset).to_f64());
            assert!(Ccm::forward(dir).is_some());
            if shader(dir).is_none() {
                farthest = farthest.max(crate::math::angle_rad(axis.to_f64(), dir.to_f64()));
            }
        }
        farthest
    }

    #[test]
    fn the_printed_shader_has_six_black_discs_of_0_0315_degrees() {
        let black = [
            [-1, -1, 0],
            [1, -1, 0],
            [0, -1, -1],
            [0, -1, 1],
            [-1, 0, -1],
            [1, 0, -1],
        ];
        for middle in black {
            let radius_deg = farthest_black(middle, 6e-4).to_degrees();
            assert!(
                (radius_deg - 0.0315).abs() < 0.002,
                "{middle:?}: {radius_deg}"
            );
            assert_eq!(
                farthest_black(middle.map(|c| -c), 6e-4),
                0.0,
                "the opposite of {middle:?}"
            );
        }
    }

    #[test]
    fn eq_6_as_printed_misses_the_edge() {
        // Values of the errata: on the edge z = y the right T is 1 for every x.
        for (x, printed) in [
            (0.0, 0.925_358),
            (0.25, 0.911_216),
            (0.5, 0.874_142),
            (0.75, 0.825_678),
            (1.0, 0.776_075),
        ] {
            // At x = 1 three faces meet and the table gives the direction to +x; stay a hair inside +y.
            let dir = Vec3::new(x * (1.0 - 1e-9), 1.0, 1.0 - 1e-9);
            let (wrong, right) = (
                printed_eq6::<f64>(dir).unwrap().v,
                forward::<f64>(dir).unwrap().v,
            );
            assert!((wrong - printed).abs() < 1e-6, "{x}: {wrong}");
            assert!((right - 1.0).abs() < 1e-8, "{x}: {right}");
        }
    }
}
