//! The parts of the app that tests of the window look at, each by one name: a field that moves changes this file alone.
use std::{path::PathBuf, sync::Arc};

use noisefall_render::render::{Budget, Frame, Status, view::DisplaySettings};
use noisefall_scene::scene::{Camera, RenderSettings};

use crate::viewer::{
    app::App,
    background::{
        display_image::ReferenceComparison, loader::Loader, opened_scene::OpenedScene, render_worker::RenderWorkerHandle,
    },
    canvas::{interaction::Tool, picture_view::PictureView},
    instruments::{
        compare::comparison::Comparison, convergence::history::History as ErrorHistory, path::inspector::PathInspector,
        tabs::InstrumentTab,
    },
    panels::{panel_tabs::PanelTab, subject::Subject},
};

impl App {
    pub fn opened(&self) -> &Option<OpenedScene> {
        &self.session.opened
    }

    pub fn opened_mut(&mut self) -> &mut Option<OpenedScene> {
        &mut self.session.opened
    }

    pub fn camera(&self) -> Camera {
        self.session.camera
    }

    pub fn camera_mut(&mut self) -> &mut Camera {
        &mut self.session.camera
    }

    pub fn settings(&self) -> RenderSettings {
        self.session.settings
    }

    pub fn settings_mut(&mut self) -> &mut RenderSettings {
        &mut self.session.settings
    }

    pub fn compared_with(&self) -> Option<Comparison> {
        self.session.comparison
    }

    pub fn compared_with_mut(&mut self) -> &mut Option<Comparison> {
        &mut self.session.comparison
    }

    pub fn budget(&self) -> Budget {
        self.session.budget
    }

    pub fn budget_mut(&mut self) -> &mut Budget {
        &mut self.session.budget
    }

    pub fn look(&self) -> DisplaySettings {
        self.session.look
    }

    pub fn look_mut(&mut self) -> &mut DisplaySettings {
        &mut self.session.look
    }

    pub fn status(&self) -> &Status {
        &self.results.status
    }

    pub fn status_mut(&mut self) -> &mut Status {
        &mut self.results.status
    }

    pub fn second_status(&self) -> &Status {
        &self.results.second_status
    }

    pub fn shown_frame(&self) -> &Option<Arc<Frame>> {
        &self.results.shown
    }

    pub fn second_frame(&self) -> &Option<Arc<Frame>> {
        &self.results.second_frame
    }

    pub fn measured_error(&self) -> &Option<ReferenceComparison> {
        &self.results.comparison
    }

    pub fn tab(&self) -> Option<InstrumentTab> {
        self.window.tab
    }

    pub fn tab_mut(&mut self) -> &mut Option<InstrumentTab> {
        &mut self.window.tab
    }

    pub fn tool(&self) -> Tool {
        self.window.tool
    }

    pub fn tool_mut(&mut self) -> &mut Tool {
        &mut self.window.tool
    }

    pub fn panel(&self) -> PanelTab {
        self.window.panel
    }

    pub fn panel_mut(&mut self) -> &mut PanelTab {
        &mut self.window.panel
    }

    pub fn picture_view(&self) -> &PictureView {
        &self.window.view
    }

    pub fn last_saved(&self) -> Option<PathBuf> {
        self.window.last_saved.clone()
    }

    pub fn last_saved_mut(&mut self) -> &mut Option<PathBuf> {
        &mut self.window.last_saved
    }

    pub fn hovered(&self) -> Option<[u32; 2]> {
        self.window.hovered
    }

    pub fn selected(&self) -> Option<Subject> {
        self.selection.subject.clone()
    }

    pub fn selected_mut(&mut self) -> &mut Option<Subject> {
        &mut self.selection.subject
    }

    pub fn path_inspector(&self) -> &PathInspector {
        &self.instruments.path
    }

    pub fn path_inspector_mut(&mut self) -> &mut PathInspector {
        &mut self.instruments.path
    }

    pub fn curves(&self) -> &ErrorHistory {
        &self.instruments.history
    }

    pub fn worker(&self) -> &RenderWorkerHandle {
        &self.background.worker
    }

    pub fn worker_mut(&mut self) -> &mut RenderWorkerHandle {
        &mut self.background.worker
    }

    pub fn loader(&self) -> &Loader {
        &self.background.loader
    }

    pub fn loader_mut(&mut self) -> &mut Loader {
        &mut self.background.loader
    }
}
