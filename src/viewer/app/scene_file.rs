//! Asks before unsaved changes are lost.
use std::path::Path;

use egui::ViewportCommand;
use noisefall_render::render::State;

use super::state::App;
use crate::viewer::dialogs::unsaved::{self, Leaving, UnsavedAnswer};

impl App {
    pub fn has_unsaved_changes(&self) -> bool {
        self.editor.as_ref().is_some_and(|editor| editor.document.has_changes())
    }

    /// Leaves the open scene: when it is saved, or after a question if it has unsaved changes.
    pub fn ask_to_leave(&mut self, leaving: Leaving) {
        let is_saved = !self.has_unsaved_changes();
        match &mut self.saving {
            _ if is_saved => self.leave(leaving),
            Some(saving) => saving.leave(leaving),
            None => self.dialogs.unsaved = Some(leaving),
        }
    }

    /// Leaves the open scene, whatever is unsaved.
    pub fn leave(&mut self, leaving: Leaving) {
        self.background.recovery.restoring = None;
        match leaving {
            Leaving::Open(path) => self.background.loader.open(path),
            Leaving::New(template) => self.background.loader.begin(template),
            Leaving::Restore(found) => {
                let file = found.recovery.file().map(Path::to_owned);
                self.window.kept_view = found.recovery.view.as_deref().map(|view| (file, *view));
                self.background.loader.restore(found.recovery);
                self.background.recovery.restoring = Some(found.file);
            }
            Leaving::Quit => {
                self.window.quits = true;
                self.background.recovery.forget();
                self.ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    /// Holds the window open while a question about unsaved changes has no answer.
    pub fn guard_changes(&mut self) {
        let closes = self.ctx.input(|input| input.viewport().close_requested());
        if closes && !self.window.quits && self.has_unsaved_changes() {
            self.ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.ask_to_leave(Leaving::Quit);
        } else if closes {
            self.background.progress.forget();
        }
    }

    /// Shows the question about unsaved changes, and follows the answer.
    pub fn show_unsaved(&mut self) {
        if self.dialogs.unsaved.is_none() {
            return;
        }
        let name = self.session.opened.as_ref().map_or("", |opened| opened.name.as_str());
        let Some(answer) = unsaved::show(&self.ctx, name) else { return };
        let Some(leaving) = self.dialogs.unsaved.take() else { return };
        match answer {
            UnsavedAnswer::Save => {
                self.window.leaving = Some(leaving);
                self.save_scene();
            }
            UnsavedAnswer::Discard => self.leave(leaving),
            UnsavedAnswer::Cancel => {}
        }
    }

    /// The window's title says whether there are unsaved changes, and which target is reached: a window that is not looked at is known
    /// by its title.
    pub fn update_title(&mut self) {
        let Some(opened) = &self.session.opened else { return };
        let mark = if self.has_unsaved_changes() { " •" } else { "" };
        let done = if let State::Done(target) = self.results.status.state { format!(" ({target})") } else { String::new() };
        let title = format!("{}{mark}{done} – Noisefall", opened.name);
        if title != self.window.title {
            self.window.title.clone_from(&title);
            self.ctx.send_viewport_cmd(ViewportCommand::Title(title));
        }
    }
}
