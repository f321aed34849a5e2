//! Reading and compiling scenes off the UI thread. The latest request wins.
#[cfg(test)]
mod tests;

use std::{
    path::{Path, PathBuf, absolute},
    sync::Arc,
};

use noisefall_base::progress::Progress;
use noisefall_edit::edit::{Recovery, Template};
use noisefall_formats::import::ImportOptions;
use noisefall_render::render::reference::Reference;
use noisefall_scene::scene::Camera;

use super::{
    background_task::BackgroundTask,
    catalogue::BUILT_IN_NAME,
    given_reference::GivenReference,
    opened_scene::{GivenScene, OpenResult, begin, open, restore},
};

pub type ReferenceResult = Result<GivenReference, String>;

pub struct Loader {
    ctx: egui::Context,
    pending: Option<BackgroundTask<OpenResult>>,
    /// Name of what is being read.
    name: String,
    /// The progress of the latest request.
    progress: Progress,
    reference: Option<BackgroundTask<ReferenceResult>>,
    /// The scene of the command line.
    given: GivenScene,
}

impl Loader {
    pub fn new(ctx: &egui::Context) -> Loader {
        Loader {
            ctx: ctx.clone(),
            pending: None,
            name: String::new(),
            progress: Progress::default(),
            reference: None,
            given: GivenScene::default(),
        }
    }

    /// Opens the scene of the command line.
    pub fn open_given(&mut self, scene: GivenScene) {
        self.given = scene.clone();
        self.open(scene.path);
    }

    /// Opens a scene file, or the built-in scene.
    pub fn open(&mut self, path: Option<PathBuf>) {
        let mut scene = if self.is_given(path.as_deref()) { GivenScene { path, ..self.given.clone() } } else { path.into() };
        self.name = scene.path.as_deref().map_or_else(|| BUILT_IN_NAME.to_owned(), file_name);
        scene.options.progress = self.restart();
        self.pending = Some(BackgroundTask::start(&self.ctx, |_| open(scene)));
    }

    /// Cancels the request that is pending, and returns the progress of the next one.
    fn restart(&mut self) -> Progress {
        self.cancel();
        self.progress = Progress::default();
        self.progress.clone()
    }

    /// The progress of the pending request.
    pub fn progress(&self) -> Option<&Progress> {
        self.pending.is_some().then_some(&self.progress)
    }

    /// The options with which a scene was opened.
    pub fn options_of(&self, path: Option<&Path>) -> ImportOptions {
        if self.is_given(path) { self.given.options.clone() } else { ImportOptions::default() }
    }

    /// Whether a file is that of the command line, whose options it takes.
    fn is_given(&self, path: Option<&Path>) -> bool {
        let paths = self.given.path.as_deref().zip(path);
        paths.is_some_and(|(given, path)| absolute(given).ok() == absolute(path).ok())
    }

    /// Begins a new scene.
    pub fn begin(&mut self, template: Template) {
        self.cancel();
        template.title.clone_into(&mut self.name);
        self.pending = Some(BackgroundTask::start(&self.ctx, move |_| begin(template)));
    }

    /// Opens a scene with the changes that were not saved.
    pub fn restore(&mut self, recovery: Recovery) {
        let is_given = self.is_given(recovery.origin.as_deref());
        self.name = recovery.file().map_or_else(|| "unsaved changes".to_owned(), file_name);
        let of_file = if is_given { self.given.options.clone() } else { ImportOptions::default() };
        let options = ImportOptions { progress: self.restart(), ..of_file };
        self.pending = Some(BackgroundTask::start(&self.ctx, move |_| restore(&recovery, &options)));
    }

    /// Reads a reference for images by this camera.
    pub fn read_reference(&mut self, path: PathBuf, camera: Camera) {
        self.reference = Some(BackgroundTask::start(&self.ctx, move |_| {
            let name = file_name(&path);
            let read = Reference::read(&path);
            let read = read.map(|reference| GivenReference { name, reference: Arc::new(reference), camera, scene: None });
            read.map_err(|error| format!("Not a reference: {error}"))
        }));
    }

    /// Discards the reference that is being read, because it is for another scene.
    pub fn forget_reference(&mut self) {
        self.reference = None;
    }

    pub fn is_busy(&self) -> bool {
        self.pending.is_some()
    }

    /// The name of the scene that is being read.
    pub fn reading(&self) -> Option<&str> {
        self.pending.is_some().then_some(&self.name)
    }

    /// Cancels the pending request; no result will come. Returns whether there was one.
    pub fn cancel(&mut self) -> bool {
        self.progress.cancel();
        self.pending.take().is_some()
    }

    /// Reads a scene that is never there, until it is cancelled. `ended` is set then.
    #[cfg(test)]
    pub fn read_for_ever(&mut self, name: &str, ended: Arc<std::sync::atomic::AtomicBool>) {
        name.clone_into(&mut self.name);
        self.pending = Some(BackgroundTask::start(&self.ctx, move |cancelled| {
            while !cancelled() {
                std::thread::yield_now();
            }
            ended.store(true, std::sync::atomic::Ordering::Relaxed);
            Err("cancelled".to_owned())
        }));
    }

    /// Takes the result of the latest request, if it is finished.
    pub fn take(&mut self) -> Option<OpenResult> {
        let failed = |_| Err("reading the scene failed unexpectedly".to_owned());
        Some(BackgroundTask::take(&mut self.pending)?.unwrap_or_else(failed))
    }

    /// Takes the last reference, if it has been read.
    pub fn take_reference(&mut self) -> Option<ReferenceResult> {
        let failed = |_| Err("Reading the reference failed unexpectedly".to_owned());
        Some(BackgroundTask::take(&mut self.reference)?.unwrap_or_else(failed))
    }
}

/// Nobody takes the result of a load whose window is gone.
impl Drop for Loader {
    fn drop(&mut self) {
        self.cancel();
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
