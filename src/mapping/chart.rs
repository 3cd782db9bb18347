//! Where a direction lands: charts, their coordinates and what is said about a mapping.

use std::fmt::Display;

use serde::{Deserialize, Serialize};

use super::convention::{Convention, Erratum};
use super::cube_face::{self, Neighbour, Side};
use super::evaluator::EvaluatorInfo;
use super::family::Family;
use super::healpix;
use super::lanes::{self, AngleLanes, DirLanes, Lane, Line, PointLanes};
use super::layout::Layout;
use crate::math::{Real, Vec3};

/// A point on one chart of a mapping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChartPoint<R> {
    /// Index of the chart, from 0.
    pub chart: u32,
    /// To the right, in [0, 1].
    pub u: R,
    /// Downwards, in [0, 1].
    pub v: R,
}

impl<R: Real> ChartPoint<R> {
    /// The point (u, v) of a chart.
    pub const fn new(chart: u32, u: R, v: R) -> Self {
        Self { chart, u, v }
    }

    /// The same point with both coordinates clamped to [0, 1].
    pub fn clamped(self) -> Self {
        Self {
            u: self.u.clamp_unit(),
            v: self.v.clamp_unit(),
            ..self
        }
    }

    /// The same place with v counted from the other end; its own inverse.
    pub fn flipped(self) -> Self {
        Self {
            v: R::one() - self.v,
            ..self
        }
    }

    /// The point's coordinates as f64.
    pub fn to_f64(self) -> ChartPoint<f64> {
        ChartPoint::new(self.chart, self.u.to_f64(), self.v.to_f64())
    }

    /// True when the point lies on a chart of a mapping with `charts` charts: both coordinates in [0, 1].
    pub fn is_on(self, charts: u32) -> bool {
        let unit = |c: R| c >= R::zero() && c <= R::one();
        self.chart < charts && unit(self.u) && unit(self.v)
    }
}

/// One mapping: everything around a point, stored in flat charts.
///
/// Both functions are written once for every number type. Dual numbers make them yield their exact Jacobian.
pub trait Mapping {
    /// What the mapping is called, covers and claims.
    const INFO: MappingInfo;

    /// The chart point of a direction of any length. `None` for zero, NaN and infinite vectors only; a direction without a
    /// unique image (see [`Coverage`]) gets one of its images.
    fn forward<R: Real>(dir: Vec3<R>) -> Option<ChartPoint<R>>;

    /// The unit direction of a chart point. `None` off the chart: an index too large, a coordinate outside [0, 1] or not a
    /// number, or a point outside the disc of a disc mapping.
    fn inverse<R: Real>(point: ChartPoint<R>) -> Option<Vec3<R>> {
        let info = &Self::INFO;
        (point.is_on(info.chart_count()) && info.domain.contains(point.u, point.v))
            .then(|| Self::continued(point))
    }

    /// [`inverse`](Self::inverse), continued beyond the border: the unit direction that a texel of the gutter stands for.
    ///
    /// Without a jump at the border; over a seam into the neighbour, and where a rim has no other side the rim's own
    /// direction. Takes finite coordinates at most half a chart beyond; each mapping says how it goes on, and its shader does
    /// the same.
    fn continued<R: Real>(point: ChartPoint<R>) -> Vec3<R>;

    /// Parts of each chart in which the mapping is smooth, convex ones: between them it is bent, as the octahedron's square is
    /// along the octahedron's edges. Most mappings are smooth on all of a chart.
    const FACETS: u32 = 1;

    /// The part, below [`FACETS`](Self::FACETS), in which a point of a chart lies.
    fn facet<R: Real>(point: ChartPoint<R>) -> u32 {
        let _ = point;
        0
    }

    /// [`inverse`](Self::inverse) by the formula of one part, continued beyond its borders so that light between texels on both
    /// sides of them is where it belongs. By itself [`continued`](Self::continued), which has to stay at the border within an ULP.
    fn extended<R: Real>(facet: u32, point: ChartPoint<R>) -> Vec3<R> {
        let _ = facet;
        Self::continued(point)
    }

    /// Where the direction of a point beyond one part of a chart, [`extended`](Self::extended), lies on the map.
    fn folded<R: Real>(facet: u32, point: ChartPoint<R>) -> Option<ChartPoint<R>> {
        Self::forward(Self::extended(facet, point))
    }

    /// Whether the functions on lanes below are the mapping's own, free of branches.
    const HAS_LANES: bool = false;

    /// Whether the lanes resolve directions near the y axis only as long as their x and z are small and exact: not when a
    /// rotation has made them from large ones.
    const LANES_HAVE_POLES: bool = false;

    /// [`forward`](Self::forward) of many directions at once. On ties and within an ULP of them the chart may be another of
    /// those that meet there.
    #[inline(always)]
    fn forward_lanes(dirs: &DirLanes, points: &mut PointLanes)
    where
        Self: Sized,
    {
        lanes::forward_each::<Self>(dirs, points);
    }

    /// What the texels of a column (`side` 0) or row (1) share, for [`inverse_lanes`](Self::inverse_lanes); by itself the
    /// coordinate.
    fn line(side: usize, coordinate: f64) -> Line {
        let _ = side;
        [coordinate as f32, 0.0, 0.0, 0.0]
    }

    /// Directions, of any length, of texels of one row from what their columns and the row have in common.
    #[inline(always)]
    fn inverse_lanes(chart: u32, columns: [&Lane; 4], row: Line, dirs: &mut DirLanes)
    where
        Self: Sized,
    {
        lanes::inverse_each::<Self>(chart, columns, row, dirs);
    }

    /// Whether the columns of a chart are meridians: all texels of one have the same longitude.
    fn has_meridians(chart: u32) -> bool {
        let _ = chart;
        false
    }

    /// Latitudes, in turns, of texels of one row of a chart that [has meridians](Self::has_meridians), from what their columns and
    /// the row have in common.
    #[inline(always)]
    fn latitude_lanes(columns: [&Lane; 4], row: Line, latitudes: &mut AngleLanes)
    where
        Self: Sized,
    {
        let _ = (columns, row, latitudes);
    }

    /// Where u depends on the longitude alone and v in proportion on the latitude, so that rows are parallels and columns meridians: v
    /// on the equator, and what is added for each turn of latitude.
    const PARALLELS: Option<[f32; 2]> = None;

    /// Whether charts are the faces of a cube, from the side in the order of [`cube_face`](super::cube_face).
    const HAS_FACES: bool = false;

    /// (u - 1/2, v - 1/2) of a point of a face's gnomonic plane, where the mapping [has faces](Self::HAS_FACES); without a branch.
    #[inline(always)]
    fn from_middle(face: u32, a: f32, b: f32) -> (f32, f32) {
        let _ = face;
        (a, b)
    }

    /// The formula step by step with the numbers of `dir` put in; empty for a vector that is no direction.
    fn steps<R: Real + std::fmt::Display>(dir: Vec3<R>) -> Vec<Step>;
}

/// One line of a mapping's formula.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Step {
    /// What is computed.
    pub name: &'static str,
    /// The formula in letters.
    pub formula: &'static str,
    /// The formula with the numbers put in, and its value.
    pub with_numbers: String,
}

impl Step {
    /// A step whose numbers are already written out.
    pub fn new(name: &'static str, formula: &'static str, with_numbers: String) -> Self {
        Self {
            name,
            formula,
            with_numbers,
        }
    }

    /// Which of two discs.
    pub(super) fn disc(is_front: bool) -> Self {
        let found = if is_front {
            "z ≥ 0: front"
        } else {
            "z < 0: back"
        };
        Self::new("chart", "front where z ≥ 0, else back", found.to_owned())
    }

    /// The distance `q` of a direction from the z axis.
    pub(super) fn across<R: Display>(x: R, y: R, q: R) -> Self {
        Self::new("across", "q = √(x² + y²)", format!("√({x}² + {y}²) = {q}"))
    }

    /// u and v at a distance `rho` from a disc's middle, towards (x, y)/q.
    pub(super) fn from_middle<R: Display>(
        is_front: bool,
        rho: R,
        [x, y, q]: [R; 3],
        point: &ChartPoint<R>,
    ) -> [Self; 2] {
        let (u_formula, sign) = if is_front {
            ("u = 1/2 + ρ x/q", "+")
        } else {
            ("u = 1/2 − ρ x/q", "−")
        };
        let ChartPoint { u, v, .. } = point;
        [
            Self::new("u", u_formula, format!("1/2 {sign} {rho} · {x}/{q} = {u}")),
            Self::new(
                "v",
                "v = 1/2 − ρ y/q",
                format!("1/2 − {rho} · {y}/{q} = {v}"),
            ),
        ]
    }

    /// The length `n` of a direction.
    pub(super) fn length<R: Display>(Vec3 { x, y, z }: Vec3<R>, n: R) -> Self {
        Self::new(
            "length",
            "n = √(x² + y² + z²)",
            format!("√({x}² + {y}² + {z}²) = {n}"),
        )
    }
}

/// From [-1, 1] to the chart's [0, 1].
pub(super) fn to_unit<R: Real>(c: R) -> R {
    (c + R::one()) * R::half()
}

/// From the chart's [0, 1] to [-1, 1]: undoes [`to_unit`].
pub(super) fn to_signed<R: Real>(c: R) -> R {
    R::two() * c - R::one()
}

/// What a mapping is called, covers and claims.
#[derive(Debug)]
pub struct MappingInfo {
    /// Name on the command line and in files.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// One sentence on what it is.
    pub about: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// Under which heading lists have it.
    pub family: Family,
    /// Name of each chart, in order.
    pub charts: &'static [&'static str],
    /// Width of a chart over its height at which texels are square where the mapping is least distorted.
    pub aspect: f64,
    /// Which part of each chart holds directions.
    pub domain: Domain,
    /// Which directions have an image.
    pub coverage: Coverage,
    /// What lies across the borders of the charts.
    pub borders: Borders,
    /// How the charts are unfolded into one picture.
    pub layout: Layout,
    /// What the mapping promises; laws hold it to that.
    pub claims: Claims,
    /// Where f32 cannot resolve directions, however they are computed.
    pub weak_spots: &'static [WeakSpot],
    /// The other numbers that the literature gives for the same map.
    pub conventions: &'static [Convention],
    /// Where the literature prints it wrongly.
    pub errata: &'static [Erratum],
    /// Makes the list of ways to compute it beyond the shared ones.
    pub evaluators: fn() -> Vec<EvaluatorInfo>,
}

impl MappingInfo {
    /// What most mappings have in common: one square chart for the whole sphere, and nothing promised. A mapping names what
    /// differs.
    pub const PLAIN: Self = Self {
        id: "",
        name: "",
        about: "",
        source: "",
        family: Family::Graticule,
        charts: &["all"],
        aspect: 1.0,
        domain: Domain::Square,
        coverage: Coverage::Sphere,
        borders: Borders::End,
        layout: Layout::Single,
        claims: Claims {
            equal_area: false,
            conformal: false,
            continuous: true,
        },
        weak_spots: &[],
        conventions: &[],
        errata: &[],
        evaluators: Vec::new,
    };

    /// Number of charts.
    pub const fn chart_count(&self) -> u32 {
        self.charts.len() as u32
    }

    /// The named convention.
    pub fn convention(&self, id: &str) -> Option<&'static Convention> {
        self.conventions.iter().find(|c| c.id == id)
    }
}

/// Which part of each chart holds directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Domain {
    /// All of it.
    Square,
    /// The largest disc that fits: pi/4 = 78.5 % of the texels.
    Disc,
}

impl Domain {
    /// True when (u, v) in [0, 1]^2 lies in the domain. The disc's edge gets four ULP of slack, because a rim point's
    /// rounded coordinates may lie just outside.
    pub fn contains<R: Real>(self, u: R, v: R) -> bool {
        match self {
            Self::Square => true,
            Self::Disc => {
                let (p, q) = (R::two() * u - R::one(), R::two() * v - R::one());
                p * p + q * q <= R::from_f64(1.0 + 4.0 * R::EPSILON)
            }
        }
    }
}

/// Squared height of the unit ball over a point of the disc: 1 - p^2 - q^2 with p = 2u - 1, q = 2v - 1.
///
/// 1 - p^2 is 4u(1 - u), which keeps the digits of a small u that 2u - 1 rounds away; near the rim, where they matter,
/// the larger of the two lies in [1/2, 1], so that taking it from 1 is exact.
pub(super) fn height_squared<R: Real>(u: R, v: R) -> R {
    let four = R::two() * R::two();
    let (a, b) = (four * u * (R::one() - u), four * v * (R::one() - v));
    // Not `max` and `min`: on a tie both would give the same one, and a dual number would lose the other's derivative.
    let (large, small) = if a < b { (b, a) } else { (a, b) };
    (large - R::one()) + small
}

/// A point of one of two discs that share their rim, (p, q) from the middle over the radius with q upwards: beyond the rim it is the
/// point of the other disc that lies as far within. The back one is seen from inside too, so that left is right there.
pub(super) fn over_rim<R: Real>(chart: u32, p: R, q: R) -> (u32, R, R) {
    let radius = p.hypot(q);
    if radius <= R::one() {
        return (chart, p, q);
    }
    let shrink = (R::two() - radius) / radius;
    (chart ^ 1, -p * shrink, q * shrink)
}

/// A direction found as if on the front one of two discs, on the disc where it is: the back one looks along -z and is seen from inside too.
pub(super) fn on_disc<R: Real>(chart: u32, Vec3 { x, y, z }: Vec3<R>) -> Vec3<R> {
    if chart == 0 {
        Vec3::new(x, y, z)
    } else {
        Vec3::new(-x, y, -z)
    }
}

/// What lies across the borders of the charts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Borders {
    /// The twelve edges of a cube.
    CubeEdges,
    /// The twenty-four edges of HEALPix's base pixels.
    BasePixelEdges,
    /// Left and right meet at the date line, and each row of texels at a pole meets itself.
    DateLineAndPoles,
    /// Left and right meet at the date line; the texels at a pole reach over many degrees.
    DateLine,
    /// Each side is folded onto itself around its middle.
    FoldedSides,
    /// The rim is one direction.
    OneRim,
    /// The rims of two discs are one circle.
    TwoRims,
    /// Nothing.
    End,
}

impl Borders {
    /// True of a picture of meridians and parallels, whose left and right side are one meridian.
    pub fn is_around(self) -> bool {
        matches!(self, Self::DateLineAndPoles | Self::DateLine)
    }

    /// What lies across a side of a chart, where each side of a chart is one of another.
    pub fn across(self, chart: u32, side: Side) -> Option<Neighbour> {
        match self {
            Self::CubeEdges => Some(cube_face::across(chart, side)),
            Self::BasePixelEdges => Some(healpix::across(chart, side)),
            _ => None,
        }
    }
}

/// Which directions have an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coverage {
    /// Every direction.
    Sphere,
    /// Every direction but this one, whose image is the whole rim; forward picks the rim's rightmost point.
    SphereLessPoint([f64; 3]),
    /// The directions whose cosine with an axis is at least so large; the others share their texels.
    Cap {
        /// Unit vector.
        axis: [f64; 3],
        /// Cosine of the angle from the axis at which the map ends.
        least: f64,
    },
    /// The directions whose cosine with an axis is at most so large, whatever its sign; the others share their texels.
    Band {
        /// Unit vector.
        axis: [f64; 3],
        /// Cosine of the angle from the axis at which the map ends, on both sides.
        most: f64,
    },
}

impl Coverage {
    /// One word for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::SphereLessPoint(_) => "sphere less one point",
            Self::Cap { least: 0.0, .. } => "hemisphere",
            Self::Cap { .. } => "cap",
            Self::Band { .. } => "band",
        }
    }

    /// Whether whole regions have no image of their own, so that a texel may be looked up by directions that are not its own.
    pub const fn has_cut(self) -> bool {
        matches!(self, Self::Cap { .. } | Self::Band { .. })
    }

    /// Solid angle covered, in sr.
    pub fn solid_angle_sr(self) -> f64 {
        use std::f64::consts::PI;
        match self {
            Self::Sphere | Self::SphereLessPoint(_) => 4.0 * PI,
            Self::Cap { least, .. } => 2.0 * PI * (1.0 - least),
            Self::Band { most, .. } => 4.0 * PI * most,
        }
    }

    /// True when `dir` has an image of its own.
    pub fn contains(self, dir: [f64; 3]) -> bool {
        let along = |axis: [f64; 3]| axis[0] * dir[0] + axis[1] * dir[1] + axis[2] * dir[2];
        let length = || dir[0].hypot(dir[1]).hypot(dir[2]);
        match self {
            Self::Sphere => true,
            Self::SphereLessPoint(point) => crate::math::angle_rad(point, dir) > 0.0,
            Self::Cap { axis, least } => along(axis) >= least * length(),
            Self::Band { axis, most } => along(axis).abs() <= most * length(),
        }
    }
}

/// What a mapping promises.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Claims {
    /// Equal solid angle for equal area of the chart.
    pub equal_area: bool,
    /// Angles are kept: Tissot's indicatrix is a circle everywhere.
    pub conformal: bool,
    /// Each seam is divided alike from both sides, so that the coordinate along it agrees.
    pub continuous: bool,
}

/// A direction around which the map is so flat that f32 coordinates cannot tell directions apart.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WeakSpot {
    /// Centre of the zone; with `great_circle` the pole of the circle.
    pub dir: [f64; 3],
    /// The zone surrounds the great circle whose pole is `dir` instead of `dir` itself.
    pub great_circle: bool,
    /// Radius of the zone in radians.
    pub radius_rad: f64,
    /// Largest round-trip error that f32 keeps outside of the zone, in radians.
    pub outside_rad: f64,
    /// Why.
    pub reason: &'static str,
}

impl WeakSpot {
    /// True when the direction lies in the zone.
    pub fn contains(&self, dir: [f64; 3]) -> bool {
        let angle = crate::math::angle_rad(self.dir, dir);
        let distance = if self.great_circle {
            (angle - std::f64::consts::FRAC_PI_2).abs()
        } else {
            angle
        };
        distance < self.radius_rad
    }
}
