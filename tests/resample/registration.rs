//! Every texel shows the direction where it belongs: the source's texels hold their own directions, so a target's texel says
//! where it looked.

use crate::fixtures::*;
use sixfold::imaging::resample::{Conversion, Filter};
use sixfold::imaging::{EnvironmentMap, MapShape, Siting};
use sixfold::mapping::{ChartPoint, MappingId};
use sixfold::math::{Vec3, angle_rad};

/// What lies around the place at which a texel is looked up.
#[derive(Clone, Copy, Debug)]
enum Where {
    /// Four texels of one part of a chart.
    Inside,
    /// Texels beyond a chart's border, a rim, a pole, a corner where three faces meet, an edge of the octahedron.
    Seam,
    /// Where the map itself is torn or flat, so that what lies between texels is not between their directions.
    Singular,
}

/// The four texels around a point: the first's column and row, and the rests.
fn around(shape: &MapShape, point: ChartPoint<f64>) -> ([f64; 2], [f64; 2]) {
    let place = [point.u, point.v];
    let place = [0, 1].map(|i| place[i] * f64::from(shape.size[i]) - 0.5);
    (place.map(f64::floor), place.map(|c| c - c.floor()))
}

const FOUR: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];

fn place_of(shape: &MapShape, point: ChartPoint<f64>) -> Where {
    let (first, _) = around(shape, point);
    let radius = (2.0 * point.u - 1.0).hypot(2.0 * point.v - 1.0);
    let is_singular = match shape.mapping {
        // Near the rim directions move like the square root of the distance from it.
        MappingId::Sphere | MappingId::Matcap => radius > 0.8,
        // So they do near the poles.
        MappingId::CylindricalEqualArea => (point.v - 0.5).abs() > 0.4,
        // Around its upper and lower tips the map is a cone.
        MappingId::OctahedralEqualArea => shape.mapping.continued(point).y.abs() > 0.9,
        _ => false,
    };
    let facet = shape.mapping.facet(point);
    let is_own = |step: [f64; 2]| {
        let texel = texel(shape, point.chart, first, step);
        shape.mapping.inverse(texel).is_some() && shape.mapping.facet(texel) == facet
    };
    match (is_singular, FOUR.into_iter().all(is_own)) {
        (true, _) => Where::Singular,
        (_, true) => Where::Inside,
        _ => Where::Seam,
    }
}

fn texel(shape: &MapShape, chart: u32, first: [f64; 2], step: [f64; 2]) -> ChartPoint<f64> {
    let c = |i: usize| (first[i] + step[i] + 0.5) / f64::from(shape.size[i]);
    ChartPoint::new(chart, c(0), c(1))
}

/// The longest side of the quadrangle between the four texels around a point, as an angle.
fn texel_rad(shape: &MapShape, point: ChartPoint<f64>) -> f64 {
    let (first, _) = around(shape, point);
    let facet = shape.mapping.facet(point);
    let dirs = FOUR.map(|step| {
        let texel = texel(shape, point.chart, first, step);
        shape.mapping.extended(facet, texel).to_f64()
    });
    [(0, 1), (0, 2), (1, 3), (2, 3)]
        .into_iter()
        .fold(0.0, |side, (a, b)| angle_rad(dirs[a], dirs[b]).max(side))
}

fn dirs_of(shape: &MapShape) -> EnvironmentMap {
    map_of(shape, |d| d.map(|c| c as f32))
}

/// Worst error inside, at seams and at singular places, in texels of the source.
type Worst = [f64; 3];

/// Compares what the texels of a target show with what they should: `shown` tells the first, `meant` the second, of a point of
/// the source and its direction.
fn worst(
    source: &MapShape,
    target: &MapShape,
    rotation: [[f64; 3]; 3],
    shown: impl Fn(u32, [u32; 2], ChartPoint<f64>) -> Option<Dir>,
    meant: impl Fn(ChartPoint<f64>, Dir) -> Dir,
) -> Worst {
    let mut worst = [0.0_f64; 3];
    for (chart, texel, dir) in texels(target) {
        let dir = rotated(rotation, dir);
        if !source.mapping.info().coverage.contains(dir) {
            continue;
        }
        let point = source.mapping.forward(Vec3::from_f64(dir)).unwrap();
        let Some(shown) = shown(chart, texel, point) else {
            continue;
        };
        let away = angle_rad(shown, meant(point, dir)) / texel_rad(source, point);
        let at = place_of(source, point) as usize;
        worst[at] = worst[at].max(away);
    }
    worst
}

fn light(map: &EnvironmentMap, chart: u32, texel: [u32; 2]) -> Dir {
    let [x, y, z, _] = map.light(chart, texel).map(f64::from);
    [x, y, z]
}

/// Errors of the directions that a conversion shows.
fn of_conversion(source: &EnvironmentMap, conversion: &Conversion, meant: &Conversion) -> Worst {
    let (target, _) = run(source, conversion);
    worst(
        source.shape(),
        target.shape(),
        meant.rotation,
        |chart, texel, _| Some(light(&target, chart, texel)),
        |_, dir| dir,
    )
}

/// The mean of the four texels around a point by their distances.
fn between(
    shape: &MapShape,
    point: ChartPoint<f64>,
    texel_light: impl Fn(ChartPoint<f64>, [f64; 2]) -> Dir,
) -> Dir {
    let (first, rest) = around(shape, point);
    let mut sum = [0.0; 3];
    for step in FOUR {
        let part = |i: usize| {
            if step[i] > 0.0 {
                rest[i]
            } else {
                1.0 - rest[i]
            }
        };
        let at = [first[0] + step[0], first[1] + step[1]];
        let light = texel_light(texel(shape, point.chart, first, step), at);
        for (sum, light) in sum.iter_mut().zip(light) {
            *sum += part(0) * part(1) * light;
        }
    }
    sum
}

/// What lies exactly at a point between four texels that hold their own directions; beyond a border, those of the part going on.
fn exactly_between(shape: &MapShape, point: ChartPoint<f64>) -> Dir {
    let facet = shape.mapping.facet(point);
    between(shape, point, |texel, _| {
        shape.mapping.extended(facet, texel).to_f64()
    })
}

fn join(into: &mut Worst, other: Worst) {
    for (a, b) in into.iter_mut().zip(other) {
        *a = a.max(b);
    }
}

/// What is promised of maps of one mapping, in texels; 0 where no such place is.
struct Promise {
    from: MappingId,
    /// How far a texel shows from what lies at its place between exact texels, in charts of [`ROWS`] rows: at seams, and at
    /// singular places. A texel beyond a border is found between others, so that at seams this falls as 1/rows.
    seam: f64,
    singular: f64,
    /// Rows at which the direction that it shows is right to [`DIRECTION`]: between texels a straight line cuts the corner of a
    /// curved map, by what falls as 1/rows.
    rows: u32,
    /// How far from the right direction at singular places, where no number of rows helps.
    flat: f64,
}

const ROWS: u32 = 301;

/// A thousandth of a texel is what the field's best converters reach inside of cube faces.
const DIRECTION: f64 = 1e-3;

/// Inside, where only rounding is left.
const INSIDE: f64 = 1e-4;

const PROMISES: [Promise; 11] = {
    const fn promise(from: MappingId, seam: f64, rows: u32) -> Promise {
        Promise {
            from,
            seam,
            singular: 0.0,
            rows,
            flat: 0.0,
        }
    }
    [
        promise(MappingId::Latlong, 1e-5, 301),
        // At the rim the direction turns by the square root of the distance: of the last texel's turn a quarter cannot be told.
        Promise {
            singular: 0.3,
            flat: 0.25,
            ..promise(MappingId::Sphere, 0.0, 1201)
        },
        // What lies beyond the rim is what lies before it: light turns back there, and no texel holds the rim's own.
        Promise {
            singular: 1.0,
            flat: 3.5,
            ..promise(MappingId::Matcap, 0.0, 1001)
        },
        promise(MappingId::Paraboloid, 1e-3, 401),
        promise(MappingId::Cube, 5e-4, 301),
        promise(MappingId::Ccm, 5e-4, 301),
        promise(MappingId::Eac, 5e-4, 301),
        promise(MappingId::Octahedral, 1e-3, 901),
        Promise {
            singular: 1e-5,
            flat: 0.1,
            ..promise(MappingId::OctahedralEqualArea, 1e-3, 1201)
        },
        promise(MappingId::Angular, 1e-3, 701),
        Promise {
            singular: 1e-5,
            flat: 0.15,
            ..promise(MappingId::CylindricalEqualArea, 1e-5, 701)
        },
    ]
};

/// Every texel shows what lies at its place, to a thousandth of a texel: at poles, date lines, edges, corners and rims, too.
#[test]
fn every_texel_is_looked_up_where_it_belongs() {
    let mut budgets = Budgets::default();
    for promise in PROMISES {
        let source = dirs_of(&shape(promise.from, size_of(promise.from, ROWS)));
        let source_shape = source.shape();
        let [width, height] = source_shape.size;
        // Two and a half texels for each of the source's, so that some lie within half a texel of everything; turned by
        // less than a millionth of a texel, so that no short way is taken. And another mapping, turned.
        let fine = [width * 5 / 2, height * 5 / 2];
        let mut close = conversion(source_shape, promise.from, fine, Filter::Bilinear);
        (close.rotation, close.charts) = (turned(1e-9, Conversion::UNTURNED), 1);
        let mut other = conversion(source_shape, MappingId::Eac, [101; 2], Filter::Bilinear);
        other.rotation = askew();
        let mut observed: Worst = Default::default();
        for conversion in [close, other] {
            let (target, _) = run(&source, &conversion);
            // All near the border, an eighth of the others.
            let takes = |[x, y]: [u32; 2]| {
                let near = |i: u32, n: u32| i < 4 || i + 4 >= n;
                near(x, conversion.size[0]) || near(y, conversion.size[1]) || (x + 3 * y) % 8 == 0
            };
            let shown = |chart, texel, _| takes(texel).then(|| light(&target, chart, texel));
            let meant = |point, _| exactly_between(source_shape, point);
            join(
                &mut observed,
                worst(
                    source_shape,
                    target.shape(),
                    conversion.rotation,
                    shown,
                    meant,
                ),
            );
        }
        let from = promise.from;
        budgets.within(&format!("{from}, inside, texels"), observed[0], INSIDE);
        if promise.seam > 0.0 {
            budgets.hold(&format!("{from}, at seams"), observed[1], promise.seam);
        }
        if promise.singular > 0.0 {
            budgets.hold(&format!("{from}, singular"), observed[2], promise.singular);
        }
        assert!(promise.seam > 0.0 || observed[1] == 0.0);
    }
    budgets.check();
}

/// What is seen there is the right direction.
#[test]
fn every_texel_shows_its_direction() {
    let mut budgets = Budgets::default();
    for promise in PROMISES {
        let from = promise.from;
        let source = dirs_of(&shape(from, size_of(from, promise.rows)));
        let mut observed: Worst = Default::default();
        let targets = [MappingId::Cube, MappingId::Angular, MappingId::Octahedral];
        for (index, to) in targets.into_iter().enumerate() {
            let mut conversion = conversion(source.shape(), to, size_of(to, 61), Filter::Bilinear);
            if index > 0 {
                conversion.rotation = askew();
            }
            join(
                &mut observed,
                of_conversion(&source, &conversion, &conversion),
            );
        }
        let [inside, seam, singular] = observed;
        let what = format!("{from} of {} rows", promise.rows);
        budgets.hold(&format!("{what}, inside, texels"), inside, DIRECTION);
        budgets.within(&format!("{what}, at seams"), seam, DIRECTION);
        if promise.flat > 0.0 {
            budgets.hold(&format!("{what}, singular"), singular, promise.flat);
        } else {
            assert_eq!(singular, 0.0);
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
        MappingId::Octahedral,
        MappingId::OctahedralEqualArea,
    ] {
        let source_shape = shape(from, size_of(from, ROWS));
        let source = dirs_of(&source_shape);
        let mut meant = conversion(
            &source_shape,
            MappingId::Octahedral,
            [201, 201],
            Filter::Bilinear,
        );
        meant.rotation = askew();

        // Texels beyond a chart are its outermost, as where nobody thought of seams; and an octahedron's edges are none.
        let target = meant.target_shape(&source_shape).unwrap();
        let clamped = |_, _, point: ChartPoint<f64>| {
            Some(between(&source_shape, point, |_, at| {
                let at = [0, 1].map(|i| {
                    let last = f64::from(source_shape.size[i] - 1);
                    at[i].clamp(0.0, last) as u32
                });
                light(&source, point.chart, at)
            }))
        };
        let exact = |point, _| exactly_between(&source_shape, point);
        let observed = worst(&source_shape, &target, meant.rotation, clamped, exact);
        budgets.must_break(
            &format!("{from}, clamped at seams"),
            observed[1],
            100.0 * DIRECTION,
        );
        let observed = worst(&source_shape, &target, meant.rotation, clamped, |_, dir| {
            dir
        });
        budgets.must_break(
            &format!("{from}, clamped at seams, direction"),
            observed[1],
            100.0 * DIRECTION,
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
            100.0 * DIRECTION,
        );

        // A hundredth of a texel, and a thousandth of the promise more.
        for (angle, budget) in [(3e-4, 5.0 * DIRECTION), (3e-6, INSIDE)] {
            let turn = Conversion {
                rotation: turned(angle, meant.rotation),
                ..meant.clone()
            };
            let (target, _) = run(&source, &turn);
            let shown = |chart, texel, _| Some(light(&target, chart, texel));
            let observed = worst(&source_shape, target.shape(), meant.rotation, shown, exact);
            budgets.must_break(
                &format!("{from}, turned by {angle:.0e} rad"),
                observed[0],
                budget,
            );
        }
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
                ..shape(from, size_of(from, 401))
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
    budgets.hold("centre and edge, both sides, texels", all, 1e-3);
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
