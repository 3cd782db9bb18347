//! Beyond the border: the continued inverse is the inverse on the chart, goes on without a jump, and what it says is found again.

use std::f64::consts::TAU;

use sixfold::mapping::{ChartPoint, Coverage, Domain, MappingId};
use sixfold::math::inputs::Random;
use sixfold::math::{Real, angle_rad};

use crate::inputs::chart_points;
use crate::report::{Finding, Worst};
use crate::subject::Subject;

/// Whether the map ends all around, so that no direction beyond is found there.
pub fn is_cut_all_around(map: MappingId) -> bool {
    matches!(map.info().coverage, Coverage::Cap { .. })
}

/// Whether the rim is one direction or ends what is covered and the formula too, so that nothing lies beyond it.
pub fn ends_at_its_rim(map: MappingId) -> bool {
    matches!(map, MappingId::Sphere | MappingId::Matcap)
}

/// A place that is `beyond` outside the border, inside where that is negative: on a random side, or out along a disc's radius.
fn outside(subject: &Subject, random: &mut Random, beyond: f64) -> ChartPoint<f64> {
    let chart = random.below(subject.info().chart_count());
    if subject.info().domain == Domain::Disc {
        let (sin, cos) = (TAU * random.unit()).sin_cos();
        let radius = 0.5 + beyond;
        return ChartPoint::new(chart, 0.5 + radius * cos, 0.5 + radius * sin);
    }
    let (along, side) = (random.unit(), random.below(4));
    let across = if side < 2 { -beyond } else { 1.0 + beyond };
    match side % 2 {
        0 => ChartPoint::new(chart, across, along),
        _ => ChartPoint::new(chart, along, across),
    }
}

/// (largest difference from length 1, largest way there and back in rad) of places up to half a chart beyond.
fn found_again<R: Real>(subject: &Subject) -> (f64, f64) {
    let mut random = Random::new(51);
    let (mut length, mut back) = (Worst::default(), Worst::default());
    for _ in 0..subject.effort / 16 {
        let beyond = 0.5 * random.unit();
        let p = outside(subject, &mut random, beyond);
        let point = ChartPoint::new(p.chart, R::from_f64(p.u), R::from_f64(p.v));
        let dir = subject.continued(point);
        let given = dir.to_f64();
        length.see((given.iter().map(|c| c * c).sum::<f64>().sqrt() - 1.0).abs());
        // Beyond a cut a direction is found at the cut.
        if subject.is_weak(given) || !subject.info().coverage.contains(given) {
            continue;
        }
        let found = subject.forward(dir).and_then(|p| subject.inverse(p));
        back.see(found.map_or(f64::NAN, |found| angle_rad(found.to_f64(), given)));
    }
    (length.0, back.0)
}

pub fn continued(subject: &Subject) -> Vec<Finding> {
    let info = subject.info();
    let mut differ = 0;
    for point in chart_points::<f64>(52, info.chart_count(), info.domain, subject.effort / 16) {
        let inverse = subject.inverse(point).map(|dir| dir.to_f64());
        differ += u32::from(inverse != Some(subject.continued(point).to_f64()));
    }

    /// The step over the border, and beyond it. What changes with the root of it shows a jump of its root.
    const STEP: f64 = 1e-9;
    let (mut jump, mut moved) = (Worst::default(), Worst::default());
    for i in 0..subject.effort / 16 {
        let (seed, half) = (i as u64, STEP / 2.0);
        let beyond = if i % 2 == 0 {
            0.0
        } else {
            0.4 * Random::new(seed + 1).unit()
        };
        let at = |beyond| {
            subject
                .continued(outside(subject, &mut Random::new(seed), beyond))
                .to_f64()
        };
        jump.see(angle_rad(at(beyond - half), at(beyond + half)));
        moved.see(angle_rad(at(0.0), at(0.01)));
    }
    let (single_length, single) = found_again::<f32>(subject);
    let (double_length, double) = found_again::<f64>(subject);
    let mut findings = vec![
        Finding::new(
            "points on the chart at which the inverse differs",
            f64::from(differ),
            0.0,
        ),
        Finding::new("f32 from length 1", single_length, 2e-7),
        Finding::new("f64 from length 1", double_length, 7e-16),
    ];
    findings.push(match subject.weak_budget() {
        None => Finding::new("f64 jump, rad", jump.0, 1e-8),
        Some(_) => Finding::new("f64 jump where the map is weak, rad", jump.0, 2e-4),
    });
    if !ends_at_its_rim(subject.map) {
        findings.extend([
            Finding::new("f32 there and back, rad", single, 1.5e-6),
            Finding::new("f64 there and back, rad", double, 5e-15),
            // A gutter that repeats the border would stand still.
            Finding::at_least("a hundredth beyond, rad", moved.0, 0.005),
        ]);
    }
    findings
}

/// Largest angle between the inverse and the formula of the part in which a point lies, or of the next part instead.
fn off_its_part(map: MappingId, next: u32) -> f64 {
    let info = map.info();
    let points = chart_points::<f64>(53, info.chart_count(), info.domain, 20_000);
    let angles = points.map(|point| {
        let part = (map.facet(point) + next) % map.facets();
        let inverse = map.inverse(point).map_or([f64::NAN; 3], |dir| dir.to_f64());
        angle_rad(map.extended(part, point).to_f64(), inverse)
    });
    angles.fold(
        0.0,
        |worst, angle| if angle <= worst { worst } else { angle },
    )
}

#[test]
fn within_a_part_its_formula_is_the_inverse() {
    let bent = MappingId::ALL.iter().filter(|map| map.facets() > 1);
    for &map in bent {
        let off = off_its_part(map, 0);
        println!("{map}: {off:e}");
        // Observed: at most 2.9e-16, by the equal-area octahedron.
        assert!(off < 1e-15, "{map}: {off:e}");
        // Control: the next part's formula is another one.
        let other = off_its_part(map, 1);
        assert!(other > 1e-3, "{map}: {other:e}");
    }
}
