//! Joins the windows over the image with the state of the window.
use std::path::PathBuf;

use noisefall_scene::{
    material::Material,
    scene::{
        Estimator, RenderSettings, Roulette,
        description::{ObjectDescription, SceneDescription},
    },
};

use super::{front::FrontDialog, state::App};
use crate::viewer::background::adviser::Adviser;
use crate::viewer::dialogs::{
    advice, choose_file, help, open, open_reference, remarks, save,
    save::SaveAnswer,
    save_target::SaveTarget,
    scene_error, shield,
    tour::{self, TourRequest},
    unsaved::Leaving,
};
use crate::viewer::instruments::tabs::InstrumentTab;

/// The shipped scene with the caustic of a glass ball.
const GLASS: &str = "glass_ball_caustic";

impl App {
    /// Shows the dialog in front, and what lies over the image beside it.
    pub fn show_dialogs(&mut self, ctx: &egui::Context) {
        self.receive_questions();
        let front = self.front();
        if front.is_some_and(FrontDialog::waits) {
            shield::show(ctx);
        }
        match front {
            Some(front) => self.show_front(ctx, front),
            None => self.show_loading(),
        }
        if let Some(page) = self.dialogs.tour.filter(|_| self.results.shown.is_some() && front.is_none()) {
            let has_glass = self.session.opened.as_ref().is_some_and(|opened| has_glass(&opened.description));
            tour::show(ctx, page, has_glass).into_iter().for_each(|request| self.follow_tour(request));
        }
        let height = if front.is_none() { scene_error::show_of_file(ctx, &mut self.dialogs.file_error) } else { 0.0 };
        self.dialogs.notices.show(ctx, height);
    }

    fn show_front(&mut self, ctx: &egui::Context, front: FrontDialog) {
        match front {
            FrontDialog::Save => self.show_save(ctx),
            FrontDialog::Open => {
                let opened = open::show(ctx, &mut self.dialogs.open);
                opened.into_iter().for_each(|path| self.ask_to_leave(Leaving::Open(Some(path))));
            }
            FrontDialog::ChooseFile => {
                let file = choose_file::show(ctx, &mut self.dialogs.file);
                file.into_iter().for_each(|(purpose, path)| self.use_file(&purpose, &path));
            }
            FrontDialog::Reference => {
                let reference = open_reference::show(ctx, &mut self.dialogs.reference);
                reference.into_iter().for_each(|path| self.background.loader.read_reference(path, self.session.camera));
            }
            FrontDialog::Tev => self.show_tev(ctx),
            FrontDialog::Sequence => self.show_sequence(ctx),
            FrontDialog::ExistingFrames => self.show_existing_frames(ctx),
            FrontDialog::Unsaved => self.show_unsaved(),
            FrontDialog::Conflict => self.show_conflict(),
            FrontDialog::Recovery => self.show_recovery(),
            FrontDialog::Unfinished => self.show_unfinished(),
            FrontDialog::Help => {
                if help::show(ctx, &mut self.dialogs.help) {
                    self.start_tour();
                }
            }
            FrontDialog::Gallery => {
                let request = self.dialogs.gallery.show(ctx, &self.catalogue, self.session.path());
                request.into_iter().for_each(|request| self.open_scene(request));
            }
            FrontDialog::SceneError => {
                if scene_error::show(ctx, &mut self.dialogs.scene_error, self.session.opened.is_some()) {
                    self.ask_to_leave(Leaving::Open(None));
                }
            }
            FrontDialog::Advice => self.show_advice(ctx),
            FrontDialog::Remarks => {
                if let Some(opened) = &self.session.opened {
                    remarks::show(ctx, &mut self.dialogs.remarks, &opened.remarks);
                }
            }
        }
    }

    fn show_save(&mut self, ctx: &egui::Context) {
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
    }

    /// Whether a study has the machine, and the image waits.
    pub fn is_studying(&self) -> bool {
        self.background.adviser.as_ref().is_some_and(Adviser::is_busy)
    }

    fn show_advice(&mut self, ctx: &egui::Context) {
        let adviser = &mut self.background.adviser;
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
            TourRequest::CompareBidirectional => {
                self.session.settings.estimator = Estimator::Mis;
                self.start_comparison(RenderSettings { estimator: Estimator::Bidirectional, ..self.session.settings });
            }
            TourRequest::OpenGlass => {
                let entry = self.catalogue.iter().find(|entry| entry.path.file_stem().is_some_and(|stem| stem == GLASS));
                let path = entry.map_or_else(|| PathBuf::from(GLASS), |entry| entry.path.clone());
                self.ask_to_leave(Leaving::Open(Some(path)));
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

/// Whether a scene has glass that light is refracted by.
fn has_glass(scene: &SceneDescription) -> bool {
    let refracts = |object: &ObjectDescription| {
        let material = object.material.as_ref().and_then(|name| scene.materials.get(name));
        material.is_some_and(|material| matches!(material.kind, Material::Dielectric(_)))
    };
    scene.objects.iter().any(refracts)
}
