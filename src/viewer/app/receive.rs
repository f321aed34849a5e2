//! Receives what the threads have finished: scenes, references, frames, images, saved files.
use std::sync::Arc;

use noisefall_edit::edit::Document;
use noisefall_render::render::{Budget, RenderTask, WhiteBalance};

use super::{file_tasks::OutsideChanges, history::History, scene_editor::SceneEditor, selection::Selection, state::App};
use crate::viewer::background::{
    catalogue, display_image::DisplayImage, earlier_scenes::EarlierScenes, feature_finder::FeatureFinder,
    given_reference::GivenReference, opened_scene::OpenedScene, recent,
};
use crate::viewer::instruments::{convergence::curve::Moment, path::inspector::PathInspector};

impl App {
    pub fn receive(&mut self) {
        match self.background.loader.take() {
            Some(Ok((opened, document))) => {
                let is_first = self.session.opened.is_none();
                self.open(opened, document);
                self.look_for_recovery(is_first);
            }
            Some(Err(report)) => self.dialogs.scene_error = Some(report),
            None => {}
        }
        self.receive_edited();
        self.receive_saved();
        self.follow_files();
        self.receive_copy();
        self.receive_exports();
        self.receive_reference();
        match self.background.loader.take_reference() {
            Some(Ok(given)) => self.take_reference(given),
            Some(Err(error)) => self.tell(error, true),
            None => {}
        }
        match self.background.saver.take() {
            Some(Ok(path)) => {
                self.tell(format!("Saved {}", path.display()), false);
                self.window.last_saved = Some(path);
            }
            Some(Err(error)) => self.tell(format!("Not saved: {error}"), true),
            None => {}
        }
        let worker = &self.background.worker;
        let second = worker.latest_second();
        self.results.second_status = second.status;
        let is_there = self.second_view().is_some() && second.frame.generation == worker.second_generation();
        self.results.second_frame = Some(second.frame).filter(|frame| is_there && !frame.radiance.is_empty());
        self.note_series();
        let published = self.background.worker.latest();
        self.results.status = published.status;
        let request = self.display_request(published.frame);
        self.background.display.request(request);
        if let Some(image) = self.background.display.take() {
            self.take_image(image);
        }
    }

    /// Puts an image on the screen, and records its figures.
    pub fn take_image(&mut self, image: DisplayImage) {
        self.results.black = self.shows_nothing(image.lit);
        self.note_blackness(image.frame.generation);
        self.meter(&image.frame);
        let reference = self.reference();
        // An image that was requested before may have been compared with another reference, or with none.
        let is_current = reference.as_ref().map(Arc::as_ptr) == image.reference.as_ref().map(Arc::as_ptr);
        let [first, second_comparison] =
            [image.comparison, image.second_comparison].map(|comparison| comparison.filter(|_| is_current));
        let (worker, history) = (&self.background.worker, &mut self.instruments.history);
        if let Some(request) = worker.request() {
            history.look_at(&request.scene, &request.camera, reference.as_ref());
            history.current = Some(request.settings);
            let frame = &image.frame;
            if frame.generation == worker.generation() && !frame.is_coarse() {
                history.record(&request.settings, frame.generation, Moment::of(frame, first));
            }
            let is_latest = |generation| generation == worker.second_generation();
            let second = image.second.as_ref().filter(|frame| is_latest(frame.generation) && !frame.is_coarse());
            let other = self.session.comparison.map(|comparison| comparison.other).filter(|other| *other != request.settings);
            if let (Some(frame), Some(other)) = (second, other) {
                history.record(&other, frame.generation, Moment::of(frame, second_comparison));
            }
        }
        self.results.show(&self.ctx, image);
    }

    /// Takes note of what caps would lose, if the series without a cap is rendered.
    fn note_series(&mut self) {
        let (second_view, request) = (self.second_view(), self.session.request());
        let is_whole = |task: &RenderTask| matches!(task, RenderTask::Series(of) if of.settings.max_bounces.is_none());
        let is_asked = |task: &RenderTask| request.is_some_and(|request| self.background.worker.is_asked(&request, Some(task)));
        if second_view.filter(is_whole).is_some_and(|task| is_asked(&task))
            && let Some(frame) = &self.results.second_frame
        {
            self.instruments.history.note_series(frame);
        }
    }

    pub fn take_reference(&mut self, given: GivenReference) {
        let name = &given.name;
        if let Some(mismatch) = given.reference.mismatch(self.session.camera.resolution) {
            self.tell(format!("{name}: {mismatch}. Set the resolution to that of the reference."), true);
        } else {
            let noise = given
                .reference
                .relative_noise()
                .map_or_else(String::new, |noise| format!(" (estimated error {:.2} %)", 100.0 * noise));
            self.tell(format!("The image is now compared with {name}{noise}"), false);
        }
        self.session.given_reference = Some(given);
    }

    fn open(&mut self, mut opened: OpenedScene, document: Document) {
        let (session, results, scene) = (&mut self.session, &mut self.results, &opened.scene);
        let is_other = session.opened.as_ref().is_none_or(|before| before.path != opened.path || opened.path.is_none());
        if is_other {
            // The exposure that suited another scene says nothing about this one.
            let display = &mut session.look.display;
            (display.exposure, display.white_balance) = (scene.exposure, WhiteBalance::NEUTRAL);
            self.window.forget_last_saved();
            // They name files after the scene before.
            (self.dialogs.save, self.dialogs.sequence, self.window.leaving) = (None, None, None);
        }
        if let Some(path) = &opened.path {
            opened.name = catalogue::remember(&mut self.catalogue, &opened.name, path);
            self.preferences.change(|saved| recent::note(&mut saved.recent, path));
        }
        let kept_view = self.window.kept_view.take().filter(|(path, _)| *path == opened.path).map(|(_, view)| view);
        let view = kept_view.map_or((scene.camera, scene.settings), |view| (view.camera, view.settings));
        session.look.display.exposure = kept_view.map_or(session.look.display.exposure, |view| view.exposure);
        (session.camera, session.settings) = opened.kept.as_ref().map_or(view, |kept| (kept.header.camera, kept.header.settings));
        // A new scene has no file, and goes on being edited as the one before.
        let paused = session.budget.paused && opened.path.is_none() && session.opened.is_some();
        session.budget = Budget { max_spp: scene.spp, steps: session.budget.steps, paused, ..Budget::default() };
        (session.comparison, session.pinned, session.given_reference) = (None, None, None);
        (self.background.adviser, self.background.reference) = (None, None);
        self.background.loader.forget_reference();
        self.background.drops.forget();
        self.background.exact_compile.forget();
        (session.waiting_edit, session.submitted_edit) = (None, None);
        session.earlier = EarlierScenes::default();
        session.earlier.note(&opened.description, &opened.scene);
        // Results of the earlier scene would keep it in memory.
        (self.instruments.path, self.background.features) = (PathInspector::new(&self.ctx), FeatureFinder::new(&self.ctx));
        (results.last_seeing, results.black_reason) = (None, None);
        (results.awaits_meter, results.misfit) = (true, None);
        self.dialogs.scene_error = None;
        self.history = History::default();
        self.selection = Selection::new(&self.ctx);
        self.editor = Some(SceneEditor::new(document));
        (self.outside, self.saving) = (OutsideChanges::default(), None);
        (self.dialogs.file, self.dialogs.conflict, self.dialogs.file_error) = (None, None, None);
        self.dialogs.remarks = !opened.remarks.is_empty();
        self.window.view.fit();
        session.opened = Some(opened);
        self.continue_checkpoint();
    }
}
