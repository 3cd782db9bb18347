//! Work off the window's thread, with progress and cancel.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::imaging::Progress;

/// A running job. Dropping it cancels the work; its late result goes nowhere.
pub struct Job<T> {
    /// Told apart from others by this number.
    pub id: u64,
    /// What the status bar calls it.
    pub title: String,
    /// How far it is; also carries the wish to stop.
    pub progress: Arc<Progress>,
    result: Receiver<T>,
}

/// What came of a job.
pub enum Outcome<T> {
    /// Still at work.
    Running,
    /// Done.
    Done(T),
    /// The worker died without a result.
    Failed,
}

impl<T: Send + 'static> Job<T> {
    /// Starts `work` on a thread of its own; `wake` is called when it ends.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(
        id: u64,
        title: String,
        wake: impl Fn() + Send + 'static,
        work: impl FnOnce(&Progress) -> T + Send + 'static,
    ) -> std::io::Result<Self> {
        let progress = Arc::new(Progress::new());
        let shared = Arc::clone(&progress);
        let (sender, result) = channel();
        std::thread::Builder::new()
            .name("job".to_owned())
            .spawn(move || {
                let outcome = work(&shared);
                drop(sender.send(outcome)); // nobody listens to a job that was replaced
                wake();
            })?;
        Ok(Self {
            id,
            title,
            progress,
            result,
        })
    }

    /// Looks for the result without waiting.
    pub fn poll(&self) -> Outcome<T> {
        match self.result.try_recv() {
            Ok(value) => Outcome::Done(value),
            Err(TryRecvError::Empty) => Outcome::Running,
            Err(TryRecvError::Disconnected) => Outcome::Failed,
        }
    }
}

impl<T> Drop for Job<T> {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wait<T: Send + 'static>(job: &Job<T>) -> Option<T> {
        loop {
            match job.poll() {
                Outcome::Done(value) => return Some(value),
                Outcome::Failed => return None,
                Outcome::Running => std::thread::yield_now(),
            }
        }
    }

    #[test]
    fn a_job_gives_its_result() {
        let job = Job::start(1, "sum".to_owned(), || (), |_| 2 + 2).unwrap();
        assert_eq!(wait(&job), Some(4));
    }

    #[test]
    fn a_dropped_job_is_asked_to_stop() {
        let job = Job::start(
            2,
            "wait".to_owned(),
            || (),
            |progress: &Progress| {
                while !progress.is_cancelled() {
                    std::thread::yield_now();
                }
            },
        )
        .unwrap();
        let progress = Arc::clone(&job.progress);
        assert!(!progress.is_cancelled());
        drop(job);
        assert!(progress.is_cancelled());
    }
}
