//! The progress bar while a scene is opened. Ctrl+C then ends the program at once.
use std::{thread, time::Duration};

use crossbeam_channel::{RecvTimeoutError, bounded};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use noisefall_base::progress::Progress;

/// Most scenes open faster, and have no bar.
const DELAY: Duration = Duration::from_millis(500);
const INTERVAL: Duration = Duration::from_millis(100);
/// Length of the bar.
const STEPS: u64 = 1000;

/// Runs a task, and shows its progress on standard error if that is a terminal.
pub fn with_bar<T>(progress: &Progress, task: impl FnOnce() -> T) -> T {
    if ProgressDrawTarget::stderr().is_hidden() {
        return task();
    }
    let (done, is_done) = bounded::<()>(0);
    thread::scope(|scope| {
        scope.spawn(move || {
            let go_on = |time| is_done.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
            if !go_on(DELAY) {
                return;
            }
            let bar = bar();
            while {
                show(&bar, progress);
                go_on(INTERVAL)
            } {}
            bar.finish_and_clear();
        });
        let result = task();
        // The bar is gone before anything else is printed.
        drop(done);
        result
    })
}

fn bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}  {elapsed} elapsed");
    ProgressBar::new(STEPS).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn show(bar: &ProgressBar, progress: &Progress) {
    bar.set_message(progress.stage().name());
    bar.set_position((progress.fraction() * STEPS as f64) as u64);
}

#[cfg(test)]
mod tests {
    use noisefall_base::progress::Stage;

    use super::*;

    #[test]
    fn the_bar_shows_the_stage_and_how_much_of_it_is_done() {
        let (bar, progress) = (bar(), Progress::default());
        progress.expect(Stage::Trees, 80);
        assert_eq!(progress.advance(20), Ok(()));
        show(&bar, &progress);
        assert_eq!((bar.position(), bar.length(), bar.message().as_str()), (250, Some(STEPS), "Building trees"));
    }

    #[test]
    fn the_result_is_that_of_the_task() {
        assert_eq!(with_bar(&Progress::default(), || 7), 7);
    }
}
