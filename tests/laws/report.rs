//! What a law observed, beside what it allows.

/// One observed number. A count of violations has the budget 0.
#[derive(Clone, Debug)]
pub struct Finding {
    pub what: &'static str,
    pub observed: f64,
    pub budget: f64,
}

impl Finding {
    pub fn new(what: &'static str, observed: f64, budget: f64) -> Self {
        Self {
            what,
            observed,
            budget,
        }
    }

    /// A number that must not be zero or small: what is not claimed must be seen to fail.
    pub fn at_least(what: &'static str, observed: f64, floor: f64) -> Self {
        Self::new(what, f64::from(u8::from(observed < floor)), 0.0)
    }

    pub fn holds(&self) -> bool {
        self.observed <= self.budget
    }
}

/// The largest of a stream of numbers; NaN wins over everything, so that it cannot be overlooked.
#[derive(Clone, Copy, Debug, Default)]
pub struct Worst(pub f64);

impl Worst {
    pub fn see(&mut self, value: f64) {
        if value.is_nan() || value > self.0 {
            self.0 = value;
        }
    }
}

/// Prints the findings of one law as rows: number, budget, worst mapping, and the others.
pub fn print(law: &str, rows: &[(String, Finding)]) {
    let mut whats: Vec<&str> = rows.iter().map(|(_, finding)| finding.what).collect();
    whats.dedup();
    let mut seen: Vec<&str> = Vec::new();
    for what in whats {
        if seen.contains(&what) {
            continue;
        }
        seen.push(what);
        println!("{law}: {what}");
        for (map, finding) in rows.iter().filter(|(_, finding)| finding.what == what) {
            let mark = if finding.holds() { "" } else { "  BROKEN" };
            println!(
                "    {map:24} observed {:9.2e}  budget {:7.1e}{mark}",
                finding.observed, finding.budget
            );
        }
    }
}
