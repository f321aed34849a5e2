//! Rendering until a target is reached, with a progress bar.
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use crossbeam_channel::{Receiver, RecvTimeoutError};
use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};
use noisefall::render::{Budget, Publish, Published, RenderRequest, RenderTask, Renderer, State, Status, threads::Threads};

use super::{messages::Failure, stop::stop_signal, summary::noise_text};

/// The images of a command.
#[derive(Clone, Copy)]
pub struct Plan {
    pub images: u64,
    /// Whether each image is rendered a second time, by number of bounces.
    pub has_bounces: bool,
    pub is_sequence: bool,
}

impl Plan {
    /// The number of renders.
    fn renders(&self) -> u64 {
        self.images * if self.has_bounces { 2 } else { 1 }
    }

    /// What happens at an interruption.
    fn interruption(&self) -> &'static str {
        if self.is_sequence {
            "interrupted: the unfinished frame is dropped (interrupt again to stop at once)"
        } else {
            "interrupted: saving the unfinished image (interrupt again to stop at once)"
        }
    }
}

/// The worker of a command, and the progress of its images.
pub struct Rendering {
    renderer: Renderer,
    woken: Receiver<()>,
    stop: Arc<AtomicBool>,
    budget: Budget,
    bar: ProgressBar,
    plan: Plan,
    /// Number of the image that is rendered.
    image: u64,
    /// Number of renders that are finished.
    finished: u64,
}

impl Rendering {
    /// Starts the worker. Each render has the same budget. Shows a progress bar if standard error is a terminal.
    pub fn new(threads: Threads, budget: Budget, plan: Plan, quiet: bool) -> Result<Rendering, Failure> {
        let (wake, woken) = crossbeam_channel::bounded(1);
        let renderer = Renderer::new(threads, Publish::Sparse, move || {
            let _ = wake.try_send(());
        });
        renderer.set_budget(budget);
        let stop = stop_signal(plan.interruption())?;
        let bar = if quiet { ProgressBar::hidden() } else { progress_bar(&budget, &plan) };
        Ok(Rendering { renderer, woken, stop, budget, bar, plan, image: 0, finished: 0 })
    }

    /// Whether the user has asked to stop.
    pub fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Renders the next image up to the budget.
    pub fn picture(&mut self, request: RenderRequest) -> Result<Published, Failure> {
        self.image += 1;
        self.renderer.submit(self.image, request);
        self.finish(Renderer::latest)
    }

    /// Renders the same image by number of bounces, with samples of its own.
    pub fn series(&mut self, request: RenderRequest) -> Result<Published, Failure> {
        self.renderer.submit_second(self.image, RenderTask::Series(request));
        let published = self.finish(Renderer::latest_second);
        self.renderer.stop_second();
        published
    }

    /// Hides the bar while a task prints.
    pub fn suspend<T>(&self, task: impl FnOnce() -> T) -> T {
        self.bar.suspend(task)
    }

    /// Waits for the end of the current render.
    fn finish(&mut self, latest: fn(&Renderer) -> Published) -> Result<Published, Failure> {
        loop {
            if self.woken.recv_timeout(Duration::from_millis(200)) == Err(RecvTimeoutError::Disconnected) {
                return Err("the render thread ended unexpectedly".to_owned());
            }
            if self.is_interrupted() {
                self.renderer.set_budget(Budget { paused: true, ..self.budget });
            }
            // Until the worker begins, the figures are those of the image before.
            let published = latest(&self.renderer);
            if published.status.generation != self.image {
                continue;
            }
            self.show(&published.status);
            if matches!(published.status.state, State::Paused | State::Done(_) | State::Failed(_)) {
                self.finished += 1;
                return Ok(published);
            }
        }
    }

    fn show(&self, status: &Status) {
        self.bar.set_position(length(&self.budget) * self.finished + position(&self.budget, status));
        let frame = if self.plan.images > 1 { format!("frame {} of {}, ", self.image, self.plan.images) } else { String::new() };
        let rate = status.samples_per_second() / 1e6;
        self.bar.set_message(format!("{frame}{} spp, {rate:.1} M samples/s{}", status.spp, noise_text(status)));
    }
}

/// A bar that disappears at the end.
fn progress_bar(budget: &Budget, plan: &Plan) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {percent:>3} %  {msg}  {elapsed} elapsed, {eta} left");
    let bar = ProgressBar::new(length(budget) * plan.renders()).with_finish(ProgressFinish::AndClear);
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Length of the bar of one render.
fn length(budget: &Budget) -> u64 {
    match budget {
        Budget { max_spp: Some(spp), .. } => u64::from(*spp),
        Budget { max_time: Some(time), .. } => time.as_millis() as u64,
        _ => 1000,
    }
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
        let one = Plan { images: 1, has_bounces: false, is_sequence: false };
        let by = |budget: Budget, status: &Status| (position(&budget, status), progress_bar(&budget, &one).length());
        assert_eq!(by(Budget { max_spp: Some(20), ..Budget::default() }, &status), (7, Some(20)));
        assert_eq!(by(Budget { max_time: Some(Duration::from_secs(10)), ..Budget::default() }, &status), (2500, Some(10_000)));
        // Half of the noise takes four times as many samples.
        assert_eq!(by(Budget { noise: Some(0.1), ..Budget::default() }, &status), (250, Some(1000)));
        assert_eq!(by(Budget { noise: Some(0.3), ..Budget::default() }, &status), (1000, Some(1000)));
        assert_eq!(by(Budget { noise: Some(0.1), ..Budget::default() }, &Status::default()), (0, Some(1000)));
    }

    #[test]
    fn the_bar_counts_the_renders_of_bounces() {
        let budget = Budget { max_spp: Some(20), ..Budget::default() };
        let length = |images, has_bounces| progress_bar(&budget, &Plan { images, has_bounces, is_sequence: true }).length();
        assert_eq!([length(1, false), length(1, true), length(3, false), length(3, true)], [20, 40, 60, 120].map(Some));
    }

    #[test]
    fn a_sequence_of_one_frame_says_what_becomes_of_the_frame() {
        let said = |is_sequence| Plan { images: 1, has_bounces: false, is_sequence }.interruption();
        assert!(said(true).contains("the unfinished frame is dropped") && said(false).contains("saving the unfinished image"));
    }
}
