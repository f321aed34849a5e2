//! Joins the windows over the image with the state of the window.
use noisefall::scene::{Estimator, RenderSettings, Roulette};

use super::state::App;
use crate::viewer::background::adviser::Adviser;
use crate::viewer::dialogs::{
    advice, choose_file, help, open, remarks, save,
    save::SaveAnswer,
    save_target::SaveTarget,
    scene_error, shield,
    tour::{self, TourRequest},
    unsaved::Leaving,
};
use crate::viewer::instruments::tabs::InstrumentTab;

impl App {
    pub fn show_dialogs(&mut self, ctx: &egui::Context) {
        if self.dialogs.wait() {
            shield::show(ctx);
        }
        let mut bounces = self.window.tab == Some(InstrumentTab::Bounces);
        let had_bounces = bounces;
        let answer = save::show(ctx, &mut self.dialogs.save, &mut bounces);
        if bounces != had_bounces {
            self.window.tab = bounces.then_some(InstrumentTab::Bounces);
        }
        if answer.is_none() && self.dialogs.save.is_none() {
            // The question where to save had no answer.
            self.window.leaving = None;
        }
        match answer {
            Some(SaveAnswer::File(target, path)) => self.save_target(target, path),
            Some(SaveAnswer::SceneWithView(path)) => {
                self.keep_view();
                self.save_target(SaveTarget::Scene, path);
            }
            Some(SaveAnswer::Other(export)) => self.open_export(export),
            None => {}
        }
        self.show_export_dialogs(ctx);
        let opened = open::show(ctx, &mut self.dialogs.open);
        opened.into_iter().for_each(|path| self.ask_to_leave(Leaving::Open(Some(path))));
        let file = choose_file::show(ctx, &mut self.dialogs.file);
        file.into_iter().for_each(|(purpose, path)| self.use_file(&purpose, &path));
        self.show_loading();
        self.show_unsaved();
        self.show_conflict();
        self.show_recovery();
        self.show_unfinished();
        scene_error::show_of_file(ctx, &mut self.dialogs.file_error);
        if let Some(opened) = self.session.opened.as_ref().filter(|_| self.dialogs.remarks) {
            remarks::show(ctx, &mut self.dialogs.remarks, &opened.remarks);
        }
        if help::show(ctx, &mut self.dialogs.help) {
            self.start_tour();
        }
        if scene_error::show(ctx, &mut self.dialogs.scene_error, self.session.opened.is_some()) {
            self.ask_to_leave(Leaving::Open(None));
        }
        let request = self.dialogs.gallery.show(ctx, &self.catalogue, self.session.path());
        request.into_iter().for_each(|request| self.open_scene(request));
        self.show_advice(ctx);
        if let Some(page) = self.dialogs.tour.filter(|_| self.results.shown.is_some()) {
            tour::show(ctx, page).into_iter().for_each(|request| self.follow_tour(request));
        }
        self.dialogs.notices.show(ctx);
    }

    /// Whether a study has the machine, and the picture waits.
    pub fn is_studying(&self) -> bool {
        self.background.adviser.as_ref().is_some_and(Adviser::is_busy)
    }

    fn show_advice(&mut self, ctx: &egui::Context) {
        let (edited, camera, adviser) = (*self.session.edited(), self.session.camera, &mut self.background.adviser);
        // Advice is for the picture that it was asked for, and for none that has changed since.
        adviser.take_if(|adviser| adviser.request.settings != edited || adviser.request.camera != camera);
        advice::show(ctx, adviser).into_iter().for_each(|settings| *self.session.edited() = settings);
    }

    /// Starts the tour in the first window of a user.
    pub fn welcome(&mut self) {
        if !self.preferences.now.toured {
            self.start_tour();
        }
    }

    pub fn start_tour(&mut self) {
        self.follow_tour(TourRequest::GoTo(0));
    }

    fn follow_tour(&mut self, request: TourRequest) {
        match request {
            TourRequest::GoTo(page) => {
                self.dialogs.tour = Some(page);
                self.window.tab = tour::tab_of(page).or(self.window.tab);
            }
            TourRequest::End => _ = self.end_tour(),
            TourRequest::Restart => self.background.worker.restart(),
            TourRequest::ShowSecondBounce => (self.session.bounces.k, self.session.bounces.up_to) = (2, false),
            TourRequest::CompareWithCap => {
                self.session.settings.roulette = Roulette::BY_THROUGHPUT;
                self.start_comparison(RenderSettings { max_bounces: Some(3), ..self.session.settings });
            }
            TourRequest::CompareBothEnds => {
                self.session.settings.estimator = Estimator::Mis;
                self.start_comparison(RenderSettings { estimator: Estimator::Bidirectional, ..self.session.settings });
            }
            TourRequest::OpenGallery => self.dialogs.gallery.open = true,
        }
    }

    /// Ends the tour. Returns whether it was open.
    pub fn end_tour(&mut self) -> bool {
        self.preferences.change(|saved| saved.toured |= self.dialogs.tour.is_some());
        self.dialogs.tour.take().is_some()
    }
}
