//! `sixfold convert`: one environment map into another mapping, layout, size and format.

mod ends;
mod error;
mod interrupt;
mod names;
mod options;
mod pipe;
mod pipeline;
mod raw;
mod report;
mod source;
mod task;
mod work;

pub(super) use error::ConvertError;
pub(super) use options::ConvertOptions;

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use super::bar::Bar;
use crate::imaging::{Environment, EnvironmentMap, OpenHints, Progress};
use ends::{FilesOut, Input, Output};
use names::Name;
use report::{Done, Printed};
use source::Source;
use task::Task;
use work::{Converter, Files};

/// Converts what the options say.
pub(super) fn run(options: &ConvertOptions) -> Result<(), ConvertError> {
    let task = Task::new(options)?;
    if let Input::Raw {
        frames,
        mapping,
        hints,
    } = &task.input
    {
        // A pipe leaves nothing behind, and may wait for ever for its next frame: signals end it as they end any program.
        return pipe::run(&task, *frames, *mapping, hints);
    }
    let progress = Arc::new(Progress::new());
    interrupt::cancels(&progress);
    let outcome = files(&task, &progress);
    match outcome {
        Err(_) if progress.is_cancelled() => Err(ConvertError::Interrupted),
        outcome => outcome,
    }
}

/// Converts what comes from files or is built in.
fn files(task: &Task, progress: &Arc<Progress>) -> Result<(), ConvertError> {
    match (&task.input, &task.output) {
        (Input::Files { name, hints }, Output::Files(files)) if name.has_number() => {
            film(task, name, *hints, files, progress)
        }
        (Input::Files { name, hints }, Output::Files(files)) => {
            let path = name.path().to_owned();
            single(task, files, progress, || {
                source::open(path, hints, progress)
            })
        }
        (Input::BuiltIn(environment), Output::Files(files)) => {
            single(task, files, progress, || {
                source::built_in(environment, task.rows_of_latlong(), progress)
            })
        }
        (Input::Files { name, hints }, _) => inspect(name, hints, progress),
        (Input::BuiltIn(environment), _) => inspect_built_in(environment),
        (Input::Raw { .. }, _) => Err(ConvertError::Broken),
    }
}

/// Converts one map.
fn single(
    task: &Task,
    files_out: &FilesOut,
    progress: &Arc<Progress>,
    read: impl FnOnce() -> Result<Source, ConvertError>,
) -> Result<(), ConvertError> {
    let bar = Bar::watch(progress);
    task.check_free(files_out, 0)?;
    let mut converter = Converter::new(task);
    let start = Instant::now();
    let source = read()?;
    converter.times.read = start.elapsed();
    tell(&source.notes);
    let files = files_of(
        files_out,
        converter.prepare(source.map.shape(), source.stored)?,
        0,
    );
    files_out.check(&files.paths)?;
    let result = converter.convert_file(&source, files_out.format, None, progress)?;
    let from = source.map.shape().mapping;
    let shape = result.shape().clone();
    let bytes = source.map.bytes() + result.bytes();
    // Not needed any more, and a format may need room to compress.
    drop(source);
    let start = Instant::now();
    drop(files_out.write(result, &files, task.mips(), progress)?);
    converter.times.write = start.elapsed();
    drop(bar);
    let report = converter.report.as_ref().ok_or(ConvertError::Broken)?;
    finish(
        task,
        &Done {
            from,
            target: &shape,
            report,
            times: &converter.times,
            bytes,
            frames: 1,
        },
    )
}

/// A frame on its way to its files.
struct Framed {
    /// Lent to the writer, which may use it up.
    map: Option<EnvironmentMap>,
    files: Option<Files>,
}

/// Converts numbered files, all by one plan; the next is read and the last written meanwhile.
fn film(
    task: &Task,
    name: &Name,
    hints: OpenHints,
    files_out: &FilesOut,
    progress: &Arc<Progress>,
) -> Result<(), ConvertError> {
    let numbers = source::frames(name)?;
    let count = numbers.len();
    for number in &numbers {
        task.check_free(files_out, *number)?;
    }
    let times = Arc::new([Mutex::new(Duration::ZERO), Mutex::new(Duration::ZERO)]);
    let add = |times: &[Mutex<Duration>; 2], which: usize, start: Instant| {
        if let Ok(mut time) = times[which].lock() {
            *time += start.elapsed();
        }
    };
    let (read_times, read_progress, name) = (times.clone(), progress.clone(), name.clone());
    let mut left = numbers.into_iter();
    let read = move |_| {
        let Some(number) = left.next() else {
            return Ok(None);
        };
        let start = Instant::now();
        let source = source::open(name.file("%f", number), &hints, &read_progress)?;
        add(&read_times, 0, start);
        Ok(Some((number, source)))
    };
    let mut converter = Converter::new(task);
    let mut last = None;
    let convert = |(number, source): &(u64, Source), old: Option<Framed>| {
        let files = files_of(
            files_out,
            converter.prepare(source.map.shape(), source.stored)?,
            *number,
        );
        files_out.check(&files.paths)?;
        let old = old.and_then(|old| old.map);
        let map = converter.convert_file(source, files_out.format, old, progress)?;
        if last.is_none() {
            tell(&source.notes);
        }
        let bytes = source.map.bytes() + map.bytes();
        last = Some((source.map.shape().mapping, map.shape().clone(), bytes));
        Ok(Framed {
            map: Some(map),
            files: Some(files),
        })
    };
    let (write_times, write_progress, writer) =
        (times.clone(), progress.clone(), files_out.clone());
    let mips = task.mips();
    let write = move |framed: &mut Framed| {
        let (Some(files), Some(map)) = (framed.files.take(), framed.map.take()) else {
            return Err(ConvertError::Broken);
        };
        let start = Instant::now();
        framed.map = writer.write(map, &files, mips, &write_progress)?;
        add(&write_times, 1, start);
        Ok(())
    };
    pipeline::run(read, convert, write)?;
    let taken = |which: usize| times[which].lock().map_or(Duration::ZERO, |time| *time);
    (converter.times.read, converter.times.write) = (taken(0), taken(1));
    let (from, target, bytes) = last.ok_or(ConvertError::Broken)?;
    let report = converter.report.as_ref().ok_or(ConvertError::Broken)?;
    finish(
        task,
        &Done {
            from,
            target: &target,
            report,
            times: &converter.times,
            bytes,
            frames: count,
        },
    )
}

fn files_of(files_out: &FilesOut, target: &task::Target, frame: u64) -> Files {
    Files {
        paths: files_out.paths(&target.conversion, frame),
        conversion: target.conversion.clone(),
        save: target.save.clone(),
    }
}

/// Says what was done, where that is asked for.
fn finish(task: &Task, done: &Done) -> Result<(), ConvertError> {
    if task.json() {
        let json = serde_json::to_string(&Printed::new(done));
        let text = json.map_err(|error| ConvertError::Write(error.into()))? + "\n";
        super::print(&text).map_err(ConvertError::Write)?;
    } else if task.repeat() > 1 {
        let (median, spread) = done.times.resampling();
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        super::complain(format_args!(
            "resampled in {:.2} ms, the median of {} runs; between the fastest and the slowest lie {:.2} ms",
            ms(median),
            done.times.resample.len(),
            ms(spread)
        ));
    }
    Ok(())
}

fn tell(notes: &[String]) {
    notes.iter().for_each(super::complain);
}

/// Says what a map seems to be.
fn inspect(name: &Name, hints: &OpenHints, progress: &Progress) -> Result<(), ConvertError> {
    let opened = source::look(name.path().to_owned(), hints, progress)?;
    super::print(&opened).map_err(ConvertError::Write)
}

fn inspect_built_in(environment: &Environment) -> Result<(), ConvertError> {
    let text = format!("latlong, built in: {}\n", environment.name());
    super::print(&text).map_err(ConvertError::Write)
}
