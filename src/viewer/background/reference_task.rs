//! Renders a reference in the background. It is kept in a file, from which it goes on, or is there at once, the next time.
use std::{
    ops::ControlFlow,
    path::{Path, PathBuf},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, SystemTime},
};

use crossbeam_channel::unbounded;
use noisefall_base::math::SimdLevel;
use noisefall_render::{
    render::{
        Budget, Frame, Published, RenderRequest, State,
        checkpoint::{Checkpoint, CheckpointFile, CheckpointPlan, EXTENSION},
        still::StillRenderer,
        threads::Threads,
    },
    render_file::{Header, sha256},
};
use noisefall_scene::{
    sampling::{Directions, Sampler},
    scene::{Estimator, RenderSettings, Reuse, Roulette},
};

use super::{background_task::BackgroundTask, checkpoint_render::RenderToKeep, recovery_files::left_files};

/// Time between two checkpoints.
const PAUSE: Duration = Duration::from_secs(60);
/// The oldest files beyond this number are removed.
const MOST_FILES: usize = 16;
/// Bit of the seed that distinguishes references from the images that are compared with them.
const SEED_BIT: u32 = 1 << 31;

/// The settings of a reference for images with these: unbiased, and with samples of its own.
pub fn settings_of_reference(of_image: &RenderSettings) -> RenderSettings {
    RenderSettings {
        estimator: Estimator::Auto,
        sampler: Sampler::Sobol,
        directions: Directions::Bsdf,
        roulette: Roulette::BY_THROUGHPUT,
        max_bounces: None,
        reuse: Reuse::Off,
        adaptive: false,
        merging: false,
        seed: of_image.seed ^ SEED_BIT,
        ..*of_image
    }
}

/// A reference to render.
pub struct ReferenceRequest {
    pub render: RenderToKeep,
    /// Relative noise at which it ends.
    pub noise: f64,
    pub threads: usize,
    /// The folder of references that are kept; without one, or if the scene cannot be read again, none is.
    pub folder: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReferenceProgress {
    pub spp: u32,
    pub noise: Option<f64>,
    /// The noise at which it ends.
    pub goal: f64,
}

impl ReferenceProgress {
    /// Part of the work that is done, if it can be told.
    pub fn part(&self) -> f32 {
        self.noise.map_or(0.0, |noise| (self.goal / noise).powi(2).min(1.0)) as f32
    }
}

/// How the work ended.
pub enum ReferenceEnd {
    Done(Arc<Frame>),
    Stopped,
}

pub struct ReferenceTask {
    /// The image that is rendered.
    pub image: RenderRequest,
    progress: Arc<Mutex<ReferenceProgress>>,
    stop: Arc<AtomicBool>,
    pending: Option<BackgroundTask<Result<ReferenceEnd, String>>>,
}

impl ReferenceTask {
    pub fn start(ctx: &egui::Context, request: ReferenceRequest) -> ReferenceTask {
        let image = request.render.request.clone();
        let progress = Arc::new(Mutex::new(ReferenceProgress { goal: request.noise, ..ReferenceProgress::default() }));
        let stop = Arc::new(AtomicBool::new(false));
        let (told, stopped, window) = (progress.clone(), stop.clone(), ctx.clone());
        let pending = BackgroundTask::start(ctx, move |cancelled| {
            let tell = |progress| {
                *told.lock().unwrap_or_else(PoisonError::into_inner) = progress;
                window.request_repaint();
            };
            render(&request, &tell, &|| cancelled() || stopped.load(Ordering::Relaxed))
        });
        ReferenceTask { image, progress, stop, pending: Some(pending) }
    }

    pub fn progress(&self) -> ReferenceProgress {
        *self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Ends the work. What is rendered is kept.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Takes the end of the work and removes the task. `None` while it runs, or if there is none.
    pub fn take(task: &mut Option<ReferenceTask>) -> Option<(ReferenceTask, Result<ReferenceEnd, String>)> {
        let end = BackgroundTask::take(&mut task.as_mut()?.pending)?;
        Some((task.take()?, end.unwrap_or_else(|_| Err("the render failed unexpectedly".to_owned()))))
    }
}

fn render(
    request: &ReferenceRequest,
    tell: &dyn Fn(ReferenceProgress),
    stops: &dyn Fn() -> bool,
) -> Result<ReferenceEnd, String> {
    let threads = Threads::new(request.threads, SimdLevel::best()).map_err(|error| error.to_string())?;
    let mut stills = StillRenderer::new(threads, Budget { noise: Some(request.noise), ..Budget::default() });
    let file = request.folder.as_deref().and_then(|folder| file_in(folder, &request.render));
    let earlier = file.as_ref().and_then(|(path, _)| read(path));
    let is_kept = file.is_some();
    if let Some((path, header)) = file {
        let (events, _) = unbounded();
        stills.set_plan(CheckpointPlan { path, header, every: Some(PAUSE), events });
    }
    let mut watch = |published: &Published| {
        let noise = published.status.relative_noise();
        tell(ReferenceProgress { spp: published.status.spp, noise, goal: request.noise });
        if stops() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let image = request.render.request.clone();
    let published = match earlier {
        Some(earlier) => stills.continued(image, earlier, &mut watch),
        None => stills.picture(image, &mut watch),
    };
    let published = published.map_err(|error| error.to_string())?;
    if is_kept {
        stills.keep_now().map_err(|error| error.to_string())?;
        request.folder.iter().for_each(|folder| remove_oldest(folder));
    }
    match published.status.state {
        State::Failed(failure) => Err(format!("the renderer failed: {}", failure.message)),
        State::Done(_) => Ok(ReferenceEnd::Done(published.frame)),
        _ => Ok(ReferenceEnd::Stopped),
    }
}

/// The file in which a reference is kept, named by all that its samples depend on, and its header. Nothing is reported: a reference
/// can do without.
fn file_in(folder: &Path, render: &RenderToKeep) -> Option<(PathBuf, Header)> {
    std::fs::create_dir_all(folder).ok()?;
    let header = render.header().ok()?;
    let Header { program, scene, camera, settings, probe, .. } = &header;
    let files: Vec<&str> = header.files.iter().map(|file| file.sha256.as_str()).collect();
    let name = sha256(format!("{program}{}{camera:?}{settings:?}{probe:?}{files:?}", scene.text).as_bytes());
    Some((folder.join(name).with_extension(EXTENSION), header))
}

fn read(path: &Path) -> Option<Checkpoint> {
    CheckpointFile::open(path).ok()?.read().ok()
}

/// Leaves the files that were written last.
fn remove_oldest(folder: &Path) {
    let written = |file: &PathBuf| file.metadata().and_then(|metadata| metadata.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
    let mut files: Vec<PathBuf> = left_files(folder, EXTENSION).collect();
    files.sort_by_key(|file| std::cmp::Reverse(written(file)));
    files.iter().skip(MOST_FILES).for_each(|file| _ = std::fs::remove_file(file));
}

#[cfg(test)]
mod tests {
    use noisefall_formats::import::ImportOptions;
    use noisefall_render::render_file::Target;
    use noisefall_scene::scene::{Camera, built_in, description::SceneDescription};

    use super::*;

    fn request(folder: Option<PathBuf>, noise: f64) -> ReferenceRequest {
        let scene = built_in();
        let camera = Camera { resolution: [16, 12], ..scene.camera };
        let settings = settings_of_reference(&RenderSettings { max_bounces: Some(1), ..scene.settings });
        let render = RenderToKeep {
            request: RenderRequest { scene: Arc::new(scene), camera, settings },
            generation: 0,
            description: Arc::new(SceneDescription::default()),
            target: Target::default(),
            scene: ("scene.toml".into(), ImportOptions::default()),
            remarks: Vec::new(),
        };
        ReferenceRequest { render, noise, threads: 1, folder }
    }

    #[test]
    fn the_settings_of_a_reference_are_unbiased_and_its_samples_are_its_own() {
        let of_image = RenderSettings { max_bounces: Some(2), merging: true, seed: 5, ..RenderSettings::default() };
        let settings = settings_of_reference(&of_image);
        assert!(settings.bias().is_none() && settings.seed != of_image.seed);
    }

    #[test]
    fn a_reference_is_stopped_goes_on_from_its_file_and_is_there_at_once_when_it_is_done() {
        let folder = tempfile::tempdir().expect("a folder");
        let of = |noise| request(Some(folder.path().to_owned()), noise);
        let seen = Mutex::new(ReferenceProgress::default());
        let tell = |progress| *seen.lock().expect("it is not poisoned") = progress;
        let spp = || seen.lock().expect("it is not poisoned").spp;
        let stopped = render(&of(1e-9), &tell, &|| spp() > 0).expect("it runs");
        let before = spp();
        assert!(matches!(stopped, ReferenceEnd::Stopped) && before > 0);
        assert_eq!(left_files(folder.path(), EXTENSION).count(), 1);
        let Ok(ReferenceEnd::Done(frame)) = render(&of(0.05), &tell, &|| false) else { panic!("it ends") };
        assert!(frame.spp >= before && frame.rel_mse_estimate.is_some_and(|rel_mse| rel_mse.sqrt() <= 0.05), "{}", frame.spp);
        let Ok(ReferenceEnd::Done(alone)) = render(&request(None, 0.05), &tell, &|| false) else { panic!("it ends") };
        if alone.spp == frame.spp {
            assert_eq!(alone.radiance, frame.radiance, "it has the bits of one that was not stopped");
        }
        let Ok(ReferenceEnd::Done(again)) = render(&of(0.05), &tell, &|| false) else { panic!("it ends") };
        assert_eq!((again.spp, &again.radiance), (frame.spp, &frame.radiance));
        assert_eq!(left_files(folder.path(), EXTENSION).count(), 1);
    }
}
