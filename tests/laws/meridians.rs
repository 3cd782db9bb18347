//! Columns that are meridians: what the shortcuts for whole rows say against the mapping's own f64.

use std::f64::consts::{PI, TAU};

use sixfold::mapping::{AngleLanes, ChartPoint, LANES, Lane, MappingId, PointLanes, cube_face};
use sixfold::math::Vec3;

const ROWS: u32 = 33;

/// Angles are rounded to f32 in parts of an eighth of a turn: 2^-4 ulp there is 3.7e-9; the arctangent's 7.5e-8 rad are 1.2e-8 turns.
/// Observed: 1.5e-8.
const WORST_TURNS: f64 = 2.5e-8;

fn middle(index: u32, count: u32) -> f64 {
    (f64::from(index) + 0.5) / f64::from(count)
}

fn dir(mapping: MappingId, chart: u32, column: u32, row: u32) -> Vec3<f64> {
    let (u, v) = (middle(column, LANES as u32), middle(row, ROWS));
    mapping.inverse(ChartPoint::new(chart, u, v)).unwrap()
}

/// How far apart the longitudes of a column lie, in turns; the most of all columns.
fn longitude_spread(mapping: MappingId, chart: u32) -> f64 {
    let longitude = |column, row| {
        let dir = dir(mapping, chart, column, row);
        dir.x.atan2(dir.z) / TAU
    };
    let spread = |column| {
        let first = longitude(column, ROWS / 2);
        (0..ROWS)
            .map(|row| longitude(column, row) - first)
            .map(|apart| (apart - apart.round()).abs())
            .fold(0.0, f64::max)
    };
    (0..LANES as u32).map(spread).fold(0.0, f64::max)
}

fn latitudes(mapping: MappingId, row: u32) -> AngleLanes {
    let mut columns: [Lane; 4] = [[0.0; LANES]; 4];
    for k in 0..LANES {
        let line = mapping.line(0, middle(k as u32, LANES as u32));
        for (lane, number) in columns.iter_mut().zip(line) {
            lane[k] = number;
        }
    }
    let mut latitudes = AngleLanes::default();
    let columns = [&columns[0], &columns[1], &columns[2], &columns[3]];
    mapping.latitude_lanes(columns, mapping.line(1, middle(row, ROWS)), &mut latitudes);
    latitudes
}

#[test]
fn columns_are_meridians_exactly_where_it_is_said() {
    let mut found = 0;
    for &mapping in MappingId::ALL.iter().filter(|mapping| mapping.has_lanes()) {
        for chart in 0..mapping.info().chart_count() {
            let spread = longitude_spread(mapping, chart);
            if mapping.has_meridians(chart) {
                found += 1;
                assert!(spread < 1e-14, "{mapping} {chart}: {spread}");
            } else {
                assert!(spread > 1e-3, "{mapping} {chart}: {spread}");
            }
        }
    }
    // Latlong, two sides of ccm, four sides each of cube and eac, of five more that divide both axes alike, and of arvo.
    assert_eq!(found, 1 + 2 + 4 * 8);
}

#[test]
fn latitudes_of_rows_are_those_of_directions() {
    let (mut worst, mut control) = (0.0_f64, 0.0_f64);
    for &mapping in MappingId::ALL {
        for chart in (0..mapping.info().chart_count()).filter(|chart| mapping.has_meridians(*chart))
        {
            for row in 0..ROWS {
                let found = latitudes(mapping, row);
                for k in 0..LANES {
                    let dir = dir(mapping, chart, k as u32, row);
                    let exact = dir.y.atan2(dir.x.hypot(dir.z)) / TAU;
                    let (base, rest) = (f64::from(found.base), f64::from(found.rest[k]));
                    assert!(base * 8.0 == (base * 8.0).round() && rest.abs() < 0.1251);
                    worst = worst.max((base + rest - exact).abs());
                    control = control.max((base - rest - exact).abs());
                }
            }
        }
    }
    assert!(worst < WORST_TURNS && worst > WORST_TURNS / 4.0, "{worst}");
    assert!(control > 0.1, "{control}");
}

#[test]
fn rows_are_parallels_where_it_is_said() {
    let mut found = 0;
    for &mapping in MappingId::ALL {
        let Some([equator, slope]) = mapping.parallels() else {
            continue;
        };
        found += 1;
        let (mut worst, mut control) = (0.0_f64, 0.0_f64);
        for row in 0..ROWS {
            let latitudes = latitudes(mapping, row);
            for k in 0..LANES {
                let exact = mapping.forward(dir(mapping, 0, k as u32, row)).unwrap();
                let latitude = f64::from(latitudes.base) + f64::from(latitudes.rest[k]);
                let v = f64::from(equator) + f64::from(slope) * latitude;
                worst = worst.max((v - exact.v).abs());
                control = control.max((1.0 - v - exact.v).abs());
            }
        }
        // Observed: 7.4e-9, half an ulp of 1/8 in f32, twice.
        assert!(worst < 1.5e-8 && worst > 1e-9, "{mapping}: {worst}");
        assert!(control > 0.4, "{control}");
    }
    assert_eq!(found, 1);
}

/// Chart points where a parallel meets meridians, against the mapping's own f64: worst error of a coordinate.
fn graticule_error(mapping: MappingId, row: u32) -> f64 {
    let angles = |k: u32| (middle(k, LANES as u32) - 0.5) * TAU;
    let latitude = (0.5 - middle(row, ROWS)) * PI;
    let (mut charts, mut columns) = ([0; LANES], [[0.0; LANES]; 4]);
    for k in 0..LANES {
        let (x, z) = angles(k as u32).sin_cos();
        let (chart, numbers) = cube_face::meridian([x, z]);
        charts[k] = chart;
        for (lane, number) in columns.iter_mut().zip(numbers) {
            lane[k] = number;
        }
    }
    let (y, radius) = latitude.sin_cos();
    let mut points = PointLanes::default();
    let columns = [&columns[0], &columns[1], &columns[2], &columns[3]];
    let parallel = cube_face::parallel([radius, y]);
    mapping.graticule_lanes((&charts, columns), parallel, &mut points);
    let base = f64::from(points.base.unwrap());
    (0..LANES)
        .map(|k| {
            let (x, z) = angles(k as u32).sin_cos();
            let exact = mapping
                .forward(Vec3::new(radius * x, y, radius * z))
                .unwrap();
            assert_eq!(points.chart[k], exact.chart, "{mapping} {row} {k}");
            let [u, v] = [points.rest_u[k], points.rest_v[k]].map(|rest| base + f64::from(rest));
            (u - exact.u).abs().max((v - exact.v).abs())
        })
        .fold(0.0, f64::max)
}

#[test]
fn a_graticule_lies_where_its_directions_do() {
    let mut found = 0;
    for &mapping in MappingId::ALL.iter().filter(|mapping| mapping.has_faces()) {
        found += 1;
        let worst = (0..ROWS)
            .map(|row| graticule_error(mapping, row))
            .fold(0.0, f64::max);
        println!("{mapping}: {worst:.2e}, at most 2e-7");
        assert!(worst < 2e-7 && worst > 2e-8, "{mapping}: {worst}");
    }
    // The cube family but for qsc, which is bent.
    assert_eq!(found, 12);
}

#[test]
fn what_is_folded_lies_where_its_direction_does() {
    let beyond = [-0.4, -0.01, 0.2, 0.7, 1.02, 1.4];
    let (mut worst, mut control) = (0.0_f64, 0.0_f64);
    for (u, v) in beyond.iter().flat_map(|u| beyond.map(|v| (*u, v))) {
        let mapping = MappingId::Latlong;
        let point = ChartPoint::new(0, u, v);
        let folded: ChartPoint<f64> = mapping.folded(0, point).unwrap();
        let exact = mapping.forward(mapping.extended(0, point)).unwrap();
        let apart = |u: f64| {
            (u - exact.u - (u - exact.u).round())
                .abs()
                .max((folded.v - exact.v).abs())
        };
        worst = worst.max(apart(folded.u));
        control = control.max(apart(folded.u + 0.5));
    }
    assert!(worst < 1e-15, "{worst}");
    assert!(control > 0.4, "{control}");
}
