//! Rendering until a target is reached, with a progress bar.
use std::{
    fs,
    ops::ControlFlow,
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

use crossbeam_channel::Receiver;

use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};
use noisefall_base::quote;
use noisefall_render::render::{
    Budget, Published, RenderRequest, Status,
    checkpoint::{Checkpoint, CheckpointEvent},
    still::StillRenderer,
    threads::Threads,
};

use super::{
    checkpointing::{Checkpointing, message},
    live::LiveView,
    messages::{Failure, tell},
    output::Output,
    scene_file::quoted,
    sequence::DROPPED,
    stop::stop_signal,
    summary::noise_text,
};

/// The images of a command.
#[derive(Clone, Copy)]
pub struct Plan {
    pub images: u64,
    /// Whether each image is rendered a second time, by number of bounces.
    pub has_bounces: bool,
    pub is_sequence: bool,
    /// Whether there are checkpoints.
    pub is_kept: bool,
}

impl Plan {
    /// The number of renders.
    fn renders(&self) -> u64 {
        self.images * if self.has_bounces { 2 } else { 1 }
    }

    /// Returns the message for an interruption.
    fn interruption(&self) -> &'static str {
        match (self.is_sequence, self.is_kept) {
            (true, true) => "interrupted: keeping the unfinished frame (interrupt again to stop at once)",
            (true, false) => DROPPED,
            (false, _) => "interrupted: saving the unfinished image (interrupt again to stop at once)",
        }
    }
}

/// The worker of a command, and the progress of its images.
pub struct Rendering {
    stills: StillRenderer,
    checkpoints: Checkpoints,
    stop: Arc<AtomicBool>,
    progress: Progress,
    live: LiveView,
}

/// The checkpoints of the image.
#[derive(Default)]
struct Checkpoints {
    path: Option<PathBuf>,
    events: Option<Receiver<CheckpointEvent>>,
    /// The checkpoint that the image continues from.
    kept: Option<Checkpoint>,
    /// Render time before this run.
    earlier: Duration,
    /// How the image differs from one that was rendered in one go.
    remarks: Vec<String>,
    /// Why the last one was not written.
    failure: Option<String>,
}

/// The progress bar of all images.
struct Progress {
    budget: Budget,
    bar: ProgressBar,
    plan: Plan,
    /// Number of the image that is rendered.
    image: u64,
    /// Number of renders that are finished.
    finished: u64,
}

impl Rendering {
    /// Starts the worker. Each render has the same budget. Shows a progress bar if standard error is a terminal, and the images in the
    /// live view.
    pub fn new(threads: Threads, budget: Budget, plan: Plan, quiet: bool, live: LiveView) -> Result<Rendering, Failure> {
        let stop = stop_signal(plan.interruption())?;
        let bar = if quiet { ProgressBar::hidden() } else { progress_bar(&budget, &plan) };
        let progress = Progress { budget, bar, plan, image: 0, finished: 0 };
        Ok(Rendering { stills: StillRenderer::new(threads, budget), checkpoints: Checkpoints::default(), stop, progress, live })
    }

    /// Keeps the image, and continues from what was kept of it.
    pub fn keep(&mut self, Checkpointing { plan, events, kept, remarks }: Checkpointing) {
        let path = plan.as_ref().map(|plan| plan.path.clone());
        let earlier = kept.as_ref().map_or(Duration::ZERO, Checkpoint::elapsed);
        plan.into_iter().for_each(|plan| self.stills.set_plan(plan));
        self.checkpoints = Checkpoints { path, events, kept, earlier, remarks, failure: None };
    }

    /// Removes the checkpoint of an image that is finished.
    pub fn discard_checkpoint(&mut self) -> Result<(), Failure> {
        self.stills.stop_keeping().map_err(|error| error.to_string())?;
        let path = std::mem::take(&mut self.checkpoints).path;
        if let Some(path) = path.filter(|path| path.exists())
            && let Err(error) = fs::remove_file(&path)
        {
            self.suspend(|| tell(&format!("warning: {}: cannot be removed: {error}", quote::path(&path))));
        }
        Ok(())
    }

    /// How the image differs from one that was rendered in one go.
    pub fn remarks(&self) -> &[String] {
        &self.checkpoints.remarks
    }

    /// Render time of the image before this run.
    pub fn earlier(&self) -> Duration {
        self.checkpoints.earlier
    }

    /// Tells after an interruption how the render is continued.
    pub fn tell_how_to_go_on(&self, output: &Output) {
        let Checkpoints { path, failure, .. } = &self.checkpoints;
        if let Some(path) = path.as_ref().filter(|path| self.is_interrupted() && failure.is_none() && path.exists()) {
            let path = quoted(&path.to_string_lossy());
            tell(&format!("{path} keeps the render: `noisefall render --resume {path} -o {output}` continues it"));
        }
    }

    /// Whether the user has asked to stop.
    pub fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Renders the next image up to the budget.
    pub fn picture(&mut self, request: RenderRequest) -> Result<Published, Failure> {
        self.progress.image += 1;
        let Rendering { stills, checkpoints, stop, progress, live } = self;
        let kept = checkpoints.kept.take();
        let mut watch = |published: &Published| {
            progress.show(&published.status);
            checkpoints.report(&progress.bar);
            let is_of_image = published.frame.generation == published.status.generation;
            let warning = if is_of_image { live.show(&published.frame) } else { None };
            warning.into_iter().for_each(|warning| progress.bar.suspend(|| tell(&warning)));
            go_on(stop)
        };
        let published = match kept {
            Some(kept) => stills.continued(request, kept, &mut watch),
            None => stills.picture(request, &mut watch),
        };
        let published = published.map_err(|error| error.to_string())?;
        // A frame that is finished needs none.
        if checkpoints.path.is_some() && (!progress.plan.is_sequence || stop.load(Ordering::Relaxed)) {
            stills.keep_now().map_err(|error| error.to_string())?;
            checkpoints.report(&progress.bar);
        }
        self.count_finished();
        Ok(published)
    }

    /// Renders the same image by number of bounces, with samples of its own.
    pub fn series(&mut self, request: RenderRequest) -> Result<Published, Failure> {
        let Rendering { stills, stop, progress, .. } = self;
        let mut watch = |published: &Published| {
            progress.show(&published.status);
            go_on(stop)
        };
        let published = stills.series(request, &mut watch).map_err(|error| error.to_string());
        self.count_finished();
        published
    }

    /// Counts a render. After the last one only the live view can still be waited for.
    fn count_finished(&mut self) {
        self.progress.finished += 1;
        if self.progress.finished == self.progress.plan.renders() {
            self.live.announce_end();
        }
    }

    /// Hides the bar while a task prints.
    pub fn suspend<T>(&self, task: impl FnOnce() -> T) -> T {
        self.progress.bar.suspend(task)
    }

    /// Waits until the live view has the last image. Fails if the render could not be kept.
    pub fn finish(self) -> Result<(), Failure> {
        self.live.finish(&self.stop);
        self.checkpoints.failure.map_or(Ok(()), |error| Err(format!("the render is not kept: {error}")))
    }
}

impl Checkpoints {
    /// Tells what has become of checkpoints.
    fn report(&mut self, bar: &ProgressBar) {
        for event in self.events.iter().flat_map(Receiver::try_iter) {
            message(&event).into_iter().for_each(|text| bar.suspend(|| tell(&text)));
            match event {
                CheckpointEvent::Kept => self.failure = None,
                CheckpointEvent::Failed(error) => self.failure = Some(error),
                CheckpointEvent::Slower { .. } => {}
            }
        }
    }
}

fn go_on(stop: &AtomicBool) -> ControlFlow<()> {
    if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

impl Progress {
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
    use std::time::Duration;

    use super::*;

    #[test]
    fn the_bar_is_as_far_as_the_render() {
        let status = Status { spp: 7, elapsed: Duration::from_millis(2500), rel_mse_estimate: Some(0.04), ..Status::default() };
        let one = Plan { images: 1, has_bounces: false, is_sequence: false, is_kept: false };
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
        let length = |images, has_bounces| {
            progress_bar(&budget, &Plan { images, has_bounces, is_sequence: true, is_kept: false }).length()
        };
        assert_eq!([length(1, false), length(1, true), length(3, false), length(3, true)], [20, 40, 60, 120].map(Some));
    }

    #[test]
    fn a_sequence_of_one_frame_drops_or_keeps_the_unfinished_frame() {
        let said = |is_sequence, is_kept| Plan { images: 1, has_bounces: false, is_sequence, is_kept }.interruption();
        assert!(
            said(true, false).contains("the unfinished frame is dropped") && said(true, true).contains("keeping the unfinished")
        );
        assert!(said(false, false).contains("saving the unfinished image") && said(false, true) == said(false, false));
    }
}
