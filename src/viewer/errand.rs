//! Something to find out on a thread of its own. It is given up when nobody waits for it any more.
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc,
    },
};

/// The thread panicked.
#[derive(Debug, PartialEq)]
pub struct Failed;

/// What is on its way. Dropping it gives it up.
pub struct Errand<T> {
    result: mpsc::Receiver<Result<T, Failed>>,
    given_up: Arc<AtomicBool>,
}

impl<T: Send + 'static> Errand<T> {
    /// Starts it. `find` may ask now and then whether it is given up. The window is drawn again when it ends.
    pub fn start(ctx: &egui::Context, find: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T + Send + 'static) -> Errand<T> {
        let (sender, result) = mpsc::channel();
        let given_up = Arc::new(AtomicBool::new(false));
        let errand = Errand { result, given_up: given_up.clone() };
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            let found = catch_unwind(AssertUnwindSafe(|| find(&|| given_up.load(Ordering::Relaxed)))).map_err(|_| Failed);
            let _ = sender.send(found);
            ctx.request_repaint();
        });
        errand
    }

    /// What came of an errand, which ends with it; `None` while it is under way, or there is none.
    pub fn take(errand: &mut Option<Errand<T>>) -> Option<Result<T, Failed>> {
        let found = errand.as_ref()?.result.try_recv().ok()?;
        *errand = None;
        Some(found)
    }
}

impl<T> Drop for Errand<T> {
    fn drop(&mut self) {
        self.given_up.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;

    fn wait<T: Send + 'static>(errand: Errand<T>) -> Result<T, Failed> {
        let (mut errand, start) = (Some(errand), Instant::now());
        loop {
            if let Some(found) = Errand::take(&mut errand) {
                assert!(errand.is_none());
                return found;
            }
            assert!(start.elapsed() < Duration::from_secs(30));
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn an_errand_ends_with_a_result_or_a_failure_and_notices_that_it_is_given_up() {
        let ctx = egui::Context::default();
        assert_eq!(wait(Errand::start(&ctx, |_| 7)), Ok(7));
        assert_eq!(wait(Errand::<i32>::start(&ctx, |_| panic!("on purpose"))), Err(Failed));
        let (sender, noticed) = mpsc::channel();
        drop(Errand::start(&ctx, move |given_up| {
            while !given_up() {
                std::thread::yield_now();
            }
            let _ = sender.send(());
        }));
        assert_eq!(noticed.recv_timeout(Duration::from_secs(30)), Ok(()));
    }
}
