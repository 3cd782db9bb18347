//! The metrics against published values, and against what follows from the definitions by hand.

use std::collections::HashMap;
use std::f64::consts::{PI, SQRT_2};
use std::sync::LazyLock;

use sixfold::imaging::Progress;
use sixfold::lab::metrics::{CORNER_BOUND, Metrics, UNBOUNDED, Yardstick, measure};
use sixfold::mapping::{Borders, ChartPoint, MappingId};

static ALL: LazyLock<HashMap<MappingId, Metrics>> = LazyLock::new(|| {
    let measured = MappingId::ALL.iter().map(|&map| {
        let metrics = measure(map, &Progress::new()).expect("nobody cancels");
        (map, metrics)
    });
    measured.collect()
});

fn of(map: &str) -> &'static Metrics {
    &ALL[&MappingId::from_id(map).unwrap_or_else(|| panic!("{map}"))]
}

/// Whether a published number and ours are the same to within `budget`.
fn near(what: &str, observed: f64, published: f64, budget: f64) {
    println!("{what}: {observed:.9}, published {published:.9}");
    let off = (observed - published).abs();
    assert!(
        off <= budget,
        "{what}: {observed} is {off:.1e} from {published}"
    );
}

#[test]
fn exact_values_are_met() {
    let root3 = 3f64.sqrt();
    // Observed: all digits of f64, but 2.6e-8 for a/b = 1, where the axes' difference is the root of a rounding, 4.5e-8 at the sphere map's
    // rim, where u has lost its digits, and the digits that s2metrics.cc prints.
    for (what, observed, exact, budget) in [
        ("gnomonic area", of("cube").area_ratio, 3.0 * root3, 1e-12),
        ("gnomonic a/b", of("cube").anisotropy_max, root3, 1e-12),
        ("gnomonic edges", of("cube").edge_ratio, 1.5 * SQRT_2, 1e-12),
        ("gnomonic diagonals", of("cube").diagonal_ratio, 3.0, 1e-12),
        ("equi-angular area", of("eac").area_ratio, SQRT_2, 1e-12),
        (
            "equi-angular budget",
            of("eac").texel_budget,
            PI / 2.0,
            1e-12,
        ),
        // s2metrics.cc: pi^2/(4 sqrt 2) to pi^2/4; linear 4/(3 sqrt 3) to 4; quadratic 8 sqrt 2/9 to 2.6358.
        (
            "quadratic area",
            of("s2-quadratic").area_ratio,
            2.6358 * 9.0 / (8.0 * SQRT_2),
            4e-5,
        ),
        ("paraboloid area", of("paraboloid").area_ratio, 4.0, 1e-12),
        ("paraboloid a/b", of("paraboloid").anisotropy_max, 1.0, 1e-7),
        ("sphere map area", of("sphere").area_ratio, 1.0, 1e-6),
        (
            "octahedral area",
            of("octahedral").area_ratio,
            3.0 * root3,
            1e-12,
        ),
        (
            "latlong worst texel",
            of("latlong").texel_budget,
            PI / 2.0,
            1e-12,
        ),
        (
            "matcap, two directions in one texel",
            of("matcap").anisotropy_mean,
            2.0,
            1e-6,
        ),
    ] {
        near(what, observed, exact, budget);
    }
    // Control: another's number is not met.
    assert!((of("unicube").area_ratio - of("algebraic").area_ratio).abs() > 0.05);
}

/// The head of s2coords.h: largest area, edge and diagonal ratios of cells of one level, found on a sample of cells.
#[test]
fn the_numbers_of_s2_are_met_to_within_its_sampling() {
    let rows = [
        ("cube", [5.200, 2.117, 2.959]),
        ("eac", [1.414, 1.414, 1.704]),
        ("s2-quadratic", [2.082, 1.802, 1.932]),
    ];
    let ours = |map: &str| {
        let found = of(map);
        [found.area_ratio, found.edge_ratio, found.diagonal_ratio]
    };
    // Cells have a size, so their ratios stay below the limits that are ours. Observed: up to 1.63 %, the diagonals of `eac`.
    const SAMPLED: f64 = 0.017;
    for (map, published) in rows {
        for (ours, published) in ours(map).into_iter().zip(published) {
            println!("{map}: {ours:.4}, published {published}");
            assert!(
                (ours / published - 1.0).abs() < SAMPLED,
                "{map}: {ours} {published}"
            );
        }
    }
    // Control: another row does not fit.
    let off = ours("cube")
        .into_iter()
        .zip(rows[1].1)
        .map(|(a, b)| (a / b - 1.0).abs());
    assert!(off.fold(0.0, f64::max) > 10.0 * SAMPLED);
}

/// Name; D_A's rms; a/b mean and max; omega mean; worst linear, on 256 x 256 midpoints a face.
type Second = (&'static str, f64, f64, f64, Option<f64>, Option<f64>);

/// A second computation of the same means, by midpoints and differences.
const SECOND: [Second; 15] = [
    ("cube", 0.464, 1.281, 1.728, Some(13.7), Some(1.382)),
    ("eac", 0.089, 1.234, 1.725, Some(11.6), Some(1.251)),
    ("s2-quadratic", 0.173, 1.256, 1.726, Some(12.8), Some(1.192)),
    ("tangent", 0.041, 1.290, 1.724, Some(13.9), Some(1.401)),
    ("everitt", 0.053, 1.298, 1.851, Some(14.3), Some(1.444)),
    ("algebraic", 0.044, 1.271, 1.724, None, Some(1.396)),
    ("unicube", 0.038, 1.288, 1.724, None, Some(1.440)),
    ("nowell", 0.034, 1.235, 1.722, Some(11.5), Some(1.377)),
    ("outerra", 0.297, 1.078, 1.717, Some(4.1), Some(1.145)),
    ("cobe", 0.002, 1.253, 1.720, Some(12.3), Some(1.319)),
    ("arvo", 0.0, 1.259, 1.895, Some(12.5), Some(1.377)),
    ("qsc", 0.0, 1.328, 1.545, Some(16.0), Some(1.243)),
    ("ccm", 0.183, 1.179, 1.724, Some(9.1), Some(1.203)),
    ("octahedral", 0.478, 1.792, 2.595, Some(32.1), Some(1.6926)),
    (
        "octahedral-equal-area",
        0.0,
        2.043,
        2.961,
        Some(39.0),
        Some(1.7208),
    ),
];

/// How far ours are from a row: means in units of its last digit, extremes relative.
fn apart(ours: &Metrics, second: &Second) -> (f64, f64) {
    let (_, rms, mean, max, omega, linear) = *second;
    let mut means = vec![
        (ours.area_rms - rms) / 1e-3,
        (ours.anisotropy_mean - mean) / 1e-3,
    ];
    means.extend(omega.map(|omega| (ours.omega_mean_deg - omega) / 0.1));
    let mut extremes = vec![ours.anisotropy_max / max - 1.0];
    extremes.extend(linear.map(|linear| ours.worst_linear / linear - 1.0));
    let worst = |values: Vec<f64>| values.into_iter().map(f64::abs).fold(0.0, f64::max);
    (worst(means), worst(extremes))
}

#[test]
fn a_second_computation_agrees_but_for_what_it_leaves_out() {
    for second in &SECOND {
        let (means, extremes) = apart(of(second.0), second);
        println!(
            "{}: means {means:.2} of the last digit, extremes {extremes:.4}",
            second.0
        );
        // Half a unit is its rounding; the rest is its grid. Observed: at most 2.9 units (`qsc`, whose diagonals it runs along).
        assert!(means < 3.5, "{}: {means}", second.0);
        // Its points end half a texel before borders and bends, where the extremes lie. Observed: at most 1.3 %.
        assert!(extremes < 0.015, "{}: {extremes}", second.0);
    }
    // Control: rows of others do not fit.
    let mistaken = SECOND.iter().zip(SECOND.iter().cycle().skip(1));
    let close = mistaken.filter(|(row, other)| apart(of(row.0), other).0 < 3.5);
    assert_eq!(close.count(), 0);
}

#[test]
fn what_is_differentiable_at_a_corner_is_no_rounder_than_the_bound_there() {
    assert!((CORNER_BOUND - 60f64.to_radians().tan()).abs() < 1e-15);
    for &map in MappingId::ALL {
        let info = map.info();
        if info.borders != Borders::CubeEdges {
            continue;
        }
        let found = of(info.id).anisotropy_max;
        if map.facets() == 1 {
            assert!(found > CORNER_BOUND - 1e-9, "{map}: {found}");
            // At the corner itself, not only somewhere.
            let corner = ChartPoint::new(0, 1e-9, 1e-9);
            let there = Yardstick::new(map).at(corner).unwrap().anisotropy;
            assert!(there > CORNER_BOUND - 1e-6, "{map}: {there}");
        } else {
            // Control: bent along the diagonal, it has no derivative at the corner and stays below.
            assert!(found < 0.95 * CORNER_BOUND, "{map}: {found}");
        }
    }
}

#[test]
fn texels_sum_to_what_is_covered() {
    for metrics in ALL.values() {
        let covered = metrics.mapping.info().coverage.solid_angle_sr();
        let off = (metrics.solid_angle_sum_sr - covered).abs();
        // Observed: at most 5.3e-13; 1.4e-11 around matcap's rim, where a solid angle is unbounded.
        let budget = if metrics.mapping == MappingId::Matcap {
            3e-11
        } else {
            1e-12
        };
        assert!(off < budget, "{}: {off:.1e}", metrics.mapping);
    }
}

#[test]
fn claims_are_what_is_measured() {
    for metrics in ALL.values() {
        let map = metrics.mapping;
        // At the sphere map's rim the digits of u run out.
        assert_eq!(metrics.area_ratio < 1.0 + 1e-6, metrics.equal_area, "{map}");
        assert_eq!(
            metrics.anisotropy_max < 1.0 + 1e-6,
            metrics.conformal,
            "{map}"
        );
        assert!(
            metrics.area_ratio > 1.0 - 1e-6 && metrics.anisotropy_mean > 1.0 - 1e-9,
            "{map}"
        );
        assert!(
            metrics.omega_mean_deg <= metrics.omega_max_deg + 1e-9,
            "{map}"
        );
    }
}

#[test]
fn what_grows_without_bound_is_said_so() {
    let unbounded = |map: &str| of(map).anisotropy_max.is_infinite();
    for map in [
        "latlong",
        "sphere",
        "matcap",
        "angular",
        "cylindrical-equal-area",
    ] {
        assert!(unbounded(map), "{map}");
    }
    for map in [
        "cube",
        "paraboloid",
        "octahedral",
        "octahedral-equal-area",
        "qsc",
    ] {
        assert!(!unbounded(map), "{map}");
    }
    let text = serde_json::to_string(of("latlong")).unwrap();
    assert!(
        text.contains(&format!("\"anisotropy_max\":\"{UNBOUNDED}\"")),
        "{text}"
    );
}

#[test]
fn a_cancelled_measurement_gives_nothing() {
    let progress = Progress::new();
    progress.cancel();
    assert_eq!(measure(MappingId::Cube, &progress), None);
}
