//! One list of evaluators, each in every set of instructions.

use std::collections::HashSet;

use sixfold::lab::inputs::Inputs;
use sixfold::lab::stress::allowed;
use sixfold::mapping::{ChartPoint, DirList, MappingId, NOWHERE, PointList};
use sixfold::math::{Isa, Vec3, angle_rad};

/// The mappings with an arctangent.
const TRANSCENDENTAL: [MappingId; 5] = [
    MappingId::Ccm,
    MappingId::Latlong,
    MappingId::Eac,
    MappingId::Angular,
    MappingId::OctahedralEqualArea,
];

#[test]
fn every_mapping_has_what_is_to_be_compared() {
    for map in MappingId::ALL {
        let ids: Vec<&str> = map.evaluators().iter().map(|e| e.id).collect();
        let unique: HashSet<&str> = ids.iter().copied().collect();
        assert_eq!(unique.len(), ids.len(), "{map}: {ids:?}");
        assert_eq!(ids[..4], ["f32", "reference", "library", "wgsl"]);
        for evaluator in map.evaluators() {
            assert!(!evaluator.about.is_empty() && !evaluator.source.is_empty());
            assert!(std::ptr::eq(
                map.evaluator(evaluator.id).unwrap(),
                evaluator
            ));
            // The table of budgets knows it.
            assert!(
                allowed(*map, evaluator.id).max_forward_rad > 0.0,
                "{map} {}",
                evaluator.id
            );
        }
    }
    for map in TRANSCENDENTAL {
        for id in [
            "atan-5",
            "atan-7",
            "atan-9",
            "atan-11",
            "atan-13",
            "atan-15",
            "atan-17",
            "hastings-9",
            "hastings-17",
            "rational",
            "pbrt",
            "table-64",
            "table-256",
            "table-1024",
            "table-4096",
            "table-64-cubic",
            "table-4096-cubic",
        ] {
            assert!(map.processor(id).is_some_and(|e| e.is_vector), "{map} {id}");
        }
    }
    for map in [
        MappingId::Cube,
        MappingId::Paraboloid,
        MappingId::Octahedral,
        MappingId::Sphere,
    ] {
        assert!(
            map.processor("lanes")
                .is_some_and(|e| e.is_vector && e.inverse.is_some())
        );
    }
    for id in ["textbook", "paper-shader", "fused-shader", "printed-eq6"] {
        assert!(MappingId::Ccm.evaluator(id).is_some());
    }
    assert!(MappingId::Latlong.evaluator("paper-shader").is_none());
}

/// Directions of every size and kind, a few blocks and a rest.
fn directions(map: MappingId) -> DirList {
    let mut dirs = Vec::new();
    for inputs in Inputs::ALL {
        let list = inputs.directions(map, 700);
        dirs.extend((0..list.len()).map(|k| list.view().at(k).to_array()));
    }
    // One that is none, and two that have to be scaled, each in a block of its own.
    dirs[10] = [0.0, f32::NAN, 1.0];
    dirs[600] = [3e38, -1e38, 2e-38];
    dirs[1300] = [1e-44, 3e-44, -2e-44];
    dirs.into_iter().collect()
}

/// The sets of instructions that this processor has, the narrowest first.
fn sets() -> impl Iterator<Item = Isa> {
    Isa::ALL.into_iter().filter(|isa| *isa <= Isa::best())
}

#[test]
fn instructions_make_no_difference_beyond_the_budget() {
    for map in MappingId::ALL {
        let dirs = directions(*map);
        let processors = map
            .evaluators()
            .iter()
            .filter_map(|e| Some((e, e.processor()?)));
        for (evaluator, processor) in processors.filter(|(_, own)| own.is_vector) {
            let budget = allowed(*map, evaluator.id);
            let found: Vec<PointList> = sets()
                .map(|isa| {
                    let mut points = PointList::zeros(dirs.len());
                    (processor.forward)(isa, dirs.view(), points.view_mut());
                    points
                })
                .collect();
            for pair in found.windows(2) {
                for k in 0..dirs.len() {
                    let [p, q] = [0, 1].map(|i| pair[i].view().at(k));
                    assert_eq!(p.chart == NOWHERE, k == 10, "{map} {}", evaluator.id);
                    assert_eq!(p.chart, q.chart, "{map} {}", evaluator.id);
                    // A seam parts equal directions: there the other end is as good.
                    let step = |a: f32, b: f32| (a - b).abs().min(1.0 - (a - b).abs());
                    let apart = step(p.u, q.u).max(step(p.v, q.v));
                    // Fusing takes away half of the roundings; where the map is flat they are many ULP.
                    let most = if map.info().weak_spots.is_empty() {
                        5e-7
                    } else {
                        3e-6
                    };
                    assert!(
                        apart <= most,
                        "{map} {} {k}: {p:?} {q:?} {budget:?}",
                        evaluator.id
                    );
                }
            }
            // AVX2 and AVX-512 fuse alike, so that they agree to the last bit.
            if let [_, avx2, avx512] = &found[..] {
                assert_eq!(avx2, avx512, "{map} {}", evaluator.id);
            }
        }
    }
}

#[test]
fn one_by_one_and_all_together_are_the_same() {
    for map in [MappingId::Ccm, MappingId::Sphere, MappingId::Matcap] {
        let dirs = directions(map);
        for evaluator in map.evaluators() {
            let Some(processor) = evaluator.processor() else {
                continue;
            };
            let mut points = PointList::zeros(dirs.len());
            (processor.forward)(Isa::best(), dirs.view(), points.view_mut());
            for k in (0..dirs.len()).step_by(37) {
                let together = points.view().at(k);
                let alone = processor.forward_one(dirs.view().at(k));
                let alone = alone.unwrap_or(ChartPoint::new(NOWHERE, 0.0, 0.0));
                let bits = |p: ChartPoint<f32>| (p.chart, p.u.to_bits(), p.v.to_bits());
                assert_eq!(bits(alone), bits(together), "{map} {} {k}", evaluator.id);
            }
        }
    }
}

#[test]
fn points_off_the_chart_have_no_direction() {
    for map in MappingId::ALL {
        let info = map.info();
        let charts = info.chart_count();
        let mut off = vec![(charts, 0.5, 0.5), (NOWHERE, 0.5, 0.5)];
        for bad in [-1e-30, 1.000_000_1, f32::NAN, f32::INFINITY, -2.0] {
            off.extend([(0, bad, 0.5), (0, 0.5, bad)]);
        }
        if info.domain == sixfold::mapping::Domain::Disc {
            off.extend([(0, 0.0, 0.0), (0, 0.95, 0.9)]);
        }
        let processors = map
            .evaluators()
            .iter()
            .filter_map(|e| Some((e, e.processor()?)));
        for (evaluator, processor) in processors.filter(|(_, own)| own.inverse.is_some()) {
            for (chart, u, v) in &off {
                let found = processor.inverse_one(ChartPoint::new(*chart, *u, *v));
                assert!(found.is_none(), "{map} {} {chart} {u} {v}", evaluator.id);
            }
            let middle = processor
                .inverse_one(ChartPoint::new(0, 0.5, 0.625))
                .unwrap();
            let exact = map.inverse(ChartPoint::new(0, 0.5, 0.625)).unwrap();
            let apart = angle_rad(middle.to_f64(), Vec3::<f64>::to_f64(exact));
            let length = middle.to_f64().iter().map(|c| c * c).sum::<f64>().sqrt();
            let most = 2.0 * allowed(*map, evaluator.id).max_round_trip_rad;
            assert!(
                apart <= most && (length - 1.0).abs() <= most,
                "{map} {}",
                evaluator.id
            );
        }
    }
}
