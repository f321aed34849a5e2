//! Edits of the scene. The worker compiles the changed parts on the render threads, and renders the result at once.
use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    sync::Arc,
};

use crossbeam_channel::{Receiver, Sender, unbounded};

use super::{pass::panic_message, protocol::RenderRequest, threads::Threads};
use noisefall_base::declare::Precision;
use noisefall_scene::scene::{Camera, RenderSettings, Scene, SceneError, description::SceneDescription};

/// A changed scene that is compiled and rendered instead of the previous one.
#[derive(Clone)]
pub struct SceneEdit {
    /// The changed scene.
    pub description: Arc<SceneDescription>,
    /// Folder of its relative file paths.
    pub folder: PathBuf,
    /// The scene whose parts are reused; it need not be the one that is rendered.
    pub before: Arc<Scene>,
    /// Precision of the compile.
    pub precision: Precision,
    /// Whether the scene differs from `before` unseen at most: see [`SceneDescription::differs_unseen`]. Its image is then that of
    /// `before`, which continues.
    pub keeps_image: bool,
    /// The camera, which need not be the scene's.
    pub camera: Camera,
    /// How it is rendered.
    pub settings: RenderSettings,
}

/// The result of a [`SceneEdit`]. After an error, the previous image continues.
pub struct EditResult {
    /// Number of the image.
    pub generation: u64,
    /// The compiled scene.
    pub scene: Result<Arc<Scene>, SceneError>,
}

impl SceneEdit {
    /// Compiles the scene on the render threads.
    fn compile(&self, threads: &Threads) -> Result<Arc<Scene>, SceneError> {
        let rebuild = || threads.install(|| self.description.rebuild(&self.folder, &self.before, self.precision));
        let mut scene = catch_unwind(AssertUnwindSafe(rebuild)).unwrap_or_else(|panic| Err(failed(&*panic)))?;
        if self.keeps_image {
            scene.keep_image(&self.before);
        }
        Ok(Arc::new(scene))
    }
}

fn failed(panic: &(dyn Any + Send)) -> SceneError {
    let message = format!("compiling it failed: {}", panic_message(panic));
    SceneError::of_file(Path::new("scene"), message, "undo the change, and report the scene")
}

/// The edits of a worker: the latest one that waits, and the results.
pub(super) struct SceneEdits {
    /// With the number of its image.
    waiting: Option<(u64, Box<SceneEdit>)>,
    done: Sender<EditResult>,
    results: Receiver<EditResult>,
}

impl Default for SceneEdits {
    fn default() -> SceneEdits {
        let (done, results) = unbounded();
        SceneEdits { waiting: None, done, results }
    }
}

impl SceneEdits {
    /// Receives the results.
    pub fn results(&self) -> Receiver<EditResult> {
        self.results.clone()
    }

    /// Compiles this instead of the edit that waits.
    pub fn set(&mut self, edit: Option<(u64, Box<SceneEdit>)>) {
        self.waiting = edit;
    }

    /// Compiles the edit that waits. If that fails and `frees` has freed memory, tries again. Returns the request of its image, and a
    /// message for [`SceneEdits::tell`].
    pub fn compile(&mut self, threads: &Threads, frees: impl FnOnce() -> bool) -> Option<(Option<RenderRequest>, EditResult)> {
        let (generation, edit) = self.waiting.take()?;
        let scene = edit.compile(threads).or_else(|error| if frees() { edit.compile(threads) } else { Err(error) });
        let SceneEdit { camera, settings, .. } = *edit;
        let request = scene.as_ref().ok().map(|scene| RenderRequest { scene: scene.clone(), camera, settings });
        Some((request, EditResult { generation, scene }))
    }

    /// Sends a result.
    pub fn tell(&self, result: EditResult) {
        let _ = self.done.send(result);
    }
}
