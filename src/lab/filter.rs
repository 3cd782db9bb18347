//! Which measurements are looked at together.

use serde::{Deserialize, Serialize};

use super::bench::{CPU, Row, Way};
use super::front::on_front;
use super::inputs::Inputs;
use crate::mapping::MappingId;
use crate::math::Isa;

/// How many directions at a time, and by how many threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Load {
    /// Few, by one thread: they stay in the first-level cache.
    #[default]
    One,
    /// Many, by one thread: they come from memory.
    OneFromMemory,
    /// Many, by all threads.
    All,
}

impl Load {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::One, Self::OneFromMemory, Self::All];

    /// For people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::One => "one core",
            Self::OneFromMemory => "one core, memory",
            Self::All => "all cores",
        }
    }

    /// Whether the row was measured so. Another device than the processor has one way only.
    fn is_of(self, row: &Row) -> bool {
        // Only few directions are also timed one after the other.
        let is_many = row.ns_latency.is_none();
        row.device != CPU
            || match self {
                Self::One => !is_many,
                Self::OneFromMemory => is_many && row.threads == 1,
                Self::All => is_many && row.threads > 1,
            }
    }
}

/// What is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Filter<'a> {
    /// The mappings.
    pub maps: &'a [MappingId],
    /// Which way.
    pub direction: Way,
    /// On what.
    pub inputs: Inputs,
    /// Threads.
    pub load: Load,
    /// One of [`devices`]; `None`: of each evaluator the widest instructions, on each device.
    pub device: Option<&'a str>,
}

impl Filter<'_> {
    /// Those of `rows` that are looked at, in their order.
    pub fn of<'r>(&self, rows: &'r [Row]) -> Vec<&'r Row> {
        let is_wanted = |row: &&Row| {
            self.maps.iter().any(|map| map.info().id == row.mapping)
                && row.direction == self.direction
                && row.inputs == self.inputs
                && self.load.is_of(row)
        };
        let wanted: Vec<&Row> = rows.iter().filter(is_wanted).collect();
        let is_shown = |row: &&Row| match self.device {
            Some(device) => device == device_name(row),
            None => is_widest(row, &wanted),
        };
        wanted.iter().copied().filter(is_shown).collect()
    }
}

/// Which of the rows are on the front of their mapping and device among these rows. What has holes is no answer, however fast.
pub fn fronts(rows: &[&Row]) -> Vec<bool> {
    let mut fronts = vec![false; rows.len()];
    let key = |row: &Row| (row.mapping, row.device.clone());
    let mut groups: Vec<_> = rows.iter().map(|row| key(row)).collect();
    groups.sort_unstable();
    groups.dedup();
    for group in groups {
        let cost = |row: &Row| match row.holes {
            0 if key(row) == group => (row.ns, row.max_error_rad),
            _ => (f64::NAN, f64::NAN),
        };
        let costs: Vec<(f64, f64)> = rows.iter().map(|row| cost(row)).collect();
        for (front, is_on) in fronts.iter_mut().zip(on_front(&costs)) {
            *front |= is_on;
        }
    }
    fronts
}

/// True when no other of `rows` is the same evaluator's with wider instructions, under the same circumstances.
pub fn is_widest(row: &Row, rows: &[&Row]) -> bool {
    let width = |row: &Row| Isa::ALL.iter().position(|set| set.id() == row.isa);
    !rows
        .iter()
        .filter(|other| other.evaluator == row.evaluator && width(other) > width(row))
        .any(|other| other.circumstances() == row.circumstances())
}

/// The device and the instructions: "cpu avx2", or an adapter's name.
pub fn device_name(row: &Row) -> String {
    if row.device == CPU {
        format!("{CPU} {}", row.isa)
    } else {
        row.device.clone()
    }
}

/// The devices, with their instructions, that the rows were measured on, in the rows' order.
pub fn devices(rows: &[Row]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for row in rows {
        let name = device_name(row);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::imaging::Progress;
    use crate::lab::bench::{Plan, bench};
    use crate::lab::clock::Clock;
    use crate::lab::devices::Devices;
    use crate::mapping::NoDevice;

    fn measured() -> Vec<Row> {
        let plan = Plan {
            maps: vec![MappingId::Cube, MappingId::Octahedral],
            inputs: vec![Inputs::Random, Inputs::Coherent],
            few: 64,
            many: 1 << 15,
            judged: 64,
            clock: Clock {
                samples: 1,
                shortest: std::time::Duration::ZERO,
            },
            devices: Devices::Cpu,
            ..Plan::full()
        };
        bench(&plan, &NoDevice("not asked"), &Progress::new()).rows
    }

    #[test]
    fn a_filter_shows_what_it_says_and_all_of_it() {
        let rows = measured();
        let all = Filter {
            maps: &[MappingId::Cube],
            direction: Way::Forward,
            inputs: Inputs::Random,
            load: Load::One,
            device: None,
        };
        let ids = |filter: &Filter<'_>| -> Vec<&str> {
            let shown = filter.of(&rows);
            assert!(shown.iter().all(|row| row.direction == filter.direction));
            assert!(shown.iter().all(|row| row.inputs == filter.inputs));
            shown.iter().map(|row| row.evaluator).collect()
        };
        // Every evaluator once, with its widest instructions.
        let known = MappingId::Cube.evaluators().iter();
        let known = known.filter(|e| e.processor().is_some()).map(|e| e.id);
        assert_eq!(ids(&all), known.collect::<Vec<_>>());
        let best = Isa::best().id();
        let lanes = |filter: &Filter<'_>| -> Vec<&str> {
            let shown = filter.of(&rows).into_iter();
            let lanes = shown.filter(|row| row.evaluator == "lanes");
            lanes.map(|row| row.isa).collect()
        };
        assert_eq!(lanes(&all), [best]);
        let device = Some("cpu baseline");
        let narrow = Filter {
            device,
            ..all.clone()
        };
        assert_eq!(lanes(&narrow), ["baseline"]);
        assert!(devices(&rows).contains(&format!("cpu {best}")));
        for (filter, count) in [
            (
                Filter {
                    maps: &[],
                    ..all.clone()
                },
                0,
            ),
            (
                Filter {
                    maps: &[MappingId::Eac],
                    ..all.clone()
                },
                0,
            ),
            (
                Filter {
                    inputs: Inputs::Adversarial,
                    ..all.clone()
                },
                0,
            ),
            (
                Filter {
                    device: Some("abacus"),
                    ..all.clone()
                },
                0,
            ),
        ] {
            assert_eq!(ids(&filter).len(), count, "{filter:?}");
        }
        let both = Filter {
            maps: &[MappingId::Cube, MappingId::Octahedral],
            ..all.clone()
        };
        assert!(ids(&both).len() > ids(&all).len());
        // From memory only what runs on vectors; by all threads where there are several.
        for load in [Load::OneFromMemory, Load::All] {
            let filter = Filter {
                load,
                ..all.clone()
            };
            let shown = filter.of(&rows);
            assert!(shown.iter().all(|row| row.n == 1 << 15), "{load:?}");
            assert!(
                shown
                    .iter()
                    .all(|row| (row.threads > 1) == (load == Load::All))
            );
        }
    }

    #[test]
    fn the_front_is_that_of_what_is_shown() {
        let mut rows = measured();
        rows.truncate(3);
        for (k, row) in rows.iter_mut().enumerate() {
            (row.ns, row.max_error_rad, row.holes) = (1.0 + k as f64, 1e-3, 0);
        }
        let all: Vec<&Row> = rows.iter().collect();
        assert_eq!(fronts(&all), [true, false, false]);
        // Without the fastest the next one is; another mapping's does not count, nor does one with holes.
        assert_eq!(fronts(&all[1..]), [true, false]);
        let other = Row {
            mapping: "eac",
            ..rows[0].clone()
        };
        let hollow = Row {
            holes: 1,
            ..rows[0].clone()
        };
        assert_eq!(fronts(&[&other, &hollow, &rows[1]]), [true, false, true]);
    }

    #[test]
    fn another_device_is_shown_whatever_the_threads() {
        let mut rows = measured();
        rows.truncate(1);
        rows[0].device = "an adapter".to_owned();
        rows[0].ns_latency = None;
        let filter = |load| Filter {
            maps: &[MappingId::Cube],
            direction: Way::Forward,
            inputs: Inputs::Random,
            load,
            device: Some("an adapter"),
        };
        assert!(
            Load::ALL
                .iter()
                .all(|load| filter(*load).of(&rows).len() == 1)
        );
    }
}
