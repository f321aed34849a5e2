//! Saves the open scene, and asks before unsaved changes are lost.
use std::path::Path;

use egui::ViewportCommand;
use noisefall::{
    declare::{Declare, Parameter, Parameters, Value},
    render::State,
    scene::description::SceneDescription,
};

use super::state::App;
use crate::viewer::background::catalogue;
use crate::viewer::dialogs::{
    save_target::SaveTarget,
    unsaved::{self, Answer, Leaving},
};

impl App {
    /// Saves the scene to its file. A scene without a file asks for one.
    pub fn save_scene(&mut self) {
        let Some(editor) = &self.editor else { return };
        match editor.document.path().map(Path::to_owned) {
            Some(path) => self.save_scene_to(&path),
            None => self.ask_where_to_save(),
        }
    }

    pub fn ask_where_to_save(&mut self) {
        self.open_save_dialog(SaveTarget::Scene);
    }

    /// Saves the scene to a file, which is its file from then on. Then what waited for it goes on.
    pub fn save_scene_to(&mut self, path: &Path) {
        let (Some(editor), Some(opened)) = (&mut self.editor, &mut self.session.opened) else { return };
        let leaving = self.window.leaving.take();
        let folder = |path: &Path| path.parent().and_then(|folder| folder.canonicalize().ok());
        let moves = opened.path.as_deref().is_some_and(|before| folder(before) != folder(path));
        if moves && names_files(editor.document.description()) {
            let folder = opened.folder();
            return self.tell(
                format!("Not saved: the scene uses relative file paths. Save it in their folder, {}", folder.display()),
                true,
            );
        }
        if let Err(error) = editor.document.save(path) {
            return self.tell(format!("Not saved: {error}"), true);
        }
        if opened.path.as_deref() != Some(path) {
            opened.path = Some(path.to_owned());
            opened.name = catalogue::name(&editor.document.description().title, path);
            catalogue::remember(&mut self.catalogue, &opened.name, path);
        }
        self.tell(format!("Saved {}", path.display()), false);
        leaving.into_iter().for_each(|leaving| self.leave(leaving));
    }

    pub fn has_unsaved_changes(&self) -> bool {
        self.editor.as_ref().is_some_and(|editor| editor.document.has_changes())
    }

    /// Leaves the open scene, after a question if it has unsaved changes.
    pub fn ask_to_leave(&mut self, leaving: Leaving) {
        if self.has_unsaved_changes() {
            self.dialogs.unsaved = Some(leaving);
        } else {
            self.leave(leaving);
        }
    }

    fn leave(&mut self, leaving: Leaving) {
        match leaving {
            Leaving::Open(path) => self.background.loader.open(path),
            Leaving::New(template) => self.background.loader.begin(template),
            Leaving::Quit => {
                self.window.quits = true;
                self.ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    /// Holds the window open while a question about unsaved changes has no answer.
    pub fn guard_changes(&mut self) {
        let closes = self.ctx.input(|input| input.viewport().close_requested());
        if closes && !self.window.quits && self.has_unsaved_changes() {
            self.ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.dialogs.unsaved = Some(Leaving::Quit);
        }
    }

    /// Shows the question about unsaved changes, and follows the answer.
    pub fn show_unsaved(&mut self) {
        let Some(leaving) = self.dialogs.unsaved.clone() else { return };
        let name = self.session.opened.as_ref().map_or("", |opened| opened.name.as_str());
        let Some(answer) = unsaved::show(&self.ctx, name) else { return };
        self.dialogs.unsaved = None;
        match answer {
            Answer::Save => {
                self.window.leaving = Some(leaving);
                self.save_scene();
            }
            Answer::Discard => self.leave(leaving),
            Answer::Cancel => {}
        }
    }

    /// The window's title says whether there are unsaved changes, and which target is reached: a window that is not looked at is known
    /// by its title.
    pub fn update_title(&mut self) {
        let Some(opened) = &self.session.opened else { return };
        let mark = if self.has_unsaved_changes() { "*" } else { "" };
        let done = if let State::Done(target) = self.results.status.state { format!(" ({target})") } else { String::new() };
        let title = format!("{}{mark}{done} – Noisefall", opened.name);
        if title != self.window.title {
            self.window.title.clone_from(&title);
            self.ctx.send_viewport_cmd(ViewportCommand::Title(title));
        }
    }
}

/// Whether a scene names files relative to its own.
fn names_files(description: &SceneDescription) -> bool {
    struct Files(bool);
    impl Parameters for Files {
        fn value(&mut self, _: &Parameter, value: Value<'_>) {
            if let Value::File(path) = value {
                self.0 |= Path::new(path).is_relative();
            }
        }
    }
    let mut files = Files(false);
    description.clone().parameters(&mut files);
    files.0
}
