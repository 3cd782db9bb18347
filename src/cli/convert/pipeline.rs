//! Reading, converting and writing at once: while a frame is converted the next is read and the last is written.

use std::sync::mpsc::{Receiver, Sender, SyncSender, channel, sync_channel};
use std::thread;

use super::error::ConvertError;

/// Runs three steps over frames until `read` gives none. What a step is done with goes back to the step before, to be
/// filled anew: a film needs no more memory than its third frame.
///
/// `read` runs on a thread that is left behind when a later step fails: it may be waiting for input that never comes.
///
/// # Errors
/// The first step's that fails.
pub(super) fn run<In: Send + 'static, Out: Send + 'static>(
    read: impl FnMut(Option<In>) -> Result<Option<In>, ConvertError> + Send + 'static,
    mut convert: impl FnMut(&In, Option<Out>) -> Result<Out, ConvertError>,
    write: impl FnMut(&mut Out) -> Result<(), ConvertError> + Send + 'static,
) -> Result<(), ConvertError> {
    // No frame waits between two steps: each holds the one that it works on.
    let (to_convert, frames) = sync_channel(0);
    let (used_up, emptied) = channel();
    let (to_write, results) = sync_channel(0);
    let (written, free) = channel();
    thread::spawn(move || read_all(read, &to_convert, &emptied));
    let writer = thread::spawn(move || write_all(write, &results, &written));
    let converted = convert_all(&mut convert, &frames, &used_up, &to_write, &free);
    // The writer ends when nothing more can come; why it ended early says more than that it did.
    drop(to_write);
    writer.join().map_err(|_| ConvertError::Broken)??;
    converted
}

fn read_all<In>(
    mut read: impl FnMut(Option<In>) -> Result<Option<In>, ConvertError>,
    to_convert: &SyncSender<Result<Option<In>, ConvertError>>,
    emptied: &Receiver<In>,
) {
    loop {
        let frame = read(emptied.try_recv().ok());
        let goes_on = matches!(frame, Ok(Some(_)));
        if to_convert.send(frame).is_err() || !goes_on {
            return;
        }
    }
}

fn convert_all<In, Out>(
    convert: &mut impl FnMut(&In, Option<Out>) -> Result<Out, ConvertError>,
    frames: &Receiver<Result<Option<In>, ConvertError>>,
    used_up: &Sender<In>,
    to_write: &SyncSender<Out>,
    free: &Receiver<Out>,
) -> Result<(), ConvertError> {
    loop {
        // A reader that sends nothing has broken off.
        let Some(frame) = frames.recv().map_err(|_| ConvertError::Broken)?? else {
            return Ok(());
        };
        let result = convert(&frame, free.try_recv().ok())?;
        // Where nobody reads any more, there is nothing to be filled anew.
        let _ = used_up.send(frame);
        if to_write.send(result).is_err() {
            return Ok(());
        }
    }
}

fn write_all<Out>(
    mut write: impl FnMut(&mut Out) -> Result<(), ConvertError>,
    results: &Receiver<Out>,
    written: &Sender<Out>,
) -> Result<(), ConvertError> {
    for mut result in results {
        write(&mut result)?;
        let _ = written.send(result);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::{Arc, Mutex};

    #[test]
    fn frames_come_in_order_and_few_are_made() {
        let (made, seen) = (Arc::new(Mutex::new(0)), Arc::new(Mutex::new(Vec::new())));
        let (count, list) = (made.clone(), seen.clone());
        let mut next = 0;
        let read = move |old: Option<Box<u32>>| {
            next += 1;
            let mut frame = old.unwrap_or_else(|| {
                *count.lock().unwrap() += 1;
                Box::default()
            });
            *frame = next;
            Ok((next <= 100).then_some(frame))
        };
        let write = move |frame: &mut u32| {
            list.lock().unwrap().push(*frame);
            Ok(())
        };
        run(read, |frame, _| Ok(**frame), write).unwrap();
        assert_eq!(*seen.lock().unwrap(), (1..=100).collect::<Vec<_>>());
        assert!(*made.lock().unwrap() <= 3);
    }

    #[test]
    fn each_step_can_fail() {
        for failing in 0..3 {
            let fails = move |step: usize, frame: u32| {
                if step == failing && frame == 3 {
                    Err(ConvertError::usage(format!("step {step}")))
                } else {
                    Ok(())
                }
            };
            let mut next = 0;
            let outcome = run(
                move |_| {
                    next += 1;
                    fails(0, next).map(|()| Some(next))
                },
                |frame, _| fails(1, *frame).map(|()| *frame),
                move |frame| fails(2, *frame),
            );
            assert_eq!(outcome.unwrap_err().to_string(), format!("step {failing}"));
        }
    }
}
