//! A task on its own thread. It is cancelled when its handle is dropped.
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use crossbeam_channel::{Receiver, bounded};

/// The thread of a task panicked.
#[derive(Debug, PartialEq)]
pub struct Panicked;

/// A computation on another thread. Dropping it cancels the computation.
pub struct BackgroundTask<T> {
    result: Receiver<Result<T, Panicked>>,
    cancelled: Arc<AtomicBool>,
}

impl<T: Send + 'static> BackgroundTask<T> {
    /// Starts a task. `find` gets a function that tells whether the task is cancelled. The window is redrawn when the task ends.
    pub fn start(ctx: &egui::Context, find: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send + 'static) -> BackgroundTask<T> {
        let (sender, result) = bounded(1);
        let cancelled = Arc::new(AtomicBool::new(false));
        let task = BackgroundTask { result, cancelled: cancelled.clone() };
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            let found = catch_unwind(AssertUnwindSafe(|| find(&|| cancelled.load(Ordering::Relaxed)))).map_err(|_| Panicked);
            let _ = sender.send(found);
            ctx.request_repaint();
        });
        task
    }

    /// Takes the result of a finished task and removes the task. `None` while it runs, or if there is none.
    pub fn take(task: &mut Option<BackgroundTask<T>>) -> Option<Result<T, Panicked>> {
        let found = task.as_ref()?.result.try_recv().ok()?;
        *task = None;
        Some(found)
    }
}

impl<T> Drop for BackgroundTask<T> {
    fn drop(&mut self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;

    fn wait<T: Send + 'static>(task: BackgroundTask<T>) -> Result<T, Panicked> {
        let (mut task, start) = (Some(task), Instant::now());
        loop {
            if let Some(found) = BackgroundTask::take(&mut task) {
                assert!(task.is_none());
                return found;
            }
            assert!(start.elapsed() < Duration::from_secs(30));
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn a_task_ends_with_a_result_or_a_failure_and_notices_that_it_is_cancelled() {
        let ctx = egui::Context::default();
        assert_eq!(wait(BackgroundTask::start(&ctx, |_| 7)), Ok(7));
        assert_eq!(wait(BackgroundTask::<i32>::start(&ctx, |_| panic!("on purpose"))), Err(Panicked));
        let (sender, noticed) = bounded(1);
        drop(BackgroundTask::start(&ctx, move |cancelled| {
            while !cancelled() {
                std::thread::yield_now();
            }
            let _ = sender.send(());
        }));
        assert_eq!(noticed.recv_timeout(Duration::from_secs(30)), Ok(()));
    }
}
