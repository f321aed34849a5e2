//! Commands of the toolbar and of keys.
use egui::Ui;
use noisefall_render::render::State;

use super::{front::FrontDialog, state::App};
use crate::viewer::background::catalogue::SceneRequest;
use crate::viewer::canvas::interaction::Tool;
use crate::viewer::dialogs::save_target::SaveTarget;
use crate::viewer::instruments::tabs::InstrumentTab;
use crate::viewer::panels::toolbar::{Command, Toolbar};

impl App {
    pub fn toolbar(&mut self, ui: &mut Ui) {
        let bar = Toolbar {
            is_open: self.session.opened.is_some(),
            is_paused: self.session.budget.paused,
            is_done: matches!(self.results.status.state, State::Done(_)),
            has_region: self.session.budget.region.is_some(),
            can_save: self.can_save(),
            is_comparing: self.session.comparison.is_some(),
            undo: self.history.names(),
            tool: self.window.tool,
            zoom: self.results.shown.as_ref().map(|_| self.window.view.drawn_zoom),
            settings: &self.session.settings,
        };
        bar.show(ui).into_iter().for_each(|command| self.perform(command));
    }

    pub fn perform(&mut self, command: Command) {
        self.history.end_gesture();
        match command {
            Command::Undo => self.undo(),
            Command::Redo => self.redo(),
            Command::TogglePause => self.session.budget.paused = !self.session.budget.paused,
            Command::Step => self.step(),
            Command::Restart => self.background.worker.restart(),
            Command::ChooseTool(tool) => {
                self.window.tool = tool;
                if tool == Tool::Inspect {
                    self.window.tab = Some(InstrumentTab::Path);
                }
            }
            Command::ClearRegion => self.session.budget.region = None,
            Command::ResetCamera => self.session.reset_camera(),
            Command::Fit => self.window.view.fit(),
            Command::ActualSize => self.window.view.actual_size(),
            Command::Compare(other) => self.start_comparison(other),
            Command::EndComparison => self.session.comparison = None,
            Command::Open => self.open_scene(SceneRequest::Browse),
            Command::SaveScene => self.save_scene(),
            Command::SavePicture => self.open_save_dialog(SaveTarget::Picture),
            Command::Help => self.toggle_dialog(FrontDialog::Help),
        }
    }
}
