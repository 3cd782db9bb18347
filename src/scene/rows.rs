//! Pictures computed row by row, on all cores.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// Fills a picture of one or several layers, each of `width` times `height` places, row by row from the top. `fill` gets a row's
/// number and its part of every layer, so that any thread may fill it.
///
/// `stop` is asked after each row, from several threads, with the part that is done in [0, 1]; true cancels. True when all was
/// filled.
pub(super) fn fill_rows<'a, T: Send + 'a>(
    layers: impl Iterator<Item = &'a mut [T]>,
    [width, height]: [u32; 2],
    stop: &(dyn Fn(f32) -> bool + Sync),
    fill: impl Fn(u32, &mut [&mut [T]]) + Sync,
) -> bool {
    let parts: Vec<_> = layers
        .map(|layer| layer.chunks_mut(width.max(1) as usize))
        .collect();
    let waiting = Mutex::new((0..height, parts));
    let next_row = || {
        let mut waiting = waiting.lock().ok()?;
        let (rows, parts) = &mut *waiting;
        let row: Vec<_> = parts.iter_mut().filter_map(Iterator::next).collect();
        // An empty picture has no parts, however high it is.
        (!row.is_empty()).then_some(())?;
        rows.next().map(|y| (y, row))
    };
    let (done, stopped) = (AtomicU32::new(0), AtomicBool::new(false));
    let work = || {
        while !stopped.load(Ordering::Relaxed)
            && let Some((y, mut row)) = next_row()
        {
            fill(y, &mut row);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            if stop(done as f32 / height as f32) {
                stopped.store(true, Ordering::Relaxed);
            }
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(work);
        }
        work();
    });
    !stopped.into_inner()
}
