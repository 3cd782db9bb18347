//! Ctrl-C: a file that is being written is taken away again, then the command ends.

use crate::imaging::Progress;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Lets the first signal to stop cancel a job, and the second end the process at once. Where the system does not give signals
/// away, they end the process as ever.
pub(super) fn cancels(progress: &Progress) {
    let asked = progress.cancel_flag();
    for signal in [SIGINT, SIGTERM] {
        // In this order: the first signal finds the flag still unset.
        let ends = flag::register_conditional_shutdown(
            signal,
            i32::from(crate::cli::INTERRUPTED),
            asked.clone(),
        );
        if ends.is_ok() {
            let _ = flag::register(signal, asked.clone());
        }
    }
}
