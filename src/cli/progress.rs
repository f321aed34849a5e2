//! Rendering until a target is reached, with a progress bar.
use std::{sync::atomic::Ordering, time::Duration};

use crossbeam_channel::RecvTimeoutError;
use indicatif::{ProgressBar, ProgressStyle};
use noisefall::render::{Budget, Publish, Published, RenderRequest, Renderer, State, Status, threads::Threads};

use super::{messages::Failure, stop::stop_signal, summary::noise_text};

/// Renders until a target is reached. Shows a progress bar if standard error is a terminal.
pub fn render(threads: Threads, request: RenderRequest, budget: Budget, quiet: bool) -> Result<Published, Failure> {
    let (wake, woken) = crossbeam_channel::bounded(1);
    let renderer = Renderer::new(threads, Publish::Sparse, move || {
        let _ = wake.try_send(());
    });
    renderer.set_budget(budget);
    renderer.submit(1, request);
    let stop = stop_signal("interrupted: saving the unfinished image (interrupt again to stop at once)")?;
    let bar = if quiet { ProgressBar::hidden() } else { progress_bar(&budget) };
    loop {
        if woken.recv_timeout(Duration::from_millis(200)) == Err(RecvTimeoutError::Disconnected) {
            return Err("the render thread ended unexpectedly".to_owned());
        }
        if stop.load(Ordering::Relaxed) {
            renderer.set_budget(Budget { paused: true, ..budget });
        }
        let published = renderer.latest();
        show_progress(&bar, &budget, &published.status);
        if matches!(published.status.state, State::Paused | State::Done(_) | State::Failed(_)) {
            bar.finish_and_clear();
            return Ok(published);
        }
    }
}

fn progress_bar(budget: &Budget) -> ProgressBar {
    let length = match budget {
        Budget { max_spp: Some(spp), .. } => u64::from(*spp),
        Budget { max_time: Some(time), .. } => time.as_millis() as u64,
        _ => 1000,
    };
    let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}  {elapsed} elapsed, {eta} left");
    ProgressBar::new(length).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn show_progress(bar: &ProgressBar, budget: &Budget, status: &Status) {
    bar.set_position(position(budget, status));
    bar.set_message(format!("{} spp, {:.1} M samples/s{}", status.spp, status.samples_per_second() / 1e6, noise_text(status)));
}

/// Position of the bar: samples, milliseconds, or thousandths of the work.
fn position(budget: &Budget, status: &Status) -> u64 {
    match (budget.noise, status.relative_noise()) {
        _ if budget.max_spp.is_some() => u64::from(status.spp),
        _ if budget.max_time.is_some() => status.elapsed.as_millis() as u64,
        // Noise falls with the square root of time, so the fraction of the work that is done is the squared ratio.
        (Some(goal), Some(noise)) => (1000.0 * (goal / noise).powi(2)).min(1000.0) as u64,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_is_as_far_as_the_render() {
        let status = Status { spp: 7, elapsed: Duration::from_millis(2500), rel_mse_estimate: Some(0.04), ..Status::default() };
        let by = |budget: Budget, status: &Status| (position(&budget, status), progress_bar(&budget).length());
        assert_eq!(by(Budget { max_spp: Some(20), ..Budget::default() }, &status), (7, Some(20)));
        assert_eq!(by(Budget { max_time: Some(Duration::from_secs(10)), ..Budget::default() }, &status), (2500, Some(10_000)));
        // Half of the noise takes four times as many samples.
        assert_eq!(by(Budget { noise: Some(0.1), ..Budget::default() }, &status), (250, Some(1000)));
        assert_eq!(by(Budget { noise: Some(0.3), ..Budget::default() }, &status), (1000, Some(1000)));
        assert_eq!(by(Budget { noise: Some(0.1), ..Budget::default() }, &Status::default()), (0, Some(1000)));
    }
}
