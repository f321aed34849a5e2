//! Follows the files of the open scene: other programs can change them.
use std::path::Path;

use noisefall_edit::edit::Outside;
use noisefall_formats::import::is_foreign;
use noisefall_scene::scene::{SceneError, load};

use super::{scene_editor::SceneEditor, state::App};
use crate::viewer::background::{
    background_task::BackgroundTask,
    file_state::{FileState, compare, named_files},
};
use crate::viewer::dialogs::{
    conflict::{self, Conflict, ConflictAnswer},
    unsaved::{Leaving, SaveRequest},
};

impl App {
    /// Takes up what other programs have changed. Drags and saves end first.
    pub fn follow_files(&mut self) {
        if let Some(Ok(report)) = BackgroundTask::take(&mut self.outside.diagnosis) {
            self.dialogs.file_error = Some(report);
        }
        if self.saving.is_some() || self.is_dragging() {
            return;
        }
        self.watch_files();
        while let Some(path) = self.background.files.take() {
            if self.editor.as_ref().is_some_and(|editor| editor.document.path() == Some(&path)) {
                self.outside.recheck();
            } else if self.session.path() == Some(&path) || self.is_source(&path) {
                self.reload_foreign();
            } else {
                // The scene names it. The compile reads files that have changed.
                self.follow_document();
            }
        }
        let Some(document) = self.editor.as_ref().map(|editor| &editor.document) else { return };
        if let Some(Ok((version, state))) = BackgroundTask::take(&mut self.outside.comparison) {
            if version == document.version() {
                return self.follow_file(state, None);
            }
            self.outside.is_due = true;
        }
        if self.outside.is_due && self.outside.comparison.is_none() {
            let document = document.clone();
            let compare = move |_: &(dyn Fn() -> bool + Sync)| (document.version(), compare(&document));
            (self.outside.comparison, self.outside.is_due) = (Some(BackgroundTask::start(&self.ctx, compare)), false);
        }
    }

    /// Watches the scene file and the files that the scene names.
    fn watch_files(&mut self) {
        let (Some(editor), Some(opened)) = (&self.editor, &self.session.opened) else { return };
        let (document, folder) = (&editor.document, opened.folder());
        let (path, version) = (document.path().unwrap_or(Path::new("")), document.version());
        let before = self.outside.watched.as_ref();
        if before.is_some_and(|(of, watched)| of == path && *watched == version) {
            return;
        }
        let is_other = before.is_none_or(|(of, _)| of != path);
        let named = named_files(document.description()).into_iter().map(|file| folder.join(file));
        let foreign = opened.path.clone().filter(|path| is_foreign(path));
        let sources = foreign.iter().flat_map(|_| opened.scene.assets.sources()).map(|file| folder.join(file));
        let files = named.chain(document.path().map(Path::to_owned)).chain(sources).chain(foreign.clone()).collect();
        self.background.files.watch(files);
        self.outside.watched = Some((path.to_owned(), version));
        // It could have changed before it was watched.
        self.outside.is_due |= is_other;
    }

    /// Whether the scene of another program was read from this file too, such as one that its file includes.
    fn is_source(&self, path: &Path) -> bool {
        let (Some(editor), Some(opened)) = (&self.editor, &self.session.opened) else { return false };
        let Ok(inside) = path.strip_prefix(opened.folder()) else { return false };
        let is_named = || named_files(editor.document.description()).iter().any(|file| file == inside);
        let is_foreign = opened.path.as_deref().is_some_and(is_foreign);
        is_foreign && opened.scene.assets.sources().any(|source| Path::new(source) == inside) && !is_named()
    }

    /// Opens the scene of another program again that has changed.
    fn reload_foreign(&mut self) {
        let Some(path) = self.session.path().map(Path::to_owned) else { return };
        self.window.kept_view = Some((Some(path.clone()), self.session.window_view()));
        self.ask_to_leave(Leaving::Open(Some(path)));
    }

    /// Takes up the file as it is now. `save` is a save that met it.
    pub fn follow_file(&mut self, state: FileState, save: Option<SaveRequest>) {
        let save = save.or_else(|| self.dialogs.conflict.take()?.save);
        self.dialogs.conflict = None;
        match state {
            FileState::Known => {
                if self.shows_document() {
                    self.dialogs.file_error = None;
                }
                save.into_iter().for_each(|save| self.request_save(save));
            }
            FileState::Changed(outside) if outside.conflicts => {
                (self.dialogs.conflict, self.dialogs.file_error) = (Some(Conflict { file: Ok(outside), save }), None);
            }
            FileState::Changed(outside) => {
                self.take_outside(*outside);
                self.resume_save(save);
            }
            FileState::Missing => {
                if let Some(editor) = &mut self.editor {
                    editor.document.keep_own("");
                    let name = file_name(editor);
                    self.tell(format!("{name} was removed by another program. Save the scene to keep it."), true);
                }
            }
            FileState::Broken(file) => {
                self.dialogs.file_error = Some(file.report.clone());
                self.dialogs.conflict = save.map(|save| Conflict { file: Err(file), save: Some(save) });
            }
        }
    }

    /// Goes on with a save that waited for the file to be taken up.
    fn resume_save(&mut self, save: Option<SaveRequest>) {
        let Some(save) = save else { return };
        if self.has_unsaved_changes() {
            self.request_save(save);
        } else {
            save.leaving.into_iter().for_each(|leaving| self.ask_to_leave(leaving));
        }
    }

    /// Whether a drag of the mouse or an operation of the gizmo is under way.
    pub fn is_dragging(&self) -> bool {
        self.selection.gizmo.is_active() || self.ctx.input(|input| input.pointer.any_down())
    }

    /// Whether the image is, or will be, that of the document.
    pub fn shows_document(&self) -> bool {
        let (Some(editor), Some(opened)) = (&self.editor, &self.session.opened) else { return false };
        self.is_compiling() || editor.document.description() == &*opened.description
    }

    /// Reloads the scene file, as a step that can be undone.
    fn take_outside(&mut self, outside: Outside) {
        let Some(editor) = &self.editor else { return };
        let (before, name) = (editor.description(), file_name(editor));
        self.dialogs.file_error = None;
        if !outside.is_format {
            self.history.push_edit("reload of the file");
        }
        self.step_in_scene(|editor| editor.take_outside(outside), |now| *now != *before);
        self.tell(format!("Reloaded {name}"), false);
    }

    /// Shows the question about a file that was changed by another program, and follows the answer.
    pub fn show_conflict(&mut self) {
        let (Some(conflict), Some(editor)) = (&self.dialogs.conflict, &mut self.editor) else { return };
        let Some(answer) = conflict::show(&self.ctx, conflict, &file_name(editor)) else { return };
        if answer == ConflictAnswer::SaveAs {
            // The question stays until the scene is saved.
            self.window.leaving = conflict.save.as_ref().and_then(|save| save.leaving.clone());
            return self.ask_where_to_save();
        }
        let Some(Conflict { file, save }) = self.dialogs.conflict.take() else { return };
        match (answer, file) {
            (ConflictAnswer::KeepMine, file) => {
                let text = file.map_or_else(|broken| broken.text, |outside| Some(outside.text().to_owned()));
                // A later change of the file is asked about again. What is not text cannot be compared.
                let replaces = text.is_none();
                text.into_iter().for_each(|text| editor.document.keep_own(text));
                self.outside.recheck();
                save.into_iter().for_each(|save| self.request_save(SaveRequest { replaces, ..save }));
            }
            (ConflictAnswer::UseFile, Ok(outside)) => {
                self.take_outside(*outside);
                self.resume_save(save);
            }
            _ => {}
        }
    }

    /// Finds the place of an error in a scene file that was reloaded. Returns false if the document is not that of its file.
    pub fn diagnose_file(&mut self, error: &SceneError) -> bool {
        let submitted = self.session.submitted_edit.as_deref();
        let document = self.editor.as_ref().map(|editor| &editor.document);
        let document = document.filter(|document| !document.has_changes() && submitted == Some(document.description()));
        let Some(path) = document.and_then(|document| document.path()).map(Path::to_owned) else { return false };
        let known = error.report();
        let report = move |_: &(dyn Fn() -> bool + Sync)| load(&path).err().map_or(known, |error| error.report());
        self.outside.diagnosis = Some(BackgroundTask::start(&self.ctx, report));
        true
    }
}

/// The name of the scene file.
fn file_name(editor: &SceneEditor) -> String {
    let name = editor.document.path().and_then(Path::file_name);
    name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}
