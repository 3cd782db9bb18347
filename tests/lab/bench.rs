//! Measurements: every evaluator once in every way, speed never without error, the front real.

use std::time::Duration;

use sixfold::imaging::Progress;
use sixfold::lab::bench::{Plan, Row, Way, bench, mark_front};
use sixfold::lab::clock::Clock;
use sixfold::lab::inputs::Inputs;
use sixfold::lab::report;
use sixfold::lab::scatter::scatter;
use sixfold::mapping::{MappingId, NoDevice};
use sixfold::math::Isa;

fn plan() -> Plan {
    Plan {
        maps: vec![MappingId::Ccm, MappingId::Cube],
        inputs: vec![Inputs::Random, Inputs::Adversarial],
        few: 256,
        many: 1 << 15,
        judged: 2000,
        clock: Clock {
            samples: 2,
            shortest: Duration::from_micros(1),
        },
        ..Plan::full()
    }
}

const NO_DEVICE: NoDevice = NoDevice("a test of the processor");

/// The rows of the processor.
fn measured(plan: &Plan) -> Vec<Row> {
    bench(plan, &NO_DEVICE, &Progress::new()).rows
}

#[test]
fn every_evaluator_is_measured_in_every_way_it_has() {
    let rows = measured(&plan());
    for map in &plan().maps {
        for evaluator in map.evaluators() {
            for inputs in [Inputs::Random, Inputs::Adversarial] {
                for (way, isa) in [Way::Forward, Way::Inverse]
                    .into_iter()
                    .flat_map(|way| Isa::ALL.map(|isa| (way, isa)))
                {
                    let of = |row: &&Row| {
                        (
                            row.mapping,
                            row.evaluator,
                            row.direction,
                            row.inputs,
                            row.isa,
                        ) == (map.info().id, evaluator.id, way, inputs, isa.id())
                            && row.ns_latency.is_some()
                    };
                    let has_way = way == Way::Forward || evaluator.has_inverse();
                    let has_isa = evaluator.processor().is_some_and(|own| {
                        isa <= Isa::best() && (own.is_vector || isa == Isa::Baseline)
                    });
                    let count = rows.iter().filter(of).count();
                    assert_eq!(
                        count,
                        usize::from(has_way && has_isa),
                        "{map} {} {way:?} {isa:?}",
                        evaluator.id
                    );
                }
            }
        }
    }
    for row in &rows {
        let positive = [
            row.ns,
            row.copy_ratio,
            row.max_error_rad,
            row.rms_error_rad,
            row.max_error_ulp,
            row.max_error_texels,
        ];
        let has_holes = row.holes > 0;
        assert!(
            positive.iter().all(|c| c.is_finite() && *c > 0.0),
            "{row:?}"
        );
        assert!(row.rms_error_rad <= row.max_error_rad);
        assert!(
            !has_holes || (row.evaluator.ends_with("-shader") && !row.on_front),
            "{row:?}"
        );
        assert!(
            row.n
                == if row.ns_latency.is_some() {
                    256
                } else {
                    1 << 15
                }
        );
        // 1024 texels along a face, and an ULP of f32 just below 1.
        assert!(row.max_error_texels < 1024.0 * row.max_error_rad * 1.6);
    }
    // The reference's error is the rounding of its result: half an ULP.
    let reference = rows
        .iter()
        .filter(|r| r.evaluator == "reference" && r.direction == Way::Forward);
    for row in reference {
        assert!((0.4..=0.5).contains(&row.max_error_ulp), "{row:?}");
    }
    front_is_real(&rows);
}

/// Under the same circumstances each row of the front is faster than every one of equal or smaller error.
fn front_is_real(rows: &[Row]) {
    let circumstances = |row: &Row| (row.mapping, row.direction, row.inputs, row.threads, row.n);
    let mut seen = 0;
    for row in rows.iter().filter(|row| row.on_front) {
        seen += 1;
        for other in rows
            .iter()
            .filter(|other| circumstances(other) == circumstances(row))
        {
            let is_nearer = other.max_error_rad < row.max_error_rad && other.holes == 0;
            assert!(!is_nearer || other.ns >= row.ns, "{other:?} beats {row:?}");
        }
    }
    assert!(seen > 8, "{seen}");
    // The nearest of all is always on it.
    let nearest = rows
        .iter()
        .filter(|row| circumstances(row) == circumstances(&rows[0]))
        .min_by(|a, b| a.max_error_rad.total_cmp(&b.max_error_rad));
    let error = nearest.unwrap().max_error_rad;
    let on = rows
        .iter()
        .any(|row| row.on_front && row.max_error_rad == error);
    assert!(on);
}

#[test]
fn a_slower_and_worse_one_leaves_the_front() {
    let mut small = plan();
    small.maps = vec![MappingId::Cube];
    small.inputs = vec![Inputs::Random];
    let mut rows = measured(&small);
    let first = rows.iter().position(|row| row.on_front).unwrap();
    let mut better = rows[first].clone();
    better.ns *= 0.5;
    better.max_error_rad *= 0.5;
    rows.push(better);
    mark_front(&mut rows);
    assert!(!rows[first].on_front && rows.last().unwrap().on_front);
    // One with holes is no answer.
    let last = rows.len() - 1;
    rows[last].holes = 1;
    mark_front(&mut rows);
    assert!(rows[first].on_front && !rows[last].on_front);
}

#[test]
fn reports_hold_every_row() {
    let mut small = plan();
    small.maps = vec![MappingId::Octahedral];
    small.inputs = vec![Inputs::Random];
    let rows = measured(&small);
    let csv = report::csv(&rows).unwrap();
    let json = report::json(&rows).unwrap();
    let parsed: Vec<serde_json::Value> = serde_json::from_str(&json).unwrap();
    assert_eq!(parsed.len(), rows.len());
    assert_eq!(csv.lines().count(), rows.len() + 1);
    let names: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    for line in csv.lines() {
        assert_eq!(line.split(',').count(), names.len(), "{line}");
    }
    let table = report::bench_table(&rows);
    assert!(table.contains("octahedral") && table.contains("lanes") && table.contains('*'));
    let picture = scatter(&rows);
    let svg = picture.svg();
    assert!(svg.contains("octahedral") && svg.matches("<circle").count() >= 4);
    // The front is drawn.
    let rgba = picture.rgba();
    assert!(rgba.chunks_exact(4).any(|p| p[0] > 180 && p[1] < 60));
    assert_eq!(rgba.len() as u32, 4 * picture.size()[0] * picture.size()[1]);
}

#[test]
fn a_cancelled_run_ends_early() {
    let progress = Progress::new();
    progress.cancel();
    assert!(bench(&plan(), &NO_DEVICE, &progress).rows.is_empty());
}
