//! How a map's texels part the horizon: the cut through the sphere at y = 0, seen from above (the paper's Figure 4).

use std::f64::consts::{PI, TAU};

use super::drawing::{Colour, Drawing, width as words_width};
use crate::imaging::resample::{chart_size, equal_rows};
use crate::mapping::{Borders, MappingId};
use crate::math::Vec3;

/// Texels on a quarter of the horizon that can be asked for.
pub const QUARTERS: (u32, u32) = (2, 24);

/// Borders as near as this are one, in radians: far below a texel.
const CORNER_RAD: f64 = 1e-6;

/// The texels of one map around the horizon.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampling {
    map: MappingId,
    /// Where one texel ends and the next one begins: angles from +z towards +x in radians, in [0, 2 pi), rising.
    borders_rad: Vec<f64>,
    /// For the angles from each border to the next one, the last to the first: true where the map has texels of its own.
    is_own: Vec<bool>,
}

/// The direction on the horizon at an angle from +z towards +x.
pub fn on_horizon(angle_rad: f64) -> Vec3<f64> {
    let (sin, cos) = angle_rad.sin_cos();
    Vec3::new(sin, 0.0, cos)
}

impl Sampling {
    /// A map of that fineness at which its texels on the horizon are most nearly as many as those of a cube map with `quarter` texels on a side, in
    /// proportion to what it holds of the horizon.
    pub fn new(map: MappingId, quarter: u32) -> Self {
        let quarter = quarter.clamp(QUARTERS.0, QUARTERS.1);
        let rows = equal_rows(map, MappingId::Cube, [quarter; 2]);
        let mut best = Self::of_rows(map, rows);
        let held_rad: f64 = best.texels_rad().map(|[from, to]| to - from).sum();
        let wanted = f64::from(4 * quarter) * held_rad / TAU;
        let off = |cut: &Self| (cut.texels_rad().count() as f64 - wanted).abs();
        // Texels that lie askew are crossed near their corners too: their number does not simply rise with that of the rows.
        let mut others: Vec<u32> = (rows.div_ceil(2)..=2 * rows).collect();
        others.sort_by_key(|other| other.abs_diff(rows));
        for other in others {
            if off(&best) < 0.5 {
                break;
            }
            let cut = Self::of_rows(map, other);
            if off(&cut) < off(&best) {
                best = cut;
            }
        }
        best
    }

    fn of_rows(map: MappingId, rows: u32) -> Self {
        /// Of a texel: nearer to a border is on it. Far above what rounding moves a place, so that a horizon on a border is on one side of it.
        const NEAR: f64 = 1e-12;
        let size = chart_size(map, rows).map(f64::from);
        let texel = |angle_rad: f64| {
            let point = map.own_point(on_horizon(angle_rad))?;
            let index = |c: f64, count: f64| {
                let place = c * count;
                let border = place.round();
                let is_on = (place - border).abs() < NEAR;
                (if is_on { border } else { place }) as u32
            };
            Some((
                point.chart,
                index(point.u, size[0]),
                index(point.v, size[1]),
            ))
        };
        /// Steps around: a twentieth of a texel of the finest cube map. What is passed in less than a step is not told from its neighbour.
        const STEPS: u32 = 20 * 4 * QUARTERS.1;
        /// Off the round angles, at which texels end.
        const OFFSET: f64 = 0.37;
        let angle = |step: u32| TAU * (f64::from(step) + OFFSET) / f64::from(STEPS);
        let mut borders_rad = Vec::new();
        let mut next = texel(angle(0));
        for step in 0..STEPS {
            let (mut low, mut high) = (angle(step), angle(step + 1));
            let first = std::mem::replace(&mut next, texel(high));
            if first == next {
                continue;
            }
            while high - low > 4.0 * f64::EPSILON * TAU {
                let middle = 0.5 * (low + high);
                if texel(middle) == first {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            borders_rad.push(high.rem_euclid(TAU));
        }
        borders_rad.sort_by(f64::total_cmp);
        // Where texels meet at a corner, u and v pass a border at once.
        borders_rad.dedup_by(|b, a| *b - *a < CORNER_RAD);
        let is_own = spans(&borders_rad)
            .map(|[from, to]| texel(0.5 * (from + to)).is_some())
            .collect();
        Self {
            map,
            borders_rad,
            is_own,
        }
    }

    /// The mapping.
    pub fn map(&self) -> MappingId {
        self.map
    }

    /// From where to where each texel of the map's own reaches, in radians; the last may end beyond 2 pi.
    pub fn texels_rad(&self) -> impl Iterator<Item = [f64; 2]> {
        let owned = spans(&self.borders_rad).zip(&self.is_own);
        owned.filter_map(|(span, is_own)| is_own.then_some(span))
    }

    /// The smallest and the largest angle that a texel covers, in radians; `None` when the map has none on the horizon.
    pub fn extremes_rad(&self) -> Option<[f64; 2]> {
        let angles = self.texels_rad().map(|[from, to]| to - from);
        angles.fold(None, |found, angle| {
            let [least, most] = found.unwrap_or([angle; 2]);
            Some([least.min(angle), most.max(angle)])
        })
    }

    /// What the numbers say, in a line.
    pub fn caption(&self) -> String {
        let Some([least, most]) = self.extremes_rad() else {
            return "nothing of the horizon".to_owned();
        };
        let count = self.texels_rad().count();
        let [small, large] = [least, most].map(|angle| format!("{:.2}", angle.to_degrees()));
        if small == large {
            format!("{count} texels of {small} degrees each")
        } else {
            let ratio = most / least;
            format!("{count} texels of {small} to {large} degrees, 1 : {ratio:.2}")
        }
    }
}

/// From each border to the next one, the last to the first.
fn spans(borders_rad: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    let next = borders_rad.iter().skip(1).copied();
    let first = borders_rad.first().map(|first| first + TAU);
    borders_rad
        .iter()
        .copied()
        .zip(next.chain(first))
        .map(|(from, to)| [from, to])
}

/// How far from the middle the map's solid is, cut at the horizon, where the sphere is at 1 and lies in it: the cube around it, the octahedron's
/// square with its corners ahead and at the sides, or the sphere itself.
fn reach(map: MappingId, dir: Vec3<f64>) -> f64 {
    match map.info().borders {
        Borders::CubeEdges => 1.0 / dir.x.abs().max(dir.z.abs()),
        Borders::FoldedSides => OCTAHEDRON / (dir.x.abs() + dir.z.abs()),
        _ => 1.0,
    }
}

/// Where the corners of the octahedron lie whose square touches the sphere from outside.
const OCTAHEDRON: f64 = std::f64::consts::SQRT_2;

/// Half the side of a square around a cut with room for the probe's mark.
fn half_side(map: MappingId) -> f64 {
    match map.info().borders {
        Borders::FoldedSides => OCTAHEDRON,
        _ => PROBE_REACH,
    }
}

/// How far the line to the probe goes: beyond the sphere.
const PROBE_REACH: f64 = 1.12;

const INK: Colour = [30, 30, 30];
const RAY: Colour = [160, 160, 160];
/// Every other texel, so that each is told from its neighbours; two of Okabe and Ito's colours.
const TEXELS: [Colour; 2] = [[0, 114, 178], [230, 159, 0]];
const PROBE: Colour = [213, 94, 0];

/// The cuts side by side, or one below the other on a high sheet; with the probe's direction where there is one.
pub fn drawing(cuts: &[Sampling], probe: Option<Vec3<f64>>, size: [u32; 2]) -> Drawing {
    let mut drawing = Drawing::new(size);
    let [width, height] = size.map(f64::from);
    let count = cuts.len().max(1) as f64;
    // The spheres are equally large.
    let half = cuts.iter().map(|cut| half_side(cut.map));
    let half = half.fold(1.0, f64::max);
    let [across, down] = if width >= height {
        [width / count, 0.0]
    } else {
        [0.0, height / count]
    };
    for (k, cut) in cuts.iter().enumerate() {
        let corner = [across * k as f64, down * k as f64];
        let cell = [
            if across > 0.0 { across } else { width },
            if down > 0.0 { down } else { height },
        ];
        draw_cut(&mut drawing, cut, probe, (corner, cell), half);
    }
    drawing
}

fn draw_cut(
    drawing: &mut Drawing,
    cut: &Sampling,
    probe: Option<Vec3<f64>>,
    (corner, [width, height]): ([f64; 2], [f64; 2]),
    half_side: f64,
) {
    /// Letters, of the sheet's smaller side, and the largest of them in pixels.
    const LETTER: f64 = 0.03;
    let letter = (LETTER * width.min(height)).clamp(7.0, 20.0);
    let head = 5.5 * letter;
    let radius = (0.5 * width.min(height - head) / half_side * 0.94).max(1.0);
    let middle = [
        corner[0] + 0.5 * width,
        corner[1] + head + 0.5 * (height - head),
    ];
    // From above: +z up, +x to the right.
    let at = |angle: f64, reach: f64| {
        let dir = on_horizon(angle);
        [
            middle[0] + dir.x * reach * radius,
            middle[1] - dir.z * reach * radius,
        ]
    };
    let solid = |angle: f64| at(angle, reach(cut.map, on_horizon(angle)));
    let left = corner[0] + letter;
    // As large as they may be, and within the cell.
    let head = [
        (cut.map.info().name.to_owned(), 1.0, 1.3 * letter),
        (cut.caption(), 3.3, letter),
    ];
    for (words, line, size) in head {
        let fits = (width - 2.0 * letter) / words_width(&words, 1.0);
        let at = [left, corner[1] + line * letter];
        drawing.words(&words, at, size.min(fits.max(1.0)), INK);
    }

    let pen = 0.08 * letter;
    for [from, to] in cut.texels_rad() {
        for end in [from, to] {
            drawing.line(&[middle, solid(end)], pen, RAY);
        }
    }
    /// Around the circle.
    const STEPS: u32 = 360;
    // An eighth of a turn is a whole number of steps, so that the solids' corners are among the points.
    let around = |place: &dyn Fn(f64) -> [f64; 2]| -> Vec<[f64; 2]> {
        (0..=STEPS)
            .map(|k| place(TAU * f64::from(k) / f64::from(STEPS)))
            .collect()
    };
    drawing.line(&around(&solid), 2.0 * pen, INK);
    for (k, [from, to]) in cut.texels_rad().enumerate() {
        let steps = ((to - from) / PI * 180.0).ceil().max(1.0) as u32;
        let arc: Vec<_> = (0..=steps)
            .map(|k| at(from + (to - from) * f64::from(k) / f64::from(steps), 1.0))
            .collect();
        drawing.line(&arc, 5.0 * pen, TEXELS[k % 2]);
    }
    for border in &cut.borders_rad {
        drawing.disc(solid(*border), 3.0 * pen, INK);
    }
    drawing.disc(middle, 3.0 * pen, INK);
    // Which way is which, inside the circle.
    for (name, angle) in [("+z", 0.0), ("+x", 0.5 * PI)] {
        let [x, y] = at(angle, 0.86);
        drawing.words_below(name, [x, y - 0.5 * letter], letter, INK);
    }
    if let Some(dir) = probe.filter(|dir| dir.x != 0.0 || dir.z != 0.0) {
        let angle = dir.x.atan2(dir.z);
        drawing.line(&[middle, at(angle, PROBE_REACH)], 3.0 * pen, PROBE);
        drawing.words("probe", [left, corner[1] + 4.9 * letter], letter, PROBE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mapping::ChartPoint;

    fn degrees(map: MappingId, quarter: u32) -> [f64; 2] {
        let found = Sampling::new(map, quarter).extremes_rad().unwrap();
        found.map(f64::to_degrees)
    }

    #[test]
    fn a_cube_parts_the_horizon_by_tangents_and_others_in_equal_angles() {
        // Four texels on a side end at tangents 0, 1/2 and 1.
        let inner = 0.5_f64.atan().to_degrees();
        let [least, most] = degrees(MappingId::Cube, 4);
        assert!((least - (45.0 - inner)).abs() < 1e-9 && (most - inner).abs() < 1e-9);
        for map in [MappingId::Latlong, MappingId::Eac] {
            let [least, most] = degrees(map, 4);
            let is_even = (least - 22.5).abs() < 1e-9 && (most - 22.5).abs() < 1e-9;
            assert!(is_even, "{map}");
        }
        // The continuous cube map lies between: its first border is where its inverse says.
        let border: Vec3<f64> = MappingId::Ccm
            .inverse(ChartPoint::new(4, 0.75, 0.5))
            .unwrap();
        let inner = border.x.atan2(border.z).to_degrees();
        let ccm = degrees(MappingId::Ccm, 4);
        let expected = [inner.min(45.0 - inner), inner.max(45.0 - inner)];
        assert!(
            ccm.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9),
            "{ccm:?}"
        );
        assert!(ccm[1] / ccm[0] < 1.2);
        assert!(most - least > 8.0, "control: a cube's texels differ");
    }

    #[test]
    fn the_texels_of_every_map_cover_what_it_holds_of_the_horizon_once() {
        const STEPS: u32 = 10_000;
        for &map in MappingId::ALL {
            let own = (0..STEPS)
                .filter(|k| {
                    let angle = TAU * (f64::from(*k) + 0.5) / f64::from(STEPS);
                    map.own_point(on_horizon(angle)).is_some()
                })
                .count();
            let share = own as f64 / f64::from(STEPS);
            for quarter in QUARTERS.0..=QUARTERS.1 {
                let cut = Sampling::new(map, quarter);
                let spans: Vec<_> = cut.texels_rad().collect();
                let whole: f64 = spans.iter().map(|[from, to]| to - from).sum();
                // Each of at most two ends of what it holds lies between two of the angles asked.
                let off = (whole - TAU * share).abs();
                assert!(
                    off < 2.0 * TAU / f64::from(STEPS),
                    "{map} {quarter}: {whole}"
                );
                let is_rising = spans.windows(2).all(|pair| pair[0][1] <= pair[1][0]);
                assert!(is_rising, "{map} {quarter}");
                // As many as were asked for, as far as whole rows can have them; none that rounding has made.
                let wanted = 4.0 * f64::from(quarter) * share;
                let count = spans.len() as f64;
                assert!(
                    (count - wanted).abs() <= 4.0,
                    "{map} {quarter}: {count} of {wanted}"
                );
                let [least, most] = cut.extremes_rad().unwrap();
                assert!(most / least < 30.0, "{map} {quarter}: {least} {most}");
            }
        }
    }

    #[test]
    fn a_finer_map_has_more_texels_and_the_words_say_how_many() {
        let of = |quarter| Sampling::new(MappingId::Cube, quarter);
        assert_eq!(
            of(4).caption(),
            "16 texels of 18.43 to 26.57 degrees, 1 : 1.44"
        );
        assert_eq!(
            Sampling::new(MappingId::Eac, 4).caption(),
            "16 texels of 22.50 degrees each"
        );
        assert_eq!(of(8).texels_rad().count(), 32);
        assert_eq!(of(0), of(QUARTERS.0));
        let sheet = drawing(&[of(4)], None, [300, 300]);
        let with_probe = drawing(&[of(4)], Some(Vec3::new(1.0, 0.0, 0.0)), [300, 300]);
        assert_eq!(sheet.svg().matches("<circle").count(), 17);
        assert!(with_probe.svg().len() > sheet.svg().len());
    }
}
