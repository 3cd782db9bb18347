//! A progress bar, on a terminal only.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::imaging::Progress;

/// Shows how far a job is, with the time that is left, until it is dropped; leaves nothing behind on the screen.
pub(super) struct Bar(Option<(Sender<()>, JoinHandle<()>)>);

impl Bar {
    /// Begins to watch a job, where standard error is a terminal.
    pub fn watch(progress: &Arc<Progress>) -> Self {
        /// Nobody misses a bar for what is done before.
        const PATIENCE: Duration = Duration::from_millis(500);
        const PERIOD: Duration = Duration::from_millis(100);
        if !std::io::stderr().is_terminal() {
            return Self(None);
        }
        let progress = Arc::clone(progress);
        let (stop, stopped) = channel();
        let thread = std::thread::spawn(move || {
            if stopped.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
                return;
            }
            let bar = bar();
            let mut stage = progress.stage();
            while stopped.recv_timeout(PERIOD) == Err(RecvTimeoutError::Timeout) {
                if progress.stage() != stage {
                    stage = progress.stage();
                    // Each stage has its own pace.
                    bar.reset();
                }
                bar.set_message(stage.name());
                bar.set_position((progress.fraction() * STEPS as f32) as u64);
            }
            bar.finish_and_clear();
        });
        Self(Some((stop, thread)))
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some((stop, thread)) = self.0.take() {
            drop(stop);
            // A bar that broke off takes nothing with it.
            let _ = thread.join();
        }
    }
}

const STEPS: u64 = 1000;

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(STEPS);
    if let Ok(style) =
        ProgressStyle::with_template("{msg:12} {wide_bar} {percent:>3} %, {eta} left")
    {
        bar.set_style(style);
    }
    bar
}
