//! Joins the panels at the right and at the bottom with the state of the window.
use egui::{ScrollArea, Ui};
use noisefall_base::declare::capitalised;
use noisefall_render::render::RenderRequest;

use super::state::App;
use crate::viewer::background::{adviser::Adviser, catalogue::SceneRequest, recent};
use crate::viewer::dialogs::{open::OpenDialog, unsaved::Leaving};
use crate::viewer::panels::{
    camera, panel_tabs, panel_tabs::PanelTab, pixel_readout::Pixel, reference, reference::ReferenceRow, sampling,
    sampling::Findings, scene, status_bar::StatusBar, stop, tone, views, window,
};
use crate::viewer::widgets::style::{leave_room_for_bar, section};

/// The largest part of the panel's height that the notes of a scene take while it is edited.
const NOTES: f32 = 0.2;

impl App {
    pub fn side_panel(&mut self, ui: &mut Ui) {
        let height = ui.available_height();
        ui.scope(|ui| {
            leave_room_for_bar(ui);
            self.scene_and_tabs(ui);
        });
        if self.window.panel == PanelTab::Edit {
            let notes = ScrollArea::vertical().id_salt("notes").max_height(NOTES * height).auto_shrink([false, true]);
            notes.show(ui, |ui| {
                leave_room_for_bar(ui);
                scene::notes(ui, self.session.opened.as_ref());
            });
            // Its parts scroll by themselves.
            return self.editor_panel(ui);
        }
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            leave_room_for_bar(ui);
            scene::notes(ui, self.session.opened.as_ref());
            ui.add_enabled_ui(self.session.opened.is_some(), |ui| {
                section(ui, "Sampling", |ui| self.sampling_panel(ui));
                section(ui, "Stop", |ui| stop::show(ui, &mut self.session.budget, self.session.camera.resolution));
                section(ui, "Display", |ui| self.display_panel(ui));
                section(ui, "Camera", |ui| {
                    let scene = self.session.opened.as_ref().map(|opened| opened.scene.as_ref());
                    if camera::show(ui, &mut self.session.camera, scene) {
                        self.session.reset_camera();
                    }
                });
                section(ui, "Window", |ui| {
                    let theme = window::show(ui, &mut self.session.threads, &mut self.frame_times.shown);
                    theme.into_iter().for_each(|theme| self.preferences.change(|saved| saved.theme = theme));
                });
            });
        });
    }

    /// Shows the scene and the tabs, which stay where they are while the rest scrolls.
    fn scene_and_tabs(&mut self, ui: &mut Ui) {
        ui.add_space(4.0);
        let opened = self.session.opened.as_ref();
        let request = scene::show(ui, opened, &self.catalogue);
        ui.add_space(4.0);
        panel_tabs::show(ui, &mut self.window.panel);
        request.into_iter().for_each(|request| self.open_scene(request));
    }

    pub fn open_scene(&mut self, request: SceneRequest) {
        match request {
            SceneRequest::Open(path) => self.ask_to_leave(Leaving::Open(path)),
            SceneRequest::Browse => {
                let recent = recent::look_up(&self.preferences.now.recent);
                self.dialogs.open = Some(OpenDialog::new(self.session.path(), recent));
            }
            SceneRequest::Gallery => self.dialogs.gallery.open = true,
        }
    }

    fn sampling_panel(&mut self, ui: &mut Ui) {
        sampling::side_choice(ui, self.session.comparison.as_mut().map(|comparison| &mut comparison.edits_other));
        let edits_second = self.session.comparison.is_some_and(|comparison| comparison.edits_other);
        let status = if edits_second { &self.results.second_status } else { &self.results.status };
        let edited = *self.session.edited();
        let caution = self
            .session
            .opened
            .as_ref()
            .and_then(|opened| opened.scene.infinite_variance(&edited))
            .map(|caution| format!("{}.", capitalised(&caution)));
        let in_force = self.session.opened.as_ref().and_then(|opened| opened.scene.estimator_in_force(&edited));
        let unmergeable = self.session.opened.as_ref().and_then(|opened| opened.scene.obstacle_to_merging()).map(capitalised);
        let findings =
            Findings { status, in_force: in_force.as_ref(), unmergeable: unmergeable.as_deref(), caution: caution.as_deref() };
        if sampling::show(ui, self.session.edited(), &findings) {
            self.ask_for_advice();
        }
    }

    fn ask_for_advice(&mut self) {
        let settings = *self.session.edited();
        if let Some(request) = self.background.worker.request() {
            let request = RenderRequest { settings, ..request.clone() };
            self.background.adviser = Some(Adviser::start(&self.ctx, &request, self.session.threads));
        }
    }

    pub fn display_panel(&mut self, ui: &mut Ui) {
        let default_exposure = self.session.opened.as_ref().map_or(0.0, |opened| opened.scene.exposure);
        tone::show(ui, &mut self.session.look.display, default_exposure);
        views::rows(ui, &mut self.session.look.map, self.results.shown.as_ref(), &mut self.session.pinned);
        let (mut noise, unusable) = (self.session.reference_noise, self.why_no_reference());
        let row = ReferenceRow {
            source: self.reference_source(),
            noise: &mut noise,
            is_rendering: self.background.reference.is_some(),
            unusable: unusable.as_deref(),
        };
        let command = reference::row(ui, row);
        self.session.reference_noise = noise;
        command.into_iter().for_each(|command| self.follow_reference(command));
    }

    pub fn status_bar(&mut self, ui: &mut Ui) {
        let (session, results, over_second) = (&self.session, &self.results, self.window.over_second);
        let frame = if over_second { &results.second_frame } else { &results.shown };
        let values = if over_second { &results.second_values } else { &results.values };
        let materials = session.opened.as_ref().map_or(&[][..], |opened| &opened.materials);
        let pixel = |at| Some(Pixel { at, frame: frame.as_ref()?, values, legend: results.legend.as_ref(), materials });
        let bar = StatusBar {
            opened: session.opened.as_ref(),
            is_opening: self.background.loader.is_busy(),
            is_studying: self.is_studying(),
            camera: &session.camera,
            settings: &session.settings,
            in_force: session.opened.as_ref().and_then(|opened| opened.scene.estimator_in_force(&session.settings)),
            budget: &session.budget,
            status: &results.status,
            request: self.background.worker.request(),
            why_black: results.why_black(),
            comparison: results.comparison,
            reference_noise: self.reference().and_then(|reference| reference.relative_noise()),
            mismatch: self.reference().and_then(|reference| reference.mismatch(session.camera.resolution)),
            pixel: self.window.hovered.and_then(pixel),
            is_denoised: self.shown_view().is_denoised(),
        };
        self.dialogs.remarks |= bar.show(ui);
    }
}
