//! Edits of the open scene. The worker compiles and renders them. After a drag, the exact_compile compiles the exact scene.
use std::sync::Arc;

use noisefall_render::render::RenderRequest;
use noisefall_scene::scene::{Camera, Scene, description::SceneDescription};

use super::state::App;
use crate::viewer::background::{exact_compile::EditedScene, render_worker::EditedDescription};

/// The beginning of the message that an edited scene cannot be compiled. It holds until one can.
const BEFORE: &str = "The image shows the scene before this change";

impl App {
    /// Renders a changed scene. If changes come faster than their images, only the latest counts.
    pub fn edit_scene(&mut self, description: Arc<SceneDescription>) {
        self.session.waiting_edit = Some(description);
    }

    /// Requests an edit of the scene.
    pub fn submit_edit(&mut self, request: RenderRequest, description: Arc<SceneDescription>, now: f64) {
        let Some(opened) = &self.session.opened else { return };
        let folder = opened.folder();
        // A diagnosis of an earlier edit is out of date.
        self.outside.diagnosis = None;
        self.session.submitted_edit = Some(description.clone());
        let differs_unseen = description.differs_unseen(&opened.description);
        // A drag has no way back to an earlier scene, and no time to look for one.
        let earlier = if self.is_dragging() { None } else { self.session.earlier.of(&description) };
        self.background.worker.edit(request, EditedDescription { description, folder, differs_unseen, earlier }, now);
    }

    /// Receives the edited scene from the worker, and the exact one from the exact_compile.
    pub fn receive_edited(&mut self) {
        match self.background.worker.take_edited() {
            Some(Ok(scene)) => self.take_edited(scene),
            Some(Err(error)) if self.diagnose_file(&error) => {}
            Some(Err(error)) => self.tell(format!("{BEFORE}: {error}"), true),
            None => {}
        }
        // A drag goes on as long as a button is down.
        if !self.is_compiling() && !self.ctx.input(|input| input.pointer.any_down()) {
            self.background.exact_compile.start();
        }
        if let Some(settled) = self.background.exact_compile.take()
            && let Some(opened) = &mut self.session.opened
        {
            opened.warnings = settled.warnings;
            if !Arc::ptr_eq(&opened.scene, &settled.scene) {
                self.session.earlier.note(&opened.description, &settled.scene);
                opened.change(settled.scene);
            }
        }
    }

    /// Whether an edit is compiled or waits to be.
    pub fn is_compiling(&self) -> bool {
        self.session.waiting_edit.is_some() || self.background.worker.is_editing()
    }

    fn take_edited(&mut self, scene: Arc<Scene>) {
        let session = &mut self.session;
        let (Some(opened), Some(description)) = (&mut session.opened, session.submitted_edit.take()) else { return };
        // The camera and the settings are those of the window, unless they are what was edited.
        let (before, new) = (opened.description.clone(), scene.camera);
        if description.camera != before.camera {
            let keeps_resolution = description.camera.resolution == before.camera.resolution;
            session.camera =
                Camera { resolution: if keeps_resolution { session.camera.resolution } else { new.resolution }, ..new };
        }
        if description.render.settings != before.render.settings {
            session.settings = scene.settings;
        }
        let exposure = &mut session.look.display.exposure;
        if *exposure == before.render.exposure {
            *exposure = scene.exposure;
        }
        if description.render.spp != before.render.spp {
            session.budget.max_spp = scene.spp;
        }
        session.earlier.note(&description, &scene);
        self.dialogs.notices.0.retain(|notice| !notice.text.starts_with(BEFORE));
        opened.description = description.clone();
        let folder = opened.folder();
        self.background.exact_compile.note(EditedScene { scene: scene.clone(), description: description.clone(), folder });
        opened.change(scene);
        (self.results.black_reason, self.results.misfit) = (None, None);
        if self.dialogs.file_error.is_some() {
            // That this scene compiles says nothing about the file as it is now.
            self.outside.recheck();
        }
        if description.camera != before.camera || description.render != before.render {
            self.history.adopt(self.session.controls());
        }
    }
}
