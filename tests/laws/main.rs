//! The laws that every mapping keeps, in one list, run over the registry in f32 and f64.
//!
//! Each law is also run on stand-ins that are broken on purpose and must notice them. Budgets stand beside what is
//! observed (`cargo test --test laws -- --nocapture` prints the table), and one that is ten times too wide fails too.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stdout,
    reason = "tests say what they expect by unwrapping, and what they saw by printing"
)]

mod area;
mod beyond;
mod charts;
mod healpix;
mod inputs;
mod meridians;
mod published;
mod report;
mod round_trip;
mod seams;
mod subject;

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use report::Finding;
use sixfold::mapping::{Domain, MappingId};
use subject::{Fault, Subject};

type Applies = fn(MappingId) -> bool;

/// One law.
struct Law {
    name: &'static str,
    applies: Applies,
    check: fn(&Subject) -> Vec<Finding>,
    /// What it must notice, and on which mappings.
    controls: &'static [(Fault, Applies)],
}

const ALL: Applies = |_| true;
const CUBE_FAMILY: Applies = |map| map.info().chart_count() == 6;
const LATLONG: Applies = |map| map == MappingId::Latlong;
/// Those with a seam: a rim that is one direction, or that bounds the half that is covered, has no other side.
const WITH_SEAMS: Applies =
    |map| map.info().chart_count() > 1 || map.info().domain == Domain::Square;
const CONTINUOUS: Applies = |map| WITH_SEAMS(map) && map.info().claims.continuous;
/// Those whose charts have something beyond their border.
const GOES_ON: Applies = |map| !beyond::ends_at_its_rim(map);
/// Those of which some directions beyond the border are found again.
const IS_FOUND_BEYOND: Applies = |map| GOES_ON(map) && !beyond::is_cut_all_around(map);
const WITH_AREA_CLAIMS: Applies = |map| map.info().claims.equal_area || map.info().claims.conformal;

const LAWS: [Law; 15] = [
    Law {
        name: "direction -> uv -> direction",
        applies: ALL,
        check: round_trip::by_direction,
        controls: &[
            (Fault::SwapUv, ALL),
            (Fault::Mirror, ALL),
            (Fault::Coarse, ALL),
            (Fault::AcosLatitude, LATLONG),
        ],
    },
    Law {
        name: "uv -> direction -> uv",
        applies: ALL,
        check: round_trip::by_chart_point,
        controls: &[
            (Fault::SwapUv, ALL),
            (Fault::Coarse, ALL),
            (Fault::NextChart, ALL),
        ],
    },
    Law {
        name: "each way against f64",
        applies: ALL,
        check: round_trip::against_f64,
        controls: &[
            (Fault::Mirror, ALL),
            (Fault::Tilted, ALL),
            (Fault::Coarse, ALL),
            (Fault::AcosLatitude, LATLONG),
        ],
    },
    Law {
        name: "the inverse is unit",
        applies: ALL,
        check: round_trip::inverse_is_unit,
        controls: &[(Fault::Long, ALL)],
    },
    Law {
        name: "one chart for every direction",
        applies: ALL,
        check: charts::one_chart,
        controls: &[
            (Fault::NextChart, ALL),
            (Fault::Hole, ALL),
            (Fault::TiesToX, CUBE_FAMILY),
        ],
    },
    Law {
        name: "ties",
        applies: ALL,
        check: charts::ties,
        controls: &[
            (Fault::NextChart, ALL),
            (Fault::Hole, ALL),
            (Fault::TiesToX, CUBE_FAMILY),
        ],
    },
    Law {
        name: "u and v in [0, 1]",
        applies: ALL,
        check: charts::in_range,
        controls: &[(Fault::Stretched, ALL), (Fault::Hole, ALL)],
    },
    Law {
        name: "bad input is refused",
        applies: ALL,
        check: charts::refuses,
        controls: &[(Fault::Careless, ALL)],
    },
    Law {
        name: "any length will do",
        applies: ALL,
        check: charts::any_length,
        controls: &[(Fault::Unscaled, ALL), (Fault::SwapUv, ALL)],
    },
    Law {
        name: "dual Jacobian against differences",
        applies: ALL,
        check: area::jacobian,
        controls: &[(Fault::Skewed, ALL)],
    },
    Law {
        name: "solid angles sum to the coverage",
        applies: ALL,
        check: area::solid_angles,
        controls: &[(Fault::Skewed, ALL)],
    },
    Law {
        name: "claims",
        applies: ALL,
        check: area::claims,
        controls: &[
            (Fault::Skewed, WITH_AREA_CLAIMS),
            (Fault::Flat, WITHOUT_AREA_CLAIMS),
        ],
    },
    Law {
        name: "seams are divided alike",
        applies: WITH_SEAMS,
        check: seams::continuous,
        controls: &[
            (Fault::OneSided, CONTINUOUS),
            (Fault::PlainCube, |map| !map.info().claims.continuous),
        ],
    },
    Law {
        name: "texels across a seam are neighbours",
        applies: WITH_SEAMS,
        check: seams::neighbours,
        controls: &[(Fault::SwapUv, WITH_SEAMS)],
    },
    Law {
        name: "beyond the border",
        applies: ALL,
        check: beyond::continued,
        controls: &[
            (Fault::Shifted, ALL),
            (Fault::Long, ALL),
            (Fault::Jumping, ALL),
            (Fault::Mirror, IS_FOUND_BEYOND),
            (Fault::Clamped, GOES_ON),
        ],
    },
];

/// Those for which a flat sheet claims too much.
const WITHOUT_AREA_CLAIMS: Applies =
    |map| !map.info().claims.equal_area || !map.info().claims.conformal;

/// A law, what it is held against, and what came of it.
type Outcome = (usize, Subject, Vec<Finding>);

/// Runs every law on its subjects, on all cores.
fn run(work: Vec<(usize, Subject)>) -> Vec<Outcome> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    std::thread::scope(|scope| {
        for _ in 0..threads.min(work.len()) {
            scope.spawn(|| {
                while let Some(&(law, subject)) = work.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let findings = (LAWS[law].check)(&subject);
                    done.lock().unwrap().push((law, subject, findings));
                }
            });
        }
    });
    let mut outcomes = done.into_inner().unwrap();
    outcomes.sort_by_key(|(law, subject, _)| (*law, subject.map));
    outcomes
}

#[test]
fn every_mapping_keeps_every_law() {
    let subject = |map| Subject {
        map,
        fault: None,
        effort: 1_000_000,
    };
    let laws = LAWS.iter().enumerate();
    let work = laws.flat_map(|(i, law)| {
        let maps = MappingId::ALL.iter().filter(|map| (law.applies)(**map));
        maps.map(move |map| (i, subject(*map)))
    });
    let outcomes = run(work.collect());

    let mut faults = Vec::new();
    for (i, law) in LAWS.iter().enumerate() {
        let rows: Vec<(String, Finding)> = outcomes
            .iter()
            .filter(|(l, ..)| *l == i)
            .flat_map(|(_, s, findings)| findings.iter().map(|f| (s.map.to_string(), f.clone())))
            .collect();
        report::print(law.name, &rows);
        // The worst of all mappings under the same budget.
        let mut worst: BTreeMap<(&str, u64), f64> = BTreeMap::new();
        for (map, finding) in &rows {
            let key = (finding.what, finding.budget.to_bits());
            let entry = worst.entry(key).or_default();
            *entry = entry.max(finding.observed);
            if !finding.holds() {
                faults.push(format!(
                    "{}, {}: {map}: {:.3e} > {:.1e}",
                    law.name, finding.what, finding.observed, finding.budget
                ));
            }
        }
        for ((what, budget), observed) in worst {
            let budget = f64::from_bits(budget);
            // A weak spot is drawn as small as its budget allows.
            let weak = law.name.starts_with("direction") && what.starts_with("f32 outside");
            if observed * if weak { 2.0 } else { 10.0 } < budget {
                faults.push(format!(
                    "{}, {what}: {budget:.1e} is far above {observed:.3e}",
                    law.name
                ));
            }
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn every_law_notices_what_is_broken() {
    let mut work = Vec::new();
    for (i, law) in LAWS.iter().enumerate() {
        assert!(
            !law.controls.is_empty(),
            "{} has no negative control",
            law.name
        );
        for (fault, applies) in law.controls {
            let maps = MappingId::ALL.iter().filter(|map| applies(**map));
            work.extend(maps.map(|map| {
                let subject = Subject {
                    map: *map,
                    fault: Some(*fault),
                    effort: 20_000,
                };
                (i, subject)
            }));
        }
    }
    let outcomes = run(work);
    let mut unnoticed = Vec::new();
    // Whether any stand-in breaks this number of this law.
    let mut breakable: BTreeMap<(usize, &str), bool> = BTreeMap::new();
    for (law, subject, findings) in &outcomes {
        if findings.iter().all(Finding::holds) {
            unnoticed.push(format!(
                "{}: {} with {:?}",
                LAWS[*law].name, subject.map, subject.fault
            ));
        }
        for finding in findings {
            *breakable.entry((*law, finding.what)).or_default() |= !finding.holds();
        }
    }
    let idle = breakable.iter().filter(|(_, broken)| !**broken);
    unnoticed
        .extend(idle.map(|((law, what), _)| format!("{}: {what} never breaks", LAWS[*law].name)));
    println!(
        "{} broken stand-ins noticed",
        outcomes.len() - unnoticed.len()
    );
    assert!(
        unnoticed.is_empty(),
        "not noticed:\n{}",
        unnoticed.join("\n")
    );
}
