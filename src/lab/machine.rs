//! What a report was measured on.

use std::time::{SystemTime, UNIX_EPOCH};

use serde::Serialize;

use crate::mapping::Adapter;
use crate::math::Isa;

/// Head of a report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Machine {
    /// The processor's name for itself.
    pub cpu: String,
    /// Cores that the program may use.
    pub cores: usize,
    /// The widest instructions.
    pub isa: &'static str,
    /// The graphics adapter; `null` where none was measured.
    pub adapter: Option<String>,
    /// Its driver.
    pub driver: Option<String>,
    /// The compiler of this program.
    pub compiler: &'static str,
    /// The source's state.
    pub commit: &'static str,
    /// Day and time, UTC.
    pub date: String,
}

impl Machine {
    /// This one, now, with the adapter that was measured.
    pub fn this(adapter: Option<&Adapter>) -> Self {
        let seconds = SystemTime::now().duration_since(UNIX_EPOCH);
        Self {
            cpu: cpu_name().unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            isa: Isa::best().id(),
            adapter: adapter.map(|adapter| adapter.name.clone()),
            driver: adapter.map(|adapter| adapter.driver.clone()),
            compiler: option_env!("SIXFOLD_COMPILER").unwrap_or("unknown"),
            commit: option_env!("SIXFOLD_COMMIT").unwrap_or("unknown: no release build"),
            date: date(seconds.map_or(0, |since| since.as_secs())),
        }
    }
}

/// What Linux says; other systems need calls that are not worth a crate.
fn cpu_name() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// ISO 8601 of seconds since 1970.
fn date(seconds: u64) -> String {
    let (days, time) = (seconds / 86_400, seconds % 86_400);
    // Years begin in March, so that a leap day is the last; 400 of them have 146097 days (Richards 2013).
    let since = days + 719_468;
    let (era, day) = (since / 146_097, since % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let of_year = day - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let of_month = of_year - (153 * month + 2) / 5 + 1;
    let (month, carry) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    let year = era * 400 + year + carry;
    let (hour, minute, second) = (time / 3600, time / 60 % 60, time % 60);
    format!("{year:04}-{month:02}-{of_month:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, text) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            assert_eq!(date(seconds), text);
        }
    }
}
