//! Edits of the scene: requests to the worker, and their results.
use std::{path::PathBuf, sync::Arc};

use noisefall_base::declare::Precision;
use noisefall_render::render::{EditResult, RenderRequest, SceneEdit};
use noisefall_scene::scene::{Scene, SceneError, description::SceneDescription};

use super::{PendingEdit, RenderWorkerHandle};

/// A changed scene.
pub struct EditedDescription {
    pub description: Arc<SceneDescription>,
    /// Folder of its relative file paths.
    pub folder: PathBuf,
    /// Only what no image shows has changed: see [`SceneDescription::differs_unseen`].
    pub differs_unseen: bool,
    /// A scene that was rendered before and has the image of the changed one.
    pub earlier: Option<Arc<Scene>>,
}

impl RenderWorkerHandle {
    /// Requests a changed scene. The request holds the scene before the edit. If only texts changed, or nothing, the image continues;
    /// the image of an earlier scene comes back with its samples. Until there is a result, nothing else is requested.
    pub fn edit(&mut self, request: RenderRequest, edited: EditedDescription, now: f64) {
        let EditedDescription { description, folder, differs_unseen, earlier } = edited;
        let generation = self.generation;
        let has_same_image = differs_unseen || earlier.as_ref().is_some_and(|earlier| earlier.has_same_image(&request.scene));
        let continues = has_same_image && !self.restarts && self.request.as_ref() == Some(&request);
        if !continues {
            self.generation = self.next(now);
        }
        let RenderRequest { scene, camera, settings } = request.clone();
        let earlier = earlier.filter(|_| !continues);
        let keeps_image = continues || earlier.is_some();
        let (before, precision) = (earlier.unwrap_or(scene), Precision::Interactive);
        let edit = SceneEdit { description, folder, before, precision, keeps_image, camera, settings };
        self.renderer.edit(self.generation, edit);
        self.edit = Some(PendingEdit { request, before: generation, continues });
    }

    /// Whether an edit has no result yet.
    pub fn is_editing(&self) -> bool {
        self.edit.is_some()
    }

    /// The result of the last edit, once: the scene, which is being rendered.
    pub fn take_edited(&mut self) -> Option<Result<Arc<Scene>, SceneError>> {
        let EditResult { scene, .. } = self.renderer.take_edited()?;
        let PendingEdit { request, before, continues } = self.edit.take()?;
        match &scene {
            Ok(scene) => {
                // A file of the scene may have changed too: the image is a new one then.
                self.restarts |= continues && !scene.has_same_image(&request.scene);
                self.request = Some(RenderRequest { scene: scene.clone(), ..request });
            }
            Err(_) => self.generation = before,
        }
        Some(scene)
    }
}
