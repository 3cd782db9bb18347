//! What a conversion did, as `--json` prints it, and what it is measured by.

use std::time::{Duration, Instant};

use serde::Serialize;

use super::options::IsaName;
use crate::imaging::MapShape;
use crate::imaging::resample::{Report, Skipped};
use crate::mapping::MappingId;

/// The object that `--json` prints.
#[derive(Debug, Serialize)]
pub(super) struct Printed {
    from: &'static str,
    to: &'static str,
    /// Texels of a chart, [width, height].
    size: [u32; 2],
    filter: &'static str,
    threads: usize,
    isa: &'static str,
    stages: Vec<StageTime>,
    /// `null` where there is no memory for the copy.
    copy_ratio: Option<f64>,
    skipped: Vec<String>,
    /// `null` where the system does not tell.
    peak_bytes: Option<u64>,
    /// Texels of the charts that were asked for.
    texels: u64,
    largest_footprint_texels: f64,
}

#[derive(Debug, Serialize)]
struct StageTime {
    name: &'static str,
    ms: f64,
    /// The longest time less the shortest, where it was timed more than once.
    #[serde(skip_serializing_if = "Option::is_none")]
    spread_ms: Option<f64>,
}

/// How long each stage took.
#[derive(Clone, Debug, Default)]
pub(super) struct Times {
    pub read: Duration,
    pub plan: Duration,
    pub write: Duration,
    /// Of each run.
    pub resample: Vec<Duration>,
}

impl Times {
    /// The median of the resampling's runs, and the longest less the shortest.
    pub fn resampling(&self) -> (Duration, Duration) {
        let mut runs = self.resample.clone();
        runs.sort_unstable();
        match (runs.first(), runs.last()) {
            (Some(first), Some(last)) => (runs[runs.len() / 2], *last - *first),
            _ => Default::default(),
        }
    }
}

/// What was converted.
pub(super) struct Done<'a> {
    pub from: MappingId,
    pub target: &'a MapShape,
    pub report: &'a Report,
    pub times: &'a Times,
    /// Bytes of the source's and the result's texels.
    pub bytes: u64,
    /// Frames of a film; 1 for a single map.
    pub frames: usize,
}

impl Printed {
    /// Puts the object together; copies memory to have something to compare with.
    pub fn new(done: &Done) -> Self {
        // The copy must not count as the conversion's.
        let peak_bytes = peak_bytes();
        let (median, spread) = done.times.resampling();
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        let stage = |name, time| StageTime {
            name,
            ms: ms(time),
            spread_ms: None,
        };
        let repeated = done.times.resample.len() > done.frames;
        let all: Duration = done.times.resample.iter().sum();
        let resample = StageTime {
            name: "resample",
            // Of a film all frames; of one map the median of its runs.
            ms: ms(if done.frames > 1 { all } else { median }),
            spread_ms: repeated.then(|| ms(spread)),
        };
        let wanted = done.target.charts.iter().flatten().count() as u64;
        let [width, height] = done.target.size.map(u64::from);
        Self {
            from: done.from.info().id,
            to: done.target.mapping.info().id,
            size: done.target.size,
            filter: done.report.filter.id(),
            threads: done.report.threads,
            isa: IsaName::of(done.report.isa),
            stages: vec![
                stage("read", done.times.read),
                stage("plan", done.times.plan),
                resample,
                stage("write", done.times.write),
            ],
            copy_ratio: copy_time(done.bytes / 2, done.report.threads)
                .map(|copy| median.as_secs_f64() / copy.as_secs_f64()),
            skipped: done.report.skipped.iter().map(in_words).collect(),
            peak_bytes,
            texels: wanted * width * height,
            largest_footprint_texels: done.report.largest_footprint_texels,
        }
    }
}

fn in_words(skipped: &Skipped) -> String {
    match skipped {
        Skipped::Charts(1) => "1 chart not asked for".to_owned(),
        Skipped::Charts(count) => format!("{count} charts not asked for"),
        Skipped::OutsideDiscs(texels) => format!("{texels} texels outside of the discs"),
        Skipped::TableOfPlaces => "table of places".to_owned(),
        Skipped::Decoding => "decoding and encoding".to_owned(),
        Skipped::Rotation => "rotation".to_owned(),
    }
}

/// The median time to copy so many bytes on so many threads; `None` where there is no memory for it.
fn copy_time(bytes: u64, threads: usize) -> Option<Duration> {
    /// Runs: enough for a median that one disturbance does not move.
    const RUNS: usize = 5;
    let bytes = usize::try_from(bytes).ok().filter(|bytes| *bytes > 0)?;
    let filled = |value: u8| {
        let mut list: Vec<u8> = Vec::new();
        list.try_reserve_exact(bytes).ok()?;
        // Written once, so that no copy meets pages that are not there yet.
        list.resize(bytes, value);
        Some(list)
    };
    let (from, mut to) = (filled(1)?, filled(2)?);
    let part = bytes.div_ceil(threads.max(1));
    let mut times: Vec<Duration> = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            std::thread::scope(|scope| {
                for (from, to) in from.chunks(part).zip(to.chunks_mut(part)).skip(1) {
                    scope.spawn(|| to.copy_from_slice(from));
                }
                let (from, to) = (&from[..part], &mut to[..part]);
                to.copy_from_slice(from);
            });
            // What nobody reads need not be written.
            std::hint::black_box(&mut to);
            start.elapsed()
        })
        .collect();
    times.sort_unstable();
    Some(times[RUNS / 2].max(Duration::from_nanos(1)))
}

/// Most memory that the process has had, in bytes; `None` where the system does not tell.
fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_takes_time_and_more_bytes_more_of_it() {
        assert_eq!(copy_time(0, 2), None);
        let (small, large) = (copy_time(1 << 10, 1).unwrap(), copy_time(1 << 25, 1).unwrap());
        assert!(small > Duration::ZERO && large > small);
        assert!(copy_time(3, 8).is_some(), "more threads than bytes");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn the_peak_grows_with_what_was_used() {
        let before = peak_bytes().unwrap();
        let block = vec![1_u8; 1 << 26];
        std::hint::black_box(&block);
        drop(block);
        assert!(peak_bytes().unwrap() >= before.max(1 << 26));
    }

    #[test]
    fn the_median_of_runs_is_told_with_their_spread() {
        let runs = [3, 9, 1].map(Duration::from_millis).to_vec();
        let times = Times {
            resample: runs,
            ..Times::default()
        };
        let expected = [3, 8].map(Duration::from_millis);
        assert_eq!(times.resampling(), expected.into());
        assert_eq!(Times::default().resampling(), Default::default());
    }
}
