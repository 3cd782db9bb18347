//! Every texel shows the direction where it belongs: the source's texels hold their own directions, so a target's texel says
//! where it looked.

use crate::fixtures::*;
use sixfold::imaging::resample::{Conversion, Filter};
use sixfold::imaging::{EnvironmentMap, MapShape, Siting};
use sixfold::mapping::{ChartPoint, Domain, MappingId};
use sixfold::math::{Vec3, angle_rad};

/// What lies around the place at which a texel is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Where {
    /// Four texels of one chart, where the map is smooth.
    Inside,
    /// Beyond the first or the last column: the date line, an edge of a face, a rim.
    Side,
    /// Beyond the first or the last row: a pole, an edge of a face, a rim.
    Cap,
    /// Both: where three faces meet.
    Corner,
    /// Where the map itself is bent or torn, so that light between texels is not between their directions.
    Singular,
}

const EVERYWHERE: [Where; 5] = [
    Where::Inside,
    Where::Side,
    Where::Cap,
    Where::Corner,
    Where::Singular,
];

/// The four texels around a point: the first's column and row, and the rests.
fn around(shape: &MapShape, point: ChartPoint<f64>) -> ([f64; 2], [f64; 2]) {
    let place = [point.u, point.v];
    let place = [0, 1].map(|i| place[i] * f64::from(shape.size[i]) - 0.5);
    (place.map(f64::floor), place.map(|c| c - c.floor()))
}

const FOUR: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

fn place_of(shape: &MapShape, point: ChartPoint<f64>) -> Where {
    let (first, _) = around(shape, point);
    let four = FOUR.map(|step| {
        let c = |i: usize| (first[i] + step[i] + 0.5) / f64::from(shape.size[i]);
        ChartPoint::new(point.chart, c(0), c(1))
    });
    let radius = (2.0 * point.u - 1.0).hypot(2.0 * point.v - 1.0);
    let is_singular = match shape.mapping {
        // The rim is one direction, or seen edge-on: its neighbourhood is flat like a square root.
        MappingId::Sphere | MappingId::Matcap => radius > 0.9,
        // So are the poles.
        MappingId::CylindricalEqualArea => (point.v - 0.5).abs() > 0.4,
        // Around its upper and lower tips the second map is a cone.
        MappingId::OctahedralEqualArea => shape.mapping.continued(point).y.abs() > 0.98,
        _ => false,
    };
    let facet = shape.mapping.facet(point);
    let missing =
        four.map(|p| shape.mapping.inverse(p).is_none() || shape.mapping.facet(p) != facet);
    let out = |i: usize| first[i] < 0.0 || first[i] > f64::from(shape.size[i]) - 2.0;
    match (is_singular, missing.contains(&true), out(0), out(1)) {
        (true, ..) => Where::Singular,
        (false, false, ..) => Where::Inside,
        (_, _, true, true) => Where::Corner,
        (_, _, false, true) => Where::Cap,
        _ => Where::Side,
    }
}

/// The longer side of a texel, as an angle.
fn texel_rad(shape: &MapShape, point: ChartPoint<f64>) -> f64 {
    let inner = |c: f64| c.clamp(0.01, 0.99);
    let point = ChartPoint::new(point.chart, inner(point.u), inner(point.v));
    let (_, jacobian) = shape.mapping.jacobian(point).unwrap_or_else(|| {
        let middle = |c: f64| 0.5 + 0.69 * (c - 0.5);
        shape
            .mapping
            .jacobian(ChartPoint::new(
                point.chart,
                middle(point.u),
                middle(point.v),
            ))
            .unwrap()
    });
    let side = |v: Vec3<f64>, n: u32| v.length() / f64::from(n);
    side(jacobian.du, shape.size[0]).max(side(jacobian.dv, shape.size[1]))
}

fn dirs_of(shape: &MapShape) -> EnvironmentMap {
    map_of(shape, |d| d.map(|c| c as f32))
}

/// Worst error by place, in texels of the source.
type Worst = [f64; 5];

/// Compares what the texels of a target show with where they should look; `shown` tells the first.
fn worst(
    source: &MapShape,
    target: &MapShape,
    rotation: [[f64; 3]; 3],
    shown: impl Fn(u32, [u32; 2], ChartPoint<f64>) -> [f64; 3],
) -> Worst {
    worst_of(source, target, rotation, |_| true, shown)
}

fn worst_of(
    source: &MapShape,
    target: &MapShape,
    rotation: [[f64; 3]; 3],
    takes: impl Fn([u32; 2]) -> bool,
    shown: impl Fn(u32, [u32; 2], ChartPoint<f64>) -> [f64; 3],
) -> Worst {
    let mut worst = [0.0_f64; 5];
    for (chart, texel, dir) in texels(target).filter(|(_, texel, _)| takes(*texel)) {
        let dir = rotated(rotation, dir);
        if !source.mapping.info().coverage.contains(dir) {
            continue;
        }
        let point = source.mapping.forward(Vec3::from_f64(dir)).unwrap();
        let away = angle_rad(shown(chart, texel, point), dir) / texel_rad(source, point);
        let at = place_of(source, point) as usize;
        worst[at] = worst[at].max(away);
    }
    worst
}

fn of_conversion(source: &EnvironmentMap, conversion: &Conversion, meant: &Conversion) -> Worst {
    let (target, _) = run(source, conversion);
    worst(
        source.shape(),
        target.shape(),
        meant.rotation,
        |chart, texel, _| {
            let [x, y, z, _] = target.light(chart, texel).map(f64::from);
            [x, y, z]
        },
    )
}

fn join(into: &mut Worst, other: Worst) {
    for (a, b) in into.iter_mut().zip(other) {
        *a = a.max(b);
    }
}

/// Budgets in texels for charts of `ROWS` rows, inside, at a seam and where the map is singular. Between texels a bilinear
/// lookup cuts the corner of a curved map, so that all but the last fall as 1/rows: at 2048 rows they are an eighth.
const ROWS: u32 = 301;
const BUDGETS: [(MappingId, f64, f64, f64); 11] = [
    (MappingId::Latlong, 1e-3, 1e-3, 0.0),
    (MappingId::Sphere, 8e-3, 0.0, 3.0),
    (MappingId::Matcap, 8e-3, 0.0, 3.0),
    (MappingId::Paraboloid, 1e-3, 1.1e-3, 0.0),
    (MappingId::Cube, 1e-3, 1e-3, 0.0),
    (MappingId::Ccm, 5e-4, 5e-4, 0.0),
    (MappingId::Eac, 5e-4, 7e-4, 0.0),
    (MappingId::Octahedral, 4e-3, 0.0, 0.4),
    (MappingId::OctahedralEqualArea, 1e-2, 0.0, 0.6),
    (MappingId::Angular, 2.5e-3, 1e-3, 0.0),
    (MappingId::CylindricalEqualArea, 2.5e-3, 2e-3, 2.0),
];

#[test]
fn every_texel_is_where_it_belongs() {
    let mut budgets = Budgets::default();
    for (from, inside, seam, singular) in BUDGETS {
        let info = from.info();
        let source = dirs_of(&shape(from, size_of(from, ROWS)));
        let mut worst: Worst = Default::default();
        for (index, &to) in MappingId::ALL.iter().enumerate() {
            let mut conversion = conversion(source.shape(), to, size_of(to, 41), Filter::Bilinear);
            if index % 3 != 0 {
                conversion.rotation = askew();
            }
            join(&mut worst, of_conversion(&source, &conversion, &conversion));
        }
        // Two and a half texels for each of the source's, so that some lie within half a texel of poles and corners; turned by
        // less than a millionth of a texel, so that the general way is gone.
        let [width, height] = source.shape().size;
        let mut close = conversion(
            source.shape(),
            from,
            [width * 5 / 2, height * 5 / 2],
            Filter::Bilinear,
        );
        (close.rotation, close.charts) = (turned(1e-9, Conversion::UNTURNED), 1);
        let (target, _) = run(&source, &close);
        let near_border = |[x, y]: [u32; 2]| {
            let near = |i: u32, n: u32| i < 4 || i + 4 >= n;
            near(x, close.size[0]) || near(y, close.size[1])
        };
        let observed = worst_of(
            &source.shape().clone(),
            target.shape(),
            close.rotation,
            near_border,
            |chart, texel, _| {
                let [x, y, z, _] = target.light(chart, texel).map(f64::from);
                [x, y, z]
            },
        );
        join(&mut worst, observed);
        for place in EVERYWHERE {
            let budget = match place {
                Where::Inside => inside,
                Where::Singular => singular,
                _ => seam,
            };
            let observed = worst[place as usize];
            let is_met = match place {
                Where::Inside => true,
                Where::Singular => singular > 0.0,
                Where::Side => seam > 0.0,
                Where::Cap => seam > 0.0 && info.domain == Domain::Square,
                Where::Corner => seam > 0.0 && info.domain == Domain::Square,
            };
            let what = format!("{from}, {place:?}, texels");
            if is_met && matches!(place, Where::Cap | Where::Corner) {
                budgets.within(&what, observed, budget);
            } else if is_met {
                budgets.hold(&what, observed, budget);
            }
        }
    }
    budgets.check();
}

#[test]
fn what_is_broken_is_noticed() {
    let mut budgets = Budgets::default();
    for from in [
        MappingId::Latlong,
        MappingId::Cube,
        MappingId::Eac,
        MappingId::Paraboloid,
    ] {
        let budget = BUDGETS.iter().find(|row| row.0 == from).unwrap();
        let source_shape = shape(from, size_of(from, ROWS));
        let source = dirs_of(&source_shape);
        let mut meant = conversion(
            &source_shape,
            MappingId::Octahedral,
            [201, 201],
            Filter::Bilinear,
        );
        meant.rotation = askew();

        // Texels beyond a chart are its outermost, as where nobody thought of seams.
        let target = meant.target_shape(&source_shape).unwrap();
        let clamped = worst(&source_shape, &target, meant.rotation, |_, _, point| {
            let (first, rest) = around(&source_shape, point);
            let mut sum = [0.0; 3];
            for step in FOUR {
                let at = |i: usize| {
                    (first[i] + step[i]).clamp(0.0, f64::from(source_shape.size[i] - 1)) as u32
                };
                let part = |i: usize| {
                    if step[i] > 0.0 {
                        rest[i]
                    } else {
                        1.0 - rest[i]
                    }
                };
                let light = source.light(point.chart, [at(0), at(1)]);
                for (sum, light) in sum.iter_mut().zip(light) {
                    *sum += part(0) * part(1) * f64::from(light);
                }
            }
            sum
        });
        budgets.must_break(
            &format!("{from}, clamped at seams"),
            clamped[Where::Side as usize],
            10.0 * budget.2,
        );

        // Samples at the edges instead of the middles.
        let (_, rasters) = source.clone().into_parts();
        let shifted = MapShape {
            siting: Siting::Edge,
            ..source_shape.clone()
        };
        let shifted = EnvironmentMap::new(shifted, rasters).unwrap();
        let observed = of_conversion(&shifted, &meant, &meant);
        budgets.must_break(
            &format!("{from}, shifted by half a texel"),
            observed[0],
            100.0 * budget.1,
        );

        let turn = Conversion {
            rotation: turned(1e-4, meant.rotation),
            ..meant.clone()
        };
        let observed = of_conversion(&source, &turn, &meant);
        budgets.must_break(
            &format!("{from}, turned by 1e-4 rad"),
            observed[0],
            budget.1,
        );
    }
    budgets.check();
}

fn turned(angle: f64, m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let (sin, cos) = angle.sin_cos();
    let [first, second, third] = m;
    [
        std::array::from_fn(|k| cos * first[k] - sin * second[k]),
        std::array::from_fn(|k| sin * first[k] + cos * second[k]),
        third,
    ]
}

/// Both sitings, on both sides, and charts of very few texels: nothing breaks, and edge samples lie where they say.
#[test]
fn sitings_agree() {
    let mut budgets = Budgets::default();
    let mut worst: Worst = Default::default();
    for from in [
        MappingId::Latlong,
        MappingId::Cube,
        MappingId::Ccm,
        MappingId::Paraboloid,
    ] {
        for siting in [Siting::Centre, Siting::Edge] {
            let source_shape = MapShape {
                siting,
                ..shape(from, size_of(from, ROWS))
            };
            let source = dirs_of(&source_shape);
            for to in [MappingId::Eac, MappingId::Latlong, MappingId::Angular] {
                for siting in [Siting::Centre, Siting::Edge] {
                    let mut conversion =
                        conversion(&source_shape, to, size_of(to, 33), Filter::Bilinear);
                    (conversion.rotation, conversion.siting) = (askew(), siting);
                    join(&mut worst, of_conversion(&source, &conversion, &conversion));
                }
            }
        }
    }
    let all = worst.into_iter().fold(0.0, f64::max);
    budgets.hold("centre and edge, both sides, texels", all, 1.1e-3);
    budgets.check();
}

/// What is left at large sizes is single precision: the places of 4096 x 2048 texels.
#[test]
fn places_are_right_at_full_size() {
    let mut budgets = Budgets::default();
    for (from, height) in [(MappingId::Latlong, 1024), (MappingId::Cube, 700)] {
        let source = dirs_of(&shape(from, size_of(from, height)));
        let mut conversion = conversion(
            source.shape(),
            MappingId::Octahedral,
            [101, 101],
            Filter::Bilinear,
        );
        conversion.rotation = askew();
        let observed = of_conversion(&source, &conversion, &conversion);
        let all = observed.into_iter().fold(0.0, f64::max);
        budgets.hold(&format!("{from} of {height} rows, texels"), all, 5e-4);
    }
    budgets.check();
}
